"""The files of a dance: any motion's formats, and a page in which the song drives the body."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from src.shared.audio.synthetic_score import SongSpec
from src.shared.audio.synthetic_songs import render_song
from src.shared.errors import UserError
from src.shared.formats.arrays import read_npz
from src.shared.formats.preview.trajectory import SongTrack
from src.shared.formats.registry import export_dance, write_dance_page
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.trajectory import MotionTrajectory, to_motion
from tests.shared.evaluation.tiny_pairs import nod
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.pages import Page, array

FRAMES = 90


@pytest.fixture
def track(tmp_path: Path) -> SongTrack:
    path = tmp_path / "song.wav"
    song = render_song(SongSpec(seconds=3.0, seed=1))
    song.write_wav(path)
    return SongTrack(path, song.beat_times, song.downbeat_times)


def dance(text: str = "a person dances") -> tuple[Motion, MotionTrajectory]:
    """A body whose left arm turns at one speed while it walks."""
    path = nod(np.arange(FRAMES + 2) / 30 * 0.5)
    motion = to_motion(path, text=text)
    angle = np.arange(FRAMES) / 30.0
    motion.quaternions[:, JOINT_INDEX["l_shoulder"], 0] = np.cos(angle)
    motion.quaternions[:, JOINT_INDEX["l_shoulder"], 3] = np.sin(angle)
    return motion, path


def test_every_format_is_written_and_the_page_has_the_song(
    tmp_path: Path, track: SongTrack
) -> None:
    motion, path = dance()
    files = export_dance(motion, path, tmp_path, "dance", ("html", "bvh", "npz"), track)
    assert list(files) == ["html", "bvh", "npz"] and all(file.is_file() for file in files.values())
    kept = read_npz(files["npz"]).quaternions
    np.testing.assert_allclose(kept, motion.quaternions, atol=1e-6)
    page = Page(files["html"])
    assert [tag for tag, _ in page.tags if tag == "audio"] == ["audio"]
    (card,) = page.data["motions"]
    assert card["text"] == "a person dances" and JOINT_INDEX["l_shoulder"] in card["turning"]
    speed = array(card["speed"], "<u2") / 1000
    steps = np.linalg.norm(np.diff(motion.positions(), axis=0), axis=-1).mean(1) * 30
    np.testing.assert_allclose(speed[:-1], steps, atol=0.002)  # of the whole body
    text = files["html"].read_text("utf-8")
    assert "mean speed of all joints" in text and "stands in" not in text


def test_several_dances_share_a_page(tmp_path: Path, track: SongTrack) -> None:
    both = [dance("one"), dance("two")]
    bodies, paths = zip(*both, strict=True)
    page = Page(write_dance_page(bodies, paths, tmp_path / "index.html", track))
    assert [card["text"] for card in page.data["motions"]] == ["one", "two"]


def test_a_broken_body_is_refused(tmp_path: Path, track: SongTrack) -> None:
    motion, path = dance()
    broken = replace(motion, quaternions=motion.quaternions * np.nan)
    with pytest.raises(UserError, match="NaN"):
        export_dance(broken, path, tmp_path, "dance", ("html",), track)
    assert not (tmp_path / "dance.html").exists()


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_the_song_drives_the_body(tmp_path: Path, track: SongTrack) -> None:
    motion, path = dance()
    page = write_dance_page([motion], [path], tmp_path / "dance.html", track)
    wrist = JOINT_INDEX["l_wrist"]
    with Browser(page.as_uri(), tmp_path / "profile") as browser:
        browser.press(" ")
        browser.wait("song.currentTime > 0.5")
        now, *place = browser.evaluate(
            f"[state.time, ...poseAt(MOTIONS[0], state.time).positions[{wrist}]]"
        )
        track_of_wrist = motion.positions()[:, wrist]
        expected = [np.interp(30 * now, np.arange(FRAMES), axis) for axis in track_of_wrist.T]
        np.testing.assert_allclose(place, expected, atol=0.01)
        assert abs(browser.evaluate("song.currentTime") - now) < 0.25
        assert browser.problems == []
