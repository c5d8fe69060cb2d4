"""`train`: the training stages by name, each with the flags and settings of its own file."""

from collections.abc import Callable
from importlib import import_module

import typer

from .console import guarded

STAGES = {
    "clip": ("train_clip", "The text tower and the motion tower that share one space."),
    "generation": ("train_generation", "Motion from text, behind the text tower of `clip`."),
    "evaluator": ("train_evaluator", "The independent judge that `evaluate` asks."),
    "text": ("train_text", "A text tower that bears wordings it never saw."),
    "action": ("train_action", "A new action for a trained text model, from a few clips."),
    "distill": ("train_distill", "A text model of one or a few steps, from one of many."),
    "audio": ("train_audio", "Paths from music."),
    "decoder": ("train_decoder", "The decoder behind `audio`."),
    "finetune-e2e": ("finetune_e2e", "`audio` and `decoder` through the sampler, as one."),
    "audio-tower": ("train_audio_tower", "Sound in the space of `clip`."),
    "memory": ("train_memory", "An audio model that hears a memory."),
}

train = typer.Typer(
    no_args_is_help=True,
    help="Train a stage on your own data: settings are KEY=VALUE, Ctrl-C saves.",
    epilog="Example:  motion-tools train clip --data data/mine --output runs/clip",
    rich_markup_mode=None,
)


def stage(module: str) -> Callable[[typer.Context], None]:
    """The command that hands its arguments, --help among them, to a stage's own."""

    def run(context: typer.Context) -> None:
        """All of it is the stage's to read."""
        app = import_module(f"..train.{module}", __package__).app
        app(context.args, prog_name=context.command_path)

    return run


UNREAD = {"ignore_unknown_options": True, "allow_extra_args": True, "help_option_names": []}
for name, (module, about) in STAGES.items():
    train.command(name, help=about, context_settings=UNREAD)(guarded(stage(module)))
