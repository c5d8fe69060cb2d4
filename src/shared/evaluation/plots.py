"""Plots of TECH §14.2: a trajectory's six panels, and the losses of a training run.

matplotlib is imported when a plot is drawn; no window is opened.
"""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UserError
from ..io.files import atomic_write, parse_json
from ..metrics.sanity import SanityThresholds
from ..motion.trajectory import MotionTrajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOSSES = (
    "loss", "diffusion", "decoder-position", "velocity-coherence", "accel-coherence", "jerk",
)  # fmt: skip
MAX_PANELS = 12
FORMATS = ("png", "pdf", "svg")


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
            _legend(axes)
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


def plot_losses(
    history: Mapping[str, Sequence[float]], path: str | Path, *, title: str = ""
) -> Path:
    """A curve for each loss of `read_losses` on a logarithmic scale, as .png, .pdf or .svg; TECH's
    six losses come first where the run has them.
    Raises UserError: nothing to draw, matplotlib is missing, or the file cannot be written."""
    panels: dict[str, list[str]] = {name: [] for name in LOSSES}
    for name in (name for name in history if name != "step"):  # validation/loss beside loss
        panels.setdefault(name.rpartition("/")[2], []).append(name)
    panels = dict([(name, curves) for name, curves in panels.items() if curves][:MAX_PANELS])
    if not panels:
        raise UserError(
            f"cannot write {path}: the log holds no numbers to draw; name the log of a run"
        )
    columns = min(3, len(panels))
    rows = math.ceil(len(panels) / columns)
    figure = new_figure(5 * columns, 3.6 * rows)
    for index, (panel, names) in enumerate(panels.items()):
        axes = figure.add_subplot(rows, columns, index + 1)
        for name in names:
            values = np.asarray(history[name], dtype=np.float64)
            known = np.isfinite(values)  # evaluations come more rarely than steps
            steps = np.asarray(history["step"])[known]
            label = name.rpartition("/")[0] or "training"
            axes.plot(steps, values[known], marker="." if known.sum() < 50 else "", label=label)
            if known.any():
                axes.set_yscale("log" if values[known].min() > 0 else "symlog")
        axes.set_title(panel, loc="left")
        axes.set_xlabel("step")
        if len(names) > 1:
            _legend(axes)
    figure.suptitle(title)
    return save_figure(figure, Path(path))


def read_losses(path: str | Path) -> dict[str, list[float]]:
    """The numbers of a run's log.jsonl or training_log.json by name, NaN where a step has none.
    Raises UserError: missing, or neither of them."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise UserError(
            f"{path}: cannot be read: {error}; name a log.jsonl or training_log.json"
        ) from error
    try:
        rows = _rows(text)
    except ValueError as error:
        raise UserError(
            f"{path}: is not the log of a run ({error}); name a log.jsonl or training_log.json"
        ) from error
    names = {name for row in rows for name, value in row.items() if _is_number(value)}
    order = [name for name in dict.fromkeys(key for row in rows for key in row) if name in names]
    history = {
        name: [float(row[name]) if _is_number(row.get(name)) else math.nan for row in rows]
        for name in order
    }
    return {"step": [float(number) for number in range(len(rows))]} | history


def _rows(text: str) -> list[dict[str, Any]]:
    """The figures of each step or epoch, under the names that log.jsonl has for them."""
    try:
        content = parse_json(text)
    except ValueError:  # more than one object: a line each, the last maybe cut off by a kill
        lines = text.splitlines()
        whole = lines if text.endswith("\n") else lines[:-1]
        content = [parse_json(line) for line in whole if line.strip()]
    rows = content if isinstance(content, list) else [content]
    if not rows or not all(isinstance(row, dict) for row in rows):
        raise ValueError("it holds no rows")
    return [_flat(row) for row in rows]


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """An entry of training_log.json with its two tables in one: `loss`, `validation/loss`."""
    flat = {name: value for name, value in row.items() if name != "epoch"}
    for table, prefix in (("train", ""), ("validation", "validation/")):
        found = flat.pop(table, None)
        if isinstance(found, dict):
            flat |= {prefix + name: value for name, value in found.items()}
    return flat


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return isinstance(value, float) or abs(value) < 2**1000  # a float holds it


def _legend(axes: "Axes") -> None:
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
