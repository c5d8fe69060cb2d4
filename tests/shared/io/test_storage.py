"""Addresses: what becomes one, that it does what a path does, and how its faults are told."""

import json
from pathlib import Path

import pytest

from src.shared.errors import UsageError, UserError
from src.shared.io.files import atomic_write, is_whole, load_json, sha256_file, write_json
from src.shared.io.storage import Address, fetched, place


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("data/mine", Path("data/mine")),
        ("C:/data", Path("C:/data")),
        ("file:///data/mine", Path("/data/mine")),
        ("gs://bucket/data/", Address("gs://bucket/data")),
        (Path("gs://bucket/data"), Address("gs://bucket/data")),
        (Address("s3://bucket"), Address("s3://bucket")),
    ],
)
def test_what_is_an_address(name: str | Path | Address, found: Path | Address) -> None:
    assert place(name) == found


def test_an_address_is_named_as_a_path_is() -> None:
    address = place("memory://root/takes/walk.amass.npz")
    path = Path("/root/takes/walk.amass.npz")
    assert (address.name, address.stem, address.suffix) == (path.name, path.stem, path.suffix)
    assert str(address.with_suffix(".json")) == "memory://root/takes/walk.amass.json"
    assert str(address.parent / "run.bvh") == "memory://root/takes/run.bvh"


def test_objects_come_and_go() -> None:
    folder = place("memory://come-and-go")
    assert not folder.exists() and not (folder / "a.json").is_file()
    write_json(folder / "a.json", {"a": 1})
    with atomic_write(folder / "deep" / "b.bin") as temporary:
        temporary.write_bytes(b"content")
    assert folder.is_dir() and (folder / "a.json").is_file()
    assert load_json(folder / "a.json") == {"a": 1}
    assert sorted(map(str, folder.iterdir())) == [
        "memory://come-and-go/a.json", "memory://come-and-go/deep/b.bin",
    ]  # fmt: skip
    digest = sha256_file(folder / "deep" / "b.bin")
    assert is_whole(folder / "deep" / "b.bin", digest) and not is_whole(folder / "none", digest)
    with fetched(folder / "deep" / "b.bin") as local:
        assert local.name == "b.bin" and local.read_bytes() == b"content"
    assert not local.exists()
    (folder / "a.json").unlink()
    (folder / "a.json").unlink(missing_ok=True)
    with pytest.raises(FileNotFoundError):
        (folder / "a.json").unlink()


def test_a_failed_block_puts_nothing() -> None:
    address = place("memory://failed/a.json")
    with pytest.raises(ValueError), atomic_write(address) as temporary:
        temporary.write_text(json.dumps(1))
        raise ValueError
    assert not address.exists()


def test_a_skeleton_comes_along() -> None:
    folder = place("memory://acclaim")
    for name in ("07/07_01.amc", "07/07.asf", "08/08.asf"):
        (folder / name).write_bytes(name.encode())
    with fetched(folder / "07" / "07_01.amc") as local:
        assert sorted(path.name for path in local.parent.iterdir()) == ["07.asf", "07_01.amc"]


def test_faults_are_one_line(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="give a folder, gs:// or s3://"):
        place("nonsense://a").exists()
    with pytest.raises(UserError, match=r"webhdfs|install"):
        place("oci://bucket/a").exists()
