"""Files that replace others whole: who may read them afterwards, and what a failure leaves."""

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.torch import save_file

from src.shared.errors import UserError
from src.shared.io.files import atomic_write, inside, same_place, write_json
from tests.full_disk import full_disk


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


def write_table(path: Path) -> None:
    faiss = pytest.importorskip("faiss")
    table = faiss.IndexFlatL2(10)
    table.add(np.zeros((1000, 10), np.float32))
    faiss.write_index(table, str(path))


@pytest.mark.parametrize(
    "write",
    [
        lambda path: save_file({"values": torch.zeros(1000)}, path),
        lambda path: np.savez(path.open("wb"), values=np.zeros(1000)),
        lambda path: path.write_bytes(bytes(5000)),
        write_table,
    ],
    ids=["safetensors", "numpy", "bytes", "faiss"],
)
def test_a_full_disk_is_one_line_and_leaves_nothing(
    tmp_path: Path, write: Callable[[Path], None]
) -> None:
    """Whatever error the library has for it."""
    with full_disk(), pytest.raises(UserError) as caught, atomic_write(tmp_path / "a") as temporary:
        write(temporary)
    start, _, reason = str(caught.value).partition(": ")
    assert start == f"cannot write {tmp_path / 'a'}"
    assert reason.endswith("; free space or choose another folder") and len(reason) < 100
    assert not list(tmp_path.iterdir())


def test_an_error_inside_keeps_its_own_words(tmp_path: Path) -> None:
    with (
        full_disk(),
        pytest.raises(UserError, match=r"^cannot write .*inner: "),
        atomic_write(tmp_path / "outer"),
    ):
        write_json(tmp_path / "inner", "x" * 5000)


def test_a_loop_of_links_is_its_own_place(tmp_path: Path) -> None:
    loop, link = tmp_path / "loop", tmp_path / "link"
    try:
        loop.symlink_to(loop)
        link.symlink_to(tmp_path)
    except OSError:
        pytest.skip("no links here")
    assert same_place(loop, loop) and not same_place(loop, tmp_path)
    assert same_place(link, tmp_path)
    assert inside(tmp_path, "loop") == loop


@pytest.mark.parametrize("name", [".", "", "sub", "../other", "/etc"])
def test_a_name_in_a_manifest_is_that_of_a_file_inside(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder" / "sub").mkdir(parents=True)
    with pytest.raises(UserError, match="anew"):
        inside(tmp_path / "folder", name)
    assert inside(tmp_path / "folder", "sub/new.json").parent.is_dir()
