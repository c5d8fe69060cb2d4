"""Gestures as wholes: which clips come back to where they began, and how one is made shorter.

T frames. Features are those of src/shared/motion/root_track.py, raw.
"""

import torch
from torch import Tensor

from ..motion.root_track import FORWARD, LATERAL, ROOT_ROW

SHORTEST_SHARE = 0.4  # of its frames a gesture keeps at least
_IN_PLACE = 0.3  # m/s over the ground, on average
_SAME_POSE = 1.0  # between [22,6] rotations: hands that hang, twice; half a step is 1.2
_JOIN = 10  # frames over which the two moments are blended
_ENDS = 8  # frames at both ends that are never left out
_PACE = 6.0  # frames of motion that weigh as much as the pose, when moments are compared


def comes_back(values: Tensor) -> bool:
    """Whether a clip [T,23,6] stays in place and ends in the pose that it began with."""
    travel = values[:, ROOT_ROW, [FORWARD, LATERAL]].norm(dim=-1).mean()
    gap = (values[0, :ROOT_ROW] - values[-1, :ROOT_ROW]).norm()
    return bool(travel < _IN_PLACE) and bool(gap < _SAME_POSE)


def shorten(values: Tensor, frames: int) -> Tensor | None:
    """The clip [T,23,6] without a part of its middle: [≤frames,23,6], or None.

    The two moments nearest in pose and motion are joined (a transition of a motion graph, Kovar
    et al. 2002, section 3.1), as far apart as is needed and up to a fifth more. None where too
    much would go, or no two moments are alike.
    """
    num = len(values)
    excess = num - frames
    if frames < num * SHORTEST_SHARE or num - excess < 2 * _ENDS:
        return None
    pose = values[:, :ROOT_ROW].flatten(1)  # [T,132]
    pace = torch.nn.functional.pad(pose[1:] - pose[:-1], (0, 0, 0, 1)) * _PACE
    moments = torch.cat((pose, pace), dim=1)
    far = torch.cdist(moments, moments)  # [T,T]
    first, second = torch.meshgrid(torch.arange(num), torch.arange(num), indexing="ij")
    apart = second - first
    allowed = (apart >= excess) & (apart <= excess + frames // 5)
    allowed &= (first >= _ENDS) & (second < num - _ENDS - _JOIN)
    far = far.masked_fill(~allowed, torch.inf)
    best = int(far.argmin())
    start, end = best // num, best % num
    if far[start, end] > _SAME_POSE:
        return None
    share = torch.linspace(0, 1, _JOIN + 2)[1:-1, None, None]
    joined = torch.lerp(values[start : start + _JOIN], values[end : end + _JOIN], share)
    return torch.cat((values[:start], joined, values[end + _JOIN :]))
