"""A real GCS emulator process behind a proxy that fails: what an epoch must survive."""

import hashlib
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.data.phrases.layout import features_path, trajectory_path
from tests.shared.data.phrases.gcs_proxy import (  # before gcsfs: sets its switch
    BUCKET,
    FaultProxy,
    emulator,
    options,
)
from tests.shared.data.phrases.phrase_samples import flip_bit, plain_encode, store_phrases

pytest.importorskip("gcp_storage_emulator")
gcsfs = pytest.importorskip("gcsfs")

ROOT = f"gs://{BUCKET}/phrases"


@pytest.fixture
def proxy(tmp_path: Path) -> Iterator[FaultProxy]:
    with emulator(tmp_path / "emulator.log") as address, FaultProxy(address) as proxy:
        yield proxy


def upload(folder: Path, proxy: FaultProxy) -> Any:
    fs = gcsfs.GCSFileSystem(**options(proxy.address))
    files = [path for path in folder.rglob("*") if path.is_file()]
    fs.pipe({f"{BUCKET}/phrases/{f.relative_to(folder)}": f.read_bytes() for f in files})
    return fs


def test_a_bucket_with_each_kind_of_fault(proxy: FaultProxy, tmp_path: Path) -> None:
    store_phrases(tmp_path / "data", [60] * 8)
    fs = upload(tmp_path / "data", proxy)
    busy, flipped, short, over = (trajectory_path(f"p00{n}") for n in (0, 1, 2, 3))
    gone = features_path("p004")
    proxy.busy[f"phrases/{busy}"] = 1
    proxy.cut[f"phrases/{features_path('p005')}"] = 1
    proxy.damage = {f"phrases/{flipped}": flip_bit, f"phrases/{short}": lambda data: data[:-9]}
    fs.pipe(f"{BUCKET}/phrases/{over}", (tmp_path / "data" / busy).read_bytes())
    fs.rm(f"{BUCKET}/phrases/{gone}")

    def epoch() -> tuple[list[str], dict[str, Any]]:
        data = MotionPhraseDataset(
            ROOT,
            cache_dir=tmp_path / "cache",
            encode=plain_encode,
            storage_options=options(proxy.address),
            max_bad_fraction=0.5,
        )
        return sorted(item.record.id for item in data.epoch()), data.report()

    good, report = epoch()
    assert good == ["p000", "p005", "p006", "p007"]
    reasons = [report["bad"][f"p00{n}"] for n in (1, 2, 3, 4)]
    words = ["damaged on the way", "truncated", "overwritten", "is missing"]
    assert all(word in reason for word, reason in zip(words, reasons, strict=True)), reasons
    before = proxy.asked.copy()
    assert epoch()[0] == good
    assert proxy.asked - before == {"phrases/manifest.json": 1}


def test_a_bucket_without_a_manifest(proxy: FaultProxy, tmp_path: Path) -> None:
    store_phrases(tmp_path / "data", [60] * 4, manifest=False)
    upload(tmp_path / "data", proxy)
    proxy.damage = {f"phrases/{trajectory_path('p001')}": flip_bit}  # the listing has MD5s
    for _ in range(2):
        data = MotionPhraseDataset(
            ROOT,
            cache_dir=tmp_path / "cache",
            encode=plain_encode,
            storage_options=options(proxy.address),
            max_bad_fraction=0.5,
        )
        assert sorted(item.record.id for item in data.epoch()) == ["p000", "p002", "p003"]
    proxy.delivered.pop(f"phrases/{trajectory_path('p001')}")
    assert set(proxy.delivered.values()) == {1}


def spoil(folder: Path, proxy: FaultProxy, fs: Any) -> tuple[set[str], set[str]]:
    """Ten bad objects of five kinds and 25 that are busy once; bad phrases and their objects."""
    bad = [f"p{number:03d}" for number in range(7, 250, 25)]
    paths = [trajectory_path(p) if n % 2 else features_path(p) for n, p in enumerate(bad)]
    for path in paths[0:2]:
        proxy.damage[f"phrases/{path}"] = lambda data: data[: len(data) // 2]
    for path in paths[2:5]:
        proxy.damage[f"phrases/{path}"] = flip_bit
    for path in paths[5:8]:
        fs.pipe(
            f"{BUCKET}/phrases/{path}",
            (folder / path.replace(path.split("/")[1], "p000")).read_bytes(),
        )
    fs.rm(f"{BUCKET}/phrases/{paths[8]}")
    fs.pipe(f"{BUCKET}/phrases/{paths[9]}", b"")
    for number in range(3, 250, 10):
        proxy.busy[f"phrases/{trajectory_path(f'p{number:03d}')}"] = 1
    return set(bad), {f"phrases/{path}" for path in paths}


@pytest.mark.slow
def test_an_epoch_survives_faults_and_a_killed_process(proxy: FaultProxy, tmp_path: Path) -> None:
    """500 objects, 2% bad, 5% of them 503 at first, SIGKILL in the middle."""
    folder, cache, ledger = tmp_path / "data", tmp_path / "cache", tmp_path / "ledger.json"
    store_phrases(folder, [60] * 250)
    fs = upload(folder, proxy)
    bad, bad_objects = spoil(folder, proxy, fs)
    good = {f"p{number:03d}" for number in range(250)} - bad
    script = Path(__file__).with_name("epoch_process.py")
    command = [sys.executable, str(script), proxy.address, str(cache), str(ledger)]

    proxy.delay = 0.02  # so that some are under way when the process dies
    process = subprocess.Popen(command)
    while proxy.delivered.total() < 230 or not ledger.exists():
        assert process.poll() is None
        time.sleep(0.01)
    process.kill()
    process.wait()
    half = json.loads(ledger.read_text())["seen"]
    assert 0 < len(half) < 150
    kept = {path.name for path in cache.glob("objects/*/*")}
    time.sleep(0.5)  # answers to the dead process
    before = proxy.delivered.copy()

    subprocess.run(command, check=True, timeout=300)
    done = json.loads(ledger.read_text())
    assert done["seen"][: len(half)] == half
    assert sorted(done["seen"]) == sorted(good)
    assert set(done["report"]["bad"]) == bad

    objects = {
        f"phrases/{path}": hashlib.sha256((folder / path).read_bytes()).hexdigest()
        for number in range(250)
        for path in (trajectory_path(f"p{number:03d}"), features_path(f"p{number:03d}"))
    }
    again = proxy.delivered - before
    for name in objects:
        if name.split("/")[2] in good:
            assert again[name] == (objects[name] not in kept), name
    allowed = {name: 2 if name in bad_objects else 1 for name in objects}  # one second chance
    excess = {name: proxy.delivered[name] - allowed[name] for name in objects}
    lost = [name for name, count in excess.items() if count > 0]
    assert len(lost) <= 8 and max(excess.values()) <= 1  # in flight when the process died
    print(f"{proxy.asked.total()} downloads asked for, {len(kept)} kept at the kill, lost: {lost}")
