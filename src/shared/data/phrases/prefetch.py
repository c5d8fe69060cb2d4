"""Epochs of phrases, fetched ahead in threads, that can be left and taken up again."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ...ahead import ahead
from ...errors import UserError

if TYPE_CHECKING:
    from .dataset import MotionPhraseDataset, PhraseItem


class EpochIterator:
    """Every good phrase of one epoch exactly once, in an order given by (seed, epoch).

    Save `state_dict()` together with what became of the items; an iterator with that state loaded
    goes on behind the last item handed out, in this process or another.
    """

    def __init__(self, dataset: "MotionPhraseDataset", epoch: int, position: int = 0) -> None:
        self.dataset, self.epoch, self.position = dataset, epoch, position
        self._items: Iterator[tuple[int, PhraseItem | None]] | None = None

    def __iter__(self) -> "EpochIterator":
        return self

    def __next__(self) -> "PhraseItem":
        if self._items is None:
            self._items = self._start()
        for position, item in self._items:
            self.position = position + 1
            if item is not None:
                return item
        raise StopIteration

    def _start(self) -> "Iterator[tuple[int, PhraseItem | None]]":
        order = self.dataset.order(self.epoch)
        positions = range(self.position, len(order))

        def make(position: int) -> "tuple[int, PhraseItem | None]":
            return position, self.dataset.item(int(order[position]), self.epoch)

        threads = self.dataset.threads
        return ahead(make, positions, threads, depth=2 * threads)

    def state_dict(self) -> dict[str, Any]:
        """Plain data for JSON: the position counts bad phrases too."""
        return {
            "epoch": self.epoch,
            "position": self.position,
            "seed": self.dataset.seed,
            "data": self.dataset.fingerprint,
        }

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on where another iterator stopped.

        Raises:
            UserError: that one ran over other data or with another seed.
        """
        for name, now in (("data", self.dataset.fingerprint), ("seed", self.dataset.seed)):
            if state[name] != now:
                raise UserError(
                    f"cannot go on in epoch {state['epoch']}: its {name} was {state[name]}, that of"
                    f" {self.dataset.root} is {now}; start the epoch again"
                )
        self.epoch, self.position, self._items = state["epoch"], state["position"], None
