"""Best of N on pools whose answer is known by construction."""

import numpy as np
import pytest

from src.shared.evaluation.selection_harness import (
    Figure,
    Pool,
    choices,
    measured,
    report_of,
    selection_report,
    selection_tables,
)

P, N = 400, 8
OUTSIDE = Figure("quality", "quality", 3, True, "outside")
ERROR = Figure("error", "error", 3, False, "outside")
OWN = Figure("term", "term", 3, True, "judge")


def pool(listening: float) -> Pool:
    """The judge's score is so much quality and so much noise; the error is quality's opposite."""
    rng = np.random.default_rng(0)
    quality, noise = rng.normal(size=(2, P, N))
    score = listening * quality + (1 - listening**2) ** 0.5 * noise
    values = {"quality": quality, "error": -quality, "term": score}
    return Pool([OUTSIDE, ERROR, OWN], score, values, floors={"chance": {"quality": quality[:, 0]}})


def test_runs_of_candidates_give_every_choice_of_a_size() -> None:
    score = np.array([[3.0, 1, 2, 5, 9], [0, 1, 7, 2, 9]])
    assert [c.tolist() for c in choices(score, 1)] == [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]
    assert [c.tolist() for c in choices(score, 2)] == [[0, 1], [3, 2]]
    assert [c.tolist() for c in choices(score, 4)] == [[3, 2]]
    assert pool(1).sizes == [1, 2, 4, 8]


def test_the_best_of_one_is_the_mean_of_all() -> None:
    made = pool(0.5)
    found = measured(made, choices(made.score, 1))
    np.testing.assert_allclose(found["quality"], made.values["quality"].mean(1))


def test_what_was_not_asked_is_left_out() -> None:
    values = np.array([[1.0, np.nan], [np.nan, np.nan]])
    found = measured(Pool([], np.zeros((2, 2)), {"obeys": values}), choices(np.zeros((2, 2)), 1))
    np.testing.assert_array_equal(found["obeys"], [1.0, np.nan])


def test_a_judge_that_knows_gains_what_order_statistics_say() -> None:
    report = selection_report(pool(1.0))
    rows, gain = report["rows"], report["gains"]["quality"]
    assert rows["best of 8"]["quality"]["value"] == pytest.approx(1.4236, abs=0.1)  # E max of 8
    assert rows["best of 2"]["quality"]["value"] == pytest.approx(0.5642, abs=0.05)
    assert rows["worst of 8"]["quality"]["value"] == pytest.approx(-1.4236, abs=0.1)
    assert gain["apart"] and gain["better"]
    difference = rows["best of 8"]["quality"]["value"] - rows["best of 1"]["quality"]["value"]
    assert gain["difference"]["value"] == pytest.approx(difference)
    assert report["outside_apart"] == ["quality", "error"], "its own term does not count"


def test_a_deaf_judge_gains_nothing_but_its_own_term() -> None:
    report = selection_report(pool(0.0))
    assert report["outside_apart"] == []
    assert report["gains"]["term"]["apart"]
    difference = report["gains"]["quality"]["difference"]
    assert difference["low"] < 0 < difference["high"]


def test_figures_of_a_set_are_resampled_with_their_subjects() -> None:
    made = pool(1.0)
    quality = made.values["quality"]
    made = Pool(
        [Figure("mean", "mean", 3, True, "outside")],
        made.score,
        {},
        of_set=lambda rows, chosen: {"mean": float(quality[rows, chosen].mean())},
        together=lambda chosen: {"same": quality[np.arange(P), chosen]},
        set_floors={"real": {"mean": 3.0}},
        floors={"real": {}},
    )
    report = selection_report(made)
    cell, same = (report["rows"]["best of 8"][key] for key in ("mean", "same"))
    assert cell["value"] == pytest.approx(same["value"])
    assert cell["high"] - cell["low"] == pytest.approx(same["high"] - same["low"], rel=0.25)
    assert report["rows"]["real"]["mean"]["value"] == 3.0
    assert report["outside_apart"] == ["mean"] and "difference" not in report["gains"]["mean"]


def test_tables_part_what_counts_from_what_does_not() -> None:
    report = report_of(pool(1.0), "400 dice", {}, {}, 0)
    outside, own = selection_tables(report)
    assert outside.header == ["row", "quality ↑", "error ↓"] and own.header == ["row", "term ↑"]
    assert [row[0] for row in outside.rows] == [
        "chance", "best of 1", "best of 2", "best of 4", "best of 8", "worst of 8",
        "best of 8 less best of 1",
    ]  # fmt: skip
    assert outside.rows[-1][1].endswith("*") and outside.rows[0][2] == "–"
    assert "400 dice" in outside.title and "best of 8" in outside.note
