"""The mirror image of a motion: left and right change places across the plane x = 0."""

from dataclasses import replace

import numpy as np
import torch
from torch import Tensor

from .motion import Motion
from .root_track import LATERAL, LEFT_CONTACT, RIGHT_CONTACT, YAW_RATE
from .skeleton import MIRROR, NUM_JOINTS

_QUATERNION_SIGNS = np.array([1, 1, -1, -1], dtype=np.float32)  # M·R·M, M = diag(-1, 1, 1)
_SIX_D_SIGNS = (1.0, -1.0, -1.0, -1.0, 1.0, 1.0)  # the same on the first two columns


def mirror_motion(motion: Motion) -> Motion:
    """The mirrored motion; the caption is left to whoever knows its language."""
    return replace(
        motion,
        quaternions=motion.quaternions[:, list(MIRROR)] * _QUATERNION_SIGNS,
        root_position=motion.root_position * np.array([-1, 1, 1], dtype=np.float32),
        contacts=motion.contacts[:, ::-1].copy(),
    )


def mirror_features(features: Tensor) -> Tensor:
    """Mirror features [...,23,6] or [...,22,6] directly: a permutation and signs."""
    rotations = features[..., list(MIRROR), :] * features.new_tensor(_SIX_D_SIGNS)
    if features.shape[-2] == NUM_JOINTS:
        return rotations
    order = list(range(6))
    order[LEFT_CONTACT], order[RIGHT_CONTACT] = RIGHT_CONTACT, LEFT_CONTACT
    signs = torch.ones_like(features[..., 0, :])
    signs[..., [LATERAL, YAW_RATE]] = -1
    root = features[..., NUM_JOINTS, order] * signs
    return torch.cat((rotations, root[..., None, :]), -2)
