"""The files of a dance: any motion's formats, and a page in which the song drives the body."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile

from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.errors import UserError
from src.shared.formats.arrays import read_npz
from src.shared.formats.preview.figures import rounds
from src.shared.formats.preview.trajectory import SongTrack
from src.shared.formats.registry import export_dance, write_dance_page
from src.shared.motion.motion import Danced, Motion
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.trajectory import MotionTrajectory, to_motion
from tests.shared.evaluation.tiny_pairs import nod
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.pages import Page, array

FRAMES = 90
FIGURES = (
    Danced("box@0.5", "waltz", (0.25, 0.75, 1.25), False, "a"),
    Danced("box@0.5", "waltz", (1.25, 1.75, 2.25, 2.75), True, "a'"),
)


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


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_a_stage_shows_the_figures_and_their_counts(tmp_path: Path, track: SongTrack) -> None:
    motion, path = dance()
    page = write_dance_page([motion], [path], tmp_path / "dance.html", track, [FIGURES])
    texts = "[...document.querySelectorAll('.figures button')].map((b) => b.innerText)"
    with Browser(page.as_uri() + "#t=1.3", tmp_path / "profile", (900, 700)) as browser:
        assert browser.evaluate("[state.yaw, state.follow]") == [0, False]
        first, second = browser.evaluate(texts)
        assert first.split() == ["waltz", "0:00", "a", "·", "box@0.5"] and "⇄" in second
        counted = browser.evaluate("[0, 0.3, 1.3, 2.3, 2.8].map((t) => danced(MOTIONS[0], t))")
        assert counted == [[-1, 0], [0, 1], [1, 1], [1, 3], [-1, 0]]
        ten, six = "{length: 11}", "{length: 7}"
        said = [browser.evaluate(f"[0, 5, 7, 8].map((i) => counted(i, {n}))") for n in (ten, six)]
        assert said == [[1, 6, 8, 1], [1, 6, 2, 3]]
        assert (rounds(8), rounds(10), rounds(6), rounds(12)) == (8, 8, 6, 6)
        browser.wait("document.querySelector('[aria-current]')?.innerText.includes('⇄')")
        browser.evaluate("document.querySelector('.figures button').click()")
        browser.wait("document.querySelector('[aria-current]')?.innerText.startsWith('waltz\\n')")
        assert browser.evaluate("state.time") == 0.25 and browser.problems == []


def test_a_path_has_no_stage(tmp_path: Path, track: SongTrack) -> None:
    motion, path = dance()
    shown = [FIGURES, None]
    page = Page(write_dance_page([motion] * 2, [path] * 2, tmp_path / "i.html", track, shown))
    staged, led = page.data["motions"]
    assert [figure["times"] for figure in staged["figures"]] == [list(f.times) for f in FIGURES]
    assert "figures" not in led and json.dumps(staged["figures"][1]).count("true") == 1


@pytest.mark.parametrize("figures", [None, (), FIGURES])
def test_the_film_has_the_song(
    tmp_path: Path, track: SongTrack, figures: tuple[Danced, ...] | None
) -> None:
    av = pytest.importorskip("av")
    motion, path = dance()
    short = replace(
        motion,
        quaternions=motion.quaternions[:24],
        root_position=motion.root_position[:24],
        contacts=motion.contacts[:24],
    )
    files = export_dance(short, path, tmp_path, "dance", ("mp4",), track, figures)
    with av.open(str(files["mp4"])) as film:
        assert [stream.type for stream in film.streams] == ["video", "audio"]
        assert film.streams.video[0].frames == 24
        heard = np.concatenate([f.to_ndarray()[0] for f in film.decode(audio=0)])
    assert track.path is not None
    song, rate = soundfile.read(track.path, frames=int(0.8 * 44100), always_2d=True)
    assert rate == 44100 and 0 <= len(heard) - len(song) <= 2048
    assert np.corrcoef(heard[: len(song)], song[:, 0])[0, 1] > 0.9
