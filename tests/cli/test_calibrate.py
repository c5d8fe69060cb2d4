"""`calibrate` writes into a folder of one's own, and into nothing else."""

import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.data.prepare import prepare
from src.shared.data.sources import SyntheticSource
from src.shared.evaluation import actions
from src.shared.model.checkpoint import resolve_model
from src.shared.model.clip.out_of_domain import OutOfDomainDetector


@pytest.mark.parametrize("model", ["starter", "nowhere"])
def test_what_is_no_folder_of_ones_own_is_refused_before_the_work(
    model: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(actions, "action_reliability", lambda *a, **k: pytest.fail("it began"))
    result = CliRunner().invoke(app, ["calibrate", "--model", model, "--data", "data"])
    assert result.exit_code == 2 and f"--model {model} is no model folder" in result.output
    assert not list(tmp_path.iterdir())


def test_the_shares_stand_beside_the_weights(tmp_path: Path) -> None:
    model = tmp_path / "model"
    shutil.copytree(resolve_model("starter"), model)
    prepare([SyntheticSource(16)], tmp_path / "data", workers=1)
    given = ["--model", str(model), "--data", str(tmp_path / "data"), "--tries", "1"]
    result = CliRunner().invoke(app, ["calibrate", *given, "--threads", "1", "--json"])
    assert result.exit_code == 0, result.output
    assert not list(model.glob("*calibration*"))
    found = OutOfDomainDetector.from_pretrained(model)
    assert found is not None and found.reliability
    assert set(found.reliability.values()) <= {1 / 3, 2 / 3}  # missed once, shown once
    before = OutOfDomainDetector.from_pretrained(resolve_model("starter"))
    assert before is not None and found.weights == before.weights
