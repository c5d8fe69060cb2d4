"""Small memories for tests: phrases of dancers, a space that is a linear map, pairs on disk."""

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor
from torch.nn.functional import normalize

from src.shared.data.phrases.layout import write_body, write_manifest, write_phrase
from src.shared.memory.index import MemoryIndex, Phrase
from src.shared.motion.features import encode_features
from src.shared.motion.trajectory import to_motion
from tests.shared.data.phrases.phrase_samples import make_features
from tests.shared.evaluation.tiny_pairs import nod


def make_phrase(number: int, dim: int = 16, *, frames: int = 60, song: str = "") -> Phrase:
    """A phrase of two bars of 30 frames, with random keys."""
    rng = np.random.default_rng(number)
    keys = rng.standard_normal((2, dim)).astype(np.float32)
    bars = np.arange(frames + 2) / 30 + number % 4 / 4
    return Phrase(
        id=f"phrase-{number}",
        song=song or f"song-{number // 2}",
        caption=f"caption {number}",
        clip=f"clip-{number}",
        tempo=240.0,
        trajectory=nod(bars).data,
        priors=rng.random((4, frames), np.float32),
        audio_key=keys[0] / np.linalg.norm(keys[0]),
        motion_key=keys[1] / np.linalg.norm(keys[1]),
    )


def make_index(count: int = 12, dim: int = 16, **about: Any) -> MemoryIndex:
    return MemoryIndex.from_phrases([make_phrase(n, dim) for n in range(count)], **about)


def random_index(count: int, dim: int, *, songs: int = 7, seed: int = 0) -> MemoryIndex:
    """Keys without motions, some of them equal."""
    generator = torch.Generator().manual_seed(seed)
    keys = torch.randn(2, count, dim, generator=generator)
    keys[:, count // 2 :: 3] = keys[:, :1].clone()
    keys = normalize(keys, dim=-1)
    return MemoryIndex(
        audio_keys=keys[0],
        motion_keys=keys[1],
        start_phase=torch.rand(count, generator=generator),
        tempo=torch.full((count,), 120.0),
        song=torch.arange(count) % songs,
        offsets=torch.zeros(count + 1, dtype=torch.int64),
        trajectories=torch.zeros(0, 25, dtype=torch.float16),
        priors=torch.zeros(0, 4, dtype=torch.float16),
        songs=tuple(f"song-{n}" for n in range(songs)),
        ids=tuple(map(str, range(count))),
        captions=("",) * count,
        clips=("",) * count,
    )


class LinearSpace:
    """Averages over time, then a fixed linear map: what a SharedSpace is to the memory."""

    embed_dim = 16

    def __init__(self, seed: int = 0) -> None:
        generator = torch.Generator().manual_seed(seed)
        self.audio = torch.randn(167, self.embed_dim, generator=generator)
        self.motion = torch.randn(23 * 6, self.embed_dim, generator=generator)
        for weights in (self.audio, self.motion):
            weights.requires_grad_()
        self.fingerprint = hashlib.sha256(str(seed).encode()).hexdigest()

    def embed_audio(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
        mean = _mean(condition.transpose(1, 2), mask)
        return normalize(mean @ self.audio[: mean.shape[1]], dim=-1)

    def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        return normalize(_mean(features.flatten(2), mask) @ self.motion, dim=-1)


def _mean(values: Tensor, mask: Tensor | None) -> Tensor:
    if mask is None:
        return values.mean(1)
    return (values * mask[..., None]).sum(1) / mask.sum(1, keepdim=True)


def write_dancers(root: Path, songs: int = 6, *, frames: int = 200, bodies: bool = True) -> Path:
    """Two phrases a song, a bar of 60 frames; the last song is of split test."""
    records = []
    for number in range(2 * songs):
        name, song = f"dance-{number:02d}", f"song-{number // 2}"
        bars = np.arange(frames + 2) / 60 + number / 8
        trajectory = nod(bars, 0.1 + 0.05 * number)
        features = make_features(frames, number) | {"phase": bars[:-2]}
        record = write_phrase(
            root,
            name,
            trajectory.data,
            features,
            split="test" if number // 2 == songs - 1 else "train",
            song=song,
            tempo=120.0,
            caption=f"a person nods {number} times",
        )
        if bodies:
            body = encode_features(to_motion(trajectory))
            record = record.model_copy(update={"body": write_body(root, name, body.numpy())})
        records.append(record)
    write_manifest(root, records)
    return root
