"""Trajectory files out, by the ending of their name: one table of writers.

A writer takes the trajectory, the path, the song it goes with and a title; formats without a
place for the song or the title leave them out.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..motion.trajectory import MotionTrajectory
from .registry import find_writer
from .trajectory_beats import SongTrack

Writer = Callable[[MotionTrajectory, Path, SongTrack, str], Path]


def _npz(trajectory: MotionTrajectory, path: Path, song: SongTrack, title: str) -> Path:
    from .trajectory_npz import write_trajectory_npz

    return write_trajectory_npz(trajectory, path)


def _csv(trajectory: MotionTrajectory, path: Path, song: SongTrack, title: str) -> Path:
    from .trajectory_csv import write_trajectory_csv

    return write_trajectory_csv(trajectory, path)


def _glb(trajectory: MotionTrajectory, path: Path, song: SongTrack, title: str) -> Path:
    from .trajectory_glb import write_trajectory_glb

    return write_trajectory_glb(trajectory, path, title)


def _html(trajectory: MotionTrajectory, path: Path, song: SongTrack, title: str) -> Path:
    from .trajectory_html import write_trajectory_html

    return write_trajectory_html(trajectory, path, song, [title])


def _png(trajectory: MotionTrajectory, path: Path, song: SongTrack, title: str) -> Path:
    from .trajectory_png import render_trajectory

    return render_trajectory(trajectory, path, song, title)


TRAJECTORY_EXPORTERS: dict[str, Writer] = {
    "npz": _npz,
    "csv": _csv,
    "glb": _glb,
    "html": _html,
    "png": _png,
}


def write_trajectory(
    trajectory: MotionTrajectory,
    path: str | Path,
    song: SongTrack | str | Path | None = None,
    *,
    title: str = "",
) -> Path:
    """Write one trajectory in the format that the ending of `path` names; returns the path.

    Args:
        trajectory: what to write.
        path: the file; its folder is made where it is missing.
        song: the song's file, with its beats where they are known; beats are taken from the
            trajectory's bar phase otherwise.
        title: caption, name of the animation.

    Raises:
        UsageError: no format has this ending.
        UserError: the trajectory is empty or holds NaN, the song cannot be read, or the file
            cannot be written.
    """
    path = Path(path)
    writer = find_writer(TRAJECTORY_EXPORTERS, path.suffix.removeprefix("."), str(path))
    _check(trajectory, path)
    return writer(trajectory, path, _track(song), title)


def export_trajectory(
    trajectory: MotionTrajectory,
    folder: str | Path,
    stem: str,
    formats: Sequence[str] = ("npz", "html"),
    song: SongTrack | str | Path | None = None,
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
    song: SongTrack | str | Path | None = None,
    titles: Sequence[str] = (),
) -> Path:
    """Write one HTML page that plays the song with its trajectories side by side, offline.

    Raises:
        UserError: no trajectory, or as `write_trajectory`.
    """
    from .trajectory_html import write_trajectory_html

    shown = [trajectories] if isinstance(trajectories, MotionTrajectory) else trajectories
    for trajectory in shown:
        _check(trajectory, path)
    return write_trajectory_html(shown, path, _track(song), titles)


def _track(song: SongTrack | str | Path | None) -> SongTrack:
    if isinstance(song, SongTrack):
        return song
    return SongTrack(None if song is None else Path(song))


def _check(trajectory: MotionTrajectory, path: str | Path) -> None:
    """Refuse what no viewer could show; a diverged model makes such trajectories."""
    if not trajectory.num_frames:
        raise UserError(f"cannot write {path}: the trajectory has no frames; give one with some")
    if not np.isfinite(trajectory.data).all():
        raise UserError(f"cannot write {path}: the trajectory holds NaN or infinite values; "
                        "the model that made it may have diverged in training"
                        "; train it anew or take an earlier checkpoint")  # fmt: skip
    if np.linalg.norm(trajectory.quaternion, axis=-1).min() < 1e-6:
        raise UserError(f"cannot write {path}: the trajectory holds a quaternion of zeros, "
                        "which is no rotation; make it again")  # fmt: skip
