"""Retrieval among held-out windows of phrases, in batches that hold each phrase once.

Letters: N windows, P phrases, M windows of a batch, D embed dim.
"""

from dataclasses import dataclass

import numpy as np
from torch import Tensor

from ..metrics.retrieval import BATCH
from .metrics_space import ranks, retrieval_figures
from .space_windows import Windows, related
from .stats import Estimate

Figures = dict[str, Estimate]


@dataclass(frozen=True)
class Bench:
    """Batches of windows, drawn once, so that every row of a table answers the same questions.

    Attributes:
        batches: numbers of the windows [M] of each.
        phrase: of each window [N].
        songs: of each query, batch after batch.
        kin: phrases [P,P] bool of one song or that share a clip.
        same_action: phrases [P,P] bool whose motion goes by the same tag.
        seed: of everything random.
    """

    batches: list[np.ndarray]
    phrase: np.ndarray
    songs: list[str]
    kin: np.ndarray
    same_action: np.ndarray
    seed: int

    @classmethod
    def draw(
        cls, windows: Windows, *, batch: int = BATCH, replications: int = 20, seed: int = 0
    ) -> "Bench":
        """Replications of: all phrases in any order, full batches of them, a window of each.

        With fewer phrases than a batch there is one batch of all.
        """
        number = len(windows.records)
        batch = min(batch, number)
        rng = np.random.default_rng(seed)
        batches = []
        for _ in range(replications):
            order = rng.permutation(number)[: number // batch * batch].reshape(-1, batch)
            for phrases in order:
                shown = [rng.choice(windows.of_phrase[phrase]) for phrase in phrases]
                batches.append(np.array(shown))
        phrase = np.array([window.phrase for window in windows.items])
        drawn = phrase[np.concatenate(batches)]
        tags = np.array([record.tag for record in windows.records])
        return cls(
            batches,
            phrase,
            [windows.records[p].song or windows.records[p].id for p in drawn],
            related(windows.records),
            (tags[:, None] == tags[None]) & (tags != "")[:, None],
            seed,
        )

    def measure(
        self, query: Tensor, items: Tensor, *, by_action: bool = False, shuffled: bool = False
    ) -> Figures:
        """How well queries [N,D] find the items [N,D] of their own windows.

        Args:
            by_action: phrases of the same tag are neither right nor wrong: a caption fits them all.
            shuffled: each asks in another's place, which is what knowing nothing gives.
        """
        query_rows, item_rows = query.numpy(), items.numpy()
        kin = self.kin | self.same_action if by_action else self.kin
        rng = np.random.default_rng(self.seed)
        found = []
        for windows in self.batches:
            asking = rng.permutation(windows) if shuffled else windows
            phrases = self.phrase[windows]
            found.append(
                ranks(query_rows[asking], item_rows[windows], kin[np.ix_(phrases, phrases)])
            )
        return retrieval_figures(found, self.songs, seed=self.seed)
