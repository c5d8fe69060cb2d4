"""Figures: cut at counts, mirrored, kept in files, and those that are shipped."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.memory.figures import (
    CARD,
    SHIPPED,
    TAKES,
    FigureMemory,
    Take,
    find_counts,
    is_figure_memory,
)
from src.shared.memory.steps import LICENCE, STEPS, made_take
from src.shared.motion.skeleton import JOINT_INDEX, REST_FOOT_HEIGHT
from tests.shared.evaluation.dancers import hopping, swinging_arms
from tests.shared.memory.tiny_figures import stepping, tiny_figures


def test_figures_lie_between_counts_and_each_has_a_mirror_image() -> None:
    memory = tiny_figures()
    found = memory.figures(8)
    half = len(found) // 2
    assert half > 20 and not found.mirrored[:half].any() and found.mirrored[half:].all()
    own = memory.takes[0].counts
    first = found.times[found.take == 0][0]
    assert np.abs(first[:, None] - own).min(1).max() < 1e-9
    np.testing.assert_allclose(found.travel[:half, 0], -found.travel[half:, 0], atol=1e-9)
    np.testing.assert_allclose(found.turn[:half], -found.turn[half:], atol=1e-9)
    assert found.entry.shape == found.leave.shape
    assert (found.clear >= 0).all() and found.clear[found.take == 0].mean() > 0.6


def test_slow_takes_are_counted_twice_as_fast_too() -> None:
    found = tiny_figures().figures(8)
    paces = found.count[found.take == 2]
    assert paces.min() == pytest.approx(0.35, abs=0.03)
    assert paces.max() == pytest.approx(0.7, abs=0.03)


def test_short_takes_are_counted_at_several_paces() -> None:
    memory = FigureMemory([Take.of(stepping(0.5, 300), "short", "dance")])
    paces = [np.median(np.diff(counts)) for _, counts in memory.readings()]
    assert len(paces) > 2 and min(paces) < 0.45 and max(paces) >= 0.5


def test_who_floats_is_brought_down() -> None:
    lifted = stepping(0.5, bend=-0.12)
    take = Take.of(lifted, "x", "y")
    low = take.motion.positions()[..., 1].min(1)
    assert np.abs(low - REST_FOOT_HEIGHT).max() < 0.01
    assert take.motion.contacts.any()


def test_files_keep_what_was_saved(tmp_path: Path) -> None:
    memory = tiny_figures()
    memory.save(tmp_path / "figures")
    again = FigureMemory.open(tmp_path / "figures")
    assert is_figure_memory(tmp_path / "figures") and not is_figure_memory(tmp_path)
    for before, after in zip(memory.takes, again.takes, strict=True):
        assert (before.name, before.kind, before.licence) == (after.name, after.kind, "CC0")
        assert np.abs(before.motion.positions() - after.motion.positions()).max() < 2e-3
        np.testing.assert_array_equal(before.motion.contacts, after.motion.contacts)
        np.testing.assert_array_equal(before.counts, after.counts)


def test_a_damaged_memory_and_one_without_dance_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="holds no figures"):
        FigureMemory.open(tmp_path)
    folder = tmp_path / "figures"
    tiny_figures().save(folder)
    (folder / TAKES).write_bytes(b"PK")
    with pytest.raises(UserError, match="damaged"):
        FigureMemory.open(folder)
    (folder / CARD).write_text("{}")
    with pytest.raises(UserError, match="damaged"):
        FigureMemory.open(folder)
    with pytest.raises(UserError, match="five counts"):
        FigureMemory([Take.of(swinging_arms(frames=40), "short", "dance")])


def test_the_shipped_figures_are_free_small_and_of_several_kinds() -> None:
    assert sum(path.stat().st_size for path in SHIPPED.iterdir()) < 3_500_000
    memory = FigureMemory.open()
    assert {"salsa", "breakdance", "indian dance", "modern dance"} <= {t.kind for t in memory.takes}
    assert {take.licence for take in memory.takes} <= {"free for all uses", "CC0", LICENCE}
    assert all(take.source for take in memory.takes)
    assert "mocap.cs.cmu.edu" in (SHIPPED / "README.md").read_text()
    assert len(memory.figures(8)) > 1000
    assert {take.meter for take in memory.takes if take.kind == "waltz"} == {3}


def test_steps_begin_with_bars_and_are_counted_as_they_are() -> None:
    memory = FigureMemory([made_take(STEPS[0], 0.6), Take.of(swinging_arms(), "arms", "dance")])
    assert [which for which, _ in memory.readings()].count(0) == 1
    figures = memory.figures(4)
    own = figures.rows(np.flatnonzero(figures.take == 0))
    assert set(own.meter.tolist()) == {4} and set((own.number % 4).tolist()) == {0}
    assert set(figures.meter.tolist()) == {0, 4}


def test_metres_gone_backward_are_counted() -> None:
    motion = stepping(0.5)
    place = motion.root_position.copy()
    place[:, 2] -= 0.01 * np.arange(len(place))
    memory = FigureMemory([Take.of(replace(motion, root_position=place), "back", "dance")])
    figures = memory.figures(4)
    spans = figures.times[:, -1] - figures.times[:, 0]
    np.testing.assert_allclose(figures.back, 0.3 * spans, atol=0.06)


@pytest.mark.parametrize("angles", [[np.pi / 2], [0.08, -0.08]])  # radians in frame 300, 301
def test_where_a_joint_jumps_or_shakes_there_is_no_figure(angles: list[float]) -> None:
    whole = Take.of(stepping(0.5), "step", "salsa")
    turns = whole.motion.quaternions.copy()
    for frame, angle in enumerate(angles, 300):
        turns[frame, JOINT_INDEX["l_hip"]] = np.cos(angle / 2), np.sin(angle / 2), 0, 0
    torn = replace(whole, motion=replace(whole.motion, quaternions=turns))
    kept = FigureMemory([torn]).figures(8)
    beside = (kept.times[:, 0] < 10.3) & (kept.times[:, -1] > 9.7)
    assert len(kept) and not beside.any()
    assert len(kept) < len(FigureMemory([whole]).figures(8))


@pytest.mark.parametrize("period", [0.4, 0.5, 0.6])
@pytest.mark.parametrize("offset", [0.0, 0.2])
def test_counts_fall_where_a_dancer_slows_down(period: float, offset: float) -> None:
    counts = find_counts(swinging_arms(period, 300, offset))
    assert np.median(np.diff(counts)) == pytest.approx(period, abs=0.02)
    off = (counts - offset + period / 2) % period - period / 2
    assert np.abs(off).mean() < 0.05 and len(counts) > 0.7 * 10 / period


def test_a_short_or_still_motion_has_none() -> None:
    assert not len(find_counts(swinging_arms(0.5, 50)))
    assert not len(find_counts(hopping(height=0.0)))
