"""Named arrays in npz files: whole or not at all, no pickles, faults in one line."""

from pathlib import Path
from zipfile import BadZipFile
from zlib import error as ZlibError

import numpy as np

from src.shared.errors import UserError
from src.shared.files import atomic_write


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
        with np.load(path, allow_pickle=False) as stored:
            return {name: stored[name] for name in stored.files}
    except FileNotFoundError:
        raise UserError(f"{path} does not exist; name a features file (.npz)") from None
    except (OSError, ValueError, EOFError, KeyError, BadZipFile, ZlibError, AttributeError) as e:
        raise UserError(f"{path} is no features file, or is damaged ({e}); make it again") from e
