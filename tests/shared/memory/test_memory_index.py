"""MemoryIndex: exact search against a plain sort, exclusion, phases, folders that do not lie."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from safetensors.torch import load_file, save_file

from src.shared.errors import UserError
from src.shared.io.files import sha256_file
from src.shared.memory import index as index_module
from src.shared.memory.index import MemoryIndex, phase_cost
from tests.shared.memory.tiny_memory import make_index, make_phrase, random_index


def plain_search(
    index: MemoryIndex, query: torch.Tensor, top_k: int, banned: set[str], phase: float | None
) -> list[tuple[int, float]]:
    """One query the slow way, in the order (-score, phrase)."""
    scored = []
    for number, key in enumerate(index.audio_keys):
        if index.song_of(number) in banned:
            continue
        score = float(query @ key)
        if phase is not None:
            turn = phase - float(index.start_phase[number])
            score -= 0.1 * (1 - np.cos(2 * np.pi * turn)) / 2
        scored.append((-round(score, 5), number))
    return [(number, -score) for score, number in sorted(scored)[:top_k]]


@settings(max_examples=30)
@given(
    count=st.integers(1, 40),
    top_k=st.integers(1, 12),
    block=st.sampled_from([1, 3, 7, 64]),
    seed=st.integers(0, 9),
    with_phase=st.booleans(),
)
def test_search_is_a_sort(count: int, top_k: int, block: int, seed: int, with_phase: bool) -> None:
    index = random_index(count, 8, seed=seed)
    query = torch.nn.functional.normalize(
        torch.randn(3, 8, generator=torch.Generator().manual_seed(seed + 1)), dim=-1
    )
    query[0] = index.audio_keys[0]
    excluded: list[set[str] | None] = [None, {"song-0", "song-3", "unknown"}, set(index.songs)]
    phase = torch.tensor([0.1, 0.9, 0.5]) if with_phase else None
    before, index_module.BLOCK = index_module.BLOCK, block
    try:
        hits = index.search(query, top_k=top_k, exclude_songs=excluded, phase=phase)
    finally:
        index_module.BLOCK = before
    assert hits.index.shape == hits.score.shape == (3, top_k)
    for row in range(3):
        wanted = plain_search(
            index,
            query[row],
            top_k,
            excluded[row] or set(),
            None if phase is None else float(phase[row]),
        )
        found = hits.index[row].tolist()
        assert found[len(wanted) :] == [-1] * (top_k - len(wanted))
        assert torch.isinf(hits.score[row, len(wanted) :]).all()
        scores = [score for _, score in wanted]
        assert np.allclose(hits.score[row, : len(wanted)], scores, atol=2e-5)
        assert len(set(found[: len(wanted)])) == len(wanted)


def test_ties_come_in_the_order_of_the_phrases() -> None:
    index = random_index(100, 4)
    index = MemoryIndex(**vars(index) | {"audio_keys": torch.ones(100, 4) / 2})
    hits = index.search(torch.ones(2, 4) / 2, top_k=7)
    assert hits.index.tolist() == [list(range(7))] * 2
    hits = index.search(torch.ones(1, 4) / 2, top_k=7, exclude_songs=[{"song-0", "song-2"}])
    assert hits.index.tolist() == [[1, 3, 4, 5, 6, 8, 10]]


def test_the_side_that_is_asked_for() -> None:
    index = make_index()
    for key in ("audio", "motion"):
        hits = index.search(index.keys(key), top_k=1, key=key)  # type: ignore[arg-type]
        assert hits.index[:, 0].tolist() == list(range(12))


def test_phase_costs_half_a_bar_most() -> None:
    phases = torch.tensor([0.0, 0.25, 0.5, 0.75, 1.0])
    cost = phase_cost(torch.tensor([0.0]), phases, 0.2)[0]
    assert torch.allclose(cost, torch.tensor([0, 0.1, 0.2, 0.1, 0]), atol=1e-6)


def test_wrong_shapes_are_the_callers_fault() -> None:
    index = make_index()
    with pytest.raises(ValueError, match=r"\[B,16\], not \[2, 8\]"):
        index.search(torch.zeros(2, 8), top_k=1)
    with pytest.raises(ValueError, match="1 entries, not 2"):
        index.search(torch.zeros(2, 16), top_k=1, exclude_songs=[None])


def test_a_folder_gives_back_what_was_saved(tmp_path: Path) -> None:
    index = make_index(space="abc", bars=2)
    index.save(tmp_path / "memory")
    opened = MemoryIndex.open(tmp_path / "memory")
    for name, value in vars(index).items():
        other = getattr(opened, name)
        assert torch.equal(value, other) if isinstance(value, torch.Tensor) else value == other
    phrase = make_phrase(5)
    assert np.allclose(opened.trajectory(5), phrase.trajectory, atol=0.02, rtol=1e-3)
    assert np.allclose(opened.prior(5), phrase.priors, atol=1e-3)
    assert opened.song_of(5) == "song-2" and opened.captions[5] == "caption 5"
    assert opened.start_phase[:4].tolist() == [0.0, 0.25, 0.5, 0.75]
    query = index.audio_keys[:3]
    assert torch.equal(opened.search(query, top_k=4).index, index.search(query, top_k=4).index)


def test_the_same_memory_is_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        make_index().save(tmp_path / name)
    for file in (tmp_path / "a").iterdir():
        assert sha256_file(file) == sha256_file(tmp_path / "b" / file.name)


def damage(folder: Path, how: str) -> None:
    manifest = folder / "manifest.json"
    content: dict[str, Any] = json.loads(manifest.read_text())
    if how == "no manifest":
        manifest.unlink()
    elif how == "no json":
        manifest.write_text("{")
    elif how == "another kind":
        manifest.write_text(json.dumps(content | {"kind": "cake"}))
    elif how == "another version":
        manifest.write_text(json.dumps(content | {"format-version": 99}))
    elif how == "bit flip":
        path = folder / "keys.safetensors"
        data = bytearray(path.read_bytes())
        data[-9] ^= 1
        path.write_bytes(data)
    elif how == "cut off":
        path = folder / "motions.safetensors"
        path.write_bytes(path.read_bytes()[:-10])
    elif how == "missing":
        (folder / "phrases.json").unlink()
    elif how == "lacks a tensor":
        path = folder / "keys.safetensors"
        tensors = load_file(path)
        del tensors["tempo"]
        save_file(dict(tensors), path)
        told = {"sha256": sha256_file(path), "bytes": path.stat().st_size}
        content["files"]["keys.safetensors"] = told
        manifest.write_text(json.dumps(content))


@pytest.mark.parametrize(
    ("how", "says"),
    [
        ("no manifest", "is no memory"),
        ("no json", "cannot be read"),
        ("another kind", "describes no memory"),
        ("another version", "format-version 99"),
        ("bit flip", "does not match the SHA-256"),
        ("cut off", "bytes, not"),
        ("missing", "is missing"),
        ("lacks a tensor", "is damaged"),
    ],
)
def test_damage_is_found_and_named(tmp_path: Path, how: str, says: str) -> None:
    make_index().save(tmp_path)
    damage(tmp_path, how)
    with pytest.raises(UserError, match=says) as caught:
        MemoryIndex.open(tmp_path)
    assert str(tmp_path) in str(caught.value) and "\n" not in str(caught.value)
