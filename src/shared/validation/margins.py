"""How far within its bounds a checked motion stays: pass and fail as a number in [0, 1].

The margin of a failed check is 0. Of a passed one:
- a figure with a band of real motions: 1 inside the band (5th to 95th percentile), falling with
  the logarithm to 0 at the limits (the band with its slack);
- jerk and roughness: 1 up to the 95th percentile of real motions, falling likewise to 0 at the
  bound. They must not go on rising below, or the tamest motion is the best;
- a figure below a bound of which no band is known, or that is 0 by right: 1 - value / bound;
- anything else: 1.
"""

import math
from collections.abc import Iterable

from .sanity import CheckResult

LIVELY = ("jerk", "roughness")
BELOW = (*LIVELY, "velocity_coherence", "accel_coherence")


def margin(result: CheckResult) -> float:
    """The margin of one check, in [0, 1]."""
    if not result.passed:
        return 0.0
    value, bound = result.value, result.threshold
    if result.name in BELOW:
        assert not isinstance(value, tuple) and not isinstance(bound, tuple)
        if result.band and result.name in LIVELY:
            return share(value, bound, result.band[1])
        return 1.0 - value / bound
    if result.name.startswith("band_"):
        assert not isinstance(value, tuple) and isinstance(bound, tuple) and result.band
        side = 0 if value < result.band[0] else 1
        return share(value, bound[side], result.band[side])
    return 1.0


def mean_margin(results: Iterable[CheckResult]) -> float:
    """Mean margin of one motion's checks, at least one."""
    margins = [margin(result) for result in results]
    return sum(margins) / len(margins)


def share(value: float, limit: float, edge: float) -> float:
    """1 at the edge of what real motion has and on its far side, 0 at the limit and beyond.

    Between them it falls with the logarithm. Limit and edge are above 0; any value will do.
    """
    if (value - edge) * (limit - edge) <= 0:
        return 1.0
    if (value - limit) * (limit - edge) >= 0:
        return 0.0
    return math.log(value / limit) / math.log(edge / limit)
