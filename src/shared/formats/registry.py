"""Motion files out, by the ending of their name: one table of writers."""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import TypeVar

import numpy as np

from ..errors import UsageError, UserError
from ..motion.motion import Motion
from .rig import RigClip

Exporter = Callable[[Motion, Path], Path]
Writer = TypeVar("Writer")


def _function(module: str, function: str) -> Callable[..., Path]:
    """A writer whose module is imported at its first use: no format pays for another."""

    def write(*args: object, **kwargs: object) -> Path:
        found: Callable[..., Path] = getattr(import_module(f".{module}", __package__), function)
        return found(*args, **kwargs)

    return write


EXPORTERS: dict[str, Exporter] = {
    "bvh": _function("bvh_writer", "write_bvh"),
    "glb": _function("glb", "write_glb"),
    "usd": _function("usd", "write_usd"),
    "usda": _function("usd", "write_usd"),
    "usdc": _function("usd", "write_usd"),
    "npz": _function("npz", "write_npz"),
    "amass": _function("amass_writer", "write_amass"),
    "csv": _function("motion_csv", "write_motion_csv"),
    "html": _function("html", "write_html"),
    "png": _function("png", "render_strip"),
    "gif": _function("video", "write_gif"),
    "mp4": _function("video", "write_mp4"),
}
# Formats that hold any skeleton, under any names.
CLIP_EXPORTERS: dict[str, Callable[[RigClip, Path], Path]] = {
    "bvh": _function("bvh_writer", "write_bvh_clip"),
    "glb": _function("glb", "write_glb_clip"),
    "usd": _function("usd", "write_usd_clip"),
    "usda": _function("usd", "write_usd_clip"),
    "usdc": _function("usd", "write_usd_clip"),
}
ENDINGS = {"amass": "amass.npz"}  # of formats whose name is not the ending


def ending(name: str) -> str:
    """How the files of a format end, without the dot."""
    return ENDINGS.get(name, name)


def format_of(path: str | Path) -> str:
    """The format that the end of a file's name tells: `amass` of `walk.amass.npz`, else `npz`.

    Raises:
        UsageError: no format ends like this.
    """
    name = Path(path).name.lower()
    for known, end in ENDINGS.items():
        if name.endswith(f".{end}"):
            return known
    found = Path(name).suffix.removeprefix(".")
    if not found:
        known = ", ".join(EXPORTERS)
        raise UsageError(f"{path}: its name does not end in a format; choose from {known}")
    find_writer(EXPORTERS, found, str(path))
    return found


def write_motion(motion: Motion, path: str | Path, *, names: str = "canonical") -> Path:
    """Write one motion in the format that the ending of `path` names; returns the path.

    Args:
        motion: what to write.
        path: the file; its folder is made where it is missing.
        names: what BVH, GLB and USD call the joints (`joint_names.SCHEMES`).

    Raises:
        UsageError: no format has this ending.
        UserError: the motion is empty or holds NaN, or the file cannot be written.
    """
    path = Path(path)
    name = format_of(path)
    check_motion(motion, path)
    if name in CLIP_EXPORTERS and names != "canonical":
        return EXPORTERS[name](motion, path, names=names)  # type: ignore[call-arg]
    return EXPORTERS[name](motion, path)


def write_clip(clip: RigClip, path: str | Path) -> Path:
    """Write the movement of any skeleton in the format that the ending of `path` names.

    Raises:
        UsageError: no format that holds any skeleton has this ending.
        UserError: the file cannot be written.
    """
    path = Path(path)
    return find_writer(CLIP_EXPORTERS, path.suffix.removeprefix("."), str(path))(clip, path)


def export_motion(
    motion: Motion, folder: str | Path, stem: str, formats: Sequence[str] = ("bvh", "glb", "npz")
) -> dict[str, Path]:
    """Write one motion as `folder/stem.<ending>` for each format; the path of each.

    Raises:
        UsageError: an unknown format; nothing has been written then.
        UserError: the motion is empty or holds NaN, or a file cannot be written.
    """
    for name in formats:
        find_writer(EXPORTERS, name, name)
    return {name: write_motion(motion, Path(folder) / f"{stem}.{ending(name)}") for name in formats}


def write_preview(motions: Sequence[Motion] | Motion, path: str | Path) -> Path:
    """Write one HTML page that plays the motions side by side, offline.

    Raises:
        UserError: no motion, one that is empty or holds NaN, or the file cannot be written.
    """
    from .html import write_html

    for motion in [motions] if isinstance(motions, Motion) else motions:
        check_motion(motion, path)
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


def check_motion(motion: Motion, path: str | Path) -> None:
    """Refuse what no viewer could show; a diverged model makes such motions."""
    if not motion.num_frames:
        raise UserError(f"cannot write {path}: the motion has no frames; give one with some")
    arrays = (motion.quaternions, motion.root_position, motion.contacts)
    if not all(np.isfinite(array).all() for array in arrays):
        raise UserError(f"cannot write {path}: the motion holds NaN or infinite values; "
                        "the model that made it may have diverged in training"
                        "; train it anew or take an earlier checkpoint")  # fmt: skip
