"""AudioCondition: what a network is told of a song (TECH 12.1).

Letters: T frames, M beats.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
import torch
from torch import Tensor

from ..audio.song import Song
from ..model.audio.conditioning import BEAT, CONDITION_ROWS, FEATURE_ROWS
from ..motion.trajectory import FPS
from ..motion.trajectory_math import unwrap_phase
from .song_generator import heard


@dataclass(frozen=True, eq=False)
class AudioCondition:
    """Rows [163 or 167, T] at 30 fps: features, and beat and bar phase where they are known.

    Raises:
        ValueError: another shape.
    """

    rows: Tensor

    def __post_init__(self) -> None:
        if self.rows.ndim != 2 or len(self.rows) not in (FEATURE_ROWS, CONDITION_ROWS):
            raise ValueError(f"a condition is [163 or 167, T], not {list(self.rows.shape)}")

    @classmethod
    def of(cls, sound: Song | np.ndarray | Tensor) -> Self:
        """Of an analysed song; or of rows, with a batch of one in front or without."""
        if isinstance(sound, Song):
            return cls(heard(sound, None)[0])
        rows = torch.as_tensor(sound).float()
        return cls(rows[0] if rows.ndim == 3 and len(rows) == 1 else rows)

    @property
    def num_frames(self) -> int:
        """T."""
        return self.rows.shape[1]

    def first(self, num_frames: int) -> Self:
        """Its first frames."""
        return type(self)(self.rows[:, :num_frames])

    def time(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Unwrapped bars [T], and times [M] of beats in seconds; None where they are unknown."""
        beat_and_bar = self.rows[BEAT].double().cpu().numpy()
        if not len(beat_and_bar) or not np.hypot(*beat_and_bar[:2]).min() > 0.5:
            return None
        beats, bars = (
            unwrap_phase(np.arctan2(sine, cosine) / (2 * np.pi) % 1.0)
            for cosine, sine in (beat_and_bar[:2], beat_and_bar[2:])
        )
        numbers = np.arange(np.ceil(beats[0]), np.floor(beats[-1]) + 1)
        return bars, np.interp(numbers, beats, np.arange(len(beats))) / FPS
