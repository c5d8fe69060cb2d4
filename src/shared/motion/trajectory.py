"""The 25-d trajectory: where the pelvis is, how it turns, where in the bar, in which style.

TECH §2.1, with the pelvis in metres (ruling 8), forward differences (ruling 6), quaternion signs
of ruling 10 and the bar phase modulo 1 (ruling 9). NumPy in and out, derived on the
CPU in float64: accelerations multiply a position's rounding by 900.

Letters: T frames, 25 columns, see the slices.
"""

from dataclasses import dataclass

import numpy as np
import torch

from .features import FORWARD, HEIGHT, LATERAL, YAW_RATE
from .kinematics import derive, forward_difference
from .motion import Motion
from .rotations import heading_of, quaternion_continuous, turn_about_y
from .skeleton import NUM_JOINTS

CHANNELS = 25
FPS = 30.0
POSITION = slice(0, 3)  # pelvis, metres
VELOCITY = slice(3, 6)  # m/s
ACCELERATION = slice(6, 9)  # m/s²
QUATERNION = slice(9, 13)  # w x y z, unit
ANGULAR_VELOCITY = slice(13, 16)  # world frame, rad/s
PHASE = 16  # of the bar, in [0, 1)
STYLE = slice(17, 25)  # unit vector
NEUTRAL_STYLE = np.full(8, 8**-0.5, dtype=np.float32)  # halfway in all four pairs, see style.py


@dataclass(frozen=True, eq=False)
class MotionTrajectory:
    """A trajectory and its frame rate.

    Attributes:
        data: [T,25] float32, the columns of this module's slices.
        fps: frames per second.

    Raises:
        ValueError: `data` is not [T,25].
    """

    data: np.ndarray
    fps: float = FPS

    def __post_init__(self) -> None:
        if self.data.ndim != 2 or self.data.shape[1] != CHANNELS:
            raise ValueError(f"a trajectory is [T,{CHANNELS}], not {list(self.data.shape)}")

    @classmethod
    def from_pose(
        cls,
        position: np.ndarray,
        quaternion: np.ndarray,
        phase_unwrapped: np.ndarray,
        style: np.ndarray = NEUTRAL_STYLE,
        *,
        fps: float = FPS,
        spare: int = 0,
    ) -> "MotionTrajectory":
        """Derive the rest from a path.

        Args:
            position: pelvis [T,3], metres.
            quaternion: unit, w x y z [T,4]; signs are mended (ruling 10).
            phase_unwrapped: [T] bars, not modulo 1.
            style: [8] or [T,8], unit.
            fps: frames per second.
            spare: frames at the end that only help to derive and are cut off; 2 keep the last
                acceleration from being zero (ruling 6).
        """
        path = torch.as_tensor(position, dtype=torch.float64)
        signed = quaternion_continuous(torch.as_tensor(quaternion, dtype=torch.float64), dim=-2)
        velocity, acceleration, turning = derive(path, signed, fps)
        num_frames = len(path)
        pose = torch.cat((path, velocity, acceleration, signed, turning), 1)  # T 16
        data = np.empty((num_frames, CHANNELS), dtype=np.float32)
        data[:, :PHASE] = pose.numpy()
        data[:, PHASE] = wrap_phase(phase_unwrapped)
        data[:, STYLE] = style
        return cls(data[: num_frames - spare], fps)

    @property
    def num_frames(self) -> int:
        return len(self.data)

    @property
    def seconds(self) -> float:
        return self.num_frames / self.fps

    @property
    def position(self) -> np.ndarray:
        """Pelvis [T,3], metres."""
        return self.data[:, POSITION]

    @property
    def velocity(self) -> np.ndarray:
        """[T,3] m/s."""
        return self.data[:, VELOCITY]

    @property
    def acceleration(self) -> np.ndarray:
        """[T,3] m/s²."""
        return self.data[:, ACCELERATION]

    @property
    def quaternion(self) -> np.ndarray:
        """[T,4], w x y z."""
        return self.data[:, QUATERNION]

    @property
    def angular_velocity(self) -> np.ndarray:
        """[T,3] rad/s, world frame."""
        return self.data[:, ANGULAR_VELOCITY]

    @property
    def phase(self) -> np.ndarray:
        """[T] of the bar, in [0, 1)."""
        return self.data[:, PHASE]

    @property
    def phase_unwrapped(self) -> np.ndarray:
        """[T] bars, float64, growing on."""
        return unwrap_phase(self.phase)

    @property
    def style(self) -> np.ndarray:
        """[T,8], unit."""
        return self.data[:, STYLE]

    @property
    def heading(self) -> np.ndarray:
        """[T] radians about +Y, unwrapped, float64."""
        angles = heading_of(torch.as_tensor(self.quaternion, dtype=torch.float64))
        return np.unwrap(angles.numpy())


def from_motion(
    motion: Motion, phase: np.ndarray | None = None, style: np.ndarray | None = None
) -> MotionTrajectory:
    """The trajectory of a body's pelvis.

    Args:
        motion: T frames.
        phase: unwrapped bars [T]; None = no music, zeros.
        style: [8] or [T,8], unit; None = neutral. `style.measure_style` measures it.
    """
    return MotionTrajectory.from_pose(
        motion.root_position,
        motion.quaternions[:, 0],
        np.zeros(motion.num_frames) if phase is None else phase,
        NEUTRAL_STYLE if style is None else style,
        fps=motion.fps,
    )


def to_root(trajectory: MotionTrajectory) -> torch.Tensor:
    """Rows [T,6] float32 of the text branch's root track (ruling 19) that this path pins.

    Forward and lateral velocity, pelvis height and yaw rate; the contacts are left at zero, as
    the pelvis does not tell them. The path's first position and heading are dropped.
    """
    heading = torch.as_tensor(trajectory.heading)  # T
    position = torch.as_tensor(trajectory.position, dtype=torch.float64)
    velocity = turn_about_y(forward_difference(position, trajectory.fps), -heading)
    rows = torch.zeros(trajectory.num_frames, 6)
    rows[:, FORWARD], rows[:, LATERAL] = velocity[:, 2].float(), velocity[:, 0].float()
    rows[:, HEIGHT] = position[:, 1].float()
    rows[:, YAW_RATE] = forward_difference(heading[:, None], trajectory.fps)[:, 0].float()
    return rows


def to_motion(trajectory: MotionTrajectory, *, text: str = "") -> Motion:
    """A body in rest pose carried along the path, for previews of a trajectory alone."""
    quaternions = np.zeros((trajectory.num_frames, NUM_JOINTS, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    quaternions[:, 0] = trajectory.quaternion
    return Motion(
        quaternions=quaternions,
        root_position=trajectory.position.astype(np.float32),
        contacts=np.zeros((trajectory.num_frames, 2), dtype=np.float32),
        fps=trajectory.fps,
        text=text,
    )


def unwrap_phase(phase: np.ndarray) -> np.ndarray:
    """Phase modulo 1 [...,T] → bars that grow on without a jump, float64 [...,T] (ruling 9).

    Right as long as the phase moves by less than half a bar a frame, 900 bars a minute.
    """
    return np.unwrap(np.asarray(phase, dtype=np.float64), period=1.0, axis=-1)


def wrap_phase(unwrapped: np.ndarray) -> np.ndarray:
    """Bars [...,T] → phase in [0, 1) as float32; 0 is the downbeat."""
    wrapped = np.mod(np.asarray(unwrapped, dtype=np.float64), 1.0).astype(np.float32)
    return np.where(wrapped >= 1, np.float32(0), wrapped)  # 0.99999999 rounds up in float32
