"""Retries, verification, cache and quarantine on a file system that fails on demand."""

import multiprocessing
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import torch

from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.data.phrases.layout import StoredObject, features_path, trajectory_path
from src.shared.data.phrases.store import ObjectCache, Remote
from src.shared.errors import UserError
from src.shared.io.storage import Backoff, Unreachable
from tests.shared.data.phrases.phrase_samples import (
    FlakyFileSystem,
    flip_bit,
    no_wait,
    plain_encode,
    store_phrases,
)

LENGTHS = [130, 140, 125, 121, 160, 131]
ROOT = "flaky://bucket/phrases"


@pytest.fixture
def bucket(tmp_path: Path) -> Iterator[FlakyFileSystem]:
    store_phrases(tmp_path / "data", LENGTHS)
    fs = FlakyFileSystem()
    fs.upload(tmp_path / "data", "/bucket/phrases")
    yield fs
    for state in (fs.store, fs.faults, fs.reads):
        state.clear()


def open_bucket(cache: Path, **settings: Any) -> MotionPhraseDataset:
    settings = {
        "encode": plain_encode,
        "max_bad_fraction": 0.5,
        "backoff": no_wait(),
        "threads": 3,
    } | settings
    return MotionPhraseDataset(ROOT, cache_dir=cache, **settings)


def good_ids(data: MotionPhraseDataset) -> list[str]:
    return sorted(item.record.id for item in data.epoch())


def reads(fs: FlakyFileSystem, path: str) -> int:
    return fs.reads[f"/bucket/phrases/{path}"]


def fail(fs: FlakyFileSystem, path: str, *faults: Any) -> None:
    fs.faults[f"/bucket/phrases/{path}"] = list(faults)


@pytest.mark.parametrize("manifest", [True, False])
def test_nothing_is_downloaded_twice(
    bucket: FlakyFileSystem, tmp_path: Path, manifest: bool
) -> None:
    if not manifest:
        bucket.rm("/bucket/phrases/manifest.json")
    for _ in range(2):
        data = open_bucket(tmp_path / "cache", cache_in_memory=False)
        for epoch in range(2):
            assert len(list(data.epoch(epoch))) == len(LENGTHS)
    objects = [count for path, count in bucket.reads.items() if "manifest" not in path]
    assert objects == [1] * 2 * len(LENGTHS)
    assert data.report()["hits"] == 4 * len(LENGTHS) and "downloads" not in data.report()


def test_a_new_version_without_a_manifest_is_fetched(
    bucket: FlakyFileSystem, tmp_path: Path
) -> None:
    bucket.rm("/bucket/phrases/manifest.json")
    assert len(good_ids(open_bucket(tmp_path / "cache"))) == 6
    store_phrases(tmp_path / "new", [150])
    bucket.upload(tmp_path / "new", "/bucket/phrases")
    bucket.rm("/bucket/phrases/manifest.json")
    data = open_bucket(tmp_path / "cache", target_frames=150)
    item = data.item(0, 0)
    assert item is not None and item.mask.all()


def test_transient_errors_are_waited_out(bucket: FlakyFileSystem, tmp_path: Path) -> None:
    waits: list[float] = []
    path = trajectory_path("p003")
    fail(bucket, path, TimeoutError(), ConnectionResetError(), OSError("503 Service Unavailable"))
    data = open_bucket(tmp_path / "cache", backoff=Backoff(sleep=waits.append))
    assert len(good_ids(data)) == 6 and reads(bucket, path) == 4
    assert len(waits) == 3
    assert all(0.125 * 2**n <= wait <= 0.25 * 2**n for n, wait in enumerate(waits))


def test_an_outage_is_no_fault_of_the_object(bucket: FlakyFileSystem, tmp_path: Path) -> None:
    fail(bucket, trajectory_path("p003"), *[TimeoutError()] * 4)
    data = open_bucket(tmp_path / "cache", backoff=no_wait(attempts=4))
    assert "p003" not in good_ids(data)
    assert "4 attempts" in data.report()["bad"]["p003"]
    assert "p003" in good_ids(open_bucket(tmp_path / "cache"))


def test_content_gets_one_second_chance(bucket: FlakyFileSystem, tmp_path: Path) -> None:
    once, twice, short = (trajectory_path(f"p00{n}") for n in (0, 1, 2))
    fail(bucket, once, flip_bit)
    fail(bucket, twice, flip_bit, flip_bit, flip_bit)
    fail(bucket, short, *[lambda data: data[:-100]] * 3)
    bucket.rm(f"/bucket/phrases/{features_path('p004')}")
    bucket.pipe_file(f"/bucket/phrases/{trajectory_path('p005')}", b"something else")
    data = open_bucket(tmp_path / "cache", max_bad_fraction=0.7)
    assert good_ids(data) == ["p000", "p003"]
    assert [reads(bucket, path) for path in (once, twice, short)] == [2, 2, 2]
    bad = data.report()["bad"]
    assert "overwritten or damaged" in bad["p001"]  # a store without checksums cannot tell
    assert "truncated: " in bad["p002"] and "of " in bad["p002"]
    assert "missing" in bad["p004"]
    assert "overwritten: 14 bytes that the manifest does not describe" in bad["p005"]
    before = dict(bucket.reads)
    assert good_ids(open_bucket(tmp_path / "cache", max_bad_fraction=0.7)) == ["p000", "p003"]
    assert reads(bucket, "manifest.json") == 2
    assert {k: v for k, v in bucket.reads.items() if "manifest" not in k} == {
        k: v for k, v in before.items() if "manifest" not in k
    }


def test_damage_in_the_cache_is_seen_and_mended(bucket: FlakyFileSystem, tmp_path: Path) -> None:
    good_ids(open_bucket(tmp_path / "cache"))
    files = sorted((tmp_path / "cache").glob("objects/*/*"))
    assert len(files) == 12 and all(file.parent.name == file.name[:2] for file in files)
    files[3].write_bytes(flip_bit(files[3].read_bytes()))
    files[7].write_bytes(b"")
    data = open_bucket(tmp_path / "cache")
    assert len(good_ids(data)) == 6
    assert data.report()["downloads"] == 2


def test_the_least_recently_used_goes_first(tmp_path: Path) -> None:
    cache = ObjectCache(tmp_path, max_bytes=10_000)
    objects = [StoredObject(path=f"{n}", size=1000) for n in range(14)]
    for number, obj in enumerate(objects):
        cache.put(obj, bytes([number]) * 1000)
        for file in tmp_path.glob("objects/*/*"):
            os.utime(file, (stamp := file.stat().st_mtime - 10, stamp))
        assert cache.get(objects[0]) is not None  # always in use
    kept = [number for number, obj in enumerate(objects) if cache.get(obj) is not None]
    assert kept[0] == 0 and len(kept) <= 10 and kept[1:] == list(range(15 - len(kept), 14))


def test_what_a_killed_process_left_is_swept(tmp_path: Path) -> None:
    folder = tmp_path / "objects" / "ab"
    folder.mkdir(parents=True)
    old, new = folder / ".abc.1.part", folder / ".abd.2.part"
    old.touch()
    new.touch()
    os.utime(old, (time.time() - 7200,) * 2)
    ObjectCache(tmp_path)
    assert not old.exists() and new.exists()


def test_a_full_disk_is_an_error_of_the_cache(tmp_path: Path) -> None:
    (tmp_path / "objects").write_text("in the way")
    with pytest.raises(UserError, match="cannot write"):
        ObjectCache(tmp_path).put(StoredObject(path="a", size=1), b"a")


def _fetch(data: Path, cache: Path, log: Path, barrier: Any) -> None:
    dataset = MotionPhraseDataset(data, cache_dir=cache, encode=plain_encode, threads=4)
    dataset.store.cache = ObjectCache(cache)  # as if the folder were far away
    read = dataset.store.remote.read

    def logged(path: str) -> bytes:
        with log.open("a") as stream:
            stream.write(path + "\n")
        time.sleep(0.02)
        return read(path)

    dataset.store.remote.read = logged  # type: ignore[method-assign]
    torch.set_num_threads(1)  # as workers of a DataLoader begin: alone, as a pool is renewed here
    barrier.wait()
    assert len(list(dataset.epoch())) == len(LENGTHS)


def test_processes_share_one_download(tmp_path: Path) -> None:
    store_phrases(tmp_path / "data", LENGTHS)
    context = multiprocessing.get_context("fork")
    barrier = context.Barrier(3)
    log = tmp_path / "log"
    workers = [
        context.Process(target=_fetch, args=(tmp_path / "data", tmp_path / "cache", log, barrier))
        for _ in range(3)
    ]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(60)
        assert worker.exitcode == 0
    assert sorted(log.read_text().split()) == sorted(
        path for n in range(6) for path in (trajectory_path(f"p00{n}"), features_path(f"p00{n}"))
    )


class _Status(Exception):
    def __init__(self, code: int | str) -> None:
        self.code = code


_Status.__module__ = "gcsfs.retry"


@pytest.mark.parametrize(
    ("error", "attempts"),
    [
        (TimeoutError(), 4),
        (BrokenPipeError(), 4),
        (OSError(5, "Input/output error"), 4),
        (_Status(503), 4),
        (_Status("429"), 4),
        (_Status(400), 1),
        (PermissionError(), 1),
        (OSError("Forbidden: gs://x"), 1),
    ],
)
def test_what_is_tried_again(bucket: FlakyFileSystem, error: Exception, attempts: int) -> None:
    fail(bucket, "manifest.json", *[error] * 9)
    with pytest.raises(Unreachable, match=rf"manifest.json: .* \({attempts} attempts\)"):
        Remote(ROOT, backoff=no_wait(attempts=4)).read("manifest.json")


def test_mistakes_and_missing_objects_pass_through(bucket: FlakyFileSystem) -> None:
    fail(bucket, "manifest.json", KeyError("a mistake of ours"))
    with pytest.raises(KeyError):
        Remote(ROOT, backoff=no_wait()).read("manifest.json")
    with pytest.raises(FileNotFoundError):
        Remote(ROOT, backoff=no_wait()).read("nothing.json")


def test_patience_ends(bucket: FlakyFileSystem) -> None:
    fail(bucket, "manifest.json", *[TimeoutError()] * 9)
    with pytest.raises(Unreachable, match="1 attempts"):
        Remote(ROOT, backoff=no_wait(patience=-1.0)).read("manifest.json")
    with pytest.raises(UserError, match="check the address"):
        MotionPhraseDataset(ROOT, backoff=no_wait(attempts=2))


def test_a_missing_package_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "s3fs", None)
    with pytest.raises(UserError, match="install s3fs"):
        MotionPhraseDataset("s3://bucket/x")
