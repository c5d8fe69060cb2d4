"""Bodies whose beats, landings and paths are known by construction."""

import numpy as np

from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX, NUM_JOINTS, REST_PELVIS_HEIGHT

FPS = 30.0


def swinging_arms(period: float = 0.5, frames: int = 240, offset: float = 0.0) -> Motion:
    """Arms that swing to and fro and rest for a moment at offset + k · period seconds."""
    time = np.arange(frames) / FPS
    angle = 0.8 * np.cos(np.pi * (time - offset) / period)
    quaternions = np.zeros((frames, NUM_JOINTS, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    for name in ("l_shoulder", "r_shoulder"):
        quaternions[:, JOINT_INDEX[name], 0] = np.cos(angle / 2)
        quaternions[:, JOINT_INDEX[name], 2] = np.sin(angle / 2)
    root = np.tile(np.float32([0, REST_PELVIS_HEIGHT, 0]), (frames, 1))
    return Motion(quaternions, root, np.ones((frames, 2), dtype=np.float32), FPS)


def hopping(period: float = 0.5, frames: int = 240, height: float = 0.1) -> Motion:
    """A statue that is off the ground between multiples of `period` seconds."""
    time = np.arange(frames) / FPS
    root = np.zeros((frames, 3), dtype=np.float32)
    root[:, 1] = REST_PELVIS_HEIGHT + height * np.abs(np.sin(np.pi * time / period))
    quaternions = np.zeros((frames, NUM_JOINTS, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    return Motion(quaternions, root, np.zeros((frames, 2), dtype=np.float32), FPS)
