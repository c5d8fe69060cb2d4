"""One of two processes: stages as DDP and as FSDP2, and halves of runs; see the test."""

import sys
from collections.abc import Callable
from pathlib import Path

from tiny_audio_stage import audio_config, train_audio
from tiny_stage import generation_config, train_generation

from src.train import text_stages

Run = Callable[..., object]
KINDS = {"audio": ("ddp", "fsdp"), "text": ("ddp", "fsdp")}
EVERY = ("log-every=1", "save-every=2", "lr-schedule=constant", "validate-every=100")


def runs(circles: Path, prepared: Path, clip: Path) -> dict[str, Run]:
    """By name, what trains in a folder with settings: songs, and text that is streamed.

    A step is of eight clips by two processes.
    """
    text = ("batch-size=4", "stream=true", *EVERY)
    return {
        "audio": lambda output, *more, resume=False: train_audio(
            audio_config(circles, output, *EVERY, *more), resume=resume
        ),
        "text": lambda output, *more, resume=False: train_generation(
            generation_config(prepared, clip, output, *text, *more), resume=resume
        ),
    }


def main(folder: Path, *data: Path) -> None:
    """Of each stage and kind a whole run, and one that goes on from one process."""
    text_stages.CALIBRATING = 300
    for stage, train in runs(*data).items():
        for name in KINDS[stage]:
            kind = f"fsdp-version={2 if name == 'fsdp' else 'null'}"
            train(folder / stage / name, kind)
            train(folder / stage / f"one-half-{name}", kind, resume=True)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
