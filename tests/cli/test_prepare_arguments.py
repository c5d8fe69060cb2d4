"""Arguments of `prepare` that do not fit together."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from src.cli.prepare import print_summary
from src.cli.tools import app
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.formats.writers.bvh import write_bvh
from src.shared.io.storage import place


@pytest.mark.parametrize("flag", ["--captions", "--mapping", "--labels"])
def test_a_table_without_source_is_refused(flag: str, tmp_path: Path) -> None:
    command = ["prepare", "--synthetic", "2", flag, "x.csv", "--out", str(tmp_path / "out")]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 2 and f"{flag} without SOURCE" in result.output


def test_what_is_read_is_not_written_into(tmp_path: Path) -> None:
    (tmp_path / "walk.bvh").write_text("HIERARCHY")
    result = CliRunner().invoke(app, ["prepare", str(tmp_path), "--out", f"{tmp_path}/."])
    assert result.exit_code == 2 and "is a SOURCE" in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["walk.bvh"]


def test_addresses_are_read_and_written(tmp_path: Path) -> None:
    clip = write_bvh(generate_clip(sample_specs(1, seed=1)[0], seed=0), tmp_path / "walk.bvh")
    source = place("memory://mocap/takes")
    (source / "a person walks.bvh").write_bytes(clip.read_bytes())
    command = ["prepare", str(source), "--out", "memory://prepared", "--workers", "1"]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 0, result.output
    assert "next: motion-tools train clip --data memory://prepared" in result.stdout
    assert (place("memory://prepared") / "manifest.json").is_file()


@pytest.mark.parametrize(
    ("actions", "taught"),
    [(["kata"], True), (["kata", "ukemi"], True), (["kata", "walk"], True), (["walk"], False),
     (["", "kata"], False)],
)  # fmt: skip
def test_clips_of_new_actions_may_be_taught_to_what_ships(
    actions: list[str], taught: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    report = {"clips": 2, "seconds": 60.0, "groups": 1, "by_source": {}, "by_split": {}}
    print_summary(report | {"skipped": [], "actions": actions}, Path("data/kata"))
    told = capsys.readouterr().out
    assert "next: motion-tools train clip --data data/kata" in told
    assert ("train action --data data/kata --init starter" in told) is taught


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (["memory://nothing", "--out", "memory://prepared"], 2, "does not exist"),
        (["memory://nothing", "--out", "memory://x", "--scheduler", "here"], 2, "is no address"),
        (["memory://mocap", "--out", "memory://mocap/"], 2, "is a SOURCE"),
        (["--synthetic", "2", "--out", "nonsense://x"], 2, "give a folder, gs:// or s3://"),
    ],
)
def test_addresses_that_do_not_serve(arguments: list[str], code: int, told: str) -> None:
    result = CliRunner().invoke(app, ["prepare", *arguments])
    assert (result.exit_code, told in result.stderr) == (code, True), result.output
