"""Rhythm guidance: a body led, while it is denoised, to slow down on given beats.

Each predicted clean motion is moved down the gradient of

    E = mean over t of w(t) log(v(t) + v0),    w(t) = cos 2 pi phi(t),

v the mean speed of the joints in the world, phi counting beats: slow on a beat, fast halfway
(guidance by a loss on the predicted x0: Chung et al. 2023, DPS; Bansal et al. 2023, universal
guidance; here without going back through the network). The gradient is smoothed over time, so that
a limb is led and not jerked; the steps that follow make the result a motion again.

Letters: B batch, T frames, K rows (bones, root track), C channels, M beats.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional as F

from ...motion.features import world_joints

STEP = 0.02  # root mean square of one move, in standard deviations of the data
MOVES = 3  # a prediction
SMOOTHING = 2.5  # frames, standard deviation of the kernel over the gradient
SLOW = 0.05  # m/s, v0: below it speed hardly counts, a standing body is not shaken
BEYOND = 1.5  # beats; further than this from the first and the last one nothing is asked for


@dataclass(frozen=True, eq=False)
class RhythmGuidance:
    """Leads a batch of z-scored motions to their beats.

    Attributes:
        weight: w [B, T - 1], 0 where nothing is asked for.
        mean, std: [K, C] of the z-scores.
        fps: frames per second.
    """

    weight: Tensor
    mean: Tensor
    std: Tensor
    fps: float

    @classmethod
    def of(
        cls,
        beats: Sequence[Tensor | None],
        frames: int,
        mean: Tensor,
        std: Tensor,
        *,
        fps: float,
    ) -> Self | None:
        """For beats in seconds [M], one row a motion; None where no row tells a tempo."""
        if frames < 2 or all(row is None or len(row) < 2 for row in beats):
            return None
        weight = torch.stack([beat_weight(row, frames, fps) for row in beats])
        return cls(weight.to(mean.device), mean, std, fps)

    def __call__(self, x_0: Tensor, *, free: Tensor) -> Tensor:
        """Motions [B, T, K, C] moved where `free` [B, T, K, C] bool."""
        for _ in range(MOVES):
            gradient = smoothed(self._gradient(x_0), SMOOTHING) * free
            size = gradient.square().mean((1, 2, 3), keepdim=True).sqrt()
            x_0 = x_0 - STEP * gradient / size.clamp_min(1e-12)
        return x_0

    def _gradient(self, x_0: Tensor) -> Tensor:
        with torch.inference_mode(False), torch.enable_grad():
            leaf = x_0.clone().requires_grad_()  # inference tensors have no gradient
            joints = world_joints(leaf * self.std.clone() + self.mean.clone(), self.fps)
            speed = (joints[:, 1:] - joints[:, :-1]).norm(dim=-1).mean(-1) * self.fps  # [B, T-1]
            energy = (self.weight.clone() * torch.log(speed + SLOW)).mean(-1).sum()
            (gradient,) = torch.autograd.grad(energy, leaf)
        return gradient.detach()


def beat_weight(beats: Tensor | None, frames: int, fps: float) -> Tensor:
    """cos 2 pi phi between neighbouring frames [T - 1]; 1 on beats [M] in seconds, 0 far away."""
    if beats is None or len(beats) < 2:
        return torch.zeros(frames - 1)
    times = np.sort(beats.cpu().numpy().astype(np.float64))
    before, after = times[1] - times[0], times[-1] - times[-2]
    known = np.concatenate((times[:1] - 2 * before, times, times[-1:] + 2 * after))
    count = np.concatenate(([-2.0], np.arange(len(times)), [len(times) + 1.0]))
    phase = np.interp((np.arange(frames - 1) + 0.5) / fps, known, count)
    asked = (phase > -BEYOND) & (phase < len(times) - 1 + BEYOND)
    return torch.from_numpy(np.where(asked, np.cos(2 * np.pi * phase), 0.0)).float()


def smoothed(series: Tensor, deviation: float) -> Tensor:
    """[B, T, K, C] convolved over time with a Gaussian of that many frames; the ends repeat."""
    reach = round(3 * deviation)
    kernel = torch.exp(
        -0.5 * (torch.arange(-reach, reach + 1, device=series.device) / deviation) ** 2
    )
    rows = series.flatten(2).transpose(1, 2)  # B K*C T
    padded = F.pad(rows, (reach, reach), mode="replicate")
    smooth = F.conv1d(padded.flatten(0, 1)[:, None], (kernel / kernel.sum())[None, None])
    return smooth.view(rows.shape).transpose(1, 2).view_as(series)
