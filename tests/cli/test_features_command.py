"""`features SONG --out F.npz`."""

import json
from pathlib import Path

import numpy as np
import pytest
import soundfile
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song

run = CliRunner().invoke


@pytest.fixture(autouse=True)
def private_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MOTIONGEN_AUDIO_CACHE", str(tmp_path / "cache"))


@pytest.fixture(scope="module")
def tune(tmp_path_factory: pytest.TempPathFactory) -> Path:
    rendered = render_song(SongSpec(seconds=4.0, tempo=110.0, meter=3, seed=5))
    path = tmp_path_factory.mktemp("songs") / "tune.ogg"
    soundfile.write(path, rendered.samples, rendered.sample_rate)
    return path


def test_writes_arrays_and_a_picture(tune: Path, tmp_path: Path) -> None:
    out, plot = tmp_path / "new" / "song.npz", tmp_path / "song.png"
    result = run(app, ["features", str(tune), "--out", str(out), "--plot", str(plot)])
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[1:] == [str(out), str(plot)]
    assert "tune.ogg: 4.00 s, 120 frames" in result.stdout
    with np.load(out) as arrays:
        assert arrays["mel"].shape == (128, 120) and arrays["phase"].shape == (120,)
    from PIL import Image

    with Image.open(plot) as picture:
        assert picture.format == "PNG" and picture.width > 900
        assert len(picture.getcolors(1 << 24) or []) > 500
    assert len(list((tmp_path / "cache").glob("*.npz"))) == 1


def test_json_and_meter_and_cache_folder(tune: Path, tmp_path: Path) -> None:
    out, folder = tmp_path / "song.npz", tmp_path / "elsewhere"
    arguments = ["features", str(tune), "--out", str(out), "--meter", "3", "--json"]
    result = run(app, [*arguments, "--cache-dir", str(folder)])
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["meter"] == 3 and told["frames"] == 120 and told["out"] == str(out)
    assert len(list(folder.glob("*.npz"))) == 1 and not (tmp_path / "cache").exists()
    assert run(app, [*arguments, "--no-cache"]).exit_code == 0
    assert not (tmp_path / "cache").exists()


@pytest.mark.parametrize(
    "extra, words",
    [
        (["--chroma", "stft"], "choose from fast, cqt"),
        (["--meter", "1"], "--meter 1 is out of range"),
        (["--out", "a" * 240 + ".npz"], "shorten its name"),
        (["--out", "song.txt"], "--out song.txt is no .npz file"),
        (["--plot", "song.jpg"], "--plot song.jpg is no .png file"),
    ],
)
def test_wrong_usage(tune: Path, tmp_path: Path, extra: list[str], words: str) -> None:
    result = run(app, ["features", str(tune), "--out", str(tmp_path / "song.npz"), *extra])
    assert result.exit_code == 2
    assert words in result.stderr and len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize("content", [None, b"", b"not a sound\n" * 200, b"RIFF" + bytes(40)])
def test_bad_files_end_in_one_line(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "song.mp3"
    if content is not None:
        path.write_bytes(content)
    result = run(app, ["features", str(path), "--out", str(tmp_path / "song.npz")])
    assert result.exit_code == (2 if content is None else 1)
    assert result.stderr.startswith("error: ") and len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "song.npz").exists()
