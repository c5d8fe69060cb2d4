"""MotionDenoiser: TEXT's order and sizes, masks, the learned null, and that it learns."""

from dataclasses import replace
from itertools import pairwise

import pytest
import torch
from torch.nn.functional import normalize

from src.shared.model.clip.features import TextFeatures
from src.shared.model.generation.denoiser import MotionDenoiser
from src.shared.model.layers import DenoiserBlock

B, T, L, D, TAGS = 3, 12, 5, 32, 4
PROVENANCE_WEIGHT = "provenance_embed.embedding.weight"


def text(batch: int = B) -> TextFeatures:
    mask = torch.arange(L) < torch.tensor([5, 2, 3])[:batch, None]
    return TextFeatures(normalize(torch.randn(batch, D), dim=-1), torch.randn(batch, L, D), mask)


def alive(denoiser: MotionDenoiser) -> MotionDenoiser:
    """The same with modulations and output away from their zeros."""
    for name, parameter in denoiser.named_parameters():
        if any(part in name for part in ("modulation", "output_proj", "contract", "known_proj")):
            torch.nn.init.normal_(parameter, std=0.2)
    return denoiser.eval()


@pytest.fixture(scope="module", params=[("pooled", 1), ("tokens", 1), ("pooled", 4)], ids=str)
def denoiser(request, make_network) -> MotionDenoiser:
    torch.manual_seed(0)
    conditioning, stride = request.param
    network = make_network(text_conditioning=conditioning, frames_per_token=stride)
    return alive(MotionDenoiser(network, TAGS))


def inputs(batch: int = B):
    return torch.randn(batch, T, 23, 6), torch.randint(0, 50, (batch,)), text(batch)


@pytest.mark.parametrize("root_track", [True, False])
def test_shapes_are_the_documents(make_network, root_track: bool):
    network = make_network().model_copy(update={"root_track": root_track})
    motion = torch.randn(B, T, network.motion_rows, 6)
    out = MotionDenoiser(network, 0)(
        motion, torch.zeros(B, dtype=torch.long), text(), torch.zeros(B, dtype=torch.long)
    )
    assert out.shape == motion.shape
    assert torch.equal(out, torch.zeros_like(out))  # the output projection starts at zero


@pytest.mark.parametrize("frames", [1, 4, 10])
def test_tokens_of_several_frames_give_every_frame(make_network, frames: int):
    model = alive(MotionDenoiser(make_network(frames_per_token=4, constraints=True), TAGS))
    lengths: list[int] = []
    model.blocks[0].register_forward_hook(lambda *call: lengths.append(call[2].shape[1]))
    noisy, timesteps, features = inputs()
    noisy = noisy[:, :frames]
    tag = torch.full((B,), TAGS)
    out = model(noisy, timesteps, features, tag, known=noisy > 0)
    assert out.shape == noisy.shape
    assert lengths == [-(-frames // 4)]
    assert (out - model(noisy, timesteps, features, tag, known=noisy > 1)).abs().amax() > 1e-4


def test_layer_sizes_are_the_documents(make_network):
    block = MotionDenoiser(make_network(), TAGS).blocks[0]
    assert block.temporal.feed_forward.expand.out_features == 4 * D
    assert block.transform.expand.out_features == 4 * D
    for layer in (block.film, block.adaln.film):
        assert (layer.modulation.in_features, layer.modulation.out_features) == (2 * D, 2 * D)


def test_layers_run_in_the_documents_order():
    block = DenoiserBlock(D, 2, dropout=0.0, tokens=False)
    called: list[str] = []
    for name, module in block.named_children():
        module.register_forward_hook(lambda *_, name=name: called.append(name))
    block(torch.randn(1, T, D), torch.randn(1, 2 * D))
    assert called == ["temporal", "film", "norm", "attention", "dropout", "adaln", "transform"]


def test_every_condition_matters(denoiser):
    noisy, timesteps, features = inputs()
    tag = torch.tensor([0, 1, TAGS])
    out = denoiser(noisy, timesteps, features, tag)
    others = [
        denoiser(noisy + 0.1, timesteps, features, tag),
        denoiser(noisy, (timesteps + 7) % 50, features, tag),
        denoiser(noisy, timesteps, text(), tag),
        denoiser(noisy, timesteps, features, torch.tensor([1, TAGS, 0])),
        denoiser(noisy.flip(1), timesteps, features, tag).flip(1),
    ]
    for other in others:
        assert (out - other).abs().amax(dim=(1, 2, 3)).min() > 1e-4


def test_only_tokens_conditioning_reads_the_tokens(make_network):
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    other = TextFeatures(features.pooled, torch.randn_like(features.tokens), features.mask)
    for conditioning, differs in (("pooled", False), ("tokens", True)):
        model = alive(MotionDenoiser(make_network(text_conditioning=conditioning), TAGS))
        same = torch.allclose(
            model(noisy, timesteps, features, tag), model(noisy, timesteps, other, tag), atol=1e-6
        )
        assert same is not differs


def test_padded_frames_and_tokens_do_not_matter(denoiser):
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    mask = torch.arange(T) < torch.tensor([[12], [7], [9]])
    out = denoiser(noisy, timesteps, features, tag, mask)
    garbage = torch.where(features.mask[..., None], features.tokens, 9.0)
    changed = TextFeatures(features.pooled, garbage, features.mask)
    noise = torch.where(mask[..., None, None], noisy, torch.randn_like(noisy))
    again = denoiser(noise, timesteps, changed, tag, mask)
    assert torch.allclose(out[mask], again[mask], atol=1e-5)
    alone = denoiser(noisy[1:2, :7], timesteps[1:2], features[1:2], tag[1:2])
    assert torch.allclose(out[1:2, :7], alone, atol=1e-5)


def test_keys_and_values_kept_give_the_same(denoiser):
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    kept = denoiser.text_keys_values(features)
    assert len(kept) == (len(denoiser.blocks) if denoiser.uses_tokens else 0)
    out = denoiser(noisy, timesteps, features, tag, keys_values=kept)
    assert torch.allclose(out, denoiser(noisy, timesteps, features, tag), atol=1e-6)


def test_dropped_rows_are_the_null_and_others_stay(denoiser):
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    dropped = denoiser.drop_text(features, torch.tensor([True, False, True]))
    out = denoiser(noisy, timesteps, dropped, tag)
    null = denoiser(noisy, timesteps, denoiser.null_text(B), tag)
    plain = denoiser(noisy, timesteps, features, tag)
    assert torch.allclose(out[[0, 2]], null[[0, 2]], atol=1e-5)
    assert torch.allclose(out[1], plain[1], atol=1e-5)
    assert not torch.allclose(null[1], plain[1], atol=1e-3)


def test_all_weights_get_gradients_once_some_text_is_dropped(make_network):
    for conditioning in ("pooled", "tokens"):
        model = MotionDenoiser(make_network(text_conditioning=conditioning), TAGS)
        alive(model).train()
        noisy, timesteps, features = inputs()
        dropped = model.drop_text(features, torch.tensor([True, False, False]))
        model(noisy, timesteps, dropped, torch.tensor([0, 1, TAGS])).square().sum().backward()
        without = [
            name
            for name, p in model.named_parameters()
            if p.grad is None or not torch.isfinite(p.grad).all()
        ]
        assert without == []


def test_it_learns_one_motion_a_text(make_network):
    torch.manual_seed(0)
    model = MotionDenoiser(make_network(dropout=0.0), TAGS)
    features, targets = text(2), torch.randn(2, 1, 23, 6).expand(2, T, 23, 6)
    tag = torch.full((2,), TAGS)
    optimizer = torch.optim.AdamW(model.parameters(), 3e-3)
    for _ in range(80):
        noisy = torch.randn(2, T, 23, 6)
        loss = (model(noisy, torch.full((2,), 49), features, tag) - targets).square().mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    assert loss.item() < 0.3


def test_autocast_stays_close_to_float32(denoiser):
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    out = denoiser(noisy, timesteps, features, tag)
    with torch.autocast("cpu", torch.bfloat16):
        low = denoiser(noisy, timesteps, features, tag)
    assert (low.float() - out).abs().max() < 0.1 * out.abs().max()


def test_no_float64_anywhere(denoiser):
    tensors = [*denoiser.state_dict().values(), *denoiser.buffers()]
    assert all(tensor.dtype != torch.float64 for tensor in tensors)


def test_provenance_can_be_learned_later(make_network):
    torch.manual_seed(1)
    noisy, timesteps, features = inputs()
    tag = torch.full((B,), TAGS)
    plain = alive(MotionDenoiser(make_network(), TAGS))
    model = alive(MotionDenoiser(make_network(provenance=True), TAGS))
    torch.nn.init.zeros_(model.get_parameter(PROVENANCE_WEIGHT))
    assert set(model.state_dict()) - set(plain.state_dict()) == {PROVENANCE_WEIGHT}
    model.load_state_dict(plain.state_dict(), strict=False)
    captured, procedural, unknown = (torch.full((B,), index) for index in (0, 1, 3))
    out = plain(noisy, timesteps, features, tag)
    assert torch.equal(model(noisy, timesteps, features, tag, provenance=captured), out)

    torch.nn.init.normal_(model.get_parameter(PROVENANCE_WEIGHT))
    told = [
        model(noisy, timesteps, features, tag, provenance=each)
        for each in (captured, procedural, unknown)
    ]
    assert all((a - b).abs().amax() > 1e-3 for a, b in pairwise([*told, out]))


def test_an_adapter_reaches_further_from_the_mean_than_the_network(make_network):
    """What goes into the output projection has a fixed length: with adapters in the blocks alone no
    body lies down for a network that has seen it stand."""
    torch.manual_seed(0)
    model = alive(MotionDenoiser(make_network(adapter_ranks=(2, 4)), TAGS))
    noisy, timesteps, features = inputs()
    heard = (noisy, timesteps, features, torch.full((B,), TAGS))
    before = model(*heard)
    far = (20 * torch.randn(23, 6)).expand_as(noisy)
    opened = replace(features, opened=torch.tensor([[0.0, 1.0]]).expand(B, 2))
    for learning, least, most in (("blocks.", 0.5, 1.0), ("", 0.0, 0.1)):
        for name, weight in model.named_parameters():
            weight.requires_grad_(name.startswith(learning) and ".adapters.1." in name)
        learner = torch.optim.Adam([w for w in model.parameters() if w.requires_grad], lr=0.05)
        for _ in range(150):
            loss = (model(noisy, timesteps, opened, heard[3]) - far).square().mean()
            learner.zero_grad()
            loss.backward()
            learner.step()
        assert least < loss.item() / far.square().mean().item() < most
    assert torch.equal(model(*heard), before)


def test_what_it_becomes_for_one_step(make_network):
    torch.manual_seed(0)
    network = make_network(one_step_rank=2, adapter_ranks=(3,), constraints=True)
    model = alive(MotionDenoiser(network, TAGS))
    model.load_state_dict({**MotionDenoiser(network, TAGS).state_dict(), **model.plain_state()})
    noisy, timesteps, features = inputs()
    heard = (noisy, timesteps, features, torch.full((B,), TAGS))
    known = torch.zeros(noisy.shape, dtype=torch.bool)

    def once() -> torch.Tensor:
        step = model.in_one_step()
        assert step is not None and step.config.generation.one_step_rank == 0
        assert step.in_one_step() is None
        return step(*heard, known=known)

    before = model(*heard, known=known)
    assert torch.equal(once(), before)  # it starts as no change
    assert model.one_step is not None
    changed = model.one_step.weights(model)
    assert not any("adapters" in name or "null_" in name for name in changed)
    vectors = {name for name, weight in changed.items() if weight.ndim == 1}
    assert {"output_proj.bias", "blocks.0.attention.qkv.bias"} <= vectors
    for parameter in model.one_step.parameters():
        torch.nn.init.normal_(parameter, std=0.2)
    assert not torch.allclose(once(), before) and torch.equal(model(*heard, known=known), before)
    for name, weight in model.one_step.weights(model).items():
        change = (weight - model.get_parameter(name)).detach()
        assert change.abs().max() > 0
        if change.ndim == 2:
            assert torch.linalg.matrix_rank(change, rtol=1e-4) <= 2
