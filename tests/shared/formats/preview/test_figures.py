"""Frame strips: the right size, a body in each panel, left and right in their colours.
Films: the right length in real time, the figure in the picture, and the camera on it."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from src.shared.errors import UserError
from src.shared.formats.preview import figures as video
from src.shared.formats.preview.drawing import Camera
from src.shared.formats.preview.figures import (
    frames,
    gif_rate,
    render_strip,
    write_gif,
    write_mp4,
)
from src.shared.motion.motion import Motion
from tests.full_disk import full_disk


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


def walk(count: int, fps: float) -> Motion:
    """A T-pose that glides 3 m along +X."""
    quaternions = np.zeros((count, 22, 4), np.float32)
    quaternions[..., 0] = 1
    root = np.zeros((count, 3), np.float32)
    root[:, 0], root[:, 1] = np.linspace(0, 3, count), 0.95
    return Motion(quaternions, root, np.ones((count, 2), np.float32), fps, "歩く")


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video, "SIZE", (96, 96))


@pytest.mark.parametrize(("fps", "expected"), [(30, 25), (24, 20), (60, 50), (25, 25), (100, 100)])
def test_gif_rates_are_whole_hundredths(fps: float, expected: float) -> None:
    assert gif_rate(fps) == pytest.approx(expected)


def test_a_gif_plays_in_real_time(tmp_path: Path) -> None:
    with Image.open(write_gif(walk(10, 30.0), tmp_path / "a.gif")) as film:
        assert film.info["loop"] == 0
        times = [picture.info["duration"] for picture in ImageSequence.Iterator(film)]
    assert set(times) == {40}
    assert sum(times) / 1000 == pytest.approx(10 / 30, abs=0.05)


def test_an_mp4_has_every_frame(tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    with av.open(str(write_mp4(walk(9, 30.0), tmp_path / "a.mp4"))) as film:
        stream = film.streams.video[0]
        assert (stream.width, stream.height) == video.SIZE
        assert stream.codec_context.name == "h264"
        assert float(stream.average_rate) == pytest.approx(30.0)
        pictures = [frame.to_ndarray(format="rgb24") for frame in film.decode(stream)]
    assert len(pictures) == 9
    drawn = np.asarray(next(frames(walk(9, 30.0), video.SIZE)))
    assert np.abs(pictures[0].astype(int) - drawn).mean() < 12  # chroma is halved


def test_fast_motions_are_filmed_at_thirty(tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    with av.open(str(write_mp4(walk(13, 120.0), tmp_path / "a.mp4"))) as film:
        assert len(list(film.decode(video=0))) == 4


def test_the_figure_is_in_the_middle_of_every_picture() -> None:
    for picture in frames(walk(6, 3.0), (120, 120)):
        pixels = np.asarray(picture).astype(int)
        limbs = np.abs(pixels[..., 0] - pixels[..., 2]) > 60  # orange and blue
        rows, columns = np.nonzero(limbs[15:])
        assert 40 < columns.mean() < 80
        assert rows.min() > 2


def test_what_is_too_long_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(video.MAX_PICTURES, "gif", 5)
    with pytest.raises(UserError, match=r"a\.gif: 1 s are too long for gif, 0 s are the limit"):
        write_gif(replace(walk(30, 25.0)), tmp_path / "a.gif")
    assert not list(tmp_path.iterdir())


def test_without_pyav_the_remedy_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(UserError, match=r"a\.mp4: MP4 needs PyAV; install it with: pip install av"):
        write_mp4(walk(3, 30.0), tmp_path / "a.mp4")


def test_a_full_disk_is_one_line(tmp_path: Path) -> None:
    pytest.importorskip("av")
    with full_disk(), pytest.raises(UserError, match=r"a\.mp4: File too large; free space"):
        write_mp4(walk(9, 30.0), tmp_path / "a.mp4")
    assert not list(tmp_path.iterdir())
