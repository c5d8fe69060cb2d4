"""The command line. Each command lives in a file of its subject: it parses, calls, and prints;
the stages of `train` have the flags and settings of their own files.

Nothing heavy is imported here: `--help` and shell completion answer at once.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from .console import INTERRUPTED, guarded, results_on_stdout, with_quiet
from .convert import convert, inspect
from .evaluate import compare, evaluate, evaluate_audio, plot, report
from .evaluate_suites import (
    evaluate_memory,
    evaluate_performer,
    evaluate_requests,
    evaluate_sanity,
    evaluate_selection,
    evaluate_space,
)
from .generate import generate
from .memory import memory
from .models import calibrate, export_onnx, models, shape_check, studio
from .options import Command, SuiteCommand
from .prepare import features, prepare, prepare_audio
from .stream import stream

PROGRAM = "motion-tools"

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    # Completion calls the program by its name, which `python -m` does not have.
    add_completion=Path(sys.argv[0]).stem == PROGRAM,
    help="From a prompt to a moving character, and from your own mocap to your own model.",
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog=f'Start here:  {PROGRAM} generate --prompt "a person waves"',
)

TRAINED = {  # what the stages of `train.launch` make, told without reading their settings
    "clip": "The text tower and the motion tower that share one space.",
    "generation": "Motion from text, behind the text tower of `clip`.",
    "evaluator": "The independent judge that `evaluate` asks.",
    "text": "A text tower that bears wordings it never saw.",
    "action": "A new action for a trained text model, from a few clips.",
    "distill": "A text model of one or a few steps, from one of many.",
    "audio": "Paths from music.",
    "decoder": "The decoder behind `audio`.",
    "finetune-e2e": "`audio` and `decoder` through the sampler, as one.",
    "audio-tower": "Sound in the space of `clip`.",
    "memory": "An audio model that hears a memory.",
}

train = typer.Typer(
    no_args_is_help=True,
    help="Train a stage on your own data: settings are KEY=VALUE, Ctrl-C saves.",
    epilog="Example:  motion-tools train clip --data data/mine --output runs/clip",
    rich_markup_mode=None,
)


def stage(name: str) -> Callable[[typer.Context], None]:
    """The command that hands its arguments, --help among them, to a stage's own."""

    def run(context: typer.Context) -> None:
        """All of it is the stage's to read."""
        from ..train.launch import STAGES

        STAGES[name].app()(context.args, prog_name=context.command_path)

    return run


def show_version(wanted: bool) -> None:
    """Name and version of the package, and nothing else."""
    if wanted:
        from importlib.metadata import version

        print(f"{PROGRAM} {version('motionsuite')}")
        raise typer.Exit


@app.callback()
def before_commands(
    version: Annotated[
        bool,
        typer.Option("--version", callback=show_version, is_eager=True, help="Show it and exit."),
    ] = False,
) -> None:
    """Options of the program itself; what it is for stands above."""


for command in (
    generate,
    convert,
    features,
    inspect,
    prepare,
    prepare_audio,
    shape_check,
    evaluate,
    evaluate_audio,
    evaluate_memory,
    evaluate_performer,
    evaluate_sanity,
    evaluate_selection,
    evaluate_requests,
    evaluate_space,
    calibrate,
    report,
    compare,
    plot,
    export_onnx,
    studio,
    stream,
):
    kind = SuiteCommand if command is evaluate else Command
    app.command(cls=kind)(with_quiet(guarded(command)))
UNREAD = {"ignore_unknown_options": True, "allow_extra_args": True, "help_option_names": []}
for name, about in TRAINED.items():
    train.command(name, help=about, context_settings=UNREAD)(guarded(stage(name)))
app.add_typer(memory, name="memory")
app.add_typer(models, name="models")
app.add_typer(train, name="train")


def main() -> None:
    """Entry point of the console script."""
    try:
        with results_on_stdout():
            app()
    except KeyboardInterrupt:  # before there was a command to answer it
        sys.exit(INTERRUPTED)


if __name__ == "__main__":
    main()
