"""`shape-check --model audio` shows every block of UNet1D and both decoders, and counts them."""

import json
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli.tools import app

runner = CliRunner()
TINY = [
    "unet.model-channels=32",
    "unet.channel-mult=[1, 2]",
    "unet.num-head-channels=16",
    "unet.attention-resolutions=[2]",
    "decoder.hidden-dim=16",
]


def check(*arguments: str) -> dict[str, Any]:
    result = runner.invoke(app, ["shape-check", "--model", "audio", "--json", *arguments])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)  # type: ignore[no-any-return]


def stage(result: dict[str, Any], name: str) -> dict[str, Any]:
    return next(stage for stage in result["stages"] if stage["stage"] == name)


def test_lightweight_is_the_references_network() -> None:
    result = check("--network-profile", "lightweight")
    assert result["agree"]
    assert stage(result, "UNet1D")["input"] == stage(result, "UNet1D")["output"] == [2, 25, 48]
    assert stage(result, "UNet1D")["parameters"] == 22_391_424
    assert stage(result, "AudioConditioner")["parameters"] == 314_432
    assert stage(result, "middle ResBlock 1")["output"] == [2, 512, 6]  # 512 channels at T/8
    assert stage(result, "MotionDecoder")["parameters"] == 1_591_835
    assert stage(result, "DerivedMotionDecoder")["parameters"] == 419_346
    attentions = {row["stage"] for row in result["stages"] if "Attention" in row["stage"]}
    assert attentions == {"down 2 Attention", "middle Attention", "up 2 Attention"}


def test_blocks_add_up_to_the_network() -> None:
    result = check(*TINY)
    rows = [row for row in result["stages"] if row["network"] == "UNet1D"]
    parts = sum(row["parameters"] for row in rows[:-1])
    apart = stage(result, "AudioConditioner")["parameters"]
    norm, null = 2 * 32, 167  # of the output, and the learned null condition
    assert rows[-1]["parameters"] == parts + apart + norm + null


@pytest.mark.parametrize("conditioning", ["film", "cross-attention"])
def test_conditioning_shows_its_own_stages_only(conditioning: str) -> None:
    result = check(f"unet.conditioning={conditioning}", *TINY)
    names = {row["stage"] for row in result["stages"]}
    assert ("AudioConditioner" in names) == (conditioning == "film")
    assert ("audio context" in names) == (conditioning == "cross-attention")


def test_the_table_names_profile_and_letters() -> None:
    result = runner.invoke(app, ["shape-check", "--model", "audio", *TINY])
    assert result.exit_code == 0
    assert result.stdout.startswith("profile default: B=2 T=24 T/2=12 T/4=6 C=32 2C=64")
    assert "down 1 Attention" in result.stdout and "stages agree" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--model", "audoi"], "choose text or audio"),
        (["--model", "audio", "--full"], "--full belongs to the text branch"),
        (["--model", "audio", "--no-root-track"], "--root-track belongs to the text branch"),
        (["--model", "audio", "unet.num-head=2"], "nearest valid key is unet.num-heads"),
        (["--model", "audio", "--network-profile", "defualt"], "unknown profile 'defualt'"),
    ],
)
def test_mistakes_are_named(arguments: list[str], message: str) -> None:
    result = runner.invoke(app, ["shape-check", *arguments])
    assert result.exit_code != 0
    assert message in str(result.exception) + result.output
