"""The memory part of UNet1D: REF's shapes, and silence without a memory, to the bit."""

import copy
from pathlib import Path
from typing import Any

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from torch import Tensor

from src.shared.config_audio import MemoryConditionConfig
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.conditioning import ContextTransformer, MemoryCondition, MPMSConditioner
from src.shared.model.audio.onnx import ConditionGraph, StepGraph, TimeGraph
from src.shared.model.audio.unet import UNet1D, sampling_copy
from tests.shared.model.audio.tiny_audio import awake, network_config, unet, unet_config

CONFIG = MemoryConditionConfig(width=16, num_heads=2, num_layers=1, patch=4, dropout=0.0)
CONDITIONINGS = ["cross-attention", "film", "both"]
FRAMES = 21


def inputs(frames: int = FRAMES, batch: int = 2) -> tuple[Tensor, Tensor, Tensor]:
    draws = torch.Generator().manual_seed(frames)
    x = torch.randn(batch, 25, frames, generator=draws)
    condition = torch.randn(batch, 167, frames, generator=draws)
    return x, torch.tensor([3, 700])[:batch], condition


def memory(frames: int = FRAMES, batch: int = 2, **changes: Any) -> MemoryCondition:
    draws = torch.Generator().manual_seed(1)
    values: dict[str, Any] = {
        "context": torch.nn.functional.normalize(torch.randn(batch, 256, generator=draws), dim=-1),
        "priors": torch.rand(batch, 4, frames, generator=draws),
        "confidence": torch.ones(batch),
        "recent": torch.randn(batch, 25, 8, generator=draws),
    }
    return MemoryCondition(**values | changes)


def with_memory(model: UNet1D, *, seed: int | None = 0) -> UNet1D:
    """The same weights and a memory part; a seed wakes up its joins."""
    twin = copy.deepcopy(model)
    twin.add_memory(CONFIG)
    assert twin.memory is not None
    if seed is not None:
        awake(twin.memory, seed)
    return twin.eval()


# ------------------------------------------------------------ the two parts


@pytest.mark.parametrize("frames", [1, 8, 30, 121])
def test_the_parts_have_the_shapes_that_ref_prints(frames: int) -> None:
    transformer = ContextTransformer(CONFIG).eval()
    context = transformer(torch.randn(3, 163, frames), torch.randn(3, 25, min(frames, 7)))
    assert context.shape == (3, 256)
    blended, priors = MPMSConditioner(CONFIG)(
        context, torch.randn(3, 256), torch.rand(3, 4, frames)
    )
    assert blended.shape == (3, 256) and priors.shape == (3, 64, frames)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**31), st.floats(0.1, 50))
def test_the_blend_lies_between_both_contexts(seed: int, scale: float) -> None:
    draws = torch.Generator().manual_seed(seed)
    first, second = (scale * torch.randn(2, 256, generator=draws) for _ in range(2))
    blended, _ = MPMSConditioner(CONFIG)(first, second, torch.rand(2, 4, 9))
    slack = 1e-5 * scale
    assert (blended >= torch.minimum(first, second) - slack).all()
    assert (blended <= torch.maximum(first, second) + slack).all()


def test_frames_of_zeros_are_unknown_frames() -> None:
    transformer, (_, _, condition) = ContextTransformer(CONFIG).eval(), inputs()
    recent = torch.randn(2, 25, 6)
    nothing = transformer(condition)
    torch.testing.assert_close(transformer(condition, torch.zeros(2, 25, 9)), nothing)
    longer = torch.nn.functional.pad(recent, (0, 5))
    torch.testing.assert_close(transformer(condition, longer), transformer(condition, recent))
    assert (transformer(condition, recent) - nothing).abs().max() > 1e-3


def test_the_context_hears_sound_and_motion_and_where_they_are() -> None:
    transformer, (_, _, condition) = ContextTransformer(CONFIG).eval(), inputs(24)
    before = transformer(condition)
    assert not torch.allclose(transformer(condition.flip(-1)), before, atol=1e-4)
    assert not torch.allclose(transformer(condition.roll(4, dims=-1)), before, atol=1e-4)


def test_a_width_that_heads_cannot_share_is_refused() -> None:
    with pytest.raises(ValidationError, match="width 18 must be a multiple of 8"):
        MemoryConditionConfig(width=18, num_heads=4)


# ------------------------------------------------------------ silence


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_without_a_memory_every_bit_is_as_before(conditioning: str) -> None:
    """Whatever the memory part has learned."""
    model, (x, t, condition) = unet(conditioning=conditioning), inputs()
    twin, before = with_memory(model), model(x, t, condition)
    assert torch.equal(twin(x, t, condition), before)
    null = memory(confidence=torch.zeros(2))
    assert torch.equal(twin(x, t, condition, memory=null), before)
    assert torch.equal(twin(x, t, twin.prepare(condition, memory=null)), before)
    dropped = torch.tensor([True, False])
    assert torch.equal(
        twin(x, t, condition, dropped, memory(confidence=torch.tensor([1.0, 0.0]))),
        model(x, t, condition, dropped),
    )


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_an_untrained_memory_part_is_silent(conditioning: str) -> None:
    model, (x, t, condition) = unet(conditioning=conditioning), inputs()
    twin = with_memory(model, seed=None)
    assert torch.equal(twin(x, t, condition, memory=memory()), model(x, t, condition))


def test_other_weights_are_drawn_as_if_there_were_no_memory() -> None:
    models = []
    for config in (None, CONFIG):
        torch.manual_seed(3)
        models.append(UNet1D(unet_config(memory=config)))
    plain, remembering = (dict(model.named_parameters()) for model in models)
    assert all(torch.equal(remembering[name], weight) for name, weight in plain.items())


def test_half_as_sure_is_half_as_loud() -> None:
    model = with_memory(unet())
    _, _, condition = inputs()
    assert model.memory is not None
    full = model.memory(condition, memory())
    half = model.memory(condition, memory(confidence=torch.full((2,), 0.5)))
    for a, b in zip(vars(full).values(), vars(half).values(), strict=True):
        torch.testing.assert_close(b, a / 2)


# ------------------------------------------------------------ effect


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
@pytest.mark.parametrize("part", ["context", "priors", "recent"])
def test_each_part_of_a_memory_matters_to_its_own_sample(conditioning: str, part: str) -> None:
    model, (x, t, condition) = with_memory(unet(conditioning=conditioning)), inputs()
    first = memory()
    other = getattr(first, part).clone()
    other[1] = 1 - other[1]
    out, changed = (model(x, t, condition, memory=m) for m in (first, memory(**{part: other})))
    torch.testing.assert_close(out[0], changed[0])
    assert (out[1] - changed[1]).abs().max() > 1e-5


@pytest.mark.parametrize("frames", [8, 9, 21, 30])
def test_any_length_prepared_or_not(frames: int) -> None:
    model, (x, t, condition) = with_memory(unet()), inputs(frames)
    given_ = memory(frames)
    prepared = model.prepare(condition, memory=given_)
    torch.testing.assert_close(model(x, t, prepared), model(x, t, condition, memory=given_))


def test_curves_of_another_length_are_refused() -> None:
    model, (x, t, condition) = with_memory(unet()), inputs()
    with pytest.raises(ValueError, match=r"prior curves \[2, 4, 20\] are not \[2, 4, 21\]"):
        model(x, t, condition, memory=memory(20))


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_every_weight_of_the_part_learns_and_may_learn_alone(conditioning: str) -> None:
    model = with_memory(unet(conditioning=conditioning)).train()
    model.requires_grad_(False)
    assert model.memory is not None
    model.memory.requires_grad_(True)
    x, t, condition = inputs()
    model(x, t, condition, memory=memory()).square().mean().backward()
    for name, weight in model.named_parameters():
        heard = weight.grad is not None and bool(weight.grad.any())
        assert heard == name.startswith("memory."), name


def test_one_memory_serves_all_samples() -> None:
    recent = torch.randn(3, 25, 8)
    wide = memory(batch=1).after(recent)
    assert wide.context.shape == (3, 256) and wide.priors.shape == (3, 4, FRAMES)
    assert wide.confidence.shape == (3,) and wide.recent is recent


# ------------------------------------------------------------ copies and folders


def test_the_sampling_copy_remembers_too() -> None:
    model, (x, t, condition) = with_memory(unet()), inputs()
    out = model(x, t, condition, memory=memory())
    fast = sampling_copy(model)(x, t, condition, memory=memory())
    torch.testing.assert_close(fast, out, rtol=1e-4, atol=1e-4)


def test_exported_graphs_leave_the_memory_out() -> None:
    model, (x, t, condition) = with_memory(unet()), inputs(24)
    heard = ConditionGraph(model)
    assert heard.unet.memory is None and model.memory is not None
    given = TimeGraph(model).named(t) | heard.named(condition)
    found = StepGraph(model, list(given))(x, *given.values())
    torch.testing.assert_close(found, model(x, t, condition), rtol=1e-4, atol=1e-5)


def test_guidance_leads_away_from_no_audio_and_no_memory() -> None:
    model = AudioMotionModel(network_config())
    awake(model.unet)
    x, t, condition = inputs()
    plain = model.model_fn(condition, 2.5)(x, t)
    model.add_memory(CONFIG)
    assert model.unet.memory is not None
    awake(model.unet.memory)
    model.eval()
    assert torch.equal(model.model_fn(condition, 2.5)(x, t), plain)
    guided = model.model_fn(condition, 2.0, memory())(x, t)
    null = model(x, t, model.prepare_null(2, FRAMES))
    heard = model(x, t, condition, memory=memory())
    torch.testing.assert_close(guided, 2 * heard - null, rtol=1e-4, atol=1e-5)


def test_a_folder_keeps_the_memory_part(tmp_path: Path) -> None:
    model = AudioMotionModel(network_config())
    model.add_memory(CONFIG)
    awake(model.unet)
    model.save_pretrained(tmp_path)
    again = AudioMotionModel.from_pretrained(tmp_path)
    assert again.config.unet.memory == CONFIG
    x, t, condition = inputs()
    model.eval()
    assert torch.equal(
        again(x, t, condition, None, memory()), model(x, t, condition, None, memory())
    )
