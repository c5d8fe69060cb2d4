"""The studio's page in a browser, and what the command line makes."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from src.shared.pipelines.motion_generator import MotionGenerator
from src.shared.studio.page import write_studio
from tests.shared.formats.chromium_pipe import Browser


@pytest.fixture(scope="package")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_studio(tmp_path_factory.mktemp("studio"))


@pytest.fixture(scope="package")
def browser(page: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """The page with its model loaded; one take at a time."""
    profile = tmp_path_factory.mktemp("profile")
    with Browser(page.as_uri(), profile, ready="typeof studio === 'object'") as opened:
        opened.wait("studio.timings?.first !== undefined", 180)
        opened.evaluate("studio.history.change({ takes: 1 })")
        opened.wait("!studio.making")
        yield opened


@pytest.fixture(scope="package")
def generator() -> MotionGenerator:
    return MotionGenerator("starter", device="cpu")
