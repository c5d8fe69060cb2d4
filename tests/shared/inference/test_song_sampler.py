"""Songs by windows: every frame once, pieces equal the whole, and no seam jumps at any length."""

import numpy as np
import pytest
import torch

from src.shared.errors import UsageError
from src.shared.inference.song_sampler import SPARE, SampleSettings, SongSampler, spans
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.motion.trajectory_math import heading_of
from tests.shared.model.audio.tiny_audio import awake, network_config, walk

WINDOW, OVERLAP = 64, 12
STEP = WINDOW - SPARE - OVERLAP


@pytest.fixture(scope="module")
def sampler() -> SongSampler:
    torch.manual_seed(0)
    model = AudioMotionModel(network_config())
    awake(model)
    rows = walk(WINDOW)[0]
    # calm, yet made around another place than the known frames lead to: unmended it jumps
    model.set_statistics(rows.mean(0), 0.003 * (0.1 + rows.std(0)))
    return SongSampler(model, SampleSettings(window=WINDOW, overlap=OVERLAP, steps=2))


def sound(frames: int) -> torch.Tensor:
    return torch.randn(167, frames, generator=torch.Generator().manual_seed(1))


def test_windows_cover_a_song_and_share_their_seams() -> None:
    found = spans(100, 40, 10)
    assert found == [(0, 40), (30, 70), (60, 100)]
    assert spans(5, 40, 10) == [(0, 5)]


def test_pieces_are_the_whole(sampler: SongSampler) -> None:
    pieces = [piece[0].data for piece in sampler.stream(sound(150))]
    np.testing.assert_array_equal(np.concatenate(pieces), sampler.sample(sound(150))[0].data)
    assert len(pieces) > 2


@pytest.mark.parametrize("more", [1, 2, 3, 20])
def test_no_seam_jumps_however_short_the_last_window(sampler: SongSampler, more: int) -> None:
    """A last window that is one or two frames longer than what it knows was left unmended once."""
    frames = WINDOW - SPARE + more
    made = sampler.sample(sound(frames))[0]
    assert made.num_frames == frames
    steps = np.linalg.norm(np.diff(made.position.astype(float), axis=0), axis=1)
    joined = slice(WINDOW - SPARE - 2, WINDOW - SPARE + more)
    assert steps[joined].max() <= 2 * steps[: WINDOW - SPARE - 1].max()
    turns = np.abs((made.quaternion[1:] * made.quaternion[:-1]).sum(1))
    assert turns[joined].min() >= turns[: WINDOW - SPARE - 1].min() - 1e-3


def test_a_window_that_fits_no_overlap_is_refused() -> None:
    with pytest.raises(UsageError, match="overlap"):
        SampleSettings(window=20, overlap=20)


def test_the_end_is_derived_like_the_rest_and_the_start_is_the_origin(sampler: SongSampler) -> None:
    made = sampler.sample(sound(100))[0]
    assert np.abs(made.acceleration[-2:]).min(axis=1).max() > 0  # ruling 6: not degenerate
    assert not np.array_equal(made.velocity[-1], made.velocity[-2])
    np.testing.assert_allclose(made.position[0, [0, 2]], 0, atol=1e-6)  # ruling 8
    heading = heading_of(torch.as_tensor(made.quaternion[0], dtype=torch.float64))
    assert float(heading) == pytest.approx(0, abs=1e-5)
