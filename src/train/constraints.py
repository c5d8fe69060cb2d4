"""Which entries of a clip the network is told in training: random masks.

It learns every use of a constraint at once: a pinned path, feet that land when they are to, windows
that follow each other, gaps between two clips, joints done again.

Letters: B batch, T frames, R rows.
"""

import numpy as np
import torch
from torch import Tensor

from ..shared.config_schema import ConstraintShares
from ..shared.motion.features import FORWARD, HEIGHT, LATERAL, LEFT_CONTACT, ROOT_ROW, YAW_RATE
from ..shared.motion.skeleton import JOINT_INDEX, LIMBS

LONGEST_END = 45  # frames known at a start or an end
ROOT_WAYS = (0.7, 0.15, 0.15)  # shares of both, heading alone, path alone
MOST_FRAMES = 6  # frames known here and there


def draw_known(
    mask: Tensor, rows: int, shares: ConstraintShares, rng: np.random.Generator
) -> Tensor:
    """Random masks [B, T, R, 6] bool for clips with real frames `mask` [B, T] bool."""
    known = torch.zeros(*mask.shape, rows, 6, dtype=torch.bool)
    for row, length in zip(known, mask.sum(1).tolist(), strict=True):
        if rng.random() >= shares.free:
            _draw_clip(row[:length], shares, rng)
    return known


def _draw_clip(known: Tensor, shares: ConstraintShares, rng: np.random.Generator) -> None:
    """Fill the mask [T, R, 6] of one clip."""
    frames = len(known)
    if rng.random() < shares.joints:
        _draw_joints(known, rng)
        return
    if known.shape[1] > ROOT_ROW and rng.random() < shares.root:
        _draw_root(known, rng)
    if known.shape[1] > ROOT_ROW and rng.random() < shares.contacts:
        known[_most(frames, rng), ROOT_ROW, LEFT_CONTACT:] = True
    longest = max(1, min(LONGEST_END, frames // 2))
    if rng.random() < shares.start:
        known[: rng.integers(1, longest + 1)] = True
    if rng.random() < shares.end:
        known[frames - rng.integers(1, longest + 1) :] = True
    if rng.random() < shares.frames:
        known[torch.as_tensor(rng.choice(frames, size=rng.integers(1, MOST_FRAMES + 1)))] = True


def _draw_joints(known: Tensor, rng: np.random.Generator) -> None:
    """All but some limbs, or the whole body, during a span."""
    span = _span(len(known), rng)
    again = [name for name in LIMBS if rng.random() < 0.4]
    known[:] = True
    if not again:
        known[span] = False
    for limb in again:
        known[span, [JOINT_INDEX[joint] for joint in LIMBS[limb]]] = False
        if limb.endswith("leg"):
            known[span, ROOT_ROW:, LEFT_CONTACT:] = False


def _draw_root(known: Tensor, rng: np.random.Generator) -> None:
    """The path and the heading, or one of them; at times the height and the pelvis' tilt."""
    span = _most(len(known), rng)
    ways = ([FORWARD, LATERAL, YAW_RATE], [YAW_RATE], [FORWARD, LATERAL])
    channels = list(ways[rng.choice(len(ways), p=ROOT_WAYS)])
    channels += [HEIGHT] if rng.random() < 0.6 else []
    for channel in channels:
        known[span, ROOT_ROW, channel] = True
    if rng.random() < 0.25:
        known[span, 0] = True  # the pelvis' tilt


def _most(frames: int, rng: np.random.Generator) -> slice:
    """Nearly always the whole clip."""
    return slice(None) if rng.random() < 0.85 else _span(frames, rng)


def _span(frames: int, rng: np.random.Generator) -> slice:
    start, stop = sorted(rng.integers(0, frames + 1, size=2).tolist())
    return slice(start, max(stop, start + 1))
