"""Dances and paths of songs by onnxruntime: those of PyTorch, guidance to the beats included."""

from typing import Any

import numpy as np
import pytest

from src.shared.audio.song import Song, analyse
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.model.diffusion import Sampling
from src.shared.pipelines.motion_generator import MotionGenerator
from src.shared.pipelines.path import DrawnPath

pytest.importorskip("onnxruntime")

FEW = Sampling(seed=2, steps=3)
DANCES: dict[str, tuple[str | None, dict[str, Any]]] = {
    "figures": ("a person dances", {}),
    "the model alone, on the beats": ("a person dances", {"figures": False}),
    "as the music says": (None, {"figures": False}),
    "along a drawn path": (
        "a person walks",
        {"path": DrawnPath(np.array([[0.0, 0.0], [0.0, 2.0]]))},
    ),
    "along the song's path": ("a person walks", {"follow_path": True, "foot_lock": False}),
    "stepping along it": ("a person walks", {"follow_path": True, "foot_lock": True}),
}


@pytest.fixture(scope="module")
def song(tmp_path_factory: pytest.TempPathFactory) -> Song:
    path = tmp_path_factory.mktemp("song") / "song.wav"
    render_song(SongSpec(seconds=4.0, tempo=120.0, seed=1)).write_wav(path)
    return analyse(path, cache=False)


@pytest.fixture(scope="module")
def generators() -> dict[str, MotionGenerator]:
    return {name: MotionGenerator(device="cpu", runtime=name) for name in ("torch", "onnx")}


@pytest.mark.parametrize("name", DANCES)
def test_same_seed_same_dance(
    generators: dict[str, MotionGenerator], song: Song, name: str
) -> None:
    prompt, options = DANCES[name]
    wanted, found = (
        each.dance(song, prompt, sampling=FEW, **options).ranked[0].motion
        for each in generators.values()
    )
    assert wanted.num_frames > 100
    np.testing.assert_allclose(found.quaternions, wanted.quaternions, atol=1e-3)
    np.testing.assert_allclose(found.root_position, wanted.root_position, atol=1e-3)
    np.testing.assert_array_equal(found.contacts > 0.5, wanted.contacts > 0.5)


def test_same_seed_same_path(generators: dict[str, MotionGenerator], song: Song) -> None:
    wanted, found = (
        generator.trajectory(song, sampling=FEW).trajectories[0]
        for generator in generators.values()
    )
    np.testing.assert_allclose(found.position, wanted.position, atol=1e-3)


def test_candidates_are_judged_alike(generators: dict[str, MotionGenerator]) -> None:
    tables = [
        each.candidates(["a person waves"], 2, sampling=FEW, seconds=1.5)[0].table
        for each in generators.values()
    ]
    np.testing.assert_array_equal(tables[0].order, tables[1].order)
