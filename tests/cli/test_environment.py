"""MOTIONGEN_* variables: the flag counts first, then the variable, then the default."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli import evaluate, evaluate_suites
from src.cli.tools import app
from src.shared import environment
from src.shared.evaluation.suites import sanity


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What reaches the evaluation instead of running it."""
    found: list[dict[str, Any]] = []

    def load(name: str, decoder: str | None, device: str) -> None:
        found.append({"model": name, "decoder": decoder, "device": device})

    def evaluate(model: None, **options: Any) -> None:
        found[-1].update(options)
        raise KeyboardInterrupt  # enough

    monkeypatch.setattr(evaluate_suites, "load_generator", load)
    monkeypatch.setattr(sanity, "evaluate_sanity", evaluate)
    return found


def run(*arguments: str, **variables: str) -> Any:
    return CliRunner().invoke(app, ["evaluate-sanity", *arguments], env=variables)


def test_defaults(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    assert run("--output-dir", str(tmp_path)).exit_code == 130
    assert calls[0]["model"] == "starter-audio" and calls[0]["device"] == "auto"
    assert calls[0]["decoder"] is None and calls[0]["data"] is None
    settings = calls[0]["settings"]
    assert (settings.num_samples, settings.num_frames, settings.num_steps) == (100, 120, 20)


def test_quick_and_flags(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    run("--quick", "--num-samples", "7", "--output-dir", str(tmp_path))
    settings = calls[0]["settings"]
    assert (settings.num_samples, settings.num_frames, settings.num_steps) == (7, 120, 10)


def test_variables_come_before_defaults(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    variables = {
        environment.DEVICE: "cpu",
        environment.OUTPUT_DIR: str(tmp_path),
        environment.DATA_DIR: str(tmp_path),
        environment.DIFFUSION_CHECKPOINT: "runs/a",
        environment.DECODER_CHECKPOINT: "runs/b",
    }
    run(**variables)
    assert calls[0]["model"] == "runs/a" and calls[0]["decoder"] == "runs/b"
    assert calls[0]["device"] == "cpu" and calls[0]["data"] == str(tmp_path)


@pytest.mark.parametrize("flag", ["--model", "--diffusion-checkpoint"])
def test_flags_come_before_variables(
    calls: list[dict[str, Any]], tmp_path: Path, flag: str
) -> None:
    variables = {environment.DEVICE: "mps", environment.DIFFUSION_CHECKPOINT: "runs/a"}
    run(flag, "runs/c", "--device", "cpu", "--output-dir", str(tmp_path), **variables)
    assert calls[0]["model"] == "runs/c" and calls[0]["device"] == "cpu"


def test_an_empty_variable_is_none(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    run("--output-dir", str(tmp_path), **{environment.DEVICE: "", environment.DATA_DIR: ""})
    assert calls[0]["device"] == "auto" and calls[0]["data"] is None


def test_the_names_are_techs() -> None:
    ours = ("AUDIO_MODEL", "TEXT_MODEL", "BLENDER")
    names = {v for k, v in vars(environment).items() if k.isupper() and k not in ours}
    assert names == {
        f"MOTIONGEN_{name}"
        for name in (
            *("DEVICE", "OUTPUT_DIR", "DATA_DIR"),
            *("DIFFUSION_CHECKPOINT", "DECODER_CHECKPOINT"),
        )
    }


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["evaluate-sanity", "--num-frames", "3"], "--num-frames 3 is out of range"),
        (["evaluate-sanity", "--num-samples", "0"], "--num-samples 0 is out of range"),
        (["evaluate-sanity", "--data", "nowhere"], "--data nowhere is no folder"),
        (["evaluate-sanity", "--output-dir", "/proc/none"], "--output-dir /proc/none: cannot"),
        (["evaluate-sanity", "--seed", "-1"], "--seed -1 is out of range"),
        (["evaluate-audio", "--num-songs", "1"], "--num-songs 1 is out of range"),
        (["evaluate-audio", "--song-seconds", "1"], "--song-seconds 1 is out of range"),
        (["evaluate-audio", "--songs", "nowhere"], "--songs nowhere is no folder"),
        (["evaluate-audio", "--data", "nowhere"], "--data nowhere is no folder"),
        (["evaluate-audio", "--steps", "0"], "--steps 0 is out of range"),
    ],
)
def test_wrong_arguments_are_usage_errors(arguments: list[str], message: str) -> None:
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2 and message in result.output


def test_no_such_model_is_one_line(tmp_path: Path) -> None:
    for command, flag in (("evaluate-audio", "--out"), ("evaluate-sanity", "--output-dir")):
        result = CliRunner().invoke(app, [command, "--model", "nosuch", flag, str(tmp_path)])
        assert result.exit_code == 2 and "no model named 'nosuch'" in result.output
    assert evaluate.MODEL == evaluate_suites.MODEL == "starter-audio"
