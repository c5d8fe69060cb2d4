"""Shared space: unit vectors, padding, the frozen motion tower, one text tower, folders."""

import copy
import math

import pytest
import torch
from safetensors.torch import load_file
from torch.nn.functional import cosine_similarity

from src.shared.config_audio import AudioTowerConfig
from src.shared.errors import UserError
from src.shared.model.audio.shared_space import AudioTower, SharedSpace, rate_rows
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip, TextTower
from src.shared.model.clip.pretrained import ClipBundle, encode_captions, tower_hash
from src.shared.model.clip.tokenizer import PromptTokenizer

CONFIG = AudioTowerConfig(embed_dim=32, dim=16, num_heads=2, num_layers=1)


@pytest.fixture(scope="module")
def bundle(network, captions) -> ClipBundle:
    torch.manual_seed(0)
    mean, std = torch.linspace(-0.2, 0.2, 23 * 6).view(23, 6), torch.full((23, 6), 0.5)
    tokenizer = PromptTokenizer.train(captions, 400)
    return ClipBundle(
        MotionClip(network).eval(), tokenizer, mean, std, ModelCard(kind="motion-clip")
    )


@pytest.fixture(scope="module")
def space(bundle) -> SharedSpace:
    torch.manual_seed(1)
    return SharedSpace.beside(bundle, CONFIG).eval()


def sound(*shape: int, seed: int = 0) -> torch.Tensor:
    return torch.randn(*shape, generator=torch.Generator().manual_seed(seed))


def test_vectors_are_unit_norm_and_padding_changes_nothing(space):
    condition, features = sound(2, 167, 40), sound(2, 40, 23, 6)
    mask = torch.arange(40) < torch.tensor([[40], [27]])
    for embed, x, alone in (
        (space.embed_audio, condition, condition[1:, :, :27]),
        (space.embed_motion, features, features[1:, :27]),
    ):
        vectors = embed(x, mask)
        assert vectors.shape == (2, 32)
        assert torch.allclose(vectors.norm(dim=1), torch.ones(2), atol=1e-5)
        assert torch.allclose(vectors[1:], embed(alone), atol=1e-5)


def test_unknown_phases_are_zeros(space):
    condition = sound(2, 163, 30)
    known = torch.cat((condition, torch.zeros(2, 4, 30)), dim=1)
    assert torch.equal(space.embed_audio(condition), space.embed_audio(known))
    with pytest.raises(ValueError, match="163 or 167 rows"):
        space.embed_audio(sound(2, 160, 30))


def test_the_rate_of_the_beat_is_told() -> None:
    for tempo, octave in ((60, -1.0), (120, 0.0), (170, math.log2(170 / 120))):
        phase = 2 * math.pi * tempo / 60 * torch.arange(40) / 30
        beat = torch.stack((phase.cos(), phase.sin()))[None]
        rows = rate_rows(beat)
        assert rows.shape == (1, 5, 40)
        assert torch.allclose(rows[0, 0], torch.full((40,), octave), atol=1e-4)
        assert rows[0, 1:3].norm(dim=0) == pytest.approx(torch.ones(40), abs=1e-5)
    beat[..., 20:] = 0  # unknown, or padding
    assert torch.equal(rate_rows(beat)[..., :20], rows[..., :20])
    assert not rate_rows(beat)[..., 20:].any()
    assert rate_rows(beat[..., :1]).shape == (1, 5, 1)


def test_sound_is_standardised_by_its_statistics_and_phases_are_not():
    tower = AudioTower(CONFIG).eval()
    raw = sound(1, 167, 24)
    before = tower(raw)
    mean, std = torch.linspace(-3, 3, 163), torch.linspace(0.5, 2, 163)
    tower.set_statistics(mean, std)
    scaled = raw.clone()
    scaled[:, :163] = raw[:, :163] * std[:, None] + mean[:, None]
    assert torch.allclose(tower(scaled), before, atol=1e-5)
    assert torch.allclose(tower.standardise(scaled), raw, atol=1e-5)


def test_the_motion_tower_is_the_clip_models_and_stays_fixed(space, bundle):
    features = sound(3, 30, 23, 6)
    expected = bundle.clip.encode_motion((features - bundle.mean) / bundle.std)
    space.train()
    assert torch.allclose(space.embed_motion(features), expected, atol=1e-6)  # no dropout either
    space.eval()
    assert not any(parameter.requires_grad for parameter in space.motion.parameters())
    assert all(parameter.requires_grad for parameter in space.audio.parameters())


def test_text_comes_from_the_tower_the_space_belongs_to(space, bundle, network):
    prompts = ["a person walks forward", "somebody jumps twice"]
    text = space.embed_text(prompts, bundle.clip.text, bundle.tokenizer)
    assert torch.equal(text, encode_captions(bundle.clip.text, bundle.tokenizer, prompts))
    stranger = TextTower(network.clip, 32)
    with pytest.raises(UserError, match="were not trained together"):
        space.embed_text(prompts, stranger, bundle.tokenizer)


def test_a_towers_hash_survives_float16(bundle):
    before = tower_hash(bundle.clip.text)
    assert tower_hash(copy.deepcopy(bundle.clip.text).half().float()) == before


def test_folders_round_trip_and_half_the_size(space, tmp_path):
    space.save_pretrained(tmp_path / "full")
    space.save_pretrained(tmp_path / "half", half=True)
    condition, features = sound(2, 167, 30), sound(2, 30, 23, 6)
    full = SharedSpace.from_pretrained(tmp_path / "full")
    assert torch.equal(full.embed_audio(condition), space.embed_audio(condition))
    assert torch.equal(full.embed_motion(features), space.embed_motion(features))
    assert full.card.text_tower == space.card.text_tower
    assert full.fingerprint == full.card.weights.sha256
    half = SharedSpace.from_pretrained(tmp_path / "half")
    assert half.fingerprint != full.fingerprint
    assert cosine_similarity(half.embed_audio(condition), space.embed_audio(condition)).min() > 0.99
    weights = load_file(tmp_path / "half" / "model.safetensors")
    assert {tensor.dtype for tensor in weights.values()} == {torch.float16}


def test_other_folders_and_widths_are_refused(generator, network, tmp_path):
    generator.save_pretrained(tmp_path)
    with pytest.raises(UserError, match="motion-generator, not a shared-space"):
        SharedSpace.from_pretrained(tmp_path)
    with pytest.raises(UserError, match="motion tower has 32, the audio tower 192"):
        SharedSpace(network, AudioTowerConfig())
    with pytest.raises(ValueError, match="num-heads 3 must divide dim 16"):
        AudioTowerConfig(dim=16, num_heads=3)
