"""A saved shared space and a saved memory of its width, for tests of what listens to them."""

from pathlib import Path

import torch

from src.shared.config_audio import AudioTowerConfig
from src.shared.memory.index import MemoryIndex
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.model.audio.shared_space import SharedSpace
from tests.shared.memory.tiny_memory import make_index
from tests.shared.model.audio.tiny_audio import awake
from tests.shared.model.conftest import tiny_network


def save_space(folder: Path, *, seed: int = 0) -> SharedSpace:
    """An untrained space."""
    torch.manual_seed(seed)
    network = tiny_network()
    tower = AudioTowerConfig(embed_dim=network.embed_dim, dim=16, num_heads=2, num_layers=1)
    space = SharedSpace(network, tower).eval()
    space.save_pretrained(folder)
    return space


def save_memory(folder: Path, space: SharedSpace, space_folder: Path) -> MemoryIndex:
    """Twelve random phrases of six songs."""
    about = {"space": space.fingerprint, "space_name": str(space_folder), "bars": 2}
    index = make_index(12, space.embed_dim, **about)
    index.save(folder)
    return index


def remember(model: AudioMotionModel, **sizes: int) -> AudioMotionModel:
    """The model with a memory part that has an effect."""
    from src.shared.config_audio import MemoryConditionConfig

    values = {"width": 16, "num_heads": 2, "num_layers": 1} | sizes
    model.add_memory(MemoryConditionConfig(**values))
    assert model.unet.memory is not None
    awake(model.unet.memory)
    return model.eval()
