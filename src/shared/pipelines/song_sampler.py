"""From a song's condition to trajectories of any length: windows that share their seam.

Each window after the first is denoised with its first frames known: the last frames of the window
before, seen from its own start. The network was trained so (src/train/train_audio.py), hence a
seam is part of one motion, not a blend of two; what it misses there is taken up by `carry_on`. One
window is in memory at a time.

Letters: B samples, T frames of the song, W of a window, O shared by neighbours, K known.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..config_audio import AudioNetworkConfig
from ..device import idle_threads
from ..errors import UsageError
from ..model.audio import MIN_FRAMES
from ..model.diffusion import Sampling, holding, make_sampler
from ..model.noise import NoiseStream, sample_generators, standard_normal
from ..motion.rotations import (
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_multiply,
    quaternion_slerp,
)
from ..motion.trajectory import (
    CHANNELS,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    MotionTrajectory,
    WindowJoiner,
    encode_window,
)
from ..tensors import F, Tensor, nn, torch
from .runtime import Runtime

if TYPE_CHECKING:
    from ..model.audio.conditioning import MemoryCondition

SPARE = 8  # frames at the end that are made and cut off: no neighbour to learn from (ruling 6)
TAIL = 2  # of them, what the last frames of a song are derived from
Progress = Callable[[int, int], None]  # frames done, frames in all
# Of a window's first frame and length, spare included.
Recall = Callable[[int, int], "MemoryCondition"]


@dataclass(frozen=True)
class SongSampling(Sampling):
    """How a song is sampled; None = the model's own setting.

    Attributes:
        num_samples: candidates.
        window, overlap: frames W and O; a window longer than those of training is a guess.
    """

    num_samples: int = 1
    window: int | None = None
    overlap: int = 30

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.num_samples < 1:
            raise UsageError(f"num-samples {self.num_samples} must be 1 or more")
        half = math.inf if self.window is None else self.window // 2
        if not MIN_FRAMES <= self.overlap <= half:
            raise UsageError(
                f"overlap {self.overlap} must lie between {MIN_FRAMES} and half the window ({half})"
            )

    def resolved(self, config: AudioNetworkConfig) -> "SongSampling":
        """With the model's own window where none was chosen, and an overlap that fits it."""
        if self.window is not None:
            return self
        return replace(self, window=config.window, overlap=min(self.overlap, config.window // 2))


def spans(num_frames: int, window: int, overlap: int) -> list[tuple[int, int]]:
    """First and last-plus-one frame of each window that covers [0, num_frames)."""
    found = [(0, min(window, num_frames))]
    while found[-1][1] < num_frames:
        start = found[-1][1] - overlap
        found.append((start, min(start + window, num_frames)))
    return found


class SongSampler:
    """Samples trajectories from conditions.

    Args:
        model: trained; used on the device it is on, a torch module in evaluation mode.
        settings: see `SongSampling`.
    """

    def __init__(self, model: Runtime, settings: SongSampling | None = None) -> None:
        self.model = model.eval() if isinstance(model, nn.Module) else model
        self.settings = (settings or SongSampling()).resolved(model.config)
        self.device = model.mean.device
        diffusion = model.config.diffusion
        self.sampler = make_sampler(
            model.diffusion,
            self.settings.sampler or diffusion.sampler,
            self.settings.steps,
        )

    def sample(
        self,
        condition: Tensor,
        *,
        phase: np.ndarray | None = None,
        style: np.ndarray | None = None,
        progress: Progress | None = None,
        recall: Recall | None = None,
    ) -> list[MotionTrajectory]:
        """Whole trajectories, one a sample; see `stream`."""
        stream = self.stream(condition, phase=phase, style=style, progress=progress, recall=recall)
        pieces = list(stream)
        return [
            MotionTrajectory(np.concatenate([piece[index].data for piece in pieces]))
            for index in range(self.settings.num_samples)
        ]

    def stream(
        self,
        condition: Tensor,
        *,
        phase: np.ndarray | None = None,
        style: np.ndarray | None = None,
        progress: Progress | None = None,
        recall: Recall | None = None,
    ) -> Iterator[list[MotionTrajectory]]:
        """Pieces that follow each other, one a sample, as soon as they are settled.

        Args:
            condition: [163 or 167, T].
            phase: unwrapped bars [T] of the beat tracker: the trajectory's phase too. None = the
                model's own count.
            style: [8] unit, held; None = the model's choice.
            progress: told after each window.
            recall: what is remembered for a window, for one sample or for all; None = nothing.
        """
        num_frames, draws = condition.shape[1], self._generators()
        joiners: list[WindowJoiner] = []
        before: list[np.ndarray] = []  # of each sample, the window's last decoded frames
        for start, end in self._spans(num_frames):
            tracked = None if phase is None else np.asarray(phase[start:end], dtype=np.float64)
            known, values = self._known(before, style, end - start)
            memory = None
            if recall is not None:
                from ..model.audio.conditioning import known_frames

                remembered = recall(start, known.shape[-1])
                memory = remembered.to(self.device).after(known_frames(values, known))
            shown = self.settings.overlap if before else 0
            # torch's threads would wait, spinning, on the cores that an export computes on
            with idle_threads(None if isinstance(self.model, nn.Module) else 1):
                windows = self._window(
                    condition[:, start:end], known, values, tracked, draws, memory, shown=shown
                )
            tail = TAIL if end == num_frames else 0
            windows = [(rows[:, : end - start + tail], first) for rows, first in windows]
            if not joiners:
                # a path starts at the origin and faces +Z (ruling 8), whatever the network made
                windows = [(reset_window(rows), first) for rows, first in windows]
                shared = min(self.settings.overlap, num_frames - 1)
                joiners = [
                    WindowJoiner(shared, phase=first if tracked is None else tracked[0])
                    for _, first in windows
                ]
            yield [joiner.add(window) for joiner, (window, _) in zip(joiners, windows, strict=True)]
            before = [window[:, -self.settings.overlap :] for window, _ in windows]
            if progress is not None:
                progress(end, num_frames)
        yield [joiner.finish(spare=TAIL) for joiner in joiners]

    def windows(self, num_frames: int) -> list[tuple[int, int]]:
        """First frame and length of each window, spare frames included: what `recall` is asked."""
        return [(start, self._length(end - start)) for start, end in self._spans(num_frames)]

    def _spans(self, num_frames: int) -> list[tuple[int, int]]:
        assert self.settings.window is not None  # resolved
        return spans(num_frames, self.settings.window - SPARE, self.settings.overlap)

    def _length(self, frames: int) -> int:
        """Always as long as in training: a shorter window is unlike any that the network knows."""
        assert self.settings.window is not None  # resolved
        return max(frames + SPARE, self.settings.window)

    def _generators(self) -> list[NoiseStream]:
        return sample_generators(self.settings.seed, self.settings.num_samples)

    def _known(
        self, before: list[np.ndarray], style: np.ndarray | None, frames: int
    ) -> tuple[Tensor, Tensor]:
        """Which entries [B,25,W] the network is given, and their z-scores."""
        size, length = self.settings.num_samples, self._length(frames)
        known = torch.zeros(size, CHANNELS, length, dtype=torch.bool)
        values = torch.zeros(size, CHANNELS, length)
        for index, window in enumerate(before):
            local = reset_window(window)
            known[index, :, : local.shape[1]] = True
            values[index, :, : local.shape[1]] = torch.from_numpy(local)
        if style is not None:
            known[:, STYLE] = True
            values[:, STYLE] = torch.as_tensor(style, dtype=torch.float32)[:, None]
        values = values.to(self.device)
        return known.to(self.device), self.model.normalise(values)

    @torch.no_grad()
    def _window(
        self,
        condition: Tensor,
        known: Tensor,
        values: Tensor,
        tracked: np.ndarray | None,
        draws: list[NoiseStream],
        memory: "MemoryCondition | None" = None,
        *,
        shown: int,
    ) -> list[tuple[np.ndarray, float]]:
        """Window [25,W] with its spare frames, and first phase, of each sample.

        `shown` first frames are known.
        """
        model, frames = self.model, condition.shape[1]
        size, _, length = known.shape
        heard = F.pad(condition[None], (0, length - frames), mode="replicate")
        heard = heard.to(self.device).expand(size, -1, -1)
        model_fn = model.model_fn(heard, self.settings.guidance_scale, memory)
        noise = standard_normal(known.shape, draws, device=self.device)
        x_0 = self.sampler.run(holding(model_fn, known, values), noise, generator=draws)
        x_0 = torch.where(known, values, x_0)
        start = None if tracked is None else torch.full((size,), tracked[0] % 1.0).to(x_0)
        decoded = model.decode(x_0, start)
        trajectories = decoded.trajectory.cpu().numpy()
        phases = decoded.phase_unwrapped.cpu().double().numpy()
        windows = []
        for trajectory, own in zip(trajectories, phases, strict=True):
            rows = trajectory.T.copy()
            carry_on(rows, shown)  # before the end is cut off: a last window may be a frame longer
            steps = np.diff(own if tracked is None else tracked)
            rows[PHASE] = np.pad(steps, (0, length - len(steps)), mode="edge")
            windows.append((rows, float(own[0])))
        return windows


def reset_window(window: np.ndarray) -> np.ndarray:
    """A window [25,O] cut out of another one, seen from its own first frame."""
    phase = np.concatenate(([0.0], np.cumsum(window[PHASE, :-1], dtype=np.float64)))
    local = encode_window(window.T, phase)
    local[PHASE, -1] = window[PHASE, -1]
    return local


SPEED_FRAMES = 10  # until the path has the speed that the network made
POSE_FRAMES = 30  # until height and rotation are the network's
GROUND = [0, 2]


def carry_on(rows: np.ndarray, known: int) -> None:
    """Join what was made of a window to its known frames, in place.

    The network is shown the first frames and makes the rest, but only nearly continues them: 1 cm
    of misplacement is a teleport, an acceleration of 9 m/s². So the rest of the path is moved to
    where the known frames lead, its speed taken over within a third of a second, its height and
    rotation within a second. At the join it accelerates and turns by the mean of both sides: a step
    that merely repeated the last one would be the only frame without acceleration.

    Args:
        rows: [25,W], position and quaternion as made; only these two are changed.
        known: K ≥ 3 frames that are right; W ≥ K + 3, else nothing is done.
    """
    if known < 3 or rows.shape[1] < known + 3:
        return
    rest = rows.shape[1] - known
    position = rows[POSITION].astype(np.float64)  # 3 W
    made = position[:, known:].copy()
    after = np.diff(made, axis=1)  # 3 W-K-1, the first step of the rest is not among them
    before = np.diff(position[:, known - 3 : known], axis=1)  # 3 2
    steps = np.insert(after, 0, 2 * after[:, 0] - after[:, 1], axis=1)  # 3 W-K
    acceleration = (before[:, 1] - before[:, 0] + after[:, 1] - after[:, 0]) / 2
    first = before[:, 1] + acceleration
    steps += (first - steps[:, 0])[:, None] * _fade(rest, SPEED_FRAMES)
    path = position[:, known - 1 : known] + np.cumsum(steps, axis=1)
    path[1] = made[1] + (path[1] - made[1]) * _fade(rest, POSE_FRAMES)
    rows[POSITION][:, known:] = path

    rotation = torch.as_tensor(rows[QUATERNION].T, dtype=torch.float64)  # W 4
    rotation = quaternion_continuous(F.normalize(rotation, dim=-1), dim=-2)
    both = quaternion_multiply(rotation[1:], quaternion_conjugate(rotation[:-1]))  # W-1 4, turns
    half, past = torch.tensor([0.5]).to(both), known + 1
    turn = quaternion_slerp(both[known - 2 : known - 1], both[known:past], half)  # 1 4
    due = quaternion_multiply(turn, rotation[known - 1 : known])
    miss = quaternion_multiply(due, quaternion_conjugate(rotation[known:past]))
    share = torch.as_tensor(_fade(rest, POSE_FRAMES))[:, None]
    nothing = torch.tensor([1.0, 0.0, 0.0, 0.0], dtype=torch.float64).expand(rest, 4)
    turns = quaternion_slerp(nothing, miss.expand(rest, 4), share)
    rotation[known:] = quaternion_multiply(turns, rotation[known:])
    rows[QUATERNION] = quaternion_continuous(rotation, dim=-2).T.numpy()


def _fade(frames: int, length: int) -> np.ndarray:
    """Weights [frames] from nearly 1 to 0 over `length` frames, two vanishing derivatives."""
    x = np.clip((np.arange(frames) + 1) / (length + 1), 0, 1)
    return 1 - x**3 * (x * (6 * x - 15) + 10)
