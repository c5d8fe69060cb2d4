"""What decides a synthetic song: tempo map, meter, voices, seed."""

from dataclasses import dataclass

import numpy as np

VOICES = ("drums", "bass", "chords", "melody")
METERS = (2, 3, 4, 6)


class TempoMap:
    """Beats as a function of seconds since the first downbeat, both ways in closed form.

    Args:
        knots: (seconds, BPM) in order of time, the first at 0; the tempo is linear between them
            and constant outside. Two knots at one time are a sudden change.
    """

    def __init__(self, knots: tuple[tuple[float, float], ...]) -> None:
        times, tempi = np.array(knots, dtype=np.float64).T
        self._times, self._rates = times, tempi / 60
        spans = np.diff(times)
        slopes = np.divide(np.diff(self._rates), spans, out=np.zeros_like(spans), where=spans > 0)
        self._slopes = np.append(slopes, 0.0)
        steps = spans * (self._rates[1:] + self._rates[:-1]) / 2
        self._beats = np.concatenate([[0.0], np.cumsum(steps)])

    def beats(self, seconds: np.ndarray) -> np.ndarray:
        """Beats [N] (float64) at times [N] in seconds; negative before the first downbeat."""
        seconds = np.asarray(seconds, dtype=np.float64)
        index = np.maximum(np.searchsorted(self._times, seconds, side="right") - 1, 0)
        ahead = seconds - self._times[index]
        slope = np.where(ahead > 0, self._slopes[index], 0.0)
        return self._beats[index] + ahead * (self._rates[index] + slope * ahead / 2)

    def seconds(self, beats: np.ndarray) -> np.ndarray:
        """Times [N] in seconds at beats [N]: the inverse of `beats`."""
        beats = np.asarray(beats, dtype=np.float64)
        index = np.maximum(np.searchsorted(self._beats, beats, side="right") - 1, 0)
        ahead = beats - self._beats[index]
        slope = np.where(ahead > 0, self._slopes[index], 0.0)
        rate = self._rates[index]
        return self._times[index] + 2 * ahead / (rate + np.sqrt(rate**2 + 2 * slope * ahead))


@dataclass(frozen=True)
class SongSpec:
    """Everything that decides a song; times in seconds, tempi in BPM, shares in [0, 1]."""

    seconds: float = 30.0
    tempo: float | tuple[tuple[float, float], ...] = 120.0  # or knots of a TempoMap
    meter: int = 4
    voices: tuple[str, ...] = VOICES
    density: float = 0.5  # quarter notes ... sixteenths
    syncopation: float = 0.0
    swing: float = 0.0  # straight ... triplets
    key: int = 0  # semitones above C
    minor: bool = False
    dynamics: float = 0.3  # accents, loud and soft sections, breaks
    silence: float = 0.5  # before the first sound
    pickup: int = 0  # beats before the first downbeat
    noise: float = 0.0  # white noise, standard deviation relative to the music's
    jitter: float = 0.0  # standard deviation of the players' timing, seconds
    seed: int = 0

    def __post_init__(self) -> None:
        if self.meter not in METERS:
            raise ValueError(f"meter is {self.meter}; a synthetic song has one of {METERS}")
        if not self.voices or set(self.voices) - set(VOICES):
            raise ValueError(f"voices are {self.voices}; choose some of {VOICES}")

    @property
    def tempo_map(self) -> TempoMap:
        """The map from seconds after the first downbeat to beats."""
        constant = isinstance(self.tempo, float | int)
        return TempoMap(((0.0, float(self.tempo)),) if constant else self.tempo)  # type: ignore[arg-type]

    @property
    def first_downbeat(self) -> float:
        """Time of the first downbeat in seconds."""
        return self.silence - float(self.tempo_map.seconds(np.array([-self.pickup]))[0])
