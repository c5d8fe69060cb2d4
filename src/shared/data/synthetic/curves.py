"""Curves over time that the synthetic actions are made of; pure NumPy.

T frames. Every function takes times or progress [T] and returns [T] unless stated.
"""

from collections.abc import Sequence

import numpy as np

Array = np.ndarray


def min_jerk(progress: Array) -> Array:
    """0 → 1 with zero speed and acceleration at both ends (Flash & Hogan 1985)."""
    x = np.clip(progress, 0.0, 1.0)
    return x**3 * (10.0 + x * (6.0 * x - 15.0))


def smooth_step(progress: Array) -> Array:
    """0 → 1 with zero speed at both ends; brisker than `min_jerk`."""
    x = np.clip(progress, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def ramp(t: Array, start: float, duration: float) -> Array:
    """0 before `start` seconds, 1 after `start + duration`, minimum jerk between."""
    return min_jerk((t - start) / max(duration, 1e-6))


def bump(progress: Array, peak: float = 0.5) -> Array:
    """0 → 1 → 0 over progress 0 … 1 with the maximum at `peak`, smooth everywhere."""
    x = np.clip(progress, 0.0, 1.0)
    return np.where(x < peak, min_jerk(x / peak), min_jerk((1.0 - x) / (1.0 - peak)))


def keyframes(t: Array, keys: Sequence[tuple[float, float]]) -> Array:
    """Minimum-jerk interpolation of (time, value) keys; constant outside them."""
    times = np.array([time for time, _ in keys])
    values = np.array([value for _, value in keys])
    if len(keys) == 1:
        return np.full_like(t, values[0])
    index = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(keys) - 2)
    span = np.maximum(times[index + 1] - times[index], 1e-6)
    blend = min_jerk((t - times[index]) / span)
    return values[index] + (values[index + 1] - values[index]) * blend


def hermite(t: Array, keys: Sequence[tuple[float, float, float]]) -> Array:
    """Cubic interpolation of (time, value, speed) keys; constant outside them."""
    times, values, speeds = np.array(keys, dtype=float).T
    index = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(keys) - 2)
    span = times[index + 1] - times[index]
    x = np.clip((t - times[index]) / span, 0.0, 1.0)
    return (
        (1 + 2 * x) * (1 - x) ** 2 * values[index]
        + x * (1 - x) ** 2 * span * speeds[index]
        + x * x * (3 - 2 * x) * values[index + 1]
        + x * x * (x - 1) * span * speeds[index + 1]
    )


def smooth_noise(rng: np.random.Generator, t: Array, amplitude: float, period: float) -> Array:
    """Slow wandering: three sines near `period` seconds with random phases, |value| ≤ amplitude."""
    rates = 2 * np.pi / (period * rng.uniform((0.7, 1.2, 2.0), (1.0, 1.7, 2.8)))
    phases = rng.uniform(0, 2 * np.pi, 3)
    weights = np.array([0.5, 0.3, 0.2])
    return amplitude * (weights * np.sin(t[:, None] * rates + phases)).sum(1)


def gaussian_smooth(values: Array, sigma: float) -> Array:
    """Gaussian filter along time, `sigma` in frames; ends are repeated."""
    radius = int(np.ceil(3 * sigma))
    kernel = np.exp(-0.5 * (np.arange(-radius, radius + 1) / sigma) ** 2)
    padded = np.pad(values, radius, mode="edge")
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


def upper_envelope(values: Array, radius: int) -> Array:
    """A smooth curve that stays above `values`: running maximum, then a narrower smoothing."""
    padded = np.pad(values, radius, mode="edge")
    highest = np.lib.stride_tricks.sliding_window_view(padded, 2 * radius + 1).max(1)
    return gaussian_smooth(highest, radius / 3)
