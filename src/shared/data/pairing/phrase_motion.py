"""A phrase of motion: clips joined at their motion beats, and the whole body that follows.

A seam lies where a motion beat of one clip meets one of the next, so that the beats go on, and
where the two pelvises do nearly the same. Over the seam the clips' velocities, heights, yaw
rates and tilts are blended; the path is their integral, so nothing jumps. Pieces and warp say which
moment of which clip is seen when, so the other joints follow the same seams and the same warp.

T frames of the phrase, N of its motion before the warp.
"""

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from scipy.interpolate import CubicSpline
from scipy.optimize import lsq_linear
from torch import Tensor

from ...io.files import is_whole, write_json
from ...io.storage import Place
from ...motion.features import (
    FORWARD,
    HEIGHT,
    LATERAL,
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    encode_features,
    integrate_root,
)
from ...motion.motion import Motion
from ...motion.rotations import (
    quaternion_continuous,
    quaternion_multiply,
    quaternion_slerp,
    rotation_6d_to_quaternion,
    yaw_quaternion,
)
from ..phrases.layout import StoredObject, write_body
from ..prepared import MIRRORED, ClipRecord, PreparedData
from .clip_library import FPS, MARGIN, Clip, track_of

LIMIT = 0.15
MATCH_LIMIT = 0.13  # between two matches; the rest of the limit lets the rate change smoothly
KNOT_SECONDS = 0.2
LOOK_BACK = 6  # motion beats; so many less one may stay unmatched in a row
GRID_LOOK_BACK = 12  # music beats
SKIP_COST = 0.5  # per motion beat left unmatched
STRETCH_COST = 20.0  # per squared log rate and match
RATE_DIGITS = 5  # what the manifest stores is what was used

Pair = tuple[int, int]


def match_beats(motion: np.ndarray, grid: np.ndarray, seconds: float, lead: float) -> list[Pair]:
    """Pairs (motion beat, music beat) in order, each next one reachable at an allowed rate.

    Args:
        motion: motion beats [N] in seconds of the motion's own time.
        grid: music beats [K] in seconds of the phrase.
        seconds: length of the phrase.
        lead: seconds of motion that may be skipped before the phrase starts.

    Maximises matches minus `SKIP_COST` per motion beat between them left out minus
    `STRETCH_COST` times the squared logarithm of the rate between matches.
    """
    grid_index = np.flatnonzero((grid >= 0) & (grid < seconds))
    times = grid[grid_index]
    if not len(motion) or not len(times):
        return []
    score = np.full((len(motion), len(times)), -np.inf)
    parent = np.full((len(motion), len(times), 2), -1)
    for i, beat in enumerate(motion):
        # A chain may start here if the motion before it fills the phrase's beginning.
        earliest, latest = beat - times * (1 + MATCH_LIMIT), beat - times * (1 - MATCH_LIMIT)
        missed = i - np.searchsorted(motion[:i], beat - times)
        fits = (earliest <= lead) & (latest >= 0)
        score[i] = np.where(fits, 1 - SKIP_COST * missed, -np.inf)
        for back in range(1, min(LOOK_BACK, i) + 1):
            passed = beat - motion[i - back]
            for step in range(1, min(GRID_LOOK_BACK, len(times) - 1) + 1):
                rate = passed / (times[step:] - times[:-step])
                allowed = np.abs(rate - 1) <= MATCH_LIMIT
                gain = 1 - SKIP_COST * (back - 1) - STRETCH_COST * np.log(rate) ** 2
                value = np.where(allowed, score[i - back, :-step] + gain, -np.inf)
                better = value > score[i, step:]
                score[i, step:][better] = value[better]
                columns = np.flatnonzero(better) + step
                parent[i, columns, 0], parent[i, columns, 1] = i - back, columns - step
    i, k = (int(n) for n in np.unravel_index(int(score.argmax()), score.shape))
    pairs = []
    while i >= 0 and np.isfinite(score[i, k]):
        pairs.append((i, int(grid_index[k])))
        i, k = (int(n) for n in parent[i, k])
    return pairs[::-1]


@dataclass(frozen=True)
class Warp:
    """When of the motion is seen at which time of the phrase.

    Attributes:
        start: seconds of motion at the phrase's first frame.
        rates: playback rates at knots `KNOT_SECONDS` apart, 1 = as recorded, linear between.
    """

    start: float
    rates: tuple[float, ...]

    def times(self, at: np.ndarray) -> np.ndarray:
        """Seconds of motion [T] at phrase seconds `at` [T] ≥ 0."""
        return np.asarray(self.start + _integral(at, len(self.rates)) @ np.asarray(self.rates))


def _integral(at: np.ndarray, num_knots: int) -> np.ndarray:
    """Weights [T,K] of knot rates in the integral over [0, at] of their linear interpolation."""
    x = np.clip(np.asarray(at, np.float64) / KNOT_SECONDS, 0, num_knots - 1)[:, None]
    left = np.clip(x - np.arange(num_knots - 1), 0, 1)  # share of each interval passed
    weights = np.zeros((len(x), num_knots))
    weights[:, :-1] += left - left**2 / 2
    weights[:, 1:] += left**2 / 2
    return weights * KNOT_SECONDS


def knots_for(seconds: float) -> int:
    """Number of knots that cover a phrase."""
    return int(np.ceil(seconds / KNOT_SECONDS - 1e-9)) + 1


def plain_warp(seconds: float, start: float = 0.0) -> Warp:
    """As recorded."""
    return Warp(start, (1.0,) * knots_for(seconds))


def fit_warp(motion: np.ndarray, music: np.ndarray, seconds: float, lead: float) -> Warp:
    """The smoothest warp that shows motion second `motion[n]` at phrase second `music[n]`.

    Rates stay within [1 - LIMIT, 1 + LIMIT].

    Bounded linear least squares in the knots' rates: hits within 10 ms weigh as much as a
    curvature of the rate of 0.05 per knot.

    Args:
        motion, music: matched seconds [N] each; none gives the plain warp.
        seconds: length of the phrase.
        lead: largest `start`.
    """
    if not len(motion):
        return plain_warp(seconds, lead / 2)
    k = knots_for(seconds)
    hits = np.concatenate((np.ones((len(music), 1)), _integral(music, k)), 1) / 0.01
    stay = np.eye(k, k + 1, 1)
    bend = np.diff(stay, n=2, axis=0)
    matrix = np.concatenate((hits, bend / 0.05, stay / 0.5))
    target = np.concatenate((motion / 0.01, np.zeros(len(bend)), np.full(k, 1 / 0.5)))
    low = np.array([0.0] + [1 - LIMIT] * k)
    high = np.array([max(lead, 1e-6)] + [1 + LIMIT] * k)
    solution = lsq_linear(matrix, target, (low, high)).x
    rates = np.clip(np.round(solution[1:], RATE_DIGITS), 1 - LIMIT, 1 + LIMIT)
    return Warp(round(float(solution[0]), RATE_DIGITS), tuple(float(rate) for rate in rates))


def resample(
    position: np.ndarray, quaternion: np.ndarray, times: np.ndarray, fps: float = 30.0
) -> tuple[np.ndarray, np.ndarray]:
    """A pelvis path [N,3] and its rotations [N,4] at other seconds [T]: cubic and slerp."""
    last = len(position) - 1
    moved = CubicSpline(np.arange(last + 1), position.astype(np.float64))(
        np.clip(times * fps, 0, last)
    )
    return moved.astype(np.float32), resample_rotations(quaternion, times, fps)


def resample_rotations(quaternion: np.ndarray, times: np.ndarray, fps: float = 30.0) -> np.ndarray:
    """Rotations [N,...,4] at other seconds [T], by slerp, without changes of sign: [T,...,4]."""
    last = len(quaternion) - 1
    frames = np.clip(times * fps, 0, last)
    before = np.minimum(frames.astype(int), last - 1)
    q = torch.as_tensor(quaternion, dtype=torch.float32)
    part = torch.as_tensor(frames - before, dtype=torch.float32)
    part = part.view(-1, *(1,) * (q.ndim - 1))
    return quaternion_continuous(quaternion_slerp(q[before], q[before + 1], part)).numpy()


NEAREST = 12  # candidates for the next clip, the best matches at the seam
REPEAT_COST = 1.5  # how much better a clip that was used must fit
SHORT_COST = 2.0  # of a piece of one second, half of it for two
SPARE = 2  # frames beyond the phrase that only help to derive (ruling 6)
SEAM_FRAMES = 2 * MARGIN + 1  # 0.43 s


@dataclass(frozen=True)
class Piece:
    """Frames of a clip within a phrase, before the time warp.

    Attributes:
        clip: id in the prepared folder.
        first, last: frames of the clip, last included.
        at: frame of the phrase's motion where `first` lies; `SEAM_FRAMES` are shared with the
            piece before.
    """

    clip: str
    first: int
    last: int
    at: int


@dataclass(frozen=True, eq=False)
class PhraseMotion:
    """Motion of a phrase in its own time.

    Attributes:
        position: pelvis [N,3] float32, metres; starts at x = z = 0, facing +Z.
        quaternion: world rotation [N,4] float32, w x y z.
        pieces: where it comes from.
        seams: frames [len(pieces)-1], the middle of each.
    """

    position: np.ndarray
    quaternion: np.ndarray
    pieces: tuple[Piece, ...]
    seams: tuple[int, ...]


def assemble(
    clips: Sequence[Clip], weights: np.ndarray, num_frames: int, rng: np.random.Generator
) -> PhraseMotion:
    """Join clips until they fill `num_frames`.

    Args:
        clips: to choose from, at least one, each with two cuts or more.
        weights: probability of each as the first one [len(clips)].
        num_frames: N.
        rng: makes every choice.
    """
    index = int(rng.choice(len(clips), p=weights))
    entries = [clip.entries for clip in clips]
    match = np.concatenate([clip.match[e] for clip, e in zip(clips, entries, strict=True)])
    owner = np.repeat(np.arange(len(clips)), [len(e) for e in entries])
    entry = np.concatenate(entries)
    spans = np.concatenate(
        [clip.cuts[-1] - clip.cuts[e] for clip, e in zip(clips, entries, strict=True)]
    )
    shortness = SHORT_COST * FPS / spans  # few long pieces rather than many short ones
    # A long clip is entered anywhere, so that all of it is used.
    cut = int(rng.choice(entries[index]))
    first = int(clips[index].cuts[cut]) - MARGIN if cut else 0
    pieces: list[Piece] = []
    used: list[int] = []
    at = 0
    while True:
        clip = clips[index]
        last = int(clip.cuts[-1]) + MARGIN
        if at + clip.num_frames - first >= num_frames:
            pieces.append(Piece(clip.id, first, first + num_frames - at - 1, at))
            break
        pieces.append(Piece(clip.id, first, last, at))
        at += last - first + 1 - SEAM_FRAMES
        cost = np.linalg.norm(match - clip.match[-1], axis=1) + shortness
        used.append(index)
        cost += REPEAT_COST * np.isin(owner, used)  # rather another clip than the same again
        nearest = np.argpartition(cost, min(NEAREST, len(cost)) - 1)[:NEAREST]
        chance = np.exp(-(cost[nearest] - cost[nearest].min()))
        chosen = nearest[int(rng.choice(len(nearest), p=chance / chance.sum()))]
        index = int(owner[chosen])
        first = int(clips[index].cuts[entry[chosen]]) - MARGIN
    by_id = {clip.id: clip for clip in clips}
    return join(pieces, lambda name: (by_id[name].root, by_id[name].tilt))


def join(
    pieces: Sequence[Piece], tracks: Callable[[str], tuple[np.ndarray, np.ndarray]]
) -> PhraseMotion:
    """The motion that pieces make up.

    Args:
        pieces: in order.
        tracks: clip id → its rows [T,4] and tilt [T,4], see `Clip`.
    """
    rows = lay(pieces, lambda name: torch.as_tensor(tracks(name)[0]), torch.lerp)
    tilt = lay(pieces, lambda name: torch.as_tensor(tracks(name)[1]), quaternion_slerp)
    root = torch.zeros(len(rows), 6)
    root[:, [FORWARD, LATERAL, HEIGHT, YAW_RATE]] = rows
    position, heading = integrate_root(root, FPS)
    quaternion = quaternion_multiply(yaw_quaternion(heading), tilt)
    seams = tuple(piece.at + MARGIN for piece in pieces[1:])
    return PhraseMotion(position.numpy(), quaternion.numpy(), tuple(pieces), seams)


def lay(
    pieces: Sequence[Piece],
    values: Callable[[str], Tensor],
    blend: Callable[[Tensor, Tensor, Tensor], Tensor],
) -> Tensor:
    """Frames of clips one after the other, blended where they share a seam.

    Args:
        pieces: in order.
        values: clip id → [T,...].
        blend: (before, after, weight of after) → what a seam shows; `torch.lerp`, say.

    Returns:
        [N,...].
    """
    x = torch.arange(1, SEAM_FRAMES + 1, dtype=torch.float32) / (SEAM_FRAMES + 1)
    smooth = x**3 * (x * (6 * x - 15) + 10)  # two vanishing derivatives at both ends
    parts = [values(piece.clip)[piece.first : piece.last + 1] for piece in pieces]
    laid = parts[0].new_zeros(pieces[-1].at + len(parts[-1]), *parts[0].shape[1:])
    for number, (piece, part) in enumerate(zip(pieces, parts, strict=True)):
        if number:
            before = laid[piece.at : piece.at + SEAM_FRAMES]
            n = len(before)
            weight = smooth[:n].view(n, *(1,) * (part.ndim - 1))
            part = torch.cat((blend(before, part[:n], weight), part[n:]))
        laid[piece.at : piece.at + len(part)] = part
    return laid


Entry = dict[str, Any]


def add_body(out: Place, entry: Entry, data: PreparedData) -> None:
    """Write the body of a phrase; its entry, as `pair_song` makes them, learns of it."""
    pieces, warp = read_pair(entry["pair"])
    frames, records = entry["pair"]["frames"], data.records_by_id
    features = phrase_body(pieces, warp, frames, lambda name: data.features(records[name]))
    entry["body"] = write_body(out, entry["id"], features.numpy()).model_dump()


def describe(out: Place, entries: Sequence[Entry], data: PreparedData) -> None:
    """Put body, tag, caption and clips of phrases into their records, and a caption of each of
    their clips beside these; bodies that are missing are made, as in folders of before.
    """
    records = data.records_by_id
    for entry in entries:
        stored = StoredObject(**entry["body"]) if "body" in entry else None
        if stored is None or not is_whole(out / stored.path, stored.sha256):
            add_body(out, entry, data)
            write_json(out / "phrases" / f"{entry['id']}.json", entry)
        parts = entry["pair"]["pieces"]
        longest = max(parts, key=lambda piece: piece["last"] - piece["first"])
        shown = records[longest["clip"]]
        captions = data.captions(shown)
        spoken = captions.get("en") or next(iter(captions.values()), None) or [""]
        chosen = zlib.crc32(entry["id"].encode()) % len(spoken)  # phrases of a clip differ in it
        entry["record"] |= {
            "body": entry["body"],
            "tag": shown.tag,
            "caption": spoken[chosen],
            "clips": sorted({part["clip"].removesuffix(MIRRORED) for part in parts}),
        }
        told = {part["clip"]: _told(records[part["clip"]], data) for part in parts}
        entry["pair"]["captions"] = {clip: text for clip, text in told.items() if text}


def _told(record: ClipRecord, data: PreparedData) -> str:
    """A caption of a clip: its own if it has one, rather than one of its labels; English first."""
    for captions in (record.captions, data.captions(record)):
        for texts in (captions.get("en", []), *captions.values()):
            if texts:
                return texts[0]
    return ""


def read_pair(pair: Entry) -> tuple[list[Piece], Warp]:
    """Pieces and warp as the manifest holds them."""
    warp = Warp(pair["warp"]["start"], tuple(pair["warp"]["rates"]))
    return [Piece(**piece) for piece in pair["pieces"]], warp


def phrase_body(
    pieces: Sequence[Piece], warp: Warp, num_frames: int, features_of: Callable[[str], Tensor]
) -> Tensor:
    """Features of a phrase's body; its pelvis is that of the phrase's trajectory.

    Args:
        pieces, warp: what the phrase is made of.
        num_frames: T.
        features_of: clip id → raw features [N',23,6].

    Returns:
        [T,23,6] float32, see motion/features.py.
    """
    times = warp.times(np.arange(num_frames + SPARE) / FPS)
    motion = join(pieces, lambda name: track_of(features_of(name)))
    position, pelvis = resample(motion.position, motion.quaternion, times, FPS)
    joints = lay(pieces, lambda name: _joints(features_of(name)), quaternion_slerp)  # N 21 4
    contacts = lay(pieces, lambda name: features_of(name)[:, ROOT_ROW, LEFT_CONTACT:], torch.lerp)
    body = Motion(
        quaternions=np.concatenate(
            (pelvis[:, None], resample_rotations(joints.numpy(), times, FPS)), 1
        ),
        root_position=position,
        contacts=_resample_linear(contacts.numpy(), times),
    )
    return encode_features(body)[:num_frames]


def _joints(features: Tensor) -> Tensor:
    """Rotations [N,21,4] of all joints but the pelvis."""
    return quaternion_continuous(rotation_6d_to_quaternion(features[:, 1:ROOT_ROW]))


def _resample_linear(values: np.ndarray, times: np.ndarray) -> np.ndarray:
    """[N,C] at other seconds [T]."""
    frames = np.arange(len(values)) / FPS
    columns = [np.interp(times, frames, column) for column in values.T]
    return np.stack(columns, 1).astype(np.float32)
