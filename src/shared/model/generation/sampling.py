"""One batch of requests through the reverse diffusion, with guidance and masks.

Letters: B batch, T frames, K rows (bones, root track), C channels, L text tokens.
"""

from collections.abc import Sequence
from typing import Any

import torch
from torch import Tensor

from ...config_schema import PROVENANCES
from ..clip.core import TextFeatures
from ..diffusion.gaussian import GaussianDiffusion
from ..diffusion.guidance import guided
from .constraint import KnownBatch
from .denoiser import MotionDenoiser
from .requests import SampleRequest


def sample_batch(
    denoiser: MotionDenoiser,
    diffusion: GaussianDiffusion,
    requests: Sequence[SampleRequest],
    text: TextFeatures,
    *,
    guidance_scale: float,
    sampler: str,
    steps: int | None,
    known: KnownBatch | None = None,
) -> Tensor:
    """Z-scored motions [B, T, K, C], T the longest of the batch; frames beyond a request's are
    to be cropped.

    Args:
        denoiser: with the diffusion, on one device.
        diffusion: its process.
        requests: B of them; noise comes from their own streams.
        text: B encoded prompts, row by row.
        guidance_scale: 1 = the text alone, in one forward a step.
        sampler: ddim, ddpm or dpm-solver++; ddpm wants requests of one length.
        steps: None = as configured.
        known: what is given of the motions, padded to T.
    """
    device = text.pooled.device
    rows, channels = denoiser.config.motion_rows, denoiser.config.generation.motion_channels
    lengths = torch.tensor([request.frames for request in requests])
    longest = int(lengths.max())
    noise = torch.zeros(len(requests), longest, rows, channels)  # [B, T, K, C]
    for row, request in zip(noise, requests, strict=True):
        row[: request.frames] = request.noise(rows, channels)
    padded = bool((lengths < longest).any())
    mask = (torch.arange(longest) < lengths[:, None]).to(device) if padded else None

    tag = torch.tensor([request.tag for request in requests], device=device)
    no_tag = torch.full_like(tag, denoiser.num_tags)
    null = denoiser.null_text(len(requests), text.mask.shape[1])
    learned = denoiser.known_proj is not None
    shared = {
        "mask": mask,
        "known": known.told if known is not None and learned else None,
        "provenance": _captured(denoiser, tag),
    }
    model_fn = guided(
        denoiser,
        _condition(denoiser, text, tag) | shared,
        _condition(denoiser, null, no_tag) | shared,
        guidance_scale,
    )
    noise = noise.to(device)
    if known is not None:
        model_fn = known.hold(model_fn, diffusion, noise, clean=learned)
    return diffusion.sample(
        model_fn,
        noise.shape,
        sampler=sampler,
        num_steps=steps,
        generator=[request.generator() for request in requests],
        x_T=noise,
    )


def _condition(denoiser: MotionDenoiser, text: TextFeatures, tag: Tensor) -> dict[str, Any]:
    keys_values = denoiser.text_keys_values(text)  # once a sample, not once a step
    return {"text": text, "tag": tag, "keys_values": keys_values}


def _captured(denoiser: MotionDenoiser, like: Tensor) -> Tensor | None:
    """Sampled motion is to look captured: procedural clips are there to teach, not to answer."""
    if denoiser.provenance_embed is None:
        return None
    return torch.full_like(like, PROVENANCES.index("captured"))
