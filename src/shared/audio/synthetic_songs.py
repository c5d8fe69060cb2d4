"""Synthetic songs whose beats, downbeats and bar phase are known exactly, and their sounds.

They are the oracle of the beat tracker, the held-out songs of the evaluation and the music that
is always at hand for training. One seed gives one song, sample by sample, on every run.
The tempo map is piecewise linear in time, so beat times and phases have closed forms.

Every drum stroke and tone starts at its first sample, so the place where it is mixed in is its
exact onset. They are cached and shared: callers scale copies and never write into them.
"""

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Literal

import numpy as np

from .synthetic_score import VOICES, SongSpec, compose

SAMPLE_RATE = 44_100
DRUMS = ("kick", "snare", "hat", "crash", "click")
# Strength of the harmonics 1, 2, ..., time to 1/e in seconds, attack in seconds.
TIMBRES: dict[str, tuple[tuple[float, ...], float, float]] = {
    "bass": ((1.0, 0.6, 0.3, 0.15, 0.08), 0.5, 0.004),
    "piano": ((1.0, 0.5, 0.35, 0.2, 0.12, 0.08), 0.6, 0.002),
    "pluck": ((1.0, 0.7, 0.6, 0.4, 0.3, 0.2, 0.1), 0.25, 0.001),
    "organ": ((1.0, 0.8, 0.0, 0.5, 0.0, 0.0, 0.0, 0.3), 6.0, 0.012),
    "strings": ((1.0, 0.6, 0.5, 0.35, 0.25, 0.2, 0.15, 0.1), 6.0, 0.06),
    "flute": ((1.0, 0.35, 0.12, 0.05), 4.0, 0.03),
}
LONGEST_TONE = 3.0  # seconds
RELEASE = 0.03  # seconds


def _time(seconds: float) -> np.ndarray:
    return np.arange(round(seconds * SAMPLE_RATE)) / SAMPLE_RATE


def _noise(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal(count)


@lru_cache(maxsize=64)
def drum(name: str, kit: int = 0) -> np.ndarray:
    """One stroke of `name` (of DRUMS), [S], peak about 1; `kit` varies pitch and length."""
    lift = 1.0 + 0.12 * (kit % 4 - 1.5)
    if name == "kick":
        t = _time(0.3)
        sweep = 48 * lift * t + 110 * lift * 0.03 * (1 - np.exp(-t / 0.03))  # cycles
        sound = np.sin(2 * np.pi * sweep) * np.exp(-t / 0.09)
        sound += 0.25 * _noise(t.size, kit) * np.exp(-t / 0.003)
    elif name == "snare":
        t = _time(0.25)
        sound = 0.6 * _noise(t.size, 10 + kit) * np.exp(-t / (0.06 * lift))
        sound += 0.5 * np.sin(2 * np.pi * 185 * lift * t) * np.exp(-t / 0.05)
    elif name == "click":
        t = _time(0.05)
        sound = np.sin(2 * np.pi * 1000 * lift * t) * np.exp(-t / 0.01)
    else:
        length = {"hat": 0.025, "crash": 0.5}[name] * lift
        t = _time(6 * length)
        sound = np.diff(_noise(t.size + 1, 20 + kit)) * np.exp(-t / length) * 0.5
    return np.asarray((sound / np.abs(sound).max()).astype(np.float32))


@lru_cache(maxsize=192)
def _full_tone(pitch: int, timbre: str) -> np.ndarray:
    harmonics, decay, attack = TIMBRES[timbre]
    frequency = 440.0 * 2 ** ((pitch - 69) / 12)
    t = _time(LONGEST_TONE)
    angle = 2 * np.pi * frequency * t
    wave, twice_cos = np.sin(angle), 2 * np.cos(angle)
    before, sound = np.zeros_like(t), np.zeros_like(t)
    for number, strength in enumerate(harmonics, start=1):
        if number * frequency > 0.45 * SAMPLE_RATE:
            break
        sound += strength * wave
        before, wave = wave, twice_cos * wave - before  # sin((n+1)x) from sin(nx), sin((n-1)x)
    sound *= np.exp(-t / decay) * np.minimum(1.0, t / attack)
    return np.asarray((sound / np.abs(sound).max()).astype(np.float32))


def tone(pitch: int, timbre: str, seconds: float) -> np.ndarray:
    """A note [S] of MIDI number `pitch`, held for `seconds` (at most LONGEST_TONE), faded out."""
    count = round(min(max(seconds, 2 * RELEASE), LONGEST_TONE) * SAMPLE_RATE)
    note = _full_tone(pitch, timbre)[:count].copy()
    fade = round(RELEASE * SAMPLE_RATE)
    note[-fade:] *= np.linspace(1.0, 0.0, fade, dtype=np.float32)
    return note


# ---------------------------------------------------------------- songs

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
        pitched = note.pitch > 0
        sound = tone(note.pitch, note.voice, end - start) if pitched else drum(note.voice, kit)
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
