"""A motion on the spot: the pelvis stays over the origin, as game engines want loops."""

from dataclasses import replace

import numpy as np

from .motion import Motion


def in_place(motion: Motion) -> Motion:
    """The same motion without travel: x and z of the pelvis are 0 in every frame.

    Height, rotations and contacts are kept: a jump still rises and a turn still turns, but feet
    that stood now slide backwards under the body.
    """
    flat = np.array([0.0, 1.0, 0.0], np.float32)
    return replace(motion, root_position=motion.root_position * flat)
