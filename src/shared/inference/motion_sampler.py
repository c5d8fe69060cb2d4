"""MotionSampler: several candidates for one piece of sound, and the best of them (REF).

Letters: N candidates, T frames.
"""

from dataclasses import dataclass

import numpy as np
from torch import Tensor

from ..device import choose_device
from ..errors import UsageError
from ..model.audio.audio_motion_model import AudioMotionModel
from .audio_condition import AudioCondition
from .audio_judge import AudioJudge
from .selection import ScoreTable
from .song_sampler import Recall, SampleSettings, SongSampler


@dataclass(frozen=True, eq=False)
class SampleResult:
    """The best candidate [T,25]; all of them [N,T,25], as sampled, if asked for; their scores."""

    trajectory: np.ndarray
    all_candidates: np.ndarray | None
    table: ScoreTable

    @property
    def best(self) -> int:
        """The place of the best among the candidates."""
        return self.table.best


class MotionSampler:
    """Best of N.

    Args:
        diffusion: a trained model, with the decoder and the statistics that a bare diffusion lacks.
        device: auto, cuda, mps or cpu.
        judge: of the candidates; None = one without bands.
    """

    def __init__(
        self, diffusion: AudioMotionModel, device: str = "auto", *, judge: AudioJudge | None = None
    ) -> None:
        self.model = diffusion.to(choose_device(device)[0]).eval()
        self.judge = judge or AudioJudge()

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
        """Sample N candidates of any length and keep the one that `AudioJudge` puts first.

        Beats count where the condition knows them.

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
        condition = hearable(audio_condition, num_frames)
        settings = SampleSettings(num_samples, guidance_scale, num_steps, seed=seed)
        return self.keep_best(condition, SongSampler(self.model, settings), return_all=return_all)

    def keep_best(
        self,
        condition: AudioCondition,
        sampler: SongSampler,
        *,
        return_all: bool,
        recall: Recall | None = None,
    ) -> SampleResult:
        """Sample and judge; see `sample`, and `SongSampler.stream` for `recall`."""
        bars, beats = condition.time() or (None, None)
        made = sampler.sample(condition.rows, phase=bars, recall=recall)
        table = self.judge.judge(made, beats)
        everything = np.stack([trajectory.data for trajectory in made]) if return_all else None
        return SampleResult(made[table.best].data, everything, table)


def hearable(sound: AudioCondition | np.ndarray | Tensor, num_frames: int | None) -> AudioCondition:
    """The first frames of a condition, or of its rows; None = all.

    Raises:
        UsageError: it has fewer.
    """
    condition = sound if isinstance(sound, AudioCondition) else AudioCondition.of(sound)
    frames = condition.num_frames if num_frames is None else num_frames
    if not 1 <= frames <= condition.num_frames:
        raise UsageError(f"num_frames {frames}: choose 1 to {condition.num_frames}, the sound's")
    return condition.first(frames)
