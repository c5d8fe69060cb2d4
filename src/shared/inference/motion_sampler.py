"""MotionSampler: several candidates for one piece of sound, and the best of them (REF).

Letters: N candidates, T frames.
"""

from dataclasses import dataclass

import numpy as np
from torch import Tensor

from src.shared.data.pairing.motion_beats import alignment, motion_beats
from src.shared.device import choose_device
from src.shared.errors import UsageError
from src.shared.inference.audio_condition import AudioCondition
from src.shared.inference.song_sampler import SampleSettings, SongSampler
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.motion.trajectory import MotionTrajectory
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
        audio_condition: AudioCondition | np.ndarray | Tensor,
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
            audio_condition: an `AudioCondition`, or its rows, [1, C, T] or [C, T].
            num_frames: only the first so many; None = all.
            num_samples: N.
            guidance_scale: 1 = none; None = the model's own.
            num_steps: of the model's sampler; None = its own.
            return_all: keep the others too.
            seed: candidate i depends on (seed, i) alone.

        Raises:
            UsageError: N, the steps or the frames are out of range.
        """
        condition = (
            audio_condition
            if isinstance(audio_condition, AudioCondition)
            else AudioCondition.of(audio_condition)
        )
        frames = condition.num_frames if num_frames is None else num_frames
        if not 1 <= frames <= condition.num_frames:
            raise UsageError(
                f"num_frames {frames}: choose 1 to {condition.num_frames}, the sound's"
            )
        condition = condition.first(frames)
        bars, beats = condition.time() or (None, None)
        settings = SampleSettings(num_samples, guidance_scale, num_steps, seed=seed)
        made = SongSampler(self.model, settings).sample(condition.rows, phase=bars)
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
