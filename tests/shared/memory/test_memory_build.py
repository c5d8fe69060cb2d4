"""Building a memory: what is in it, that it is found again, and what is refused."""

import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import fsspec
import numpy as np
import pytest
import torch
from torch import Tensor

from src.shared.config_audio import MemoryConfig
from src.shared.data.phrases.layout import MANIFEST, body_path
from src.shared.errors import UsageError, UserError
from src.shared.io.storage import Address
from src.shared.memory import build
from src.shared.memory.build import build_memory
from src.shared.memory.folders import readable, writable
from src.shared.memory.index import MemoryIndex
from tests.files import files_of
from tests.shared.memory.tiny_memory import LinearSpace, write_dancers


@pytest.fixture(scope="module")
def pairs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_dancers(tmp_path_factory.mktemp("pairs"))


def test_phrases_of_the_training_split(pairs: Path, tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    index = build_memory(pairs, LinearSpace(), tmp_path, progress=lambda *n: told.append(n))
    assert told[-1] == (10, 10)
    assert index.songs == tuple(f"song-{n}" for n in range(5)), "the sixth song is for testing"
    assert index.dim == 16 and index.about["space"] == LinearSpace().fingerprint
    assert index.about["left_out"] == {}
    assert {phrase.split("/")[0] for phrase in index.ids} == {f"dance-{n:02d}" for n in range(10)}
    assert (index.tempo == 120).all()
    assert index.captions[0] == "a person nods 0 times"
    for number in range(len(index)):
        trajectory = index.trajectory(number)
        assert np.allclose(trajectory[0, [0, 2]], 0, atol=1e-3), "local"
        assert abs(trajectory[0, 11]) < 1e-3, "faces +Z"
        assert trajectory[0, 16] == pytest.approx(float(index.start_phase[number]), abs=1e-3)
        assert index.prior(number).shape == (4, len(trajectory))
    starts = [round(float(phase), 2) % 1 for phase in index.start_phase]
    assert starts.count(0.0) >= 10, "a whole phrase starts on a downbeat"


def test_keys_are_those_of_the_space(pairs: Path, tmp_path: Path) -> None:
    """Each key is what the space makes of the piece alone: padding in a batch does not show."""
    from src.shared.memory.build import Source

    space = LinearSpace()
    index = build_memory(pairs, space, tmp_path)
    pieces = list(Source(str(pairs), "train").pieces(MemoryConfig()))
    assert [piece.phrase.id for piece in pieces] == list(index.ids)
    for number, piece in enumerate(pieces):
        audio = space.embed_audio(torch.from_numpy(piece.audio)[None])[0]
        motion = space.embed_motion(torch.from_numpy(piece.body)[None])[0]
        assert torch.allclose(index.audio_keys[number], audio, atol=1e-5)
        assert torch.allclose(index.motion_keys[number], motion, atol=1e-5)


def test_what_a_build_left_that_was_stopped_at_its_very_end_goes(
    pairs: Path, tmp_path: Path
) -> None:
    build_memory(pairs, LinearSpace(), tmp_path)
    (tmp_path / build.PARTS / "00000000").mkdir(parents=True)
    build_memory(pairs, LinearSpace(), tmp_path)
    assert not (tmp_path / build.PARTS).exists()


def test_an_up_to_date_memory_is_only_opened(pairs: Path, tmp_path: Path) -> None:
    build_memory(pairs, LinearSpace(), tmp_path)
    keys = tmp_path / "keys.safetensors"
    before = keys.stat().st_mtime_ns
    build_memory(pairs, LinearSpace(), tmp_path)
    assert keys.stat().st_mtime_ns == before
    build_memory(pairs, LinearSpace(1), tmp_path)
    assert keys.stat().st_mtime_ns != before, "keys of one space mean nothing in another"
    assert MemoryIndex.open(tmp_path).about["space"] == LinearSpace(1).fingerprint
    longer = build_memory(pairs, LinearSpace(1), tmp_path, config=MemoryConfig(bars=3))
    assert longer.about["bars"] == 3


# ---------------------------------------------------------------- stopped

KILLED = """
import os, signal, sys
from src.shared.memory import build
from tests.shared.memory.tiny_memory import LinearSpace

class Killed(LinearSpace):
    calls = 0
    def embed_audio(self, condition, mask=None):
        Killed.calls += 1
        if Killed.calls == 4:
            os.kill(os.getpid(), signal.SIGKILL)
        return super().embed_audio(condition, mask)

build.CHUNK = 2
build.build_memory(sys.argv[1], Killed(), sys.argv[2])
"""


class Counting(LinearSpace):
    """Counts what it embeds."""

    def __init__(self) -> None:
        super().__init__()
        self.calls = 0

    def embed_audio(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
        self.calls += 1
        return super().embed_audio(condition, mask)


def test_a_killed_build_goes_on_where_it_was(
    pairs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "CHUNK", 2)
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    space = Counting()
    build_memory(pairs, space, whole)
    assert space.calls == 5, "ten phrases, two a part"
    command = [sys.executable, "-c", KILLED, str(pairs), str(stopped)]
    assert subprocess.run(command, check=False).returncode == -signal.SIGKILL
    first, *others = sorted((stopped / build.PARTS).iterdir())
    assert len(others) == 2
    (first / "keys.safetensors").write_bytes(b"damaged meanwhile")
    with pytest.raises(UserError, match="no memory"):
        MemoryIndex.open(stopped)
    told: list[tuple[int, int]] = []
    space = Counting()
    build_memory(pairs, space, stopped, progress=lambda *n: told.append(n))
    assert space.calls == 3 and told == [(4, 10), (6, 10), (8, 10), (10, 10)]
    files = sorted(path.name for path in stopped.iterdir())
    assert files == sorted(path.name for path in whole.iterdir()), "the parts are gone"
    for name in files:
        assert (stopped / name).read_bytes() == (whole / name).read_bytes(), name
    (stopped / "motions.safetensors").write_bytes(b"damaged later")
    build_memory(pairs, LinearSpace(), stopped)
    assert len(MemoryIndex.open(stopped)) == len(MemoryIndex.open(whole))


def test_processes_and_a_cluster_do_not_change_the_result(
    pairs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scheduler: str
) -> None:
    monkeypatch.setattr(build, "CHUNK", 2)
    one, two, cluster = (tmp_path / name for name in ("one", "two", "cluster"))
    build_memory(pairs, LinearSpace(), one)
    build_memory(pairs, LinearSpace(), two, workers=2)
    build_memory(pairs, LinearSpace(), cluster, scheduler=scheduler)
    assert files_of(one) == files_of(two) == files_of(cluster)


def test_parts_of_something_else_are_not_taken(
    pairs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "CHUNK", 2)

    class Stops(LinearSpace):
        def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
            if any((tmp_path / build.PARTS).glob("*/manifest.json")):
                raise KeyboardInterrupt
            return super().embed_motion(features, mask)

    with pytest.raises(KeyboardInterrupt):
        build_memory(pairs, Stops(), tmp_path)
    index = build_memory(pairs, LinearSpace(1), tmp_path)
    monkeypatch.setattr(build, "CHUNK", 64)
    other = build_memory(pairs, LinearSpace(1), tmp_path / "other")
    assert index.ids == other.ids and index.songs == other.songs
    for name in ("song", "offsets", "start_phase", "trajectories", "priors"):
        assert torch.equal(getattr(index, name), getattr(other, name)), name
    assert torch.allclose(index.audio_keys, other.audio_keys, atol=1e-5)


def test_a_folder_without_bodies_says_what_to_do(tmp_path: Path) -> None:
    write_dancers(tmp_path / "pairs", 2, bodies=False)
    with pytest.raises(UserError, match=r"have no body\.npz.*run prepare-audio again"):
        build_memory(tmp_path / "pairs", LinearSpace(), tmp_path / "memory")
    assert not (tmp_path / "memory").exists()


def test_other_folders_and_splits(pairs: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no phrases of split 'val'; there are: test, train"):
        build_memory(pairs, LinearSpace(), tmp_path, split="val")
    with pytest.raises(
        UsageError, match="is missing or holds no phrases; name a folder of `prepare-audio`"
    ):
        build_memory(tmp_path, LinearSpace(), tmp_path / "memory")
    with pytest.raises(UserError, match="long enough"):
        build_memory(pairs, LinearSpace(), tmp_path, config=MemoryConfig(min_frames=500))


def test_a_few_bad_phrases_are_left_out_and_named_many_are_an_error(tmp_path: Path) -> None:
    pairs = write_dancers(tmp_path / "pairs", 12)
    (pairs / body_path("dance-03")).write_bytes(b"not an npz")
    index = build_memory(pairs, LinearSpace(), tmp_path / "memory")
    assert list(index.about["left_out"]) == ["dance-03"]
    assert not any(phrase.startswith("dance-03") for phrase in index.ids)
    (pairs / body_path("dance-04")).write_bytes(b"")
    with pytest.raises(UserError, match="more than 5% of 22 phrases cannot be used"):
        build_memory(pairs, LinearSpace(1), tmp_path / "memory")
    assert MemoryIndex.open(tmp_path / "memory").about["space"] == LinearSpace().fingerprint


def test_the_clip_that_is_shown_names_the_phrase(tmp_path: Path) -> None:
    """A phrase joined of two clips: each piece has the caption of the one it shows most of."""
    pairs = write_dancers(tmp_path / "pairs", 2, frames=240)
    manifest = json.loads((pairs / MANIFEST).read_text())
    rates = [1.0] * 41
    for number, phrase in enumerate(manifest["phrases"]):
        main, other = ("walk", "run") if number % 2 else ("run", "walk")
        phrase["caption"] = f"a person does a {main}"
        phrase["pair"] = {
            "pieces": [
                {"clip": main, "first": 0, "last": 150, "at": 0},
                {"clip": other, "first": 0, "last": 100, "at": 140},
            ],
            "warp": {"start": 0.0, "knot_seconds": 0.2, "rates": rates},
        }
    (pairs / MANIFEST).write_text(json.dumps(manifest))
    index = build_memory(pairs, LinearSpace(), tmp_path / "memory")
    for name, clip, caption in zip(index.ids, index.clips, index.captions, strict=True):
        phrase, _, start = name.partition("/")
        main, other = ("walk", "run") if int(phrase[-2:]) % 2 else ("run", "walk")
        assert clip == (main if int(start) < 90 else other), name
        assert caption == f"a person does a {clip}"


def test_each_clip_of_a_phrase_has_a_caption_of_its_own(tmp_path: Path) -> None:
    """Where the data tells of every clip: "run" is nowhere shown longest."""
    pairs = write_dancers(tmp_path / "pairs", 2, frames=240)
    manifest = json.loads((pairs / MANIFEST).read_text())
    for phrase in manifest["phrases"]:
        phrase["pair"] = {
            "pieces": [
                {"clip": "walk", "first": 0, "last": 150, "at": 0},
                {"clip": "run", "first": 0, "last": 100, "at": 140},
            ],
            "warp": {"start": 0.0, "knot_seconds": 0.2, "rates": [1.0] * 41},
        }
    (pairs / MANIFEST).write_text(json.dumps(manifest))
    before = build_memory(pairs, LinearSpace(), tmp_path / "memory")
    assert {c for n, c in zip(before.clips, before.captions, strict=True) if n == "run"} == {""}
    for phrase in manifest["phrases"]:
        phrase["pair"]["captions"] = {"walk": "she strolls", "run": "she hurries"}
    (pairs / MANIFEST).write_text(json.dumps(manifest))
    index = build_memory(pairs, LinearSpace(), tmp_path / "memory")
    told = set(zip(index.clips, index.captions, strict=True))
    assert told == {("walk", "she strolls"), ("run", "she hurries")}


def test_a_bucket_will_do(pairs: Path, tmp_path: Path) -> None:
    files = fsspec.filesystem("memory")
    for file in pairs.rglob("*"):
        if file.is_file():
            files.pipe_file(f"/dancers/{file.relative_to(pairs)}", file.read_bytes())
    here, there = (
        build_memory(root, LinearSpace(), tmp_path / name)
        for name, root in (("here", str(pairs)), ("there", "memory://dancers"))
    )
    assert here.ids == there.ids and torch.equal(here.audio_keys, there.audio_keys)


# ---------------------------------------------------------------- at an address


@pytest.fixture
def address(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Address:
    """Nothing there yet, and nothing in the cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return Address(f"memory://{tmp_path.name}/memory")


def stored(address: Address) -> dict[str, bytes]:
    return {name: (address / name).read_bytes() for name in address.find()}


def test_an_address_holds_what_a_folder_does(
    pairs: Path, tmp_path: Path, address: Address, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Up to date, on this machine or another one, nothing is done; what is asked is a copy."""
    pytest.importorskip("faiss")
    config = MemoryConfig(library_above=0)
    build_memory(pairs, LinearSpace(), tmp_path / "memory", config=config)
    index = build_memory(pairs, LinearSpace(), address, config=config)
    assert stored(address) == files_of(tmp_path / "memory") == files_of(readable(address))
    before = address.find()
    for machine in ("cache", "other"):
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / machine))
        space = Counting()
        build_memory(pairs, space, address, config=config)
        assert space.calls == 0 and address.find() == before, "neither made nor put there again"
    keys = readable(address) / "keys.safetensors"
    keys.write_bytes(b"damaged")
    assert torch.equal(MemoryIndex.open(str(address)).audio_keys, index.audio_keys), "healed"
    build_memory(pairs, LinearSpace(1), address, config=config)
    assert address.find()["phrases.json"] == before["phrases.json"], "the same, left as it is"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert MemoryIndex.open(address).about["space"] == LinearSpace(1).fingerprint


def test_a_stopped_build_at_an_address_goes_on(
    pairs: Path, tmp_path: Path, address: Address, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "CHUNK", 2)

    class Stops(Counting):
        def embed_audio(self, condition: Tensor, mask: Tensor | None = None) -> Tensor:
            if self.calls == 3:
                raise KeyboardInterrupt
            return super().embed_audio(condition, mask)

    with pytest.raises(KeyboardInterrupt):
        build_memory(pairs, Stops(), address)
    assert not address.exists()
    space = Counting()
    build_memory(pairs, space, address)
    build_memory(pairs, LinearSpace(), tmp_path / "memory")
    assert space.calls == 2 and stored(address) == files_of(tmp_path / "memory")
    with writable(address), pytest.raises(UserError, match="another process is writing"):
        build_memory(pairs, LinearSpace(), address)


def test_the_parts_of_a_cluster_lie_at_the_address(
    pairs: Path, tmp_path: Path, address: Address, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where every worker sees them; here this process is all of them."""
    monkeypatch.setattr(build, "CHUNK", 2)
    build_memory(pairs, LinearSpace(), tmp_path / "memory")

    def worked(function: Any, jobs: Any, workers: Any, scheduler: Any) -> Any:
        yield from ((job, function(job)) for job in jobs)
        assert len(address.find()) == 5 * 4

    monkeypatch.setattr(build, "run_jobs", worked)
    build_memory(pairs, LinearSpace(), address, scheduler="tcp://far:8786")
    assert stored(address) == files_of(tmp_path / "memory") == files_of(readable(address))


def test_what_an_address_lacks_is_told(pairs: Path, tmp_path: Path, address: Address) -> None:
    with pytest.raises(UserError, match=r"is no memory: .* `memory build`"):
        MemoryIndex.open(address)
    assert not files_of(tmp_path / "cache")
    build_memory(pairs, LinearSpace(), tmp_path / "memory")
    for name, data in files_of(tmp_path / "memory").items():
        (address / name).write_bytes(data)
    (address / "keys.safetensors").unlink()
    with pytest.raises(UserError, match=r"keys\.safetensors is missing, or not"):
        MemoryIndex.open(address)
    manifest = json.loads((address / "manifest.json").read_bytes())
    escaping = manifest | {"files": {"../../escaped": {"sha256": "", "bytes": 0}}}
    (address / "manifest.json").write_bytes(json.dumps(escaping).encode())
    with pytest.raises(UserError, match="leads out of"):
        MemoryIndex.open(address)
    (address / "manifest.json").write_bytes(json.dumps(manifest | {"files": []}).encode())
    with pytest.raises(UserError, match="is damaged"):
        MemoryIndex.open(address)
    build_memory(pairs, LinearSpace(), address)
    assert stored(address) == files_of(tmp_path / "memory"), "mended"
