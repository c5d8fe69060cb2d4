"""Does a motion keep a song's time? Phase errors on the circle, and beats that fall on beats.

Times in seconds, phases in bars or beats, unwrapped or not: only the part after the point counts.
Motion beats are those of `src.shared.data.pairing.motion_beats`, one definition everywhere.

Letters: T frames, N motion beats, M music beats.
"""

from collections.abc import Iterator
from dataclasses import asdict, dataclass

import numpy as np

from ..data.pairing.motion_beats import SIGMA, beat_alignment, distances

HIT = 0.07  # seconds, the window of the F-measure in beat tracking (Davies et al. 2009)


# ---------------------------------------------------------------- phase


def circular_error(phase: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """How far each phase [T] is ahead of the truth [T], the shorter way round: [-0.5, 0.5)."""
    difference = np.asarray(phase, np.float64) - np.asarray(truth, np.float64)
    return (difference + 0.5) % 1.0 - 0.5


@dataclass(frozen=True)
class PhaseError:
    """Errors of one song, in cycles.

    Attributes:
        absolute: mean |error|; guessing scores 0.25, always half a cycle off 0.5.
        offset: circular mean of the error, ahead of the truth is positive.
        concentration: length of the mean vector [0, 1]; 1 = the same offset all the time.
    """

    absolute: float
    offset: float
    concentration: float


def phase_error(phase: np.ndarray, truth: np.ndarray) -> PhaseError:
    """Compare phases [T] of at least one frame, both in the same cycles.

    Circular statistics after Fisher 1993, §2.3. The offset of errors that cancel out is noise:
    look at the concentration first.
    """
    error = circular_error(phase, truth)
    mean = np.exp(2j * np.pi * error).mean()
    return PhaseError(
        float(np.abs(error).mean()), float(np.angle(mean) / (2 * np.pi)), float(np.abs(mean))
    )


def beats_of_phase(beats: np.ndarray, fps: float = 30.0) -> np.ndarray:
    """Times [M] at which an unwrapped, rising phase [T] in beats passes whole numbers."""
    numbers = np.arange(np.ceil(beats[0]), np.floor(beats[-1]) + 1)
    return np.interp(numbers, beats, np.arange(len(beats))) / fps


# ---------------------------------------------------------------- beats on beats


@dataclass(frozen=True)
class Rhythm:
    """How a motion's beats and a song's fall on each other; all but `distance` in [0, 1].

    Attributes:
        motion_to_music: mean over motion beats of exp(-d²/2σ²), σ = 0.05 s; 0 without any.
        music_to_motion: mean over music beats; a dance on every second beat gets half.
        f: harmonic mean of the two.
        hits: F-measure of matches one to one within 70 ms.
        distance: median seconds from a motion beat to the nearest music beat, NaN without any.
    """

    motion_to_music: float
    music_to_motion: float
    f: float
    hits: float
    distance: float

    def as_dict(self) -> dict[str, float]:
        return asdict(self)


OFFSETS = 16  # random times a motion, for the floor
COLUMNS = ("motion_to_music", "music_to_motion", "f", "hits", "distance")


def rhythm(
    motion: np.ndarray, music: np.ndarray, seconds: float, *, sigma: float = SIGMA
) -> Rhythm:
    """Score motion beats [N] against music beats [M] within [0, seconds), both ascending.

    Beats outside count as neighbours, never as beats of their own. A motion that never slows down
    has no beats and scores 0: it must not win by leaving.

    Raises:
        ValueError: a time is NaN or infinite.
    """
    if not (np.isfinite(motion).all() and np.isfinite(music).all()):
        raise ValueError("beat times hold NaN or infinity")
    made = motion[(motion >= 0) & (motion < seconds)]
    heard = music[(music >= 0) & (music < seconds)]
    forth = beat_alignment(made, music, sigma) if len(made) else 0.0
    back = beat_alignment(heard, motion, sigma) if len(heard) else 0.0
    near = len(made) and len(music)
    return Rhythm(
        motion_to_music=forth,
        music_to_motion=back,
        f=2 * forth * back / (forth + back) if forth + back else 0.0,
        hits=hit_f_measure(heard, made),
        distance=float(np.median(distances(made, music))) if near else float("nan"),
    )


def hit_f_measure(reference: np.ndarray, estimate: np.ndarray, window: float = HIT) -> float:
    """F-measure of beats matched one to one within `window` seconds, both ascending.

    Times on a line: taking the earliest pair that fits gives a largest matching.
    """
    if not len(reference) or not len(estimate):
        return 0.0
    matched = i = k = 0
    while i < len(reference) and k < len(estimate):
        apart = estimate[k] - reference[i]
        if abs(apart) <= window:
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


def turned_round(
    motion: np.ndarray, seconds: float, rng: np.random.Generator, n: int
) -> Iterator[np.ndarray]:
    """The motion's beats moved by a random time, `n` times: chance.

    Turned round within the song, so that number and spacing of the beats stay.
    """
    inside = motion[(motion >= 0) & (motion < seconds)]
    for shift in (np.arange(n) + rng.random(n)) * (seconds / n):
        yield np.sort((inside + shift) % seconds)


def against_chance(
    motion: np.ndarray, music: np.ndarray, seconds: float, rng: np.random.Generator
) -> tuple[Rhythm, Rhythm, Rhythm]:
    """A motion's beats on the music's, by chance, and on the off-beats; see `rhythm`.

    Chance is the mean over `OFFSETS` random times that the motion is turned round by.
    """
    turned = [rhythm(each, music, seconds) for each in turned_round(motion, seconds, rng, OFFSETS)]
    own, off = rhythm(motion, music, seconds), rhythm(motion, half_beat_later(music), seconds)
    return own, mean_rhythm(turned), off


def strangers(number: int, rng: np.random.Generator) -> list[int]:
    """For each of `number` motions another one: a single cycle, so nobody keeps its own song."""
    order, other = rng.permutation(number), np.zeros(number, dtype=int)
    other[order] = np.roll(order, 1)
    return other.tolist()


def mean_rhythm(scores: list[Rhythm]) -> Rhythm:
    """The mean of each column over at least one score; distances that are NaN are left out."""
    table = np.array([[getattr(score, name) for name in COLUMNS] for score in scores])
    known = ~np.isnan(table)
    sums = np.where(known, table, 0.0).sum(0)
    means = np.divide(sums, known.sum(0), out=np.full(len(COLUMNS), np.nan), where=known.any(0))
    return Rhythm(*(float(value) for value in means))
