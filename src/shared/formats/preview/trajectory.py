"""What previews of a trajectory show beside it: beats, a colour for each place in the bar, a body.

Beats are the song's where they are known, else those of the trajectory's bar phase. A trajectory
tells of the pelvis alone; so that its height and turning can be seen, a proxy body is posed by one
rule: arms hang, trunk and head go with the pelvis, the legs stay upright and bend until the feet
reach the floor. Legend: T frames."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...motion.motion import Motion
from ...motion.rotations import quaternion_exp, quaternion_multiply, quaternion_to_matrix
from ...motion.skeleton import JOINT_INDEX, LEG_LENGTH, canonical_skeleton
from ...motion.trajectory import MotionTrajectory, to_motion
from ...tensors import torch

PATH = (200, 60, 90)  # colour of the way over the ground


@dataclass(frozen=True, eq=False)
class SongTrack:
    """What files about a trajectory say of its song.

    Attributes:
        path: the sound file, for the page that plays it.
        beat_times: [N] seconds, none where the song has no beat; None = take the beats from the
            trajectory's bar phase.
        downbeat_times: [M] seconds, some of the beats.
        meter: beats in a bar.
    """

    path: Path | None = None
    beat_times: np.ndarray | None = None
    downbeat_times: np.ndarray | None = None
    meter: int = 4

    @property
    def beatless(self) -> bool:
        """Is it known that the song has no beat?"""
        return self.beat_times is not None and not len(self.beat_times)


@dataclass(frozen=True, eq=False)
class BeatMarks:
    """Beats within a trajectory: times [N] in seconds, which are downbeats [N], beats in a bar."""

    times: np.ndarray
    downbeat: np.ndarray
    meter: int


def beat_marks(trajectory: MotionTrajectory, song: SongTrack) -> BeatMarks:
    """The beats that fall into a trajectory; none where there is no music."""
    if song.beat_times is None:
        return _marks_of_phase(trajectory, song.meter)
    end = (trajectory.num_frames - 1) / trajectory.fps
    times = np.asarray(song.beat_times, dtype=np.float64)
    times = times[(times >= 0) & (times <= end)]
    strong = np.asarray([] if song.downbeat_times is None else song.downbeat_times)
    near = np.abs(times[:, None] - strong).min(1) if len(strong) else np.full(len(times), np.inf)
    return BeatMarks(times, near < 0.02, song.meter)


def _marks_of_phase(trajectory: MotionTrajectory, meter: int) -> BeatMarks:
    """Where the unwrapped phase reaches whole beats, linear between frames."""
    beats = np.maximum.accumulate(trajectory.phase_unwrapped * meter)
    whole = np.arange(np.ceil(beats[0] - 1e-6), np.floor(beats[-1] + 1e-6) + 1)
    if beats[-1] - beats[0] < 1e-3:
        whole = whole[:0]
    rising = np.concatenate(([True], np.diff(beats) > 0))  # interpolation needs distinct places
    times = np.interp(whole, beats[rising], np.flatnonzero(rising) / trajectory.fps)
    return BeatMarks(times, whole % meter == 0, meter)


def phase_palette(steps: int = 60) -> np.ndarray:
    """RGB of places in the bar [steps,3] uint8, red at the downbeat, all equally light.

    A circle in OKLCH (Björn Ottosson 2020, "A perceptual color space for image processing"),
    so that no beat looks stronger than another and the end meets the beginning.
    """
    hue = 2 * np.pi * np.arange(steps) / steps + np.deg2rad(20.0)
    lightness, chroma = 0.70, 0.115
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    red = 4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short
    green = -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short
    blue = -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short
    linear = np.clip(np.stack((red, green, blue), -1), 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * encoded), np.uint8)


ANKLE_HEIGHT = 0.08  # metres, in the rest pose
MIN_REACH = 0.3  # share of the leg's length that a folded leg keeps
MAX_LEAN = np.deg2rad(60.0)  # legs are kept upright against so much leaning, no more
ARMS = {  # rotation vectors from the T-pose, left side; the right one is mirrored
    "shoulder": np.deg2rad([0.0, 0.0, -72.0]),
    "elbow": np.deg2rad([0.0, -22.0, 0.0]),
}


def proxy_body(trajectory: MotionTrajectory, title: str = "") -> Motion:
    """The mannequin's motion: joint 0 is the trajectory's position and quaternion.

    Contacts are zero: a trajectory has no feet.
    """
    motion = to_motion(trajectory, text=title)
    quaternions = motion.quaternions.copy()
    for name, turn in ARMS.items():
        for side, sign in (("l", 1.0), ("r", -1.0)):
            quaternions[:, JOINT_INDEX[f"{side}_{name}"]] = _turn(sign * turn)
    pelvis = torch.as_tensor(quaternions[:, 0].astype(np.float64))
    world = quaternion_to_matrix(pelvis).numpy()
    upright = _upright(world)
    for side in ("l", "r"):
        hip, knee, ankle = (JOINT_INDEX[f"{side}_{part}"] for part in ("hip", "knee", "ankle"))
        height = trajectory.position[:, 1] + (world @ canonical_skeleton().offsets[hip])[:, 1]
        bend = np.arccos(np.clip((height - ANKLE_HEIGHT) / LEG_LENGTH, MIN_REACH, 1.0))
        pitch = bend[:, None] * np.array([1.0, 0.0, 0.0])
        quaternions[:, hip] = quaternion_multiply(
            torch.as_tensor(upright), torch.as_tensor(_turn(-pitch))
        )
        quaternions[:, knee], quaternions[:, ankle] = _turn(2 * pitch), _turn(-pitch)
    return replace(motion, quaternions=quaternions)


def _upright(pelvis: np.ndarray) -> np.ndarray:
    """Quaternions [T,4] in the frame of the pelvis [T,3,3] that take its lean back, up to
    `MAX_LEAN`."""
    up = pelvis[:, 1]  # the world's, in the pelvis' frame
    axis = np.stack((up[:, 2], np.zeros(len(up)), -up[:, 0]), -1)  # +Y × up
    sine = np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = np.arctan2(sine, up[:, 1:2])
    return _turn(axis / np.maximum(sine, 1e-9) * np.minimum(angle, MAX_LEAN))


def _turn(vector: np.ndarray) -> np.ndarray:
    """Quaternions [...,4] of rotation vectors [...,3]."""
    return np.asarray(quaternion_exp(torch.as_tensor(vector)).numpy())
