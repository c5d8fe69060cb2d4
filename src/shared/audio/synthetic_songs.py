"""Synthetic songs whose beats, downbeats and bar phase are known exactly.

They are the oracle of the beat tracker, the held-out songs of the evaluation and the music that
is always at hand for training. One seed gives one song, sample by sample, on every run.
The tempo map is piecewise linear in time, so beat times and phases have closed forms.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from . import synth_voices
from .song_spec import VOICES, SongSpec
from .synth_score import compose
from .synth_voices import SAMPLE_RATE

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
PEAK = 0.8


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
