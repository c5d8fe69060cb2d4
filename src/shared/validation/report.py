"""The suite over many motions: a row of pass rates a group, real and frozen beside ours."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..motion.trajectory import MotionTrajectory
from .measures import MEASURES
from .sanity import SEVEN, SanityChecker


def frozen(trajectory: MotionTrajectory) -> MotionTrajectory:
    """The first pose held while the music goes on: a row that must fail."""
    still = trajectory.data[:1]
    columns = MotionTrajectory(still, trajectory.fps)
    length = (trajectory.num_frames, 1)
    return MotionTrajectory.from_pose(
        np.tile(columns.position, length),
        np.tile(columns.quaternion, length),
        trajectory.phase_unwrapped,
        trajectory.style,
        fps=trajectory.fps,
    )


def sanity_row(
    name: str, trajectories: Iterable[MotionTrajectory], checker: SanityChecker
) -> dict[str, Any]:
    """One group of motions through the suite, as plain values for JSON.

    Returns:
        name, motions, passed (whole suite), passed_seven, rate; checks: for each check its number
        passed and the mean of its value, None where that is not finite; inside: for each of
        `MEASURES` the share of motions between the 5th and 95th percentile of real ones, with
        bands only; failures: for each failed motion its index and the names of what failed.
    """
    motions = list(trajectories)
    outcomes = [checker.check_all(motion) for motion in motions]
    checks = {
        key: {
            "passed": sum(results[key].passed for _, results in outcomes),
            "mean": _finite_mean([results[key].value for _, results in outcomes]),
        }
        for key in (outcomes[0][1] if outcomes else {})
    }
    seven = sum(all(results[key].passed for key in SEVEN) for _, results in outcomes)
    passed = sum(good for good, _ in outcomes)
    return {
        "name": name,
        "motions": len(motions),
        "passed": passed,
        "passed_seven": seven,
        "rate": passed / len(motions) if motions else None,
        "checks": checks,
        "inside": _inside(motions, checker),
        "failures": [
            {"index": index, "failed": [r.name for r in results.values() if not r.passed]}
            for index, (good, results) in enumerate(outcomes)
            if not good
        ],
    }


def _finite_mean(values: Sequence[float | tuple[float, float]]) -> float | None:
    mean = float(np.mean(values))
    return mean if np.isfinite(mean) else None


def _inside(motions: Sequence[MotionTrajectory], checker: SanityChecker) -> dict[str, float]:
    if checker.bands is None or not motions:
        return {}
    rows = [checker.bands.inside(motion) for motion in motions]
    return {
        name: float(np.mean([row[name] for row in rows])) for name in MEASURES if name in rows[0]
    }
