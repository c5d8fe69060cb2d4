"""Picture of a trajectory: its path from above, and its speed over time under the song's beats.

The colour is the place in the bar, as in the HTML preview; lines of the path point to where the
pelvis faces. Long songs take several rows, like a score. Needs Pillow, nothing else.
"""

from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..motion.trajectory import MotionTrajectory
from .drawing import (
    FLOOR,
    GRID,
    INK,
    MARGIN,
    OVERSAMPLE,
    PATH,
    FloorMap,
    font,
    new_sheet,
    save_sheet,
)
from .trajectory_beats import BeatMarks, SongTrack, beat_marks, phase_palette

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

MAP = 430 * OVERSAMPLE
WIDTH = 800 * OVERSAMPLE  # of a row of the chart
HEIGHT = 92 * OVERSAMPLE
HEADER = 30 * OVERSAMPLE
ROW_SECONDS, MAX_ROWS = 20.0, 20
FACINGS = 12  # places on the path that show where the pelvis faces


def render_trajectory(
    trajectory: MotionTrajectory, path: str | Path, song: SongTrack | None = None, title: str = ""
) -> Path:
    """Draw one trajectory and save a PNG.

    Raises:
        UserError: Pillow is not installed, or the file cannot be written.
    """
    song = song or SongTrack()
    marks = beat_marks(trajectory, song)
    seconds = trajectory.seconds
    rows = int(np.clip(np.ceil(seconds / ROW_SECONDS), 1, MAX_ROWS))
    sheet, draw = new_sheet(MAP + WIDTH + MARGIN, HEADER + max(MAP, rows * HEIGHT))
    speed = np.linalg.norm(trajectory.velocity, axis=-1)
    rhythm = "no beat found, own time" if song.beatless else f"{len(marks.times)} beats"
    facts = f"{seconds:.1f} s, {rhythm}, mean speed {speed.mean():.2f} m/s"
    pen = font(14 * OVERSAMPLE, title)
    draw.text((MARGIN, HEADER / 2), f"{title[:80]}   {facts}".strip(), INK, pen, anchor="lm")
    colours = _phase_colours(trajectory.phase)
    if not len(marks.times):
        colours[:] = PATH
    sheet.paste(_draw_path(trajectory, colours, marks), (0, HEADER))
    for row in range(rows):
        span = (row * seconds / rows, (row + 1) * seconds / rows)
        chart = _draw_row(span, speed, colours, marks, trajectory.fps)
        sheet.paste(chart, (MAP, HEADER + row * HEIGHT))
    return save_sheet(sheet, Path(path))


def _phase_colours(phase: np.ndarray) -> np.ndarray:
    """RGB [T,3] for places in the bar [T]."""
    palette = phase_palette()
    return np.asarray(palette[(phase * len(palette)).astype(int) % len(palette)])


def _draw_path(
    trajectory: MotionTrajectory, colours: np.ndarray, marks: BeatMarks
) -> "Image.Image":
    """The square with the floor: the path, its downbeats, and facings along the way."""
    ground = trajectory.position[:, [0, 2]].astype(np.float64)
    image, draw = new_sheet(MAP, MAP)
    floor = FloorMap(ground, MAP)
    floor.draw_grid(draw)
    points = [floor.pixel(p) for p in ground]
    for step, colour in zip(pairwise(points), colours, strict=False):
        draw.line(step, tuple(colour), 3 * OVERSAMPLE)
    for time in marks.times[marks.downbeat]:
        frame = min(round(time * trajectory.fps), len(points) - 1)
        _dot(draw, points[frame], 3.5 * OVERSAMPLE, colours[frame])
    half = np.stack((np.sin(trajectory.heading), np.cos(trajectory.heading)), -1)
    for frame in np.linspace(0, len(points) - 1, min(FACINGS, len(points))).astype(int):
        radius = 4.5 * OVERSAMPLE if frame == 0 else 2 * OVERSAMPLE
        floor.draw_facing(draw, ground[frame], half[frame], radius)
    if len(marks.times):
        _draw_legend(draw, marks.meter)
    return image


def _draw_legend(draw: "ImageDraw.ImageDraw", meter: int) -> None:
    """A small dial: the colours of the bar with the numbers of its beats, 1 at the top."""
    radius, turns = 20 * OVERSAMPLE, np.arange(60) / 60
    x, y = MAP - radius - 2 * MARGIN, radius + 2 * MARGIN
    box = (x - radius, y - radius, x + radius, y + radius)
    for turn, colour in zip(turns, _phase_colours(turns), strict=True):
        draw.arc(box, 360 * turn - 90, 360 * turn - 83, tuple(colour), 5 * OVERSAMPLE)
    pen = font(10 * OVERSAMPLE)
    for beat in range(meter):
        angle = 2 * np.pi * beat / meter
        place = (x + 0.5 * radius * np.sin(angle), y - 0.5 * radius * np.cos(angle))
        draw.text(place, str(beat + 1), INK, pen, anchor="mm")


def _draw_row(
    span: tuple[float, float],
    speed: np.ndarray,
    colours: np.ndarray,
    marks: BeatMarks,
    fps: float,
) -> "Image.Image":
    """Speed between two times; a column of pixels shows the fastest of its frames."""
    image, draw = new_sheet(WIDTH + MARGIN, HEIGHT)
    top, floor = 14 * OVERSAMPLE, HEIGHT - 20 * OVERSAMPLE
    draw.rectangle((0, top, WIDTH, floor), FLOOR)
    highest = max(1.0, float(speed.max()))
    edges = np.clip(np.linspace(*span, WIDTH) * fps, 0, len(speed) - 1)
    stride = max(1, round(float(edges[1] - edges[0])))  # frames a column, where there are several
    peaks = np.stack([np.interp(edges + i, np.arange(len(speed)), speed) for i in range(stride)])
    line = floor - peaks.max(0) / highest * (floor - top)
    fills = np.rint(0.45 * colours[edges.astype(int)] + 0.55 * 255).astype(int)
    for column, (y, fill) in enumerate(zip(line, fills, strict=True)):
        draw.line([(column, y), (column, floor)], tuple(fill))
    draw.line(list(enumerate(line)), INK, OVERSAMPLE)
    shown = (marks.times >= span[0]) & (marks.times < span[1])
    crowded = shown.sum() * 4 * OVERSAMPLE > WIDTH
    for time, strong in zip(marks.times[shown], marks.downbeat[shown], strict=True):
        if strong or not crowded:
            x, tick = _across(time, span), (10 if strong else 5) * OVERSAMPLE
            draw.line([(x, top - tick), (x, top)], INK, (2 if strong else 1) * OVERSAMPLE)
    pen = font(10 * OVERSAMPLE)
    length = span[1] - span[0]
    step = 1.0 if length <= 12 else 5.0 if length <= 60 else 60.0
    for second in np.arange(np.ceil(span[0] / step) * step, span[1], step):
        x = _across(float(second), span)
        draw.line([(x, floor), (x, floor + 3 * OVERSAMPLE)], INK, OVERSAMPLE)
        label = f"{second:g} s" if step == 1.0 else f"{second // 60:.0f}:{second % 60:02.0f}"
        draw.text((x + 2 * OVERSAMPLE, floor + 2 * OVERSAMPLE), label, INK, pen)
    draw.line([(0, top), (WIDTH, top)], GRID, OVERSAMPLE)
    draw.text((WIDTH - MARGIN, top), f"{highest:.2g} m/s", INK, pen, anchor="rt")
    return image


def _across(time: float, span: tuple[float, float]) -> float:
    return float((time - span[0]) / max(1e-9, span[1] - span[0]) * WIDTH)


def _dot(
    draw: "ImageDraw.ImageDraw", point: tuple[float, float], radius: float, colour: np.ndarray
) -> None:
    x, y = point
    draw.ellipse((x - radius, y - radius, x + radius, y + radius), tuple(colour), INK, OVERSAMPLE)
