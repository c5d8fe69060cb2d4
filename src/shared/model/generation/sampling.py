"""What a user asks for, one request a motion, and a batch of them through the reverse diffusion.

Letters: B batch, T frames, K rows (bones, root track), C channels, L text tokens.
"""

import math
import zlib
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...config_loader import nearest
from ...config_schema import PROVENANCES
from ...errors import UserError
from ..clip.core import TextFeatures
from ..diffusion import GaussianDiffusion, guided
from .constraint import KnownBatch
from .denoiser import MotionDenoiser

MIN_FRAMES = 8


@dataclass(frozen=True)
class SampleRequest:
    """One motion to be made.

    Attributes:
        prompt: what it shows.
        frames: its length.
        tag: index of the action label; the number of tags where there is none.
        stream: what its noise depends on: seed, prompt, and which sample of that prompt it is;
            never what else is in the batch.
    """

    prompt: str
    frames: int
    tag: int
    stream: tuple[int, int, int]

    def generator(self) -> torch.Generator:
        """A fresh CPU generator, so that a seed means the same on every device."""
        state = np.random.SeedSequence(self.stream).generate_state(1, np.uint64)
        return torch.Generator("cpu").manual_seed(int(state[0] >> np.uint64(1)))

    def noise(self, rows: int, channels: int) -> Tensor:
        """Starting noise [T, rows, channels] float32."""
        return torch.randn(self.frames, rows, channels, generator=self.generator())


def make_requests(
    prompts: Sequence[str],
    *,
    seconds: float | Sequence[float],
    tags: Sequence[str | None] | None,
    known_tags: Sequence[str],
    num_samples: int,
    seed: int,
    fps: float,
) -> list[SampleRequest]:
    """Requests in prompt-major order.

    Raises:
        UserError: no or empty prompts, lists of unequal length, an unknown tag, a length that is
            no number or too short, a negative seed.
    """
    if isinstance(prompts, str):
        raise UserError("prompts is a string; give a list of prompts, e.g. ['a person walks']")
    if not prompts:
        raise UserError("no prompt given; describe a motion, e.g. 'a person walks forward'")
    if num_samples < 1:
        raise UserError(f"num-samples {num_samples} must be at least 1")
    if seed < 0:
        raise UserError(f"seed {seed} must be 0 or more")
    lengths = _each(seconds, len(prompts), "seconds")
    labels = _each(tags, len(prompts), "tags")
    count: Counter[str] = Counter()
    requests = []
    for prompt, length, label in zip(prompts, lengths, labels, strict=True):
        frames, tag = _frames(length, fps), _tag_index(label, known_tags)
        text = zlib.crc32(prompt.encode())
        for _ in range(num_samples):
            requests.append(SampleRequest(prompt, frames, tag, (seed, text, count[prompt])))
            count[prompt] += 1
    return requests


def batches(
    requests: Sequence[SampleRequest], size: int, *, equal_lengths: bool
) -> Iterator[list[int]]:
    """Indices of at most `size` requests of like length, the shortest first.

    Args:
        equal_lengths: never two lengths in one batch. Samplers that draw noise on the way need
            it, or the padding would shift the streams.
    """
    batch: list[int] = []
    for index in sorted(range(len(requests)), key=lambda i: requests[i].frames):
        other_length = bool(batch) and requests[batch[-1]].frames != requests[index].frames
        if len(batch) == size or (equal_lengths and other_length):
            yield batch
            batch = []
        batch.append(index)
    if batch:
        yield batch


def _each(value: Any, count: int, name: str) -> list[Any]:
    if value is None or isinstance(value, str | int | float):
        return [value] * count
    values = list(value)
    if len(values) != count:
        raise UserError(
            f"{name} has {len(values)} entries for {count} prompts; give one for all or one each"
        )
    return values


def _frames(seconds: float | None, fps: float) -> int:
    if not isinstance(seconds, int | float) or not math.isfinite(seconds):
        raise UserError(f"seconds {seconds!r} is not a number; give one, such as 4")
    frames = round(seconds * fps)
    if frames < MIN_FRAMES:
        raise UserError(f"seconds {seconds:g} is too short; ask for {MIN_FRAMES / fps:.2f} or more")
    return frames


def _tag_index(tag: str | None, known: Sequence[str]) -> int:
    if tag is None:
        return len(known)
    if tag not in known:
        hint = f"; did you mean {nearest(tag, known)!r}? known: {', '.join(known)}" if known else ""
        raise UserError(f"tag {tag!r} is not one this model was trained with{hint}")
    return list(known).index(tag)


# ---------------------------------------------------------------- one batch


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
        "known": known.shown if known is not None and learned else None,
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
