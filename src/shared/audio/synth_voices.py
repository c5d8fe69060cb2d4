"""Drum strokes and plucked, bowed and blown tones for synthetic songs, as mono float32 at 44.1 kHz.

Every sound starts at its first sample, so the place where it is mixed in is its exact onset.
Sounds are cached and shared: callers scale copies and never write into them.
"""

from functools import lru_cache

import numpy as np

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
    return (sound / np.abs(sound).max()).astype(np.float32)


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
    return (sound / np.abs(sound).max()).astype(np.float32)


def tone(pitch: int, timbre: str, seconds: float) -> np.ndarray:
    """A note [S] of MIDI number `pitch`, held for `seconds` (at most LONGEST_TONE), faded out."""
    count = round(min(max(seconds, 2 * RELEASE), LONGEST_TONE) * SAMPLE_RATE)
    note = _full_tone(pitch, timbre)[:count].copy()
    fade = round(RELEASE * SAMPLE_RATE)
    note[-fade:] *= np.linspace(1.0, 0.0, fade, dtype=np.float32)
    return note
