"""Rhythm guidance: bodies slow down on the beats they are given, others are left alone."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.metrics.rhythm import beat_alignment, motion_beats
from src.shared.model.generation.constraint import Constraint, RhythmGuidance, beat_weight
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import ROOT_ROW, decode_features, world_joints
from src.shared.motion.rotations import axis_angle_to_matrix, gaussian_smooth, matrix_to_rotation_6d

BEATS = 0.4 + 0.5 * torch.arange(9)


def swinging(frames: int = 150) -> torch.Tensor:
    """Limbs that turn at one speed: nothing tells a beat."""
    turn = matrix_to_rotation_6d(axis_angle_to_matrix(0, torch.arange(frames) * 0.06))
    features = torch.zeros(1, frames, ROOT_ROW + 1, 6)
    features[..., 0] = features[..., 4] = 1.0
    features[:, :, [1, 2, 16, 17]] = turn[:, None]
    features[:, :, ROOT_ROW] = torch.tensor([0.3, 0.0, 0.9, 0.1, 1.0, 0.0])
    return features


def led(
    features: torch.Tensor, beats: torch.Tensor, free: torch.Tensor, times: int
) -> torch.Tensor:
    rows = features.shape[2:]
    guide = RhythmGuidance.of(
        [beats], features.shape[1], torch.zeros(rows), torch.ones(rows), fps=30.0
    )
    assert guide is not None
    for _ in range(times):
        features = guide(features, free=free)
    return features


def alignment(features: torch.Tensor, beats: torch.Tensor) -> float:
    found = motion_beats(decode_features(features[0]).positions()).times
    return beat_alignment(beats.numpy()[1:-1], found)


def test_a_steady_body_gets_beats_where_it_is_told():
    free = torch.ones(1, 150, ROOT_ROW + 1, 6, dtype=torch.bool)
    made = led(swinging(), BEATS, free, 8)
    assert alignment(made, BEATS) > 0.7
    assert alignment(made, BEATS + 0.25) < 0.2
    assert alignment(swinging(), BEATS) < 0.5


def test_what_is_not_free_stays():
    free = torch.zeros(1, 150, ROOT_ROW + 1, 6, dtype=torch.bool)
    free[:, :, 16:18] = True
    made, before = led(swinging(), BEATS, free, 2), swinging()
    assert torch.equal(made[~free], before[~free])
    assert not torch.equal(made[free], before[free])


def test_it_works_where_gradients_are_off():
    free = torch.ones(1, 150, ROOT_ROW + 1, 6, dtype=torch.bool)
    with torch.inference_mode():
        made = led(swinging(), BEATS, free, 1)
    assert torch.isfinite(made).all() and not torch.equal(made, swinging())


@given(
    tempo=st.floats(40, 200), start=st.floats(-1, 3), count=st.integers(2, 12), seed=st.integers(0)
)
def test_the_weight_is_one_on_beats_and_minus_one_between(tempo, start, count, seed):
    rng = np.random.default_rng(seed % 2**32)
    beats = start + np.cumsum(60 / tempo * rng.uniform(0.9, 1.1, count))
    weight = beat_weight(torch.from_numpy(beats), 300, 30.0).numpy()
    time = (np.arange(299) + 0.5) / 30
    assert np.abs(weight).max() <= 1
    inside = (beats > 0.1) & (beats < 9.8)
    assert (np.interp(beats[inside], time, weight) > 0.8).all()
    middles = (beats[1:] + beats[:-1]) / 2
    middles = middles[(middles > 0.1) & (middles < 9.8)]
    assert (np.interp(middles, time, weight) < -0.8).all()
    far = time > beats[-1] + 2 * (beats[-1] - beats[-2])
    assert not weight[far].any()


def test_too_few_beats_ask_for_nothing():
    rows = torch.zeros(23, 6)
    assert RhythmGuidance.of([None, torch.tensor([1.0])], 60, rows, rows + 1, fps=30.0) is None
    assert not beat_weight(None, 60, 30.0).any()


def test_smoothing_keeps_constants_and_the_sum_of_a_spike():
    constant = torch.full((2, 40, 3, 6), 0.7)
    assert torch.allclose(gaussian_smooth(constant, 2.5), constant, atol=1e-6)
    spike = torch.zeros(1, 41, 1, 1)
    spike[0, 20] = 1
    assert gaussian_smooth(spike, 2.5).sum() == pytest.approx(1.0, abs=1e-5)
    assert gaussian_smooth(spike, 2.5).argmax() == 20


def test_world_joints_are_those_of_the_decoded_motion():
    features = swinging()
    positions = decode_features(features[0]).positions()
    assert np.abs(world_joints(features, 30.0)[0].numpy() - positions).max() < 1e-4


@pytest.mark.parametrize("constraints", [True, False])
@pytest.mark.parametrize("prediction", ["sample", "epsilon"])
def test_a_generator_hears_the_beats(make_generator, constraints: bool, prediction: str):
    generator: TextToMotion = make_generator(constraints=constraints, prediction_type=prediction)
    free = Constraint.free(60)
    timed = Constraint(free.values, free.known, BEATS)
    options = {"seconds": 2.0, "constraints": [timed]}
    made = generator.sample_features(["a person walks forward"], **options)[0]
    alone = generator.sample_features(["a person walks forward"], seconds=2.0)[0]
    assert torch.isfinite(made).all() and not torch.allclose(made, alone, atol=1e-3)
