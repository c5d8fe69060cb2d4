"""Noise schedules end in noise, keep the documents' formulas, and space steps as published."""

from itertools import pairwise

import numpy as np
import pytest
import torch
from diffusers import DDIMScheduler
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_schema import DiffusionConfig
from src.shared.errors import UsageError
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.model.noise import get_beta_schedule, sampling_timesteps

SCHEDULES = ("linear", "cosine", "sqrt")
SPACINGS = ("leading", "linspace", "trailing")


@pytest.mark.parametrize("schedule", SCHEDULES)
@pytest.mark.parametrize("timesteps", [2, 3, 10, 50, 100, 999, 1000, 4000])
def test_the_last_step_is_noise(schedule: str, timesteps: int) -> None:
    betas = get_beta_schedule(schedule, timesteps)
    alpha_bar = np.cumprod(1 - betas)
    assert betas.shape == (timesteps,)
    assert betas.dtype == np.float64
    assert (betas > 0).all() and (betas <= 0.9999).all()
    assert (np.diff(alpha_bar) < 0).all()
    assert np.sqrt(alpha_bar[-1]) < 0.02


def test_a_weak_end_is_raised_to_the_limit() -> None:
    alpha_bar = np.cumprod(1 - get_beta_schedule("linear", 100, 1e-4, 0.003))
    assert 0.01 < np.sqrt(alpha_bar[-1]) < 0.02


def test_linear_at_1000_steps_is_the_printed_one() -> None:
    np.testing.assert_allclose(
        get_beta_schedule("linear", 1000), np.linspace(1e-4, 0.02, 1000), rtol=1e-12
    )


def test_cosine_is_the_printed_one() -> None:
    t = np.linspace(0, 1000, 1001) / 1000
    signal = np.cos((t + 0.008) / 1.008 * np.pi / 2) ** 2
    printed = np.clip(1 - signal[1:] / signal[:-1], 0.0001, 0.9999)
    np.testing.assert_allclose(get_beta_schedule("cosine", 1000), printed, rtol=1e-9)


def test_sqrt_stays_within_a_tenth_of_the_printed_one() -> None:
    printed = np.linspace(1e-4**0.5, 0.02**0.5, 1000) ** 2
    np.testing.assert_allclose(get_beta_schedule("sqrt", 1000), printed, rtol=0.1)


def test_buffers_are_float32_and_stay_out_of_checkpoints() -> None:
    diffusion = GaussianDiffusion(DiffusionConfig())
    assert {buffer.dtype for buffer in diffusion.buffers()} == {torch.float32}
    assert not diffusion.state_dict()
    assert all(torch.isfinite(buffer).all() for buffer in diffusion.buffers())


@given(total=st.integers(1, 1200), share=st.floats(0, 1), spacing=st.sampled_from(SPACINGS))
def test_timesteps_fall_strictly_within_range(total: int, share: float, spacing: str) -> None:
    count = 1 + round(share * (total - 1))
    steps = sampling_timesteps(total, count, spacing)
    assert len(steps) == count
    assert all(a > b for a, b in pairwise(steps))
    assert total > steps[0] and steps[-1] >= 0
    if spacing != "leading":
        assert steps[0] == total - 1


@pytest.mark.parametrize("spacing", SPACINGS)
@pytest.mark.parametrize(("total", "count"), [(1000, 50), (1000, 7), (100, 20), (100, 30)])
def test_timesteps_equal_diffusers(spacing: str, total: int, count: int) -> None:
    oracle = DDIMScheduler(num_train_timesteps=total, timestep_spacing=spacing)
    oracle.set_timesteps(count)
    assert sampling_timesteps(total, count, spacing) == tuple(oracle.timesteps.tolist())


def test_wrong_values_are_named() -> None:
    with pytest.raises(UsageError, match=r"steps 0 .* 1 \.\.\. 100"):
        sampling_timesteps(100, 0, "trailing")
    with pytest.raises(UsageError, match="steps 101"):
        sampling_timesteps(100, 101, "trailing")
    with pytest.raises(UsageError, match=r"'even'.*leading"):
        sampling_timesteps(100, 10, "even")
    with pytest.raises(UsageError, match=r"'square'.*cosine"):
        get_beta_schedule("square", 100)
