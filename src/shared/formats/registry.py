"""Files of motions, trajectories and dances, by the ending of their name: tables of writers.

A module is imported at the first use of its format: none pays for another.
"""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..errors import UsageError, UserError
from ..motion.motion import Danced, Motion
from ..motion.trajectory import MotionTrajectory
from .preview.trajectory import SongTrack
from .rig import RigClip

Writer = TypeVar("Writer")
Song = SongTrack | str | Path | None  # with its beats where they are known, else its file


def _lazy(module: str, function: str) -> Callable[..., Any]:
    """A function whose module is imported at its first use."""

    def call(*args: object, **kwargs: object) -> Any:
        return getattr(import_module(f".{module}", __package__), function)(*args, **kwargs)

    return call


# Of (motion, path), with `names=` those that are in `CLIP_EXPORTERS`, too. A new one wants a row in
# docs/formats.md, its first bytes in the test, and a place in the help of `generate` and `convert`.
EXPORTERS: dict[str, Callable[..., Path]] = {
    "bvh": _lazy("writers.bvh", "write_bvh"),
    "glb": _lazy("writers.glb", "write_glb"),
    **dict.fromkeys(("usd", "usda", "usdc"), _lazy("writers.usd", "write_usd")),
    "fbx": _lazy("blender", "write_fbx"),
    "vrm": _lazy("writers.glb", "write_vrm"),
    "vrma": _lazy("writers.glb", "write_vrma"),
    "npz": _lazy("arrays", "write_npz"),
    "amass": _lazy("amass", "write_amass"),
    "csv": _lazy("csv_files", "write_motion_csv"),
    "html": _lazy("preview.html", "write_html"),
    "png": _lazy("preview.figures", "render_strip"),
    "gif": _lazy("preview.figures", "write_gif"),
    "mp4": _lazy("preview.figures", "write_mp4"),
}
# Formats that hold any skeleton, under any names.
CLIP_EXPORTERS: dict[str, Callable[[RigClip, Path], Path]] = {
    "bvh": _lazy("writers.bvh", "write_bvh_clip"),
    "glb": _lazy("writers.glb", "write_glb_clip"),
    "fbx": _lazy("blender", "write_fbx_clip"),
    **dict.fromkeys(("usd", "usda", "usdc"), _lazy("writers.usd", "write_usd_clip")),
}
# What a format needs beside this program; raises UserError where it is missing.
NEEDS: dict[str, Callable[[], Any]] = {
    "fbx": _lazy("blender", "find_blender"),
    "mp4": _lazy("preview.figures", "find_av"),
}
_trajectory_npz = _lazy("arrays", "write_trajectory_npz")
_trajectory_csv = _lazy("csv_files", "write_trajectory_csv")
_trajectory_glb = _lazy("writers.glb", "write_trajectory_glb")
_trajectory_html = _lazy("preview.html", "write_trajectory_html")
# Of (trajectory, path, song, title); formats without a place for song or title leave them out.
TRAJECTORY_EXPORTERS: dict[str, Callable[[MotionTrajectory, Path, SongTrack, str], Path]] = {
    "npz": lambda trajectory, path, song, title: _trajectory_npz(trajectory, path),
    "csv": lambda trajectory, path, song, title: _trajectory_csv(trajectory, path),
    "glb": lambda trajectory, path, song, title: _trajectory_glb(trajectory, path, title),
    "html": lambda trajectory, path, song, title: _trajectory_html(trajectory, path, song, [title]),
    "png": _lazy("preview.charts", "render_trajectory"),
}
TRAJECTORY_READERS: dict[str, Callable[[Path], MotionTrajectory]] = {
    "npz": _lazy("arrays", "read_trajectory_npz"),
    "npy": _lazy("arrays", "read_trajectory_npy"),
    "csv": _lazy("csv_files", "read_trajectory_csv"),
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


def find_writer(writers: Mapping[str, Writer], name: str, given: str) -> Writer:
    """The writer of a format in a table; `given` is what the user wrote.

    Raises:
        UsageError: no format has this name.
        UserError: it needs a program that is not here.
    """
    if (writer := writers.get(name.lower())) is None:
        known = ", ".join(writers)
        raise UsageError(f"{given}: {name!r} is not a format; choose from {known}")
    NEEDS.get(name.lower(), str)()
    return writer


# ---------------------------------------------------------------- motions


def write_motion(
    motion: Motion | MotionTrajectory, path: str | Path, *, names: str = "canonical"
) -> Path:
    """Write one motion in the format that the ending of `path` names; returns the path. A
    trajectory is written as `write_trajectory` does.

    Args:
        names: what BVH, GLB and USD call the joints (`rig.SCHEMES`).

    Raises:
        UsageError: no format has this ending, or it is not one motion.
        UserError: the motion has a fault (see `Motion.fault`), or the file cannot be written.
    """
    path = Path(path)
    if isinstance(motion, MotionTrajectory):
        return write_trajectory(motion, path)
    name = format_of(path)
    check_motion(motion, path)
    if name in CLIP_EXPORTERS and names != "canonical":
        return EXPORTERS[name](motion, path, names=names)
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
    for motion in [motions] if isinstance(motions, Motion) else motions:
        check_motion(motion, path)
    return EXPORTERS["html"](motions, path)


def check_motion(motion: Any, path: str | Path) -> None:
    """Refuse what is not one motion, or what no viewer could show; diverged models make such."""
    if not isinstance(motion, Motion):
        several = isinstance(motion, Sequence) and all(isinstance(each, Motion) for each in motion)
        found = f"{len(motion)} motions" if several else type(motion).__name__
        raise UsageError(
            f"cannot write {path}: motion is {found}; give one Motion, as `generate` and"
            " `read_motion` make them" + ", and each a file of its own" * several
        )
    if fault := motion.fault():
        raise UserError(f"{path}: {fault}")


# ---------------------------------------------------------------- trajectories


def read_trajectory(path: str | Path) -> MotionTrajectory:
    """Read a trajectory; of a body's NPZ its pelvis.

    Raises:
        UsageError: no format has this ending.
        UserError: missing, damaged, or not a trajectory.
    """
    path = Path(path)
    name = path.suffix.removeprefix(".").lower()
    if name not in TRAJECTORY_READERS:
        raise UsageError(
            f"{path}: {name!r} is not a trajectory's ending; known are"
            f" {', '.join(TRAJECTORY_READERS)}; `convert` draws a body: convert CLIP CLIP.png"
        )
    return TRAJECTORY_READERS[name](path)


def write_trajectory(
    trajectory: MotionTrajectory, path: str | Path, song: Song = None, *, title: str = ""
) -> Path:
    """Write one trajectory in the format that the ending of `path` names; returns the path.

    Args:
        song: beats are taken from the trajectory's bar phase where it does not know them.
        title: caption, name of the animation.

    Raises:
        UsageError: no format has this ending.
        UserError: the trajectory is empty or holds NaN, the song cannot be read, or the file
            cannot be written.
    """
    path = Path(path)
    writer = find_writer(TRAJECTORY_EXPORTERS, path.suffix.removeprefix("."), str(path))
    _check_trajectory(trajectory, path)
    return writer(trajectory, path, _track(song), title)


def export_trajectory(
    trajectory: MotionTrajectory,
    folder: str | Path,
    stem: str,
    formats: Sequence[str] = ("npz", "html"),
    song: Song = None,
    *,
    title: str = "",
) -> dict[str, Path]:
    """Write one trajectory as `folder/stem.<format>` for each format; the path of each.

    Raises:
        UsageError: an unknown format; nothing has been written then.
        UserError: as `write_trajectory`.
    """
    for name in formats:
        find_writer(TRAJECTORY_EXPORTERS, name, name)
    return {
        name: write_trajectory(trajectory, Path(folder) / f"{stem}.{name}", song, title=title)
        for name in formats
    }


def write_trajectory_preview(
    trajectories: Sequence[MotionTrajectory] | MotionTrajectory,
    path: str | Path,
    song: Song = None,
    titles: Sequence[str] = (),
) -> Path:
    """Write one HTML page that plays the song with its trajectories side by side, offline; raises
    UserError: no trajectory, or as `write_trajectory`."""
    shown = [trajectories] if isinstance(trajectories, MotionTrajectory) else trajectories
    for trajectory in shown:
        _check_trajectory(trajectory, path)
    return Path(_trajectory_html(shown, path, _track(song), titles))


def _track(song: Song) -> SongTrack:
    if isinstance(song, SongTrack):
        return song
    return SongTrack(None if song is None else Path(song))


def _check_trajectory(trajectory: MotionTrajectory, path: str | Path) -> None:
    """Refuse what no viewer could show; a diverged model makes such trajectories."""
    if not trajectory.num_frames:
        raise UserError(f"cannot write {path}: the trajectory has no frames; give one with some")
    if not np.isfinite(trajectory.data).all():
        raise UserError(f"cannot write {path}: the trajectory holds NaN or infinite values; the"
                        " model that made it may have diverged; train it anew")  # fmt: skip
    if np.linalg.norm(trajectory.quaternion, axis=-1).min() < 1e-6:
        raise UserError(f"cannot write {path}: the trajectory holds a quaternion of zeros, "
                        "which is no rotation; make it again")  # fmt: skip


# ---------------------------------------------------------------- dances


def export_dance(
    motion: Motion,
    trajectory: MotionTrajectory,
    folder: Path,
    stem: str,
    formats: Sequence[str],
    song: SongTrack,
    figures: Sequence[Danced] | None = None,
) -> dict[str, Path]:
    """Write one dance as `folder/stem.<format>` for each format, page and film with the song.

    Args:
        trajectory: its path, as many frames.
        folder: where to; it is made where it is missing.
        formats: of `EXPORTERS`.
        song: that it belongs to.
        figures: what it dances on a stage, seen from the front; None = it follows a path.

    Returns:
        The path of each format.

    Raises:
        UsageError: an unknown format; nothing has been written then.
        UserError: as `write_motion`, or the song cannot be read.
    """
    paths = export_motion(motion, folder, stem, [n for n in formats if n not in ("html", "mp4")])
    if "html" in formats:
        page = folder / f"{stem}.html"
        paths["html"] = write_dance_page([motion], [trajectory], page, song, [figures])
    if "mp4" in formats:
        check_motion(motion, folder / f"{stem}.mp4")
        film = EXPORTERS["mp4"](motion, folder / f"{stem}.mp4", song.path, figures)
        paths["mp4"] = film
    return {name: paths[name] for name in formats}


def write_dance_page(
    motions: Sequence[Motion],
    trajectories: Sequence[MotionTrajectory],
    path: Path,
    song: SongTrack,
    figures: Sequence[Sequence[Danced] | None] = (),
) -> Path:
    """One page that plays the song with its dances side by side, offline.

    Raises:
        UserError: a motion holds NaN, the song cannot be read, or the page cannot be written.
    """
    for motion in motions:
        check_motion(motion, path)
    titles = [motion.text for motion in motions]
    return Path(_trajectory_html(trajectories, path, song, titles, motions, figures))
