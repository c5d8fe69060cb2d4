"""Motion files out, by the ending of their name: one table of writers."""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TypeVar

import numpy as np

from src.shared.errors import UsageError, UserError
from src.shared.motion.motion import Motion

Exporter = Callable[[Motion, Path], Path]
Writer = TypeVar("Writer")


def _exporter(module: str, function: str) -> Exporter:
    """A writer whose module is imported at its first use: no format pays for another."""

    def write(motion: Motion, path: Path) -> Path:
        _check(motion, path)
        writer: Exporter = getattr(import_module(f"src.shared.formats.{module}"), function)
        return writer(motion, path)

    return write


EXPORTERS: dict[str, Exporter] = {
    "bvh": _exporter("bvh_writer", "write_bvh"),
    "glb": _exporter("glb", "write_glb"),
    "npz": _exporter("npz", "write_npz"),
    "html": _exporter("html", "write_html"),
    "png": _exporter("png", "render_strip"),
}


def write_motion(motion: Motion, path: str | Path) -> Path:
    """Write one motion in the format that the ending of `path` names; returns the path.

    Raises:
        UsageError: no format has this ending.
        UserError: the motion is empty or holds NaN, or the file cannot be written.
    """
    path = Path(path)
    return find_writer(EXPORTERS, path.suffix.removeprefix("."), str(path))(motion, path)


def export_motion(
    motion: Motion, folder: str | Path, stem: str, formats: Sequence[str] = ("bvh", "glb", "npz")
) -> dict[str, Path]:
    """Write one motion as `folder/stem.<format>` for each format; the path of each.

    Raises:
        UsageError: an unknown format; nothing has been written then.
        UserError: the motion is empty or holds NaN, or a file cannot be written.
    """
    writers = {name: find_writer(EXPORTERS, name, name) for name in formats}
    return {name: write(motion, Path(folder) / f"{stem}.{name}") for name, write in writers.items()}


def write_preview(motions: Sequence[Motion] | Motion, path: str | Path) -> Path:
    """Write one HTML page that plays the motions side by side, offline.

    Raises:
        UserError: no motion, one that is empty or holds NaN, or the file cannot be written.
    """
    from src.shared.formats.html import write_html

    for motion in [motions] if isinstance(motions, Motion) else motions:
        _check(motion, path)
    return write_html(motions, path)


def find_writer(writers: Mapping[str, Writer], name: str, given: str) -> Writer:
    """The writer of a format in a table; `given` is what the user wrote.

    Raises:
        UsageError: no format has this name.
    """
    try:
        return writers[name.lower()]
    except KeyError:
        known = ", ".join(writers)
        raise UsageError(f"{given}: {name!r} is not a format; choose from {known}") from None


def _check(motion: Motion, path: str | Path) -> None:
    """Refuse what no viewer could show; a diverged model makes such motions."""
    if not motion.num_frames:
        raise UserError(f"cannot write {path}: the motion has no frames")
    arrays = (motion.quaternions, motion.root_position, motion.contacts)
    if not all(np.isfinite(array).all() for array in arrays):
        raise UserError(f"cannot write {path}: the motion holds NaN or infinite values; "
                        "the model that made it may have diverged in training")  # fmt: skip
