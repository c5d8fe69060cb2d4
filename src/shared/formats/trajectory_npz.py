"""NPZ and NPY of trajectories: the 25 columns as one plain array for Python, no pickles.

Arrays of the NPZ (T frames):

| name           | shape   | type    | meaning                                                     |
|----------------|---------|---------|-------------------------------------------------------------|
| format_version | ()      | int32   | 1                                                           |
| trajectory     | [T,25]  | float32 | columns as `columns` names them; metres, seconds, radians   |
| phase_bars     | [T]     | float64 | bar phase that grows on, from the first frame's phase       |
| fps            | ()      | float32 | frames a second                                             |
| columns        | [25]    | str     | name of each column                                         |

An NPY holds the array `trajectory` alone, at 30 frames a second (TECH's data layout).
"""

from pathlib import Path

import numpy as np

from ..errors import UserError
from ..files import atomic_write
from ..motion.trajectory import CHANNELS, FPS, QUATERNION, MotionTrajectory
from .limits import array_names, read_array, read_arrays

FORMAT_VERSION = 1
MAX_VALUE = 1e6
COLUMNS = (
    *(f"{name}_{axis}" for name in ("position", "velocity", "acceleration") for axis in "xyz"),
    *(f"quaternion_{axis}" for axis in "wxyz"),
    *(f"angular_velocity_{axis}" for axis in "xyz"),
    "phase",
    *(f"style_{index}" for index in range(8)),
)


def write_trajectory_npz(trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Write one trajectory with the arrays of the module's table.

    Raises:
        UserError: the file cannot be written.
    """
    with atomic_write(Path(path)) as temporary, temporary.open("wb") as stream:
        np.savez_compressed(
            stream,
            format_version=np.int32(FORMAT_VERSION),
            trajectory=trajectory.data.astype(np.float32),
            phase_bars=trajectory.phase_unwrapped,
            fps=np.float32(trajectory.fps),
            columns=np.array(COLUMNS),
        )
    return Path(path)


def read_trajectory_npz(path: str | Path) -> MotionTrajectory:
    """Read a trajectory that `write_trajectory_npz` wrote.

    Raises:
        UserError: missing, damaged, not ours, of another shape, or holding NaN.
    """
    path = Path(path)
    arrays = load_arrays(path)
    if "beat_times" in arrays:
        raise UserError(f"{path}: is an analysed song, not a trajectory; "
                        "`features SONG --plot PICTURE` draws it")  # fmt: skip
    for name in ("trajectory", "fps"):
        if name not in arrays:
            raise UserError(
                f"{path}: has no array {name!r}, so it is no trajectory of this project"
                "; write it again"
            )
    columns = arrays.get("columns", np.array(COLUMNS))
    if columns.shape != (CHANNELS,) or columns.tolist() != list(COLUMNS):
        raise UserError(f"{path}: columns are not the {CHANNELS} of this project; write it again")
    fps = arrays["fps"]
    if fps.shape != () or fps.dtype.kind not in "fiu" or not 0 < float(fps) <= 10_000:
        raise UserError(f"{path}: fps is not a frame rate; expected a number above 0")
    return checked_trajectory(path, arrays["trajectory"], float(fps))


def read_trajectory_npy(path: str | Path) -> MotionTrajectory:
    """Read a bare [T,25] array at 30 frames a second.

    Raises:
        UserError: missing, damaged, of another shape, or holding NaN.
    """
    return checked_trajectory(Path(path), load_arrays(Path(path))["trajectory"], FPS)


def load_arrays(path: Path) -> dict[str, np.ndarray]:
    """The arrays of an NPZ by name; of an NPY its one array as `trajectory`.

    Raises:
        UserError: missing or damaged.
    """
    if path.suffix.lower() == ".npy":
        return {"trajectory": read_array(path)}
    return read_arrays(path, array_names(path))


def checked_trajectory(path: Path, data: np.ndarray, fps: float) -> MotionTrajectory:
    """A trajectory of numbers read from `path`.

    Raises:
        UserError: no frames, another shape or type, NaN, or quaternions of zeros.
    """
    if data.ndim != 2 or data.shape[1] != CHANNELS or data.dtype.kind not in "fiu":
        raise UserError(f"{path}: holds {data.dtype}{list(data.shape)}, expected numbers of shape "
                        f"[T, {CHANNELS}], time first, one trajectory")  # fmt: skip
    if not len(data):
        raise UserError(f"{path}: holds no frames; write it again")
    if not np.abs(data.astype(np.float64)).max() < MAX_VALUE:
        raise UserError(f"{path}: holds NaN or impossibly large values; write it again")
    if np.linalg.norm(data[:, QUATERNION].astype(np.float64), axis=1).min() < 1e-3:
        raise UserError(
            f"{path}: quaternion columns hold zeros, which are no rotations; write it again"
        )
    return MotionTrajectory(data.astype(np.float32), fps)
