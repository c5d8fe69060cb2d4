"""What a training run reports: log.jsonl, TensorBoard, progress on stderr; read back, and drawn."""

import json
import math
import os
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from ..shared.errors import UserError
from ..shared.formats.preview.drawing import legend, new_figure, save_figure
from ..shared.io.files import atomic_write, parse_json

VALIDATION = "validation/"  # begins the names of figures that are not of training

console = Console(stderr=True, highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """One line on stderr, from the main process alone; for tasks, which know no accelerator."""
    if os.environ.get("RANK", "0") == "0":
        console.print(text, markup=False)


def truncate_log(path: Path, step: int, *, validate: bool = False) -> None:
    """Drop what resuming writes again.

    Args:
        path: log.jsonl.
        step: entries after it go, and a line that a kill cut off.
        validate: the figures of `step` itself go, too.
    """
    if not path.exists():
        return
    kept = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            entry = json.loads(line)
            again = validate and any(key.startswith(VALIDATION) for key in entry)
            if entry["step"] < step + (not again):
                kept.append(line)
        except (ValueError, KeyError, TypeError):
            continue
    with atomic_write(path) as temporary:
        temporary.write_text("".join(line + "\n" for line in kept), encoding="utf-8")


def as_logged(value: float) -> float:
    """The number that log.jsonl holds for a value."""
    return float(f"{value:.6g}")


def _tensorboard_writer(folder: Path, start: int) -> Any:
    """A SummaryWriter that hides points after `start`."""
    # TensorBoard would load TensorFlow where it is installed, for seconds and for nothing
    os.environ.setdefault("TF_CPP_MIN_LOG_LEVEL", "3")
    from torch.utils.tensorboard import SummaryWriter

    return SummaryWriter(log_dir=str(folder), purge_step=start + 1 if start else None)


class RunLog:
    """Scalars of one run; a context manager, silent on all processes but the main one."""

    def __init__(
        self,
        folder: Path,
        *,
        start: int,
        steps: int,
        main: bool,
        tensorboard: bool,
        validate: bool = False,
    ) -> None:
        """Open the log where a run goes on; `validate`: the figures of `start` come again."""
        self._main = main
        self._seconds = time.perf_counter()
        self._start, self._steps = start, steps
        self._interactive = main and sys.stderr.isatty()
        self._writer: Any | None = None
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
            console=console,
            disable=not self._interactive,
        )
        self._bar = self._progress.add_task("training", total=steps, completed=start)
        if main:
            # a new run keeps nothing
            truncate_log(folder / "log.jsonl", start or -1, validate=validate)
            self._stream = (folder / "log.jsonl").open("a", encoding="utf-8")
            self._writer = (
                _tensorboard_writer(folder / "tensorboard", start) if tensorboard else None
            )

    def __enter__(self) -> "RunLog":
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()
        if self._main:
            self._stream.close()
        if self._writer is not None:
            self._writer.close()

    def advance(self, step: int) -> None:
        """Move the progress bar to a finished step."""
        if self._interactive:
            self._progress.update(self._bar, completed=step)

    def write(self, step: int, values: dict[str, float]) -> None:
        """One line of log.jsonl, the same in TensorBoard, and a short form on stderr.

        Not-finite values (an undefined metric) are written as null, which JSON has.
        """
        if not self._main or not values:
            return
        rounded = {k: as_logged(v) if math.isfinite(v) else None for k, v in values.items()}
        print(json.dumps({"step": step, **rounded}), file=self._stream, flush=True)
        for key, value in rounded.items():
            if self._writer is not None and value is not None:
                self._writer.add_scalar(key, value, step)
        text = "  ".join(f"{key} {value:.4g}" for key, value in values.items())
        if self._interactive and "loss" in values:
            self._progress.update(self._bar, description=f"loss {values['loss']:.4f}")
        else:
            announce(f"step {step} of {self._steps}  {text}{self._left(step)}")

    def _left(self, step: int) -> str:
        """Of the time that a run will take, as its steps so far tell."""
        if not self._start < step < self._steps:
            return ""
        each = (time.perf_counter() - self._seconds) / (step - self._start)
        seconds = each * (self._steps - step)
        left = f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"
        return f"  about {left} left"


ROWS = {  # of the table: figure, name
    "loss": "Total loss",
    "velocity-coherence": "Velocity coherence",
    "accel-coherence": "Accel coherence",
    "jerk": "Jerk",
    "quat-delta": "Quaternion delta",
    "decoder-position": "Decoder position",
    "decoder-quaternion": "Decoder quaternion",
    "quaternion-pass-rate": "Quaternion pass rate",
    "mean-speed": "Mean speed, m/s",
}


@dataclass(frozen=True)
class Epoch:
    """An entry of training_log.json: means of one epoch; 0 is what was there before training.

    Attributes:
        epoch: whole passes done.
        step: optimizer steps done.
        train: means over the epoch's batches; empty before training.
        validation: figures of held-back phrases.
    """

    epoch: int
    step: int
    train: dict[str, float]
    validation: dict[str, float]

    @property
    def loss(self) -> float:
        """The total on held-back phrases; infinite where it was not a number."""
        value = self.validation.get("loss")
        return math.inf if value is None else value


def read_epochs(log: Path, steps_per_epoch: int) -> list[Epoch]:
    """The validated epochs of a log.jsonl, first to last; none where there is no log."""
    if not log.exists():
        return []
    train: dict[int, dict[str, float]] = {}
    validation: dict[int, dict[str, float]] = {}
    for line in log.read_text(encoding="utf-8").splitlines():
        entry = json.loads(line)
        step = entry.pop("step")
        checked = {k.removeprefix(VALIDATION): v for k, v in entry.items() if VALIDATION in k}
        if checked:
            validation[step] = checked
        else:
            train[step] = entry
    return [
        Epoch(math.ceil(step / steps_per_epoch), step, train.get(step, {}), figures)
        for step, figures in sorted(validation.items())
    ]


def best_epoch(epochs: Sequence[Epoch]) -> Epoch:
    """The first one with the smallest total."""
    return min(epochs, key=lambda epoch: epoch.loss)


def results_table(epochs: Sequence[Epoch], kept: Epoch) -> str:
    """TECH 7.5 in Markdown: before training, the first, the last and the kept epoch."""
    first = next((epoch for epoch in epochs if epoch.epoch > 0), epochs[0])
    columns = {
        "before": epochs[0],
        f"epoch {first.epoch}": first,
        f"epoch {epochs[-1].epoch}": epochs[-1],
        f"kept: epoch {kept.epoch}": kept,
    }
    lines = [
        "| held-back phrases | " + " | ".join(columns) + " | before / kept |",
        "|---|" + "---:|" * (len(columns) + 1),
    ]
    for key, name in ROWS.items():
        values = [epoch.validation.get(key) for epoch in columns.values()]
        if values[0] is None:  # a term of weight 0
            continue
        ratio = f"{values[0] / values[-1]:.3g}" if values[-1] else "-"
        cells = ["-" if value is None else f"{value:.4g}" for value in values]
        lines.append(f"| {name} | {' | '.join(cells)} | {ratio} |")
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------- the losses of a run, drawn

LOSSES = (
    "loss", "diffusion", "decoder-position", "velocity-coherence", "accel-coherence", "jerk",
)  # fmt: skip
MAX_PANELS = 12


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
            legend(axes)
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
