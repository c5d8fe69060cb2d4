"""Real mocap beside the checkout, when it is there."""

import tarfile
from pathlib import Path

import pytest

SHARED = Path(__file__).resolve().parents[4] / "shared" / "data"


def unpacked(archive: str, folder: Path, *, keep: str = "") -> Path:
    """Files of an archive whose names hold `keep`; skips the test where there is no archive."""
    path = SHARED / archive
    if not path.exists():
        pytest.skip(f"{archive} is not beside the checkout")
    with tarfile.open(path) as tar:
        tar.extractall(folder, [m for m in tar if keep in m.name], filter="data")
    return folder


@pytest.fixture(scope="session")
def cmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Seventy-five CMU files."""
    return unpacked("cmu.tar.xz", tmp_path_factory.mktemp("cmu")) / "cmu"


@pytest.fixture(scope="session")
def bandai(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The whole Bandai-Namco set."""
    return unpacked("bandai-namco.tar.xz", tmp_path_factory.mktemp("bandai"))


@pytest.fixture(scope="session")
def hdm05(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The HDM05 takes, ASF/AMC."""
    return unpacked("hdm05.tar.xz", tmp_path_factory.mktemp("hdm05"))
