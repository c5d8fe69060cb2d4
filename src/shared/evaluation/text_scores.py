"""What a reader of the text tables asks first: each row against real and chance."""

from collections.abc import Sequence

from ..metrics.retrieval import normalised_score
from .families import Column
from .grids import Grid, GridRow, plain

RATIOS = ("contact_slide", "support_slide", "jerk", "hand_jerk", "speed", "diversity")


def score_grid(split: str, grids: Sequence[Grid], names: Sequence[str]) -> Grid:
    """What a reader asks first: each row against real and chance."""
    by_row = {name: scores(grids, name) for name in names}
    keys = next(iter(by_row.values()))
    columns = tuple(Column(key, key.replace("_", " ")) for key in keys)
    rows = {name: GridRow(plain(values)) for name, values in by_row.items()}
    note = (
        "normalised: (row - chance) / (real - chance). joint ratio: joint FD over that of real"
        " motions under shuffled labels; tag ratio: FD by tag over FD by wrong tag; the others:"
        " row over real. Real motion is 1 (near 0 in joint and tag ratio); chance is 0 where"
        " normalised, 1 in the joint ratio. Of the tables above, where the intervals are."
    )
    return Grid(f"{split}/scores", f"{split}: against real and chance", columns, rows, note)


def scores(grids: Sequence[Grid], name: str) -> dict[str, float]:
    """Row `name` against real and chance; NaN where a column is missing."""

    def value(row: str, column: str) -> float:
        known = [grid.value(row, column) for grid in grids]
        return next((each for each in known if each == each), float("nan"))

    def over(numerator: float, denominator: float) -> float:
        return numerator / denominator if denominator > 1e-9 else float("nan")

    result = {
        f"normalised_r_at_{k}": normalised_score(
            value(name, f"r_at_{k}"), value("chance", f"r_at_{k}"), value("real", f"r_at_{k}")
        )
        for k in (1, 2, 3)
    }
    joint, wrong_tag = value("chance", "frechet_joint"), value(name, "frechet_by_wrong_tag")
    result["frechet_joint_ratio"] = over(value(name, "frechet_joint"), joint)
    result["frechet_tag_ratio"] = over(value(name, "frechet_by_tag"), wrong_tag)
    for column in RATIOS:
        result[f"{column}_ratio"] = over(value(name, column), value("real", column))
    return result
