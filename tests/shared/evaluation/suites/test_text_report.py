"""The text branch from model folders to a report folder: complete, resumable, the same bytes."""

import json
import shutil
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
import torch

from src.shared.data.prepare import prepare
from src.shared.data.sources import SyntheticSource
from src.shared.evaluation.pages import save_report
from src.shared.evaluation.suites.text import TextSettings, evaluate_text
from src.shared.evaluation.tables import grids
from src.shared.model.evaluator import Evaluator, EvaluatorConfig
from tests.shared.model.conftest import tiny_generator

SETTINGS = TextSettings(
    num_samples=8,
    replications=2,
    untrained=1,
    max_real=12,
    max_frames=32,
    language_samples=0,
    control_seeds=1,
    languages=("en",),
    worst=2,
)


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    root = tmp_path_factory.mktemp("text")
    tiny_generator().save_pretrained(root / "model")
    torch.manual_seed(0)
    Evaluator(EvaluatorConfig(hidden_size=16, num_buckets=64)).save_pretrained(root / "judge")
    prepare([SyntheticSource(60, seed=1)], root / "data")
    return {name: str(root / name) for name in ("model", "judge", "data")}


def run(folders: dict[str, str], out: Path, **given: Any) -> None:
    report = evaluate_text(
        folders["model"],
        folders["data"],
        evaluator=folders["judge"],
        settings=SETTINGS,
        device="cpu",
        folder=out,
        **given,
    )
    save_report(report, out)


@pytest.fixture(scope="module")
def first(folders: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("first")
    run(folders, out)
    return out


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != "timing.json")
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def test_every_table_has_its_floors_and_says_how_much(first: Path) -> None:
    report = json.loads((first / "report.json").read_text())
    tables = {grid.name: grid for grid in grids(report)}
    split = next(name.split("/")[0] for name in tables if name.endswith("/retrieval"))
    rows = tables[f"{split}/retrieval"].rows
    assert list(rows) == ["real", "chance", "frozen pose", "generated", "untrained"]
    assert (rows["generated"].num, rows["generated"].replications) == (8, 2)
    assert rows["untrained"].replications == 1
    assert f"{split}/feet and floor" in tables and "controllability" in tables
    manifest = json.loads((first / "manifest.json").read_text())
    assert set(manifest["model"]) >= {"config.json", "model.safetensors"}
    assert manifest["evaluator"] and manifest["statistics"] and manifest["data"][split]
    assert manifest["environment"]["packages"]["torch"] == version("torch")
    assert len(report["samples"]) >= 2 and "iframe" in (first / "report.html").read_text()


def test_a_second_run_gives_the_same_bytes(
    folders: dict[str, str], first: Path, tmp_path: Path
) -> None:
    run(folders, tmp_path)
    again = contents(tmp_path)
    assert again.keys() == contents(first).keys()
    for name, content in contents(first).items():
        assert again[name] == content, name


def test_a_stopped_run_goes_on_to_the_same_bytes(
    folders: dict[str, str], first: Path, tmp_path: Path
) -> None:
    shutil.copytree(first, tmp_path, dirs_exist_ok=True)
    for path in (tmp_path / "parts").glob("*.001.json"):
        path.unlink()
    (tmp_path / "parts" / "controllability.json").unlink()
    (tmp_path / "report.json").unlink()
    told: list[str] = []
    run(folders, tmp_path, progress=told.append)
    assert not [line for line in told if line.startswith("controllability")], "by language"
    rows = ("real", "chance", "generated")
    missing = [f"unseen: {row}, 2 of 2" for row in rows]  # of "seen" this data has no clips
    assert [line for line in told if line.startswith("unseen")] == missing
    assert contents(tmp_path) == contents(first)
