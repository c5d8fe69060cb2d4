"""A picture of an analysed song: mel, chroma, loudness, onsets, beats and bar phase over time.

Takes the arrays of features.npz by name; needs Pillow, nothing else.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .drawing import INK, MARGIN, OVERSAMPLE, font, new_sheet, save_sheet

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

FPS = 30.0
PIXELS_PER_SECOND = 12 * OVERSAMPLE
WIDTHS = (900 * OVERSAMPLE, 6000 * OVERSAMPLE)
LABELS = 90 * OVERSAMPLE
GAP = 10 * OVERSAMPLE
HEIGHTS = {"mel": 150, "chroma": 96, "mfcc": 60, "loudness": 70, "onsets": 70, "bar phase": 50}
RAMP = np.array([(20, 16, 48), (98, 32, 110), (205, 70, 84), (248, 165, 70), (252, 252, 190)])
BEAT, DOWNBEAT, CURVE, SECOND = (120, 150, 200), (200, 60, 90), (52, 58, 68), (224, 140, 40)


def plot_features(arrays: Mapping[str, np.ndarray], path: str | Path, *, title: str = "") -> Path:
    """Draw T frames of features (TECH section 4.2's names) with `beat_times` and `phase`.

    Raises:
        UserError: the file cannot be written, or Pillow is not installed.
    """
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


def _heatmap(values: np.ndarray, width: int, height: int) -> "Image.Image":
    """Rows [C,T], low ones at the bottom, as a picture."""
    from PIL import Image

    low, high = np.quantile(values, [0.01, 0.99])
    level = np.clip((values - low) / max(float(high - low), 1e-6), 0, 1)[::-1]
    knots = np.linspace(0, 1, len(RAMP))
    pixels = np.stack([np.interp(level, knots, RAMP[:, c]) for c in range(3)], axis=-1)
    picture = Image.fromarray(pixels.astype(np.uint8))
    resampling = Image.Resampling.BOX if values.shape[1] > width else Image.Resampling.NEAREST
    return picture.resize((width, height), resampling)


def _draw_curve(
    draw: "ImageDraw.ImageDraw",
    box: tuple[int, int, int, int],
    values: np.ndarray,
    colour: tuple[int, int, int],
) -> None:
    left, top, right, bottom = box
    x = left + (np.arange(len(values)) + 0.5) / len(values) * (right - left)
    y = bottom - np.clip(values, 0, 1) * (bottom - top)
    draw.line(list(zip(x.tolist(), y.tolist(), strict=True)), colour, OVERSAMPLE)


def _draw_times(
    draw: "ImageDraw.ImageDraw",
    box: tuple[int, int, int, int],
    seconds: float,
    times: np.ndarray,
    colour: tuple[int, int, int],
) -> None:
    left, top, right, bottom = box
    for time in times:
        x = left + float(time) / seconds * (right - left)
        draw.line([(x, top), (x, bottom)], colour, OVERSAMPLE)


def _draw_clock(
    draw: "ImageDraw.ImageDraw", box: tuple[int, int, int, int], seconds: float
) -> None:
    """Seconds along the bottom, at most about twelve of them."""
    left, top, right, _ = box
    steps = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600)
    step = next((s for s in steps if seconds / s <= 12), 1200)
    for second in range(0, int(seconds) + 1, step):
        x = left + second / seconds * (right - left)
        label = f"{second // 60}:{second % 60:02d}"
        draw.text((x, top), label, INK, font(10 * OVERSAMPLE), anchor="ma")
