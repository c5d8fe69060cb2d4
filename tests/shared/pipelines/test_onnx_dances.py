"""Dances and paths of songs by onnxruntime: those of PyTorch, guidance to the beats included."""

from typing import Any

import numpy as np
import pytest

from src.shared.audio.song import Song, analyse
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.model.diffusion import Sampling
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.contacts import contact_runs
from src.shared.motion.postprocess.footskate import LEGS
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


@pytest.mark.parametrize("stepping", [False, True])
def test_same_seed_same_dance_along_the_path_of_the_song(
    generators: dict[str, MotionGenerator], song: Song, stepping: bool
) -> None:
    """Where feet would slide they step, in whole frames: paths that are 3 mm apart may
    put a step a frame later. Nothing but legs may differ for it."""
    wanted, found = (
        each.dance(song, "a person walks", sampling=FEW, follow_path=True, foot_lock=stepping)
        .ranked[0]
        .motion
        for each in generators.values()
    )
    np.testing.assert_allclose(found.root_position, wanted.root_position, atol=5e-3)
    still = np.setdiff1d(np.arange(22), np.ravel(LEGS)) if stepping else np.arange(22)
    np.testing.assert_allclose(found.quaternions[:, still], wanted.quaternions[:, still], atol=1e-3)
    for (first, last), (begin, end) in zip(*map(stances, (found, wanted)), strict=True):
        assert abs(first - begin) <= 1 and abs(last - end) <= 1


def stances(motion: Motion) -> list[tuple[int, int]]:
    """First and past-the-last frame of each time that a foot stands, left ones first."""
    return [run for side in (0, 1) for run in contact_runs(motion.contacts[:, side] > 0.5, 0)]


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
