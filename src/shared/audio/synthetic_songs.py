"""Synthetic songs whose beats, downbeats and bar phase are known exactly.

They are the oracle of the beat tracker, the held-out songs of the evaluation and the music that
is always at hand for training. One seed gives one song, sample by sample, on every run.
The tempo map is piecewise linear in time, so beat times and phases have closed forms.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from src.shared.audio import synth_voices
from src.shared.audio.synth_score import compose
from src.shared.audio.synth_voices import SAMPLE_RATE

# Bands of tempo in BPM, low inclusive, high exclusive: no tempo of one split occurs in the other.
TRAIN_TEMPI = (
    (60.0, 70.0),
    (80.0, 90.0),
    (100.0, 110.0),
    (120.0, 130.0),
    (140.0, 150.0),
    (160.0, 170.0),
)
HELD_OUT_TEMPI = tuple((high, high + 10.0) for _, high in TRAIN_TEMPI)
VOICES = ("drums", "bass", "chords", "melody")
METERS = (2, 3, 4, 6)
PEAK = 0.8


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


@dataclass(frozen=True)
class SyntheticSong:
    """A rendered song: samples [S] float32 mono at 44.1 kHz, beat and downbeat times in seconds."""

    spec: SongSpec
    samples: np.ndarray = field(repr=False)
    beat_times: np.ndarray = field(repr=False)
    downbeat_times: np.ndarray = field(repr=False)
    sample_rate: int = SAMPLE_RATE

    def phase(self, num_frames: int, fps: float = 30.0) -> np.ndarray:
        """Unwrapped bar phase [num_frames] (float64, bars): 0 at the first downbeat."""
        return song_phase(self.spec, np.arange(num_frames) / fps)

    def write_wav(self, path: Path) -> None:
        """Write the samples as 16-bit PCM."""
        import soundfile

        soundfile.write(path, self.samples, self.sample_rate, subtype="PCM_16", format="WAV")


def song_phase(spec: SongSpec, times: np.ndarray) -> np.ndarray:
    """Unwrapped bar phase [N] (float64, bars) at times [N] in seconds, without rendering."""
    return spec.tempo_map.beats(np.asarray(times) - spec.first_downbeat) / spec.meter


def song_beats(spec: SongSpec) -> tuple[np.ndarray, np.ndarray]:
    """Times in seconds of the beats [N] and of the downbeats [M] that sound within the song."""
    last = int(np.ceil(spec.tempo_map.beats(np.array([spec.seconds - spec.first_downbeat]))[0]))
    numbers = np.arange(-spec.pickup, max(last, -spec.pickup))
    times = spec.first_downbeat + spec.tempo_map.seconds(numbers)
    inside = times < spec.seconds
    return times[inside], times[inside & (numbers % spec.meter == 0)]


def render_song(spec: SongSpec) -> SyntheticSong:
    """Render `spec`; about 300 times faster than it plays."""
    beat_times, downbeat_times = song_beats(spec)
    count = round(spec.seconds * SAMPLE_RATE)
    mix = np.zeros(count, dtype=np.float32)
    rng = np.random.default_rng([spec.seed, 2])
    kit = spec.seed % 4
    notes = list(compose(spec, -spec.pickup, len(beat_times) - spec.pickup))
    edges = np.array([[note.beat, note.beat + note.length] for note in notes]).reshape(-1, 2)
    times = spec.first_downbeat + spec.tempo_map.seconds(edges)
    shifts = np.clip(rng.standard_normal(len(notes)), -2, 2) * spec.jitter
    for note, (start, end), shift in zip(notes, times, shifts, strict=True):
        if note.pitch:
            sound = synth_voices.tone(note.pitch, note.voice, end - start)
        else:
            sound = synth_voices.drum(note.voice, kit)
        offset = max(round((start + shift) * SAMPLE_RATE), 0)
        part = sound[: max(count - offset, 0)]
        mix[offset : offset + part.size] += np.float32(note.velocity) * part
    if spec.noise:
        level = spec.noise * float(mix.std())
        mix += level * rng.standard_normal(count, dtype=np.float32)
    mix *= PEAK / max(float(np.abs(mix).max(initial=0.0)), 1e-9)
    return SyntheticSong(spec, mix, beat_times, downbeat_times)


def sample_song_specs(
    number: int,
    seed: int,
    split: Literal["train", "held-out"] = "train",
    *,
    seconds: float = 30.0,
    meters: tuple[int, ...] = (4, 4, 4, 3, 3, 2),
    steady: bool = False,
) -> list[SongSpec]:
    """Draw songs whose every tempo lies in the bands of `split`.

    Args:
        number: how many.
        seed: of the draw; song i does not depend on `number`.
        split: "train" (TRAIN_TEMPI) or "held-out" (HELD_OUT_TEMPI).
        seconds: length of each.
        meters: drawn uniformly, so a repeated meter is likelier.
        steady: constant tempi only; else a third of the songs change tempo.
    """
    bands = TRAIN_TEMPI if split == "train" else HELD_OUT_TEMPI
    # The split enters the seed so that two splits of one seed share nothing.
    rngs = [np.random.default_rng([seed, split == "train", index]) for index in range(number)]
    return [_sample(rng, bands, seconds, meters, steady) for rng in rngs]


def _sample(
    rng: np.random.Generator,
    bands: tuple[tuple[float, float], ...],
    seconds: float,
    meters: tuple[int, ...],
    steady: bool,
) -> SongSpec:
    meter = int(rng.choice(meters))
    band = bands[rng.integers(len(bands))]
    voices = [VOICES, VOICES, VOICES[:2], ("drums", "chords"), VOICES[1:]][rng.integers(5)]
    return SongSpec(
        seconds=seconds,
        tempo=float(rng.uniform(*band)) if steady else _sample_tempo(rng, bands, band, seconds),
        meter=meter,
        voices=voices,
        density=float(rng.random()),
        syncopation=float(rng.random() ** 2),
        swing=float(rng.random() < 0.25) * float(rng.uniform(0.5, 1.0)),
        key=int(rng.integers(12)),
        minor=bool(rng.random() < 0.5),
        dynamics=float(rng.random()),
        silence=float(rng.uniform(0.0, 2.0)),
        pickup=int(rng.integers(meter)) if rng.random() < 0.25 else 0,
        noise=float(rng.choice([0.0, 0.02, 0.1])),
        jitter=float(rng.choice([0.0, 0.004, 0.01])),
        seed=int(rng.integers(2**31)),
    )


def _sample_tempo(
    rng: np.random.Generator,
    bands: tuple[tuple[float, float], ...],
    band: tuple[float, float],
    seconds: float,
) -> float | tuple[tuple[float, float], ...]:
    """A constant tempo, a drift within `band` or a jump to another band."""
    start, end = (float(value) for value in rng.uniform(*band, size=2))
    kind = rng.random()
    if kind < 0.67:
        return start
    if kind < 0.84:
        return ((0.0, start), (seconds, end))
    when = float(rng.uniform(0.35, 0.65)) * seconds
    after = float(rng.uniform(*bands[rng.integers(len(bands))]))
    return ((0.0, start), (when, start), (when, after))
