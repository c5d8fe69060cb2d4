"""Tiny real models of the text branch, made once a session."""

import numpy as np
import pytest
import torch

from src.shared.config_schema import ClipConfig, GenerationConfig, NetworkConfig
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import TextTower
from src.shared.model.clip.out_of_domain import OutOfDomainDetector
from src.shared.model.clip.pretrained import encode_captions
from src.shared.model.clip.tokenizer import PromptTokenizer
from src.shared.model.generation.denoiser import MotionDenoiser
from src.shared.model.generation.motion_generator import TextToMotion

CAPTIONS = {
    "a person walks forward": "walk",
    "una persona camina hacia adelante": "walk",
    "une personne marche vers l'avant": "walk",
    "eine Person geht vorwärts": "walk",
    "人が前に歩く": "walk",
    "一个人向前走": "walk",
    "somebody jumps twice": "jump",
    "alguien salta dos veces": "jump",
}


def tiny_network(**generation: object) -> NetworkConfig:
    """A network of some 100,000 parameters."""
    settings = {"num_layers": 2, "num_heads": 2, "diffusion_steps": 50, "sampling_steps": 4}
    return NetworkConfig(
        embed_dim=32,
        generation=GenerationConfig(**{"prediction_type": "sample", **settings, **generation}),
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


def tiny_generator(**generation: object) -> TextToMotion:
    """An untrained network that claims to be trained, with an output that is not zero."""
    network = tiny_network(**generation)
    torch.manual_seed(0)
    tokenizer = PromptTokenizer.train(CAPTIONS, 400)
    tower = TextTower(network.clip, network.embed_dim).freeze()
    denoiser = MotionDenoiser(network, num_tags=2)
    torch.nn.init.normal_(denoiser.output_proj.weight, std=0.1)
    embeddings = encode_captions(tower, tokenizer, list(CAPTIONS)).numpy()
    return TextToMotion(
        denoiser,
        tower,
        tokenizer,
        mean=torch.linspace(-0.2, 0.2, 23 * 6).view(23, 6),
        std=torch.full((23, 6), 0.5),
        card=ModelCard(
            kind="motion-generator",
            name="tiny",
            trained=True,
            tags=("walk", "jump"),
            max_seconds=2.0,
        ),
        scope=OutOfDomainDetector.fit(
            list(CAPTIONS), list(CAPTIONS.values()), np.array(embeddings)
        ),
        device="cpu",
    )


@pytest.fixture(scope="session")
def generator() -> TextToMotion:
    return tiny_generator()


@pytest.fixture(scope="session")
def captions() -> dict[str, str]:
    return dict(CAPTIONS)


@pytest.fixture(scope="session")
def network() -> NetworkConfig:
    return tiny_network()


@pytest.fixture(scope="session")
def make_generator():
    return tiny_generator


@pytest.fixture(scope="session")
def make_network():
    return tiny_network
