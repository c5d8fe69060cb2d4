"""The little template language of captions: `{slot}`, `(a|b|)` alternatives, and plain text.

A template is parsed once into a tree; a caption is one walk through the tree. Nothing here knows
about languages or labels.
"""

import random
import re
import unicodedata
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import cache
from typing import TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Slot:
    """A name in braces, to be filled in."""

    name: str


@dataclass(frozen=True)
class Choice:
    """Alternatives in parentheses; one is taken."""

    options: tuple["Sequence", ...]


Node = str | Slot | Choice
Sequence = tuple[Node, ...]
_TOKEN = re.compile(r"\{([^{}]*)\}|([()|{}])|([^(){}|]+)")


@cache
def parse(template: str) -> Sequence:
    """Parse one template.

    Raises:
        ValueError: a brace or parenthesis is not closed, or a slot has no name.
    """
    stack: list[list[list[Node]]] = [[[]]]  # open choices > their options > nodes
    for match in _TOKEN.finditer(template):
        slot, mark, text = match.groups()
        if slot is not None:
            if not slot.strip():
                raise ValueError(f"slot without a name in {template!r}")
            stack[-1][-1].append(Slot(slot.strip()))
        elif text is not None:
            stack[-1][-1].append(text)
        elif mark == "(":
            stack.append([[]])
        elif mark == ")" and len(stack) > 1:
            options = tuple(tuple(option) for option in stack.pop())
            stack[-1][-1].append(Choice(options))
        elif mark == "|" and len(stack) > 1:
            stack[-1].append([])
        else:
            raise ValueError(f"stray {mark!r} in {template!r}")
    if len(stack) > 1:
        raise ValueError(f"parenthesis never closed in {template!r}")
    return tuple(stack[0][0])


def slots_in(sequence: Sequence) -> Iterator[str]:
    """Yield the names of all slots of a template."""
    for node in sequence:
        if isinstance(node, Slot):
            yield node.name
        elif isinstance(node, Choice):
            for option in node.options:
                yield from slots_in(option)


def without(sequence: Sequence, names: Collection[str]) -> Sequence:
    """The template without the slots of these names."""
    kept: list[Node] = []
    for node in sequence:
        if isinstance(node, Choice):
            node = Choice(tuple(without(option, names) for option in node.options))
        if not (isinstance(node, Slot) and node.name in names):
            kept.append(node)
    return tuple(kept)


def render(sequence: Sequence, fill: Callable[[str], str], rng: random.Random | None) -> str:
    """Write a template out; `fill` gives the text of a slot, no `rng` takes first alternatives."""
    parts: list[str] = []
    for node in sequence:
        if isinstance(node, str):
            parts.append(node)
        elif isinstance(node, Slot):
            parts.append(fill(node.name))
        else:
            parts.append(render(pick(node.options, rng), fill, rng))
    return "".join(parts)


def pick(options: tuple[T, ...] | list[T], rng: random.Random | None) -> T:
    """One of the options: at random, or the first without a generator."""
    return options[0] if rng is None else options[int(rng.random() * len(options))]


def tidy(text: str, spaces: bool) -> str:
    """Remove what dropped slots leave behind: double spaces, stray commas.

    With `spaces` false (Japanese, Chinese) spaces stay only between two Latin words.
    """
    if not spaces:
        text = re.sub(r"(?<=[^\x00-\x7f])\s+|\s+(?=[^\x00-\x7f])", "", text.strip())
        text = re.sub(r"[、，](?=[、，。])", "", text)
    text = re.sub(r"\s+", " ", text)
    text = re.sub(r"\s+(?=[,.;!])", "", text)
    text = re.sub(r",(?:\s*,)+", ",", text)
    return text.strip(" ,、，;")


def normalised(text: str) -> str:
    """Letters and digits only, in small letters: what makes two captions the same."""
    folded = unicodedata.normalize("NFKC", text).casefold()
    return "".join(character for character in folded if character.isalnum())
