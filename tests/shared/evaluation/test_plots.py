"""Pictures of trajectories and of logs in every form a run writes."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.errors import UserError
from src.shared.evaluation.plots import plot_losses, plot_trajectory, read_losses
from tests.shared.motion.trajectories import smooth_trajectory

pytest.importorskip("matplotlib")
ROWS = [{"step": 1, "loss": 4.0, "jerk": 2.0}, {"step": 2, "loss": 3.0}, {"step": 3, "loss": 2.5}]


@pytest.mark.parametrize("num_frames", [1, 90])
def test_a_trajectory_becomes_six_panels(num_frames: int, tmp_path: Path) -> None:
    path = plot_trajectory(smooth_trajectory(1, num_frames), tmp_path / "a.png", title="a")
    with Image.open(path) as picture:
        assert picture.size == (1200, 1000)
        assert len(np.unique(np.asarray(picture.convert("L")))) > 10


@pytest.mark.parametrize(
    "text",
    [
        "".join(json.dumps(row) + "\n" for row in ROWS),
        "".join(json.dumps(row) + "\n" for row in ROWS) + '{"step": 4, "lo',
        json.dumps(ROWS),
        json.dumps({"run": "audio", "epochs": ROWS}),
        json.dumps({"step": [1, 2, 3], "loss": [4.0, 3.0, 2.5], "jerk": [2.0]}),
    ],
)
def test_logs_of_every_form(text: str, tmp_path: Path) -> None:
    (tmp_path / "log.json").write_text(text, encoding="utf-8")
    history = read_losses(tmp_path / "log.json")
    assert history["step"] == [1, 2, 3] and history["loss"] == [4.0, 3.0, 2.5]
    assert history["jerk"][0] == 2 and np.isnan(history["jerk"][1:]).all()
    path = plot_losses(history, tmp_path / "losses.svg")
    assert b"jerk" in path.read_bytes() or path.stat().st_size > 5000


def test_epochs_count_as_steps(tmp_path: Path) -> None:
    (tmp_path / "training_log.json").write_text('[{"epoch": 5, "total": null, "jerk": 1e-3}]')
    assert read_losses(tmp_path / "training_log.json") == {"step": [5], "jerk": [1e-3]}


@pytest.mark.parametrize("text", ["", "no json", "[]", "[1, 2]", '"text"'])
def test_what_is_no_log_is_named(text: str, tmp_path: Path) -> None:
    (tmp_path / "log.jsonl").write_text(text, encoding="utf-8")
    with pytest.raises(UserError, match="is not the log of a run"):
        read_losses(tmp_path / "log.jsonl")
    with pytest.raises(UserError, match="no numbers"):
        plot_losses({"step": [1.0]}, tmp_path / "a.png")
    with pytest.raises(UserError, match="cannot be read"):
        read_losses(tmp_path / "none.jsonl")
