"""Shards read as they are needed: every clip once an epoch, in any number of parts."""

from itertools import islice
from pathlib import Path

import pytest
import torch

from src.shared.data import prepare as preparation
from src.shared.data import streamed
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import SyntheticSource
from src.shared.data.streamed import AHEAD, MIXED, StreamedData, StreamedSet
from src.shared.errors import UserError
from src.shared.io.storage import Address


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A prepared folder of 30 shards of four clips and their mirror images."""
    out = tmp_path_factory.mktemp("streamed") / "data"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(preparation, "CLIPS_PER_SHARD", 4)
        preparation.prepare([SyntheticSource(120)], out, workers=1)
    return out


@pytest.fixture
def data(folder: Path) -> StreamedSet:
    return StreamedSet(StreamedData(folder), seed=3)


def ids(data: StreamedSet, start: int, stop: int) -> list[str]:
    return [data.at(place).id for place in range(start, stop)]


def test_every_clip_once_an_epoch_in_bounded_memory(folder: Path, data: StreamedSet) -> None:
    wanted = [r.id for r in PreparedData(folder).records("train") if data._is_usable(r)]
    first, second = ids(data, 0, len(data)), ids(data, len(data), 2 * len(data))
    assert sorted(first) == sorted(second) == sorted(wanted)
    assert first != second
    assert len(data._loaded) <= MIXED + AHEAD < len(data.data.shards)


def test_a_batch_of_several_shards_reads_each_once(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data, read = StreamedSet(StreamedData(folder), seed=3), list[str]()
    of = data._read
    monkeypatch.setattr(data, "_read", lambda shard: read.append(shard.name) or of(shard))
    size = 4 * len(data) // len(data.data.shards)  # four shards' clips, and a little less
    for step in range(1, len(data) // size + 1):
        data.batch(step, size)
    assert len(read) == len(set(read)) > MIXED + AHEAD


def test_neighbours_come_from_several_shards(data: StreamedSet) -> None:
    some = {data.at(place).shard for place in range(100, 116)}
    assert len(some) > MIXED // 2


def test_any_number_of_parts_goes_on_with_the_same_clips(data: StreamedSet) -> None:
    one = [r.id for step in (1, 2, 3) for r in data.batch(step, 8).records]
    parts = [(step, rank) for step in (1, 2, 3) for rank in range(4)]
    four = [r.id for step, rank in parts for r in data.batch(step, 2, rank=rank, count=4).records]
    assert one == four == ids(data, 0, 24)
    again = data.batch(3, 8)
    assert [r.id for r in again.records] == one[16:]
    assert torch.equal(again.motion, data.batch(3, 8).motion)


def test_clips_are_those_of_the_folder_read_whole(folder: Path, data: StreamedSet) -> None:
    whole = PreparedData(folder)
    for record in islice((data.at(place) for place in range(len(data))), 40):
        assert torch.equal(data._features(record), whole.features(record))
        assert torch.equal(data.data.features(record), whole.features(record))


def test_the_sample_is_bounded_and_the_same_every_time(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    everything = PreparedData(folder).records("train")
    monkeypatch.setattr(streamed, "SAMPLE", {"train": 60, "val": 4})
    first, second = StreamedData(folder).records("train"), StreamedData(folder).records("train")
    assert first == second and 15 < len(first) <= 60 < len(everything)
    assert {r.id for r in first} < {r.id for r in everything}
    assert {r.mirrored for r in first} == {True, False}


def test_an_address_gives_what_the_folder_gives(
    folder: Path, data: StreamedSet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    bucket = Address("memory://streamed")
    for path in folder.rglob("*"):
        if path.is_file() and path.name != ".lock":
            (bucket / path.relative_to(folder).as_posix()).write_bytes(path.read_bytes())
    other = StreamedSet(StreamedData(bucket), seed=3)
    mine, theirs = data.batch(2, 16), other.batch(2, 16)
    assert torch.equal(mine.motion, theirs.motion) and mine.captions == theirs.captions
    assert list(tmp_path.rglob("objects/*/*"))  # the cache that other processes share


def test_damage_is_named(folder: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    for path in folder.rglob("*"):
        if path.is_file():
            (copy / path.relative_to(folder)).parent.mkdir(parents=True, exist_ok=True)
            (copy / path.relative_to(folder)).write_bytes(path.read_bytes())
    data = StreamedSet(StreamedData(copy))
    for shard in data.data.shards:
        (copy / "shards" / shard.name).write_bytes(b"short")
    with pytest.raises(UserError, match=r"shards/000\d\d\.safetensors: .*--resume"):
        data.at(0)
    lines = (copy / "clips.jsonl").read_bytes()
    (copy / "clips.jsonl").write_bytes(lines.replace(b'"num_frames": 1', b'"num_frames": 2', 1))
    with pytest.raises(UserError, match=r"clips\.jsonl is damaged"):
        StreamedData(copy)


def test_too_long_a_demand_is_a_value_error(folder: Path) -> None:
    with pytest.raises(ValueError, match="no training clip of at least 5000 frames"):
        StreamedSet(StreamedData(folder), min_frames=5000, max_frames=6000)
