"""What of a motion is given beforehand: known entries, and the moments of its beats.

A network with `generation.constraints` sees the known entries clean, beside a mask of them and the
beats (Cohan et al. 2024, CondMDI: observed entries overwrite the noisy ones and the mask is an
input). Any other network gets them noised to each step (Lugmayr et al. 2022, RePaint, without its
resampling), and no beats.

Letters: B batch, T frames, K rows (bones, root track), C channels, M beats.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import torch
from torch import Tensor

from src.shared.errors import UsageError
from src.shared.model.diffusion.conditions import ModelFn
from src.shared.model.diffusion.gaussian import GaussianDiffusion

BEAT_CHANNELS = 3
BEAT_WIDTH = 1.2  # frames, standard deviation of the bump at a beat
BEAT_REACH = 0.5  # seconds; beats further away are not heard


@dataclass(frozen=True, eq=False)
class Constraint:
    """What is given of one motion.

    Attributes:
        values: raw features [T, K, C], not z-scored; used where `known`.
        known: [T, K, C] bool.
        beats: seconds [M] from the first frame at which the body is to have a beat, a minimum of
            its joints' mean speed; None = it keeps its own time.
    """

    values: Tensor
    known: Tensor
    beats: Tensor | None = None

    @classmethod
    def free(cls, frames: int, rows: int = 23, channels: int = 6) -> Self:
        """Nothing is given."""
        shape = (frames, rows, channels)
        return cls(torch.zeros(shape), torch.zeros(shape, dtype=torch.bool))

    def __len__(self) -> int:
        return len(self.values)

    def window(self, start: int, stop: int, *, fps: float = 30.0) -> "Constraint":
        """Frames [start, stop); the beats count from its first frame."""
        beats = None if self.beats is None else self.beats - start / fps
        return Constraint(self.values[start:stop], self.known[start:stop], beats)

    def keep(self, features: Tensor) -> Tensor:
        """Raw features [T, K, C] with the known entries as they were given."""
        rows = features.shape[1]
        return torch.where(self.known[:, :rows], self.values[:, :rows], features)


@dataclass(frozen=True)
class Given:
    """A batch of constraints as the network sees them: known [B, T, K, C] bool, beats
    [B, T, BEAT_CHANNELS]."""

    known: Tensor
    beats: Tensor


def beat_track(beats: Tensor | None, frames: int, fps: float) -> Tensor:
    """Beats in seconds [M] as channels [T, 3]: a bump at each, the signed time from the nearest
    in units of `BEAT_REACH`, and whether beats are given at all; zeros without."""
    track = torch.zeros(frames, BEAT_CHANNELS)
    if beats is None:
        return track
    track[:, 2] = 1.0
    if len(beats):
        away = torch.arange(frames)[:, None] / fps - beats.float()  # [T, M]
        nearest = away.gather(1, away.abs().argmin(dim=1, keepdim=True))[:, 0]
        track[:, 0] = torch.exp(-0.5 * (nearest * fps / BEAT_WIDTH) ** 2)
        track[:, 1] = (nearest / BEAT_REACH).clamp(-1, 1)
    return track


@dataclass(frozen=True)
class KnownBatch:
    """Constraints of one batch: z-scored values [B, T, K, C] where `given.known`."""

    values: Tensor
    given: Given

    @classmethod
    def of(
        cls,
        constraints: Sequence[Constraint | None],
        frames: int,
        mean: Tensor,
        std: Tensor,
        *,
        fps: float,
    ) -> Self | None:
        """Padded to `frames` on the device of mean and std [K, C]; None where nothing is given."""
        if all(constraint is None for constraint in constraints):
            return None
        rows, channels = mean.shape
        values = torch.zeros(len(constraints), frames, rows, channels)
        known = torch.zeros(values.shape, dtype=torch.bool)
        beats = torch.zeros(len(constraints), frames, BEAT_CHANNELS)
        for row, constraint in enumerate(constraints):
            if constraint is not None:
                length = len(constraint)
                values[row, :length] = constraint.values[:, :rows]
                known[row, :length] = constraint.known[:, :rows]
                beats[row, :length] = beat_track(constraint.beats, length, fps)
        device = mean.device
        known = known.to(device)
        z_scored = torch.where(known, (values.to(device) - mean) / std, 0.0)
        return cls(z_scored, Given(known, beats.to(device)))

    def hold(
        self, model_fn: ModelFn, diffusion: GaussianDiffusion, noise: Tensor, *, clean: bool
    ) -> ModelFn:
        """The model with the known entries put in before, and put right after, each call.

        Args:
            model_fn: with its condition inside.
            diffusion: its process.
            noise: [B, T, K, C] that sampling starts from; the known entries are noised with it.
            clean: hand the known entries over without noise, as the network learned it.
        """
        known = self.given.known

        def held(x_t: Tensor, t: Tensor) -> Tensor:
            noised = diffusion.q_sample(self.values, t, noise)
            output = model_fn(torch.where(known, self.values if clean else noised, x_t), t)
            return torch.where(known, diffusion.output_for(self.values, x_t, t), output)

        return held


def check_lengths(constraints: Sequence[Constraint | None], frames: Sequence[int]) -> None:
    """Raises UsageError where a constraint is not as long as its motion."""
    for constraint, length in zip(constraints, frames, strict=True):
        if constraint is not None and len(constraint) != length:
            raise UsageError(
                f"a constraint of {len(constraint)} frames for a motion of {length}; give both the"
                " same length"
            )
