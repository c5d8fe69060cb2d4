"""What the networks of songs share with their exports, which do without PyTorch.

Rows of a condition [B, 163, T]: mel 0:128, chroma 128:140, mfcc 140:160, rms, spectral centroid,
onset strength. Four more make [B, 167, T]: cosine and sine of the beat phase, then of the bar
phase, zero where no beat is known.

Letters: B batch, T frames.
"""

from dataclasses import dataclass

from ...tensors import Tensor, torch

MEL, CHROMA, MFCC = slice(0, 128), slice(128, 140), slice(140, 160)
ENERGY, BEAT = slice(160, 163), slice(163, 167)
GROUPS = {"mel": MEL, "chroma": CHROMA, "mfcc": MFCC, "energy": ENERGY, "beat": BEAT}
FEATURE_ROWS, CONDITION_ROWS = 163, 167
MIN_FRAMES = 8  # of a network's input, ruling 4


@dataclass(frozen=True)
class Decoded:
    """A trajectory [B, T, 25], and its phase in bars before it is taken modulo 1, [B, T]."""

    trajectory: Tensor
    phase_unwrapped: Tensor


def width(rows: slice) -> int:
    """Number of rows of a feature group."""
    return int(rows.stop - rows.start)


def with_phase_rows(condition: Tensor) -> Tensor:
    """[B, 163 or 167, T] -> [B, 167, T]; phases left out are unknown, which is zero.

    Raises:
        ValueError: another number of rows.
    """
    rows = condition.shape[1]
    if rows == CONDITION_ROWS:
        return condition
    if rows != FEATURE_ROWS:
        raise ValueError(
            f"an audio condition has {FEATURE_ROWS} or {CONDITION_ROWS} rows, not {rows}"
        )
    unknown = torch.zeros_like(condition[:, : CONDITION_ROWS - rows])
    return torch.cat((condition, unknown), 1)
