"""One phrase of music and a motion made for it: clips chosen by tempo, joined and warped.

Several motions are tried and the one whose beats fall best on the music's is kept.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...metrics.rhythm import Alignment, alignment, beat_alignment, chance_alignment, motion_beats
from ..prepared import SYNTHETIC
from .clip_library import FPS, Clip, Kind
from .phrase_motion import (
    LIMIT,
    MATCH_LIMIT,
    SPARE,
    PhraseMotion,
    Warp,
    assemble,
    fit_warp,
    match_beats,
    plain_warp,
    resample,
)

KINDS, TRIES = 3, 4  # kinds of motion tried, and times each
GOOD = 0.85  # a score that ends the search
FAIR = 0.7  # a kind of motion that stays below gives way to another
MIN_SCORE = 0.5  # a phrase below teaches the wrong thing
LEAD_BEATS = 1.25  # intervals of motion that may be skipped so that the first beat can meet one
MAX_LEAD = 1.5  # seconds
GROUP_SHARE = 0.25  # of phrases with a motion beat on strong beats only
LONG = 300  # frames; longer clips are not drawn more often
SYNTHETIC_WEIGHT = 0.4  # of the project's own motions against recorded ones


@dataclass(frozen=True, eq=False)
class MusicBeats:
    """Beats around a phrase, in its seconds: times [K], and which are strong [K] bool."""

    times: np.ndarray
    strong: np.ndarray

    def grids(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Where motion beats may fall: on every beat, on strong beats, on half beats too."""
        half = np.sort(np.concatenate((self.times, (self.times[1:] + self.times[:-1]) / 2)))
        return self.times, self.times[self.strong], half


def strong_beats(numbers: np.ndarray, meter: int) -> np.ndarray:
    """Which beats [K] bool open a group: every second of an even bar, every third of 3 and 6.

    Args:
        numbers: of the beats [K], counted from a downbeat.
        meter: beats a bar; of 5 and 7 only downbeats are strong.
    """
    group = 3 if meter in (3, 6) else 2 if meter % 2 == 0 else meter
    return np.asarray(numbers % group == 0)


@dataclass(frozen=True, eq=False)
class PhrasePair:
    """A motion that fits a phrase of music.

    Attributes:
        position, quaternion: pelvis [T+SPARE,3] and [T+SPARE,4] at 30 fps.
        motion: what it was made of.
        warp: which moment of the motion is seen when.
        before, after, chance: beat alignment as recorded, warped, and by chance.
        motion_beats: seconds of the phrase [N].
        coverage: how many beats it could meet are met, 0 to 1.
        matched: music beats that a motion beat was brought to.
    """

    position: np.ndarray
    quaternion: np.ndarray
    motion: PhraseMotion
    warp: Warp
    before: Alignment
    after: Alignment
    chance: Alignment
    motion_beats: np.ndarray
    coverage: float
    matched: int

    @property
    def score(self) -> float:
        """Geometric mean of motion to music alignment and coverage; 0 without motion beats."""
        return float(np.sqrt(np.nan_to_num(self.after.motion_to_music) * self.coverage))

    @property
    def seams(self) -> np.ndarray:
        """Frames of the phrase [S] where a seam's middle is seen."""
        at = np.arange(len(self.position)) / FPS
        seen = self.warp.times(at) * FPS
        inside = [seam for seam in self.motion.seams if seen[0] <= seam <= seen[-1]]
        return np.searchsorted(seen, inside)


def suitable_clips(clips: Sequence[Clip], interval: float) -> list[Clip]:
    """Clips whose motion beats can lie `interval` seconds apart within the warp's limit."""
    return [clip for clip in clips if abs(clip.period / interval - 1) <= MATCH_LIMIT]


def kind_weights(clips: Sequence[Clip]) -> dict[Kind, float]:
    """Probability of each kind of motion: the root of its seconds, fewer of the synthetic."""
    seconds: dict[Kind, float] = defaultdict(float)
    for clip in clips:
        seconds[clip.kind] += clip.num_frames / FPS
    weights = {
        kind: float(np.sqrt(total)) * (SYNTHETIC_WEIGHT if kind[0] == SYNTHETIC else 1.0)
        for kind, total in sorted(seconds.items())
    }
    return {kind: weight / sum(weights.values()) for kind, weight in weights.items()}


def pair_phrase(
    clips: Sequence[Clip],
    beats: MusicBeats,
    num_frames: int,
    rng: np.random.Generator,
) -> PhrasePair | None:
    """Make a motion for a phrase.

    What a phrase shows is drawn before it is tried, so that easy kinds of motion do not crowd
    out others: only where none of its tries reaches `FAIR` another kind is drawn.

    Args:
        clips: of the phrase's split.
        beats: of the music; neighbours beyond the phrase's ends are welcome.
        num_frames: T.
        rng: makes every choice.

    Returns:
        The best; None where there is no beat or no clip fits its tempo.
    """
    choices = _choices(clips, beats)
    best: PhrasePair | None = None
    for _ in range(KINDS if choices else 0):
        suitable, grid = choices[int(len(choices) > 1 and rng.random() < GROUP_SHARE)]
        weights = kind_weights(suitable)
        kind = list(weights)[int(rng.choice(len(weights), p=list(weights.values())))]
        for _ in range(TRIES):
            made = _warped(suitable, kind, grid, beats.times, num_frames, rng)
            if best is None or made.score > best.score:
                best = made
            if best.score >= GOOD:
                break
        if best is not None and best.score >= FAIR:
            break
    if best is None:
        return None
    chance = chance_alignment(best.motion_beats, beats.times, num_frames / FPS, rng)
    return replace(best, chance=chance)


def _choices(clips: Sequence[Clip], beats: MusicBeats) -> list[tuple[list[Clip], np.ndarray]]:
    """(clips, grid) on every beat and on strong beats; on half beats where there are neither.

    Two motion beats a music beat do not tell which of them is the beat: a last resort.
    """
    whole, strong, half = (
        (suitable_clips(clips, float(np.median(np.diff(grid)))) if len(grid) > 2 else [], grid)
        for grid in beats.grids()
    )
    found = [choice for choice in (whole, strong) if choice[0]]
    return found or ([half] if half[0] else [])


def _warped(
    clips: Sequence[Clip],
    kind: Kind,
    grid: np.ndarray,
    beats: np.ndarray,
    num_frames: int,
    rng: np.random.Generator,
) -> PhrasePair:
    """One try: assemble, match, warp.

    Args:
        clips: to join; the first is of `kind`.
        kind: what the phrase begins with; what follows is what fits at the seams.
        grid: where motion beats may fall [K], seconds.
        beats: all music beats, what alignment is measured with.
        num_frames: T.
        rng: makes every choice.
    """
    seconds = num_frames / FPS
    lead = min(LEAD_BEATS * float(np.median(np.diff(grid))), MAX_LEAD)
    shown = (num_frames + SPARE) / FPS
    needed = int(np.ceil((lead + shown * (1 + LIMIT)) * FPS)) + 2
    first = np.array([min(clip.num_frames, LONG) * (clip.kind == kind) for clip in clips])
    motion = assemble(clips, first / first.sum(), needed, rng)
    found = motion_beats(motion.position, FPS).times
    pairs = match_beats(found, grid, seconds, lead)
    warp = fit_warp(
        np.array([found[i] for i, _ in pairs]), np.array([grid[k] for _, k in pairs]), shown, lead
    )
    at = np.arange(num_frames + SPARE) / FPS
    position, quaternion = resample(motion.position, motion.quaternion, warp.times(at), FPS)
    raw, _ = resample(
        motion.position, motion.quaternion, plain_warp(shown, warp.start).times(at), FPS
    )
    after = motion_beats(position, FPS).times
    return PhrasePair(
        position,
        quaternion,
        motion,
        warp,
        before=alignment(motion_beats(raw, FPS).times, beats, seconds),
        after=alignment(after, beats, seconds),
        chance=Alignment(0.0, 0.0),  # measured for the try that is kept
        motion_beats=after,
        coverage=beat_alignment(grid[(grid >= 0) & (grid < seconds)], after),
        matched=len(pairs),
    )
