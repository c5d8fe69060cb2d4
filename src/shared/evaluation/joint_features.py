"""What the evaluator sees of a motion: joint positions and velocities, no rotations.

The denoiser and its CLIP read 6D rotations; the judge reads where the joints are, so that the two
do not share their blind spots.

Letters: B batch, T frames, K bones, F = 130 features: pelvis height, 21 joint positions relative to
the pelvis in the heading frame (m), 21 joint velocities in that frame (m/s), forward and lateral
velocity (m/s), yaw rate (rad/s).
"""

from collections.abc import Sequence

import torch
from torch import Tensor

from ..motion.features import FORWARD, HEIGHT, LATERAL, YAW_RATE
from ..motion.kinematics import forward_kinematics
from ..motion.rotations import rotation_6d_to_matrix
from ..motion.skeleton import NUM_JOINTS, canonical_skeleton

FPS = 30.0
NUM_FEATURES = 1 + 2 * 3 * (NUM_JOINTS - 1) + 3


def heading_positions(features: Tensor) -> Tensor:
    """Joint positions [T, K, 3] in metres, relative to the pelvis, in the heading frame.

    Args:
        features: [T, K + 1, 6] raw motion features; row 0 holds no heading (ruling 19).
    """
    skeleton = canonical_skeleton()
    local = rotation_6d_to_matrix(features[..., :NUM_JOINTS, :])
    offsets = torch.as_tensor(skeleton.offsets, dtype=features.dtype, device=features.device)
    origin = features.new_zeros(*features.shape[:-2], 3)
    return forward_kinematics(local, origin, offsets, skeleton.parents)[0]


def joint_features(clips: Sequence[Tensor]) -> list[Tensor]:
    """Raw motion features [T, K + 1, 6] of each clip to [T, F] of what the evaluator reads.

    The kinematics of all clips run at once. Velocities are forward differences; the last frame
    repeats (ruling 6).

    Raises:
        ValueError: the root track is missing, or a shape is another.
    """
    for clip in clips:
        if clip.ndim != 3 or clip.shape[1:] != (NUM_JOINTS + 1, 6):
            raise ValueError(
                f"the evaluator reads [T, {NUM_JOINTS + 1}, 6] with a root track,"
                f" not {tuple(clip.shape)}"
            )
    positions = heading_positions(torch.cat(list(clips))).split([len(clip) for clip in clips])
    return [_assemble(clip, joints) for clip, joints in zip(clips, positions, strict=True)]


def _assemble(features: Tensor, positions: Tensor) -> Tensor:
    joints = positions[:, 1:].flatten(1)  # [T, 63]
    velocities = torch.zeros_like(joints)
    if len(joints) > 1:
        velocities[:-1] = (joints[1:] - joints[:-1]) * FPS
        velocities[-1] = velocities[-2]
    root = features[:, NUM_JOINTS]
    track = root[:, [FORWARD, LATERAL, YAW_RATE]]
    return torch.cat([root[:, HEIGHT : HEIGHT + 1], joints, velocities, track], dim=-1)
