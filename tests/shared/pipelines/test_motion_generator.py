"""MotionGenerator: whatever a command writes, the library call beside it makes, byte for byte."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.audio.song import analyse
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.data.retarget.read_motion import read_motion
from src.shared.formats.registry import write_motion, write_trajectory
from src.shared.model.diffusion import Sampling
from src.shared.motion.motion import Motion
from src.shared.motion.trajectory import MotionTrajectory
from src.shared.pipelines.edit import chosen_joints, continue_clips, edit_clip
from src.shared.pipelines.motion_generator import MotionGenerator, load
from src.shared.pipelines.motion_sampler import MotionSampler
from src.shared.pipelines.path import read_path
from src.shared.pipelines.song import AudioCondition, SongGenerator, finished
from src.shared.pipelines.timeline import Timeline, read_timeline
from tests.shared.evaluation.tiny_pairs import tiny_model
from tests.shared.model.conftest import tiny_generator

WALK, JUMP = "a person walks forward", "somebody jumps twice"
SAMPLING = Sampling(seed=3, steps=2)
Made = list[Motion] | list[MotionTrajectory]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Both models, a song, a clip, a path and a timeline."""
    folder = tmp_path_factory.mktemp("modes")
    tiny_model().save_pretrained(folder / "audio")
    generator = tiny_generator()
    generator.save_pretrained(folder / "text")
    write_motion(generator.generate([JUMP], seconds=2.0, seed=1)[0], folder / "clip.npz")
    render_song(SongSpec(seconds=3.0, seed=1)).write_wav(folder / "song.wav")
    (folder / "path.csv").write_text("x,z\n0,0\n0,1.5\n")
    (folder / "timeline.json").write_text(
        f'[{{"text": "{WALK}", "start": 0, "end": 1}}, {{"text": "{JUMP}", "start": 1, "end": 2}}]'
    )
    return folder


@pytest.fixture(scope="module")
def generator(folder: Path) -> MotionGenerator:
    return MotionGenerator(folder / "text", folder / "audio", device="cpu")


def edits(generator: MotionGenerator, folder: Path) -> Made:
    given = edit_clip(read_motion(folder / "clip.npz"), 0.5, 1.5, chosen_joints(["left-arm"]))
    return [generator.edit(given, WALK, sampling=SAMPLING).motion]


def continues(generator: MotionGenerator, folder: Path) -> Made:
    given = continue_clips(read_motion(folder / "clip.npz"), keep=0.5)
    return [generator.edit(given, WALK, sampling=SAMPLING).motion]


def timed(generator: MotionGenerator, timeline: Timeline, **options: Any) -> Made:
    return [generator.timeline(timeline, sampling=SAMPLING, **options).motion]


SONG = ["--audio", "song.wav"]
MODES: dict[str, tuple[list[str], Callable[[MotionGenerator, Path], Made]]] = {
    "text": (
        ["--prompt", WALK, "--prompt", f"{JUMP}, then walks two metres", "--seconds", "1"],
        lambda g, _: g.generate(
            [WALK, f"{JUMP}, then walks two metres"], seconds=1.0, sampling=SAMPLING
        ),
    ),
    "candidates": (
        ["--prompt", WALK, "--num-samples", "3", "--return-all"],
        lambda g, _: g.generate(WALK, num_samples=3, return_all=True, sampling=SAMPLING),
    ),
    "song": (
        [*SONG, "--num-samples", "2", "--style", "proud"],
        lambda g, folder: g.trajectory(
            folder / "song.wav", num_samples=2, style="proud", sampling=SAMPLING
        ).trajectories[:1],
    ),
    "dance": (
        [*SONG, "--prompt", WALK, "--num-samples", "2"],
        lambda g, folder: [
            g.dance(folder / "song.wav", WALK, num_samples=2, sampling=SAMPLING).ranked[0].motion
        ],
    ),
    "body": (
        [*SONG, "--body"],
        lambda g, folder: [g.dance(folder / "song.wav", sampling=SAMPLING).ranked[0].motion],
    ),
    "edit": (
        ["--edit", "clip.npz", "--joints", "left-arm", "--from", "0.5", "--to", "1.5",
         "--prompt", WALK],
        edits,
    ),
    "continue": (["--start", "clip.npz", "--keep", "0.5", "--prompt", WALK], continues),
    "then": (
        ["--prompt", WALK, "--then", JUMP, "--seconds", "1"],
        lambda g, _: timed(g, Timeline.of([WALK, JUMP], 1.0)),
    ),
    "loop": (
        ["--prompt", WALK, "--seconds", "2", "--loop"],
        lambda g, _: timed(g, Timeline.of([WALK], 2.0), loop=True),
    ),
    "timeline": (
        ["--timeline", "timeline.json"],
        lambda g, folder: timed(g, read_timeline(folder / "timeline.json")),
    ),
    "path": (
        ["--prompt", WALK, "--path", "path.csv"],
        lambda g, folder: timed(g, Timeline.of([WALK]), path=read_path(folder / "path.csv")),
    ),
}  # fmt: skip


@pytest.mark.parametrize("mode", MODES)
def test_command_and_library_write_the_same_bytes(
    mode: str,
    folder: Path,
    generator: MotionGenerator,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(folder)
    arguments, make = MODES[mode]
    models = ["--model", "audio", "--body-model", "text"] if "--audio" in arguments else []
    if mode == "song":
        models = models[:2]
    common = ["--seed", "3", "--steps", "2", "--format", "npz", "--device", "cpu", "--out"]
    words = ["generate", *arguments, *(models or ["--model", "text"]), *common, str(tmp_path)]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    written = [Path(line) for line in result.stdout.splitlines()]
    made = make(generator, folder)
    assert len(written) == len(made)
    for number, (file, motion) in enumerate(zip(written, made, strict=True)):
        own = tmp_path / "own" / f"{number}.npz"
        if isinstance(motion, MotionTrajectory):
            write_trajectory(motion, own)
        else:
            write_motion(motion, own)
        assert own.read_bytes() == file.read_bytes()


def test_a_song_sampled_by_its_condition_is_the_one_of_the_command(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # where the processor multiplies bf16 the command's copy of the network would round to it
    monkeypatch.setattr("src.shared.device._native_bf16", lambda name: (False, "not here"))
    generator = MotionGenerator(folder / "text", folder / "audio", device="cpu")
    song = analyse(folder / "song.wav")
    sampler = MotionSampler(tiny_model(), device="cpu")
    found = sampler.sample(AudioCondition.of(song), num_samples=2, num_steps=2, return_all=True)
    made = generator.trajectory(song, num_samples=2, sampling=Sampling(steps=2))
    assert found.all_candidates is not None
    for rank, place in enumerate(made.table.order):
        raw = MotionTrajectory(found.all_candidates[place])
        made_here = made.trajectories[rank].position  # by the faster copy of its network
        np.testing.assert_allclose(finished(raw).position, made_here, atol=1e-3)


def test_models_are_found_by_kind_and_loaded_when_needed(folder: Path) -> None:
    assert isinstance(load(folder / "audio", device="cpu").audio, SongGenerator)
    text = load(folder / "text", audio="none", device="cpu")
    assert text.text.card.trained
    pieces = list(text.stream([WALK], seconds=0.5, sampling=SAMPLING))
    assert sum(piece.num_frames for piece in pieces) == 15
