"""Picture of a trajectory: a map and a chart in the bar's colours, rows for long songs."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.formats.preview.charts import render_trajectory
from src.shared.formats.preview.trajectory import PATH, SongTrack, phase_palette
from src.shared.motion.trajectory import MotionTrajectory, from_motion, to_motion
from tests.shared.motion.trajectories import smooth_trajectory


def pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def near(image: np.ndarray, colour: np.ndarray | tuple[int, int, int], reach: int = 14) -> int:
    return int((np.abs(image - np.asarray(colour)).max(-1) <= reach).sum())


def test_the_path_has_the_colours_of_the_bar(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(1, 240)
    image = pixels(render_trajectory(trajectory, tmp_path / "a.png", title="歩く"))
    assert image.shape == (30 + 430, 430 + 800 + 8, 3)
    map_, chart = image[90:, :430], image[30:, 430:]
    for colour in phase_palette(6).astype(int):
        assert near(map_, colour) > 10
        assert near(chart, np.rint(0.45 * colour + 0.55 * 255)) > 100


def test_no_music_is_plain_red(tmp_path: Path) -> None:
    still = from_motion(to_motion(smooth_trajectory(1)))
    image = pixels(render_trajectory(still, tmp_path / "a.png"))
    assert near(image[:, :430], PATH) > 100
    assert near(image[:, :430], phase_palette(6)[3].astype(int)) == 0


def test_a_song_without_beat_is_plain_and_says_so(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(1, 240)  # its bar phase moves on
    silent = SongTrack(None, np.array([]), np.array([]))
    image = pixels(render_trajectory(trajectory, tmp_path / "a.png", silent))
    assert near(image[:, :430], PATH) > 100
    assert near(image[30:], phase_palette(6)[3].astype(int)) == 0
    assert (image[30 + 6, 430 : 430 + 800].sum(-1) > 700).all()  # no ticks
    title = pixels(render_trajectory(trajectory, tmp_path / "b.png"))[:30]
    assert (image[:30] != title).any()


def test_ticks_stand_at_the_songs_beats(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(1, 240)  # 8 seconds: 100 pixels a second
    song = SongTrack(None, np.arange(1, 8, 1.0), np.array([2.0, 6.0]))
    image = pixels(render_trajectory(trajectory, tmp_path / "a.png", song))
    row = image[30 + 6, 430 : 430 + 800].sum(-1)  # above the small ticks
    assert [round(x / 100) for x in np.flatnonzero(row < 400)] == [2, 6]
    low = image[30 + 11, 430 : 430 + 800].sum(-1)
    assert {round(x / 100) for x in np.flatnonzero(low < 500)} == set(range(1, 8))


@pytest.mark.parametrize(("frames", "rows"), [(1, 1), (601, 2), (18_000, 20)])
def test_any_length(tmp_path: Path, frames: int, rows: int) -> None:
    image = pixels(render_trajectory(smooth_trajectory(1, frames), tmp_path / "a.png"))
    assert image.shape[0] == 30 + max(430, rows * 92)


def test_a_runaway_still_fits(tmp_path: Path) -> None:
    data = smooth_trajectory(1).data.copy()
    data[:, :3] *= 1e5
    path = render_trajectory(MotionTrajectory(data), tmp_path / "a.png")
    assert path.stat().st_size < 1_000_000
