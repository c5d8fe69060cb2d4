"""One process at a time writes a folder; what a killed one left is cleared by the next."""

from pathlib import Path
from threading import Timer

import pytest

from src.shared.errors import UserError
from src.shared.io.files import sole_writer
from tests.shared.holder import held


def test_a_second_process_is_refused_until_the_first_is_gone(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    with held(folder):
        with pytest.raises(UserError, match="another process is writing"), sole_writer(folder):
            raise AssertionError
        assert [path.name for path in folder.iterdir()] == [".lock"], "the other's"
    with sole_writer(folder):
        (folder / "report").touch()
    assert [path.name for path in folder.iterdir()] == ["report"]


def test_a_shared_folder_is_waited_for(tmp_path: Path) -> None:
    with held(tmp_path) as other:
        Timer(0.3, other.kill).start()
        with sole_writer(tmp_path, wait=True):
            assert other.wait(10) < 0


def test_what_a_killed_run_left_half_written_is_cleared(tmp_path: Path) -> None:
    """Names as `atomic_write`, `save_checkpoint`, `write_usd` and safetensors give them."""
    (tmp_path / ".lock").touch()
    (tmp_path / "checkpoints/.step-00000002.4711.part").mkdir(parents=True)
    (tmp_path / "checkpoints/.step-00000002.4711.part/model.safetensors").touch()
    (tmp_path / ".report.json.4711.part").touch()
    (tmp_path / ".tmpaB3xYz").touch()
    (tmp_path / "checkpoints/step-00000001").mkdir()
    (tmp_path / "notes.part").touch()
    with sole_writer(tmp_path):
        left = sorted(path.name for path in tmp_path.rglob("*"))
    assert left == [".lock", "checkpoints", "notes.part", "step-00000001"]


def test_files_of_others_stay(tmp_path: Path) -> None:
    """Names that look alike, another run inside, and all where nobody was killed."""
    (tmp_path / "run").mkdir()
    theirs = [".download.part", ".tmpABC123/mine.txt", ".notes.v2.part", "run/.lock"]
    alike = [".report.json.4711.part", "run/.model.4711.part", ".tmpaB3xYz"]
    for name in theirs + alike:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    with sole_writer(tmp_path):
        assert all((tmp_path / name).exists() for name in theirs + alike)
    (tmp_path / ".lock").touch()
    with sole_writer(tmp_path):
        assert all((tmp_path / name).exists() for name in [*theirs, alike[1]])
        assert not any((tmp_path / name).exists() for name in (alike[0], alike[2]))


def test_a_folder_that_stays_empty_is_not_left(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="wrong"), sole_writer(tmp_path / "new" / "run"):
        raise UserError("wrong")
    assert not list(tmp_path.iterdir())


def test_a_file_in_the_way_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(UserError, match=r"cannot write .*; name"), sole_writer(tmp_path / "file"):
        raise AssertionError
