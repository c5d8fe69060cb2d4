"""The yardstick's prompts: requests written by hand, in six languages, kept out of every training.

They lie in src/configs/requests, a file a language, and are by another hand and another rule than
the captions that train. Whoever tunes on them has no yardstick left.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from ...config_loader import load_yaml, packaged_config
from .schema import Labels, normalised

SECTIONS = ("plain", "styled", "counts", "angles", "lengths", "sides")
COMPOSITIONS, OUTSIDE, FREE = "compositions", "outside", "free"


@dataclass(frozen=True)
class Request:
    """One sentence and what a motion must show to obey it.

    Attributes:
        section: of the file.
        parts: labels of what is asked for, in order; none for what no model here can show.
        simultaneous: the parts are to be seen at the same time.
    """

    text: str
    language: str
    section: str
    parts: tuple[Labels, ...] = ()
    simultaneous: bool = False

    @property
    def labels(self) -> Labels:
        """Of the first part."""
        return self.parts[0] if self.parts else {}

    @property
    def action(self) -> str:
        """Of the first part; empty for what is outside."""
        return self.labels.get("action", "")


def load_requests(languages: Sequence[str]) -> list[Request]:
    """All requests of these languages, in the order of the files."""
    return [request for code in languages for request in _of_language(code)]


@cache
def requested(language: str) -> frozenset[str]:
    """All sentences of a language, normalised; none where nobody has written any."""
    if not packaged_config(f"requests/{language}.yaml").is_file():
        return frozenset()
    return frozenset(normalised(request.text) for request in _of_language(language))


def _of_language(code: str) -> Iterator[Request]:
    content = load_yaml(packaged_config(f"requests/{code}.yaml"))
    for section in SECTIONS:
        for entry in content[section]:
            parts = _parts(entry["labels"])
            for text in entry["text"]:
                yield Request(text, code, section, parts, bool(entry.get("simultaneous")))
    for entry in content[COMPOSITIONS]:
        for text in entry["text"]:
            yield Request(text, code, COMPOSITIONS, _parts(entry["parts"]))
    for text in content[OUTSIDE]:
        yield Request(text, code, OUTSIDE)
    for entry in content[FREE]:
        yield Request(entry["text"], code, FREE, _parts(entry["labels"]))


def _parts(labels: Any) -> tuple[Labels, ...]:
    """One set of labels, several in order, or the word "outside"."""
    if labels == OUTSIDE:
        return ()
    several = labels if isinstance(labels, list) else [labels]
    return tuple({key: str(value) for key, value in each.items()} for each in several)


def drawn(requests: Sequence[Request], num: int, seed: int) -> list[Request]:
    """At most `num` wordings of each set of labels and language, by the seed."""
    rng = np.random.default_rng(seed)
    chosen: dict[str, list[Request]] = {}
    for row in rng.permutation(len(requests)):
        request = requests[row]
        same = chosen.setdefault(f"{request.language}{request.section}{request.parts}", [])
        if len(same) < num:
            same.append(request)
    return [request for same in chosen.values() for request in same]
