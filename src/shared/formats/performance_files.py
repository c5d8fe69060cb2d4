"""Files of a dance: those of any motion, and a page that plays the song with it.

The page is that of the path, with the body instead of the stand-in.
"""

from collections.abc import Sequence
from pathlib import Path

from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory
from .registry import check_motion, export_motion
from .trajectory_beats import SongTrack
from .trajectory_html import write_trajectory_html


def export_dance(
    motion: Motion,
    trajectory: MotionTrajectory,
    folder: Path,
    stem: str,
    formats: Sequence[str],
    song: SongTrack,
) -> dict[str, Path]:
    """Write one dance as `folder/stem.<format>` for each format; the path of each.

    Raises:
        UsageError: an unknown format; nothing has been written then.
        UserError: as `write_motion`, or the song cannot be read.
    """
    plain = [name for name in formats if name != "html"]
    paths = export_motion(motion, folder, stem, plain)
    if "html" in formats:
        paths["html"] = write_dance_page([motion], [trajectory], folder / f"{stem}.html", song)
    return {name: paths[name] for name in formats}


def write_dance_page(
    motions: Sequence[Motion],
    trajectories: Sequence[MotionTrajectory],
    path: Path,
    song: SongTrack,
) -> Path:
    """One page that plays the song with its dances side by side, offline.

    Raises:
        UserError: a motion holds NaN, the song cannot be read, or the page cannot be written.
    """
    for motion in motions:
        check_motion(motion, path)
    titles = [motion.text for motion in motions]
    return write_trajectory_html(trajectories, path, song, titles, motions)
