"""`prepare-audio` as it is called: refusals, and BVH files with rendered songs to pairs."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.writers.bvh import write_bvh
from src.shared.io.storage import place
from src.shared.motion.motion import Motion
from tests.files import files_of

RUN = CliRunner()


def walk(period: float, seconds: float = 8.0) -> Motion:
    """A straight walk that brakes every `period` seconds."""
    t = np.arange(round(seconds * 30)) / 30
    z = 1.2 * t + 0.05 * np.sin(2 * np.pi * t / period)
    quaternions = np.zeros((len(t), 22, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    position = np.stack((0 * t, 0 * t + 0.95, z), 1).astype(np.float32)
    return Motion(quaternions, position, np.ones((len(t), 2), dtype=np.float32))


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--motion", "nowhere", "--music", "synthetic:3"], "--motion nowhere is no folder"),
        (["--motion", ".", "--music", "nowhere"], "--music nowhere is no folder"),
        (["--motion", ".", "--music", "synthetic:many"], "say how many songs"),
        (["--motion", ".", "--music", "synthetic:3", "--meter", "1"], "--meter 1 is out of range"),
        (["--motion", ".", "--music", "synthetic:3", "--passes", "0"], "--passes 0"),
        (["--motion", ".", "--music", "synthetic:3", "--min-seconds", "30"], "--min-seconds 30"),
        (["--motion", ".", "--music", "synthetic:3", "--workers", "0"], "--workers 0"),
    ],
)
def test_refusals(arguments: list[str], told: str, tmp_path: Path) -> None:
    result = RUN.invoke(app, ["prepare-audio", *arguments, "--out", str(tmp_path / "out")])
    assert result.exit_code == 2 and told in result.output
    assert not (tmp_path / "out").exists()


def test_a_folder_without_motion_is_told(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    command = ["prepare-audio", "--motion", str(tmp_path / "empty"), "--music", "synthetic:1"]
    result = RUN.invoke(app, [*command, "--out", str(tmp_path / "out")])
    assert result.exit_code == 1 and "holds no motion" in result.output


def test_bvh_files_and_songs_become_pairs(tmp_path: Path) -> None:
    (tmp_path / "walks").mkdir()
    for number in range(12):
        write_bvh(walk(0.46 + 0.01 * number), tmp_path / "walks" / f"mine{number}.bvh")
    (tmp_path / "songs").mkdir()
    for tempo in (115.0, 125.0):
        song = render_song(SongSpec(seconds=16.0, tempo=tempo, seed=int(tempo)))
        song.write_wav(tmp_path / "songs" / f"Song No. {tempo:.0f}.wav")
    (tmp_path / "songs" / "notes.txt").write_text("no sound")
    out = tmp_path / "pairs"
    command = ["prepare-audio", "--motion", str(tmp_path / "walks"), "--out", str(out), "--json"]
    command += ["--music", str(tmp_path / "songs"), "--max-seconds", "9"]
    result = RUN.invoke(app, command)
    assert result.exit_code == 0, result.output
    report = json.loads((out / "report.json").read_text())
    assert json.loads(result.stdout) == report
    assert report["phrases"] >= 2 and report["songs"] == 2
    assert report["alignment"]["all"]["after"]["motion_to_music"] > 0.7
    names = {path.name for path in (out / "motion").iterdir()}
    assert all(name.startswith("song-no-1") for name in names)
    assert json.loads((out / "bands.json").read_text())["bands"]

    again = RUN.invoke(app, [part for part in command if part != "--json"])
    assert again.exit_code == 0 and "phrases" in again.stdout and "by chance" in again.stdout

    songs, bucket = place("memory://songs"), place("memory://pairs")
    for song in (tmp_path / "songs").iterdir():
        (songs / song.name).write_bytes(song.read_bytes())
    command = [{str(out): str(bucket), str(tmp_path / "songs"): str(songs)}.get(part, part)
               for part in command]  # fmt: skip
    for _ in range(2):  # the second run does nothing
        result = RUN.invoke(app, command)
        assert result.exit_code == 0 and json.loads(result.stdout) == report
    stored = {name: (bucket / name).read_bytes() for name in bucket.find()}
    assert stored == {name: files_of(out)[name] for name in stored}
    assert len(stored) == len(files_of(out))
