"""Figures of edited motions: what was kept, what has changed, and how rough the borders are.

Letters: T frames, K joints.
"""

from dataclasses import dataclass

import numpy as np

from ..metrics.rhythm import seen_from_pelvis
from ..motion.motion import Motion
from ..motion.postprocess.stitching import joined, moved_to, place_of
from ..pipelines.edit import Given, kept_error
from .dance_seams import ACCELERATION, body_quantities

NEAR = 6  # frames on either side of a border


@dataclass(frozen=True)
class Kept:
    """How an edit compares with the clip that it was made of; both of T frames.

    Attributes:
        rotation: largest difference of a kept entry of the 6D rotations.
        root: the same of the root row's velocities (m/s, rad/s) and height (m).
        position: largest distance in mm of a joint in frames that are kept whole, place apart in
            what comes after the edit.
        changed: mean distance in cm of a joint from where the clip has it, in edited frames.
    """

    rotation: float
    root: float
    position: float
    changed: float


def kept_figures(motion: Motion, clip: Motion, given: Given) -> Kept:
    """Measure one edit; `changed` is 0 for who hands the clip back."""
    errors = kept_error(motion, given.constraint)
    whole = given.constraint.known.flatten(1).all(1).numpy()  # T
    made, real = from_pelvis(motion), from_pelvis(clip)
    apart = np.linalg.norm(made - real, axis=-1)  # T K
    return Kept(
        rotation=errors["rotation"],
        root=errors["root"],
        position=1000 * float(apart[whole].max()) if whole.any() else float("nan"),
        changed=100 * float(apart[~whole].mean()) if (~whole).any() else float("nan"),
    )


def from_pelvis(motion: Motion) -> np.ndarray:
    """Joint positions [T,21,3] in the pelvis's frame, and its height as one joint more."""
    height = np.zeros((motion.num_frames, 1, 3))
    height[:, 0, 1] = motion.root_position[:, 1]
    return np.concatenate((seen_from_pelvis(motion), height), axis=1)


def accelerations(motion: Motion) -> np.ndarray:
    """Of each frame [T] the largest acceleration of a joint in m/s²; 0 at the ends."""
    return body_quantities(motion)[ACCELERATION]


def near(frames: int, borders: list[int]) -> np.ndarray:
    """True [T] around the first frames of what follows a border."""
    mask = np.zeros(frames, dtype=bool)
    for border in borders:
        mask[max(0, border - NEAR) : border + NEAR] = True
    return mask


def borders_of(given: Given) -> list[int]:
    """Frames at which something stops or begins to be known."""
    known = given.constraint.known[:, :-1].flatten(1).numpy()
    return (1 + np.flatnonzero((known[1:] != known[:-1]).any(1))).tolist()


def hard_cut(first: Motion, second: Motion) -> Motion:
    """Two motions one after the other: the second goes on from the place of the first's end.

    What a transition looks like that nobody made.
    """
    return joined(first, moved_to(second, place_of(first, first.num_frames - 1)))
