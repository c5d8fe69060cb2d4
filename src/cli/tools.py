"""The command line. Each command lives in its own file: it parses, calls, and prints.

Nothing heavy is imported here: `--help` and shell completion answer at once.
"""

import sys
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
from .features import features
from .generate import generate
from .memory import memory
from .models import calibrate, export_onnx, models
from .options import Command, SuiteCommand
from .prepare import prepare, prepare_audio
from .shape_check import shape_check
from .stream import stream
from .studio import studio
from .train import train

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
