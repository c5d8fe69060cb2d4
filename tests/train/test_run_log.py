"""Logs in every form a run writes, read back and drawn."""

import json
import math
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.io.files import write_json
from src.train.run_log import Epoch, plot_losses, read_losses

pytest.importorskip("matplotlib")
ROWS = [{"step": 1, "loss": 4.0, "jerk": 2.0}, {"step": 2, "loss": 3.0}, {"step": 3, "loss": 2.5}]


@pytest.mark.parametrize(
    "text",
    [
        "".join(json.dumps(row) + "\n" for row in ROWS),
        "".join(json.dumps(row) + "\n" for row in ROWS) + '{"step": 4, "lo',
    ],
)
def test_a_log_that_grows_or_was_cut_off(text: str, tmp_path: Path) -> None:
    (tmp_path / "log.jsonl").write_text(text, encoding="utf-8")
    history = read_losses(tmp_path / "log.jsonl")
    assert history["step"] == [1, 2, 3] and history["loss"] == [4.0, 3.0, 2.5]
    assert history["jerk"][0] == 2 and np.isnan(history["jerk"][1:]).all()
    path = plot_losses(history, tmp_path / "losses.svg")
    assert b"jerk" in path.read_bytes() or path.stat().st_size > 5000


def test_the_epochs_of_a_run_draw_both_curves_of_each_loss(tmp_path: Path) -> None:
    """As `finetune_e2e` writes them: the epoch before training has no training losses."""
    epochs = [
        Epoch(0, 0, {}, {"loss": 4.0, "jerk": 2.0}),
        Epoch(1, 3, {"loss": 3.5, "learning-rate": 1e-3}, {"loss": 3.0, "jerk": 1.0}),
        Epoch(2, 6, {"loss": 2.5, "learning-rate": 1e-4}, {"loss": math.nan, "jerk": 0.5}),
    ]
    write_json(tmp_path / "training_log.json", [asdict(epoch) for epoch in epochs])
    history = read_losses(tmp_path / "training_log.json")
    assert history.pop("step") == [0, 3, 6]
    assert set(history) == {"loss", "learning-rate", "validation/loss", "validation/jerk"}
    np.testing.assert_equal(history["loss"], [math.nan, 3.5, 2.5])
    np.testing.assert_equal(history["validation/loss"], [4.0, 3.0, math.nan])
    picture = plot_losses(history | {"step": [0, 3, 6]}, tmp_path / "losses.svg").read_text()
    assert picture.count('id="axes_') == 3, "a panel for loss, jerk and learning-rate"
    assert picture.count('id="legend_') == 1, "training and validation share the panel of the loss"


@pytest.mark.parametrize("text", ["", "no json", "[]", "[1, 2]", '"text"'])
def test_what_is_no_log_is_named(text: str, tmp_path: Path) -> None:
    (tmp_path / "log.jsonl").write_text(text, encoding="utf-8")
    with pytest.raises(UserError, match="is not the log of a run"):
        read_losses(tmp_path / "log.jsonl")
    with pytest.raises(UserError, match="no numbers"):
        plot_losses({"step": [1.0]}, tmp_path / "a.png")
    with pytest.raises(UserError, match="cannot be read"):
        read_losses(tmp_path / "none.jsonl")
