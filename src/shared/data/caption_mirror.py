"""Swap left and right in the text of a caption, by a table for each language."""

import re
from functools import cached_property

from .caption_schema import MirrorTable


class TextMirror:
    """One language's mirror: word pairs, one-way words, and phrases to leave alone."""

    def __init__(self, table: MirrorTable, spaces: bool) -> None:
        self._table = table
        self._spaces = spaces

    @cached_property
    def _words(self) -> dict[str, str]:
        both_ways = {a.lower(): b for a, b in self._table.pairs}
        both_ways |= {b.lower(): a for a, b in self._table.pairs}
        return {a.lower(): b for a, b in self._table.one_way} | both_ways

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        words = sorted(self._words, key=len, reverse=True)
        swap = "|".join(re.escape(word).replace(r"\ ", r"\s+") for word in words)
        keep = "|".join(self._table.keep) or r"(?!)"
        edge = (r"(?<![^\W_])", r"(?![^\W_])") if self._spaces else ("", "")
        return re.compile(f"{edge[0]}(?:(?P<keep>{keep})|(?P<swap>{swap})){edge[1]}", re.IGNORECASE)

    def __call__(self, text: str) -> str:
        """The text with left and right exchanged, letter case preserved."""
        return self._pattern.sub(self._exchange, text)

    def _exchange(self, match: re.Match[str]) -> str:
        found = match.group()
        if match.group("keep") is not None:
            return found
        return _like(found, self._words[re.sub(r"\s+", " ", found.lower())])


def _like(model: str, word: str) -> str:
    """Give `word` the letter case of `model`: ALL CAPS, each word Capitalised, or as it is."""
    if len(model) > 1 and model.isupper():
        return word.upper()
    model_parts, parts = model.split(), word.split(" ")
    if len(model_parts) != len(parts):
        return word[:1].upper() + word[1:] if model[:1].isupper() else word
    return " ".join(
        part[:1].upper() + part[1:] if like[:1].isupper() else part
        for like, part in zip(model_parts, parts, strict=True)
    )
