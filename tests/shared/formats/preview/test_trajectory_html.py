"""The page of a trajectory: its data, its song, and that a browser keeps both together."""

import base64
import json
import re
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.formats.preview.html import write_trajectory_html
from src.shared.formats.preview.trajectory import SongTrack
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.style import style_values
from src.shared.motion.trajectory import from_motion, to_motion
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.pages import HOSTILE, Page, array
from tests.shared.motion.trajectories import smooth_trajectory

soundfile = pytest.importorskip("soundfile")


@pytest.fixture(scope="module")
def song(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four seconds of clicks at 120 BPM."""
    path = tmp_path_factory.mktemp("song") / "clicks <script> &.wav"
    t = np.arange(4 * 8000) / 8000
    soundfile.write(path, 0.5 * np.sin(2 * np.pi * 440 * t) * np.exp(-20 * (t % 0.5)), 8000)
    return path


def test_the_data_decode_to_the_trajectory(tmp_path: Path) -> None:
    trajectory = smooth_trajectory(1)
    data = Page(write_trajectory_html(trajectory, tmp_path / "a.html", titles=["t"])).data
    (motion,) = data["motions"]
    assert (motion["text"], motion["fps"], motion["frames"]) == ("t", 30.0, 120)
    np.testing.assert_array_equal(array(motion["root"], "<f4").reshape(-1, 3), trajectory.position)
    legs = [JOINT_INDEX[f"{s}_{p}"] for p in ("hip", "knee", "ankle") for s in "lr"]
    assert motion["turning"] == [0, *legs]
    turns = array(motion["quaternions"], "<i2").reshape(120, 7, 4)[:, 0] / 32767
    np.testing.assert_allclose(turns, trajectory.quaternion, atol=2e-5)
    np.testing.assert_allclose(array(motion["phase"], "<u2") / 65536, trajectory.phase, atol=2e-5)
    speed = np.linalg.norm(trajectory.velocity, axis=-1)
    np.testing.assert_allclose(array(motion["speed"], "<u2") / 1000, speed, atol=6e-4)
    style = array(motion["style"], "u1").reshape(120, 4) / 255
    np.testing.assert_allclose(style, style_values(trajectory.style), atol=2e-3)
    assert len(array(motion["beats"], "<f4")) == len(array(motion["downbeat"], "u1")) > 0
    assert len(data["palette"]) == 60


def test_the_song_is_inside_and_its_beats_are_shown(tmp_path: Path, song: Path) -> None:
    track = SongTrack(song, np.arange(8) * 0.5, np.array([0.5, 2.5]), 4)
    page = Page(write_trajectory_html(smooth_trajectory(1), tmp_path / "a.html", track))
    (audio,) = [attributes for tag, attributes in page.tags if tag == "audio"]
    head, data = str(audio["src"]).split(";base64,")
    assert head == "data:audio/wav"
    assert base64.b64decode(data, validate=True) == song.read_bytes()
    (motion,) = page.data["motions"]
    np.testing.assert_allclose(array(motion["beats"], "<f4"), np.arange(8) * 0.5)
    assert array(motion["downbeat"], "u1").tolist() == [0, 1, 0, 0, 0, 1, 0, 0]


def test_titles_are_data_and_nothing_comes_from_elsewhere(tmp_path: Path, song: Path) -> None:
    shown = [smooth_trajectory(2, 3)] * len(HOSTILE)
    path = write_trajectory_html(shown, tmp_path / "a.html", SongTrack(song), HOSTILE)
    page = Page(path)
    assert [motion["text"] for motion in page.data["motions"]] == HOSTILE
    plain = Page(write_trajectory_html(shown[0], tmp_path / "b.html", SongTrack(song)))
    assert [tag for tag, _ in page.tags] == [tag for tag, _ in plain.tags]
    text = re.sub('base64,[^"]*', "", path.read_text("utf-8"))
    assert not re.search(r"https?:|//cdn|@import|url\(|\bimport\(|fetch\(", text)


def test_ten_minutes_stay_small(tmp_path: Path) -> None:
    path = write_trajectory_html(smooth_trajectory(3, 18_000), tmp_path / "a.html")
    assert path.stat().st_size < 2_300_000


def test_no_music_shows_no_dial(tmp_path: Path) -> None:
    still = from_motion(to_motion(smooth_trajectory(1)))
    (motion,) = Page(write_trajectory_html(still, tmp_path / "a.html")).data["motions"]
    assert "phase" not in motion


def test_a_song_without_beat_has_no_dial_and_no_beats(tmp_path: Path, song: Path) -> None:
    track = SongTrack(song, np.array([]), np.array([]), 4)
    path = write_trajectory_html(smooth_trajectory(1), tmp_path / "a.html", track)
    page = Page(path)
    (motion,) = page.data["motions"]
    assert motion["meter"] == 0 and motion["beats"] == ""
    assert len(page.data["palette"]) == 1 and motion["speed"]
    assert "No beat was found" in path.read_text("utf-8")


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_a_browser_shows_a_song_without_beat(tmp_path: Path, song: Path) -> None:
    track = SongTrack(song, np.array([]), np.array([]), 4)
    page = write_trajectory_html(smooth_trajectory(1), tmp_path / "a.html", track)
    with Browser(page.as_uri() + "#t=1.0", tmp_path / "profile") as browser:
        browser.wait("!state.dirty")
        assert browser.problems == []


def test_nothing_to_show_and_no_song(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no trajectory"):
        write_trajectory_html([], tmp_path / "a.html")
    with pytest.raises(UserError, match=r"none\.ogg"):
        track = SongTrack(tmp_path / "none.ogg")
        write_trajectory_html(smooth_trajectory(1, 3), tmp_path / "a.html", track)
    assert not list(tmp_path.iterdir())


NODE_CHECK = """
const fs = require("fs");
const page = fs.readFileSync(process.argv[1], "utf8");
const data = /type="application.json">(.*?)<.script>/s.exec(page)[1];
const scripts = process.argv.slice(2).map((name) => fs.readFileSync(name, "utf8"));
const run = new Function("document", "atob", scripts.join("") + `
const [motion] = MOTIONS, frames = [0, 10.5, 50.25, 118.9, 500];
return { phases: frames.map((frame) => phaseAt(motion, frame)),
  after: [0, 1, 2, 99].map((time) => beatAfter(motion, time)), beats: [...motion.beats],
  ranges: [0, 6, 60].map((time) => stripRange({ seconds: 60 }, time)),
  glow: glowAt(motion, motion.beats[0]) };`);
const document = { getElementById: () => ({ textContent: data }) };
console.log(JSON.stringify(run(document, atob)));
"""


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_phase_and_beats_of_the_viewer(tmp_path: Path) -> None:
    """The viewer's own code, between frames, against the trajectory."""
    trajectory = smooth_trajectory(4)
    page = write_trajectory_html(trajectory, tmp_path / "a.html")
    folder = Path(__file__).parents[4] / "src/shared/formats/preview"
    scripts = [str(folder / f"preview_{name}.js") for name in ("scene", "rhythm")]
    command = ["node", "-e", NODE_CHECK, str(page), *scripts]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    frames = np.minimum([0, 10.5, 50.25, 118.9, 500], 119)
    expected = np.interp(frames, np.arange(120), trajectory.phase_unwrapped) % 1
    gap = np.abs(np.array(result["phases"]) - expected)
    assert np.minimum(gap, 1 - gap).max() < 5e-5
    assert result["after"] == np.searchsorted(result["beats"], [0, 1, 2, 99]).tolist()
    assert result["ranges"] == [[0, 12], [0, 12], [48, 60]]
    assert result["glow"] >= 0.5


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_a_browser_keeps_body_dial_and_song_together(tmp_path: Path, song: Path) -> None:
    """Really plays; then seeks, loops, stops at the end, and starts again."""
    trajectory = smooth_trajectory(5)  # 4 seconds, as the song
    page = write_trajectory_html(trajectory, tmp_path / "a.html", SongTrack(song), ["歩く"])
    with Browser(page.as_uri(), tmp_path / "profile") as browser:
        assert browser.evaluate("[state.playing, song.paused, silent]") == [False, True, False]
        browser.press(" ")
        browser.wait("song.currentTime > 0.3")
        together = """new Promise((done) => requestAnimationFrame(() => done([song.currentTime,
            state.time, phaseAt(MOTIONS[0], 30 * state.time),
            ...poseAt(MOTIONS[0], state.time).positions[0]])))"""
        seen = []
        for _ in range(3):
            seen.append(browser.evaluate(together))
            time.sleep(0.2)
        for heard, shown, phase, *place in seen:
            assert abs(heard - shown) < 0.12
            frame = min(30 * shown, 119)
            bars = np.interp(frame, np.arange(120), trajectory.phase_unwrapped) % 1
            assert abs((phase - bars + 0.5) % 1 - 0.5) < 1e-3
            path = [np.interp(frame, np.arange(120), axis) for axis in trajectory.position.T]
            np.testing.assert_allclose(place, path, atol=1e-4)
        assert seen[0][1] < seen[1][1] < seen[2][1]
        browser.evaluate("song.currentTime = 2.5")  # not through our clock: the song leads
        browser.wait("state.time >= 2.5 && Math.abs(song.currentTime - state.time) < 0.12")
        browser.evaluate("song.pause()")  # as a headset does
        browser.wait("!state.playing")
        browser.evaluate("seek(3.2)")
        browser.wait("song.currentTime === 3.2 && state.time === 3.2")
        browser.press(" ")
        browser.wait("state.time < 3")  # looped
        assert browser.evaluate("state.playing")
        browser.press("l")
        browser.evaluate("seek(3.7)")
        browser.wait("!state.playing")
        assert browser.evaluate("state.time") == pytest.approx(119 / 30)
        browser.press("m")
        assert browser.evaluate("song.muted")
        assert browser.problems == []


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_a_song_that_the_browser_cannot_play(tmp_path: Path, song: Path) -> None:
    page = write_trajectory_html(smooth_trajectory(5), tmp_path / "a.html", SongTrack(song))
    page.write_text(page.read_text("utf-8").replace(";base64,UklGR", ";base64,AAAAA"), "utf-8")
    with Browser(page.as_uri(), tmp_path / "profile") as browser:
        browser.wait("silent")
        assert "cannot play" in browser.evaluate("find('note').textContent")
        browser.press(" ")
        browser.wait("state.time > 0.2")  # its own clock
