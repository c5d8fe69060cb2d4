"""Our motions onto a user's own skeleton: the way of `retarget`, backwards.

Each mapped joint gets the world rotation that `retarget` would read as ours; a joint without a
counterpart keeps its rest pose against its parent. Lengths are scaled by the legs, so feet stand
still on the target as they do on ours. T frames, N target joints.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from src.shared.data.guesses import guess_up, joint_indices, upright
from src.shared.data.mapping import SkeletonMapping, find_mapping, load_mappings
from src.shared.data.retarget import leg_length, rest_corrections
from src.shared.errors import UserError
from src.shared.formats.bvh import read_bvh
from src.shared.formats.glb_character import write_glb_character
from src.shared.formats.glb_reader import GlbSkeleton, read_glb_skeleton
from src.shared.formats.registry import check_motion, write_clip
from src.shared.formats.rig import Rig, RigClip, canonical_rig
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import (
    FOOT_JOINTS,
    JOINT_INDEX,
    JOINT_NAMES,
    LEG_LENGTH,
    REST_FOOT_HEIGHT,
)

STANDING = 0.3  # of the legs: feet of a rest pose that are no higher than this stand on the floor


def retarget_out(
    motion: Motion, rig: Rig, mapping: SkeletonMapping, *, up: str | None = None
) -> RigClip:
    """A motion as the movement of another skeleton, on the floor, at the motion's rate.

    Args:
        motion: what to carry over.
        rig: the skeleton, in its own unit.
        mapping: which of its joints play ours; all of them are there.
        up: the rig's up axis, "Y" or "Z"; None guesses it from the rest pose.

    Raises:
        UserError: the rig's legs have no length.
    """
    rest = rest_clip(rig)
    legs = leg_length(rest, mapping)
    if not legs > 1e-6:
        raise UserError("the skeleton's legs have no length: check the mapping of hips, knees "
                        "and ankles")  # fmt: skip
    scale = legs / LEG_LENGTH
    turn = upright(up or guess_up(rest, mapping)[0])  # the rig's world → ours
    corrections = rest_corrections(rest, mapping)
    index = joint_indices(rest, mapping)
    players = {index[ours]: ours for ours in sorted(mapping.joints, key=JOINT_NAMES.index)}
    ours_world = motion.global_rotations().astype(np.float64)

    world = np.empty((motion.num_frames, len(rig.names), 3, 3))
    local = np.empty_like(world)
    for joint, parent in enumerate(rig.parents):
        above = world[:, parent] if parent >= 0 else np.broadcast_to(np.eye(3), world[:, 0].shape)
        if joint in players:
            ours = players[joint]
            world[:, joint] = turn.T @ ours_world[:, JOINT_INDEX[ours]] @ corrections[ours].T
        else:
            world[:, joint] = above
        local[:, joint] = above.swapaxes(-1, -2) @ world[:, joint]
    translations = np.repeat(rig.offsets[None].astype(np.float64), motion.num_frames, 0)
    clip = RigClip(rig, local, translations, motion.fps, motion.text)
    return _placed(clip, motion, index, turn, scale)


def rest_clip(rig: Rig) -> RigClip:
    """One frame of the rest pose."""
    turns = np.tile(np.eye(3), (1, len(rig.names), 1, 1))
    return RigClip(rig, turns, rig.offsets[None].astype(np.float64), 30.0)


def _placed(
    clip: RigClip, motion: Motion, index: dict[str, int], turn: np.ndarray, scale: float
) -> RigClip:
    """Move the pelvis so that the middle of the hips goes where ours does, times `scale`."""
    hips = [JOINT_INDEX["l_hip"], JOINT_INDEX["r_hip"]]
    wanted = motion.positions()[:, hips].mean(1).astype(np.float64) * scale
    wanted[:, 1] += _lift(clip.rig, index, turn, scale)
    positions, world = clip.world()
    found = positions[:, [index["l_hip"], index["r_hip"]]].mean(1)
    step = wanted @ turn - found  # in the rig's world
    mover = index["pelvis"] if _carries_hips(clip.rig, index) else 0
    parent = clip.parents[mover]
    if parent >= 0:
        step = (world[:, parent].swapaxes(-1, -2) @ step[..., None])[..., 0]
    translations = clip.translations.copy()
    translations[:, mover] += step
    return replace(clip, translations=translations)


def _lift(rig: Rig, index: dict[str, int], turn: np.ndarray, scale: float) -> float:
    """How far the rig's feet must go up, for the balls to stand as high as they do at rest.

    A rest pose whose feet are on the floor says how high that is; of others it is our own
    height, scaled.
    """
    rest = rig.rest() @ turn.T  # +Y up
    balls = [name for name in ("l_foot", "r_foot") if name in index]
    if len(balls) < 2:
        return 0.0
    height = float(np.mean([rest[index[name], 1] for name in balls]))
    hips = float(np.mean([rest[index[f"{side}_hip"], 1] for side in "lr"]))
    ours = _rest_hips_above_ball()
    standing = 0.0 <= height < STANDING * scale * LEG_LENGTH
    floor = height if standing else REST_FOOT_HEIGHT * scale
    # In our rest pose the hips are at (ball + `ours`) · scale; the rig's ball is hips - height
    # below them.
    return floor + (hips - height) - (REST_FOOT_HEIGHT + ours) * scale


def _rest_hips_above_ball() -> float:
    """Metres from the ball of the foot up to the hip in our rest pose."""
    rest = canonical_rig().rest()
    return float(rest[JOINT_INDEX["l_hip"], 1] - rest[FOOT_JOINTS[0][1], 1])


def _carries_hips(rig: Rig, index: dict[str, int]) -> bool:
    """Whether both hips hang from the joint that is mapped as the pelvis."""
    for side in "lr":
        joint = index[f"{side}_hip"]
        while joint >= 0 and joint != index["pelvis"]:
            joint = rig.parents[joint]
        if joint < 0:
            return False
    return True


@dataclass(frozen=True, eq=False)
class Target:
    """A user's skeleton, ready to be moved.

    Attributes:
        path: the file it came from.
        rig: the skeleton, in its file's unit.
        mapping: the profile that fits it.
        character: of a GLB, whose mesh then moves as well.
    """

    path: Path
    rig: Rig
    mapping: SkeletonMapping
    character: GlbSkeleton | None = None

    def clip(self, motion: Motion) -> RigClip:
        """The motion on this skeleton."""
        return retarget_out(motion, self.rig, self.mapping, up="Y" if self.character else None)

    def write(self, motion: Motion, path: Path) -> Path:
        """Write the motion on this skeleton in the format that `path` ends with.

        A GLB character is written with its own mesh; all else with the skeleton alone.

        Raises:
            UsageError: no format that holds any skeleton ends like this.
            UserError: the file cannot be written, or is the skeleton's own.
        """
        check_motion(motion, path)
        if path.resolve() == self.path.resolve():
            raise UserError(f"{path} is the skeleton's own file; name another OUT")
        if self.character is not None and path.suffix.lower() == ".glb":
            return write_glb_character(self.character, self.clip(motion), path)
        return write_clip(self.clip(motion), path)


def read_target(path: str | Path, *, mapping: Path | None = None) -> Target:
    """A skeleton to move, from a BVH or GLB file; its own motion is left aside.

    Args:
        path: the file.
        mapping: YAML with skeleton profiles that go before ours.

    Raises:
        UserError: missing, damaged, or with joints that no profile maps.
    """
    path = Path(path)
    character = read_glb_skeleton(path) if path.suffix.lower() == ".glb" else None
    rig = character.rig if character else bvh_rig(path)
    try:
        profile = find_mapping(rig.names, load_mappings(mapping))
    except UserError as error:
        raise UserError(f"{path}: {error}") from None
    return Target(path, rig, profile, character)


def bvh_rig(path: Path) -> Rig:
    """The skeleton of a BVH file, in its own unit.

    Raises:
        UserError: missing, damaged or with several roots.
    """
    clip = read_bvh(path)
    roots = [name for name, parent in zip(clip.names, clip.parents, strict=True) if parent < 0]
    if len(roots) > 1:
        raise UserError(f"{path}: has the roots {', '.join(roots)}; a character has one")
    orders = tuple(o if sorted(o) == ["X", "Y", "Z"] else "ZXY" for o in clip.rotation_orders)
    frames = np.tile(np.eye(3), (len(clip.names), 1, 1))
    return Rig(clip.names, clip.parents, clip.offsets, clip.end_sites, frames, orders)
