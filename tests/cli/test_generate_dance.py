"""`generate --audio --prompt` and `--audio --body`: files, facts, candidates, refusals."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from typer.testing import CliRunner

from src.cli.generate import left_out
from src.cli.tools import app
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.formats.arrays import read_npz
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.evaluation.tiny_pairs import tiny_model
from tests.shared.formats.pages import Page, array
from tests.shared.model.conftest import tiny_generator

runner = CliRunner()
PROMPT = ("--prompt", "a person walks forward")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Both models and a song."""
    folder = tmp_path_factory.mktemp("dances")
    tiny_model().save_pretrained(folder / "path")
    tiny_generator().save_pretrained(folder / "body")
    render_song(SongSpec(seconds=3.0, seed=1)).write_wav(folder / "song.wav")
    return folder


def generate(folder: Path, *arguments: str | Path, song: Path | None = None, code: int = 0) -> Any:
    models = ["--model", folder / "path", "--body-model", folder / "body", "--device", "cpu"]
    command = ["generate", "--audio", song or folder / "song.wav", *models, "--steps", "2"]
    result = runner.invoke(app, [str(word) for word in (*command, *arguments)])
    assert result.exit_code == code, result.output
    return result


def test_a_song_and_a_sentence_become_a_body(folder: Path, tmp_path: Path) -> None:
    told = json.loads(generate(folder, *PROMPT, "--out", tmp_path, "--json").stdout)
    (row,) = told["motions"]
    assert list(row["files"]) == ["bvh", "glb", "npz", "html"]
    assert all(Path(path).name.startswith("song-a-person-walks") for path in row["files"].values())
    assert row["root-error"] is None and told["model"] is None  # nothing is pinned
    assert row["frames"] == 90 and row["prompt"] == "a person walks forward"
    assert row["passages"] == [{"text": "a person walks forward", "seconds": 3.0}]
    assert set(row["beat-alignment"]) == {"motion-to-music", "music-to-motion", "chance"}
    assert told["tempo"] > 0 and told["beats"] > 0
    assert set(told["timings"]) >= {"load", "listen", "body", "write", "total"}
    page = Page(Path(row["files"]["html"]))
    assert [tag for tag, _ in page.tags if tag == "audio"] == ["audio"]
    (shown,) = page.data["motions"]
    motion = read_npz(Path(row["files"]["npz"]))
    np.testing.assert_allclose(
        array(shown["root"], "<f4").reshape(-1, 3), motion.root_position, atol=1e-5
    )
    assert len(shown["turning"]) > 4  # all joints move, not only the stand-in's legs


def test_it_dances_figures_and_says_which(folder: Path, tmp_path: Path) -> None:
    asked = ("--prompt", "a person dances", "--format", "npz", "--out", tmp_path, "--json")
    render_song(SongSpec(seconds=9.0, tempo=120.0, seed=5)).write_wav(tmp_path / "long.wav")
    rows = {}
    for flag in ("--figures", "--no-figures"):
        told = json.loads(generate(folder, *asked, flag, song=tmp_path / "long.wav").stdout)
        (rows[flag],) = told["motions"]
    assert rows["--no-figures"]["figures"] == []
    figures = rows["--figures"]["figures"]
    assert figures and {"name", "kind", "start", "stop", "counts", "mirrored"} <= set(figures[0])


def test_candidates_share_a_page_and_are_scored(folder: Path, tmp_path: Path) -> None:
    arguments = (*PROMPT, "--num-samples", "2", "--return-all", "--format", "npz,html", "--json")
    told = json.loads(generate(folder, *arguments, "--out", tmp_path).stdout)
    assert [row["rank"] for row in told["motions"]] == [1, 2]
    assert {row["sample"] for row in told["motions"]} == {0, 1}
    (scores,) = told["selection"]
    assert {"feet", "smoothness", "beats"} <= set(scores["candidates"][0])
    assert len(Page(Path(told["index"])).data["motions"]) == 2
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["index.html", *(f"song-a-person-walks-forward{n}.npz" for n in ("-2", ""))]


@pytest.mark.parametrize("drawn", [False, True])
def test_who_asks_for_a_path_gets_one(folder: Path, tmp_path: Path, drawn: bool) -> None:
    (tmp_path / "way.csv").write_text("x,z\n0,0\n0,1\n1,2\n")
    asked = ("--path", tmp_path / "way.csv") if drawn else ("--follow-path", "--style", "tired")
    arguments = (*PROMPT, *asked, "--format", "npz", "--out", tmp_path, "--json")
    told = json.loads(generate(folder, *arguments).stdout)
    (row,) = told["motions"]
    assert row["root-error"]["max-metres"] < 1e-3 and row["root-error"]["max-degrees"] < 0.1
    assert (told["model"] is None) == drawn and ("path" in told["timings"]) != drawn
    assert told["runtime"] == told["body-runtime"] == "torch"  # neither folder holds an export
    motion = read_npz(Path(row["files"]["npz"]))
    if drawn:
        np.testing.assert_allclose(motion.root_position[-1, [0, 2]], [1, 2], atol=0.05)


def test_several_prompts_dance_side_by_side(folder: Path, tmp_path: Path) -> None:
    both = (*PROMPT, "--prompt", "somebody jumps twice", "--format", "npz")
    told = json.loads(generate(folder, *both, "--out", tmp_path, "--json").stdout)
    assert [row["prompt"] for row in told["motions"]] == [PROMPT[1], "somebody jumps twice"]


def test_a_dance_that_is_not_there_is_told(folder: Path, tmp_path: Path) -> None:
    asked = ("--prompt", "a person dances hip hop", "--prompt", "a person dances tango")
    result = generate(folder, *asked, "--format", "html", "--out", tmp_path / "a", "--json")
    told = json.loads(result.stdout)["motions"]
    assert all(w in row["warning"] for row, w in zip(told, ("hip hop", "tango"), strict=True))
    assert "breakdance" in told[0]["warning"]
    shown = generate(folder, *asked, "--format", "html", "--out", tmp_path / "b").stdout
    assert shown.splitlines() == [str(tmp_path / "b" / "index.html")]


def test_the_music_chooses_where_nobody_says_anything(folder: Path, tmp_path: Path) -> None:
    result = generate(folder, "--body", "--format", "npz", "--out", tmp_path, "--json")
    (row,) = json.loads(result.stdout)["motions"]
    assert Path(row["files"]["npz"]).name == "song-dance.npz"
    assert sum(part["seconds"] for part in row["passages"]) == pytest.approx(3.0)


def test_a_song_without_beat(
    folder: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    soundfile.write(tmp_path / "still.wav", np.zeros(44_100 * 2), 44_100)
    arguments = (*PROMPT, "--format", "html", "--out", tmp_path / "out", "--json")
    result = generate(folder, *arguments, song=tmp_path / "still.wav")
    (row,) = json.loads(result.stdout)["motions"]
    for told in (caplog.text, row["warning"]):
        assert "no beat was found" in told and "body stands" in told
    assert row["beat-alignment"] is None


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("--format", "bvh"), "--body"),
        ((*PROMPT, "--format", "dae"), "'dae'"),
        (("--prompt", " "), "--prompt"),
        (("--body", "--tag", "walk"), "--tag"),
        ((*PROMPT, "--body"), "--body lets the music say"),
        (("--judge", "x", "--num-samples", "2"), "--judge"),
        ((*PROMPT, "--seconds", "0.5"), "--seconds"),
        ((*PROMPT, "--style", "tired"), "--follow-path"),
        (("--follow-path",), "--prompt"),
        ((*PROMPT, "--follow-path", "--no-figures"), "--no-figures"),
        ((*PROMPT, "--memory", "."), "--memory"),
        (("--path", "way.csv"), "--path"),
        ((*PROMPT, "--path", "way.csv", "--follow-path"), "--path"),
        ((*PROMPT, "--loop"), "--loop"),
        ((*PROMPT, "--meter", "5"), "--meter 5"),
    ],
)
def test_wrong_usage(folder: Path, arguments: tuple[str, ...], named: str) -> None:
    models = () if "--judge" in arguments else ("--model", folder / "path")
    words = ["generate", "--audio", folder / "song.wav", *models, *arguments]
    result = runner.invoke(app, [str(word) for word in words])
    assert result.exit_code == 2 and named in result.stderr and "Traceback" not in result.stderr


def test_a_body_needs_a_song() -> None:
    for extra in (("--body",), ("--body-model", "starter"), ("--follow-path",)):
        result = runner.invoke(app, ["generate", *PROMPT, *extra])
        assert result.exit_code == 2 and extra[0] in result.stderr


def test_what_a_dance_leaves_out_is_told() -> None:
    starter = MotionGenerator.from_pretrained("starter", device="cpu", runtime="onnx")
    assert left_out(starter, "he walks, knits and dances") == "nothing is made of 'knits'"
    for heard in ("a person dances, then bows", "a person dances and picks up a coin", None):
        assert left_out(starter, heard) is None  # of one clause the whole sentence is heard
