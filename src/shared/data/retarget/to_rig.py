"""Our motions onto a user's own skeleton: the way of `retarget`, backwards.

Each mapped joint gets the world rotation that `retarget` would read as ours; a joint without a
counterpart keeps its rest pose against its parent. Lengths are scaled by the legs, so feet stand
still on the target as they do on ours. T frames, N target joints.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...errors import UsageError, UserError
from ...formats.blender import as_glb, through_glb
from ...formats.readers.bvh import BvhClip, read_bvh
from ...formats.readers.glb import GlbSkeleton, read_glb_skeleton
from ...formats.registry import check_motion, write_clip
from ...formats.rig import Rig, RigClip, canonical_rig, motion_clip, rescaled, turned
from ...formats.writers.bvh import CENTIMETRE
from ...formats.writers.glb import write_glb_character
from ...io.files import same_place
from ...motion.motion import Motion
from ...motion.skeleton import JOINT_INDEX, LEG_LENGTH, NUM_JOINTS, REST_FOOT_HEIGHT
from .autodetection import UNITS, detect_unit, detect_up, joint_indices, rest_frame, upright
from .mapping import SkeletonMapping, load_mappings, mapping_of
from .to_canonical import leg_length, line_between, rest_corrections

HIPS = (JOINT_INDEX["l_hip"], JOINT_INDEX["r_hip"])
STANDING = 0.3  # of the legs: feet of a rest pose that are no higher than this stand on the floor


def retarget_out(
    motion: Motion,
    rig: Rig,
    mapping: SkeletonMapping,
    *,
    up: str = "Y",
    corrections: dict[str, np.ndarray] | None = None,
) -> RigClip:
    """A motion as the movement of another skeleton, on the floor, at the motion's rate.

    Args:
        rig: the skeleton, in its own unit.
        mapping: which of its joints play ours; all of them are there.
        up: the up axis of the rig's world: "Y", "Z", "-X", …
        corrections: of `rest_corrections`; by default what the rest pose tells, which is nothing
            where all its bones lie along one axis.

    Raises:
        UserError: the rig's legs have no length.
    """
    rest = rest_clip(rig)
    legs = leg_length(rest, mapping)
    if not legs > 1e-6:
        raise UserError("the skeleton's legs have no length: check the mapping of hips, knees "
                        "and ankles")  # fmt: skip
    scale = legs / LEG_LENGTH
    turn = upright(up)  # the rig's world → ours
    places, ours = motion_clip(motion).world()
    known = corrections or rest_corrections(rest, mapping)
    index = joint_indices(rest, mapping)
    players = {index[name]: (JOINT_INDEX[name], known[name]) for name in index}
    clip = replace(_turned(rest, players, ours, turn), fps=motion.fps, text=motion.text)
    t_pose = _turned(rest, players, np.tile(np.eye(3), (1, NUM_JOINTS, 1, 1)), turn)
    hips = places[:, list(HIPS)].mean(1) * scale
    hips[:, 1] += _lift(rest, t_pose, mapping, turn, scale)
    return _placed(clip, index, hips @ turn)


def _turned(
    rest: RigClip, players: dict[int, tuple[int, np.ndarray]], ours: np.ndarray, turn: np.ndarray
) -> RigClip:
    """The rig with the world rotations [T,22,3,3] of our joints, its root at rest.

    `players` says of each mapped joint which of ours it plays, and its correction.
    """
    world = np.empty((len(ours), len(rest.names), 3, 3))
    local = np.empty_like(world)
    for joint, parent in enumerate(rest.parents):
        above = world[:, parent] if parent >= 0 else np.broadcast_to(np.eye(3), world[:, 0].shape)
        world[:, joint], local[:, joint] = above, np.eye(3)
        if joint in players:
            played, correction = players[joint]
            world[:, joint] = turn.T @ ours[:, played] @ correction.T
            local[:, joint] = above.swapaxes(-1, -2) @ world[:, joint]
    return RigClip(rest.rig, local, np.repeat(rest.translations, len(ours), 0), rest.fps)


def rest_clip(rig: Rig) -> RigClip:
    """One frame of the rest pose."""
    turns = np.tile(np.eye(3), (1, len(rig.names), 1, 1))
    return RigClip(rig, turns, rig.offsets[None].astype(np.float64), 30.0)


def _placed(clip: RigClip, index: dict[str, int], hips: np.ndarray) -> RigClip:
    """Move the pelvis so that the middle of the hips is at `hips` [T,3], in the rig's world."""
    positions, world = clip.world()
    step = hips - positions[:, [index["l_hip"], index["r_hip"]]].mean(1)
    pelvis, hips_of = index["pelvis"], (index["l_hip"], index["r_hip"])
    below = (hip == pelvis or line_between(clip, pelvis, hip) for hip in hips_of)
    mover = pelvis if all(below) else 0  # the pelvis, if both hips hang from it
    parent = clip.parents[mover]
    if parent >= 0:
        step = (world[:, parent].swapaxes(-1, -2) @ step[..., None])[..., 0]
    translations = clip.translations.copy()
    translations[:, mover] += step
    return replace(clip, translations=translations)


def _lift(
    rest: RigClip, t_pose: RigClip, mapping: SkeletonMapping, turn: np.ndarray, scale: float
) -> float:
    """How much higher the hips must be than ours, scaled, for the feet to stand on the floor.

    The balls of the feet shall be as high in our T-pose as in a rest pose that stands on the
    floor; where the rest pose does not, as ours are, scaled.
    """
    index = joint_indices(rest, mapping)
    balls = [index[name] for name in ("l_foot", "r_foot") if name in index]
    if not balls:
        return 0.0
    heights = (t_pose.world()[0] @ turn.T)[0, :, 1]
    below = heights[[index["l_hip"], index["r_hip"]]].mean() - heights[balls].mean()
    floor = REST_FOOT_HEIGHT * scale
    if rest_frame(rest, mapping) is not None:
        ball = (rest.rig.rest() @ turn.T)[balls, 1].mean()
        floor = ball if 0.0 <= ball < STANDING * scale * LEG_LENGTH else floor
    return float(floor + below - canonical_rig().rest()[list(HIPS), 1].mean() * scale)


@dataclass(frozen=True, eq=False)
class Target:
    """A user's skeleton, ready to be moved.

    Attributes:
        path: the file it came from.
        rig: the skeleton, in its file's unit.
        mapping: the profile that fits it.
        corrections: between its axes and ours, of `rest_corrections`.
        up: its up axis.
        character: of a GLB, whose mesh then moves as well.
    """

    path: Path
    rig: Rig
    mapping: SkeletonMapping
    corrections: dict[str, np.ndarray]
    up: str = "Y"
    character: GlbSkeleton | None = None

    def clip(self, motion: Motion) -> RigClip:
        """The motion on this skeleton."""
        return retarget_out(
            motion, self.rig, self.mapping, up=self.up, corrections=self.corrections
        )

    def check_avatar(self) -> None:
        """Raise UsageError where the file is no VRM avatar; a `.vrm` is written of those alone."""
        if self.character is None or not self.character.is_avatar:
            raise UsageError(
                f"{self.path} is no VRM avatar, and a .vrm is written of avatars alone; give the"
                " avatar's own .vrm as skeleton, or write a .glb"
            )

    def write(self, motion: Motion, path: Path) -> Path:
        """Write the motion on this skeleton in the format that `path` ends with.

        As GLB and FBX a character is written with its own mesh, as VRM an avatar with all that its
        file holds; all else with the skeleton alone.

        Raises:
            UsageError: no format that holds any skeleton ends so, it is the skeleton's own file, or
                a `.vrm` of what is no avatar.
            UserError: the file cannot be written.
        """
        check_motion(motion, path)
        if same_place(path, self.path):
            raise UsageError(f"{path} is the skeleton's own file; name another OUT")
        ending = path.suffix.lower()
        if ending == ".vrm":
            self.check_avatar()
        if (character := self.character) is not None and ending in (".glb", ".vrm", ".fbx"):
            clip = self.clip(motion)
            if ending != ".fbx":
                return write_glb_character(character, clip, path)
            return through_glb(lambda to: write_glb_character(character, clip, to), path, clip.fps)
        clip = self.clip(motion)
        if ending != ".bvh":  # all others are +Y up
            clip = turned(clip, upright(self.up))
        elif self.path.suffix.lower() != ".bvh":  # one in metres; who has a BVH has chosen a unit
            clip = rescaled(clip, CENTIMETRE)
        return write_clip(clip, path)


def read_target(path: str | Path, *, mapping: Path | None = None) -> Target:
    """A skeleton to move, from a BVH, GLB, VRM or FBX file.

    Its own motion only tells which way is up and, where the rest pose does not, its axes.

    Args:
        mapping: YAML with skeleton profiles that go before ours.

    Raises:
        UserError: missing, damaged, with several roots, or with joints that no profile maps.
    """
    path, profiles = Path(path), load_mappings(mapping)
    if path.suffix.lower() == ".fbx":
        with as_glb(path) as glb:
            return replace(read_target(glb, mapping=mapping), path=path)
    if path.suffix.lower() in (".glb", ".vrm"):
        character = read_glb_skeleton(path)
        rig = character.rig
        rest = rest_clip(rig)
        profile = mapping_of(path, rest, profiles)
        known = rest_corrections(rest, profile)
        return Target(path, rig, profile, known, character=character)
    clip = read_bvh(path)
    profile = mapping_of(path, clip, profiles)
    metres = UNITS[detect_unit(leg_length(clip, profile))]
    known = rest_corrections(clip, profile)
    return Target(path, _bvh_rig(path, clip, metres), profile, known, detect_up(clip, profile)[0])


def _bvh_rig(path: Path, clip: BvhClip, metres: float) -> Rig:
    """The skeleton of a BVH file, in its own unit of so many metres."""
    roots = [name for name, parent in zip(clip.names, clip.parents, strict=True) if parent < 0]
    if len(roots) > 1:
        raise UserError(
            f"{path}: has the roots {', '.join(roots)}; a character has one; export one character"
        )
    orders = tuple(o if sorted(o) == ["X", "Y", "Z"] else "ZXY" for o in clip.rotation_orders)
    frames = np.tile(np.eye(3), (len(clip.names), 1, 1))
    return Rig(clip.names, clip.parents, clip.offsets, clip.end_sites, frames, orders, metres)
