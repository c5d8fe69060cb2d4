"""`shape-check` agrees with the document's tables, counts real parameters, and can fail."""

import json
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli import shape_tables
from src.cli.tools import app

runner = CliRunner()
SMALL_XLM_R = [
    "clip.text-model=small",
    "clip.text-hidden-size=16",
    "clip.text-num-layers=1",
    "clip.text-vocab-size=100",
]


def check(*arguments: str) -> dict[str, Any]:
    result = runner.invoke(app, ["shape-check", "--json", *arguments])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)  # type: ignore[no-any-return]


def stage(result: dict[str, Any], name: str) -> dict[str, Any]:
    return next(stage for stage in result["stages"] if stage["stage"] == name)


def test_default_profile_without_root_track_has_the_documents_shapes() -> None:
    """B x T x K x 6 in, B x T x K x 4 out, and the tables' Linear layers in between."""
    result = check("--no-root-track")
    assert result["letters"] == dict(B=2, T=40, K=22, C=6, D=128, H=4, L=3, S=100)
    whole = stage(result, "MotionDenoiser")
    assert whole["input"] == whole["output"] == [2, 40, 22, 6]
    assert stage(result, "quaternion")["output"] == [2, 40, 22, 4]
    assert stage(result, "motionProj")["parameters"] == (22 * 6 + 1) * 128
    assert stage(result, "textProj")["parameters"] == 129 * 128
    assert stage(result, "timestepEmbed")["parameters"] == 129 * 512 + 513 * 128
    assert stage(result, "block 3 FiLM")["parameters"] == (2 * 128 + 1) * 2 * 128
    assert not any(stage["stage"].startswith("block 4") for stage in result["stages"])


def test_root_track_adds_one_row() -> None:
    result = check("--network-profile", "lightweight")
    assert stage(result, "MotionDenoiser")["output"] == [2, 40, 23, 6]
    assert stage(result, "quaternion")["output"] == [2, 40, 22, 4]


def test_full_adds_both_towers() -> None:
    fast, full = check(*SMALL_XLM_R), check("--full", "--device", "cpu", *SMALL_XLM_R)
    networks = {stage["network"] for stage in full["stages"]}
    assert networks - {stage["network"] for stage in fast["stages"]} == {
        "CLIP text",
        "CLIP motion",
        "CLIP",
    }
    assert stage(full, "XLM-Roberta")["output"] == [2, 12, 16]
    assert stage(full, "TemporalUNet")["output"] == [2, 128]
    assert full["agree"]


def test_hub_sizes_count_what_the_hub_models_count() -> None:
    """XLM-R base: 278,043,648 parameters with its pooler (768 x 769), which TEXT does not use."""
    import torch

    from src.shared.config_loader import load_network
    from src.shared.model.clip.core import TextTower

    clip = shape_tables.without_download(load_network("default").clip)
    with torch.device("meta"):
        tower = TextTower(clip, 128)
    assert shape_tables.count(tower.encoder) == 278_043_648 - 768 * 769


def test_other_channels_skip_the_renormalisation() -> None:
    names = {stage["stage"] for stage in check("generation.motion-channels=5")["stages"]}
    assert "smoothing" in names
    assert not {"renormalization", "quaternion", "velocity clamp"} & names


def test_token_conditioning_shows_its_cross_attention() -> None:
    result = check("generation.text-conditioning=tokens", "generation.num-layers=1")
    assert stage(result, "block 1 CrossAttention")["output"] == [2, 40, 128]


def test_a_wrong_shape_is_named_and_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = [shape_tables.Row("output_norm", "LayerNorm", "B x T x D", "B x T x C")]
    monkeypatch.setattr(shape_tables, "denoiser_rows", lambda *_: wrong)
    result = runner.invoke(app, ["shape-check"])
    assert result.exit_code == 1
    assert "MISMATCH: 2 x 40 x 128 -> 2 x 40 x 6" in result.stdout
    assert "1 of" in result.stdout and "differ" in result.stdout
