"""Files that replace others whole: who may read them afterwards, and what a failure leaves."""

import os
from pathlib import Path

import pytest

from src.shared.errors import UserError
from src.shared.files import atomic_write, inside


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_a_new_file_is_readable_as_any_other(tmp_path: Path) -> None:
    """Some writers make files for their owner alone (safetensors); a shared folder needs more."""
    mask = os.umask(0o022)
    try:
        with atomic_write(tmp_path / "new") as temporary:
            temporary.touch(mode=0o600)
    finally:
        os.umask(mask)
    assert (tmp_path / "new").stat().st_mode & 0o777 == 0o644


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_a_file_that_is_replaced_keeps_its_permissions(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("old")
    (tmp_path / "secret").chmod(0o600)
    with atomic_write(tmp_path / "secret") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "secret").stat().st_mode & 0o777 == 0o600
    assert (tmp_path / "secret").read_text() == "new"


def test_a_name_that_is_too_long_is_to_be_shortened(tmp_path: Path) -> None:
    with (
        pytest.raises(UserError, match="File name too long; shorten its name"),
        atomic_write(tmp_path / f"{'a' * 300}.npz"),
    ):
        pass


def test_a_failure_leaves_what_was_there(tmp_path: Path) -> None:
    (tmp_path / "kept").write_text("old")
    with pytest.raises(RuntimeError), atomic_write(tmp_path / "kept") as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert (tmp_path / "kept").read_text() == "old"


@pytest.mark.parametrize("name", [".", "", "sub", "../other", "/etc"])
def test_a_name_in_a_manifest_is_that_of_a_file_inside(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder" / "sub").mkdir(parents=True)
    with pytest.raises(UserError, match="anew"):
        inside(tmp_path / "folder", name)
    assert inside(tmp_path / "folder", "sub/new.json").parent.is_dir()
