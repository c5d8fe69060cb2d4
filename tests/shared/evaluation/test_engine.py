"""The engine on a bench whose figures are known: cells, halves, resuming, worst first."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.evaluation.engine import Bench, Row, estimate, motion_values, run_bench, worst_first
from src.shared.evaluation.manifest import Parts
from src.shared.evaluation.tables import Column, Grid
from tests.shared.evaluation.toy_bench import NUM, Heights, toy_bench


def run(folder: Path | None, replications: int = 3) -> dict[str, Grid]:
    bench = toy_bench()
    parts = Parts(folder)
    grids = run_bench(bench, parts, replications, 0, lambda text: None)
    return {grid.name: grid for grid in grids}


def test_cells_are_means_over_replications_and_over_motions() -> None:
    found = run(None)
    heights = found["toy/heights"]
    mean = heights.rows["generated"].cells["mean"]
    assert isinstance(mean, dict)
    assert mean["value"] == pytest.approx(0.55 + 0.6) and mean["count"] == 3
    assert mean["high"] - mean["value"] == pytest.approx(1.959964 * 0.1 / np.sqrt(3))
    each = heights.rows["generated"].cells["height"]
    assert isinstance(each, dict)
    assert each["value"] == pytest.approx(0.55 + 0.6) and each["count"] == NUM
    assert each["low"] < each["value"] < each["high"]
    runs = {name: row.replications for name, row in heights.rows.items()}
    assert runs == {"real": 3, "generated": 3, "untrained": 1}


def test_the_real_row_is_measured_between_two_halves_where_it_would_be_zero() -> None:
    found = run(None)
    assert found["toy/apart"].value("generated", "apart") == pytest.approx(0.6)
    assert 0 < found["toy/apart"].value("real", "apart") < 0.4


class Numbers:
    """Motions of a new kind: all that the engine asks of them."""

    def __init__(self, values: Sequence[float]) -> None:
        self.values = list(values)

    def __len__(self) -> int:
        return len(self.values)

    @property
    def asked(self) -> list[str]:
        return [str(number) for number in range(len(self))]

    def rows(self, index: Sequence[int]) -> "Numbers":
        return Numbers([self.values[i] for i in index])


class Size:
    """Its only family."""

    name, distance = "size", False
    columns = (Column("size", "size"),)
    definition = "The number itself."

    def compute(self, sample: Numbers, reference: Numbers, *, seed: int) -> dict[str, np.ndarray]:
        return {"size": np.array(sample.values)}


def test_another_kind_of_motion_needs_nothing_of_the_harness() -> None:
    real = Numbers([1.0, 2.0, 3.0])
    rows = [
        Row("real", lambda replication: real, real=True),
        Row("generated", lambda replication: Numbers([4.0, 5.0, 6.0])),
    ]
    bench = Bench("new", "new kind", lambda: real, rows, [Size()])
    (grid,) = run_bench(bench, Parts(None), 2, 0, lambda text: None)
    assert grid.value("real", "size") == 2 and grid.value("generated", "size") == 5


def test_a_finished_part_is_not_measured_again(tmp_path: Path) -> None:
    first = run(tmp_path, replications=1)
    bench, parts = toy_bench(), Parts(tmp_path)
    again = run_bench(bench, parts, 1, 0, lambda text: pytest.fail(text))
    heights = bench.families[0]
    assert isinstance(heights, Heights) and heights.calls == 0
    assert [grid.as_dict() for grid in again] == [grid.as_dict() for grid in first.values()]
    told: list[str] = []
    run_bench(bench, Parts(tmp_path), 2, 0, told.append)
    assert told == ["toy: real, 2 of 2", "toy: generated, 2 of 2"]


def test_whoever_stops_it_loses_only_the_part_in_hand(tmp_path: Path) -> None:
    bench = toy_bench()

    def stop(text: str) -> None:
        if text == "toy: generated, 2 of 3":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_bench(bench, Parts(tmp_path), 3, 0, stop)
    assert len(list((tmp_path / "parts").iterdir())) == 4
    whole = run(tmp_path / "whole")
    gone_on = run(tmp_path)
    assert [g.as_dict() for g in gone_on.values()] == [g.as_dict() for g in whole.values()]
    timing = json.loads((tmp_path / "timing.json").read_text())
    assert len(timing["seconds"]) == 7


def test_a_damaged_part_is_named(tmp_path: Path) -> None:
    run(tmp_path, replications=1)
    (tmp_path / "parts" / "toy.real.000.json").write_text("{")
    with pytest.raises(UserError, match=r"toy.real.000.json cannot be read.*delete it"):
        run(tmp_path, replications=1)


def test_the_worst_come_first_and_are_kept(tmp_path: Path) -> None:
    run(tmp_path, replications=1)
    part = json.loads((tmp_path / "parts" / "toy.generated.000.json").read_text())
    titles = [sample["title"] for sample in part["samples"]]
    assert titles == ["<b>11</b>", "<b>10</b>", "<b>9</b>"]  # low is good
    assert part["samples"][0]["figures"]["height"] == pytest.approx(1.6)
    assert (tmp_path / part["samples"][0]["file"]).is_file()


def test_a_motion_that_was_thrown_away_is_made_again(tmp_path: Path) -> None:
    run(tmp_path, replications=1)
    kept = tmp_path / "samples" / "toy-01.npz"
    before = kept.read_bytes()
    kept.unlink()
    run(tmp_path, replications=1)
    assert kept.read_bytes() == before


def test_ranks_share_ties_and_leave_gaps_in_the_middle() -> None:
    values = {"height": np.array([1.0, np.nan, 3.0, 1.0, 3.0])}
    assert worst_first([Heights()], values, 5) == [2, 4, 1, 0, 3]


def test_shares_have_wilson_intervals_and_others_a_bootstrap() -> None:
    parts = [{"num": 4, "figures": {}, "values": {"x": [0.0] * 4}}]
    share, other = (estimate(parts, Column("x", "x", share=yes)) for yes in (True, False))
    assert share is not None and other is not None
    assert (share.low, share.high) == pytest.approx((0.0, 0.4899), abs=1e-4)
    assert (other.low, other.high) == (0, 0)
    assert estimate(parts, Column("y", "y")) is None


def test_gaps_are_skipped() -> None:
    parts = [{"num": 3, "figures": {}, "values": {"x": [1.0, None, 0.5]}},
             {"num": 3, "figures": {}, "values": {"x": [0.0, None, None]}}]  # fmt: skip
    values = motion_values(parts, "x")
    assert values is not None
    np.testing.assert_array_equal(values, [0.5, np.nan, 0.5])
    assert motion_values(parts, "y") is None
