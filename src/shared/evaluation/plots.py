"""A trajectory's six panels (TECH §14.2), and what draws every picture of a report.

matplotlib is imported when a plot is drawn; no window is opened.
"""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import UserError
from ..io.files import atomic_write
from ..metrics.sanity import SanityThresholds
from ..motion.trajectory import MotionTrajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_trajectory(trajectory: MotionTrajectory, path: str | Path, *, title: str = "") -> Path:
    """Position, velocity, quaternion, phase, quaternion norm and jerk over the seconds of at least
    one frame, as .png, .pdf or .svg.
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
    jerk.axhline(SanityThresholds().max_jerk, color="red", linestyle="--")
    jerk.set_yscale("symlog", linthresh=1)
    jerk.set_title("Jerk, m/s³ (dashed: bound of its mean)", loc="left")
    for axes in figure.axes[4:]:
        axes.set_xlabel("seconds")
    figure.suptitle(title)
    return save_figure(figure, Path(path))


def legend(axes: "Axes") -> None:
    """In a line above the panel, right of its title."""
    axes.legend(
        loc="lower right", bbox_to_anchor=(1, 1), ncols=4, fontsize="small", frameon=False,
        borderaxespad=0,
    )  # fmt: skip


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure of so many inches. Raises UserError: matplotlib is missing."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise UserError(
            "plots need matplotlib, which is not installed; run `pip install matplotlib`"
        ) from error
    return Figure(figsize=(width, height), layout="constrained")


def save_figure(figure: "Figure", path: Path) -> Path:
    """Write .png, .pdf or .svg, whole or not at all.
    Raises UserError: the file cannot be written."""
    ending = path.suffix.removeprefix(".").lower()
    with atomic_write(path) as temporary:
        figure.savefig(temporary, format=ending or "png", dpi=100)
    return path
