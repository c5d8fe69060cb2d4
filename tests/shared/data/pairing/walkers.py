"""Clips made by hand whose motion beats are known."""

import numpy as np

from src.shared.data.pairing.clip_library import Clip, _match

FPS = 30.0


def walker(
    name: str, period: float, *, seconds: float = 6.0, speed: float = 1.2, split: str = "train"
) -> Clip:
    """A straight walk that slows down every `period` seconds, first after half of it."""
    t = (np.arange(round(seconds * FPS)) + 0.5) / FPS
    root = np.zeros((len(t), 4), dtype=np.float32)
    root[:, 0] = speed + 0.3 * np.cos(2 * np.pi * t / period)
    root[:, 2] = 0.95
    root[:, 3] = 0.2 * np.sin(2 * np.pi * t / (2 * period))
    tilt = np.zeros((len(t), 4), dtype=np.float32)
    tilt[:, 0] = 1
    beats = np.arange(period / 2, seconds, period)
    cuts = np.rint(beats * FPS).astype(int)
    cuts = cuts[(cuts >= 6) & (cuts < len(t) - 6)]
    return Clip(name, "walk", "made", split, root, tilt, cuts, period, _match(root, tilt, cuts))
