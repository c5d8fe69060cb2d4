"""Noise: how fast the signal fades in it, which steps a sampler visits, and where it is drawn.

Schedules are NumPy in float64; the diffusion process rounds to float32 once, at the end.

Letters: S training steps, N sampling steps. Timestep t runs from 0 (almost clean) to S-1.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..config_schema import DiffusionConfig
from ..errors import UsageError
from ..tensors import Tensor, torch

Array = NDArray[np.float64]

COSINE_OFFSET = 0.008  # s of Nichol & Dhariwal 2021, eq. 17
MOST_FEW = 2  # steps that begin with a learned one
MAX_FINAL_SIGNAL = 0.02  # sqrt(alpha_bar) at the last step stays below this (SPEC ruling 15)


def get_beta_schedule(
    schedule: str, timesteps: int, beta_start: float = 1e-4, beta_end: float = 0.02
) -> Array:
    """Noise added at each training step, float64 [S] (TECH 3.2.2).

    `linear` and `sqrt` are stated for 1000 steps and scaled by 1000/S, and every schedule ends in
    noise: TECH's `sqrt` would keep 2.7% of the signal (SPEC ruling 15). Betas of `cosine` are
    clipped to [1e-4, 0.9999] (Nichol & Dhariwal 2021, eq. 17; SPEC ruling 13).

    Raises:
        UsageError: the schedule is not one of linear, cosine, sqrt.
    """
    if schedule == "cosine":
        progress = np.linspace(0.0, 1.0, timesteps + 1)
        signal = np.cos((progress + COSINE_OFFSET) / (1 + COSINE_OFFSET) * np.pi / 2) ** 2
        betas = 1.0 - signal[1:] / signal[:-1]
    elif schedule == "linear":
        betas = np.linspace(beta_start, beta_end, timesteps) * (1000 / timesteps)
    elif schedule == "sqrt":
        roots = np.linspace(beta_start**0.5, beta_end**0.5, timesteps)
        betas = roots**2 * (1000 / timesteps)
    else:
        raise UsageError(
            f"beta-schedule {schedule!r} is unknown; choose one of linear, cosine, sqrt"
        )
    clipped: Array = np.clip(betas, 1e-4 if schedule == "cosine" else 1e-8, 0.9999)
    # Every alpha is raised to the one power that keeps sqrt(alpha_bar_S) under the limit.
    log_signal = 0.5 * float(np.log1p(-clipped).sum())
    power = np.log(0.95 * MAX_FINAL_SIGNAL) / log_signal
    return clipped if power <= 1 else -np.expm1(power * np.log1p(-clipped))


@dataclass(frozen=True)
class NoiseSchedule:
    """The betas [S] and their running product of alphas [S], both float64."""

    betas: Array
    alphas_cumprod: Array

    @classmethod
    def from_config(cls, config: DiffusionConfig) -> "NoiseSchedule":
        """Build the schedule that a configuration names."""
        betas = get_beta_schedule(
            config.beta_schedule, config.timesteps, config.beta_start, config.beta_end
        )
        return cls(betas=betas, alphas_cumprod=np.cumprod(1.0 - betas, dtype=np.float64))


def few_from_noise(process: DiffusionConfig, steps: int | None = None) -> bool:
    """Whether so many steps, None: its own, are one or two and begin at noise alone, as a learned
    first step does."""
    number = steps or process.sampling_steps
    if number > MOST_FEW:
        return False
    times = sampling_timesteps(process.timesteps, number, process.timestep_spacing)
    return times[0] == process.timesteps - 1


def sampling_timesteps(num_timesteps: int, num_steps: int, spacing: str) -> tuple[int, ...]:
    """The N of S steps that a sampler visits, largest first (Lin et al. 2023, table 2).

    `trailing` always starts at S-1, where training ends; `leading` never does and is here for
    checkpoints that were tuned with it. One step starts at S-1 under `linspace` as well. `halved`
    is trailing in N-1 steps with the first of them in two halves: from noise alone the prediction
    is farthest from where it ends (docs/experiments.md, section 60).

    Raises:
        UsageError: N is not within 1 ... S, or the spacing is unknown.
    """
    if not 1 <= num_steps <= num_timesteps:
        raise UsageError(
            f"steps {num_steps} is not within 1 ... {num_timesteps}, the steps of the model's"
            " training"
        )
    count = np.arange(num_steps)
    if spacing == "trailing":
        steps = np.round(num_timesteps - count * (num_timesteps / num_steps)) - 1
    elif spacing == "halved":
        if 2 * (num_steps - 1) > num_timesteps:  # half a step would be none
            return sampling_timesteps(num_timesteps, num_steps, "trailing")
        places = np.concatenate(([0, 0.5], count[1:-1]))[:num_steps]
        steps = np.round(num_timesteps - places * (num_timesteps / max(1, num_steps - 1))) - 1
    elif spacing == "linspace":
        steps = np.round(np.linspace(num_timesteps - 1, 0, num_steps))
    elif spacing == "leading":
        steps = count[::-1] * (num_timesteps // num_steps)
    else:
        raise UsageError(
            f"timestep-spacing {spacing!r} is unknown; choose one of halved, leading, linspace,"
            " trailing"
        )
    return tuple(int(step) for step in steps)


# ---------------------------------------------------------------- drawing

_MULTIPLIERS = (0xD2511F53, 0xCD9E8D57)
_WEYL = (0x9E3779B9, 0xBB67AE85)
_ROUNDS, _LOW, _WORD = 10, np.uint64(0xFFFFFFFF), np.uint64(32)
_NO_SAMPLE = 0xFFFFFFFF  # in the counter of what is no motion's noise


def philox(counter: Sequence[int | NDArray[np.uint64]], seed: int) -> list[NDArray[np.uint64]]:
    """Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").

    Args:
        counter: four 32-bit words, or arrays of them.
        seed: the key, below 2^64.

    Returns:
        Four arrays of 32-bit words.
    """
    words = np.broadcast_arrays(*(np.asarray(word, np.uint64) for word in counter))
    c0, c1, c2, c3 = words
    key = [seed & 0xFFFFFFFF, seed >> 32 & 0xFFFFFFFF]
    first, second = map(np.uint64, _MULTIPLIERS)
    for _ in range(_ROUNDS):
        low, high = first * c0, second * c2  # 64-bit products of 32-bit words
        c0, c1, c2, c3 = (
            (high >> _WORD) ^ c1 ^ np.uint64(key[0]),
            high & _LOW,
            (low >> _WORD) ^ c3 ^ np.uint64(key[1]),
            low & _LOW,
        )
        key = [(word + step) & 0xFFFFFFFF for word, step in zip(key, _WEYL, strict=True)]
    return [c0, c1, c2, c3]


class NoiseStream:
    """Standard normals that any runtime can make: a function of (seed, text, sample, draw, place).

    Each draw takes the next number of draws: the first one is 0. docs/onnx.md writes it down.

    Args:
        seed: below 2^63.
        text: CRC-32 of the prompt, 0 without one.
        sample: which one of that prompt.
    """

    def __init__(self, seed: int, text: int = 0, sample: int = 0) -> None:
        self.seed, self.text, self.sample = seed, text, sample
        self.draws = 0

    def normal(self, shape: Sequence[int]) -> Tensor:
        """The next draw, float32 on the CPU."""
        count = math.prod(shape)
        blocks = np.arange(-(-count // 4), dtype=np.uint64)
        words = philox((blocks, self.draws, self.text, self.sample), self.seed)
        self.draws += 1
        u = [(word.astype(np.float64) + 0.5) * 2.0**-32 for word in words]
        numbers = np.empty((len(blocks), 4))
        for at in (0, 2):  # Box & Muller 1958
            radius, angle = np.sqrt(-2 * np.log(u[at])), 2 * np.pi * u[at + 1]
            numbers[:, at], numbers[:, at + 1] = radius * np.cos(angle), radius * np.sin(angle)
        flat = numbers.ravel()[:count].astype(np.float32)
        return torch.from_numpy(flat).reshape(tuple(shape))


Generators = torch.Generator | Sequence[NoiseStream] | None


def derived_seed(seed: int, number: int) -> int:
    """Another seed, below 2^63, for the number 1, 2, ... of a part; the seed itself for 0."""
    if number == 0:
        return seed
    low, high, *_ = philox((number, 0, 0, _NO_SAMPLE), seed)
    return int(low) + (int(high) >> 1 << 32)


TRIES = 8  # samples at most of what is sampled again until it is right


def retry_seeds(seed: int) -> Iterator[int]:
    """The seeds of TRIES samples, the first one `seed` itself."""
    return map(partial(derived_seed, seed), range(TRIES))


def sample_generators(seed: int, num_samples: int, start: int = 0) -> list[NoiseStream]:
    """The noise of each of the samples start ... start + num_samples - 1.

    Sample i depends on (seed, i) alone: not on the batch size, its neighbours, or the device.
    """
    return [NoiseStream(seed, sample=index) for index in range(start, start + num_samples)]


def standard_normal(
    shape: Sequence[int], generator: Generators = None, *, device: torch.device | str = "cpu"
) -> Tensor:
    """Float32 noise of the given shape.

    Drawn on the CPU and moved, so that a seed means the same on CPU, CUDA and MPS. A sequence of
    streams gives each batch element its own.
    """
    shape = tuple(shape)
    if generator is None or isinstance(generator, torch.Generator):
        return torch.randn(shape, generator=generator, dtype=torch.float32).to(device)
    assert len(generator) == shape[0], f"{len(generator)} streams for a batch of {shape[0]}"
    return torch.stack([own.normal(shape[1:]) for own in generator]).to(device)
