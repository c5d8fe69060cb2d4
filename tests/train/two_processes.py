"""One of two processes: the audio stage as DDP and as FSDP2, and halves of runs; see the test."""

import sys
from pathlib import Path

from tiny_audio_stage import audio_config, train_audio


def main(circles: Path, folder: Path) -> None:
    """Two whole runs, and two that go on from one process."""
    for name, version in (("ddp", "null"), ("fsdp", "2")):
        kind = f"fsdp-version={version}"
        train_audio(audio_config(circles, folder / name, *EVERY, kind))
        half = folder / f"one-half-{name}"
        train_audio(audio_config(circles, half, *EVERY, kind), resume=True)


EVERY = ("log-every=1", "lr-schedule=constant", "validate-every=100")

if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
