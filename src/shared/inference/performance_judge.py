"""PerformanceJudge: dances to one song, scored by body, words, music and path together.

Terms, all in [0, 1]: those of `TextJudge` (similarity over windows, feet, smoothness), `beats` of
the whole body, and the path's `sanity` as `AudioJudge` measures it.

Letters: N candidates, T frames, K joints, D width of the shared space, M beats.
"""

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

from ..data.pairing.motion_beats import (
    Alignment,
    alignment,
    chance_alignment,
    motion_beats,
)
from ..motion.motion import Motion
from ..motion.root_track import encode_features
from ..motion.trajectory import MotionTrajectory
from ..validation.bands import Bands
from .audio_judge import AudioJudge
from .performer import Performance
from .selection import ScoreTable, SelectionConfig, distances, rank
from .text_judge import SCALE, TextJudge, Tower

WINDOW = 150  # frames that the motion tower sees at once: it learned from six seconds at most


class PerformanceJudge:
    """Scores dances to a song.

    Args:
        bands: of real paths, usually `bands.json` beside the audio weights; None = built-in bounds.
        tower: motions into the space of the generator's text tower; None = no similarity.
        config: weights.
    """

    def __init__(
        self,
        bands: Bands | None = None,
        tower: Tower | None = None,
        config: SelectionConfig | None = None,
    ) -> None:
        self.config = config or SelectionConfig()
        self.paths, self.bodies = AudioJudge(bands), TextJudge()
        self.tower = tower

    def judge(
        self,
        candidates: Sequence[Performance],
        raw: Sequence[MotionTrajectory],
        prompts: Sequence[Tensor],
        beats: np.ndarray | None = None,
    ) -> ScoreTable:
        """Rank dances of equal length.

        Args:
            candidates: N ≥ 1.
            raw: their paths before post-processing, which would hide what the suite looks for.
            prompts: [P,D] for each candidate, one embedding a passage, unit-norm.
            beats: seconds [M], ascending; None or none at all = unknown.
        """
        motions = [candidate.motion for candidate in candidates]
        body = self.bodies.judge(motions, torch.zeros(1))
        path = self.paths.judge(raw)
        terms = body.terms | path.terms
        if beats is not None and len(beats):
            both = [body_alignment(motion, beats) for motion in motions]
            means = [(each.motion_to_music + each.music_to_motion) / 2 for each in both]
            terms["beats"] = np.nan_to_num(means)
        if self.tower is not None:
            found = [
                _similarity(self.tower, candidate, each)
                for candidate, each in zip(candidates, prompts, strict=True)
            ]
            terms = {"similarity": np.array(found)} | terms
        points = np.stack([motion.positions() for motion in motions])
        return rank(terms, body.failed + path.failed, distances(points, SCALE), self.config)


def body_alignment(motion: Motion, beats: np.ndarray) -> Alignment:
    """How the beats of all joints' mean speed and a song's [M] fall on each other."""
    times = motion_beats(motion.positions(), motion.fps).times
    return alignment(times, beats, motion.seconds)


def beat_report(motion: Motion, beats: np.ndarray) -> dict[str, float]:
    """Both directions of alignment with beats [M], and their mean when the motion is turned round
    by a random time: chance."""
    times = motion_beats(motion.positions(), motion.fps).times
    rng = np.random.default_rng(0)
    own = alignment(times, beats, motion.seconds)
    chance = chance_alignment(times, beats, motion.seconds, rng)
    both = {"motion-to-music": own.motion_to_music, "music-to-motion": own.music_to_motion}
    both["chance"] = (chance.motion_to_music + chance.music_to_motion) / 2
    return {name: round(float(np.nan_to_num(value)), 4) for name, value in both.items()}


@torch.inference_mode()
def _similarity(tower: Tower, performance: Performance, prompts: Tensor) -> float:
    """Mean over windows of the cosine of what is seen and what was asked, not below 0."""
    features = encode_features(performance.motion)
    ends = np.cumsum([passage.frames for passage in performance.passages])
    cosines = []
    for start in range(0, max(1, len(features) - WINDOW // 2), WINDOW):
        window = features[start : start + WINDOW]
        asked = min(int(np.searchsorted(ends, start + len(window) // 2)), len(ends) - 1)
        cosines.append(float(tower(window[None])[0].cpu() @ prompts[asked].detach().float().cpu()))
    return float(np.clip(np.mean(cosines), 0, 1))
