"""People who nod on the beat, and a network that has learnt nothing, for the audio evaluations."""

from pathlib import Path

import numpy as np
import torch

from src.shared.data.phrases.layout import write_manifest, write_phrase
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.checkpoint import ModelCard
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.model.audio.tiny_audio import awake, network_config

GROUPS = {"mel": 128, "chroma": 12, "mfcc": 20, "rms": 0, "spectral_centroid": 0}


def nod(bars: np.ndarray, turn: float = 0.2) -> MotionTrajectory:
    """A walk in circles that slows down on every beat of 4/4; bars [T+2], two frames to spare."""
    angle = np.arange(len(bars)) / 30 * turn
    speed = 1 - 0.6 * np.cos(8 * np.pi * bars)
    position = np.cumsum(np.stack([np.sin(angle), 0 * angle, np.cos(angle)], 1), 0)
    position = np.cumsum(np.diff(position, axis=0, prepend=0) * speed[:, None], 0) / 30
    position[:, 1] = 1.0
    quaternion = np.stack([np.cos(angle / 2), 0 * angle, np.sin(angle / 2), 0 * angle], 1)
    return MotionTrajectory.from_pose(position, quaternion, bars, spare=2)


def write_pairs(root: Path, frames: int = 150) -> Path:
    """Six phrases to train on and four to test with, each of its own song and tempo."""
    rng, records = np.random.default_rng(0), []
    for index in range(10):
        tempo = rng.uniform(80, 140)
        bars = np.arange(frames + 2) / 30 * tempo / 240 + rng.uniform()
        sound = {k: rng.random((n, frames) if n else frames) for k, n in GROUPS.items()}
        sound["onset_strength"] = rng.random(frames)
        features = {name: values.astype(np.float32) for name, values in sound.items()}
        features |= {"phase": bars[:-2], "meter": np.array(4), "tempo": np.array(tempo)}
        split = "train" if index < 6 else "test"
        trajectory = nod(bars, rng.uniform(0.1, 0.5)).data
        name = f"nod-{index:02d}"
        records.append(
            write_phrase(root, name, trajectory, features, split=split, song=f"song-{index}")
        )
    write_manifest(root, records)
    return root


def tiny_model(data: str = "") -> AudioMotionModel:
    """Random weights that claim to be trained."""
    torch.manual_seed(0)
    config = network_config(diffusion={"timesteps": 20, "sampling-steps": 2})
    card = ModelCard(kind="audio-motion", trained=True, data=data)
    model = AudioMotionModel(config, card)
    awake(model)
    return model.eval()
