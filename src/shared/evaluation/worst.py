"""Motions to be looked at, worst first: kept as files of the report folder, with their figures.

Letters: N motions of a sample.
"""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, Generic

import numpy as np

from ..formats.arrays import write_npz, write_trajectory_npz
from .families import DanceSample, MetricFamily, MotionSample, Sample
from .grids import plain

FOLDER = "samples"


class Keeper(Generic[Sample]):
    """Writes the worst motions of a bench; called by the engine, see `Bench.keep`.

    Args:
        folder: of the report; None = nothing is kept.
        bench: begins the names of the files.
        num: motions to keep.
        families: whose one-a-motion figures are shown.
        write: writes row i of a sample to a path, and returns what else there is to say of it:
            its title, and files beside it.
    """

    def __init__(
        self,
        folder: Path | None,
        bench: str,
        num: int,
        families: Iterable[MetricFamily[Sample]],
        write: Callable[[Sample, int, Path], dict[str, Any]],
    ) -> None:
        self.folder, self.bench, self.num = folder, bench, num
        self.write: Callable[[Sample, int, Path], dict[str, Any]] = write
        self.columns = [c for family in families for c in family.columns if c.better != "real"]

    def __call__(
        self, sample: Sample, order: list[int], values: Mapping[str, np.ndarray]
    ) -> list[dict[str, Any]]:
        """What the report says of each motion kept: file, title, rank, of, figures."""
        if self.folder is None:
            return []
        kept = []
        for rank, row in enumerate(order[: self.num], start=1):
            name = f"{FOLDER}/{self.bench}-{rank:02d}.npz"
            told = self.write(sample, row, self.folder / name)
            figures = {
                column.key: plain(float(f"{values[column.key][row]:.6g}"))
                for column in self.columns
                if column.key in values
            }
            place = {"rank": rank, "of": len(order), "bench": self.bench}
            kept.append({"file": name, "figures": figures, **told, **place})
        return kept


def write_motion(sample: MotionSample, row: int, path: Path) -> dict[str, Any]:
    """A motion of the text branch; its title is the caption."""
    write_npz(sample.clips.motions[row], path)
    return {"title": sample.clips.captions[row]}


def write_dance(sample: DanceSample, row: int, path: Path) -> dict[str, Any]:
    """A trajectory of the audio branch; its title is the song."""
    dance = sample.dances[row]
    write_trajectory_npz(dance.trajectory, path)
    return {"title": dance.song, "meter": dance.counted}
