"""Same seed, same motion: PyTorch, and onnxruntime with NumPy, in every mode without gradients."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.model import onnx_card
from src.shared.model.checkpoint import PRETRAINED, list_models, read_card
from src.shared.model.onnx_card import ONNX_CARD, OnnxCard, chosen_runtime
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.pipelines.every_mode import NAMES, modes

pytest.importorskip("onnxruntime")

ROOT = Path(__file__).parents[3]
EXPORTED = sorted(path.parent for path in PRETRAINED.glob(f"*/{ONNX_CARD}"))


@pytest.fixture(scope="module")
def light(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("light")
    script = Path(__file__).with_name("every_mode.py")
    result = subprocess.run(
        [sys.executable, str(script), str(folder)],
        capture_output=True, text=True, cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"},
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return folder


@pytest.fixture(scope="module")
def with_torch() -> dict[str, Callable[[], list[Any]]]:
    return modes(MotionGenerator(device="cpu", runtime="torch"))


def test_nothing_heavy_is_imported(light: Path) -> None:
    assert (light / "imported.txt").read_text() == ""


@pytest.mark.parametrize("name", NAMES)
def test_same_seed_same_motion(
    light: Path, with_torch: dict[str, Callable[[], list[Any]]], name: str
) -> None:
    wanted = with_torch[name]()
    with np.load(light / f"{name}.npz") as found:
        quaternions = np.concatenate([each.quaternions for each in wanted])
        np.testing.assert_allclose(found["quaternions"], quaternions, atol=1e-3)
        root = np.concatenate([each.root_position for each in wanted])
        np.testing.assert_allclose(found["root"], root, atol=1e-3)


@pytest.mark.parametrize("folder", EXPORTED, ids=lambda path: path.name)
def test_shipped_graphs_are_those_of_the_shipped_weights(folder: Path) -> None:
    """New weights: `motion-tools export-onnx --model NAME --out src/shared/pretrained/NAME`."""
    kind = {"motion-generator": onnx_card.TextOnnxCard, "audio-motion": onnx_card.AudioOnnxCard}
    card: OnnxCard = onnx_card.read_onnx_card(folder, kind[read_card(folder).kind])
    assert card.model == read_card(folder).content_hash and card.trained


def test_every_shipped_generator_is_exported() -> None:
    shipped = [row["name"] for row in list_models(runs=False) if row["kind"] in onnx_card.EXPORTED]
    assert [folder.name for folder in EXPORTED] == shipped


def test_auto_is_onnx_where_it_can_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert chosen_runtime("auto", "starter", "cpu") == "onnx"
    assert chosen_runtime("auto", "starter", "cuda") == "torch"
    assert chosen_runtime("torch", "starter", "cpu") == "torch"
    assert chosen_runtime("auto", tmp_path, "cpu") == "torch"
    monkeypatch.setattr(onnx_card, "find_spec", lambda name: None)
    assert chosen_runtime("auto", "starter", "cpu") == "torch"


def test_a_model_without_graphs_says_how_to_make_them(tmp_path: Path) -> None:
    shutil.copy(PRETRAINED / "starter" / "config.json", tmp_path)
    with pytest.raises(UserError, match=f"`export-onnx --model {tmp_path} --out DIR`"):
        _ = MotionGenerator(tmp_path, device="cpu", runtime="onnx").text


def test_graphs_of_other_weights_are_refused(tmp_path: Path) -> None:
    shutil.copytree(PRETRAINED / "starter", tmp_path / "model")
    shutil.copy(PRETRAINED / "starter-free" / ONNX_CARD, tmp_path / "model")
    with pytest.raises(UserError, match="other weights"):
        _ = MotionGenerator(tmp_path / "model", device="cpu", runtime="onnx").text
