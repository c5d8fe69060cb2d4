"""Best of N on pools whose answer is known by construction."""

from dataclasses import asdict

import numpy as np
import pytest

from src.shared.evaluation.stats import replicated
from src.shared.evaluation.suites.selection import (
    Figure,
    Pool,
    choices,
    measured,
    report_of,
    selection_report,
    sizes,
)
from src.shared.evaluation.tables import tables

P, C, N = 400, 32, 8
OUTSIDE = Figure("quality", "quality", 3, True, "outside")
ERROR = Figure("error", "error", 3, False, "outside")
OWN = Figure("term", "term", 3, True, "judge")


def pool(listening: float) -> Pool:
    """The judge's score is so much quality and so much noise; the error is quality's opposite."""
    rng = np.random.default_rng(0)
    quality, noise = rng.normal(size=(2, P, C))
    score = listening * quality + (1 - listening**2) ** 0.5 * noise
    values = {"quality": quality, "error": -quality, "term": score}
    return Pool([OUTSIDE, ERROR, OWN], score, values, floors={"chance": {"quality": quality[:, 0]}})


def test_runs_of_candidates_give_every_choice_of_a_size() -> None:
    score = np.array([[3.0, 1, 2, 5, 9], [0, 1, 7, 2, 9]])
    assert [c.tolist() for c in choices(score, 1)] == [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]]
    assert [c.tolist() for c in choices(score, 2)] == [[0, 1], [3, 2]]
    assert [c.tolist() for c in choices(score, 4)] == [[3, 2]]
    assert sizes(8) == [1, 2, 4, 8] and sizes(6) == [1, 2, 4, 6] and sizes(1) == [1]


def test_the_best_of_one_is_the_mean_of_all() -> None:
    made = pool(0.5)
    subjects, whole = measured(made, choices(made.score, 1))
    quality = made.values["quality"]
    np.testing.assert_allclose(subjects["quality"], quality.mean(1))
    assert asdict(whole["quality"]) == pytest.approx(asdict(replicated(quality.mean(0).tolist())))


def test_what_was_not_asked_is_left_out() -> None:
    values = np.array([[1.0, np.nan], [np.nan, np.nan]])
    made = Pool([], np.zeros((2, 2)), {"obeys": values})
    subjects, whole = measured(made, choices(made.score, 2))
    np.testing.assert_array_equal(subjects["obeys"], [1.0, np.nan])
    assert whole["obeys"].value == 1.0


def test_a_judge_that_knows_gains_what_order_statistics_say() -> None:
    report = selection_report(pool(1.0), N)
    rows, gain = report["rows"], report["gains"]["quality"]
    assert rows["best of 8"]["quality"]["value"] == pytest.approx(1.4236, abs=0.1)  # E max of 8
    assert rows["best of 2"]["quality"]["value"] == pytest.approx(0.5642, abs=0.05)
    assert rows["worst of 8"]["quality"]["value"] == pytest.approx(-1.4236, abs=0.1)
    assert gain["apart"] and gain["better"]
    difference = rows["best of 8"]["quality"]["value"] - rows["best of 1"]["quality"]["value"]
    assert gain["difference"]["value"] == pytest.approx(difference)
    assert report["outside_apart"] == ["quality", "error"], "its own term does not count"


def test_a_deaf_judge_gains_nothing_but_its_own_term() -> None:
    report = selection_report(pool(0.0), N)
    assert report["outside_apart"] == []
    assert report["gains"]["term"]["apart"]
    difference = report["gains"]["quality"]["difference"]
    assert abs(difference["value"]) < 0.1


def test_figures_of_a_set_are_replicated() -> None:
    made = pool(1.0)
    quality, rows = made.values["quality"], np.arange(P)
    made = Pool(
        [Figure("mean", "mean", 3, True, "outside")],
        made.score,
        {},
        together=lambda chosen: {
            "mean": float(quality[rows, chosen].mean()),
            "same": quality[rows, chosen],
        },
        floors={"real": {"mean": 3.0}},
    )
    report = selection_report(made, N)
    cell, same = (report["rows"]["best of 8"][key] for key in ("mean", "same"))
    assert cell == pytest.approx(same) and cell["count"] == C // N
    assert report["rows"]["real"]["mean"]["value"] == 3.0
    assert report["outside_apart"] == ["mean"] and "difference" not in report["gains"]["mean"]


def test_one_replication_proves_nothing() -> None:
    report = selection_report(pool(1.0), C)
    assert report["gains"]["quality"]["better"] and not report["gains"]["quality"]["apart"]


def test_tables_part_what_counts_from_what_does_not() -> None:
    report = report_of(pool(1.0), N, "400 dice", {}, {})
    outside, own = tables(report)
    assert outside.header == ["row", "quality ↑", "error ↓"] and own.header == ["row", "term ↑"]
    assert [row[0] for row in outside.rows] == [
        "chance", "best of 1", "best of 2", "best of 4", "best of 8", "worst of 8",
        "best of 8 less best of 1",
    ]  # fmt: skip
    assert outside.rows[-1][1].endswith("*") and outside.rows[0][2] == "–"
    assert "400 dice" in outside.title and "replications" in outside.note
