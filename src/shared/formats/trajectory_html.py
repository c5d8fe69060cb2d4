"""HTML preview of trajectories: the song plays, and drives the body, its path and a phase dial.

One page with one song and any number of trajectories, side by side, each on a stand-in or on the
body that dances it. Per frame and trajectory it holds 78 bytes before base64, so ten minutes cost
1.9 MB beside the song; with bodies, 223 bytes.
"""

import html
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..motion.motion import Motion
from ..motion.style import PAIRS, style_values
from ..motion.trajectory import MotionTrajectory
from .drawing import PATH
from .html import base64_array, motion_data, write_page
from .song_media import song_uri
from .trajectory_beats import SongTrack, beat_marks, phase_palette
from .trajectory_figure import stand_in

MUSIC_HINT = """The path has the colours of the bar and a dot at each beat; the dial's hand goes
    round once a bar and its hub lights up at the beats;"""
BEATLESS_HINT = """No beat was found in the song: the motion keeps its own time."""
PATH_HINT = """the bars are the style, the strip is the speed. Only the pelvis is generated: the
    rest of the body stands in."""
BODY_HINT = """the bars are the path's style, the strip is the mean speed of all joints. A foot on
    the ground turns green."""
TOP_SPEED = 65.0  # m/s; the page stores 16-bit millimetres a second


def write_trajectory_html(
    trajectories: Sequence[MotionTrajectory] | MotionTrajectory,
    path: str | Path,
    song: SongTrack | None = None,
    titles: Sequence[str] = (),
    bodies: Sequence[Motion] = (),
) -> Path:
    """Write one self-contained page; titles are captions and cannot act as markup.

    Args:
        trajectories: one or several for the same song.
        path: the page to write.
        song: its file is put into the page, cut to the longest trajectory.
        titles: one caption a trajectory; a body's own text where there is none.
        bodies: one a trajectory, frame by frame on it; none = the stand-in.

    Raises:
        UserError: no trajectory, a song that cannot be read, or the page cannot be written.
    """
    shown = [trajectories] if isinstance(trajectories, MotionTrajectory) else list(trajectories)
    if not shown:
        raise UserError(f"cannot write {path}: there is no trajectory to show; give one")
    song = song or SongTrack()
    media = ""
    if song.path is not None:
        uri = song_uri(song.path, max(trajectory.seconds for trajectory in shown))
        media = f'<audio id="song" preload="auto" src="{html.escape(uri)}"></audio>'
    names = [*titles, *[""] * (len(shown) - len(titles))]
    figures = list(bodies) or [
        stand_in(trajectory, name) for trajectory, name in zip(shown, names, strict=True)
    ]
    speeds = [_mean_speed(body) for body in bodies] or [
        np.linalg.norm(trajectory.velocity, axis=-1) for trajectory in shown
    ]
    cards = [
        _card(trajectory, figure, speed, song) | ({"text": name} if name else {})
        for trajectory, figure, speed, name in zip(shown, figures, speeds, names, strict=True)
    ]
    colours = [PATH] if song.beatless else phase_palette()
    palette = ["#" + bytes(colour).hex() for colour in colours]
    data = {"motions": cards, "palette": palette, "pairs": PAIRS}
    hint = BEATLESS_HINT if song.beatless else MUSIC_HINT
    return write_page(data, path, hint=f"{hint} {BODY_HINT if bodies else PATH_HINT}", media=media)


def _card(
    trajectory: MotionTrajectory, figure: Motion, speed: np.ndarray, song: SongTrack
) -> dict[str, Any]:
    """A figure's motion and what the dial, the path and the strip show; speed [T] in m/s."""
    card = motion_data(figure)
    marks = beat_marks(trajectory, song)
    if not len(marks.times) and np.ptp(trajectory.phase) == 0:
        return card  # no music: no dial
    return card | {
        "meter": 0 if song.beatless else marks.meter,  # 0: no dial
        "beats": base64_array(marks.times, "<f4"),
        "downbeat": base64_array(marks.downbeat, "u1"),
        "phase": base64_array(np.floor(trajectory.phase.astype(np.float64) * 65536), "<u2"),
        "speed": base64_array(np.clip(speed, 0, TOP_SPEED) * 1000, "<u2"),
        "style": base64_array(style_values(trajectory.style) * 255, "u1"),
    }


def _mean_speed(body: Motion) -> np.ndarray:
    """Of all joints [T] in m/s, forward differences; what motion beats are found in."""
    steps = np.diff(body.positions(), axis=0) * body.fps
    mean = np.linalg.norm(steps, axis=-1).mean(1)
    return np.pad(mean, (0, 1), mode="edge") if len(mean) else np.zeros(body.num_frames)
