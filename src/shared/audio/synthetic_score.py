"""What decides a synthetic song, and what its players play: notes on the beat axis, from a seed.

Beat 0 is the first downbeat; negative beats are the pickup. Positions are in beats, so that the
tempo map alone decides when a note sounds.
"""

from collections.abc import Iterator
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
