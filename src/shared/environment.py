"""MOTIONGEN_* variables (TECH §11.2). What counts: the flag, else the variable, else the default.

An option of a command names its variable with `envvar`, and `--help` shows it. A variable that is
set but empty counts as not set.
"""

DEVICE = "MOTIONGEN_DEVICE"  # auto, cuda, mps or cpu
OUTPUT_DIR = "MOTIONGEN_OUTPUT_DIR"  # folder for reports
DATA_DIR = "MOTIONGEN_DATA_DIR"  # folder or bucket of pairs
DIFFUSION_CHECKPOINT = "MOTIONGEN_DIFFUSION_CHECKPOINT"  # a model folder
DECODER_CHECKPOINT = "MOTIONGEN_DECODER_CHECKPOINT"  # a model folder, for its decoder alone
