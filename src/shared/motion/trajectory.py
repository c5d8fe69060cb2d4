"""The 25-d trajectory: where the pelvis is, how it turns, where in the bar, in which style.

TECH §2.1, with the pelvis in metres (ruling 8), forward differences (ruling 6), quaternion signs
of ruling 10 and the bar phase modulo 1 (ruling 9). NumPy in and out, computed on the
CPU in float64: accelerations multiply a position's rounding by 900.

The audio UNet sees local windows of it. A window starts at x = z = 0 and its first frame faces +Z
(ruling 8); heights stay. Row 16 holds the phase increment, bars a frame (ruling 9). Windows that
follow each other share `overlap` frames: the second is turned and moved until the shared frames
fit, then both are blended.

Letters: N windows, 25 columns, of a window rows, see the slices; T frames, S shared frames.
"""

from dataclasses import dataclass

import numpy as np

from ..tensors import F, Tensor, torch
from .features import FORWARD, HEIGHT, LATERAL, YAW_RATE
from .motion import Motion
from .rotations import (
    derive,
    forward_difference,
    heading_of,
    quaternion_continuous,
    quaternion_multiply,
    quaternion_slerp,
    turn_about_y,
    yaw_quaternion,
)
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


class _Columns:
    """Columns of a trajectory by their name."""

    def __init__(self, columns: slice | int) -> None:
        self.columns = columns

    def __get__(self, trajectory: "MotionTrajectory", _: type) -> np.ndarray:
        return trajectory.data[:, self.columns]


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

    position = _Columns(POSITION)  # pelvis [T,3], metres
    velocity = _Columns(VELOCITY)  # [T,3] m/s
    acceleration = _Columns(ACCELERATION)  # [T,3] m/s²
    quaternion = _Columns(QUATERNION)  # [T,4], w x y z
    angular_velocity = _Columns(ANGULAR_VELOCITY)  # [T,3] rad/s, world frame
    phase = _Columns(PHASE)  # [T] of the bar, in [0, 1)
    style = _Columns(STYLE)  # [T,8], unit

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
    def phase_unwrapped(self) -> np.ndarray:
        """[T] bars, float64, growing on."""
        return unwrap_phase(self.phase)

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


# ---------------------------------------------------------------- windows

PHASE_STEP = PHASE  # row 16 of a window: bars a frame


def encode_window(trajectory: np.ndarray, phase_unwrapped: np.ndarray) -> np.ndarray:
    """A piece of a trajectory [T,25] → its window [25,T] float32.

    Velocities, accelerations and turns are taken over as they are, so cut windows out of a whole
    trajectory rather than deriving each anew.
    """
    data = torch.as_tensor(trajectory, dtype=torch.float64)
    heading = float(heading_of(data[0, QUATERNION]))
    local = _move(data, -heading, -turn_about_y(data[0, POSITION], -heading))
    local[:, QUATERNION] = quaternion_continuous(local[:, QUATERNION], dim=-2)
    phase = np.asarray(phase_unwrapped, dtype=np.float64)
    steps = np.diff(phase, append=phase[-1:])
    if len(steps) > 1:
        steps[-1] = steps[-2]
    local[:, PHASE_STEP] = torch.as_tensor(steps)
    return local.T.numpy().astype(np.float32)


def place_window(
    window: np.ndarray,
    *,
    position: tuple[float, float] = (0.0, 0.0),
    heading: float = 0.0,
    phase: float = 0.0,
) -> np.ndarray:
    """A window [25,T] → its trajectory [T,25] float32; the inverse of `encode_window`.

    Args:
        window: rows as `encode_window` makes them.
        position: x and z of the first frame, metres.
        heading: of the first frame, radians about +Y.
        phase: of the first frame, bars.
    """
    data = torch.as_tensor(window, dtype=torch.float64).T
    placed = _move(
        data, heading, torch.tensor((position[0], 0.0, position[1]), dtype=torch.float64)
    ).numpy()
    placed[:, PHASE] = wrap_phase(_integrate(placed[:, PHASE_STEP], phase))
    placed[:, QUATERNION] = quaternion_continuous(
        torch.as_tensor(placed[:, QUATERNION]), dim=-2
    ).numpy()
    return np.asarray(placed.astype(np.float32))


class WindowJoiner:
    """Joins windows as they come; what was returned is final, memory is one window.

    The concatenated results of every `add` and of `finish` are one trajectory, derived anew, that
    starts at x = z = 0 and faces +Z.

    Args:
        overlap: S ≥ 1 frames that neighbours share; each window is longer.
        phase: of the first frame, bars.
    """

    def __init__(self, overlap: int, *, phase: float = 0.0) -> None:
        assert overlap >= 1
        self.overlap = overlap
        self._phase = phase  # bars at the first pending frame
        self._last_sign: np.ndarray | None = None  # quaternion of the last frame returned
        self._pending: Tensor | None = None  # [T,25], of which velocities and turns are not used

    def add(self, window: np.ndarray) -> MotionTrajectory:
        """Take the next window [25,T]; return the frames that it settled."""
        data = torch.as_tensor(window, dtype=torch.float64).T
        assert len(data) > self.overlap
        if self._pending is None:
            self._pending = _move(data, 0.0, torch.zeros(3, dtype=torch.float64))
        else:
            before, shared = self._pending[: -self.overlap], self._pending[-self.overlap :]
            data = _move(data, *_fit(data[: self.overlap], shared))
            blended = _blend(shared, data[: self.overlap])
            self._pending = torch.cat((before, blended, data[self.overlap :]))
        return self._release(len(self._pending) - self.overlap - 2, spare=2)

    def finish(self, *, spare: int = 0) -> MotionTrajectory:
        """Return the frames still held back; call it once, after the last window.

        Args:
            spare: so many last frames are only what the others are derived from (ruling 6).
        """
        assert self._pending is not None, "finish follows at least one window"
        return self._release(len(self._pending) - spare, spare=spare)

    def _release(self, num_frames: int, *, spare: int) -> MotionTrajectory:
        """The first pending frames, derived with the help of `spare` frames that stay."""
        assert self._pending is not None
        if num_frames <= 0:
            return MotionTrajectory(np.empty((0, CHANNELS), dtype=np.float32))
        piece = self._pending[: num_frames + spare].numpy()
        steps = piece[:, PHASE_STEP]
        phase = _integrate(steps, self._phase)
        trajectory = MotionTrajectory.from_pose(
            piece[:, POSITION], piece[:, QUATERNION], phase, piece[:, STYLE], spare=spare
        )
        # continuity wins across the seam (ruling 10)
        if self._last_sign is not None and float(trajectory.quaternion[0] @ self._last_sign) < 0:
            trajectory.quaternion[:] *= -1
        self._last_sign = trajectory.quaternion[-1].copy()
        self._phase = phase[num_frames - 1] + float(steps[num_frames - 1])
        self._pending = self._pending[num_frames:]
        return trajectory


def _move(data: Tensor, heading: float, offset: Tensor) -> Tensor:
    """Rows [T,25] turned about +Y, then moved by `offset`; phase and style as they are."""
    moved = data.clone()
    for columns in (POSITION, VELOCITY, ACCELERATION, ANGULAR_VELOCITY):
        moved[:, columns] = turn_about_y(data[:, columns], heading)
    moved[:, (0, 2)] += offset[[0, 2]]
    turn = yaw_quaternion(torch.tensor(heading, dtype=data.dtype))
    moved[:, QUATERNION] = quaternion_multiply(turn, data[:, QUATERNION])
    return moved


def _integrate(steps: np.ndarray, start: float) -> np.ndarray:
    """Phase [T] whose first frame is `start`; the last step leads out of the window."""
    phase = np.full(len(steps), start, dtype=np.float64)
    phase[1:] += np.cumsum(steps[:-1], dtype=np.float64)
    return phase


def _fit(local: Tensor, target: Tensor) -> tuple[float, Tensor]:
    """Turn and offset that lay the shared frames of a window [S,25] on those already placed.

    The turn is the circular mean of the heading differences, the offset the mean of what then
    remains in x and z.
    """
    turns = heading_of(target[:, QUATERNION]) - heading_of(local[:, QUATERNION])  # S
    turn = float(torch.atan2(torch.sin(turns).mean(), torch.cos(turns).mean()))
    return turn, (target[:, POSITION] - turn_about_y(local[:, POSITION], turn)).mean(0)


def _blend(first: Tensor, second: Tensor) -> Tensor:
    """Shared frames [S,25], from the first window over to the second, soft at both ends.

    Phase steps are blended rather than phases: their sum stays monotone whatever they are. The
    first window's last step leads out of it, a repetition, so the second one's is taken.
    """
    x = torch.arange(1, len(first) + 1, dtype=torch.float64) / (len(first) + 1)
    weight = (x**3 * (x * (6 * x - 15) + 10))[:, None]  # two vanishing derivatives at both ends
    blended = torch.lerp(first, second, weight)
    blended[:, QUATERNION] = quaternion_slerp(first[:, QUATERNION], second[:, QUATERNION], weight)
    blended[-1, PHASE_STEP] = second[-1, PHASE_STEP]
    blended[:, STYLE] = F.normalize(blended[:, STYLE], dim=-1)
    return blended
