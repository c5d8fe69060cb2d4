"""Pictures of a trajectory and of an analysed song, with Pillow; a trajectory's plots.

A trajectory: its path from above, and its speed over time under the song's beats. The colour is
the place in the bar, as in the HTML preview; lines of the path point to where the pelvis faces.
Long songs take several rows, like a score. A song: mel, chroma, loudness, onsets, beats and bar
phase over time, from the arrays of features.npz by name."""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from ...motion.trajectory import MotionTrajectory
from .drawing import (
    FLOOR,
    GRID,
    INK,
    MARGIN,
    OVERSAMPLE,
    FloorMap,
    font,
    legend,
    new_figure,
    new_sheet,
    save_figure,
    save_sheet,
)
from .trajectory import PATH, BeatMarks, SongTrack, beat_marks, phase_palette

MAP = 430 * OVERSAMPLE
ROW_WIDTH = 800 * OVERSAMPLE  # of a row of the chart
ROW_HEIGHT = 92 * OVERSAMPLE
HEADER = 30 * OVERSAMPLE
ROW_SECONDS, MAX_ROWS = 20.0, 20
FACINGS = 12  # places on the path that show where the pelvis faces


def render_trajectory(
    trajectory: MotionTrajectory, path: str | Path, song: SongTrack | None = None, title: str = ""
) -> Path:
    """Draw one trajectory and save a PNG; raises UserError where it cannot be written."""
    song = song or SongTrack()
    marks = beat_marks(trajectory, song)
    seconds = trajectory.seconds
    rows = int(np.clip(np.ceil(seconds / ROW_SECONDS), 1, MAX_ROWS))
    sheet, draw = new_sheet(MAP + ROW_WIDTH + MARGIN, HEADER + max(MAP, rows * ROW_HEIGHT))
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
        sheet.paste(chart, (MAP, HEADER + row * ROW_HEIGHT))
    return save_sheet(sheet, Path(path))


def _phase_colours(phase: np.ndarray) -> np.ndarray:
    """RGB [T,3] for places in the bar [T]."""
    palette = phase_palette()
    return np.asarray(palette[(phase * len(palette)).astype(int) % len(palette)])


def _draw_path(trajectory: MotionTrajectory, colours: np.ndarray, marks: BeatMarks) -> Image.Image:
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
        draw.circle(points[frame], 3.5 * OVERSAMPLE, tuple(colours[frame]), INK, OVERSAMPLE)
    half = np.stack((np.sin(trajectory.heading), np.cos(trajectory.heading)), -1)
    for frame in np.linspace(0, len(points) - 1, min(FACINGS, len(points))).astype(int):
        radius = 4.5 * OVERSAMPLE if frame == 0 else 2 * OVERSAMPLE
        floor.draw_facing(draw, ground[frame], half[frame], radius)
    if len(marks.times):
        _draw_legend(draw, marks.meter)
    return image


def _draw_legend(draw: ImageDraw.ImageDraw, meter: int) -> None:
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
    span: tuple[float, float], speed: np.ndarray, colours: np.ndarray, marks: BeatMarks, fps: float
) -> Image.Image:
    """Speed between two times; a column of pixels shows the fastest of its frames."""
    image, draw = new_sheet(ROW_WIDTH + MARGIN, ROW_HEIGHT)
    top, floor = 14 * OVERSAMPLE, ROW_HEIGHT - 20 * OVERSAMPLE
    draw.rectangle((0, top, ROW_WIDTH, floor), FLOOR)
    highest = max(1.0, float(speed.max()))
    edges = np.clip(np.linspace(*span, ROW_WIDTH) * fps, 0, len(speed) - 1)
    stride = max(1, round(float(edges[1] - edges[0])))  # frames a column, where there are several
    peaks = np.stack([np.interp(edges + i, np.arange(len(speed)), speed) for i in range(stride)])
    line = floor - peaks.max(0) / highest * (floor - top)
    fills = np.rint(0.45 * colours[edges.astype(int)] + 0.55 * 255).astype(int)
    for column, (y, fill) in enumerate(zip(line, fills, strict=True)):
        draw.line([(column, y), (column, floor)], tuple(fill))
    draw.line(list(enumerate(line)), INK, OVERSAMPLE)
    shown = (marks.times >= span[0]) & (marks.times < span[1])
    crowded = shown.sum() * 4 * OVERSAMPLE > ROW_WIDTH
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
    draw.line([(0, top), (ROW_WIDTH, top)], GRID, OVERSAMPLE)
    draw.text((ROW_WIDTH - MARGIN, top), f"{highest:.2g} m/s", INK, pen, anchor="rt")
    return image


def _across(time: float, span: tuple[float, float]) -> float:
    return float((time - span[0]) / max(1e-9, span[1] - span[0]) * ROW_WIDTH)


FPS = 30.0
PIXELS_PER_SECOND = 12 * OVERSAMPLE
WIDTHS = (900 * OVERSAMPLE, 6000 * OVERSAMPLE)
LABELS = 90 * OVERSAMPLE
GAP = 10 * OVERSAMPLE
HEIGHTS = {"mel": 150, "chroma": 96, "mfcc": 60, "loudness": 70, "onsets": 70, "bar phase": 50}
RAMP = np.array([(20, 16, 48), (98, 32, 110), (205, 70, 84), (248, 165, 70), (252, 252, 190)])
BEAT, DOWNBEAT, CURVE, SECOND = (120, 150, 200), (200, 60, 90), (52, 58, 68), (224, 140, 40)


def plot_features(arrays: Mapping[str, np.ndarray], path: str | Path, *, title: str = "") -> Path:
    """Draw T frames of features (TECH section 4.2's names) with `beat_times` and `phase`; raises
    UserError where the file cannot be written."""
    seconds = arrays["mel"].shape[1] / FPS
    width = int(np.clip(seconds * PIXELS_PER_SECOND, *WIDTHS))
    panels = {name: height * OVERSAMPLE for name, height in HEIGHTS.items()}
    top = 26 * OVERSAMPLE
    height = top + sum(panels.values()) + GAP * len(panels) + 20 * OVERSAMPLE
    sheet, draw = new_sheet(LABELS + width + 4 * MARGIN, height)
    draw.text((MARGIN, MARGIN), title, INK, font(13 * OVERSAMPLE, title))
    for name, tall in panels.items():
        box = (LABELS + MARGIN, top, LABELS + MARGIN + width, top + tall)
        draw.text((MARGIN, top + tall / 2), name, INK, font(11 * OVERSAMPLE), anchor="lm")
        if name == "loudness":
            below = (MARGIN, top + tall / 2 + 15 * OVERSAMPLE)
            draw.text(below, "centroid", SECOND, font(11 * OVERSAMPLE), anchor="lm")
        if name in arrays:
            sheet.paste(_heatmap(arrays[name], width, tall), box[:2])
        else:
            draw.rectangle(box, (255, 255, 255))
            _draw_times(draw, box, seconds, arrays["beat_times"], BEAT)
            _draw_times(draw, box, seconds, arrays["downbeat_times"], DOWNBEAT)
            for rows, colour in _curves(name, arrays):
                _draw_curve(draw, box, rows, colour)
        top += tall + GAP
    _draw_clock(draw, (LABELS + MARGIN, top, LABELS + MARGIN + width, top), seconds)
    return save_sheet(sheet, Path(path))


def _curves(
    name: str, arrays: Mapping[str, np.ndarray]
) -> list[tuple[np.ndarray, tuple[int, int, int]]]:
    """The curves [T] of a panel, 0 to 1, and their colours."""
    if name == "loudness":
        return [(arrays["spectral_centroid"], SECOND), (arrays["rms"], CURVE)]
    if name == "onsets":
        return [(arrays["onset_strength"], CURVE)]
    return [(np.mod(arrays["phase"], 1.0), CURVE)]


def _heatmap(values: np.ndarray, width: int, height: int) -> Image.Image:
    """Rows [C,T], low ones at the bottom, as a picture."""
    low, high = np.quantile(values, [0.01, 0.99])
    level = np.clip((values - low) / max(float(high - low), 1e-6), 0, 1)[::-1]
    knots = np.linspace(0, 1, len(RAMP))
    pixels = np.stack([np.interp(level, knots, RAMP[:, c]) for c in range(3)], axis=-1)
    picture = Image.fromarray(pixels.astype(np.uint8))
    resampling = Image.Resampling.BOX if values.shape[1] > width else Image.Resampling.NEAREST
    return picture.resize((width, height), resampling)


def _draw_curve(
    draw: ImageDraw.ImageDraw,
    box: tuple[int, int, int, int],
    values: np.ndarray,
    colour: tuple[int, int, int],
) -> None:
    left, top, right, bottom = box
    x = left + (np.arange(len(values)) + 0.5) / len(values) * (right - left)
    y = bottom - np.clip(values, 0, 1) * (bottom - top)
    draw.line(list(zip(x.tolist(), y.tolist(), strict=True)), colour, OVERSAMPLE)


def _draw_times(
    draw: ImageDraw.ImageDraw,
    box: tuple[int, int, int, int],
    seconds: float,
    times: np.ndarray,
    colour: tuple[int, int, int],
) -> None:
    left, top, right, bottom = box
    for time in times:
        x = left + float(time) / seconds * (right - left)
        draw.line([(x, top), (x, bottom)], colour, OVERSAMPLE)


def _draw_clock(draw: ImageDraw.ImageDraw, box: tuple[int, int, int, int], seconds: float) -> None:
    """Seconds along the bottom, at most about twelve of them."""
    left, top, right, _ = box
    steps = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600)
    step = next((s for s in steps if seconds / s <= 12), 1200)
    for second in range(0, int(seconds) + 1, step):
        x = left + second / seconds * (right - left)
        label = f"{second // 60}:{second % 60:02d}"
        draw.text((x, top), label, INK, font(10 * OVERSAMPLE), anchor="ma")


def plot_trajectory(
    trajectory: MotionTrajectory, path: str | Path, *, max_jerk: float, title: str = ""
) -> Path:
    """A trajectory's six panels (TECH §14.2) as .png, .pdf or .svg: position, velocity, quaternion,
    phase, quaternion norm and jerk with the bound of its mean, over seconds of at least one frame.
    Raises UserError: matplotlib is missing, or the file cannot be written."""
    figure = new_figure(12, 10)
    panels = figure.subplots(3, 2, sharex=True).flat
    seconds = np.arange(trajectory.num_frames) / trajectory.fps
    phase = trajectory.phase.astype(np.float64)
    phase[1:][np.diff(trajectory.phase) < -0.5] = np.nan  # no line through the bar
    for axes, name, values, labels in zip(
        panels,
        ("Position, m", "Velocity, m/s", "Quaternion", "Phase of the bar"),
        (trajectory.position, trajectory.velocity, trajectory.quaternion, phase),
        ("xyz", "xyz", "wxyz", ""),
        strict=False,
    ):
        axes.plot(seconds, values, label=list(labels) or None)
        axes.set_title(name, loc="left")
        if labels:
            legend(axes)
    figure.axes[3].set_ylim(-0.05, 1.05)
    norm, jerk = figure.axes[4:]
    norm.plot(seconds, np.linalg.norm(trajectory.quaternion, axis=1))
    norm.axhline(1.0, color="red", linestyle="--")
    norm.set_title("Quaternion norm", loc="left")
    norm.set_ylim(0.8, 1.2)
    steps = np.diff(trajectory.acceleration, axis=0) * trajectory.fps
    jerk.plot(seconds[:-1], np.linalg.norm(steps, axis=1))
    jerk.axhline(max_jerk, color="red", linestyle="--")
    jerk.set_yscale("symlog", linthresh=1)
    jerk.set_title("Jerk, m/s³ (dashed: bound of its mean)", loc="left")
    for axes in figure.axes[4:]:
        axes.set_xlabel("seconds")
    figure.suptitle(title)
    return save_figure(figure, Path(path))
