"""A phrase of motion: clips joined at their motion beats, positions and headings carried on.

A seam lies where a motion beat of one clip meets one of the next, so that the beats go on, and
where the two pelvises do nearly the same. Over the seam the clips' velocities, heights, yaw
rates and tilts are blended; the path is their integral, so nothing jumps.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...motion.root_track import FORWARD, HEIGHT, LATERAL, YAW_RATE, integrate_root
from ...motion.rotations import quaternion_multiply, quaternion_slerp
from ...motion.trajectory_math import yaw_quaternion
from .clip_library import FPS, MARGIN, Clip

NEAREST = 12  # candidates for the next clip, the best matches at the seam
REPEAT_COST = 1.5  # how much better a clip that was used must fit
SHORT_COST = 2.0  # of a piece of one second, half of it for two
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
