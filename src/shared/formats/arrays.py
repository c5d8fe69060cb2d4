"""NPZ in and out: motions and trajectories as plain arrays for Python, no pickles.

Arrays of a motion (T frames, 22 joints):

| name           | shape      | type    | meaning                                                  |
|----------------|------------|---------|----------------------------------------------------------|
| format_version | ()         | int32   | 1                                                        |
| quaternions    | [T,22,4]   | float32 | local rotations w, x, y, z; joint 0 in the world         |
| root_position  | [T,3]      | float32 | pelvis in the world, metres, +Y up                       |
| contacts       | [T,2]      | float32 | left and right foot on the ground, 0 to 1                |
| positions      | [T,22,3]   | float32 | world joint positions, metres (follows from the others)  |
| fps            | ()         | float32 | frames a second                                          |
| text           | ()         | str     | caption or prompt                                        |
| joint_names    | [22]       | str     | SMPL order                                               |
| parents        | [22]       | int32   | parent of each joint, -1 for the root                    |
| offsets        | [22,3]     | float32 | rest offsets from the parent (T-pose facing +Z), metres  |

Of a trajectory: see `write_trajectory_npz`; an NPY holds its [T,25] alone, at 30 frames a second.
"""

from pathlib import Path

import numpy as np

from ..errors import UserError
from ..io.arrays import write_arrays
from ..motion.motion import Motion
from ..motion.skeleton import JOINT_NAMES, NUM_JOINTS, canonical_skeleton
from ..motion.trajectory import CHANNELS, FPS, QUATERNION, MotionTrajectory, from_motion
from .limits import check_numbers, check_plausible, read_array, read_arrays

FORMAT_VERSION = 1
_SHAPES = {"quaternions": (NUM_JOINTS, 4), "root_position": (3,), "contacts": (2,)}
_NAMES = ("format_version", "fps", "text", "joint_names", *_SHAPES)
MAX_VALUE = 1e6  # metres
MIN_FPS = 0.1  # less, and resampling would make millions of frames of a few


def write_npz(motion: Motion, path: str | Path) -> Path:
    """Write one motion with the module's arrays; raises UserError where it cannot be written."""
    skeleton = canonical_skeleton()
    arrays = {
        "format_version": np.int32(FORMAT_VERSION),
        "quaternions": motion.quaternions.astype(np.float32),
        "root_position": motion.root_position.astype(np.float32),
        "contacts": motion.contacts.astype(np.float32),
        "positions": motion.positions().astype(np.float32),
        "fps": np.float32(motion.fps),
        "text": np.array(motion.text),
        "joint_names": np.array(skeleton.names),
        "parents": np.array(skeleton.parents, dtype=np.int32),
        "offsets": skeleton.offsets.astype(np.float32),
    }
    return write_arrays(arrays, Path(path), compressed=True)


def read_npz(path: str | Path) -> Motion:
    """Read a motion that `write_npz` wrote; quaternions are normalised again.

    Raises:
        UserError: missing, damaged, not ours, or with arrays of another shape or NaN.
    """
    path = Path(path)
    arrays = read_arrays(path, _NAMES)
    for name in _NAMES:
        if name not in arrays:
            raise UserError(
                f"{path}: has no array {name!r}, so it is no motion of this project; write it again"
            )
    joint_names = arrays["joint_names"]
    if joint_names.shape != (NUM_JOINTS,) or tuple(joint_names.tolist()) != JOINT_NAMES:
        raise UserError(
            f"{path}: joint_names are not the 22 joints of this project; write it again"
        )
    num_frames = len(np.atleast_1d(arrays["quaternions"]))
    for name, shape in _SHAPES.items():
        check_numbers(f"{path}: {name}", arrays[name], (num_frames, *shape), MAX_VALUE)
    check_numbers(f"{path}: fps", arrays["fps"], (), MAX_VALUE)
    fps = float(arrays["fps"])
    if num_frames < 1 or not MIN_FPS <= fps <= 10_000:
        raise UserError(f"{path}: {num_frames} frames at {fps:g} frames a second is no motion; "
                        "write it again")  # fmt: skip
    quaternions = arrays["quaternions"].astype(np.float64)
    norms = np.linalg.norm(quaternions, axis=-1, keepdims=True)
    if norms.min() < 1e-3:
        raise UserError(f"{path}: quaternions holds zeros, which are no rotations; write it again")
    return Motion(
        (quaternions / norms).astype(np.float32),
        arrays["root_position"].astype(np.float32),
        arrays["contacts"].astype(np.float32),
        fps,
        str(arrays["text"]),
    )


COLUMNS = (
    *(f"{name}_{axis}" for name in ("position", "velocity", "acceleration") for axis in "xyz"),
    *(f"quaternion_{axis}" for axis in "wxyz"),
    *(f"angular_velocity_{axis}" for axis in "xyz"),
    "phase",
    *(f"style_{index}" for index in range(8)),
)


def write_trajectory_npz(trajectory: MotionTrajectory, path: str | Path) -> Path:
    """Write one trajectory, T frames.

    | name           | shape   | type    | meaning                                                 |
    |----------------|---------|---------|---------------------------------------------------------|
    | format_version | ()      | int32   | 1                                                       |
    | trajectory     | [T,25]  | float32 | columns as `columns` names them; metres, radians        |
    | phase_bars     | [T]     | float64 | bar phase that grows on, from the first frame's phase   |
    | fps            | ()      | float32 | frames a second                                         |
    | columns        | [25]    | str     | name of each column                                     |

    Raises:
        UserError: the file cannot be written.
    """
    arrays = {
        "format_version": np.int32(FORMAT_VERSION),
        "trajectory": trajectory.data.astype(np.float32),
        "phase_bars": trajectory.phase_unwrapped,
        "fps": np.float32(trajectory.fps),
        "columns": np.array(COLUMNS),
    }
    return write_arrays(arrays, Path(path), compressed=True)


def read_trajectory_npz(path: str | Path) -> MotionTrajectory:
    """Read a trajectory that `write_trajectory_npz` wrote; of a motion's file its pelvis.

    Raises:
        UserError: missing, damaged, not ours, of another shape, or holding NaN.
    """
    path = Path(path)
    arrays = load_arrays(path)
    if "root_position" in arrays:
        return from_motion(read_npz(path))
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
    return read_arrays(path)


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
    check_plausible(f"{path}:", data, MAX_VALUE)
    if np.linalg.norm(data[:, QUATERNION].astype(np.float64), axis=1).min() < 1e-3:
        raise UserError(
            f"{path}: quaternion columns hold zeros, which are no rotations; write it again"
        )
    return MotionTrajectory(data.astype(np.float32), fps)
