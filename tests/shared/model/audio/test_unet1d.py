"""UNet1D: shapes at any length, conditions prepared once, the learned null, sizes of profiles."""

from typing import Any

import pytest
import torch
from pydantic import ValidationError
from torch import Tensor

from src.shared.config_audio import UNetConfig
from src.shared.config_loader import load_audio_network
from src.shared.errors import UsageError
from src.shared.model.audio.unet import AttentionBlock, UNet1D
from src.shared.model.diffusion import join_conditions
from tests.shared.model.audio.tiny_audio import CONDITION, unet, unet_config

CONDITIONINGS = ["cross-attention", "film", "both"]


def inputs(frames: int = 24, rows: int = 167, batch: int = 2) -> tuple[Tensor, Tensor, Tensor]:
    generator = torch.Generator().manual_seed(frames)
    x = torch.randn(batch, 25, frames, generator=generator)
    condition = torch.randn(batch, rows, frames, generator=generator)
    return x, torch.tensor([3, 700])[:batch], condition


@pytest.mark.parametrize("frames", [8, 9, 11, 30, 64, 121, 301])
@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_any_length_from_eight_frames_up(conditioning: str, frames: int) -> None:
    out = unet(conditioning=conditioning)(*inputs(frames))
    assert out.shape == (2, 25, frames) and out.isfinite().all()


def test_fewer_frames_and_other_lengths_are_refused() -> None:
    x, t, condition = inputs(24)
    with pytest.raises(ValueError, match="8 frames"):
        unet()(x[..., :7], t, condition[..., :7])
    with pytest.raises(ValueError, match="condition has 24"):
        unet()(x[..., :12], t, condition)
    with pytest.raises(ValueError, match="163 or 167 rows, not 164"):
        unet()(x, t, condition[:, :164])


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_phases_left_out_are_zeros(conditioning: str) -> None:
    model, (x, t, condition) = unet(conditioning=conditioning), inputs()
    condition[:, 163:] = 0
    torch.testing.assert_close(model(x, t, condition[:, :163]), model(x, t, condition))


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_prepared_equals_unprepared(conditioning: str) -> None:
    model, (x, t, condition) = unet(conditioning=conditioning), inputs(21)
    prepared = model.prepare(condition)
    torch.testing.assert_close(model(x, t, prepared), model(x, t, condition))
    keys = [stage.keys_values for stage in prepared.stages]
    assert any(key is not None for key in keys) == (conditioning != "film")
    heard = [key for key in keys if key is not None]
    assert all(key.shape[2] == 21 for key, _ in heard), "the context keeps its own length"


def test_preparing_leaves_nothing_of_the_condition_to_each_step(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Ruling 3: keys and values once a sample, not once a step."""
    calls = []
    real = AttentionBlock.keys_values
    monkeypatch.setattr(
        AttentionBlock, "keys_values", lambda self, c: calls.append(1) or real(self, c)
    )
    model, (x, t, condition) = unet(), inputs()
    prepared = model.prepare(condition)
    made = len(calls)
    for _ in range(3):
        model(x, t, prepared)
    assert made == len(calls) == sum(s.keys_values is not None for s in prepared.stages)


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_the_audio_matters_and_samples_do_not_mix(conditioning: str) -> None:
    model, (x, t, condition) = unet(conditioning=conditioning), inputs()
    before = model(x, t, condition)
    condition = condition.clone()
    condition[1] += 1
    after = model(x, t, condition)
    torch.testing.assert_close(before[0], after[0])
    assert (before[1] - after[1]).abs().max() > 1e-3


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
def test_dropped_samples_hear_the_learned_null(conditioning: str) -> None:
    model, (x, t, condition) = unet(conditioning=conditioning), inputs()
    out = model(x, t, condition, torch.tensor([False, True]))
    null = model(x, t, model.null_condition(2, 24))
    torch.testing.assert_close(out[0], model(x, t, condition)[0])
    torch.testing.assert_close(out[1], null[1])
    out[1].sum().backward()
    assert model.null.grad is not None and model.null.grad.abs().sum() > 0


def test_prepared_conditions_join_as_guidance_joins_them() -> None:
    model, (x, t, condition) = unet(), inputs()
    null = model.prepare(model.null_condition(2, 24))
    both = join_conditions(model.prepare(condition), null)
    out = model(torch.cat((x, x)), torch.cat((t, t)), both)
    torch.testing.assert_close(out[:2], model(x, t, condition), rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("conditioning", CONDITIONINGS)
@pytest.mark.parametrize("scale_shift", [True, False])
def test_every_parameter_gets_a_gradient(conditioning: str, scale_shift: bool) -> None:
    model = unet(conditioning=conditioning, use_scale_shift_norm=scale_shift).train()
    x, t, condition = inputs()
    model(x, t, condition, torch.tensor([True, False])).square().mean().backward()
    silent = [name for name, p in model.named_parameters() if p.grad is None or not p.grad.any()]
    assert not silent


def test_a_fresh_network_answers_zero_yet_learns() -> None:
    model = UNet1D(unet_config(), CONDITION)
    out = model(*inputs())
    assert not out.any()
    (out - 1).square().mean().backward()
    weight = model.output_conv.get_parameter("weight")
    assert weight.grad is not None and weight.grad.abs().sum() > 0


def test_checkpointing_changes_memory_not_gradients() -> None:
    gradients = []
    for use_checkpoint in (False, True):
        model = unet(use_checkpoint=use_checkpoint).train()
        model(*inputs()).square().mean().backward()
        gradients.append([p.grad for p in model.parameters()])
    for plain, checkpointed in zip(*gradients, strict=True):
        torch.testing.assert_close(plain, checkpointed)


def test_padding_changes_little() -> None:
    """30 frames are padded to 32: nearly what 32 frames with a still end give."""
    model, (x, t, condition) = unet(), inputs(30)
    longer = torch.cat((x, x[..., -1:].expand(-1, -1, 2)), dim=-1)
    longer_condition = torch.cat((condition, condition[..., -1:].expand(-1, -1, 2)), dim=-1)
    out, reference = model(x, t, condition), model(longer, t, longer_condition)[..., :30]
    assert (out - reference).abs().mean() < 0.02 * reference.abs().mean()


def test_cross_attention_knows_where_a_frame_of_the_song_lies() -> None:
    """Rotary positions in frames: moving the context in time changes what is heard."""
    x, t, condition = inputs(32)
    moved = condition.roll(5, dims=-1)
    with_positions = unet(conditioning="cross-attention")
    without = unet(conditioning="cross-attention", rotary=False)
    assert (with_positions(x, t, condition) - with_positions(x, t, moved)).abs().max() > 1e-3
    torch.testing.assert_close(without(x, t, condition), without(x, t, moved))


@pytest.mark.parametrize(
    ("profile", "millions"), [("lightweight", 22.4), ("default", 115.2), ("spark", 235.9)]
)
def test_profiles_count_what_the_readme_says(profile: str, millions: float) -> None:
    network = load_audio_network(profile)
    with torch.device("meta"):
        model = UNet1D(network.unet, network.condition)
    count = sum(parameter.numel() for parameter in model.parameters())
    assert count / 1e6 == pytest.approx(millions, abs=0.05)


def test_default_counts_the_documents_116_million() -> None:
    """Ruling 1, within 2%, with and without the AudioConditioner, which is counted apart."""
    network = load_audio_network("default")
    with torch.device("meta"):
        model = UNet1D(network.unet, network.condition)
    assert model.conditioner is not None
    count = sum(parameter.numel() for parameter in model.parameters())
    apart = sum(parameter.numel() for parameter in model.conditioner.parameters())
    for number in (count, count - apart):
        assert number == pytest.approx(116e6, rel=0.02)


def test_printed_configurations_count_what_ruling_1_says() -> None:
    def count(**values: Any) -> int:
        with torch.device("meta"):
            model = UNet1D(UNetConfig(rotary=False, **values))
        return sum(p.numel() for name, p in model.named_parameters() if "conditioner" not in name)

    tech = count(model_channels=256, conditioning="cross-attention", num_head_channels=None)
    assert tech == pytest.approx(227e6, rel=0.01)
    ref = count(
        model_channels=128,
        channel_mult=(1, 2, 4),
        attention_resolutions=(4, 8),
        num_heads=4,
        num_head_channels=None,
        time_embed_dim=512,
        downsample_last=True,
        use_scale_shift_norm=False,
        conditioning="film",
    )
    assert ref == pytest.approx(19e6, rel=0.05)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"model_channels": 48}, "48 channels"),
        ({"attention_resolutions": (3,)}, "attention-resolutions: 3"),
        ({"attention_resolutions": (2, 16)}, "there are 1, 2, 4"),
        ({"num_head_channels": None, "num_heads": 5}, "5 heads"),
    ],
)
def test_settings_that_do_not_fit_are_named(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        unet_config(**change)


def test_profiles_take_overrides_and_name_wrong_keys() -> None:
    network = load_audio_network("lightweight", overrides=["network.unet.conditioning=film"])
    assert network.unet.conditioning == "film" and network.diffusion.prediction_type == "sample"
    with pytest.raises(UsageError, match=r"nearest valid key is unet\.num-heads"):
        load_audio_network("lightweight", overrides=["unet.num-head=8"])
    with pytest.raises(UsageError, match="unknown profile"):
        load_audio_network("lightwight")
