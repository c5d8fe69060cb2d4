"""Performer: a trajectory pins the root row, the text branch fills in the body: a dance.

Ruling 19 in reverse: the path of a song, made by the audio branch, is what is known of the root
track; everything else is sampled for a prompt, window after window, in the song's time. The body
stands on the path exactly, since neither smoothing nor foot lock moves a pelvis that is known.

Letters: T frames, M beats.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np
import torch

from ..device import idle_threads
from ..errors import UsageError
from ..model.generation.motion_generator import MotionGenerator
from ..motion.carried_feet import hold_carried_feet
from ..motion.motion import Motion
from ..motion.postprocess import MotionPostProcessor, smooth_features
from ..motion.trajectory import MotionTrajectory
from .borders import soften_cuts
from .motion_stream import Passage, stream_features
from .trajectory_constraint import (
    RootError,
    pin,
    root_error,
    start_of,
    untwisted,
)

Progress = Callable[[int, int], None]  # frames done, frames in all


@dataclass(frozen=True)
class PerformerSettings:
    """How a body is filled in; None = the model's own setting.

    Attributes:
        steps, sampler, guidance_scale: of the text branch.
        foot_lock: hold standing feet in place.
        tilt: the path also says how the pelvis leans and rolls.
        on_beats: False = the song's beats are not used at all.
        guide: the sampler leads the body to slow down on beats.
        steps_on_beats: feet land on beats while the path travels; see `footsteps`.
    """

    steps: int | None = None
    sampler: str | None = None
    guidance_scale: float | None = None
    foot_lock: bool | None = None
    tilt: bool = False
    on_beats: bool = True
    guide: bool = True
    steps_on_beats: bool = True


@dataclass(frozen=True, eq=False)
class Performance:
    """A dance.

    Attributes:
        motion: T frames, on the path.
        trajectory: the path, T frames.
        passages: what the body was asked to do, and for how long.
        error: how far the body's pelvis is from the path.
    """

    motion: Motion
    trajectory: MotionTrajectory
    passages: tuple[Passage, ...]
    error: RootError


class Performer:
    """Fills in bodies.

    Args:
        generator: trained, with a root track.
        settings: see `PerformerSettings`.

    Raises:
        UsageError: the generator has no root track.
    """

    def __init__(
        self, generator: MotionGenerator, settings: PerformerSettings | None = None
    ) -> None:
        if not generator.network.root_track:
            raise UsageError(
                "this text model has no root track, so no path can carry its bodies; use one"
                " trained with root-track: true"
            )
        self.generator, self.settings = generator, settings or PerformerSettings()

    @idle_threads()
    def perform(
        self,
        trajectory: MotionTrajectory,
        what: str | Sequence[Passage],
        *,
        beats: np.ndarray | None = None,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Performance:
        """A body on a path.

        Args:
            trajectory: post-processed, of the pelvis, T frames at the generator's frame rate.
            what: a prompt, or passages that last as long as the path.
            beats: of the song in seconds [M]; None = none known.
            seed: 0 or more; with the path and the prompts it decides everything (on the CPU).
            progress: told after each window.

        Raises:
            UsageError: passages of another length, or an argument that the generator refuses.
            UserError: as `MotionGenerator.sample_features`.
        """
        num_frames, own = trajectory.num_frames, self.settings
        passages = _passages(what, num_frames)
        beats = beats if own.on_beats else None
        known = pin(
            trajectory,
            beats=beats if own.guide else None,
            steps=beats if own.steps_on_beats else None,
            tilt=own.tilt,
        )
        pieces = []
        for piece in stream_features(
            self.generator,
            passages,
            constraint=lambda start, stop: known.window(start, stop),
            seed=seed,
            guidance_scale=own.guidance_scale,
            steps=own.steps,
            sampler=own.sampler,
        ):
            pieces.append(piece)
            if progress is not None:
                progress(sum(map(len, pieces)), num_frames)
        post = self.generator.network.generation.post_processing
        cuts = list(accumulate(map(len, pieces)))[:-1]
        smooth = smooth_features(soften_cuts(torch.cat(pieces), cuts), post.smoothing_kernel)
        # Averaged rotations may turn a little: the heading is the path's alone.
        features = known.keep(untwisted(smooth))
        foot_lock = post.foot_lock if own.foot_lock is None else own.foot_lock
        rest = post.model_copy(update={"smoothing_kernel": 1, "foot_lock": False})
        motion = MotionPostProcessor(rest)(
            features,
            known=known.known,
            fps=trajectory.fps,
            text=_title(passages),
            **start_of(trajectory),
        )
        if foot_lock:
            motion = hold_carried_feet(motion)
        return Performance(motion, trajectory, passages, root_error(motion, trajectory))


def _passages(what: str | Sequence[Passage], frames: int) -> tuple[Passage, ...]:
    """One or more passages of `frames` frames in all."""
    passages = (Passage(what, frames),) if isinstance(what, str) else tuple(what)
    total = sum(passage.frames for passage in passages)
    if total != frames:
        raise UsageError(f"passages of {total} frames for a path of {frames}; give as many")
    return passages


def _title(passages: Sequence[Passage]) -> str:
    """The texts in their order, each once."""
    return ", ".join(dict.fromkeys(passage.text for passage in passages))
