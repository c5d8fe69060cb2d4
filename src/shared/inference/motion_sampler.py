"""MotionSampler: several candidates for one piece of sound, and the best of them (REF).

Letters: N candidates, T frames.
"""

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from src.shared.data.pairing.motion_beats import alignment, motion_beats
from src.shared.device import choose_device
from src.shared.errors import UsageError
from src.shared.inference.song_sampler import SampleSettings, SongSampler
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.conditioning import BEAT, FEATURE_ROWS
from src.shared.motion.trajectory import FPS, MotionTrajectory
from src.shared.motion.trajectory_math import unwrap_phase
from src.shared.validation.sanity import SanityChecker


@dataclass(frozen=True, eq=False)
class SampleResult:
    """The best candidate [T,25]; all of them [N,T,25] if asked for; the best one's place."""

    trajectory: np.ndarray
    all_candidates: np.ndarray | None
    best: int


class MotionSampler:
    """Best of N.

    Args:
        diffusion: a trained model, with the decoder and the statistics that a bare diffusion lacks.
        device: auto, cuda, mps or cpu.
    """

    def __init__(self, diffusion: AudioMotionModel, device: str = "auto") -> None:
        self.model = diffusion.to(choose_device(device)[0]).eval()
        self.checker = SanityChecker()

    def sample(
        self,
        audio_condition: np.ndarray | Tensor,
        num_frames: int | None = None,
        num_samples: int = 8,
        guidance_scale: float | None = None,
        num_steps: int | None = None,
        *,
        return_all: bool = False,
        seed: int = 0,
    ) -> SampleResult:
        """Sample N candidates of any length and keep one.

        The best fails the fewest sanity checks; among equals its slow moments fall best on the
        beats, where the condition knows them; among equals it is the first.

        Args:
            audio_condition: [163 or 167, T] or [1, 163 or 167, T].
            num_frames: only the first so many; None = all.
            num_samples: N.
            guidance_scale: 1 = none; None = the model's own.
            num_steps: of the model's sampler; None = its own.
            return_all: keep the others too.
            seed: candidate i depends on (seed, i) alone.

        Raises:
            UsageError: N, the steps or the frames are out of range.
        """
        condition = torch.as_tensor(audio_condition).float()
        condition = condition[0] if condition.ndim == 3 else condition
        frames = condition.shape[1] if num_frames is None else num_frames
        if not 1 <= frames <= condition.shape[1]:
            raise UsageError(
                f"num_frames {frames}: the condition has {condition.shape[1]}; choose 1 to that"
            )
        condition = condition[:, :frames]
        bars, beats = heard_time(condition.numpy())
        settings = SampleSettings(num_samples, guidance_scale, num_steps, seed=seed)
        made = SongSampler(self.model, settings).sample(condition, phase=bars)
        ranks = [self._rank(trajectory, beats) for trajectory in made]
        best = min(range(len(made)), key=ranks.__getitem__)
        everything = np.stack([trajectory.data for trajectory in made]) if return_all else None
        return SampleResult(made[best].data, everything, best)

    def _rank(self, trajectory: MotionTrajectory, beats: np.ndarray | None) -> tuple[int, float]:
        """Lower is better."""
        _, results = self.checker.check_all(trajectory)
        failed = sum(not result.passed for result in results.values())
        return failed, 0.0 if beats is None else -on_the_beat(trajectory, beats)


def on_the_beat(trajectory: MotionTrajectory, beats: np.ndarray) -> float:
    """Mean of both directions of beat alignment, in [0, 1]; 0 for a motion without beats."""
    times = motion_beats(trajectory.position, trajectory.fps).times
    both = alignment(times, beats, trajectory.seconds)
    return float(np.nan_to_num([both.motion_to_music, both.music_to_motion]).mean())


def heard_time(condition: np.ndarray) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Unwrapped bars [T] and beat times [M] of a condition [163 or 167, T]; None = unknown."""
    rows = condition[BEAT]
    if condition.shape[0] == FEATURE_ROWS or not np.hypot(rows[0], rows[1]).min() > 0.5:
        return None, None
    beat, bar = (
        unwrap_phase(np.arctan2(sine, cosine) / (2 * np.pi) % 1.0)
        for cosine, sine in (rows[:2], rows[2:])
    )
    numbers = np.arange(np.ceil(beat[0]), np.floor(beat[-1]) + 1)
    return bar, np.interp(numbers, beat, np.arange(len(beat))) / FPS
