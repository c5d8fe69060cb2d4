"""The epochs of a run, read from its log: training_log.json, patience, the table of TECH 7.5.

A pure function of log.jsonl, so that a resumed run needs no state of its own.
"""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .run_log import VALIDATION

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
    """Means of one epoch; number 0 is what was there before training.

    Attributes:
        number: whole passes done.
        step: optimizer steps done.
        train: means over the epoch's batches; empty before training.
        validation: figures of held-back phrases.
    """

    number: int
    step: int
    train: dict[str, float]
    validation: dict[str, float]

    @property
    def loss(self) -> float:
        """The total on held-back phrases; infinite where it was not a number."""
        value = self.validation.get("loss")
        return math.inf if value is None else value

    def as_json(self) -> dict[str, Any]:
        """One entry of training_log.json."""
        return {
            "epoch": self.number,
            "step": self.step,
            "train": self.train,
            "validation": self.validation,
        }


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
    first = next((epoch for epoch in epochs if epoch.number > 0), epochs[0])
    columns = {
        "before": epochs[0],
        f"epoch {first.number}": first,
        f"epoch {epochs[-1].number}": epochs[-1],
        f"kept: epoch {kept.number}": kept,
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
