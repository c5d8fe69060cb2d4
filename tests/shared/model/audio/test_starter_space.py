"""The shipped space: small, licensed, of the shipped text tower, and it knows the tempo."""

import math

import pytest
import torch
from torch import Tensor

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.model.audio import CONDITION_ROWS, FEATURE_ROWS
from src.shared.model.audio.shared_space import KIND, SharedSpace
from src.shared.model.checkpoint import PRETRAINED, WEIGHTS_FILE, list_models
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import encode_features

FOLDER = PRETRAINED / "starter-space"


@pytest.fixture(scope="module")
def space() -> SharedSpace:
    return SharedSpace.from_pretrained("starter-space")


def sound(space: SharedSpace, tempo: float) -> Tensor:
    """The mean sound of training [167,120] with the beats of a tempo."""
    rows = torch.zeros(CONDITION_ROWS, 120)
    rows[:FEATURE_ROWS] = space.audio.mean[:, None]
    beat = 2 * math.pi * tempo / 60 * torch.arange(120) / 30
    rows[FEATURE_ROWS:] = torch.stack((beat.cos(), beat.sin(), (beat / 4).cos(), (beat / 4).sin()))
    return rows


def motion(**labels: str) -> Tensor:
    """A synthetic clip [1,T,23,6]."""
    return encode_features(generate_clip(spec_for(labels, 0), 0))[None, :120]


RUN = {"action": "run", "direction": "forward", "speed": "normal"}
STEP = {"action": "side-step", "direction": "left", "speed": "normal"}


def test_it_is_small_and_says_what_it_is(space: SharedSpace) -> None:
    assert (FOLDER / WEIGHTS_FILE).stat().st_size < 2e6
    assert sum(parameter.numel() for parameter in space.audio.parameters()) < 1.5e6
    [row] = [row for row in list_models() if row["name"] == "starter-space"]
    assert row["kind"] == KIND and row["trained"] is True and row["licence"].startswith("CC BY-NC")
    card = (FOLDER / "README.md").read_text(encoding="utf-8")
    for word in ("Bandai", "CC BY-NC", "train_audio_tower", "chance", "tempo alone"):
        assert word in card
    assert space.card.weights is not None and space.card.weights.dtype == "int8"


@torch.no_grad()
def test_it_belongs_to_the_shipped_text_tower(space: SharedSpace) -> None:
    starter = TextToMotion.from_pretrained("starter", device="cpu")
    prompts = ["a person runs forward", "a person steps to the left side"]
    text = space.embed_text(prompts, starter.text, starter.tokenizer)
    seen = torch.cat([space.embed_motion(motion(**labels)) for labels in (RUN, STEP)])
    similarity = text @ seen.T
    assert similarity.diagonal().min() > max(similarity[0, 1], similarity[1, 0]) + 0.2


@torch.no_grad()
def test_fast_songs_lie_nearer_to_runs_and_slow_ones_to_side_steps(space: SharedSpace) -> None:
    fast, slow = space.embed_audio(torch.stack([sound(space, 162), sound(space, 84)]))
    run, step = (space.embed_motion(motion(**labels))[0] for labels in (RUN, STEP))
    assert fast @ run > slow @ run + 0.1
    assert slow @ step > fast @ step + 0.1


@torch.no_grad()
def test_like_tempi_lie_near_one_another_and_silence_is_heard_too(space: SharedSpace) -> None:
    keys = space.embed_audio(torch.stack([sound(space, tempo) for tempo in (120, 122, 165)]))
    assert keys[0] @ keys[1] > keys[0] @ keys[2] + 0.05
    silence = space.embed_audio(torch.zeros(1, FEATURE_ROWS, 120))
    assert torch.isfinite(silence).all()
