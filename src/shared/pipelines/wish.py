"""What a sentence asks of recorded figures: of which kinds, how lively; or that it asks for more.

"somebody dances salsa" -> Wish({"salsa"}); "an old man dances" -> None: no figure shows it
"""

import re
import unicodedata
from collections.abc import Collection
from functools import cache

from ..config_loader import load_yaml, packaged_config
from .choreography import Wish

CALM, LIVELY = (0.0, 0.4), (0.5, 1.0)  # shares of the figures by their energy
_WORD = re.compile(r"[^\W\d_]")


def wish_of(sentence: str, kinds: Collection[str]) -> Wish | None:
    """What a sentence asks of figures of some kinds; None where they cannot show it.

    Args:
        sentence: in any of the six languages.
        kinds: of the figures that there are; their own names are understood, too.
    """
    rest = unicodedata.normalize("NFC", sentence).casefold()
    dances, energy, wanted = False, (0.0, 1.0), set()
    names = {name.casefold(): ("kinds", name) for name in kinds}
    for word, (about, kind) in sorted(
        (_words() | names).items(), key=lambda item: len(item[0]), reverse=True
    ):
        left, found = _pattern(word).subn(" ", rest)
        if not found:
            continue
        rest = left
        dances |= about in ("dance", "kinds")
        energy = {"calm": CALM, "lively": LIVELY}.get(about, energy)
        if about == "kinds":
            wanted.add(kind)
    if not dances or _WORD.search(rest) or not wanted <= set(kinds):
        return None
    return Wish(frozenset(wanted), energy)


@cache
def _words() -> dict[str, tuple[str, str]]:
    """Each word with what it is about and, of a kind, which."""
    found: dict[str, tuple[str, str]] = {}
    for table in load_yaml(packaged_config("dances.yaml")).values():
        for about in ("plain", "calm", "lively", "dance"):
            found |= {word.casefold(): (about, "") for word in table[about]}
        for kind, words in table["kinds"].items():
            found |= {word.casefold(): ("kinds", kind) for word in words}
    return found


@cache
def _pattern(word: str) -> re.Pattern[str]:
    """The word where it stands alone, or anywhere in writing that parts no words."""
    escaped = re.escape(word)
    parted = word.isascii() or unicodedata.name(word[0], "").startswith("LATIN")
    return re.compile(rf"(?<!\w){escaped}(?!\w)" if parted else escaped)
