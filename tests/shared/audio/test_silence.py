"""Silences are found, rests are left alone, and a noise is no music."""

import numpy as np

from src.shared.audio.silence import is_noise, silent_spans


def test_gaps_of_a_second_and_more() -> None:
    loud = np.ones(300)
    loud[60:120] = loud[200:220] = 0.01
    assert silent_spans(loud) == [(60, 120)]
    assert silent_spans(np.zeros(90)) == [(0, 90)] and silent_spans(np.ones(90)) == []


def test_noise_has_no_pitch() -> None:
    rng = np.random.default_rng(0)
    noise = 1 - 0.3 * rng.random((12, 200))
    tune = 0.1 * noise
    tune[rng.integers(12, size=200), np.arange(200)] = 1
    assert is_noise(noise) and is_noise(np.zeros((12, 50))) and not is_noise(tune)
