"""The mirror image of a motion joint by joint, the oracle of `mirror_features`."""

from dataclasses import replace

import numpy as np

from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import MIRROR


def mirror_motion(motion: Motion) -> Motion:
    """Left and right change places across the plane x = 0."""
    signs = np.array([1, 1, -1, -1], dtype=np.float32)  # M·R·M, M = diag(-1, 1, 1)
    return replace(
        motion,
        quaternions=motion.quaternions[:, list(MIRROR)] * signs,
        root_position=motion.root_position * np.array([-1, 1, 1], dtype=np.float32),
        contacts=motion.contacts[:, ::-1].copy(),
    )
