"""What decides a synthetic song, and what its players play: notes on the beat axis, from a seed.

Beat 0 is the first downbeat; negative beats are the pickup. Positions are in beats, so that the
tempo map alone decides when a note sounds.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Literal

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
        return np.asarray(self._beats[index] + ahead * (self._rates[index] + slope * ahead / 2))

    def seconds(self, beats: np.ndarray) -> np.ndarray:
        """Times [N] in seconds at beats [N]: the inverse of `beats`."""
        beats = np.asarray(beats, dtype=np.float64)
        index = np.maximum(np.searchsorted(self._beats, beats, side="right") - 1, 0)
        ahead = beats - self._beats[index]
        slope = np.where(ahead > 0, self._slopes[index], 0.0)
        rate = self._rates[index]
        return np.asarray(
            self._times[index] + 2 * ahead / (rate + np.sqrt(rate**2 + 2 * slope * ahead))
        )


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


# ---------------------------------------------------------------- what is played

# Kick and snare positions in a bar, by meter. Each names the beat level: no half-time grooves.
GROOVES: dict[int, tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]] = {
    2: (((0,), (1,)), ((0, 0.5), (1,)), ((0, 1.5), (1,))),
    3: (((0,), (1, 2)), ((0,), (2,)), ((0, 2.5), (1, 2)), ((0, 1.5), (2,))),
    4: (
        ((0, 2), (1, 3)),
        ((0, 2, 2.5), (1, 3)),
        ((0, 1, 2, 3), (1, 3)),
        ((0, 1.5, 2), (1, 3)),
        ((0, 2.5), (1, 3)),
        ((0, 0.5, 2), (1, 3)),
    ),
    6: (((0,), (3,)), ((0, 2), (3,)), ((0, 3), (2, 5))),
}
PROGRESSIONS = ((0, 5, 3, 4), (0, 3, 4, 0), (0, 4, 5, 3), (5, 3, 0, 4), (0, 1, 4, 0), (0, 3, 0, 4))
SCALES = {False: (0, 2, 4, 5, 7, 9, 11), True: (0, 2, 3, 5, 7, 8, 10)}
CHORD_STYLES = ("pad", "offbeats", "beats", "arpeggio")
RHYTHMS = ((0, 1), (0, 0.5, 1), (0,), (0, 0.5), (0, 1, 1.5))  # melody cells of two beats
SECTION_BARS = 8


@dataclass(frozen=True)
class Note:
    """One sound: a drum name or a timbre with MIDI pitch; times and length in beats."""

    beat: float
    voice: str
    velocity: float
    pitch: int = 0  # 0: a drum
    length: float = 0.0


def compose(spec: SongSpec, first_beat: int, last_beat: int) -> Iterator[Note]:
    """Yield the notes of beats [first_beat, last_beat) in no particular order."""
    rng = np.random.default_rng([spec.seed, 1])
    players = _Players(spec, rng)
    bars = range(first_beat // spec.meter, -(-last_beat // spec.meter))
    for bar in bars:
        for note in players.bar(bar):
            beat = bar * spec.meter + _swung(note.beat, spec.swing)
            if first_beat <= beat < last_beat:
                yield Note(beat, note.voice, note.velocity, note.pitch, note.length)


def _swung(beat: float, swing: float) -> float:
    """Delay half beats: swing 0 is straight, 1 is triplet feel (2/3 of a beat)."""
    return beat + swing / 6 if beat % 1 == 0.5 else beat


class _Players:
    """The choices a band keeps for the whole song, and the bars that follow from them."""

    def __init__(self, spec: SongSpec, rng: np.random.Generator) -> None:
        self.spec, self.rng = spec, rng
        self.kick, self.snare = GROOVES[spec.meter][rng.integers(len(GROOVES[spec.meter]))]
        self.progression = PROGRESSIONS[rng.integers(len(PROGRESSIONS))]
        self.chord_style = CHORD_STYLES[rng.integers(len(CHORD_STYLES))]
        self.chord_timbre = str(rng.choice(["piano", "organ", "strings", "pluck"]))
        self.melody_timbre = str(rng.choice(["flute", "piano", "pluck", "strings"]))
        self.walking = rng.random() < spec.density
        stated = "drums" in spec.voices or ("bass" in spec.voices and self.walking)
        if self.chord_style == "pad" and not stated:
            self.chord_style = "offbeats"  # somebody must play the beat
        self.cells = [RHYTHMS[rng.integers(len(RHYTHMS))] for _ in range(3)]
        self.degree = 7
        self.gain, self.drums_rest = 1.0, False

    def bar(self, number: int) -> Iterator[Note]:
        """Notes of one bar, positions from its downbeat."""
        spec, rng = self.spec, self.rng
        opening = number % SECTION_BARS == 0
        if opening:
            self.gain = 10 ** (-spec.dynamics * rng.random() * 10 / 20)
            pitched = set(spec.voices) - {"drums"}
            self.drums_rest = bool(pitched) and rng.random() < 0.25 * spec.dynamics
        chord = self.progression[number % len(self.progression)]
        if "drums" in spec.voices and not self.drums_rest:
            yield from self._drums(opening)
        if "bass" in spec.voices:
            yield from self._bass(chord)
        if "chords" in spec.voices:
            yield from self._chords(chord)
        if "melody" in spec.voices:
            yield from self._melody(chord)

    def _velocity(self, beat: float) -> float:
        middle = self.spec.meter % 2 == 0 and beat == self.spec.meter / 2
        accent = 1.0 if beat == 0 else 0.85 if middle else 0.75 if beat % 1 == 0 else 0.6
        return accent * self.gain * (1 - 0.5 * self.spec.dynamics * self.rng.random())

    def _pitch(self, degree: int, octave: int) -> int:
        scale = SCALES[self.spec.minor]
        return 12 * (octave + 1 + degree // 7) + self.spec.key + scale[degree % 7]

    def _drums(self, opening: bool) -> Iterator[Note]:
        spec, rng = self.spec, self.rng
        if opening:
            yield Note(0.0, "crash", 0.5 * self._velocity(0))
        for beat in self.kick:
            yield Note(beat, "kick", 1.1 * self._velocity(beat))
        for beat in self.snare:
            yield Note(beat, "snare", 0.8 * self._velocity(beat))
        for extra in np.arange(0.5, spec.meter, 1.0):
            if rng.random() < 0.25 * spec.syncopation:
                name = "kick" if rng.random() < 0.6 else "snare"
                yield Note(float(extra), name, 0.6 * self._velocity(extra))
        step = 0.5 if spec.density > 0.35 else 1.0
        if spec.density > 0.8 and spec.swing == 0:
            step = 0.25
        for beat in np.arange(0.0, spec.meter, step):
            yield Note(float(beat), "hat", 0.35 * self._velocity(beat))

    def _bass(self, chord: int) -> Iterator[Note]:
        meter, rng = self.spec.meter, self.rng
        if self.walking:
            steps = [(float(b), int(rng.choice([0, 2, 4])) if b else 0) for b in range(meter)]
        else:
            steps = [(0.0, 0)] + ([(meter / 2, 4)] if meter % 2 == 0 else [])
        if rng.random() < self.spec.syncopation * 0.6:
            steps.append((meter - 0.5, 4))
        length = 0.9 if self.walking else meter / 2 * 0.9
        for beat, degree in steps:
            velocity = 0.7 * self._velocity(beat)
            yield Note(beat, "bass", velocity, self._pitch(chord % 7 + degree, 2), length)

    def _chords(self, chord: int) -> Iterator[Note]:
        meter, style = self.spec.meter, self.chord_style
        pitches = [self._pitch(chord % 7 + step, 4) for step in (0, 2, 4)]
        if style == "arpeggio":
            for index, beat in enumerate(np.arange(0.0, meter, 0.5)):
                velocity = 0.4 * self._velocity(beat)
                pitch = pitches[(0, 1, 2, 1)[index % 4]]
                yield Note(float(beat), self.chord_timbre, velocity, pitch, 0.9)
            return
        beats = {"pad": [0], "offbeats": [*range(1, meter)], "beats": [*range(meter)]}[style]
        if style == "offbeats" and "bass" not in self.spec.voices:
            beats = [0, *beats]  # somebody must play the downbeat
        length = meter * 0.95 if style == "pad" else 0.5
        for beat in beats:
            velocity = 0.3 * self._velocity(beat)
            for pitch in pitches:
                yield Note(float(beat), self.chord_timbre, velocity, pitch, length)

    def _melody(self, chord: int) -> Iterator[Note]:
        meter, rng = self.spec.meter, self.rng
        for start in range(0, meter, 2):
            cell = self.cells[rng.integers(len(self.cells))]
            for position in cell:
                beat = start + position
                if beat >= meter:
                    continue
                if beat % 1 == 0 and beat and rng.random() < self.spec.syncopation * 0.5:
                    beat -= 0.5
                self.degree += int(rng.integers(-2, 3))
                self.degree = min(max(self.degree, 3), 12)
                if beat == 0:  # chord notes on downbeats
                    self.degree = chord % 7 + (0, 2, 4)[rng.integers(3)]
                pitch = self._pitch(self.degree, 5)
                yield Note(beat, self.melody_timbre, 0.4 * self._velocity(beat), pitch, 0.8)


# ---------------------------------------------------------------- what it sounds like

SAMPLE_RATE = 44_100
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
    """One kick, snare, hat, crash or click [S], peak about 1; `kit` varies pitch and length."""
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
METERS_DRAWN = (4, 4, 4, 3, 3, 2)  # uniformly, so a repeated one is likelier


@dataclass(frozen=True)
class SyntheticSong:
    """A rendered song: samples [S] float32 mono at 44.1 kHz, beat and downbeat times in seconds."""

    spec: SongSpec
    samples: np.ndarray = field(repr=False)
    beat_times: np.ndarray = field(repr=False)
    downbeat_times: np.ndarray = field(repr=False)
    sample_rate: int = SAMPLE_RATE

    def phase(self, num_frames: int) -> np.ndarray:
        """Unwrapped bar phase [num_frames] (float64, bars) at 30 fps: 0 at the first downbeat."""
        return song_phase(self.spec, np.arange(num_frames) / 30.0)

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
    number: int, seed: int, split: Literal["train", "held-out"] = "train", *, seconds: float = 30.0
) -> list[SongSpec]:
    """Draw songs whose every tempo lies in the bands of `split`.

    Args:
        seed: of the draw; song i does not depend on `number`.
        split: "train" (TRAIN_TEMPI) or "held-out" (HELD_OUT_TEMPI).
        seconds: length of each; a third of them change tempo.
    """
    bands = TRAIN_TEMPI if split == "train" else HELD_OUT_TEMPI
    # The split enters the seed so that two splits of one seed share nothing.
    rngs = [np.random.default_rng([seed, split == "train", index]) for index in range(number)]
    return [_sample(rng, bands, seconds) for rng in rngs]


def _sample(
    rng: np.random.Generator, bands: tuple[tuple[float, float], ...], seconds: float
) -> SongSpec:
    meter = int(rng.choice(METERS_DRAWN))
    band = bands[rng.integers(len(bands))]
    voices = [VOICES, VOICES, VOICES[:2], ("drums", "chords"), VOICES[1:]][rng.integers(5)]
    return SongSpec(
        seconds=seconds,
        tempo=_sample_tempo(rng, bands, band, seconds),
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
