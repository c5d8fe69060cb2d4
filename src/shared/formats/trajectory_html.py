"""HTML preview of trajectories: the song plays, and drives the body, its path and a phase dial.

One page with one song and any number of trajectories, side by side. Per frame and trajectory it
holds 78 bytes before base64, so ten minutes cost 1.9 MB beside the song.
"""

import html
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.errors import UserError
from src.shared.formats.drawing import PATH
from src.shared.formats.html import base64_array, motion_data, write_page
from src.shared.formats.song_media import song_uri
from src.shared.formats.trajectory_beats import SongTrack, beat_marks, phase_palette
from src.shared.formats.trajectory_figure import stand_in
from src.shared.motion.style import PAIRS, style_values
from src.shared.motion.trajectory import MotionTrajectory

HINT = """The path has the colours of the bar and a dot at each beat; the dial's hand goes
    round once a bar and its hub lights up at the beats; the bars are the style, the strip is the
    speed. Only the pelvis is generated: the rest of the body stands in."""
BEATLESS_HINT = """No beat was found in the song: the motion keeps its own time. The bars are the
    style, the strip is the speed. Only the pelvis is generated: the rest of the body stands in."""
TOP_SPEED = 65.0  # m/s; the page stores 16-bit millimetres a second


def write_trajectory_html(
    trajectories: Sequence[MotionTrajectory] | MotionTrajectory,
    path: str | Path,
    song: SongTrack | None = None,
    titles: Sequence[str] = (),
) -> Path:
    """Write one self-contained page; titles are captions and cannot act as markup.

    Args:
        trajectories: one or several for the same song.
        path: the page to write.
        song: its file is put into the page, cut to the longest trajectory.
        titles: one caption a trajectory.

    Raises:
        UserError: no trajectory, a song that cannot be read, or the page cannot be written.
    """
    shown = [trajectories] if isinstance(trajectories, MotionTrajectory) else list(trajectories)
    if not shown:
        raise UserError(f"cannot write {path}: there is no trajectory to show")
    song = song or SongTrack()
    media = ""
    if song.path is not None:
        uri = song_uri(song.path, max(trajectory.seconds for trajectory in shown))
        media = f'<audio id="song" preload="auto" src="{html.escape(uri)}"></audio>'
    names = [*titles, *[""] * len(shown)]
    cards = [_card(*each, song) for each in zip(shown, names, strict=False)]
    colours = [PATH] if song.beatless else phase_palette()
    palette = ["#" + bytes(colour).hex() for colour in colours]
    data = {"motions": cards, "palette": palette, "pairs": PAIRS}
    return write_page(data, path, hint=BEATLESS_HINT if song.beatless else HINT, media=media)


def _card(trajectory: MotionTrajectory, title: str, song: SongTrack) -> dict[str, Any]:
    """The stand-in's motion and what the dial, the path and the strip show."""
    card = motion_data(stand_in(trajectory, title))
    marks = beat_marks(trajectory, song)
    if not len(marks.times) and np.ptp(trajectory.phase) == 0:
        return card  # no music: no dial
    speed = np.linalg.norm(trajectory.velocity, axis=-1)
    return card | {
        "meter": 0 if song.beatless else marks.meter,  # 0: no dial
        "beats": base64_array(marks.times, "<f4"),
        "downbeat": base64_array(marks.downbeat, "u1"),
        "phase": base64_array(np.floor(trajectory.phase.astype(np.float64) * 65536), "<u2"),
        "speed": base64_array(np.clip(speed, 0, TOP_SPEED) * 1000, "<u2"),
        "style": base64_array(style_values(trajectory.style) * 255, "u1"),
    }
