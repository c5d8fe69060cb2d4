"""Noise schedules end in noise, keep the documents' formulas, and space steps as published."""

import zlib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import torch
from diffusers import DDIMScheduler
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_schema import DiffusionConfig
from src.shared.errors import UsageError
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.model.noise import (
    NoiseStream,
    derived_seed,
    get_beta_schedule,
    philox,
    sampling_timesteps,
)

SCHEDULES = ("linear", "cosine", "sqrt")
SPACINGS = ("halved", "leading", "linspace", "trailing")


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


def test_halved_is_trailing_with_one_step_more_at_the_start() -> None:
    assert sampling_timesteps(1000, 6, "halved") == (999, 899, 799, 599, 399, 199)
    assert [sampling_timesteps(1000, count, "halved") for count in (1, 2)] == [(999,), (999, 499)]
    assert sampling_timesteps(8, 8, "halved") == sampling_timesteps(8, 8, "trailing")


@pytest.mark.parametrize("spacing", SPACINGS[1:])
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


# ------------------------------------------------------------ counter-based noise


@pytest.mark.parametrize(
    ("counter", "seed", "words"),
    [  # Random123's known answers, version 1.09
        ((0,) * 4, 0, "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
        ((0xFFFFFFFF,) * 4, 0xFFFFFFFFFFFFFFFF, "408f276d 41c83b0e a20bc7c6 6d5451fd"),
        (
            (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
            0x299F31D0A4093822,
            "d16cfe09 94fdcceb 5001e420 24126ea1",
        ),
    ],
)
def test_philox_gives_the_published_words(counter: tuple[int, ...], seed: int, words: str) -> None:
    assert " ".join(f"{int(word):08x}" for word in philox(counter, seed)) == words


def test_noise_is_standard_normal_and_a_draw_its_own() -> None:
    stream = NoiseStream(3, 7, 1)
    first, second = stream.normal((501, 23, 6)), stream.normal((501, 23, 6))
    assert first.dtype == torch.float32 and first.isfinite().all()
    assert abs(float(first.mean())) < 0.01 and abs(float(first.std()) - 1) < 0.01
    flat = torch.stack((first.flatten(), second.flatten()))
    assert abs(float(torch.corrcoef(flat)[0, 1])) < 0.01
    again = NoiseStream(3, 7, 1)
    assert torch.equal(again.normal((3,)), first.flatten()[:3]), "a shorter motion begins alike"
    assert torch.equal(again.normal((501, 23, 6)), second)
    others = [NoiseStream(*parts).normal((8,)) for parts in ((4, 7, 1), (3, 8, 1), (3, 7, 2))]
    assert not any(torch.equal(other, first.flatten()[:8]) for other in others)


def test_the_first_numbers_are_those_of_the_document() -> None:
    """docs/onnx.md prints them for whoever writes the generator again."""
    document = (Path(__file__).parents[3] / "docs" / "onnx.md").read_text("utf-8")
    found = NoiseStream(0, zlib.crc32(b"a person waves"), 0).normal((4,))
    assert " ".join(f"{float(number):.6f}" for number in found) in document


def test_derived_seeds_differ_and_fit() -> None:
    assert derived_seed(5, 0) == 5
    seeds = {derived_seed(seed, number) for seed in (0, 5, 2**63 - 1) for number in range(1, 50)}
    assert len(seeds) == 147 and all(0 <= seed < 2**63 for seed in seeds)
