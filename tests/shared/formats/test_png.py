"""Frame strips: the right size, the right limb on the right side, and poses that differ."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.errors import UserError
from src.shared.formats.png import render_strip
from src.shared.formats.raster import Camera
from src.shared.motion.motion import Motion


def a_motion(frames: int = 10, *, heading: float = 0.0) -> Motion:
    quaternions = np.zeros((frames, 22, 4), np.float32)
    quaternions[..., 0] = 1.0
    quaternions[:, 0] = np.cos(heading / 2), 0.0, np.sin(heading / 2), 0.0
    root = np.tile(np.array([0.0, 0.95, 0.0], np.float32), (frames, 1))
    return Motion(quaternions, root, np.zeros((frames, 2), np.float32), 30.0, "stands 立つ")


def columns_of(pixels: np.ndarray, *, warm: bool) -> float:
    """Mean column of strongly orange (warm) or blue pixels."""
    red, _, blue = (pixels[..., i].astype(float) for i in range(3))
    return float(np.nonzero((red - blue if warm else blue - red) > 80)[1].mean())


@pytest.mark.parametrize(("heading", "left_is_right_of_right"), [(0.0, True), (np.pi, False)])
def test_left_is_orange_and_on_its_own_side(
    tmp_path: Path, heading: float, left_is_right_of_right: bool
) -> None:
    path = render_strip(a_motion(heading=heading), tmp_path / "a.png", 1, panel=(120, 160),
                        azimuth=0.0)  # fmt: skip
    with Image.open(path) as image:
        pixels = np.asarray(image)[30:, :120]
    difference = columns_of(pixels, warm=True) - columns_of(pixels, warm=False)
    assert (difference > 20) if left_is_right_of_right else (difference < -20)


def test_one_row_a_motion_and_one_panel_a_frame(tmp_path: Path) -> None:
    path = render_strip([a_motion(), a_motion(1)], tmp_path / "a.png", 3, panel=(60, 90))
    with Image.open(path) as image:
        assert image.size == (3 * 60 + 90, 2 * (90 + 26))


def test_nothing_to_draw(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="nothing to draw"):
        render_strip([], tmp_path / "a.png")


def test_camera_keeps_lengths_and_directions() -> None:
    camera = Camera(0.7, 0.3, 100.0, np.array([1.0, 0.0, 2.0]), (50.0, 60.0))
    np.testing.assert_allclose(camera.basis() @ camera.basis().T, np.eye(3), atol=1e-12)
    assert np.linalg.det(camera.basis()) == pytest.approx(1.0)
    x, y, nearness = camera.project(np.array([1.0, 1.0, 2.0]))
    assert (x, nearness > 0) == (pytest.approx(50.0), True)
    assert y == pytest.approx(60.0 - 100.0 * np.cos(0.3))
