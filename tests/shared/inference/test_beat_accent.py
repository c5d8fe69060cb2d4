"""Beat accent: slow on the beats, close to where the poses were, the path untouched."""

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.data.pairing.motion_beats import beat_alignment, motion_beats
from src.shared.inference.beat_accent import MAX_SHIFT, accent_shift, accented
from src.shared.motion.root_track import ROOT_ROW, decode_features
from src.shared.motion.rotations import axis_angle_to_matrix, matrix_to_rotation_6d


@given(
    tempo=st.floats(40, 215),
    strength=st.floats(0, 0.9),
    offset=st.floats(0, 3),
    seed=st.integers(0, 1000),
)
def test_time_runs_forward_and_never_far_from_itself(
    tempo: float, strength: float, offset: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    beats = offset + np.cumsum(60 / tempo * rng.uniform(0.95, 1.05, 12))
    shift = accent_shift(beats, 300, strength)
    assert np.abs(shift).max() <= MAX_SHIFT + 1e-9
    assert np.diff(np.arange(300) / 30 - shift).min() > 0
    near = np.interp(beats[beats < 9.9], np.arange(300) / 30, shift)
    assert np.abs(near).max() < 0.02  # a pose on the beat stays there


def test_without_beats_nothing_moves() -> None:
    assert not accent_shift(np.array([1.0]), 60, 0.5).any()
    assert not accent_shift(np.array([10.0, 10.5]), 60, 0.5)[:30].any()


def swinging(frames: int = 300) -> torch.Tensor:
    """All joints turn at one speed, so that nothing tells a beat; the body stands."""
    angle = torch.arange(frames) * 0.06
    turn = matrix_to_rotation_6d(axis_angle_to_matrix(0, angle))
    features = torch.zeros(frames, ROOT_ROW + 1, 6)
    features[..., 0] = features[..., 4] = 1.0
    features[:, [1, 2, 16, 17]] = turn[:, None]
    features[:, ROOT_ROW] = torch.tensor([0.3, 0.0, 0.9, 0.1, 1.0, 0.0])
    return features


def test_beats_appear_and_the_path_stays() -> None:
    features, beats = swinging(), 0.3 + 0.5 * np.arange(20)
    made = accented(features, beats, 0.5)
    torch.testing.assert_close(made[:, ROOT_ROW], features[:, ROOT_ROW])
    speed_beats = motion_beats(decode_features(made).positions()).times
    inside = beats[(beats > 0.4) & (beats < 9.4)]
    assert beat_alignment(inside, speed_beats) > 0.9
    assert beat_alignment(inside, motion_beats(decode_features(features).positions()).times) < 0.6
    torch.testing.assert_close(accented(features, beats, 0.0), features, atol=1e-5, rtol=0)


def test_contacts_follow_the_legs() -> None:
    features, beats = swinging(), 0.5 * np.arange(1, 20)
    features[:, ROOT_ROW, 4] = (torch.arange(300) % 30 < 12).float()
    moved = accented(features, beats, 0.8)[:, ROOT_ROW, 4]
    assert 0 < float((moved - features[:, ROOT_ROW, 4]).abs().max()) <= 1
    assert float((moved.mean() - features[:, ROOT_ROW, 4].mean()).abs()) < 0.05
