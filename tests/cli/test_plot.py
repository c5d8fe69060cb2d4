"""`plot` from the command line: pictures out, one line where there is none."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.csv_files import write_trajectory_csv
from tests.shared.motion.trajectories import smooth_trajectory

pytest.importorskip("matplotlib")


def test_a_trajectory_and_a_log(tmp_path: Path) -> None:
    file = write_trajectory_csv(smooth_trajectory(1, 30), tmp_path / "a.csv")
    result = CliRunner().invoke(app, ["plot", str(file)])
    assert result.exit_code == 0, result.output
    assert result.stdout.strip() == str(tmp_path / "a.png") and (tmp_path / "a.png").exists()
    log = tmp_path / "log.jsonl"
    log.write_text('{"step": 1, "loss": 2.0}\n{"step": 2, "loss": 1.0}\n', encoding="utf-8")
    picture = tmp_path / "new" / "losses.pdf"
    result = CliRunner().invoke(app, ["plot", str(log), "--out", str(picture)])
    assert result.exit_code == 0 and picture.read_bytes().startswith(b"%PDF")


def test_an_analysed_song_is_pointed_to_its_own_picture(tmp_path: Path) -> None:
    song, file = tmp_path / "song.wav", tmp_path / "song.npz"
    render_song(SongSpec(seconds=2.0)).write_wav(song)
    features = ["features", str(song), "--out", str(file), "--no-cache"]
    assert CliRunner().invoke(app, features).exit_code == 0
    result = CliRunner().invoke(app, ["plot", str(file)])
    assert result.exit_code == 1
    assert "is an analysed song, not a trajectory; `features SONG --plot" in result.stderr


@pytest.mark.parametrize(("arguments", "code"), [
    (["none.npz"], 2), (["none.json"], 2), (["."], 2), (["a.bvh"], 2),
    (["none.npz", "--out", "a.gif"], 2), (["none.npz", "--out", "."], 2),
])  # fmt: skip
def test_wrong_calls_end_in_one_line(
    arguments: list[str], code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["plot", *arguments])
    assert result.exit_code == code
    assert result.stderr.startswith("error: ") and result.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())
