"""Decides whether a caption grammar can write a sentence, without writing all sentences.

The search keeps sets of positions: what a template can match from where. With `labels` it follows
those labels; without, it takes every wording of every action in every frame with every value, so
it accepts much more than the grammar writes (never less): a sentence it refuses is in no template.
"""

from collections.abc import Iterable

from src.shared.data.captions.language import CaptionLanguage
from src.shared.data.captions.schema import Choice, Labels, Sequence, Slot, normalised, parse

Positions = frozenset[int]


class CaptionMatcher:
    def __init__(self, language: CaptionLanguage, labels: Labels | None = None) -> None:
        self._language = language
        self._labels = labels
        content = language.content
        action = None if labels is None else language.find_action(labels["action"])
        names = list(content.actions) if action is None else [action]
        phrases = [phrase for name in names for phrase in content.actions[name].phrases]
        self._slots: dict[str, set[str]] = {
            "verb": {
                content.verb(verb, form)
                for phrase in phrases
                for verb in phrase.verbs
                for form in (*content.forms, *content.tenses)
            },
            "rest": {rest for phrase in phrases for rest in phrase.rest},
        }
        for words in [content.words, *(frame.words for frame in content.frames)]:
            for name, choices in words.items():
                self._slots.setdefault(name, set()).update(choices)
        for name in names:
            for slot, table in language._slots[name].items():
                self._slots.setdefault(slot, {""}).update(self._entries(slot, table))

    def _entries(self, slot: str, table: dict[str, list[str]]) -> Iterable[str]:
        if self._labels is None:
            return [entry for entries in table.values() for entry in entries]
        return table.get(self._labels.get(slot.split(".")[0], ""), [])

    def accepts(self, text: str) -> bool:
        """Whether it is written; each "d'" may be a frame's shortened "de" or a template's own."""
        first, *rest = text.split("d'")
        forms = [first]
        for part in rest:
            forms = [form + joint + part for form in forms for joint in ("d'", "de ")]
        return any(self._accepts(normalised(form)) for form in forms)

    def _accepts(self, text: str) -> bool:
        self._text = text
        self._memo: dict[tuple[str, int], Positions] = {}
        frames = self._language.content.frames
        start = frozenset((0,))
        templates = {template for frame in frames for template in frame.text}
        return any(len(text) in self._follow(parse(template), start) for template in templates)

    def _follow(self, sequence: Sequence, starts: Positions) -> Positions:
        for node in sequence:
            if not starts:
                break
            if isinstance(node, str):
                literal = normalised(node)
                starts = frozenset(
                    start + len(literal)
                    for start in starts
                    if self._text.startswith(literal, start)
                )
            elif isinstance(node, Slot):
                starts = frozenset(end for start in starts for end in self._fill(node.name, start))
            elif isinstance(node, Choice):
                starts = frozenset(
                    end for option in node.options for end in self._follow(option, starts)
                )
        return starts

    def _fill(self, name: str, start: int) -> Positions:
        key = (name, start)
        if key not in self._memo:
            here = frozenset((start,))
            self._memo[key] = frozenset(
                end
                for template in self._slots.get(name, ())
                for end in self._follow(parse(template.strip()), here)
            )
        return self._memo[key]
