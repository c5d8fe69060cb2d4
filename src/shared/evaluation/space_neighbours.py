"""What the motion that a sound finds has in common with the one it was paired with.

Letters: N windows, M windows of a batch, D embed dim.
"""

from dataclasses import dataclass

import numpy as np
from torch import Tensor

from ..motion.features import FORWARD, LATERAL, ROOT_ROW
from .metrics_space import by_song
from .space_retrieval import Bench
from .space_windows import Windows
from .stats import Estimate


@dataclass(frozen=True)
class Neighbours:
    """Windows with what is known of their motion.

    Attributes:
        bench: batches within which neighbours are looked for.
        tempo: of each window's song [N], beats a minute.
        speed: mean speed over ground [N], m/s.
        tag: of each window's phrase [N].
    """

    bench: Bench
    tempo: np.ndarray
    speed: np.ndarray
    tag: np.ndarray

    @classmethod
    def of(cls, windows: Windows, bench: Bench) -> "Neighbours":
        """Measure the windows' motions."""
        root = [window.body[:, ROOT_ROW].astype(np.float32) for window in windows.items]
        return cls(
            bench,
            np.array([windows.records[i.phrase].tempo for i in windows.items]),
            np.array([np.hypot(r[:, FORWARD], r[:, LATERAL]).mean() for r in root]),
            np.array([windows.records[i.phrase].tag for i in windows.items]),
        )

    def measure(
        self, sound: Tensor, motion: Tensor, *, shuffled: bool = False
    ) -> dict[str, Estimate]:
        """`tempo`: octaves between the songs' tempi, half and double tempo being the same;
        `speed`: m/s between the motions; `action`: share of the same tag.

        Args:
            sound, motion: keys [N,D].
            shuffled: another sound asks in each one's place.
        """
        rng = np.random.default_rng(self.bench.seed)
        asked: list[np.ndarray] = []
        given: list[np.ndarray] = []
        for windows in self.bench.batches:
            asking = rng.permutation(windows) if shuffled else windows
            similarity = sound.numpy()[asking] @ motion.numpy()[windows].T  # M M
            phrases = self.bench.phrase[windows]
            similarity[self.bench.kin[np.ix_(phrases, phrases)]] = -np.inf
            asked.append(windows)
            given.append(windows[similarity.argmax(1)])
        own, found = np.concatenate(asked), np.concatenate(given)
        octaves = np.log2(self.tempo[found] / self.tempo[own])
        values = {
            "tempo": np.abs(octaves - np.rint(octaves)),
            "speed": np.abs(self.speed[found] - self.speed[own]),
            "action": (self.tag[found] == self.tag[own]).astype(float),
        }
        return {
            name: by_song(value, self.bench.songs, np.mean, seed=self.bench.seed)
            for name, value in values.items()
        }
