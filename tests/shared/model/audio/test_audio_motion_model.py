"""AudioMotionModel: statistics, guidance, folders, and whether it can learn at all."""

from pathlib import Path

import pytest
import torch
from torch import Tensor

from src.shared.errors import UserError
from src.shared.model.audio.audio_motion_model import (
    AudioMotionModel,
    load_decoder,
    load_diffusion,
)
from src.shared.model.audio.decoder import MotionDecoder
from src.shared.model.checkpoint import ModelCard, write_checkpoint
from src.shared.model.diffusion import DDIMSampler, make_sampler
from tests.shared.model.audio.tiny_audio import awake, network_config, unet_config


def tiny(**changes: object) -> AudioMotionModel:
    torch.manual_seed(0)
    model = AudioMotionModel(network_config(**changes))
    awake(model)
    model.set_statistics(torch.linspace(-1, 1, 25), torch.linspace(0.5, 2, 25))
    return model.eval()


def batch(frames: int = 20, size: int = 2) -> tuple[Tensor, Tensor, Tensor]:
    generator = torch.Generator().manual_seed(1)
    z = torch.randn(size, 25, frames, generator=generator)
    return z, torch.tensor([5, 500])[:size], torch.randn(size, 167, frames, generator=generator)


def test_statistics_go_there_and_back() -> None:
    model, (z, _, _) = tiny(), batch()
    raw = model.denormalise(z)
    torch.testing.assert_close(raw[:, 0], z[:, 0] * 0.5 - 1)
    torch.testing.assert_close(model.normalise(raw), z)
    model.set_statistics(torch.zeros(25), torch.ones(25))
    torch.testing.assert_close(model.decode(z).trajectory, model.decoder(z.transpose(1, 2)))


def test_forward_denoise_and_prepared_agree() -> None:
    model, (z, t, condition) = tiny(), batch()
    out = model(z, t, condition)
    torch.testing.assert_close(out, model(z, t, model.prepare(condition)))
    torch.testing.assert_close(out, model.model_fn(condition)(z, t))


def test_guidance_follows_its_equation_and_costs_nothing_at_scale_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    model, (z, t, condition) = tiny(), batch()
    conditional = model(z, t, condition)
    null = model(z, t, model.prepare_null(2, 20))
    torch.testing.assert_close(
        model.model_fn(condition, 2.5)(z, t),
        null + 2.5 * (conditional - null),
        rtol=1e-4,
        atol=1e-5,
    )
    torch.testing.assert_close(model.model_fn(condition, 0.0)(z, t), null)
    monkeypatch.setattr(model, "prepare_null", None)  # not called at scale 1
    model.model_fn(condition, 1.0)(z, t)


@pytest.mark.parametrize(
    ("dtype", "tolerance"), [("float32", 1e-6), ("float16", 1e-2), ("int8", 0.1)]
)
def test_a_folder_keeps_everything(tmp_path: Path, dtype: str, tolerance: float) -> None:
    model, (z, t, condition) = tiny(decoder={"decoder": "residual", "hidden-dim": 16}), batch()
    model.save_pretrained(tmp_path, half=dtype == "float16", int8=dtype == "int8")
    read = AudioMotionModel.from_pretrained(tmp_path)
    assert read.config == model.config and isinstance(read.decoder, MotionDecoder)
    assert read.card.weights is not None and read.card.weights.dtype == dtype
    torch.testing.assert_close(
        read(z, t, condition), model(z, t, condition), rtol=0, atol=tolerance
    )
    torch.testing.assert_close(read.mean, model.mean, rtol=1e-3, atol=1e-3)


def test_another_kind_of_folder_is_refused(tmp_path: Path) -> None:
    write_checkpoint(tmp_path, ModelCard(kind="motion-clip"), {"x": torch.zeros(1)})
    with pytest.raises(UserError, match=r"a motion-clip, not an audio-motion; .* starter-audio"):
        AudioMotionModel.from_pretrained(tmp_path)


def test_the_documents_quick_start(tmp_path: Path) -> None:
    """TECH 12.2 with our loaders: diffusion, sampler, decoder."""
    tiny().save_pretrained(tmp_path)
    diffusion, decoder = load_diffusion(tmp_path), load_decoder(tmp_path)
    sampler = DDIMSampler(diffusion, num_steps=2)
    with torch.no_grad():
        raw = sampler.sample((1, 25, 120), torch.randn(1, 163, 120))
        decoded = decoder(raw.permute(0, 2, 1))
    assert decoded.shape == (1, 120, 25) and decoded.isfinite().all()


def test_one_batch_is_learnt_and_sampled_back() -> None:
    """Two songs, two motions: each comes back to its own song."""
    diffusion = {"prediction-type": "sample", "timesteps": 100, "sampling-steps": 3}
    torch.manual_seed(0)
    unet = unet_config(conditioning="film", channel_mult=(1,), attention_resolutions=())
    model = AudioMotionModel(network_config(unet=unet, diffusion=diffusion)).train()
    clean = torch.linspace(-1, 1, 25)[None, :, None] * torch.tensor([1.0, -1.0])[:, None, None]
    clean = clean.expand(2, 25, 8)
    condition = torch.zeros(2, 163, 8)
    condition[1] = 1.0
    optimiser = torch.optim.Adam(model.unet.parameters(), lr=1e-2)
    for _ in range(40):
        loss = model.diffusion.training_loss(model.unet, clean, condition, time_dim=2)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
    model.eval()
    with torch.no_grad():
        out = make_sampler(model.diffusion).run(model.model_fn(condition), torch.randn(2, 25, 8))
    assert (out - clean).square().mean() < 0.1 * clean.square().mean()
