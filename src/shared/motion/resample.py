"""Another frame rate: slerp for rotations, linear for positions, nearest for contacts."""

from dataclasses import replace

import numpy as np
import torch

from .motion import Motion
from .rotations import quaternion_continuous, quaternion_slerp

SAME_RATE = 1e-3  # relative; files say 0.033333 s for 30 fps


def resample_motion(motion: Motion, fps: float) -> Motion:
    """The same motion at `fps`; the first frame stays, the last lies within one frame.

    Raises:
        ValueError: `fps` is not positive.
    """
    if fps <= 0:
        raise ValueError(f"fps {fps} must be positive")
    if abs(fps / motion.fps - 1) < SAME_RATE or motion.num_frames < 2:
        return replace(motion, fps=fps)
    last = motion.num_frames - 1
    times = np.arange(int(last / motion.fps * fps + 1e-6) + 1) * (motion.fps / fps)
    before = np.minimum(times.astype(int), last - 1)
    part = (times - before).astype(np.float32)
    q = torch.as_tensor(motion.quaternions)
    q = quaternion_slerp(q[before], q[before + 1], torch.as_tensor(part)[:, None, None])
    p = motion.root_position
    return replace(
        motion,
        quaternions=quaternion_continuous(q, dim=0).numpy(),
        root_position=p[before] + part[:, None] * (p[before + 1] - p[before]),
        contacts=motion.contacts[np.minimum(np.rint(times).astype(int), last)],
        fps=fps,
    )
