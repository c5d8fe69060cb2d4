"""A memory of three dancers whose counts are known."""

from dataclasses import replace

import numpy as np

from src.shared.memory.figures import FigureMemory, Take
from src.shared.motion.motion import Motion
from tests.shared.evaluation.dancers import swinging_arms


def stepping(period: float, frames: int = 600, *, sway: float = 0.1, bend: float = 0.0) -> Motion:
    """Swings the arms and sways to the left and back in two counts."""
    motion = swinging_arms(period, frames)
    root = motion.root_position.copy()
    root[:, 0] = sway * np.sin(np.pi * np.arange(frames) / 30 / period)
    root[:, 1] -= bend
    return replace(motion, root_position=root)


def tiny_figures() -> FigureMemory:
    """Two kinds at 120 a minute, one of them lively, and a slow take."""
    own = ("us", "CC0")
    return FigureMemory(
        [
            Take.of(stepping(0.5), "step", "salsa", *own),
            Take.of(stepping(0.52, sway=0.3), "sway", "polka", *own),
            Take.of(stepping(0.7, sway=0.0), "slow", "salsa", *own),
        ]
    )
