"""`generate --audio` from the command line: one song a run, damaged songs, what goes to stderr."""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from typer.testing import CliRunner

from src.cli.generate_files import dance_stems
from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.arrays import read_trajectory_npz
from src.shared.motion.trajectory import VELOCITY
from tests.shared.evaluation.tiny_pairs import tiny_model
from tests.shared.formats.pages import Page

runner = CliRunner()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model and a song."""
    folder = tmp_path_factory.mktemp("songs")
    tiny_model().save_pretrained(folder / "model")
    render_song(SongSpec(seconds=4.0, seed=1)).write_wav(folder / "song.wav")
    return folder


def generate(folder: Path, song: Path, *arguments: str | Path, code: int = 0) -> Any:
    command = ["generate", "--audio", song, "--model", folder / "model", "--device", "cpu"]
    result = runner.invoke(app, [str(word) for word in (*command, "--steps", "2", *arguments)])
    assert result.exit_code == code, result.output
    return result


def test_one_motion_and_nothing_but_words_on_stderr(folder: Path, tmp_path: Path) -> None:
    arguments = ("--format", "npz", "--out", tmp_path)
    first = generate(folder, folder / "song.wav", *arguments).stderr.splitlines()
    assert [line[:9] for line in first] == ["1 motion "]
    again = generate(folder, folder / "song.wav", *arguments).stderr
    assert f"1 file in {tmp_path} is replaced" in again
    many = (*arguments, "--format", "npz,html", "--num-samples", "2", "--return-all")
    both = generate(folder, folder / "song.wav", *many).stderr
    assert "1 file in" in both and "2 motions in" in both
    assert "3 files in" in generate(folder, folder / "song.wav", *many).stderr


def test_the_path_is_post_processed_as_it_is_told(folder: Path, tmp_path: Path) -> None:
    arguments = ("--format", "npz", "--out", tmp_path, "--post-processing")
    generate(folder, folder / "song.wav", *arguments, "max-velocity=0.001")
    made = read_trajectory_npz(tmp_path / "song.npz").data
    assert np.abs(made[:, VELOCITY]).max() == pytest.approx(0.001)
    wrong = generate(folder, folder / "song.wav", *arguments, "max_velocty=1", code=2)
    assert "the nearest valid key is max-velocity" in wrong.output


@pytest.mark.parametrize("name", ["cut.flac", "cut.mp3"])
def test_a_cut_off_song_gets_its_page(
    folder: Path, tmp_path: Path, name: str, capfd: pytest.CaptureFixture[str]
) -> None:
    samples, rate = soundfile.read(folder / "song.wav")
    path = tmp_path / name
    soundfile.write(path, samples, rate)
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])
    result = generate(folder, path, "--format", "npz,html", "--out", tmp_path, "--json")
    assert "Xing" not in capfd.readouterr().err
    files = json.loads(result.stdout)["motions"][0]["files"]
    frames = read_trajectory_npz(Path(files["npz"])).num_frames
    assert 60 < frames < 90
    assert [tag for tag, _ in Page(Path(files["html"])).tags if tag == "audio"] == ["audio"]


def test_a_song_without_beat_has_none_in_its_page(folder: Path, tmp_path: Path) -> None:
    soundfile.write(tmp_path / "still.wav", np.zeros(44_100 * 2), 44_100)
    asked = ("--format", "html", "--json", "--out", tmp_path)
    result = generate(folder, tmp_path / "still.wav", *asked)
    assert "no beat was found" in result.stderr
    assert "no beat was found" in json.loads(result.stdout)["motions"][0]["warning"]
    (motion,) = Page(tmp_path / "still.html").data["motions"]
    assert motion["meter"] == 0 and motion["beats"] == ""


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("A" * 240, "a" * 60),
        ("歌" * 80, "歌" * 40),
        ("01 - What's that?\x1b[2J; $(ls) <b>", "01-what-s-that-2j-ls-b"),
    ],
)
@pytest.mark.skipif(os.name == "nt", reason="such files cannot be made there")
def test_files_of_a_song_have_safe_names(
    folder: Path, tmp_path: Path, name: str, stem: str
) -> None:
    """As those of a prompt: the longest name that a song can have leaves room for endings."""
    song = tmp_path / f"{name}.wav"
    song.write_bytes((folder / "song.wav").read_bytes())
    generate(folder, song, "--format", "npz,html", "--out", tmp_path / "out")
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [f"{stem}.html", f"{stem}.npz"]
    prompt = "人" * 200
    longest = dance_stems(song, [prompt, prompt], 1)[1]
    assert longest.startswith(f"{stem}-人") and len(longest.encode()) < 230


def test_wrong_songs_are_refused(folder: Path, tmp_path: Path) -> None:
    song = folder / "song.wav"
    assert "given 2 times" in generate(folder, song, "--audio", song, code=2).stderr
    assert "is a folder" in generate(folder, tmp_path, code=2).stderr
    assert "no such file" in generate(folder, tmp_path / "none.ogg", code=2).stderr


def test_a_song_is_refused_before_any_model_is_loaded(tmp_path: Path) -> None:
    (tmp_path / "empty.wav").touch()
    for more in ([], ["--body"], ["--prompt", "a person dances"]):
        command = ["generate", "--audio", str(tmp_path / "empty.wav"), "--model", "no-such", *more]
        result = runner.invoke(app, command)
        assert result.exit_code == 1
        assert result.stderr == f"error: {tmp_path / 'empty.wav'} is empty; fetch it again\n"
