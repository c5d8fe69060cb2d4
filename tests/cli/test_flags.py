"""The public flags are a promise: whoever changes one changes this list, and the changelog."""

import ast
import inspect
import re
import sys
from typing import Any

import pytest
import typer
from typer.main import get_command

from src.cli.evaluate import Request
from src.cli.generate_request import Request as GenerateRequest
from src.cli.tools import app
from src.shared.formats.registry import EXPORTERS
from src.train.launch import STAGES

FLAGS = {
    "generate": (
        "--audio --body --body-model --device --edit --end --figures --follow-path --foot-lock"
        " --format --from --guidance-scale --joints --json --judge --keep --loop --memory"
        " --meter --model --no-figures --no-foot-lock --num-samples --out --path"
        " --post-processing --prompt --prompts --resume --return-all --runtime --sampler"
        " --seconds --seed --start --steps --style --tag --then --threads --timeline --to"
    ),
    "convert": (
        "--asf --format --fps --json --mapping --names --resume --root --scheduler --skeleton"
        " --source-fps --unit --up --workers FILES"
    ),
    "inspect": ("--json --mapping --skeleton --source-fps --unit --up --write-mapping FILE"),
    "features": "--cache --cache-dir --chroma --json --meter --no-cache --out --plot SONG",
    "prepare": (
        "--captions --json --labels --mapping --mirror --no-mirror --only-gaps --out --scheduler"
        " --seed --skeleton --source-fps --synthetic --templates --unit --up --workers SOURCE"
    ),
    "prepare-audio": (
        "--json --max-seconds --meter --min-seconds --motion --music --no-synthetic-clips --out"
        " --passes --scheduler --seed --synthetic-clips --workers"
    ),
    "shape-check": (
        "--device --full --json --model --network-file --network-profile --no-root-track"
        " --root-track OVERRIDES"
    ),
    "evaluate": (
        "--control-seeds --data --device --evaluator --guidance-scale --json --model --num-samples"
        " --num-songs --out --quick --replications --sampler --seed --song-seconds --songs --steps"
        " --suite --threads"
    ),
    "evaluate-audio": (
        "--data --decoder-checkpoint --device --diffusion-checkpoint --guidance-scale --hear-meter"
        " --json --model --num-songs --out --quick --replications --sampler --seed --song-seconds"
        " --songs --steps --tell-meter --threads --track-seconds"
    ),
    "evaluate-memory": (
        "--data --device --guidance-scale --json --memory --model --num-phrases --num-songs --out"
        " --sampler --seed --shares --song-seconds --space --splits --steps --threads --top-k"
    ),
    "evaluate-performer": (
        "--audio-model --clips --dances --data --device --edits --evaluator --guidance-scale --json"
        " --model --num-songs --other --out --quick --replications --sampler --seed"
        " --song-seconds --songs --steps --style-songs --threads --track-seconds"
    ),
    "evaluate-requests": (
        "--data --json --languages --model --out --seconds --seed --steps --threads --wordings"
    ),
    "evaluate-sanity": (
        "--data --decoder-checkpoint --device --diffusion-checkpoint --json --model --num-frames"
        " --num-samples --num-steps --output-dir --quick --seed --threads"
    ),
    "evaluate-selection": (
        "--branch --data --device --evaluator --guidance-scale --json --judge --model"
        " --num-candidates --num-subjects --out --replications --sampler --seed --steps --threads"
        " --unseen"
    ),
    "evaluate-space": (
        "--bars --batch --data --json --model --out --quick --replications --seed --split --text"
        " --threads"
    ),
    "report": "--json FOLDER",
    "calibrate": "--data --json --model --seed --threads --tries",
    "compare": (
        "--control-seeds --data --device --evaluator --json --num-samples --num-songs --other-row"
        " --out --quick --replications --row --seed --steps --threads A B"
    ),
    "export-onnx": "--json --model --out",
    "stream": (
        "--device --foot-lock --guidance-scale --json --model --no-foot-lock --no-real-time"
        " --prompt --real-time --root --sampler --seconds --seed --steps --threads --vmc"
        " --websocket --window"
    ),
    "studio": "--json --model --no-open --out --steps",
    "memory build": (
        "--bars --figures --json --out --scheduler --space --split --takes --threads --workers DATA"
    ),
    "memory query": "--json --memory --meter --model --space --threads --top-k ASK",
    "models": "--json",
    "models pull": "--force --json --out NAME",
    "models push": "--dataset --dry-run --json --licence --message --private MODEL REPO",
    "plot": "--out FILE",
}


def all_commands(app: typer.Typer) -> dict[str, Any]:
    """Every command by name; those of a group as `group command`."""
    found = {}
    for name, command in get_command(app).commands.items():  # type: ignore[attr-defined]
        inner = {**getattr(command, "commands", {})}
        if not inner or command.invoke_without_command:
            inner[""] = command
        found |= {f"{name} {part}".strip(): one for part, one in inner.items()}
    return found


def public_flags(app: typer.Typer) -> dict[str, str]:
    """Each command's options and, in capitals, its arguments."""
    return {
        name: " ".join(
            sorted(
                flag
                for parameter in command.params
                for flag in (
                    [*parameter.opts, *parameter.secondary_opts]
                    if parameter.param_type_name == "option"
                    else [parameter.name.upper()]
                )
            )
        )
        for name, command in all_commands(app).items()
    }


def test_flags_are_frozen() -> None:
    """--quiet is every command's; the stages of `train` read their own (test_train_command.py)."""
    stages = {f"train {stage}": "" for stage in STAGES}
    rest = {name: f"--quiet {flags} -q" for name, flags in FLAGS.items()}
    found = {name: sorted(flags.split()) for name, flags in public_flags(app).items()}
    assert found == {name: sorted(flags.split()) for name, flags in (rest | stages).items()}


def test_every_flag_has_a_help_text() -> None:
    for command in all_commands(app).values():
        for parameter in command.params:
            assert parameter.help, f"{command.name} {parameter.name}"


def test_flags_are_used() -> None:
    """A flag that is parsed and ignored would not show up in the function's code."""
    groups = [group.typer_instance for group in app.registered_groups]
    commands = [one for part in (app, *groups) for one in part.registered_commands]  # type: ignore[union-attr]
    for registered in commands:
        function = inspect.unwrap(registered.callback)  # type: ignore[arg-type]
        body = function.__code__.co_names + function.__code__.co_varnames
        source = inspect.getsource(function).partition('"""')[2]
        passed_on = set(Request.__dataclass_fields__) if {"locals", "Request"} <= {*body} else set()
        for name in inspect.signature(function).parameters.keys() - passed_on:
            assert name in body and name in source, f"{function.__name__}: {name}"


@pytest.mark.parametrize(
    ("request_of", "modules"),
    [
        (Request, ["src.cli.evaluate"]),
        (GenerateRequest, ["src.cli.generate", "src.cli.generate_request"]),
    ],
)
def test_every_field_of_a_request_is_read(request_of: Any, modules: list[str]) -> None:
    """By its own name, or by one in a list of names; that it is declared is not enough."""
    read = {
        node.attr if isinstance(node, ast.Attribute) else node.value
        for module in modules
        for part in ast.parse(inspect.getsource(sys.modules[module])).body
        if getattr(part, "name", "") != "evaluate"
        for node in ast.walk(part)
        if isinstance(node, ast.Attribute | ast.Constant)
    }
    assert not set(request_of.__dataclass_fields__) - read


@pytest.mark.parametrize("command", ["generate", "convert"])
def test_help_names_every_format(command: str) -> None:
    """Typed by hand, for the table of writers imports too much for `--help`."""
    options = {option.name: option for option in all_commands(app)[command].params}
    named = set(re.findall(r"[a-z0-9]+", options["format"].help))
    assert set(EXPORTERS) <= named
