"""Phrases with bodies whose sound and motion share a tempo, and a small shared space."""

from pathlib import Path

import numpy as np
import torch

from src.shared.config_audio import AudioTowerConfig
from src.shared.config_schema import ClipConfig, GenerationConfig, NetworkConfig
from src.shared.data.phrases.layout import write_body, write_manifest, write_phrase
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip
from src.shared.model.clip.pretrained import ClipBundle
from src.shared.model.clip.tokenizer import PromptTokenizer
from src.shared.motion.features import FORWARD, ROOT_ROW

FRAMES = 130
TAGS = ("walk", "run", "jump")
CAPTIONS = [f"a person does a {tag}" for tag in TAGS]
TOWER = AudioTowerConfig(embed_dim=32, dim=32, num_heads=2, num_layers=1, dropout=0.0)
NETWORK = NetworkConfig(
    embed_dim=32,
    generation=GenerationConfig(num_heads=2, num_layers=1),
    clip=ClipConfig(
        text_model="small",
        text_hidden_size=32,
        text_num_layers=1,
        text_num_heads=2,
        text_vocab_size=400,
        motion_num_heads=2,
        motion_num_layers=1,
    ),
)


def write_space_phrases(folder: Path, *, songs: int = 12) -> Path:
    """Two phrases a song; a body nods on the beat and walks as fast as the song is."""
    rng, records = np.random.default_rng(0), []
    time = np.arange(FRAMES) / 30
    for number in range(2 * songs):
        song = number // 2
        tempo = 70 * 2 ** (song / songs)
        bars = time * tempo / 240
        nod = np.cos(8 * np.pi * bars)
        trajectory = np.zeros((FRAMES, 25), np.float32)
        trajectory[:, 9], trajectory[:, 16] = 1, bars % 1
        sound = {"mel": 128, "chroma": 12, "mfcc": 20}
        features = {k: 0.1 * rng.random((n, FRAMES), np.float32) for k, n in sound.items()}
        features["mel"] += np.float32(tempo / 70)
        features |= {k: np.maximum(nod, 0).astype(np.float32) for k in ("rms", "onset_strength")}
        features |= {"spectral_centroid": np.zeros(FRAMES, np.float32), "phase": bars, "meter": 4}
        body = 0.05 * rng.normal(size=(FRAMES, 23, 6)) + tempo / 70 - 1.5
        body[:, :3, 0] += nod[:, None]
        body[:, ROOT_ROW, FORWARD] = tempo / 100
        split = ("train", "train", "val", "test")[song % 4]
        record = write_phrase(
            folder, f"s{number:02d}", trajectory, features, split=split, song=f"song-{song}",
            tempo=tempo, tag=TAGS[song % 3], caption=CAPTIONS[song % 3], clips=(f"clip-{number}",),
        )  # fmt: skip
        stored = write_body(folder, record.id, body)
        records.append(record.model_copy(update={"body": stored}))
    write_manifest(folder, records)
    return folder


def tiny_bundle() -> ClipBundle:
    """Both towers, untrained."""
    torch.manual_seed(0)
    tokenizer = PromptTokenizer.train(CAPTIONS, 400)
    card = ModelCard(kind="motion-clip")
    return ClipBundle(
        MotionClip(NETWORK).eval(), tokenizer, torch.zeros(23, 6), torch.ones(23, 6), card
    )


def tiny_space() -> SharedSpace:
    """An untrained audio tower beside an untrained motion tower."""
    return SharedSpace.beside(tiny_bundle(), TOWER).eval()
