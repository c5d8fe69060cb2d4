"""Best of N for one piece of sound (REF): MotionSampler; MPMSMotionSampler, with a memory.

Letters: N candidates, C rows of a condition, T frames, D width of the shared space.
"""

import asyncio
from collections.abc import Sequence, Set
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from ..device import choose_device
from ..errors import UsageError
from ..memory.query import Memory
from ..memory.service import MPMService
from ..model.audio.audio_motion_model import AudioMotionModel
from ..model.audio.shared_space import SharedSpace
from .ranking import AudioJudge, ScoreTable
from .song import AudioCondition, own_noise
from .song_memory import (
    Question,
    ask,
    questions,
    recalling,
    require_memory,
    same_question,
)
from .song_sampler import Recall, SongSampler, SongSampling


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
        settings = SongSampling(
            num_samples, guidance_scale=guidance_scale, steps=num_steps, seed=seed
        )
        settings = _as_of_song(settings, condition)
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


def _as_of_song(settings: SongSampling, condition: AudioCondition) -> SongSampling:
    """With noise of the song's own, as `generate --audio` has it; mere rows are of no song."""
    return settings if condition.song is None else own_noise(settings, condition.song.seed)


@dataclass(frozen=True, eq=False)
class Plan:
    """A piece of sound about to be danced to: its windows, and what each asks the memory."""

    condition: AudioCondition
    sampler: SongSampler
    windows: list[tuple[int, int]]
    asked: list[Question]


class MPMSMotionSampler(MotionSampler):
    """Best of N, each window told what the memory knows of its sound.

    A query that is late or fails is answered by "nothing known", and the window is made as without
    a memory; `mpms_service.counts` tells how many.

    Args:
        diffusion: a model that `train_memory` taught.
        mpms_service: the memory.
        space: embeds the sound of each window; None = callers give `audio_embedding`.
        device: auto, cuda, mps or cpu.
        judge: of the candidates; None = one without bands.

    Raises:
        UserError: the model hears no memory.
    """

    def __init__(
        self,
        diffusion: AudioMotionModel,
        mpms_service: MPMService,
        space: SharedSpace | None = None,
        device: str = "auto",
        *,
        judge: AudioJudge | None = None,
    ) -> None:
        require_memory(diffusion.config, diffusion.card.name or "this model")
        super().__init__(diffusion, device, judge=judge)
        self.mpms_service = mpms_service
        self.space = space

    async def sample_with_mpms(
        self,
        audio_condition: AudioCondition | np.ndarray | Tensor,
        num_frames: int | None = None,
        num_samples: int = 8,
        audio_embedding: np.ndarray | Tensor | None = None,
        beat_phase: float | None = None,
        guidance_scale: float | None = None,
        num_steps: int | None = None,
        *,
        exclude_songs: Set[str] | None = None,
        return_all: bool = False,
        seed: int = 0,
    ) -> SampleResult:
        """As `sample`, with memory; the event loop is not held up. Without one: `asyncio.run`.

        Args:
            audio_condition, num_frames, num_samples, guidance_scale, num_steps: see `sample`.
            audio_embedding: [D] or [1,D], unit, asked for every window; None = each window asks
                with its own sound.
            beat_phase: bar phase of the first frame, for a condition that knows no beats.
            exclude_songs: songs that may not be remembered.
            return_all, seed: see `sample`.

        Raises:
            UsageError: N, the steps or the frames are out of range; neither space nor embedding.
        """
        settings = SongSampling(
            num_samples, guidance_scale=guidance_scale, steps=num_steps, seed=seed
        )
        sound = hearable(audio_condition, num_frames)
        settings = _as_of_song(settings, sound)
        plan = await asyncio.to_thread(self._plan, sound, settings, audio_embedding, beat_phase)
        answers = await ask(self.mpms_service, plan.asked, exclude_songs)
        return await asyncio.to_thread(self._dance, plan, answers, return_all)

    def _plan(
        self,
        sound: AudioCondition,
        settings: SongSampling,
        embedding: np.ndarray | Tensor | None,
        beat_phase: float | None,
    ) -> Plan:
        sampler = SongSampler(self.model, settings)
        windows = sampler.windows(sound.num_frames)
        bars, _ = sound.time() or (None, None)
        if embedding is None:
            if self.space is None:
                raise UsageError("give audio_embedding, or a shared space to this sampler")
            asked = questions(self.space, sound.rows, bars, windows)
        else:
            query = torch.atleast_2d(torch.as_tensor(embedding))  # type: ignore[no-untyped-call]
            asked = same_question(query, bars, windows)
        if bars is None:  # only the first window starts where the caller says
            asked[0] = Question(asked[0].embedding, beat_phase, asked[0].num_frames)
        return Plan(sound, sampler, windows, asked)

    def _dance(self, plan: Plan, answers: Sequence[Memory], return_all: bool) -> SampleResult:
        recall = recalling(plan.windows, answers)
        return self.keep_best(plan.condition, plan.sampler, return_all=return_all, recall=recall)
