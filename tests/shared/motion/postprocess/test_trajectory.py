"""TECH §9 against a NumPy oracle written from its text, and NumPy against Torch."""

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from src.shared.config_audio import AudioNetworkConfig, PostProcessConfig
from src.shared.config_loader import load_config
from src.shared.errors import UsageError
from src.shared.motion.postprocess.trajectory import (
    MotionPostProcessor,
    MotionPostProcessorTorch,
)
from src.shared.motion.trajectory import (
    ACCELERATION,
    ANGULAR_VELOCITY,
    PHASE,
    POSITION,
    QUATERNION,
    STYLE,
    VELOCITY,
)
from tests.shared.motion.trajectories import smooth_trajectory

seeds = st.integers(0, 10_000)
switches = st.fixed_dictionaries(
    {
        name: st.booleans()
        for name in (
            "normalize_quaternions",
            "smooth_quaternions",
            "clamp_phase",
            "enforce_phase_monotonic",
            "clamp_values",
            "enforce_velocity_coherence",
            "enforce_accel_coherence",
            "apply_smoothing",
        )
    }
)


def rough_batch(seed: int, num_frames: int = 40) -> np.ndarray:
    """What a badly trained model might give: [2,T,25], far out of every bound."""
    rng = np.random.default_rng(seed)
    motion = np.stack([smooth_trajectory(seed + i, num_frames).data for i in range(2)])
    motion += rng.normal(0, 0.05, motion.shape)
    motion[..., : QUATERNION.start] *= rng.choice((1, 80), motion[..., :9].shape, p=(0.9, 0.1))
    motion[..., ANGULAR_VELOCITY] *= 8
    motion[..., QUATERNION] *= rng.uniform(0.5, 2, motion[..., 9:10].shape)
    return motion.astype(np.float32)


def oracle(motion: np.ndarray, config: PostProcessConfig) -> np.ndarray:
    """TECH §9.2 for one [T,25] with rulings 6, 9 and 10, frame by frame in float64."""
    m = motion.astype(np.float64)
    if config.clamp_values:
        for columns, bound in ((POSITION, 100), (VELOCITY, 50), (ACCELERATION, 100),
                               (ANGULAR_VELOCITY, 10)):  # fmt: skip
            m[:, columns] = np.clip(m[:, columns], -bound, bound)
    q = m[:, QUATERNION]

    def follow(q: np.ndarray) -> None:
        q[0] *= -1 if q[0, 0] < 0 else 1
        for t in range(1, len(q)):
            q[t] *= -1 if q[t] @ q[t - 1] < 0 else 1

    if config.normalize_quaternions:
        q /= np.linalg.norm(q, axis=1, keepdims=True)
        follow(q)
    if config.smooth_quaternions:
        follow(q)
        q[:] = average(q, np.full(5, 1 / 5))
        q /= np.linalg.norm(q, axis=1, keepdims=True)
        follow(q)
    if config.enforce_phase_monotonic:
        m[:, PHASE] = np.maximum.accumulate(np.unwrap(m[:, PHASE], period=1))
    if config.clamp_phase:
        m[:, PHASE] %= 1
    if config.enforce_velocity_coherence:
        m[:, VELOCITY] = (m[:, VELOCITY] + rate(m[:, POSITION])) / 2
    if config.enforce_accel_coherence:
        m[:, ACCELERATION] = (m[:, ACCELERATION] + rate(m[:, VELOCITY])) / 2
    if config.apply_smoothing:
        kept = q.copy()
        m[:, PHASE] = np.unwrap(m[:, PHASE], period=1)
        m = average(m, np.array((0.25, 0.5, 0.25)))
        m[:, QUATERNION] = kept
        m[:, PHASE] = m[:, PHASE] % 1 if config.clamp_phase else m[:, PHASE]
        m[:, STYLE] /= np.linalg.norm(m[:, STYLE], axis=1, keepdims=True)
    return m


def rate(x: np.ndarray) -> np.ndarray:
    steps = np.diff(x, axis=0) * 30
    return np.concatenate((steps, steps[-1:]))


def average(x: np.ndarray, weights: np.ndarray) -> np.ndarray:
    half = len(weights) // 2
    padded = np.pad(x, ((half, half), (0, 0)), mode="reflect", reflect_type="odd")
    return np.stack([np.convolve(column, weights, "valid") for column in padded.T], 1)


def difference(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Relative to a column's largest value; a phase on the other side of the bar line is near."""
    error = np.abs(a - b) / np.maximum(1, np.abs(b).max(-2, keepdims=True))
    error[..., PHASE] = np.minimum(error[..., PHASE], np.abs(1 - error[..., PHASE]))
    return error


@settings(max_examples=40)
@given(seeds, switches)
def test_numpy_and_torch_do_what_tech_says(seed: int, options: dict[str, bool]) -> None:
    config = PostProcessConfig(**options)  # type: ignore[arg-type]
    motion = rough_batch(seed)
    ours = MotionPostProcessor(config).process(motion)
    torched = MotionPostProcessorTorch(config).process(torch.from_numpy(motion).transpose(1, 2))
    assert difference(torched.transpose(1, 2).numpy(), ours).max() < 1e-5
    expected = np.stack([oracle(one, config) for one in motion])
    assert difference(ours, expected).max() < 1e-4
    assert difference(MotionPostProcessor(config).process(motion[0]), ours[0]).max() < 1e-5


@settings(max_examples=20)
@given(seeds)
def test_what_comes_out_keeps_the_promises(seed: int) -> None:
    config = PostProcessConfig(enforce_phase_monotonic=True)
    processor = MotionPostProcessor(config)
    motion = processor.process(rough_batch(seed))
    q, phase = motion[..., QUATERNION], motion[..., PHASE].astype(np.float64)
    assert np.linalg.norm(q, axis=-1) == pytest.approx(1, abs=1e-5)
    assert (q[:, 0, 0] >= 0).all() and ((q[:, 1:] * q[:, :-1]).sum(-1) >= 0).all()
    assert phase.min() >= 0 and phase.max() < 1
    steps = np.diff(phase)
    assert (steps - np.round(steps)).min() > -1e-6
    assert sum(processor.count_clamped(motion).values()) == 0
    assert difference(processor.process(motion), motion).max() < 1e-5


def test_good_motion_passes_untouched() -> None:
    whole = smooth_trajectory(3)
    assert np.abs(MotionPostProcessor().process(whole.data) - whole.data).max() < 1e-6


def test_clamped_values_are_counted() -> None:
    motion = smooth_trajectory(3).data.copy()
    motion[4, 0], motion[5, 3:6], motion[6, 6], motion[7, 13], motion[8, PHASE] = (
        101, 60, -300, 11, 1.5)  # fmt: skip
    expected = {"position": 1, "velocity": 3, "acceleration": 1, "angular_velocity": 1, "phase": 1}
    assert MotionPostProcessor().count_clamped(motion) == expected
    assert MotionPostProcessorTorch().count_clamped(torch.from_numpy(motion).T[None]) == expected
    off = MotionPostProcessor(PostProcessConfig(clamp_values=False, clamp_phase=False))
    assert not any(off.count_clamped(motion).values())
    assert MotionPostProcessor().process(motion)[4, 0] == 100


def test_zero_quaternions_single_frames_and_the_input_stay_sound() -> None:
    motion = np.zeros((1, 25), dtype=np.float32)
    config = PostProcessConfig(
        smooth_quaternions=True, apply_smoothing=True, enforce_phase_monotonic=True,
        enforce_velocity_coherence=True,
    )  # fmt: skip
    result = MotionPostProcessor(config).process(motion)
    assert result[0, QUATERNION].tolist() == [1, 0, 0, 0]
    assert not motion.any() and np.isfinite(result).all()


def test_smoothing_keeps_a_steady_phase_over_the_bar_line() -> None:
    motion = smooth_trajectory(2).data.copy()
    motion[:, PHASE] = (0.9 + 0.02 * np.arange(len(motion))) % 1
    config = PostProcessConfig(apply_smoothing=True, smoothing_kernel_size=5)
    after = MotionPostProcessor(config).process(motion)
    assert difference(after, motion)[:, PHASE].max() < 1e-5


def test_gradients_pass() -> None:
    motion = torch.randn(2, 25, 12, requires_grad=True)
    MotionPostProcessorTorch().process(motion).square().sum().backward()
    assert motion.grad is not None and motion.grad.isfinite().all()


@pytest.mark.parametrize(
    "wrong",
    [
        {"quat_smooth_window": 4},
        {"smoothing_kernel_size": 0},
        {"max_velocity": 0.0},
        {"phase_min": 1.0},
        {"coherence_blend": 2.0},
    ],
)
def test_wrong_settings_are_named(wrong: dict[str, float]) -> None:
    key = next(iter(wrong)).replace("_", "[-_]")
    with pytest.raises(ValidationError, match=key):
        PostProcessConfig(**wrong)  # type: ignore[arg-type]
    with pytest.raises(UsageError, match=f"command line: .*{key}"):
        overrides = [f"post-processing.{name}={value}" for name, value in wrong.items()]
        load_config(AudioNetworkConfig, {}, "test", overrides)
