"""What real motions measure: the 5th to 95th percentile of each figure, stored as JSON."""

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ..errors import UserError
from ..files import load_json, write_json
from ..motion.trajectory import MotionTrajectory
from .checks import CHECKS
from .measures import MEASURES

FORMAT_VERSION = 1
SLACK = 3.0  # a factor beyond the band at both ends that still passes


@dataclass(frozen=True)
class Band:
    """One figure over a set of real motions.

    Attributes:
        low: 5th percentile.
        median: 50th.
        high: 95th.
    """

    low: float
    median: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies between the 5th and the 95th percentile."""
        return self.low <= value <= self.high

    @property
    def limits(self) -> tuple[float, float]:
        """The band with `SLACK` at both ends, which nearly all real motion keeps to.

        One real motion in ten lies outside each band itself, so a verdict on one motion cannot
        ask for that.
        """
        return self.low / SLACK, self.high * SLACK

    def tolerates(self, value: float) -> bool:
        """Whether a value lies within `limits`."""
        return self.limits[0] <= value <= self.limits[1]


@dataclass(frozen=True)
class Bands:
    """Bands of the seven checks and of `MEASURES`, by name, and how many motions they stem from."""

    bands: dict[str, Band]
    motions: int

    @classmethod
    def of(cls, trajectories: Iterable[MotionTrajectory]) -> "Bands":
        """Measure real motions.

        Raises:
            UserError: there are none.
        """
        rows = [_figures(trajectory) for trajectory in trajectories]
        if not rows:
            raise UserError("no real motions to measure; give at least one trajectory")
        table = {name: [row[name] for row in rows] for name in rows[0]}
        bands = {
            name: Band(*(float(value) for value in np.percentile(values, (5, 50, 95))))
            for name, values in table.items()
        }
        return cls(bands, len(rows))

    def save(self, path: str | Path) -> Path:
        """Write JSON.

        Raises:
            UserError: the file cannot be written.
        """
        content = {
            "format_version": FORMAT_VERSION,
            "motions": self.motions,
            "bands": {name: asdict(band) for name, band in self.bands.items()},
        }
        write_json(Path(path), content)
        return Path(path)

    @classmethod
    def load(cls, path: str | Path) -> "Bands":
        """Read what `save` wrote.

        Raises:
            UserError: the file is missing, damaged or not ours.
        """
        try:
            content = load_json(path)
            bands = {name: _band(cells) for name, cells in content["bands"].items()}
            return cls(bands, int(content["motions"]))
        except OSError as error:
            raise UserError(
                f"{path}: cannot be read: {error.strerror or error}; name a file that may be read"
            ) from error
        except (ValueError, OverflowError, KeyError, TypeError, AttributeError) as error:
            raise UserError(
                f"{path}: is not a file of bands ({type(error).__name__}: {error}); "
                "prepare the data again"
            ) from error

    def inside(self, trajectory: MotionTrajectory) -> dict[str, bool]:
        """For each of `MEASURES`: does this motion lie between the 5th and 95th percentile?"""
        return {
            name: self.bands[name].holds(measure(trajectory))
            for name, measure in MEASURES.items()
            if name in self.bands
        }


def _figures(trajectory: MotionTrajectory) -> dict[str, float]:
    """Every figure of one motion by name."""
    values = {name: check(trajectory) for name, check in CHECKS.items()}
    return values | {name: measure(trajectory) for name, measure in MEASURES.items()}


def _band(cells: dict[str, float]) -> Band:
    band = Band(float(cells["low"]), float(cells["median"]), float(cells["high"]))
    if not all(math.isfinite(value) for value in (band.low, band.median, band.high)):
        raise ValueError("a band is not finite")
    return band
