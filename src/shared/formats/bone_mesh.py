"""A simple body for any rig: one long octahedron a bone, so that viewers show something.

Legend: V vertices, F triangles, N joints.
"""

import re
from collections.abc import Sequence

import numpy as np

from .mannequin import Mannequin
from .rig import Rig

WAIST = 0.15  # of the bone's length from its start, where it is widest
WIDTH = 0.09  # half of that width, of the bone's length
_LEFT, _RIGHT = (
    re.compile(rf"{word}|(^|[_. :-]){word[0]}($|[_. -])", re.I) for word in ("left", "right")
)
_FACES = np.array([(0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4),
                   (5, 1, 2), (5, 2, 3), (5, 3, 4), (5, 4, 1)])  # fmt: skip


def bone_mesh(rig: Rig, loose: Sequence[int] = ()) -> Mannequin:
    """The bones of a rig as a skinned mesh, each vertex moved by one joint.

    Args:
        rig: the skeleton.
        loose: joints that move against their parents, to which no bone leads.
    """
    rest = rig.rest()
    bones = [
        (parent, rest[parent], rest[joint])
        for joint, parent in enumerate(rig.parents)
        if parent >= 0 and joint not in loose
    ]
    bones += [(joint, rest[joint], rest[joint] + tip) for joint, tip in rig.tips]
    bones = [bone for bone in bones if np.linalg.norm(bone[2] - bone[1]) > 1e-6]
    if not bones:  # a lone joint
        bones = [(0, rest[0], rest[0] + np.array([0.0, 0.1, 0.0]))]
    corners = np.concatenate([_octahedron(start, end)[_FACES] for _, start, end in bones])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    owners = np.repeat([owner for owner, _, _ in bones], 3 * len(_FACES))
    count = len(owners)
    sides = np.array([float(bool(_LEFT.search(n))) - bool(_RIGHT.search(n)) for n in rig.names])
    joints = np.zeros((count, 4), np.uint8 if len(rig.names) <= 256 else np.uint16)
    joints[:, 0] = owners
    return Mannequin(
        corners.reshape(-1, 3).astype(np.float32),
        np.repeat(normals, 3, 0).astype(np.float32),
        np.arange(count, dtype=np.int32).reshape(-1, 3),
        joints,
        np.tile(np.array([1, 0, 0, 0], np.float32), (count, 1)),
        sides[owners].astype(np.float32),
        rest.astype(np.float32),
    )


def _octahedron(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Its six corners [6,3]: the start, four around the waist, the end."""
    along = end - start
    length = np.linalg.norm(along)
    across = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    across *= WIDTH * length / np.linalg.norm(across)
    other = np.cross(along / length, across)
    waist = start + WAIST * along
    ring = [waist + across, waist + other, waist - across, waist - other]
    return np.array([start, *ring, end])
