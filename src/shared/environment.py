"""What holds for a whole process: MOTIONGEN_* variables and defaults, and whether NumPy computes.

The same for commands, library and training (TECH 11.2).

What counts is the flag, the argument or the key that is given, else the variable, else the default.
A variable that is set but empty counts as not set. An option of a command names its variable with
`envvar`, and `--help` shows it.
"""

import os
from pathlib import Path

DEVICE = "MOTIONGEN_DEVICE"  # auto, cuda, mps or cpu
OUTPUT_DIR = "MOTIONGEN_OUTPUT_DIR"  # folder for reports and motions; training runs lie in it
DATA_DIR = "MOTIONGEN_DATA_DIR"  # folder or bucket of pairs
DIFFUSION_CHECKPOINT = "MOTIONGEN_DIFFUSION_CHECKPOINT"  # a model folder
BLENDER = "MOTIONGEN_BLENDER"  # the program, or a Python that has its module bpy
DECODER_CHECKPOINT = "MOTIONGEN_DECODER_CHECKPOINT"  # a model folder, for its decoder alone

TEXT_MODEL, AUDIO_MODEL = "starter", "starter-audio"  # where none is named


def variable(name: str) -> str | None:
    """What a variable is set to; None = nothing."""
    return os.environ.get(name) or None


def default_audio_model() -> str:
    """What makes the paths of songs where none is named."""
    return variable(DIFFUSION_CHECKPOINT) or AUDIO_MODEL


def run_folder(folder: str | Path) -> Path:
    """Where a run of training lies: `runs/audio` is `audio` in MOTIONGEN_OUTPUT_DIR, if it is set.

    Any other folder is itself.
    """
    path, runs = Path(folder), variable(OUTPUT_DIR)
    if runs is None or path.parts[:1] != ("runs",):
        return path
    return Path(runs, *path.parts[1:])


torch_unwanted = False  # `tensors` looks here once


def compute_without_torch() -> None:
    """Let NumPy stand in for PyTorch, which takes seconds to import, wherever nothing is learned.

    Asked for before anything of motions is imported, and for the whole process.
    """
    global torch_unwanted
    torch_unwanted = True
