"""retrieve: context, confidence and curves against what is known by construction."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_audio import MemoryConfig
from src.shared.memory.index import MemoryIndex
from src.shared.memory.query import lay, null_memory, projection, retrieve
from tests.shared.memory.tiny_memory import make_index, make_phrase

ONE = MemoryConfig(top_k=1)


@pytest.mark.parametrize("dim", [8, 192, 256])
def test_the_projection_keeps_angles(dim: int) -> None:
    assert torch.allclose(projection(dim).T @ projection(dim), torch.eye(dim), atol=1e-6)


def test_the_projection_is_the_same_everywhere() -> None:
    """A golden: contexts of trained networks depend on it. `projection(4)[0]` remakes it."""
    golden = [0.0130, -0.1163, 0.0577, 0.0407]
    assert np.allclose(projection(4)[0], golden, atol=1e-4)
    wide = projection(300)
    assert torch.allclose(wide @ wide.T, torch.eye(256), atol=1e-5)


def test_the_query_itself_is_remembered_with_confidence() -> None:
    index = make_index()
    memory = retrieve(index, index.audio_keys[3:4], ONE, num_frames=60, phase=0.75)
    assert memory.hits is not None and memory.hits.index.tolist() == [[3]]
    assert torch.allclose(memory.context[0], projection(16) @ index.motion_keys[3], atol=1e-6)
    assert torch.allclose(memory.confidence, torch.ones(1), atol=1e-5)
    assert np.allclose(memory.priors[0, :, :-1], index.prior(3)[:, :-1], atol=0.02)


def test_the_context_is_a_softmax_mean() -> None:
    index = make_index()
    query = torch.nn.functional.normalize(torch.randn(2, 16), dim=-1)
    memory = retrieve(index, query, MemoryConfig(top_k=4, temperature=0.5), num_frames=9)
    score = query @ index.audio_keys.T
    for row in range(2):
        best = score[row].argsort(descending=True)[:4]
        weights = torch.softmax(score[row, best] / 0.5, 0)
        wanted = projection(16) @ (weights @ index.motion_keys[best])
        assert torch.allclose(memory.context[row], wanted, atol=1e-6)
        mean = score[row].mean()
        margin = ((weights @ score[row, best] - mean) / (1 - mean)).clamp(0, 1)
        assert torch.isclose(memory.confidence[row], margin, atol=1e-5)
    assert (memory.context.norm(dim=1) <= 1 + 1e-6).all()


def test_nothing_is_known_where_everything_is_excluded() -> None:
    index = make_index()
    memory = retrieve(
        index, index.audio_keys[:2], num_frames=7, exclude_songs=[set(index.songs), None]
    )
    null = null_memory(1, 7)
    assert torch.equal(memory.context[:1], null.context)
    assert torch.equal(memory.priors[:1], null.priors)
    assert memory.confidence.tolist()[0] == 0 and memory.confidence[1] > 0
    assert torch.isfinite(memory.context).all()


def test_one_phrase_is_a_memory() -> None:
    index = MemoryIndex.from_phrases([make_phrase(0)])
    memory = retrieve(index, index.audio_keys, num_frames=30)
    assert torch.isfinite(memory.context).all() and 0 <= memory.confidence[0] <= 1
    assert memory.hits is not None and memory.hits.index.tolist() == [[0] + [-1] * 7]


def test_a_memory_can_be_trained_on() -> None:
    """No inference tensors: a network's backward pass goes through what it is given."""
    layer = torch.nn.Linear(256, 2)
    memory = retrieve(make_index(), make_index().audio_keys[:1], num_frames=5)
    layer(memory.context).sum().backward()
    assert layer.weight.grad is not None and layer.weight.grad.abs().sum() > 0


@pytest.mark.parametrize("phase", [np.zeros((2, 5)), np.zeros(3), np.zeros((1, 1, 1))])
def test_phases_of_another_shape(phase: np.ndarray) -> None:
    index = make_index()
    with pytest.raises(ValueError, match="phase is"):
        retrieve(index, index.audio_keys[:2], num_frames=7, phase=torch.from_numpy(phase))


# ---------------------------------------------------------------- curves along bars


def saw(bars: np.ndarray) -> np.ndarray:
    """A curve that tells where in the bar it is."""
    return np.cos(2 * np.pi * bars)[None]


@given(
    own_start=st.floats(0, 0.99),
    own_tempo=st.floats(0.4, 1.5),
    length=st.floats(1.2, 4.0),
    start=st.floats(-3, 3),
    tempo=st.floats(0.4, 1.5),
)
def test_downbeats_meet_downbeats(
    own_start: float, own_tempo: float, length: float, start: float, tempo: float
) -> None:
    own = own_start + np.arange(int(length / own_tempo * 30)) / 30 * own_tempo
    bars = start + np.arange(200) / 30 * tempo
    laid = lay(saw(own), own, bars, 200)
    away = np.abs(laid - saw(bars))
    near_seam = 0.4  # of the whole range 2: a frame of the phrase, and up to 0.05 bars held
    assert (away < near_seam).mean() > 0.99 and np.median(away) < 0.02


def test_a_start_alone_keeps_the_phrases_tempo() -> None:
    own = 0.25 + np.arange(61) / 30
    laid = lay(saw(own), own, np.array([4.25]), 61)
    assert np.allclose(laid[0, :-1], saw(own)[0, :-1], atol=1e-5)


def test_a_phrase_of_less_than_a_bar_holds_its_end() -> None:
    own = np.linspace(0, 0.5, 20)
    laid = lay(own[None], own, np.arange(60) / 30, 60)
    assert np.allclose(laid[0, 15:], 0.5) and np.allclose(laid[0, :15], np.arange(15) / 30)


def test_a_slower_query_stretches_the_curves() -> None:
    index = make_index()
    bars = torch.arange(120)[None] / 60 + 0.75  # the phrase has a bar of 30 frames
    memory = retrieve(index, index.audio_keys[3:4], ONE, num_frames=120, phase=bars)
    assert np.allclose(memory.priors[0, :, :116:2], index.prior(3)[:, :58], atol=0.05)
