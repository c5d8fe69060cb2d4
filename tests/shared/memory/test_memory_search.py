"""Search by the library: the scores of exact search, and nearly always the same phrases."""

from pathlib import Path

import pytest
import torch
from torch.nn.functional import normalize

from src.shared.errors import UserError
from src.shared.memory.index import LibraryIndex, MemoryIndex, add_library, make_table, open_index
from src.shared.memory.query import retrieve
from tests.shared.memory.tiny_memory import make_index, random_index

pytest.importorskip("faiss", reason="the extra `index` is not installed")


@pytest.fixture(scope="module")
def exact() -> MemoryIndex:
    return random_index(3000, 16, songs=5)


@pytest.fixture(scope="module")
def fast(exact: MemoryIndex) -> LibraryIndex:
    return LibraryIndex.of(exact, {"audio": make_table(exact, "audio")})


def test_hits_have_exact_scores_and_few_are_missed(exact: MemoryIndex, fast: LibraryIndex) -> None:
    generator = torch.Generator().manual_seed(3)
    query = normalize(torch.randn(20, 16, generator=generator), dim=-1)
    phase = torch.rand(20, generator=generator)
    excluded = [{"song-1", "song-4"}, None] * 10
    settings = {"top_k": 8, "exclude_songs": excluded, "phase": phase, "phase_weight": 0.3}
    right, found = exact.search(query, **settings), fast.search(query, **settings)  # type: ignore[arg-type]
    assert torch.allclose(found.score[:, 0], right.score[:, 0], atol=1e-5)
    same = [len(set(a.tolist()) & set(b.tolist())) for a, b in zip(right.index, found.index)]  # noqa: B905
    assert sum(same) >= 0.97 * 160
    assert (found.score.diff(dim=1) <= 0).all()
    for row in range(0, 20, 2):
        assert not {exact.song_of(int(n)) for n in found.index[row]} & {"song-1", "song-4"}


def test_a_ban_of_nearly_everything_still_finds_the_rest(
    exact: MemoryIndex, fast: LibraryIndex
) -> None:
    hits = fast.search(exact.audio_keys[:2], top_k=4, exclude_songs=[set(exact.songs), None])
    assert (hits.index[0] == -1).all() and torch.isinf(hits.score[0]).all()
    assert (hits.index[1] >= 0).all()


def test_a_folder_keeps_its_tables(tmp_path: Path) -> None:
    index = make_index(20)
    index.save(tmp_path)
    assert type(open_index(tmp_path, library_above=0)) is MemoryIndex, "there are no tables yet"
    add_library(index, tmp_path)
    opened = open_index(tmp_path, library_above=0)
    assert isinstance(opened, LibraryIndex)
    assert type(open_index(tmp_path, library_above=100)) is MemoryIndex
    hits = opened.search(index.motion_keys, top_k=3, key="motion")
    assert hits.index[:, 0].tolist() == list(range(20))
    ours, theirs = (retrieve(i, index.audio_keys, num_frames=9, phase=0.3) for i in (index, opened))
    assert torch.allclose(ours.context, theirs.context, atol=1e-5)
    assert torch.allclose(ours.priors, theirs.priors, atol=1e-5)
    path = tmp_path / "audio.faiss"
    path.write_bytes(path.read_bytes()[:-1] + b"\x00\x00")
    with pytest.raises(UserError, match=r"audio\.faiss"):
        open_index(tmp_path, library_above=0)
