"""A phrase of motion: clips joined at their motion beats, and the whole body that follows.

A seam lies where a motion beat of one clip meets one of the next, so that the beats go on, and
where the two pelvises do nearly the same. Over the seam the clips' velocities, heights, yaw
rates and tilts are blended; the path is their integral, so nothing jumps. Pieces and warp say which
moment of which clip is seen when, so the other joints follow the same seams and the same warp.

T frames of the phrase, N of its motion before the warp.
"""

import zlib
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...io.files import sha256_file, write_json
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
from ..prepared import MIRRORED, PreparedData
from .clip_library import FPS, MARGIN, Clip, track_of
from .time_warp import Warp, resample, resample_rotations

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

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


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


def add_bodies(out: Path, entries: Sequence[Entry], data: PreparedData) -> None:
    """Write the bodies that are missing, and put each into its phrase's record.

    Args:
        out: folder of the pairs; the marks in its `phrases` learn of the body.
        entries: of phrases, as `pair_song` returns them; `record` gets `body`, `tag`,
            `caption` and `clips`.
        data: the clips.
    """
    records = {record.id: record for record in data.records()}
    for entry in entries:
        stored = StoredObject(**entry["body"]) if "body" in entry else None
        if stored is None or not is_whole(out, stored):
            pieces, warp = read_pair(entry["pair"])
            frames = entry["pair"]["frames"]
            features = phrase_body(pieces, warp, frames, lambda n: data.features(records[n]))
            stored = write_body(out, entry["id"], features.numpy())
            entry["body"] = stored.model_dump()
            write_json(out / "phrases" / f"{entry['id']}.json", entry)
        parts = entry["pair"]["pieces"]
        longest = max(parts, key=lambda piece: piece["last"] - piece["first"])
        shown = records[longest["clip"]]
        captions = data.captions(shown)
        spoken = captions.get("en") or next(iter(captions.values()), [])
        entry["record"] |= {
            "body": stored.model_dump(),
            "tag": shown.tag,
            "caption": _one_of(spoken, entry["id"]),
            "clips": sorted({part["clip"].removesuffix(MIRRORED) for part in parts}),
        }


def is_whole(out: Path, stored: StoredObject) -> bool:
    """Whether a file is there with the content that its record describes."""
    path = out / stored.path
    return path.exists() and sha256_file(path) == stored.sha256


def _one_of(captions: Sequence[str], name: str) -> str:
    """A caption by the phrase's name, so that phrases of one clip are not all called alike."""
    if not captions:
        return ""
    return captions[zlib.crc32(name.encode()) % len(captions)]


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
