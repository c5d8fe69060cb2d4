"""One step of audio training and of end-to-end fine-tuning on random windows, for audio_unet.

Letters: B batch, T frames.
"""

from collections.abc import Callable

import torch
from torch import nn

from src.shared.config_audio import AudioNetworkConfig, FinetuneE2eConfig
from src.shared.model.audio import CONDITION_ROWS
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.motion.trajectory import CHANNELS
from src.train.finetune_e2e import E2eBatch, E2eObjective
from src.train.task import to_device
from src.train.train_audio import AudioBatch, audio_losses

LEARNING_RATE = 1e-5


def random_batch(batch: int, frames: int) -> AudioBatch:
    """Windows of noise in the place of motion."""
    shape = (batch, CHANNELS, frames)
    return AudioBatch(
        clean=torch.randn(shape),
        noise=torch.randn(shape),
        known=torch.zeros(shape, dtype=torch.bool),
        mask=torch.ones(batch, frames, dtype=torch.bool),
        condition=torch.rand(batch, CONDITION_ROWS, frames),
        drop=torch.rand(batch) < 0.1,
        timesteps=torch.randint(1000, (batch,)),
    )


def training_step(
    network: AudioNetworkConfig, batch: int, frames: int, *, bf16: bool, device: str = "cpu"
) -> Callable[[], None]:
    """Forward, backward and AdamW of the UNet."""
    model = AudioMotionModel(network).to(device)
    optimizer = torch.optim.AdamW(model.unet.parameters(), LEARNING_RATE)
    windows = to_device(random_batch(batch, frames), torch.device(device))

    def step() -> None:
        with torch.autocast(device, torch.bfloat16, enabled=bf16):
            losses = audio_losses(
                model.unet.train(), windows, model.diffusion, model.std, velocity_weight=0.5
            )
        _learn(model.unet, losses["loss"], optimizer)

    return step


def e2e_step(
    network: AudioNetworkConfig,
    batch: int,
    frames: int,
    steps: int,
    *,
    bf16: bool,
    device: str = "cpu",
) -> Callable[[], None]:
    """The same of UNet, sampler and decoder together, through `steps` DDIM steps."""
    objective = E2eObjective(
        AudioMotionModel(network), FinetuneE2eConfig(ddim_steps=steps, target_frames=frames)
    ).to(device)
    optimizer = torch.optim.AdamW(objective.parameters(), LEARNING_RATE)
    audio = to_device(random_batch(batch, frames), torch.device(device))
    with torch.no_grad():
        target = objective.model.decode(audio.clean).trajectory
    windows = E2eBatch(
        audio,
        target,
        torch.rand(batch, device=device),
        audio.noise,
        objective.sampler.data_starts[0],
    )

    def step() -> None:
        with torch.autocast(device, torch.bfloat16, enabled=bf16):
            losses = objective(windows)
        _learn(objective, losses["loss"], optimizer)

    return step


def _learn(module: nn.Module, loss: torch.Tensor, optimizer: torch.optim.Optimizer) -> None:
    loss.backward()
    nn.utils.clip_grad_norm_(module.parameters(), 1.0)
    optimizer.step()
    optimizer.zero_grad(set_to_none=True)
    finished(loss.device.type)


def finished(device: str) -> None:
    """Wait until a device has done what it was given."""
    if device != "cpu":
        getattr(torch, device).synchronize()
