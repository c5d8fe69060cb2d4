"""What of a motion is given beforehand: known entries, and the moments of its beats.

A network with `generation.constraints` sees the known entries clean, beside a mask of them (Cohan
et al. 2024, CondMDI: observed entries overwrite the noisy ones and the mask is an input). Any other
network gets them noised to each step (Lugmayr et al. 2022, RePaint, without its resampling). Beats
are no input: knowing them hardly helps to denoise (docs/experiments.md); they guide the sampling.

Letters: B batch, T frames, K rows (bones, root track), C channels, M beats.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import torch
from torch import Tensor

from ...errors import UsageError
from ..diffusion.conditions import ModelFn
from ..diffusion.gaussian import GaussianDiffusion
from .rhythm import RhythmGuidance


@dataclass(frozen=True, eq=False)
class Constraint:
    """What is given of one motion.

    Attributes:
        values: raw features [T, K, C], not z-scored; used where `known`.
        known: [T, K, C] bool.
        beats: seconds [M] from the first frame at which the body is to have a beat, a minimum of
            its joints' mean speed; None = it keeps its own time.
        told: [T, K, C] bool, which of the known entries the network is shown clean, if it is one
            that can be; it gets the others noised, as any network does. A network that is told
            most of a body makes the rest fit it, whatever the text says. None = all of them.
    """

    values: Tensor
    known: Tensor
    beats: Tensor | None = None
    told: Tensor | None = None

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
        told = None if self.told is None else self.told[start:stop]
        return Constraint(self.values[start:stop], self.known[start:stop], beats, told)

    def keep(self, features: Tensor) -> Tensor:
        """Raw features [T, K, C] with the known entries as they were given."""
        rows = features.shape[1]
        return torch.where(self.known[:, :rows], self.values[:, :rows], features)


@dataclass(frozen=True, eq=False)
class KnownBatch:
    """Constraints of one batch.

    Attributes:
        values: [B, T, K, C] z-scored, used where `known` [B, T, K, C] bool.
        told: [B, T, K, C] bool, the known entries that the network is shown clean.
        rhythm: what leads the bodies to their beats; None where nobody has any.
    """

    values: Tensor
    known: Tensor
    told: Tensor
    rhythm: RhythmGuidance | None

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
        known, told = (torch.zeros(values.shape, dtype=torch.bool) for _ in range(2))
        beats: list[Tensor | None] = [None] * len(constraints)
        for row, constraint in enumerate(constraints):
            if constraint is not None:
                length = len(constraint)
                values[row, :length] = constraint.values[:, :rows]
                known[row, :length] = constraint.known[:, :rows]
                shown = constraint.known if constraint.told is None else constraint.told
                told[row, :length] = (constraint.known & shown)[:, :rows]
                beats[row] = constraint.beats
        known, told = known.to(mean.device), told.to(mean.device)
        z_scored = torch.where(known, (values.to(mean.device) - mean) / std, 0.0)
        rhythm = RhythmGuidance.of(beats, frames, mean, std, fps=fps)
        return cls(z_scored, known, told, rhythm)

    def hold(
        self, model_fn: ModelFn, diffusion: GaussianDiffusion, noise: Tensor, *, clean: bool
    ) -> ModelFn:
        """The model with the known entries put in before, and put right after, each call.

        Args:
            model_fn: with its condition inside.
            diffusion: its process.
            noise: [B, T, K, C] that sampling starts from; the known entries are noised with it.
            clean: hand over what is told without noise, as the network learned it.
        """
        known, told = self.known, self.told & clean

        def held(x_t: Tensor, t: Tensor) -> Tensor:
            noised = diffusion.q_sample(self.values, t, noise)
            shown = torch.where(known & ~told, noised, x_t)
            output = model_fn(torch.where(told, self.values, shown), t).to(x_t.dtype)
            if self.rhythm is not None:
                x_0 = torch.where(known, self.values, diffusion.predict_x0(output, x_t, t))
                output = diffusion.output_for(self.rhythm(x_0, free=~known), x_t, t)
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
