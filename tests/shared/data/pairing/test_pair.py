"""A phrase of music and the motion made for it."""

from dataclasses import replace

import numpy as np
import pytest

from src.shared.data.pairing.pair import (
    MusicBeats,
    kind_weights,
    pair_phrase,
    strong_beats,
    suitable_clips,
)
from src.shared.data.pairing.phrase_motion import LIMIT, SPARE
from tests.shared.data.pairing.walkers import walker


def music(interval: float, seconds: float = 14.0, meter: int = 4) -> MusicBeats:
    times = np.arange(-2 + 0.13, seconds + 2, interval)
    return MusicBeats(times, strong_beats(np.arange(len(times)), meter))


CLIPS = [walker(f"walk-{n}", 0.48 + 0.01 * n, speed=1.0 + 0.05 * n) for n in range(10)]


@pytest.mark.parametrize("interval", [0.5, 0.55, 0.28])
def test_beats_meet_after_warping(interval: float) -> None:
    pair = pair_phrase(CLIPS, music(interval), 420, np.random.default_rng(0))
    assert pair is not None and pair.position.shape == (420 + SPARE, 3)
    assert pair.after.motion_to_music > 0.85
    assert pair.chance.motion_to_music < 0.65 and pair.matched > 10
    assert max(abs(rate - 1) for rate in pair.warp.rates) <= LIMIT + 1e-9
    step = np.linalg.norm(np.diff(pair.position, axis=0), axis=1) * 30
    assert step.min() > 0.4 and step.max() < 2.2


def test_the_same_seed_makes_the_same_pair() -> None:
    one, two = (pair_phrase(CLIPS, music(0.52), 300, np.random.default_rng(5)) for _ in range(2))
    assert one is not None and two is not None
    assert np.array_equal(one.position, two.position) and one.warp == two.warp
    assert one.motion.pieces == two.motion.pieces


def test_seams_are_seen_where_the_warp_shows_them() -> None:
    pair = pair_phrase(CLIPS, music(0.5), 420, np.random.default_rng(3))
    assert pair is not None and len(pair.seams) >= 1
    times = pair.warp.times(pair.seams / 30) * 30
    inside = [s for s in pair.motion.seams if s <= pair.warp.times(np.array([421 / 30]))[0] * 30]
    assert np.abs(times - inside).max() <= 1.2


def test_no_beat_or_no_clip_gives_none() -> None:
    rng = np.random.default_rng(0)
    nothing = MusicBeats(np.zeros(0), np.zeros(0, dtype=bool))
    assert pair_phrase(CLIPS, nothing, 300, rng) is None
    assert pair_phrase([], music(0.5), 300, rng) is None
    assert pair_phrase(CLIPS, music(0.8), 300, rng) is None


def test_clips_are_chosen_by_tempo() -> None:
    found = suitable_clips(CLIPS, 0.44)
    assert found and all(abs(clip.period / 0.44 - 1) <= 0.13 for clip in found)
    assert len(found) < len(CLIPS)


@pytest.mark.parametrize(
    ("meter", "wanted"),
    [(4, [0, 2, 4, 6]), (3, [0, 3, 6]), (6, [0, 3, 6]), (2, [0, 2, 4, 6]), (5, [0, 5])],
)
def test_strong_beats(meter: int, wanted: list[int]) -> None:
    assert np.flatnonzero(strong_beats(np.arange(8), meter)).tolist() == wanted


def test_rare_kinds_count_more() -> None:
    many = [walker(f"w{n}", 0.5) for n in range(9)]
    rare = replace(walker("dance", 0.5), tag="dance")
    weights = kind_weights([*many, rare])
    assert sum(weights.values()) == pytest.approx(1)
    assert weights["made", "walk"] == pytest.approx(3 * weights["made", "dance"])


def test_a_phrase_shows_the_kind_that_was_drawn() -> None:
    slow = [replace(walker(f"slow{n}", 0.5, speed=0.4), tag="stroll") for n in range(3)]
    begins = set()
    for seed in range(12):
        pair = pair_phrase([*CLIPS, *slow], music(0.5), 240, np.random.default_rng(seed))
        assert pair is not None and pair.score > 0.7 and 0 < pair.coverage <= 1
        begins.add(pair.motion.pieces[0].clip.rstrip("0123456789-"))
    assert begins == {"walk", "slow"}
