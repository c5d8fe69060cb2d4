"""Performer: the body is on the path exactly, in as many frames, whatever the text says."""

import numpy as np
import pytest
import torch

from src.shared.errors import UsageError
from src.shared.inference.motion_stream import Passage
from src.shared.inference.performance_judge import PerformanceJudge, beat_report
from src.shared.inference.performer import Performer, PerformerSettings
from src.shared.inference.song_performer import (
    HeardSong,
    SongPerformer,
    candidate_seed,
    finished,
    perform,
)
from src.shared.motion.trajectory import MotionTrajectory
from tests.shared.evaluation.tiny_pairs import nod
from tests.shared.model.conftest import tiny_generator

PROMPT = "a person walks forward"


def path(frames: int = 200, turn: float = 0.2) -> MotionTrajectory:
    return nod(np.arange(frames + 2) / 30 * 0.5, turn)


@pytest.mark.parametrize("settings", [PerformerSettings(), PerformerSettings(tilt=True)])
@pytest.mark.parametrize("trained", [False, True])
def test_the_body_stands_on_the_path(settings: PerformerSettings, trained: bool) -> None:
    performer = Performer(tiny_generator(constraints=trained), settings)
    way = path()
    done: list[tuple[int, int]] = []
    dance = performer.perform(
        way, PROMPT, beats=np.arange(14) * 0.5, progress=lambda *at: done.append(at)
    )
    assert dance.motion.num_frames == 200 and dance.motion.text == PROMPT
    assert dance.error.max_metres < 0.001 and dance.error.max_degrees < 0.1
    np.testing.assert_allclose(dance.motion.root_position, way.position, atol=1e-3)
    assert done[-1] == (200, 200) and len(done) == 2  # windows of 150 frames that share 30
    assert dance.motion.quaternions[:, 5].std(0).max() > 0  # somebody fills the body in


def test_passages_follow_each_other_and_name_the_dance() -> None:
    performer = Performer(tiny_generator())
    parts = [Passage(PROMPT, 90), Passage("somebody jumps twice", 110)]
    dance = performer.perform(path(), parts)
    assert dance.passages == tuple(parts)
    assert dance.motion.text == f"{PROMPT}, somebody jumps twice"
    again = performer.perform(path(), parts)
    np.testing.assert_array_equal(again.motion.quaternions, dance.motion.quaternions)
    other = performer.perform(path(), parts, seed=1)
    assert np.abs(other.motion.quaternions - dance.motion.quaternions).max() > 0.01
    with pytest.raises(UsageError, match="90 frames for a path of 200"):
        performer.perform(path(), parts[:1])


def test_without_a_root_track_nobody_can_follow_a_path() -> None:
    generator = tiny_generator()
    generator.network = generator.network.model_copy(update={"root_track": False})
    with pytest.raises(UsageError, match="no root track"):
        Performer(generator)


def song(frames: int = 90, seed: int = 7) -> HeardSong:
    phase = np.arange(frames) / 60.0
    return HeardSong(torch.zeros(167, frames), phase, np.arange(6) * 0.5, seed)


def test_each_path_gets_a_body_and_the_best_comes_first() -> None:
    generator = tiny_generator()
    dancers = SongPerformer(Performer(generator))
    raw = [path(90, turn) for turn in (0.1, 0.4)]
    found = dancers.dance(raw, song(), PROMPT, seed=3)
    assert len(found.ranked) == 2
    assert set(found.table.terms) == {"feet", "smoothness", "sanity", "beats"}
    best = int(found.table.order[0])
    np.testing.assert_allclose(found.ranked[0].trajectory.data, finished(raw[best]).data, atol=1e-6)
    alone = dancers.dance(raw[:1], song(), PROMPT, seed=3)
    first = found.ranked[int(np.flatnonzero(found.table.order == 0)[0])]
    np.testing.assert_array_equal(
        alone.ranked[0].motion.quaternions, first.motion.quaternions
    )  # candidates do not depend on each other
    assert candidate_seed(3, 7, 0) != candidate_seed(3, 8, 0)


def test_the_judge_sees_the_words_where_it_has_a_tower() -> None:
    generator = tiny_generator()
    dancers = SongPerformer(
        Performer(generator),
        judge=PerformanceJudge(tower=lambda features: torch.eye(32)[:1].expand(len(features), -1)),
    )
    table = dancers.dance([path(90)], song(), PROMPT).table
    prompt = generator.encode_prompts([PROMPT]).pooled[0]
    np.testing.assert_allclose(table.terms["similarity"], [max(0.0, float(prompt[0]))], atol=1e-6)


def test_beats_are_told_with_their_chance() -> None:
    performer = Performer(tiny_generator())
    told = beat_report(performer.perform(path(120), PROMPT).motion, np.arange(8) * 0.5)
    assert set(told) == {"motion-to-music", "music-to-motion", "chance"}
    assert all(0 <= value <= 1 for value in told.values())


def test_all_in_one_call(tmp_path) -> None:  # type: ignore[no-untyped-def]
    from src.shared.audio.song_spec import SongSpec
    from src.shared.audio.synthetic_songs import render_song
    from src.shared.inference.song_generator import SongGenerator
    from tests.shared.evaluation.tiny_pairs import tiny_model

    render_song(SongSpec(seconds=2.0, seed=1)).write_wav(tmp_path / "song.wav")
    found = perform(
        tmp_path / "song.wav",
        PROMPT,
        path=SongGenerator(tiny_model(), device="cpu"),
        performer=Performer(tiny_generator()),
        num_samples=2,
    )
    assert len(found.ranked) == 2 and found.ranked[0].error.max_metres < 0.001
