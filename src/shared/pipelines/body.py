"""A body that dances: free on a stage, or on a path that is known.

A free body is sampled for a prompt, window after window, in the song's time: the beats lead it,
and left and right foot land in turn, on every beat or, in fast music, on every second one. Where it
goes is its own; then its root is pulled to the middle of the stage and to the front
(`motion/steering`).

On a path it is ruling 19 in reverse: the trajectory is what is known of the root track. Feet are
planned while the path travels. The body stands on the path exactly, since neither smoothing nor
foot lock moves a pelvis that is known.

Letters: T frames, R rows (bones, root track), M beats, S steps.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

import numpy as np
import torch
from torch import Tensor

from ..device import idle_threads
from ..errors import UsageError
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import LEFT_CONTACT, ROOT_ROW, Place, headings
from ..motion.filters import smoothed
from ..motion.motion import Danced, Motion
from ..motion.postprocess.stitching import blend_cuts
from ..motion.rotations import (
    matrix_to_rotation_6d,
    quaternion_to_matrix,
    turn_about_y,
    yaw_to_matrix,
)
from ..motion.skeleton import LIMBS
from ..motion.staging import circling, settled, staged, steered, without_flips
from ..motion.trajectory import MotionTrajectory, from_motion, to_root
from .song_sampler import Progress
from .stream import Passage, stream_features

QUICK = 0.45  # seconds; beats closer than this are too fast for a step each
BOTH_STAND = 0.2  # of a step, both feet are on the ground
STILL, RUNNING = 0.25, 2.0  # m/s over a step; nobody walks slower, or faster
SWAY = 0.5  # seconds, standard deviation of the path that the pelvis sways about


def step_plan(trajectory: MotionTrajectory, beats: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Contacts [T,2] bool, left and right, and the frames [T] bool in which they are planned.

    The first foot is the one towards which the pelvis sways while it would stand.

    Args:
        trajectory: T frames.
        beats: seconds [M], increasing; fewer than two give no plan.
    """
    frames, fps = trajectory.num_frames, trajectory.fps
    contact, planned = np.zeros((frames, 2), dtype=bool), np.zeros(frames, dtype=bool)
    if len(beats) < 2:
        return contact, planned
    lands, number = _steps(beats, frames, fps)
    contact = in_turn(lands, number, _parity(trajectory, number), fps)
    speed = np.linalg.norm(np.gradient(trajectory.position[:, [0, 2]], axis=0), axis=1) * fps
    counts = np.bincount(number, minlength=len(lands))
    mean = np.bincount(number, weights=speed, minlength=len(lands)) / np.maximum(counts, 1)
    planned = (mean[number] > STILL) & (mean[number] < RUNNING)
    return contact, planned


def _steps(beats: np.ndarray, frames: int, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """When feet land [S], seconds, and the number [T] of the landing before each frame."""
    lands = landings(beats, frames / fps)
    number = np.searchsorted(lands, np.arange(frames) / fps, side="right") - 1
    return lands, np.clip(number, 0, len(lands) - 2)


def in_turn(lands: np.ndarray, number: np.ndarray, first: int, fps: float) -> np.ndarray:
    """Contacts [T,2] bool of feet that land in turn: one stands, and both just after a landing.

    Args:
        lands: seconds [S].
        number: of the landing before each frame [T].
        first: the foot that lands at number 0: 0 left, 1 right.
        fps: frames per second.
    """
    frames = np.arange(len(number))
    contact = np.zeros((len(number), 2), dtype=bool)
    contact[frames, (number + first) % 2] = True
    share = (frames / fps - lands[number]) / (lands[number + 1] - lands[number])
    contact[share < BOTH_STAND] = True
    return contact


def landings(beats: np.ndarray, seconds: float) -> np.ndarray:
    """When feet land [S]: on every beat, or on every second one where beats are quick."""
    every = beats_beyond(beats, seconds)
    if np.median(np.diff(beats)) < QUICK:
        inside = int(np.searchsorted(every, beats[0]))
        return np.asarray(every[inside % 2 :: 2])
    return every


def beats_beyond(beats: np.ndarray, seconds: float) -> np.ndarray:
    """Beats [M], M ≥ 2, and more of the first and the last length, from before 0 to after
    `seconds`."""
    before, after = beats[1] - beats[0], beats[-1] - beats[-2]
    head, tail = max(float(beats[0]), 0.0), max(seconds - float(beats[-1]), 0.0)
    early = beats[0] - before * np.arange(np.ceil(head / before) + 1, 0, -1)
    late = beats[-1] + after * np.arange(1, np.ceil(tail / after) + 2)
    return np.concatenate((early, beats, late))


def _parity(trajectory: MotionTrajectory, number: np.ndarray) -> int:
    """0 if even steps are the left foot's, 1 if odd ones are, by how the pelvis sways."""
    path = trajectory.position.astype(np.float64)
    sway = path - smoothed(path, SWAY * trajectory.fps)
    local = turn_about_y(torch.from_numpy(sway), -torch.from_numpy(trajectory.heading))
    to_left = local[:, 0].numpy()
    even = number % 2 == 0
    gain = to_left[even].mean() if even.any() else 0.0
    gain -= to_left[~even].mean() if (~even).any() else 0.0
    return 0 if gain >= 0 else 1


ARMS, SNAPPED = (*LIMBS["left-arm"][1:], *LIMBS["right-arm"][1:]), 4  # frames around a snap
COMES_TO_REST = 1.0  # seconds in which a body that a plan leads does
PELVIS = 0  # its row


def pin(
    trajectory: MotionTrajectory,
    *,
    beats: np.ndarray | None = None,
    steps: np.ndarray | None = None,
    tilt: bool = False,
) -> Constraint:
    """What is known of a body that moves along a path: velocity, height and turning, T frames.

    The inverse of `integrate_root` (forward differences, ruling 6), so that a body which keeps to
    it stands on the path.

    Args:
        trajectory: of the pelvis.
        beats: seconds [M] at which the body is to have a beat; None = it keeps its own time.
        steps: beats [M] on which feet are to land while the path travels; see `step_plan`.
        tilt: also pin how the pelvis leans and rolls.
    """
    constraint = Constraint.free(trajectory.num_frames)
    values, known = constraint.values, constraint.known
    values[:, ROOT_ROW] = to_root(trajectory)
    known[:, ROOT_ROW, :LEFT_CONTACT] = True
    if steps is not None:
        contacts, planned = step_plan(trajectory, steps)
        values[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(contacts).float()
        known[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(planned)[:, None]
    if tilt:
        turns = quaternion_to_matrix(torch.tensor(trajectory.quaternion, dtype=torch.float64))
        level = yaw_to_matrix(-torch.from_numpy(trajectory.heading)) @ turns
        values[:, PELVIS] = matrix_to_rotation_6d(level).float()
        known[:, PELVIS] = True
    times = None if beats is None else torch.as_tensor(np.asarray(beats), dtype=torch.float32)
    return Constraint(values, known, times)


def free_body(
    frames: int,
    *,
    beats: np.ndarray | None,
    steps: np.ndarray | None,
    waits: Sequence[tuple[int, int]] = (),
    first: int = 0,
    fps: float = 30.0,
) -> Constraint:
    """What is known of a body that goes where it likes: when its feet land, T frames.

    Args:
        frames: T.
        beats, steps: see `pin`; feet step wherever it does not wait.
        waits: frames [start, stop) in which nothing is known.
        first: the foot that begins: 0 left, 1 right.
        fps: frames per second.
    """
    free = Constraint.free(frames)
    if steps is not None and len(steps) > 1:
        contacts = in_turn(*_steps(steps, frames, fps), first, fps)
        free.values[:, ROOT_ROW, LEFT_CONTACT:] = torch.from_numpy(contacts).float()
        free.known[:, ROOT_ROW, LEFT_CONTACT:] = True
    for start, stop in waits:
        free.known[start:stop] = False
    times = None if beats is None else torch.as_tensor(np.asarray(beats), dtype=torch.float32)
    return replace(free, beats=times)


def start_of(trajectory: MotionTrajectory) -> Place:
    """Where a body on this path begins."""
    x, _, z = trajectory.position[0].tolist()
    return Place(x, z, float(trajectory.heading[0]))


@dataclass(frozen=True)
class RootError:
    """How far a body's pelvis is from its path: metres and degrees of heading."""

    mean_metres: float
    max_metres: float
    mean_degrees: float
    max_degrees: float


def root_error(motion: Motion, trajectory: MotionTrajectory) -> RootError:
    """Compare a body with the path that it was to stand on, both of T frames."""
    apart = np.linalg.norm(motion.root_position - trajectory.position, axis=-1)
    pelvis = torch.tensor(motion.quaternions[:, PELVIS], dtype=torch.float64)
    ahead = yaw_to_matrix(-torch.as_tensor(trajectory.heading, dtype=torch.float64))
    turned = headings(ahead @ quaternion_to_matrix(pelvis)).numpy()
    degrees = np.rad2deg(np.abs((turned + np.pi) % (2 * np.pi) - np.pi))
    return RootError(
        *(float(value) for value in (apart.mean(), apart.max(), degrees.mean(), degrees.max()))
    )


@dataclass(frozen=True, kw_only=True)
class PerformerSettings(Sampling):
    """How a body is filled in; None = the model's own setting.

    Attributes:
        foot_lock: hold standing feet in place.
        tilt: the path also says how the pelvis leans and rolls.
        on_beats: False = the song's beats are not used at all.
        guide: the sampler leads the body to slow down on beats.
        steps_on_beats: feet land on beats, on a path while it travels; see `step_plan`.
    """

    foot_lock: bool | None = None
    tilt: bool = False
    on_beats: bool = True
    guide: bool = True
    steps_on_beats: bool = True


@dataclass(frozen=True, eq=False)
class Performance:
    """A dance.

    Attributes:
        motion: T frames.
        trajectory: the path of its pelvis, T frames.
        passages: what the body was asked to do, and for how long.
        error: how far the body's pelvis is from the path that was given; None = none was.
        figures: what it dances when; none where no memory was asked.
    """

    motion: Motion
    trajectory: MotionTrajectory
    passages: tuple[Passage, ...]
    error: RootError | None = None
    figures: tuple[Danced, ...] = ()


class Performer:
    """Fills in bodies.

    Args:
        generator: trained, with a root track.
        settings: see `PerformerSettings`.

    Raises:
        UsageError: the generator has no root track.
    """

    def __init__(self, generator: TextToMotion, settings: PerformerSettings | None = None) -> None:
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
        seed: int | None = None,
        progress: Progress | None = None,
    ) -> Performance:
        """A body on a path.

        Args:
            trajectory: post-processed, of the pelvis, T frames at the generator's frame rate.
            what: a prompt, or passages that last as long as the path.
            beats: of the song in seconds [M]; None = none known.
            seed: with the path and the prompts it decides everything (on the CPU); None = the
                settings'.
            progress: told after each window.

        Raises:
            UsageError: passages of another length, or an argument that the generator refuses.
            UserError: as `TextToMotion.sample_features`.
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
        features = self._sampled(passages, known, seed, progress)
        motion = self.generator.post_processor(
            known.keep(features),
            known.known,
            text=_title(passages),
            place=start_of(trajectory),
            foot_lock=own.foot_lock,
            carried=True,
        )
        return Performance(motion, trajectory, passages, root_error(motion, trajectory))

    @idle_threads()
    def improvise(
        self,
        passages: Sequence[Passage],
        *,
        beats: np.ndarray | None = None,
        phase: np.ndarray | None = None,
        waits: Sequence[tuple[int, int]] = (),
        plan: Constraint | None = None,
        seed: int | None = None,
        progress: Progress | None = None,
    ) -> Performance:
        """A body that goes where it likes, near the middle of the stage.

        Who walks off ("an old man dances") walks round instead, unless a plan leads.

        Args:
            passages: what it does, T frames in all.
            beats, seed, progress: see `perform`.
            phase: unwrapped bars [T], for whoever shows its path; None = no music.
            waits: frames [start, stop) that are a passage or more each and have no beat.
            plan: what else is known of the T frames (`FigureDancer.plan`); None = nothing.

        Raises:
            UserError: as `TextToMotion.sample_features`.
        """
        frames, own = sum(passage.frames for passage in passages), self.settings
        beats = beats if own.on_beats else None
        known = free_body(
            frames,
            beats=beats if own.guide else None,
            steps=beats if own.steps_on_beats else None,
            waits=waits,
            first=(own.seed if seed is None else seed) % 2,
        )
        if plan is not None:
            known = plan.over(known)
        features = self._sampled(passages, known, seed, progress, waits)
        fps, root = self.generator.card.fps, features[:, ROOT_ROW]
        if plan is None:
            features[:, ROOT_ROW] = steered(circling(root, fps), fps)
        else:
            end = int(torch.nonzero(plan.known[:, ROOT_ROW, 0])[-1]) / fps
            features = plan.keep(features)
            features[:, ROOT_ROW] = staged(features[:, ROOT_ROW], fps, end)
            features = settled(features, end, COMES_TO_REST, fps)
        motion = self.generator.post_processor(
            features, None, text=_title(passages), foot_lock=own.foot_lock, carried=True
        )
        if plan is not None:  # the network was shown legs that it did not make
            motion = without_flips(motion, SNAPPED, ARMS)
        return Performance(motion, from_motion(motion, phase), tuple(passages))

    def _sampled(
        self,
        passages: Sequence[Passage],
        known: Constraint,
        seed: int | None,
        progress: Progress | None,
        waits: Sequence[tuple[int, int]] = (),
    ) -> Tensor:
        """Raw features [T,R,6] of all windows."""

        def window(start: int, stop: int) -> Constraint:
            part = known.window(start, stop)
            silent = any(first < stop <= last for first, last in waits)
            return replace(part, beats=None) if silent else part

        own, pieces = self.settings, []
        settings = own if seed is None else replace(own, seed=seed)
        for piece in stream_features(self.generator, passages, settings, constraint=window):
            pieces.append(piece)
            if progress is not None:
                progress(sum(map(len, pieces)), len(known))
        cuts = list(accumulate(map(len, pieces)))[:-1]
        return blend_cuts(torch.cat(pieces), cuts)


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
