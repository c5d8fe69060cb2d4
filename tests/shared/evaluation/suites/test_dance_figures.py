"""The performer's figures against answers known by construction."""

from dataclasses import replace

import numpy as np
import pytest

from src.shared.evaluation.families import BODY_RHYTHM, FEET, ON_THE_PATH
from src.shared.evaluation.samples import Dance, DanceSample, held_still
from src.shared.evaluation.suites.dance import effect, hard_cuts, near_seams, seam_grid
from src.shared.metrics.retrieval import rank_of
from src.shared.metrics.rhythm import body_beats, landings, limb_beats, seen_from_pelvis, strangers
from src.shared.metrics.seams import ACCELERATION, JERK, body_quantities
from src.shared.motion.motion import Motion
from src.shared.motion.trajectory import MotionTrajectory, to_motion
from src.shared.pipelines.body import start_of
from tests.shared.evaluation.dancers import FPS, hopping, swinging_arms
from tests.shared.evaluation.tiny_pairs import nod

BEATS = np.arange(20) * 0.5


def nodding_path(frames: int = 240) -> MotionTrajectory:
    """120 beats a minute, slow on each."""
    return nod(np.arange(frames + 2) / FPS * 0.5)


def rhythm_of(*dances: Dance) -> dict[str, np.ndarray]:
    sample = DanceSample.of(dances)
    return {key: np.asarray(value) for key, value in
            BODY_RHYTHM.compute(sample, sample, seed=0).items()}  # fmt: skip


def test_arms_that_rest_on_the_beat_dance_on_it() -> None:
    motion = swinging_arms()
    for find in (body_beats, limb_beats):
        inner = [beat for beat in find(motion) if 0.3 < beat < 7.7]
        np.testing.assert_allclose(inner, BEATS[1 : len(inner) + 1], atol=0.02)
    found = rhythm_of(Dance("on", motion, BEATS), Dance("off", swinging_arms(offset=0.25), BEATS))
    assert found["f"][0] > 0.9 and found["limbs_f"][0] > 0.9
    assert found["f"][1] < 0.1
    assert found["f_above_half"][0] > 0.8 and found["f_above_half"][1] < -0.8
    assert found["f_above_turned"][0] > 0.4


def test_a_carried_statue_has_the_paths_beats_and_no_limbs() -> None:
    statue = to_motion(nodding_path())
    assert len(body_beats(statue)) > 10
    assert len(limb_beats(statue)) == 0
    assert np.ptp(seen_from_pelvis(statue), axis=0).max() < 1e-5
    found = rhythm_of(Dance("statue", statue, BEATS))
    assert found["f"][0] > 0.5 and found["limbs_f"][0] == 0 and found["landings"][0] == 0


def test_frozen_poses_score_nothing() -> None:
    found = rhythm_of(Dance("still", held_still(swinging_arms()), BEATS))
    for key, values in found.items():
        assert values[0] == 0, key


def test_landings_are_where_feet_come_down() -> None:
    assert len(landings(swinging_arms())) == 0
    found = landings(hopping())
    np.testing.assert_allclose(found, np.repeat(BEATS[1:16], 2), atol=1.5 / FPS)
    assert len(found) == 2 * 15  # both feet
    low = landings(hopping(height=0.03))
    assert len(low) == 0  # a shuffle is no landing
    scores = rhythm_of(Dance("hop", hopping(), BEATS))
    assert scores["landing_to_music"][0] > 0.7 and scores["landing_above_turned"][0] > 0.3
    assert scores["landings"][0] == pytest.approx(30 / 8)


def test_the_distance_from_the_path_is_told_in_centimetres_and_degrees() -> None:
    path = nodding_path()
    body = to_motion(path)
    away = replace(body, root_position=body.root_position + np.float32([0.03, 0, 0.04]))
    sample = DanceSample.of(
        [Dance("a", body, BEATS, path=path), Dance("b", away, BEATS, path=path),
         Dance("c", body, BEATS)]
    )  # fmt: skip
    found = ON_THE_PATH.compute(sample, sample, seed=0)
    root, turn = np.asarray(found["root_mean"]), np.asarray(found["turn_max"])
    np.testing.assert_allclose(root[:2], [0, 5], atol=1e-3)
    assert turn[0] < 0.05 and np.isnan(root[2])
    assert np.asarray(found["limb_speed"])[0] < 1e-3 < np.asarray(found["joint_speed"])[0]
    assert start_of(path).heading == pytest.approx(path.heading[0])


def test_feet_are_measured_before_and_after() -> None:
    glide = to_motion(nodding_path())
    still = held_still(glide)
    figures = FEET.compute(DanceSample.of([Dance("a", still, BEATS, raw=glide)]), None, seed=0)  # type: ignore[arg-type]
    assert np.asarray(figures["support_before"])[0] > 50 and figures["support"] == 0
    assert np.isnan(np.asarray(figures["jerk_per_speed"])[0])


def test_other_songs_are_never_the_own() -> None:
    dances = [Dance(str(k), swinging_arms(offset=k), np.array([float(k)])) for k in range(5)]
    order = strangers(5, np.random.default_rng(0))
    moved = DanceSample.of(dances).reordered(order)
    assert sorted(order) == list(range(5)) and all(a != b for a, b in enumerate(order))
    assert moved.asked == [dance.song for dance in dances]
    assert all(m.motion is dances[k].motion for m, k in zip(moved.dances, order, strict=True))


# ---------------------------------------------------------------- seams


def parabola(acceleration: float, frames: int = 60) -> Motion:
    time = np.arange(frames) / FPS
    motion = held_still(hopping(frames=frames))
    root = motion.root_position.copy()
    root[:, 2] = acceleration / 2 * time**2
    return replace(motion, root_position=root)


def test_accelerations_have_their_closed_form() -> None:
    found = body_quantities(parabola(6.0))
    np.testing.assert_allclose(found[ACCELERATION][1:-1], 6.0, atol=0.01)
    np.testing.assert_allclose(found[JERK][1:-2], 0.0, atol=0.5)
    assert found[ACCELERATION][0] == 0 and len(found[JERK]) == 60


def test_a_hard_cut_is_seen_and_a_smooth_dance_is_not() -> None:
    dances = [
        Dance(str(k), swinging_arms(offset=0.13 * k), BEATS, seams=near_seams(240))
        for k in range(4)
    ]
    assert dances[0].seams is not None and dances[0].seams.any() and not dances[0].seams.all()
    (grid,) = seam_grid(
        {"own": dances, "cut": hard_cuts(dances)}, [dance.motion for dance in dances], 0
    )
    smooth, cut = (grid.rows[f"{JERK}: {name}"].cells for name in ("own", "cut"))
    assert float(str(smooth["beyond_seam"])) < 3 < 10 < float(str(cut["beyond_seam"]))
    assert grid.value(f"{JERK}: cut", "seam") > 5 * grid.value(f"{JERK}: own", "seam")
    lone = [replace_seams(dance) for dance in dances]
    assert seam_grid({"own": lone}, [dances[0].motion], 0) == []
    (beside,) = seam_grid({"own": dances, "lone": lone}, [dances[0].motion], 0)
    assert beside.title == grid.title, "the row without seams is not what the title counts"


def replace_seams(dance: Dance) -> Dance:
    return replace(dance, seams=None)


# ---------------------------------------------------------------- prompts


def test_ranks_count_ties_half() -> None:
    distances = np.array([[0.1, 0.2, 0.3], [0.3, 0.2, 0.1], [0.5, 0.5, 0.5]])
    np.testing.assert_allclose(rank_of(distances, 0), [0, 2, 1])


@pytest.mark.parametrize("listens", [True, False])
def test_only_who_listens_is_found_by_its_prompt(listens: bool) -> None:
    rng = np.random.default_rng(0)
    text = np.eye(8)
    songs = rng.normal(0, 0.02, (3, 8, 2, 2, 8))
    if listens:
        songs += text[None, :, None, None]
    else:
        songs += text[0]
    found = effect(songs, np.full((3, 16), 0.5), np.zeros((3, 16)), text)
    if listens:
        assert found["gain"].low > 1 and found["r_at_1"].value == 1
    else:
        assert abs(found["gain"].value) < 0.02 and found["r_at_1"].value < 0.3
    assert found["f"].value == 0.5
