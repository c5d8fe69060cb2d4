"""A plot of the audio evaluation: phase against beats.

matplotlib is imported when a plot is drawn; no window is opened.
"""

from pathlib import Path

import numpy as np

from ..motion.trajectory import FPS
from .audio_context import Picture
from .report.plots import new_figure, save_figure

LINES = {"truth": ("black", "-"), "beat tracker": ("tab:blue", ":"), "generated": ("tab:red", "--")}


def plot_phase(picture: Picture, path: str | Path) -> Path:
    """Bar phases over the beats, and the pelvis's speed with its beats, over seconds.

    Raises:
        UserError: matplotlib is missing, or the file cannot be written.
    """
    figure = new_figure(14, 6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for axes in (upper, lower):
        axes.vlines(picture.beats, 0, 1, transform=axes.get_xaxis_transform(), color="0.8", lw=1)
    for name, bars in picture.bars.items():
        colour, style = LINES[name]
        upper.plot(np.arange(len(bars)) / FPS, _sawtooth(bars), style, color=colour, label=name)
    upper.set_ylabel("phase of the bar")
    upper.set_ylim(0, 1)
    upper.legend(loc="upper right", ncols=3, fontsize="small")
    speed, times = picture.motion.speed, picture.motion.times
    at = (np.arange(len(speed)) + 0.5) / FPS
    lower.plot(at, speed, color="tab:red")
    lower.plot(times, np.interp(times, at, speed), "v", color="black", label="motion beats")
    lower.set_ylabel("smoothed speed of the pelvis, m/s")
    lower.set_xlabel("seconds; grey: beats of the song")
    lower.legend(loc="upper right", fontsize="small")
    figure.suptitle(picture.name)
    return save_figure(figure, Path(path))


def _sawtooth(bars: np.ndarray) -> np.ndarray:
    """Bars [T] modulo 1 with a gap where they wrap, so that no line is drawn through."""
    phase = np.asarray(bars, np.float64) % 1.0
    phase[1:][np.diff(phase) < -0.5] = np.nan
    return phase
