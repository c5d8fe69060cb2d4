"""The command line that every training stage shares: parse, check, train, report."""

import os
import shlex
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from ..shared.config_loader import (
    load_audio_network,
    load_network,
    load_train,
    split_network_overrides,
)
from ..shared.config_schema import Config, TrainConfig
from ..shared.errors import UserError
from ..shared.signals import orderly_termination
from ..shared.sole_writer import sole_writer
from .processes import Interrupted, end_with_parent, is_one_of_several, run_processes

if TYPE_CHECKING:
    from .task import Task

ConfigT = TypeVar("ConfigT", bound=TrainConfig)
Builder = Callable[[ConfigT, Any], "Task"]  # settings and network
NetworkLoader = Callable[..., Config]  # profile, file, overrides
Processes = Annotated[
    int | None,
    typer.Option("--num-processes", help="processes on this machine, such as one a GPU"),
]


def resume_command(module: str, arguments: list[str]) -> str:
    """The shell command that continues the run started with these arguments."""
    kept = [argument for argument in arguments if argument != "--resume"]
    by_command = kept[:1] == ["train"]  # `motion-tools train STAGE`
    launcher = ["motion-tools"] if by_command else ["accelerate", "launch", "-m", module]
    return shlex.join([*launcher, *kept, "--resume"])


def run_task(
    settings: ConfigT, build: Callable[[ConfigT], "Task"], *, module: str, resume: bool
) -> None:
    """Train in this process, or in as many as the settings ask for and nobody has launched yet.

    Raises:
        UserError, Interrupted: see `Trainer`.
        typer.Exit: one of several processes failed, and has said why.
    """
    if (settings.processes or 1) > 1 and not is_one_of_several():
        raise typer.Exit(run_processes(settings.processes or 1))
    end_with_parent()
    main = os.environ.get("RANK", "0") == "0"  # of the processes of one run
    with sole_writer(settings.output) if main else nullcontext():
        from .engine import Trainer  # every check that needs no torch comes before this

        command = resume_command(module, sys.argv[1:])
        Trainer(settings, build, command=command, resume=resume).train()


def new_app() -> typer.Typer:
    """An application for the one command of a stage."""
    return typer.Typer(
        add_completion=False,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )


def stage_app(
    model_class: type[ConfigT],
    build: Builder[ConfigT],
    module: str,
    about: str,
    *,
    audio: bool = False,
) -> typer.Typer:
    """A typer application with the flags of a training stage.

    Args:
        model_class: configuration of the stage.
        build: makes its task.
        module: of the stage.
        about: help text.
        audio: profiles are those of audio_network.yaml.
    """
    load: NetworkLoader = load_audio_network if audio else load_network
    networks = "audio_network.yaml" if audio else "network.yaml"
    app = new_app()
    name = module.removeprefix("src.train.train_").replace("_", "-")
    example = f"Example: motion-tools train {name} --network-profile lightweight steps=500"

    @app.command(help=f"{about}\n\n{example}")
    def train(
        overrides: Annotated[
            list[str] | None, typer.Argument(metavar="KEY=VALUE", help="settings to change")
        ] = None,
        config: Annotated[Path | None, typer.Option(help="YAML file of settings")] = None,
        data: Annotated[str | None, typer.Option(help="prepared folder, or: synthetic")] = None,
        output: Annotated[str | None, typer.Option(help="folder of this run")] = None,
        network_profile: Annotated[str | None, typer.Option(help=f"profile of {networks}")] = None,
        network_file: Annotated[Path | None, typer.Option(help=f"another {networks}")] = None,
        processes: Processes = None,
        resume: Annotated[
            bool, typer.Option("--resume", help="continue the run in output")
        ] = False,
    ) -> None:
        flags = {
            "data": data, "output": output, "profile": network_profile, "processes": processes
        }  # fmt: skip
        with short_errors():
            given = [*(overrides or []), *as_overrides(flags)]
            own, network_overrides = split_network_overrides(given)
            settings = load_train(config, model_class, own)
            network = load(settings.profile, network_file, network_overrides)
            run_task(settings, lambda c: build(c, network), module=module, resume=resume)

    return app


@contextmanager
def short_errors() -> Iterator[None]:
    """One line on stderr and an exit code for what a user can do something about."""
    try:
        with orderly_termination():
            yield
    except Interrupted as stop:
        raise _leave(str(stop), stop.exit_code) from None
    except UserError as error:
        raise _leave(f"error: {error}", error.exit_code) from None
    except OSError as error:
        what = f"{error.filename or 'a file of this run'}: {error.strerror or error}"
        raise _leave(f"error: cannot read or write {what}", 1) from None
    except KeyboardInterrupt:
        raise _leave("stopped at once, without saving", 130) from None


def as_overrides(flags: Mapping[str, str | float | None]) -> list[str]:
    """Flags that were given, as `key=value`; a text such as `7` stays a text."""
    return [
        f"{key}={_quoted(value) if isinstance(value, str) else value}"
        for key, value in flags.items()
        if value is not None
    ]


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _leave(message: str, code: int) -> typer.Exit:
    print(message, file=sys.stderr)
    return typer.Exit(code)
