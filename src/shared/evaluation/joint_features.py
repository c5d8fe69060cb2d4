"""What the evaluator sees of a motion: joint positions and velocities, no rotations.

The denoiser and its CLIP read 6D rotations; the judge reads where the joints are, so that the two
do not share their blind spots.

Letters: B batch, T frames, K bones, F = 130 features: pelvis height, 21 joint positions relative to
the pelvis in the heading frame (m), 21 joint velocities in that frame (m/s), forward and lateral
velocity (m/s), yaw rate (rad/s).
"""

import torch
from torch import Tensor

from src.shared.motion.kinematics import forward_kinematics
from src.shared.motion.root_track import FORWARD, HEIGHT, LATERAL, YAW_RATE
from src.shared.motion.rotations import rotation_6d_to_matrix
from src.shared.motion.skeleton import NUM_JOINTS, canonical_skeleton

FPS = 30.0
NUM_FEATURES = 1 + 2 * 3 * (NUM_JOINTS - 1) + 3


def heading_positions(features: Tensor) -> Tensor:
    """Joint positions [..., T, K, 3] relative to the pelvis, in the heading frame, in metres.

    Args:
        features: [..., T, K + 1, 6] raw motion features; row 0 holds no heading (ruling 19).
    """
    skeleton = canonical_skeleton()
    local = rotation_6d_to_matrix(features[..., :NUM_JOINTS, :])
    offsets = torch.as_tensor(skeleton.offsets, dtype=features.dtype, device=features.device)
    origin = features.new_zeros(*features.shape[:-2], 3)
    return forward_kinematics(local, origin, offsets, skeleton.parents)[0]


def joint_features(features: Tensor) -> Tensor:
    """[..., T, K + 1, 6] raw motion features to [..., T, F] of what the evaluator reads.

    Velocities are forward differences; the last frame repeats (ruling 6).

    Raises:
        ValueError: the root track is missing, or the shape is another.
    """
    if features.shape[-2:] != (NUM_JOINTS + 1, 6):
        raise ValueError(
            f"the evaluator reads [..., T, {NUM_JOINTS + 1}, 6] with a root track,"
            f" not {tuple(features.shape)}"
        )
    joints = heading_positions(features)[..., 1:, :].flatten(-2)
    velocities = (joints[..., 1:, :] - joints[..., :-1, :]) * FPS
    if features.shape[-3] > 1:
        velocities = torch.cat([velocities, velocities[..., -1:, :]], dim=-2)
    else:
        velocities = torch.zeros_like(joints)
    root = features[..., NUM_JOINTS, :]
    height = root[..., HEIGHT : HEIGHT + 1]
    track = root[..., [FORWARD, LATERAL, YAW_RATE]]
    return torch.cat([height, joints, velocities, track], dim=-1)
