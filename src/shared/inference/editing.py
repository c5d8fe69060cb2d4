"""Editing: what of given clips is kept, as a constraint, and the rest made anew.

The first and last seconds of clips with something new between them; chosen joints, or a span of
time, of one clip. `filling.py` makes the rest.

Letters: T frames, R rows (bones, root track), C channels.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
import torch
from torch import Tensor

from ..config_loader import nearest
from ..errors import UsageError
from ..model.generation.constraint import Constraint
from ..motion.motion import Motion
from ..motion.root_track import (
    FORWARD,
    LATERAL,
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    encode_features,
    headings,
)
from ..motion.rotations import quaternion_to_matrix
from ..motion.skeleton import JOINT_INDEX, LIMBS
from ..motion.trajectory_math import turn_about_y

GROUND = [FORWARD, LATERAL, YAW_RATE]  # channels of the root row that say where the body goes
LEGS = LIMBS["left-leg"] + LIMBS["right-leg"]
GROUPS: dict[str, tuple[str, ...]] = LIMBS | {
    "arms": LIMBS["left-arm"] + LIMBS["right-arm"],
    "legs": LEGS,
    "head": ("neck", "head"),
    "upper-body": LIMBS["left-arm"] + LIMBS["right-arm"] + LIMBS["trunk"],
    "lower-body": ("pelvis", *LEGS),
    "body": tuple(JOINT_INDEX),
}


@dataclass(frozen=True)
class Place:
    """Where a pelvis is on the ground and where it faces: metres and radians about +Y."""

    x: float = 0.0
    z: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, eq=False)
class Given:
    """What is known of a motion that is to be made.

    Attributes:
        constraint: T frames.
        place: of the first frame.
        rejoin: frame from which all is known again, and the place there; None = wherever the
            motion leads.
    """

    constraint: Constraint
    place: Place = Place()
    rejoin: tuple[int, Place] | None = None


def place_of(motion: Motion, frame: int) -> Place:
    """Where a body is in a frame."""
    pelvis = quaternion_to_matrix(torch.as_tensor(motion.quaternions[:, 0]))
    x, _, z = motion.root_position[frame].tolist()
    return Place(x, z, float(headings(pelvis)[frame]))


# ---------------------------------------------------------------- what is kept


def chosen_joints(names: Sequence[str]) -> set[str]:
    """Joints by their names and those of groups.

    Raises:
        UsageError: a name is unknown; names the nearest one.
    """
    known = [*GROUPS, *JOINT_INDEX]
    for name in names:
        if name not in known:
            raise UsageError(
                f"joint {name!r} is unknown; did you mean {nearest(name, known)!r}? Groups:"
                f" {', '.join(GROUPS)}; joints: {', '.join(JOINT_INDEX)}"
            )
    return set(chain.from_iterable(GROUPS.get(name, (name,)) for name in names))


def keep_ends(
    start: Motion | None, end: Motion | None, kept: int, frames: int, *, rejoin: bool = False
) -> Given:
    """A motion that begins as one clip begins, and ends as another one ends.

    It stands where `start` stands.

    Args:
        start: its first frames are kept; None = a free beginning.
        end: its last frames are kept; None = an open end.
        kept: frames of each.
        frames: of the whole, more than what is kept.
        rejoin: it ends where `end` stands; else wherever it leads.
    """
    given = Constraint.free(frames)
    for clip, of_clip, of_motion in (
        (start, slice(0, kept), slice(0, kept)),
        (end, slice(-kept, None), slice(frames - kept, frames)),
    ):
        if clip is not None:
            given.values[of_motion] = encode_features(clip)[of_clip]
            given.known[of_motion] = True
    place = Place() if start is None else place_of(start, 0)
    if end is None or not rejoin:
        return Given(given, place)
    return Given(given, place, (frames - kept, place_of(end, end.num_frames - kept)))


def redo(clip: Motion, start: int, stop: int, joints: set[str] | None = None) -> Given:
    """A clip of which frames [start, stop) are made anew.

    Args:
        clip: T frames.
        start, stop: frames.
        joints: only these, and the clip's path stays; None = the whole body and its path.
    """
    known = all_but(encode_features(clip), start, stop, joints)
    open_end = joints is not None or stop >= clip.num_frames
    rejoin = None if open_end else (stop, place_of(clip, stop))
    return Given(known, place_of(clip, 0), rejoin)


def all_but(features: Tensor, start: int, stop: int, joints: set[str] | None) -> Constraint:
    """Features [T,R,6] are known but for some joints, or everything, in frames [start, stop).

    Of the other joints the network is not told: it would make these as the body has them already,
    and not as the text says.
    """
    known = torch.ones(features.shape, dtype=torch.bool)
    told = None if joints is None else torch.zeros_like(known)
    if joints is None:
        known[start:stop] = False
    else:
        known[start:stop, [JOINT_INDEX[name] for name in sorted(joints)]] = False
        if joints & set(LEGS) and features.shape[1] > ROOT_ROW:
            known[start:stop, ROOT_ROW, LEFT_CONTACT:] = False
    return Constraint(features, known, told=told)


# ---------------------------------------------------------------- how well it is kept


def kept_error(motion: Motion, given: Constraint) -> dict[str, float]:
    """Largest differences between what was known and what a motion has become.

    Returns:
        rotation: of entries of the 6D rotations of known joints; root: of the root row's known
        velocities (m/s, rad/s) and height (m), the last frame's velocities left out, as they are
        none. 0 where nothing was known.
    """
    apart = (encode_features(motion) - given.values).abs()
    known = given.known.clone()
    known[-1, ROOT_ROW, GROUND] = False
    known[:, ROOT_ROW, LEFT_CONTACT:] = False
    apart[~known] = 0.0
    return {
        "rotation": float(apart[:, :ROOT_ROW].max()),
        "root": float(apart[:, ROOT_ROW].max()),
    }


def kept_positions_error(motion: Motion, clip: Motion, frames: slice, of_clip: slice) -> float:
    """Metres that a joint in kept frames is at most from where it was, place apart."""
    made = _seen_from_start(motion, frames)
    return float(np.abs(made - _seen_from_start(clip, of_clip)).max())


def _seen_from_start(motion: Motion, frames: slice) -> np.ndarray:
    """Joint positions [t,22,3] from where the body is in the first of some frames."""
    place = place_of(motion, range(motion.num_frames)[frames][0])
    positions = torch.as_tensor(motion.positions()[frames], dtype=torch.float64)
    positions = positions - torch.tensor([place.x, 0.0, place.z])
    return turn_about_y(positions, -place.heading).numpy()
