"""AudioJudge: candidates for one song, scored by the sanity suite and by the song's beats.

Terms, both in [0, 1]:
- sanity: mean margin of the suite's checks (`src.shared.validation.margins`).
- beats: mean of both directions of beat alignment; left out where the song has no known beat.

Letters: N candidates, T frames, M beats.
"""

from collections.abc import Sequence

import numpy as np

from ..data.pairing.motion_beats import alignment, motion_beats
from ..motion.trajectory import MotionTrajectory
from ..validation.bands import Bands
from ..validation.margins import mean_margin
from ..validation.sanity import SanityChecker
from .selection import ScoreTable, SelectionConfig, distances, rank

SCALE = 2.0  # metres between paths that count as far apart
AHEAD = 1.0  # metres: two motions on one path that face apart are apart as well


class AudioJudge:
    """Scores candidates for a song.

    Args:
        bands: of real motions, usually `bands.json` beside the weights; None = built-in bounds.
        config: weights.
    """

    def __init__(self, bands: Bands | None = None, config: SelectionConfig | None = None) -> None:
        self.checker, self.config = SanityChecker(bands=bands), config or SelectionConfig()

    def judge(
        self, candidates: Sequence[MotionTrajectory], beats: np.ndarray | None = None
    ) -> ScoreTable:
        """Rank trajectories of equal length made for one song.

        Args:
            candidates: N ≥ 1 as the decoder gave them, T frames each.
            beats: seconds [M], ascending; None or none at all = unknown.
        """
        outcomes = [list(self.checker.check_all(c)[1].values()) for c in candidates]
        failed = np.array([sum(not result.passed for result in results) for results in outcomes])
        terms = {"sanity": np.array([mean_margin(results) for results in outcomes])}
        if beats is not None and len(beats):
            terms["beats"] = np.array([on_the_beat(c, beats) for c in candidates])
        points = np.stack([_points(candidate) for candidate in candidates])
        return rank(terms, failed, distances(points, SCALE), self.config)


def on_the_beat(trajectory: MotionTrajectory, beats: np.ndarray) -> float:
    """Mean of both directions of beat alignment, in [0, 1]; 0 for a motion without beats."""
    times = motion_beats(trajectory.position, trajectory.fps).times
    both = alignment(times, beats, trajectory.seconds)
    return float(np.nan_to_num([both.motion_to_music, both.music_to_motion]).mean())


def _points(trajectory: MotionTrajectory) -> np.ndarray:
    """The pelvis and a point ahead of it, [T,2,3]."""
    heading = trajectory.heading
    ahead = np.stack([np.sin(heading), np.zeros_like(heading), np.cos(heading)], axis=1)
    return np.stack([trajectory.position, trajectory.position + AHEAD * ahead], axis=1)
