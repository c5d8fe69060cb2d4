"""Music of another make than the synthetic songs: what they never play, with beats that are known.

Patterns are drums, or a bass and one chord that stays: nothing but the strokes tells the bars. Pop
is a backbeat under dotted basses and chords off the beat, half of it with drums from the fifth bar
on alone, so that three quarters of a beat, and one and a half, are there to be taken for a beat.
"""

from dataclasses import dataclass

import numpy as np

from src.shared.audio.synthetic import SAMPLE_RATE, drum, tone

PROGRESSION = (0, 5, 7, 5)
BASSES = (
    (0, 1.5, 3), (0, 0.75, 1.5, 2.25, 3), (0, 1.5, 2, 3.5), (0, 1, 2, 3), (0, 2.5),
    (0, 0.5, 1.5, 2.5, 3),
)  # fmt: skip
KICKS = ((0, 2), (0, 1, 2, 3), (0, 1.5, 2.5), (0, 2.5))
CHORDS = ((0,), (0.5, 1.5, 2.5, 3.5), (0, 1.5, 3), (1, 3), (0, 0.75, 1.5, 2.25, 3))
HATS = (0.5, 0.25, 1.0, 1 / 3)


@dataclass(frozen=True)
class OtherSong:
    """Samples at 44.1 kHz, beats and downbeats in seconds, beats a bar."""

    samples: np.ndarray
    beat_times: np.ndarray
    downbeat_times: np.ndarray
    meter: int


class Mix:
    """Sounds laid into so many seconds."""

    def __init__(self, seconds: float) -> None:
        self.count = round(seconds * SAMPLE_RATE)
        self.samples = np.zeros(self.count + 5 * SAMPLE_RATE, np.float32)

    def put(self, time: float, sound: np.ndarray, gain: float) -> None:
        start = max(round(time * SAMPLE_RATE), 0)
        self.samples[start : start + len(sound)] += np.float32(gain) * sound

    def song(self, beats: np.ndarray, first: int, meter: int) -> OtherSong:
        mono = self.samples[: self.count]
        return OtherSong(0.8 * mono / np.abs(mono).max(), beats, beats[first::meter], meter)


def pattern(seed: int, *, seconds: float = 20.0) -> OtherSong:
    """Strokes in threes or fours that nothing but themselves accents."""
    rng = np.random.default_rng([seed, 99])
    meter, period = int(rng.choice([3, 3, 4])), 60 / float(rng.uniform(75, 200))
    beats = rng.uniform(0, 0.4) + np.arange(int((seconds - 0.4) / period)) * period
    first = int(rng.integers(meter)) if rng.random() < 0.3 else 0
    made_of = str(rng.choice(["drums", "bass", "accent"], p=[0.45, 0.4, 0.15]))
    weak, kit, key = rng.uniform(0.35, 0.9), int(rng.integers(4)), 40 + int(rng.integers(12))
    others = [str(rng.choice(["hat", "snare", "click"])) for _ in range(meter)]
    if meter == 4 or rng.random() < 0.5:
        others[1:] = ["snare", *others[2:-1], "snare"] if meter == 4 else [others[1]] * 2
    timbre = str(rng.choice(["piano", "strings", "pluck", "organ"]))
    hats, melody = rng.random() < 0.4, rng.random() < 0.4
    mix = Mix(seconds)
    for beat, place in enumerate(beats):
        number, time = (beat - first) % meter, place + rng.normal() * 0.005
        gain = 1.0 if number == 0 else 0.8 if 2 * number == meter else weak
        strong = gain != weak
        if made_of == "drums":
            mix.put(time, drum("kick" if strong else others[number], kit), 0.6 * gain)
        elif made_of == "accent":
            mix.put(time, drum(others[0], kit), 0.6 if number == 0 else 0.6 * weak)
        elif strong:
            mix.put(time, tone(key - (12 if number == 0 else 5), "bass", 0.9 * period), 0.6 * gain)
        else:
            for step in (0, 4, 7):
                mix.put(time, tone(key + 12 + step, timbre, 0.5 * period), 0.25 * gain)
        if hats:
            mix.put(time, drum("hat", kit), 0.2)
            mix.put(time + period / 2, drum("hat", kit), 0.15)
        if melody and rng.random() < 0.6:
            mix.put(time, tone(key + 24 + int(rng.choice([0, 2, 4, 7])), "flute", period), 0.25)
    return mix.song(beats, first, meter)


def pop(seed: int, *, seconds: float = 24.0, tempo: float | None = None) -> OtherSong:
    """Four beats a bar, much of it between them; without a tempo one from 65 to 185."""
    rng = np.random.default_rng([seed, 5])
    period = 60 / (tempo or float(rng.uniform(65, 185)))
    bass, kick, chords = (many[rng.integers(len(many))] for many in (BASSES, KICKS, CHORDS))
    hat, kit, key = HATS[rng.integers(4)], int(rng.integers(4)), 40 + int(rng.integers(12))
    timbre, late = str(rng.choice(["piano", "pluck", "organ"])), rng.random() < 0.5
    bars, lead, mix = int((seconds - 0.3) / (4 * period)), 0.2, Mix(seconds)
    for bar in range(bars):
        root = key + PROGRESSION[bar % 4]

        def at(beat: float, bar: int = bar) -> float:
            return lead + (4 * bar + beat) * period

        if not (late and bar < 4):
            for beats, name, gain in ((kick, "kick", 0.7), ((1, 3), "snare", 0.5)):
                for beat in beats:
                    mix.put(at(beat), drum(name, kit), gain)
            for beat in np.arange(0, 4 - 1e-6, hat):
                mix.put(at(beat), drum("hat", kit), 0.2 * rng.uniform(0.6, 1))
        for beat in bass:
            mix.put(at(beat), tone(root - 12, "bass", 0.7 * period), 0.5)
        for beat in chords:
            for step in (0, 4, 7):
                mix.put(at(beat), tone(root + 12 + step, timbre, 0.5 * period), 0.15)
    return mix.song(lead + np.arange(4 * bars) * period, 0, 4)
