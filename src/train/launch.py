"""The training stages as commands: their flags and settings, and how a run of one starts.

Nothing here needs PyTorch before a run starts: help and wrong settings are told without it.
"""

import inspect
import os
import shlex
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any, get_args

import typer

from ..shared.config_audio import (
    FinetuneE2eConfig,
    TrainAudioConfig,
    TrainAudioTowerConfig,
    TrainDecoderConfig,
    TrainMemoryConfig,
)
from ..shared.config_loader import (
    load_audio_network,
    load_network,
    load_train,
    recipe_network,
    split_network_overrides,
)
from ..shared.config_schema import (
    Config,
    TrainActionConfig,
    TrainClipConfig,
    TrainConfig,
    TrainDistillConfig,
    TrainEvaluatorConfig,
    TrainGenerationConfig,
    TrainTextConfig,
)
from ..shared.errors import UserError
from ..shared.io.concurrency import orderly_termination
from ..shared.io.files import sole_writer
from .processes import Interrupted, end_with_parent, is_one_of_several, run_processes

DATA = "prepared folder, or: synthetic"
PAIRS = "folder or bucket of prepare-audio, or: synthetic"


@dataclass(frozen=True)
class Stage:
    """One training stage.

    Attributes:
        config: its settings.
        module: where it is, and what `accelerate launch -m` calls it, without the package.
        task: what the module calls that which makes a `Task` of settings and network.
        about: help text.
        audio: it learns from pairs, and profiles are those of audio_network.yaml.
        init: for a stage that goes on from a trained model: the setting that names it, and the
            module's `network_of` knows its network; "" where the user chooses a profile.
        flags: settings with a flag of their own, `key: help text`, or `key: (flag, help text)`.
        example: arguments of the example in the help text.
        complete: what the module calls that which adds to settings what follows from the data.
    """

    config: type[TrainConfig]
    module: str
    task: str
    about: str
    audio: bool = False
    init: str = ""
    flags: Mapping[str, str | tuple[str, str]] = field(default_factory=dict)
    example: str = "--network-profile lightweight steps=500"
    complete: str = ""

    def run(
        self,
        overrides: Sequence[str],
        file: Path | None = None,
        network_file: Path | None = None,
        *,
        resume: bool = False,
    ) -> None:
        """Train in this process, or in as many as the settings ask for and nobody has launched yet.

        Args:
            overrides: `key=value`, those of the network as `network.key=value`.
            file: YAML of settings, or the name of a recipe; None = what ships.
            network_file: another network.yaml or audio_network.yaml.
            resume: continue the run in the output folder.

        Raises:
            UserError, Interrupted: see `Trainer`.
            typer.Exit: one of several processes failed, and has said why.
        """
        own, given = split_network_overrides(overrides)
        settings = load_train(file, self.config, own)
        network_overrides = [*recipe_network(file, self.config), *given]
        if self.init:
            network = self.part("network_of")(getattr(settings, self.init), network_overrides)
        else:
            load: Callable[..., Config] = load_audio_network if self.audio else load_network
            network = load(settings.profile, network_file, network_overrides)
        if self.complete:
            settings = self.part(self.complete)(settings)
        if (settings.processes or 1) > 1 and not is_one_of_several():
            raise typer.Exit(run_processes(settings.processes or 1))
        if find_spec("torch") is None:  # the lock below lacks in the same installation
            raise ModuleNotFoundError("no PyTorch", name="torch")
        end_with_parent()
        main = os.environ.get("RANK", "0") == "0"  # of the processes of one run
        with sole_writer(settings.output) if main else nullcontext():
            from .engine import Trainer  # every check that needs no torch comes before this

            task = self.part(self.task)
            module = self.module if "." in self.module else f"{__package__}.{self.module}"
            command = resume_command(module, sys.argv[1:])
            trainer = Trainer(settings, lambda c: task(c, network), command=command, resume=resume)
            try:
                trainer.train()
            finally:  # threads of it must not outlive the interpreter
                trainer.accelerator.end_training()

    def part(self, name: str) -> Any:
        """What the stage's module calls so; that is when PyTorch is imported."""
        return getattr(import_module(f".{self.module}", __package__), name)

    def app(self) -> typer.Typer:
        """The stage's command: KEY=VALUE, its flags, and those of every stage."""
        networks = "audio_network.yaml" if self.audio else "network.yaml"
        flags: dict[str, str | tuple[str, str]] = {
            "data": PAIRS if self.audio else DATA,
            "output": "folder of this run",
            **self.flags,
        }
        if not self.init:
            flags["profile"] = ("--network-profile", f"profile of {networks}")
        flags["processes"] = ("--num-processes", "processes on this machine, such as one a GPU")
        keys = {key.replace("-", "_").replace(".", "__"): key for key in flags}

        def train(**given: Any) -> None:
            settings = as_overrides({key: given[name] for name, key in keys.items()})
            files = given["config"], given.get("network_file")
            with short_errors():
                self.run([*(given["overrides"] or []), *settings], *files, resume=given["resume"])

        settings = typer.Argument(metavar="KEY=VALUE", help="settings to change")
        parameters = [
            _parameter("overrides", list[str] | None, settings),
            _parameter(
                "config",
                Path | None,
                typer.Option(help="YAML file of settings, or recipe: default, spark"),
            ),
        ]
        for name, key in keys.items():
            named = flags[key]
            flag, about = (f"--{key}", named) if isinstance(named, str) else named
            kind = _kind(self.config, key)
            parameters.append(_parameter(name, kind, typer.Option(flag, help=about)))
        if not self.init:
            file = typer.Option(help=f"another {networks}")
            parameters.append(_parameter("network_file", Path | None, file))
        resume = typer.Option("--resume", help="continue the run in output")
        parameters.append(_parameter("resume", bool, resume, default=False))
        train.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        app = typer.Typer(
            add_completion=False,
            rich_markup_mode=None,
            pretty_exceptions_enable=False,
            context_settings={"help_option_names": ["-h", "--help"]},
        )
        stage = self.module.rpartition(".")[2].removeprefix("train_").replace("_", "-")
        example = f"Example: motion-tools train {stage} {self.example}"
        app.command(help=f"{self.about}\n\n{example}")(train)
        return app


def _parameter(name: str, kind: Any, about: Any, default: Any = None) -> inspect.Parameter:
    annotation = Annotated[kind, about]
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation
    )


def _kind(model_class: type[Config], key: str) -> Any:
    """Type of the flag of a setting: str, int or float, or None."""
    first, _, rest = key.replace("-", "_").partition(".")
    kind = model_class.model_fields[first].annotation
    if rest:
        assert isinstance(kind, type) and issubclass(kind, Config)
        return _kind(kind, rest)
    return next(one for one in (*get_args(kind), kind) if one is not type(None)) | None


def resume_command(module: str, arguments: list[str]) -> str:
    """The shell command that continues the run started with these arguments."""
    kept = [argument for argument in arguments if argument != "--resume"]
    by_command = kept[:1] == ["train"]  # `motion-tools train STAGE`
    launcher = ["motion-tools"] if by_command else ["accelerate", "launch", "-m", module]
    return shlex.join([*launcher, *kept, "--resume"])


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


STAGES = {
    "clip": Stage(
        TrainClipConfig,
        "train_clip",
        "ClipTask",
        "Train the text tower and the motion tower that share one space.",
    ),
    "generation": Stage(
        TrainGenerationConfig,
        "train_generation",
        "GenerationTask",
        "Train the motion denoiser behind the frozen text tower of a `clip` run.",
    ),
    "evaluator": Stage(
        TrainEvaluatorConfig,
        "train_evaluator",
        "task_of",
        "Train the evaluator: an independent text-motion model that scores generated motions.",
    ),
    "text": Stage(
        TrainTextConfig,
        "train_text",
        "TextTask",
        "Harden a trained text tower against wordings it never saw; its space stays as it is.",
    ),
    "action": Stage(
        TrainActionConfig,
        "train_action",
        "ActionTask",
        "Teach a trained text model a new action from a few clips; the old ones stay.",
        init="init",
        flags={"init": "the model that learns"},
        example="--data data/mine --init starter --output runs/mine",
    ),
    "distill": Stage(
        TrainDistillConfig,
        "train_distill",
        "DistillTask",
        "Teach a copy of a text model to sample in few steps, without guidance.",
        init="init",
        flags={"init": "the teacher"},
        example="--data data/mine --init starter --output runs/quick",
    ),
    "audio": Stage(
        TrainAudioConfig,
        "train_audio",
        "AudioTask",
        "Train the trajectory UNet on pairs of sound and motion.",
        audio=True,
    ),
    "decoder": Stage(
        TrainDecoderConfig,
        "train_decoder",
        "DecoderTask",
        "Train the decoder behind an `audio` run.",
        audio=True,
        init="audio",
        flags={"audio": "folder of a train_audio run"},
        example="--audio runs/audio --data pairs",
    ),
    "finetune-e2e": Stage(
        FinetuneE2eConfig,
        "finetune_e2e",
        "FinetuneE2eTask",
        "Fine-tune UNet, sampler and decoder as one.",
        audio=True,
        init="checkpoint",
        flags={
            "checkpoint": "folder with the UNet",
            "decoder-checkpoint": "folder with the decoder; default: the checkpoint",
            "epochs": "passes over the phrases",
            "num-phrases": "take the first so many",
            "batch-size": "phrases a step and process",
            "lr-diffusion": "of the UNet",
            "lr-decoder": "of the decoder",
            "diffusion-weight": "of the diffusion loss",
            "decoder-weight": "of the reconstruction",
            "temporal-weight": "of the coherence terms",
            "patience": "epochs without a better total before stopping",
        },
        example="--checkpoint runs/decoder --data pairs",
        complete="in_steps",
    ),
    "audio-tower": Stage(
        TrainAudioTowerConfig,
        "train_audio_tower",
        "AudioTowerTask",
        "Train the tower that puts sound into the space of texts and motions.",
    ),
    "memory": Stage(
        TrainMemoryConfig,
        "train_memory",
        "MemoryTask",
        "Teach a trained audio model to hear a memory.",
        audio=True,
        init="audio",
        flags={
            "audio": "audio model that learns",
            "memory.folder": ("--memory", "folder or address of `tools memory build`"),
            "space": "shared space of the memory's keys",
        },
        example="--memory runs/memory --data pairs",
    ),
}
