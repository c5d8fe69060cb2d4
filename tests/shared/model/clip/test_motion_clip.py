"""Both towers: unit norms, padding, freezing, folders, and pretrained encoders from disk."""

import pytest
import torch

from src.shared.config_schema import ClipConfig
from src.shared.errors import UserError
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip, TextTower, clip_loss, small_text_config
from src.shared.model.clip.pretrained import ClipBundle, encode_captions, load_text_tower
from src.shared.model.clip.tokenizer import PromptTokenizer


@pytest.fixture(scope="module")
def clip(network) -> MotionClip:
    torch.manual_seed(0)
    return MotionClip(network).eval()


@pytest.fixture(scope="module")
def tokenizer(captions) -> PromptTokenizer:
    return PromptTokenizer.train(captions, 400)


def test_embeddings_are_unit_norm_and_padding_changes_nothing(clip, tokenizer, captions):
    ids, mask = tokenizer(list(captions))
    together = clip.encode_text(ids, mask)
    assert torch.allclose(together.norm(dim=-1), torch.ones(len(captions)), atol=1e-5)
    alone = clip.encode_text(*tokenizer([next(iter(captions))]))
    assert torch.allclose(together[:1], alone, atol=1e-5)
    motion = clip.encode_motion(torch.randn(2, 20, 23, 6))
    assert torch.allclose(motion.norm(dim=-1), torch.ones(2), atol=1e-5)


def test_pooled_is_the_masked_mean_of_the_encoder_through_the_projection(clip, tokenizer):
    ids, mask = tokenizer(["walks", "a person walks forward"])
    hidden = clip.text.encoder(input_ids=ids, attention_mask=mask).last_hidden_state
    mean = hidden[0, : int(mask[0].sum())].mean(dim=0)
    expected = torch.nn.functional.normalize(clip.text.text_proj(mean), dim=-1)
    features = clip.text(ids, mask)
    assert torch.allclose(features.pooled[0], expected, atol=1e-5)
    assert features.tokens.shape == (*ids.shape, clip.config.embed_dim)
    assert torch.equal(features.mask, mask.bool())


def test_the_small_tower_is_an_xlm_r_with_its_special_ids(network):
    config = small_text_config(network.clip)
    assert config.model_type == "xlm-roberta"
    assert (config.bos_token_id, config.pad_token_id, config.eos_token_id) == (0, 1, 2)


def test_the_longest_prompt_fits(network, tokenizer):
    tower = TextTower(network.clip, 32).eval()
    length = network.clip.max_tokens
    features = tower(torch.full((1, length), 5), torch.ones(1, length, dtype=torch.long))
    assert features.tokens.shape[1] == length


def test_one_step_brings_pairs_together(network, tokenizer, captions):
    torch.manual_seed(0)
    clip = MotionClip(network)
    ids, mask = tokenizer(list(captions))
    groups = torch.tensor([0] * 6 + [1] * 2)
    motion = torch.randn(2, 16, 23, 6)[groups] + 0.1 * torch.randn(8, 16, 23, 6)
    optimizer = torch.optim.AdamW(clip.parameters(), 1e-2)
    losses = []
    for _ in range(12):
        text, moved = clip(ids, mask, motion)
        loss = clip_loss(text, moved, groups, clip.scale(), cosine_weight=0.2)["loss"]
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        losses.append(loss.item())
    assert losses[-1] < 0.3 * losses[0]


def test_the_scale_is_bounded(network):
    clip = MotionClip(network)
    assert clip.scale().item() == pytest.approx(10.0, rel=1e-5)
    torch.nn.init.constant_(clip.logit_scale, 99.0)
    assert clip.scale().item() == pytest.approx(100.0, rel=1e-5)


def test_without_root_track_the_motion_has_k_rows(make_network):
    network = make_network().model_copy(update={"root_track": False})
    assert MotionClip(network).encode_motion(torch.randn(1, 9, 22, 6)).shape == (1, 32)


def test_text_features_are_cut(clip, tokenizer):
    features = clip.text(*tokenizer(["walks", "somebody jumps"]))
    assert len(features) == 2
    assert torch.equal(features[1:].pooled, features.pooled[1:])
    assert features.to("cpu").mask.dtype == torch.bool


def test_bundle_round_trip_and_width_check(clip, tokenizer, captions, tmp_path):
    bundle = ClipBundle(
        clip, tokenizer, torch.zeros(23, 6), torch.ones(23, 6), ModelCard(kind="motion-clip")
    )
    bundle.save_pretrained(tmp_path)
    tower, loaded_tokenizer = load_text_tower(tmp_path, 32)
    assert not any(parameter.requires_grad for parameter in tower.parameters())
    assert not tower.training
    expected = encode_captions(clip.text, tokenizer, list(captions))
    found = encode_captions(tower, loaded_tokenizer, list(captions), batch_size=3)
    assert torch.allclose(found, expected, atol=1e-5)
    with pytest.raises(UserError, match=r"embed-dim mismatch.* of 32, the denoiser takes 64"):
        load_text_tower(tmp_path, 64)


def test_another_kind_of_folder_is_refused(generator, tmp_path):
    generator.save_pretrained(tmp_path)
    with pytest.raises(UserError, match="motion-generator, not a motion-clip"):
        ClipBundle.from_pretrained(tmp_path)


def test_a_pretrained_encoder_is_read_from_a_folder_and_kept(tmp_path, network, tokenizer):
    from transformers.models.xlm_roberta.modeling_xlm_roberta import XLMRobertaModel

    config = small_text_config(network.clip)
    encoder = XLMRobertaModel(config, add_pooling_layer=False)
    encoder.save_pretrained(tmp_path / "hub")
    clip_config = network.clip.model_copy(update={"text_model": str(tmp_path / "hub")})
    network = network.model_copy(update={"clip": clip_config})
    clip = MotionClip(network).eval()
    weight = "embeddings.word_embeddings.weight"
    assert torch.equal(clip.text.encoder.state_dict()[weight], encoder.state_dict()[weight])

    statistics = torch.zeros(23, 6), torch.ones(23, 6)
    bundle = ClipBundle(clip, tokenizer, *statistics, ModelCard(kind="motion-clip"))
    bundle.save_pretrained(tmp_path / "ours")
    (tmp_path / "hub").rename(tmp_path / "gone")  # a model folder stands alone
    loaded = ClipBundle.from_pretrained(tmp_path / "ours")
    prompts = ["a person walks", "somebody jumps"]
    assert torch.allclose(
        encode_captions(loaded.clip.text, tokenizer, prompts),
        encode_captions(clip.text, tokenizer, prompts),
        atol=1e-5,
    )


def test_a_model_that_is_not_there_is_one_line():
    with pytest.raises(UserError, match=r"clip.text-model: cannot load .*nowhere") as caught:
        TextTower(ClipConfig(text_model="/nowhere/at-all"), 32)
    assert "\n" not in str(caught.value)
