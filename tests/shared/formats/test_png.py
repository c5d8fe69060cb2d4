"""Frame strips: the right size, a body in each panel, left and right in their colours."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.errors import UserError
from src.shared.formats.png import render_strip
from src.shared.formats.raster import Camera
from src.shared.motion.motion import Motion


def standing(text: str = "stands 立つ") -> Motion:
    quaternions = np.zeros((2, 22, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.tile(np.array([0, 0.93, 0], np.float32), (2, 1))
    return Motion(quaternions, root, np.zeros((2, 2), np.float32), 30.0, text)


def test_a_strip_shows_the_left_side_on_the_right(tmp_path: Path) -> None:
    """Seen from the front the character's left, orange, is on the right of the picture."""
    path = render_strip(standing(), tmp_path / "a.png", 2, panel=(160, 120), azimuth=0.0)
    pixels = np.asarray(Image.open(path)).astype(int)
    assert pixels.shape == (120 + 26, 2 * 160 + 120, 3)
    for start in (0, 160):
        panel = pixels[26:, start : start + 160]
        orange = np.argwhere((panel[..., 0] - panel[..., 2]) > 60)
        blue = np.argwhere((panel[..., 2] - panel[..., 0]) > 60)
        assert min(len(orange), len(blue)) > 100
        assert orange[:, 1].mean() > 85
        assert blue[:, 1].mean() < 75


def test_one_row_a_motion(tmp_path: Path) -> None:
    path = render_strip([standing(), standing("")], tmp_path / "a.png", 1, panel=(60, 80))
    assert Image.open(path).size == (60 + 80, 2 * (80 + 26))


def test_nothing_to_draw(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="nothing to draw"):
        render_strip([], tmp_path / "a.png")
    with pytest.raises(UserError, match="nothing to draw"):
        render_strip(standing(), tmp_path / "a.png", 0)


def test_the_camera_looks_at_the_face() -> None:
    camera = Camera(0.0, 0.0, 100.0, np.zeros(3), (50.0, 60.0))
    np.testing.assert_allclose(camera.project(np.array([1.0, 2.0, 3.0])), [150, -140, 300])
    basis = Camera(0.7, 0.3, 1.0, np.zeros(3), (0, 0)).basis()
    np.testing.assert_allclose(basis @ basis.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(basis) == pytest.approx(1)
