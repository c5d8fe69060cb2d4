"""Random skeletons in random motion, for the tests of formats that hold any skeleton."""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from src.shared.formats.rig import Rig, RigClip


def random_clip(seed: int, *, joints: int = 12, frames: int = 4, axes: bool = False) -> RigClip:
    """A random tree with bones of 5 to 60 cm, any rotation in any frame.

    Args:
        seed: of all numbers.
        joints: N.
        frames: T.
        axes: give the joints axes of their own, as GLB files have; then joint 2 moves, too.
    """
    rng = np.random.default_rng(seed)
    parents = (-1, *(int(rng.integers(0, joint)) for joint in range(1, joints)))
    order = depth_first(parents)
    parents = tuple(order.index(parents[j]) if parents[j] >= 0 else -1 for j in order)
    offsets = rng.normal(size=(joints, 3))
    offsets *= rng.uniform(0.05, 0.6, (joints, 1)) / np.linalg.norm(offsets, axis=-1, keepdims=True)
    leaves = sorted(set(range(joints)) - set(parents))
    tips = tuple((leaf, tuple(rng.uniform(-0.2, 0.2, 3).round(3).tolist())) for leaf in leaves)
    turns = Rotation.random(joints, random_state=seed).as_matrix()
    orders = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")
    rig = Rig(
        tuple(f"joint {j} ü" for j in range(joints)),
        parents,
        offsets,
        tips,
        turns if axes else np.tile(np.eye(3), (joints, 1, 1)),
        tuple(orders[int(k)] for k in rng.integers(0, 6, joints)),
    )
    rotations = Rotation.random(frames * joints, random_state=seed + 1).as_matrix()
    translations = np.repeat(offsets[None], frames, 0)
    translations[:, 0] = rng.uniform(-5, 5, (frames, 3))
    if axes:
        translations[:, 2] += rng.uniform(-0.1, 0.1, (frames, 3))
    shape = (frames, joints, 3, 3)
    return RigClip(rig, rotations.reshape(shape), translations, 30.0, "any")


def depth_first(parents: tuple[int, ...]) -> list[int]:
    """The joints in the order in which files list them."""
    order, stack = [], [0]
    while stack:
        order.append(stack.pop())
        stack += [j for j in reversed(range(len(parents))) if parents[j] == order[-1]]
    return order


def differences(first: Any, second: Any) -> tuple[float, float]:
    """The largest angle (rad) and distance of joints of two clips with the same joints."""
    (places, turns), (others, turned) = first.world(), second.world()
    angles = Rotation.from_matrix((turns.swapaxes(-1, -2) @ turned).reshape(-1, 3, 3)).magnitude()
    return float(angles.max()), float(np.abs(places - others).max())
