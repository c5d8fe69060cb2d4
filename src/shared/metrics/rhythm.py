"""Does a motion keep a song's time? Motion beats, phase errors on the circle, beats on beats.

A motion beat is a prominent minimum of the smoothed speed, the kinematic beat of Li et al. 2021
("AI Choreographer", §5.2). Alignment uses σ in seconds and both directions, each with the level
that the same beats reach by chance. A path that slows down on every beat lends its beats to
whatever it carries, a statue too: so limbs are also looked at from the pelvis, where a carried
statue rests.

Times in seconds, phases in bars or beats, unwrapped or not: only the part after the point counts.

Letters: T frames, K joints, N motion beats, M music beats.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..motion.filters import smoothed
from ..motion.motion import Motion
from ..motion.skeleton import REST_FOOT_HEIGHT
from .physical import BALLS

SMOOTHING = 0.05  # seconds, standard deviation of the Gaussian
PROMINENCE = 0.15  # of the 5-95% spread of the speed around its trend
TREND = 0.5  # seconds, standard deviation; walking and running in one phrase are no beat
MIN_PROMINENCE = 0.04  # m/s; a slow drift has no beats
MIN_INTERVAL = 0.2  # seconds between two beats
SIGMA = 0.05  # seconds, of the alignment


@dataclass(frozen=True, eq=False)
class MotionBeats:
    """Beats of one motion."""

    times: np.ndarray  # seconds [N], increasing
    # smoothed speed [T-1] in m/s they were found in; value t lies at (t + ½) / fps
    speed: np.ndarray

    @property
    def period(self) -> float:
        """Median interval in seconds; infinite below three beats."""
        return float(np.median(np.diff(self.times))) if len(self.times) > 2 else float("inf")


def smoothed_speed(points: np.ndarray, fps: float) -> np.ndarray:
    """Speed [T-1] in m/s of one point [T,3], or the mean over many [T,J,3]."""
    step = np.linalg.norm(np.diff(points.astype(np.float64), axis=0), axis=-1) * fps
    speed = step if step.ndim == 1 else step.mean(1)
    return smoothed(speed, SMOOTHING * fps, mode="symmetric") if len(speed) else speed


def motion_beats(points: np.ndarray, fps: float = 30.0) -> MotionBeats:
    """Beats of a pelvis path [T,3], or of a whole body's joints [T,J,3], in metres; placed between
    frames by a parabola through the minimum's three samples."""
    from scipy.signal import find_peaks  # takes a second, and a prompt has no beats

    speed = smoothed_speed(points, fps)
    if len(speed) < 3:
        return MotionBeats(np.zeros(0), speed)
    low, high = np.percentile(speed - smoothed(speed, TREND * fps, mode="symmetric"), (5, 95))
    found, _ = find_peaks(
        -speed,
        prominence=max(PROMINENCE * (high - low), MIN_PROMINENCE),
        distance=max(1, round(MIN_INTERVAL * fps)),
    )
    before, at, after = speed[found - 1], speed[found], speed[found + 1]
    curvature = before - 2 * at + after
    shift = np.where(curvature > 0, 0.5 * (before - after) / np.maximum(curvature, 1e-12), 0.0)
    return MotionBeats((found + 0.5 + np.clip(shift, -0.5, 0.5)) / fps, speed)


def distances(beats: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Seconds [N] from each of `beats` [N] to the nearest of `others` [M], sorted, M ≥ 1."""
    right = np.clip(np.searchsorted(others, beats), 1, max(1, len(others) - 1))
    before, after = others[right - 1], others[np.minimum(right, len(others) - 1)]
    return np.asarray(np.minimum(np.abs(beats - before), np.abs(after - beats)))


def beat_alignment(beats: np.ndarray, others: np.ndarray) -> float:
    """Mean over `beats` of exp(-d²/2σ²), d the distance to the nearest of `others`; NaN without
    `beats`, 0 without `others`."""
    if not len(beats):
        return float("nan")
    if not len(others):
        return 0.0
    return float(np.exp(-(distances(beats, others) ** 2) / (2 * SIGMA**2)).mean())


@dataclass(frozen=True)
class Alignment:
    """Both directions of beat alignment, in [0, 1]."""

    motion_to_music: float
    music_to_motion: float


def alignment(motion: np.ndarray, music: np.ndarray, seconds: float) -> Alignment:
    """How the motion's beats and the music's fall on each other within [0, seconds]; those beyond
    count as neighbours, never as beats of their own."""
    return Alignment(
        beat_alignment(_inside(motion, seconds), music),
        beat_alignment(_inside(music, seconds), motion),
    )


def _inside(beats: np.ndarray, seconds: float) -> np.ndarray:
    """Those in [0, seconds)."""
    return beats[(beats >= 0) & (beats < seconds)]


def turned_round(
    motion: np.ndarray, seconds: float, rng: np.random.Generator, n: int
) -> Iterator[np.ndarray]:
    """Chance: the motion's beats moved by a random time, `n` times, round within the song, so that
    their number and spacing stay."""
    for shift in (np.arange(n) + rng.random(n)) * (seconds / n):
        yield np.sort((motion + shift) % seconds)


def chance_alignment(
    motion: np.ndarray, music: np.ndarray, seconds: float, rng: np.random.Generator, *, n: int = 16
) -> Alignment:
    """What the same motion reaches when it is turned round, mean of `n`."""
    draws = [alignment(each, music, seconds) for each in turned_round(motion, seconds, rng, n)]
    return Alignment(
        float(np.mean([draw.motion_to_music for draw in draws])),
        float(np.mean([draw.music_to_motion for draw in draws])),
    )


# ---------------------------------------------------------------- phase


def circular_error(phase: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """How far each phase [T] is ahead of the truth [T], the shorter way round: [-0.5, 0.5)."""
    difference = np.asarray(phase, np.float64) - np.asarray(truth, np.float64)
    return (difference + 0.5) % 1.0 - 0.5


@dataclass(frozen=True)
class PhaseError:
    """Errors of one song, in cycles."""

    absolute: float  # mean |error|; guessing scores 0.25, always half a cycle off 0.5
    offset: float  # circular mean of the error, ahead of the truth is positive
    concentration: float  # length of the mean vector [0, 1]; 1 = the same offset all the time


def phase_error(phase: np.ndarray, truth: np.ndarray) -> PhaseError:
    """Compare phases [T] of at least one frame, both in the same cycles (Fisher 1993, §2.3). The
    offset of errors that cancel out is noise: look at the concentration first."""
    error = circular_error(phase, truth)
    mean = np.exp(2j * np.pi * error).mean()
    return PhaseError(
        float(np.abs(error).mean()), float(np.angle(mean) / (2 * np.pi)), float(np.abs(mean))
    )


def song_phase(
    beats: np.ndarray,
    bars: np.ndarray,
    true_bars: np.ndarray,
    meter: int,
    times: np.ndarray,
    fps: float = 30.0,
) -> dict[str, float]:
    """Errors of one song, counted from its first true beat to its last.

    Args:
        beats, bars: what the motion counts, unwrapped [T].
        true_bars: [T]; at least two beats lie inside.
        meter: beats a true bar.
        times: of the true beats, seconds.

    Returns:
        beat and bar: mean |error| in cycles; beat_seconds: in seconds; beat_offset: signed, in
        cycles of a beat; steady: concentration of the beat's error.
    """
    at = np.arange(min(len(bars), len(true_bars))) / fps
    inside = np.flatnonzero((at >= times[0]) & (at <= times[-1]))
    true_beats = true_bars[inside] * meter
    beat = phase_error(beats[inside], true_beats)
    period = (at[inside][-1] - at[inside][0]) / (true_beats[-1] - true_beats[0])
    return {
        "beat": beat.absolute,
        "bar": phase_error(bars[inside], true_bars[inside]).absolute,
        "beat_seconds": float(beat.absolute * period),
        "beat_offset": beat.offset,
        "steady": beat.concentration,
    }


def beats_of_phase(beats: np.ndarray, fps: float = 30.0) -> np.ndarray:
    """Times [M] at which an unwrapped, rising phase [T] in beats passes whole numbers."""
    numbers = np.arange(np.ceil(beats[0]), np.floor(beats[-1]) + 1)
    return np.interp(numbers, beats, np.arange(len(beats))) / fps


# ---------------------------------------------------------------- beats on beats


@dataclass(frozen=True)
class Rhythm:
    """How a motion's beats and a song's fall on each other; all but `distance` in [0, 1]."""

    motion_to_music: float  # mean over motion beats of exp(-d²/2σ²), σ = 0.05 s; 0 without any
    music_to_motion: float  # mean over music beats; a dance on every second beat gets half
    f: float  # harmonic mean of the two
    hits: float  # F-measure of matches one to one within 70 ms
    distance: float  # median seconds from a motion beat to the nearest music beat, NaN without any


HIT = 0.07  # seconds, the window of the F-measure in beat tracking (Davies et al. 2009)
OFFSETS = 16  # random times a motion, for the floor
COLUMNS = ("motion_to_music", "music_to_motion", "f", "hits", "distance")


def rhythm(motion: np.ndarray, music: np.ndarray, seconds: float) -> Rhythm:
    """Score motion beats [N] against music beats [M], both ascending, within [0, seconds); those
    outside are neighbours alone. Without beats, never slowing down, a motion scores 0.
    Raises ValueError: a time is NaN or infinite."""
    if not (np.isfinite(motion).all() and np.isfinite(music).all()):
        raise ValueError("beat times hold NaN or infinity")
    made, heard = _inside(motion, seconds), _inside(music, seconds)
    forth, back, f = _both_ways(made, heard, motion, music)
    near = len(made) and len(music)
    distance = float(np.median(distances(made, music))) if near else float("nan")
    return Rhythm(forth, back, f, hit_f_measure(heard, made), distance)


def rhythm_f(motion: np.ndarray, music: np.ndarray, seconds: float) -> float:
    """The F of `rhythm` alone, of times that are finite."""
    return _both_ways(_inside(motion, seconds), _inside(music, seconds), motion, music)[-1]


def _both_ways(
    made: np.ndarray, heard: np.ndarray, motion: np.ndarray, music: np.ndarray
) -> tuple[float, float, float]:
    """Motion to music, music to motion, and F of both."""
    forth = beat_alignment(made, music) if len(made) else 0.0
    back = beat_alignment(heard, motion) if len(heard) else 0.0
    return forth, back, 2 * forth * back / (forth + back) if forth + back else 0.0


def hit_f_measure(reference: np.ndarray, estimate: np.ndarray) -> float:
    """F-measure of beats matched one to one within 70 ms, both ascending: on a line the earliest
    pair that fits gives a largest matching."""
    if not len(reference) or not len(estimate):
        return 0.0
    matched = i = k = 0
    while i < len(reference) and k < len(estimate):
        apart = estimate[k] - reference[i]
        if abs(apart) <= HIT:
            matched, i, k = matched + 1, i + 1, k + 1
        elif apart < 0:
            k += 1
        else:
            i += 1
    return 2 * matched / (len(reference) + len(estimate))


# ---------------------------------------------------------------- what it is held against


def half_beat_later(beats: np.ndarray) -> np.ndarray:
    """The off-beats [M+1] around beats [M]: middles, and one beyond each end; none below 2."""
    if len(beats) < 2:
        return np.zeros(0)
    middles = (beats[1:] + beats[:-1]) / 2
    first = beats[0] - (beats[1] - beats[0]) / 2
    last = beats[-1] + (beats[-1] - beats[-2]) / 2
    return np.concatenate(([first], middles, [last]))


def against_chance(
    motion: np.ndarray, music: np.ndarray, seconds: float, rng: np.random.Generator
) -> tuple[Rhythm, Rhythm, Rhythm]:
    """A motion's beats on the music's, by chance (the mean over `OFFSETS` random times that it is
    turned round by), and on the off-beats; see `rhythm`."""
    inside = _inside(motion, seconds)
    turned = [rhythm(each, music, seconds) for each in turned_round(inside, seconds, rng, OFFSETS)]
    own, off = rhythm(motion, music, seconds), rhythm(motion, half_beat_later(music), seconds)
    return own, mean_rhythm(turned), off


def strangers(number: int, rng: np.random.Generator) -> list[int]:
    """For each of `number` motions another one: a single cycle, so nobody keeps its own song."""
    order, other = rng.permutation(number), np.zeros(number, dtype=int)
    other[order] = np.roll(order, 1)
    return other.tolist()


def mean_rhythm(scores: list[Rhythm]) -> Rhythm:
    """The mean of each column over at least one score; distances that are NaN are left out."""
    table = np.ma.masked_invalid([[getattr(score, name) for name in COLUMNS] for score in scores])
    return Rhythm(*table.mean(0).filled(np.nan).tolist())


# ---------------------------------------------------------------- when a whole body dances

DOWN, UP = 0.02, 0.04  # metres of a ball of the foot above its standing height


def body_beats(motion: Motion) -> np.ndarray:
    """Seconds [N] of the beats of all joints' mean speed."""
    return motion_beats(motion.positions(), motion.fps).times


def limb_beats(motion: Motion) -> np.ndarray:
    """Seconds [N] of the beats of the joints as seen from the pelvis."""
    return motion_beats(seen_from_pelvis(motion), motion.fps).times


def seen_from_pelvis(motion: Motion) -> np.ndarray:
    """Joint positions [T,21,3] in metres in the frame of the pelvis, place and rotation."""
    positions = motion.positions().astype(np.float64)
    pelvis = motion.global_rotations()[:, 0].astype(np.float64)  # T 3 3
    return np.asarray(np.einsum("tji,tkj->tki", pelvis, positions[:, 1:] - positions[:, :1]))


def landings(motion: Motion) -> np.ndarray:
    """Seconds [N] at which a foot comes down: it is within 2 cm of the floor after having been
    4 cm above it. Sliding feet never land."""
    heights = motion.positions()[:, BALLS, 1] - REST_FOOT_HEIGHT  # T 2
    found: list[float] = []
    for height in heights.T:
        away = False
        for frame, value in enumerate(height):
            if away and value < DOWN:
                found.append(frame / motion.fps)
                away = False
            away = away or value > UP
    return np.array(sorted(found))
