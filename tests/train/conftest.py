"""Lets the tests of this folder import the tiny task beside them; a little prepared data."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="module", autouse=True)
def calibrated_on_few() -> Iterator[None]:
    """A scope is calibrated on few captions: every run that ends makes one, of a random tower."""
    from src.train import text_stages

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text_stages, "CALIBRATING", 300)
        yield


@pytest.fixture
def held_back(monkeypatch: pytest.MonkeyPatch) -> None:
    """So little data has an empty val split: look at the training clips again instead."""
    from src.train import train_clip, train_generation
    from src.train.text_stages import split_set

    for stage in (train_clip, train_generation):
        monkeypatch.setattr(stage, "validation_set", lambda c, d: split_set(c, d, "train"))


@pytest.fixture(scope="session")
def prepared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A prepared folder of 48 synthetic clips and their mirror images."""
    from src.shared.data.prepare import prepare
    from src.shared.data.sources import SyntheticSource

    folder = tmp_path_factory.mktemp("prepared") / "data"
    prepare([SyntheticSource(48)], folder, workers=1)
    return folder


@pytest.fixture(scope="session")
def circles(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of motion phrases."""
    from tiny_audio_stage import write_circles

    return write_circles(tmp_path_factory.mktemp("circles"))
