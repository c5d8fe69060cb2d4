"""The feature tensor of the text branch: 22 rotations in 6D and one root row (SPEC ruling 19).

T frames, K = 22 joints. Row K holds forward and lateral velocity (m/s, heading frame, lateral
positive to the character's left), pelvis height (m), yaw rate (rad/s, positive turns left) and
left and right contact. Differences are forward (ruling 6); the last frame repeats its neighbour.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..tensors import Tensor, torch
from .motion import Motion
from .rotations import (
    forward_difference,
    forward_kinematics,
    heading_angle,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_continuous,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    yaw_to_matrix,
)
from .skeleton import MIRROR, NUM_JOINTS, PARENTS, REST_PELVIS_HEIGHT, canonical_skeleton

FORWARD, LATERAL, HEIGHT, YAW_RATE, LEFT_CONTACT, RIGHT_CONTACT = range(6)
ROOT_ROW = NUM_JOINTS  # index of the root track among the rows
TURNED_OVER = -0.5  # cosine: a pelvis that is tilted by more, 120 degrees, has no heading
# What a mirror does to the first two columns of a matrix: M·R·M, M = diag(-1, 1, 1).
_MIRROR_SIGNS = (1.0, -1.0, -1.0, -1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Place:
    """Where a pelvis is on the ground and where it faces: metres and radians about +Y."""

    x: float = 0.0
    z: float = 0.0
    heading: float = 0.0


ORIGIN = Place()


def headings(matrices: Tensor, spans: Sequence[slice] = (slice(None),)) -> Tensor:
    """Heading [T] in radians of pelvis rotations [T,3,3], without jumps of 2π within each span.

    Who is upside down has none that could be told (the twist about +Y goes half round there from
    one frame to the next): he turns evenly from the one before to the one after.
    """
    angles, upright = heading_angle(matrices).numpy(), matrices[:, 1, 1].numpy() > TURNED_OVER
    whole = [np.empty(0, angles.dtype)]
    for span in spans:
        own, frames = angles[span], np.flatnonzero(upright[span])
        if len(frames) in (0, len(own)):
            whole.append(np.unwrap(own))
        else:
            whole.append(np.interp(np.arange(len(own)), frames, np.unwrap(own[frames])))
    return torch.as_tensor(np.concatenate(whole), dtype=matrices.dtype)


def motion_heading(motion: Motion) -> np.ndarray:
    """Radians [T] that the pelvis faces, unwrapped, float32."""
    pelvis = quaternion_to_matrix(torch.as_tensor(motion.quaternions[:, 0]))
    return np.asarray(headings(pelvis).numpy())


def ahead_and_left(steps: np.ndarray, heading: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
    """Steps [..., 3] over the ground as seen along headings [...] in radians: two parts [...]."""
    x, z, sine, cosine = steps[..., 0], steps[..., 2], np.sin(heading), np.cos(heading)
    return x * sine + z * cosine, x * cosine - z * sine


def heading_frame(joints: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Joints [T,K,3] seen from the pelvis, turned so that the heading [T] is +Z."""
    seen = joints - joints[:, :1]
    ahead, left = ahead_and_left(seen, heading[:, None])
    return np.stack((left, seen[..., 1], ahead), -1)


def hastened(features: Tensor, times: float, frames: int | None = None) -> Tensor:
    """Features [T,23,6] so many times as fast, or in so many frames: between two frames a share of
    both, and it goes as far as they do."""
    if frames is None:
        frames = max(1, round(len(features) / times))
    if not len(features) or (times == 1 and frames == len(features)):
        return features
    values, last = features.cpu().numpy().astype(np.float64), len(features) - 1
    at = np.linspace(0, last, frames)  # it begins and ends as it did
    before = at.astype(int)
    after, share = np.minimum(before + 1, last), (at - before)[:, None, None]
    shown = values[before] + share * (values[after] - values[before])
    if features.shape[1] > ROOT_ROW:
        columns, ends = [FORWARD, LATERAL, YAW_RATE], np.linspace(0, last + 1, frames + 1)
        gone = np.cumsum(values[:, ROOT_ROW, columns], axis=0).T
        way = [np.interp(ends, np.arange(last + 2), [0.0, *each]) for each in gone]
        shown[:, ROOT_ROW, columns] = np.diff(way).T
    return torch.as_tensor(shown).to(features.dtype)


def without_drift(features: Tensor, columns: Sequence[int]) -> Tensor:
    """Features [T,23,6] without the means of these columns of the root row: with YAW_RATE a body
    faces at the end as at first, with FORWARD and LATERAL who does not turn ends where he began."""
    kept = features.clone()
    for column in columns:
        kept[:, ROOT_ROW, column] -= features[:, ROOT_ROW, column].mean()
    return kept


def encode_features(motion: Motion, *others: Motion) -> Tensor:
    """Features [T,23,6] float32 of a motion; where it stands and faces at first is dropped.

    Of several, at one frame rate, one after another.
    """
    motions = (motion, *others)
    ends = np.cumsum([each.num_frames for each in motions])
    spans = [slice(end - each.num_frames, end) for each, end in zip(motions, ends, strict=True)]

    def joined(name: str) -> Tensor:
        return torch.as_tensor(np.concatenate([getattr(each, name) for each in motions]))

    def rate(values: Tensor) -> Tensor:
        return torch.cat([forward_difference(values[span], motion.fps) for span in spans])

    local, position = quaternion_to_matrix(joined("quaternions")), joined("root_position")
    heading = headings(local[:, 0], spans)  # T
    to_heading = yaw_to_matrix(-heading)  # T 3 3
    local = torch.cat(((to_heading @ local[:, 0])[:, None], local[:, 1:]), 1)
    velocity = (to_heading @ rate(position)[..., None]).squeeze(-1)
    ground, height, turning = velocity[:, [2, 0]], position[:, [1]], rate(heading[:, None])
    root = torch.cat((ground, height, turning, joined("contacts")), 1)  # T 6
    return torch.cat((matrix_to_rotation_6d(local), root[:, None]), 1).float()


def integrate_root(root: Tensor, fps: float, place: Place = ORIGIN) -> tuple[Tensor, Tensor]:
    """Root rows [...,T,6] → pelvis path [...,T,3] in metres and heading [...,T] in radians, the
    first frame at `place`."""

    def accumulate(rate: Tensor) -> Tensor:
        total = torch.cumsum(rate / fps, -1)
        return torch.cat((torch.zeros_like(total[..., :1]), total[..., :-1]), -1)

    heading = place.heading + accumulate(root[..., YAW_RATE])
    sine, cosine = torch.sin(heading), torch.cos(heading)
    forward, lateral = root[..., FORWARD], root[..., LATERAL]
    x = place.x + accumulate(forward * sine + lateral * cosine)
    z = place.z + accumulate(forward * cosine - lateral * sine)
    return torch.stack((x, root[..., HEIGHT], z), -1), heading


def to_world(joints: Tensor, root: Tensor, fps: float) -> Tensor:
    """Joints [...,T,J,3] in the heading frame, the pelvis at x = z = 0 → the world, along the path
    of root rows [...,T,6] from the origin on."""
    path, heading = integrate_root(root, fps)  # [..., T, 3], [..., T]
    turned = (yaw_to_matrix(heading)[..., None, :, :] @ joints[..., None]).squeeze(-1)
    x, height, z = torch.moveaxis(path, -1, 0)
    ground = torch.stack((x, torch.zeros_like(height), z), -1)  # joints have their height
    return turned + ground[..., None, :]


@cache
def _rest_offsets(device: "torch.device") -> Tensor:
    """Of the canonical skeleton [K,3], metres; sent to a device once."""
    with torch.inference_mode(False):  # training may reuse what sampling asked for first
        return torch.as_tensor(canonical_skeleton().offsets, device=device)


def heading_joints(rotations: Tensor, height: Tensor) -> Tensor:
    """Joints [...,T,K,3] over the origin of local rotations [...,T,K,3,3] at pelvis heights
    [...,T], metres, in the heading frame."""
    pelvis = torch.stack((torch.zeros_like(height), height, torch.zeros_like(height)), -1)
    positions, _ = forward_kinematics(rotations, pelvis, _rest_offsets(height.device), PARENTS)
    return positions


def world_pose(features: Tensor, fps: float, place: Place = ORIGIN) -> tuple[Tensor, Tensor]:
    """Local rotations [...,T,K,3,3], the pelvis' in the world, and the pelvis path [...,T,3] of raw
    features [...,T,R,6]; without a root track the body stands in place."""
    if features.shape[-2] == NUM_JOINTS:
        root = torch.zeros_like(features[..., 0, :])
        root[..., HEIGHT] = REST_PELVIS_HEIGHT
    else:
        root = features[..., ROOT_ROW, :]
    path, heading = integrate_root(root, fps, place)
    local = rotation_6d_to_matrix(features[..., :NUM_JOINTS, :])
    pelvis = yaw_to_matrix(heading) @ local[..., 0, :, :]
    return torch.cat((pelvis[..., None, :, :], local[..., 1:, :, :]), -3), path


def world_joints(features: Tensor, fps: float) -> Tensor:
    """World joints [...,T,K,3] in metres of features [...,T,R,6]; differentiable."""
    local, path = world_pose(features, fps)
    return forward_kinematics(local, path, _rest_offsets(features.device), PARENTS)[0]


def decode_features(
    features: Tensor,
    *,
    fps: float = 30.0,
    place: Place = ORIGIN,
    text: str = "",
) -> Motion:
    """Raw features [T,23,6], or [T,22,6] without a root track (stands in place) → Motion, its first
    frame at `place`; `text` is its caption."""
    features = features.detach().float().cpu()
    local, path = world_pose(features, fps, place)
    contacts = torch.zeros(len(features), 2)
    if features.shape[1] > ROOT_ROW:
        contacts = features[:, ROOT_ROW, LEFT_CONTACT:].clip(0, 1)
    quaternions = quaternion_continuous(matrix_to_quaternion(local), dim=0)
    return Motion(quaternions.numpy(), path.numpy(), contacts.numpy(), fps=fps, text=text)


def mirror_features(features: Tensor) -> Tensor:
    """Mirror features [...,23,6] or [...,22,6] directly: a permutation and signs."""
    rotations = features[..., list(MIRROR), :] * features.new_tensor(_MIRROR_SIGNS)
    if features.shape[-2] == NUM_JOINTS:
        return rotations
    order = list(range(6))
    order[LEFT_CONTACT], order[RIGHT_CONTACT] = RIGHT_CONTACT, LEFT_CONTACT
    signs = torch.ones_like(features[..., 0, :])
    signs[..., [LATERAL, YAW_RATE]] = -1
    root = features[..., NUM_JOINTS, order] * signs
    return torch.cat((rotations, root[..., None, :]), -2)
