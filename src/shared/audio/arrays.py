"""Named arrays in npz files: whole or not at all, no pickles, faults in one line."""

from pathlib import Path

import numpy as np

from ..errors import UserError
from ..io.arrays import BadArray, load_arrays
from ..io.files import atomic_write

MAX_VALUES = 1 << 25  # numbers: the 128 rows of two hours at 30 frames a second, and some


def write_arrays(arrays: dict[str, np.ndarray], path: str | Path) -> Path:
    """Write an npz whole or not at all.

    Raises:
        UserError: the file cannot be written.
    """
    with atomic_write(Path(path)) as temporary, temporary.open("wb") as stream:
        np.savez(stream, **arrays)  # type: ignore[arg-type]
    return Path(path)


def read_arrays(path: str | Path) -> dict[str, np.ndarray]:
    """Read every array of an npz; checksums are verified.

    Raises:
        UserError: missing, no npz, or damaged.
    """
    try:
        return load_arrays(path, max_values=MAX_VALUES)
    except FileNotFoundError:
        raise UserError(f"{path} does not exist; name a features file (.npz)") from None
    except (OSError, BadArray) as error:
        raise UserError(
            f"{path} is no features file, or is damaged ({error}); make it again"
        ) from error
