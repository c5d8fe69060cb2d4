"""Footsteps: left and right in turn, landing on beats, only where a path walks.

A path as a constraint is the inverse of walking along it.

Performer: the body is on the path exactly, in as many frames, whatever the text says.
"""

from itertools import pairwise

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UsageError
from src.shared.motion.features import LEFT_CONTACT, ROOT_ROW, decode_features
from src.shared.motion.postprocess.whole import without_heading
from src.shared.motion.rotations import (
    axis_angle_to_matrix,
    matrix_to_quaternion,
    matrix_to_rotation_6d,
)
from src.shared.motion.trajectory import MotionTrajectory
from src.shared.pipelines.body import (
    QUICK,
    Performer,
    PerformerSettings,
    free_body,
    landings,
    pin,
    root_error,
    start_of,
    step_plan,
)
from src.shared.pipelines.dance import STAND, SongPerformer, candidate_seed
from src.shared.pipelines.ranking import PerformanceJudge, beat_report
from src.shared.pipelines.song import SongCondition, finished
from src.shared.pipelines.stream import Passage
from tests.shared.evaluation.tiny_pairs import nod
from tests.shared.model.conftest import tiny_generator


def walk(speed: float, frames: int = 240, *, sway: np.ndarray | None = None) -> MotionTrajectory:
    """Straight ahead, the pelvis `sway` metres to the left of the line."""
    position = np.zeros((frames, 3))
    position[:, 1], position[:, 2] = 0.93, np.arange(frames) / 30 * speed
    if sway is not None:
        position[:, 0] = sway
    turn = np.tile([1.0, 0.0, 0.0, 0.0], (frames, 1))
    return MotionTrajectory.from_pose(position, turn, np.arange(frames) / 60)


def test_feet_land_on_the_beats_in_turn() -> None:
    beats = 0.2 + 0.5 * np.arange(17)
    contact, planned = step_plan(walk(1.0), beats)
    assert planned.all() and contact.any(1).all()
    lands = [np.flatnonzero(np.diff(contact[:, side].astype(int)) == 1) + 1 for side in (0, 1)]
    times = np.sort(np.concatenate(lands)) / 30
    assert np.abs(times[:, None] - beats).min(1).max() <= 1 / 30 + 1e-9
    in_turn = sorted([(at, 0) for at in lands[0]] + [(at, 1) for at in lands[1]])
    assert all(a[1] != b[1] for a, b in pairwise(in_turn))
    both = contact.all(1).mean()
    assert 0.15 < both < 0.3


def test_nothing_is_planned_where_nobody_walks() -> None:
    beats = 0.5 * np.arange(16)
    for speed in (0.0, 3.0):
        assert not step_plan(walk(speed), beats)[1].any()
    assert not step_plan(walk(1.0), beats[:1])[1].any()
    position = np.concatenate((np.zeros(120), np.arange(120) / 30))
    both = walk(0.0)
    both.data[:, 2] = position
    planned = step_plan(both, beats)[1]
    assert not planned[:100].any() and planned[140:].all()


def test_quick_beats_get_a_step_every_second_time() -> None:
    quick, slow = QUICK * 0.8 * np.arange(20), QUICK * 1.2 * np.arange(20)
    np.testing.assert_allclose(np.diff(landings(quick, 5.0)), QUICK * 1.6)
    np.testing.assert_allclose(np.diff(landings(slow, 5.0)), QUICK * 1.2)


@given(side=st.sampled_from([-1, 1]), offset=st.integers(0, 1))
def test_the_foot_stands_under_the_swaying_pelvis(side: int, offset: int) -> None:
    beats = 0.5 * np.arange(offset, 18)
    sway = side * 0.04 * np.sin(np.pi * np.arange(240) / 30 / 0.5)  # left in the first half second
    contact, _ = step_plan(walk(1.0, sway=sway), beats)
    left_alone = contact[:, 0] & ~contact[:, 1]
    right_alone = contact[:, 1] & ~contact[:, 0]
    assert sway[left_alone].mean() > 0.01 > -0.01 > sway[right_alone].mean()


@given(seed=st.integers(0, 500), tempo=st.floats(50, 200))
def test_some_foot_stands_wherever_steps_are_planned(seed: int, tempo: float) -> None:
    rng = np.random.default_rng(seed)
    beats = rng.uniform(0, 1) + np.cumsum(60 / tempo * rng.uniform(0.95, 1.05, 30))
    contact, planned = step_plan(walk(rng.uniform(0, 2.5), 150), beats)
    assert contact[planned].any(1).all()
    assert contact.shape == (150, 2) and planned.shape == (150,)


def wild_path(seed: int, frames: int) -> MotionTrajectory:
    """A pelvis that wanders, turns round more than once, and leans; starts anywhere."""
    rng = np.random.default_rng(seed)
    walk = rng.normal(0, 0.02, (frames, 3)).cumsum(0) + rng.normal(0, 3, 3)
    yaw = rng.normal(0.05, 0.1, frames).cumsum() + rng.uniform(-3, 3)
    lean, roll = rng.normal(0, 0.3, (2, frames))
    turn = (
        axis_angle_to_matrix(1, torch.from_numpy(yaw))
        @ axis_angle_to_matrix(0, torch.from_numpy(lean))
        @ axis_angle_to_matrix(2, torch.from_numpy(roll))
    )
    return MotionTrajectory.from_pose(
        walk, matrix_to_quaternion(turn).numpy(), np.arange(frames) / 60.0
    )


@given(seed=st.integers(0, 10_000), frames=st.integers(2, 90))
def test_a_body_that_keeps_to_the_pins_stands_on_the_path(seed: int, frames: int) -> None:
    path = wild_path(seed, frames)
    motion = decode_features(pin(path, tilt=True).values, place=start_of(path))
    error = root_error(motion, path)
    assert error.max_metres < 1e-4 and error.max_degrees < 0.02
    assert error.mean_metres <= error.max_metres and error.mean_degrees <= error.max_degrees
    same = np.abs((motion.quaternions[:, 0] * path.quaternion).sum(-1))
    assert same.min() > 1 - 1e-5  # leaning and rolling too


def test_what_is_known() -> None:
    path = wild_path(1, 40)
    whole, upright = pin(path, beats=np.array([0.5, 1.0]), tilt=True), pin(path)
    assert whole.known[:, ROOT_ROW, :LEFT_CONTACT].all() and whole.known[:, 0].all()
    assert int(whole.known.sum()) == 40 * 10  # four of the root row, six of the pelvis
    assert int(upright.known.sum()) == 40 * 4 and upright.beats is None
    assert whole.beats is not None and whole.beats.tolist() == [0.5, 1.0]
    assert whole.window(15, 30).beats.tolist() == [0.0, 0.5]  # type: ignore[union-attr]


def test_steps_are_known_where_the_path_walks() -> None:
    way = nod(np.arange(122) / 30 * 0.5)  # about a metre a second
    constraint = pin(way, steps=np.arange(1, 10) * 0.5)
    contacts = constraint.values[:, ROOT_ROW, LEFT_CONTACT:]
    assert constraint.known[:, ROOT_ROW, LEFT_CONTACT:].all() and constraint.beats is None
    assert set(contacts.unique().tolist()) == {0.0, 1.0} and contacts.any(1).all()
    assert not pin(wild_path(1, 40)).known[:, ROOT_ROW, LEFT_CONTACT:].any()


def test_ten_minutes_do_not_drift() -> None:
    path = wild_path(2, 18_000)
    error = root_error(decode_features(pin(path, tilt=True).values, place=start_of(path)), path)
    assert error.max_metres < 0.005 and error.max_degrees < 0.1


def test_a_heading_in_the_pelvis_row_is_taken_out() -> None:
    path = wild_path(3, 30)
    features = pin(path, tilt=True).values.clone()
    twist = axis_angle_to_matrix(1, torch.full((30,), 0.3))
    features[:, 0] = matrix_to_rotation_6d(twist)
    features[:, 1:ROOT_ROW, 0] = features[:, 1:ROOT_ROW, 4] = 1.0
    assert root_error(decode_features(features, place=start_of(path)), path).max_degrees > 10
    level = without_heading(features)
    assert root_error(decode_features(level, place=start_of(path)), path).max_degrees < 0.02
    torch.testing.assert_close(level[:, 1:], features[:, 1:])


def test_errors_are_measured() -> None:
    path = wild_path(4, 30)
    motion = decode_features(pin(path, tilt=True).values, place=start_of(path))
    motion.root_position[:, 0] += 0.1
    error = root_error(motion, path)
    np.testing.assert_allclose([error.mean_metres, error.max_metres], 0.1, atol=1e-4)


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
    assert dance.error is not None
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


def song(frames: int = 90, seed: int = 7) -> SongCondition:
    phase = np.arange(frames) / 60.0
    return SongCondition(torch.zeros(167, frames), phase, np.arange(6) * 0.5, seed)


def test_each_path_gets_a_body_and_the_best_comes_first() -> None:
    generator = tiny_generator()
    dancers = SongPerformer(Performer(generator))
    raw = [path(90, turn) for turn in (0.1, 0.4)]
    ways = [finished(each) for each in raw]
    found = dancers.follow(ways, song(), PROMPT, raw=raw, seed=3)
    assert len(found.ranked) == 2
    assert set(found.table.terms) == {"feet", "smoothness", "sanity", "beats"}
    best = int(found.table.order[0])
    np.testing.assert_allclose(found.ranked[0].trajectory.data, ways[best].data, atol=1e-6)
    alone = dancers.follow(ways[:1], song(), PROMPT, seed=3)
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
    table = dancers.follow([path(90), path(90, 0.4)], song(), PROMPT).table
    prompt = generator.encode_prompts([PROMPT]).pooled[0]
    said = [max(0.0, float(prompt[0]))] * 2
    np.testing.assert_allclose(table.terms["similarity"], said, atol=1e-6)


def test_one_candidate_is_not_judged() -> None:
    table = SongPerformer(Performer(tiny_generator())).dance(song(), PROMPT).table
    assert table.best == 0 and table.terms == {}


def test_a_free_body_dances_and_waits() -> None:
    generator, sound = tiny_generator(), torch.zeros(167, 200)
    sound[160, :120] = 1.0  # then a silence
    heard = SongCondition(sound, np.arange(200) / 60.0, np.arange(8) * 0.5, 7)
    assert heard.waits == [(120, 200)]
    found = SongPerformer(Performer(generator)).dance(heard, PROMPT, num_samples=2, seed=1)
    assert set(found.table.terms) == {"feet", "smoothness", "beats"}
    dance = found.ranked[0]
    assert dance.error is None and dance.motion.num_frames == dance.trajectory.num_frames == 200
    assert [(each.text, each.frames) for each in dance.passages] == [(PROMPT, 120), (STAND, 80)]
    again = SongPerformer(Performer(generator)).dance(heard, PROMPT, num_samples=2, seed=1)
    np.testing.assert_array_equal(again.ranked[0].motion.quaternions, dance.motion.quaternions)


def test_what_is_known_of_a_free_body() -> None:
    known = free_body(120, beats=np.arange(8) * 0.5, steps=np.arange(8) * 0.5, waits=[(60, 120)])
    contacts = known.known[:, ROOT_ROW, LEFT_CONTACT:]
    assert contacts[:60].all() and not known.known[60:].any()
    assert int(known.known.sum()) == 120  # nothing of path and height
    assert known.values[:60, ROOT_ROW, LEFT_CONTACT:].any(1).all()
    assert not free_body(120, beats=None, steps=np.zeros(1)).known.any()


def test_beats_are_told_with_their_chance() -> None:
    performer = Performer(tiny_generator())
    told = beat_report(performer.perform(path(120), PROMPT).motion, np.arange(8) * 0.5)
    assert set(told) == {"motion-to-music", "music-to-motion", "chance"}
    assert all(0 <= value <= 1 for value in told.values())
