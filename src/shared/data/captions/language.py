"""One language's captions: choose frame, verb and wording for a set of labels, write them out."""

import random
import re
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from typing import Any

from .requests import requested
from .schema import (
    OTHER,
    Frame,
    Labels,
    LanguageFile,
    MirrorTable,
    Paraphrases,
    Phrase,
    Sequence,
    SlotTables,
    normalised,
    parse,
    pick,
    render,
    slots_in,
    tidy,
    without,
)


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


Pair = tuple[Sequence, Sequence]  # a verb and what follows it
Sentences = dict[tuple[tuple[str, str], ...], list[str]]  # by their labels
SENTENCE_RATE = 0.3  # share of captions written as a sentence: capital letter and full stop
_BRACES = re.compile(r"(\{[^{}]*\})")


@dataclass(frozen=True)
class Wording:
    """One way to say it: a sentence frame and the (verb, rest) pairs that fit the labels in it."""

    frame: Frame
    text: Sequence
    pairs: tuple[Pair, ...]


class CaptionLanguage:
    """Captions, held-out paraphrases and mirrored text of one language."""

    def __init__(self, content: LanguageFile) -> None:
        self.content = content
        self.code = content.language
        self.mirror = TextMirror(content.mirror, content.spaces)
        self._slots = {
            name: self._with_mirrored(
                content.slots
                | {slot: content.slots.get(slot, {}) | own for slot, own in action.slots.items()}
            )
            for name, action in content.actions.items()
        }
        self._plan = lru_cache(maxsize=4096)(self._make_plan)
        self._wordings = lru_cache(maxsize=4096)(self._make_wordings)
        self._verb = cache(content.verb)

    # -------------------------------------------------------------- what callers ask for

    def captions(
        self, labels: Labels, num: int, rng: random.Random, *, whole_sentences: bool = True
    ) -> list[str]:
        """Up to `num` different captions; fewer only where the templates allow no more.

        Up to half of them are whole sentences, where they are wanted and the file has some for
        these labels. The hand-written requests that models are measured by are never among them.
        """
        plan = self._plan(self._key(labels))
        whole = self.sentences(labels)
        whole = rng.sample(whole, min(len(whole), num // 2 if whole_sentences else 0))
        found = {normalised(text): text for text in whole}
        for _ in range(30 * num):
            if len(found) >= num:
                break
            text = self._write(labels, plan, rng)
            said = normalised(text)
            if said not in requested(self.code):
                found.setdefault(said, text)
        return list(found.values())

    def sentences(self, labels: Labels) -> list[str]:
        """The hand-written training sentences of these labels, and mirror images of others."""
        return self._sentences.get(self._key(spoken_labels(labels)), [])

    def sentence_keys(self) -> list[tuple[tuple[str, str], ...]]:
        """Label sets that have whole sentences, as sorted pairs."""
        return list(self._sentences)

    def canonical(self, labels: Labels) -> str:
        """The plainest caption: first frame, first verb, first words."""
        return self._write(labels, self._plan(self._key(labels)), None)

    def paraphrases(self, labels: Labels) -> list[str]:
        """Held-out sentences of the most specific entry whose labels are all among `labels`.

        Of equally specific ones the last counts: a file goes from the general to the special.
        """
        wanted = labels | {"action": self.find_action(labels.get("action", ""))}
        best: list[str] = []
        most = 0
        for entry in self.control_tasks:
            fits = all(wanted.get(key) == value for key, value in entry.labels.items())
            if fits and len(entry.labels) >= most:
                best, most = entry.text, len(entry.labels)
        return list(best)

    @cached_property
    def control_tasks(self) -> list[Paraphrases]:
        """The paraphrase entries, with the mirror image of each entry that is not written out."""
        entries = list(self.content.paraphrases)
        written = [entry.labels for entry in entries]
        for entry in self.content.paraphrases:
            labels = mirror_labels(entry.labels)
            if labels not in written:
                text = [self.mirror(line) for line in entry.text]
                entries.append(Paraphrases(labels=labels, text=text))
        return entries

    def find_action(self, action: str) -> str:
        """The entry that words an action: its own name, that of an alias, or 'other'."""
        name = re.sub(r"[\s_]+", "-", action.strip().lower())
        if name in self.content.actions:
            return name
        for key, entry in self.content.actions.items():
            if name in entry.aliases:
                return key
        return OTHER

    # -------------------------------------------------------------- choosing

    @staticmethod
    def _key(labels: Labels) -> tuple[tuple[str, str], ...]:
        return tuple(sorted((key, str(value)) for key, value in labels.items()))

    def _make_plan(self, key: tuple[tuple[str, str], ...]) -> tuple[Wording, ...]:
        """All wordings that state every label once; where there are none, the fullest ones."""
        labels = dict(key)
        name = self.find_action(labels.get("action", ""))
        stated = frozenset(
            label for label in labels if label != "action" and self._says(name, label, labels)
        )
        worded = frozenset(slot for slot in self._slots[name] if self._entries(name, slot, labels))
        phrases = self.content.actions[name].phrases
        allowed = tuple(n for n, phrase in enumerate(phrases) if _allowed(phrase, labels))
        return self._wordings(name, stated, worded, allowed or tuple(range(len(phrases))))

    def _says(self, action: str, label: str, labels: Labels) -> bool:
        """Whether any slot of this label has words for its value."""
        return any(
            any(self._entries(action, name, labels))
            for name in self._slots[action]
            if name.split(".")[0] == label
        )

    def _entries(self, action: str, name: str, labels: Labels) -> list[str]:
        label = name.split(".")[0]
        value = labels.get(label, "")
        table = self._slots[action].get(name)
        if not value or table is None:
            return []
        return table.get(str(value)) or table.get(OTHER) or []

    def _make_wordings(
        self,
        action: str,
        stated: frozenset[str],
        worded: frozenset[str],
        allowed: tuple[int, ...],
    ) -> tuple[Wording, ...]:
        """The fullest wordings; they depend on which slots have words, and not on the words."""
        table = self._slots[action]
        phrases = [self.content.actions[action].phrases[number] for number in allowed]

        @cache  # many frames differ in their subject alone
        def pairs_for(form: str, framed: frozenset[str]) -> tuple[int, tuple[Pair, ...]] | None:
            """How many labels the fullest pairs leave out, and the pairs."""
            found: list[tuple[Sequence, list[Sequence], list[int | None], int]] = []
            for phrase in phrases:
                if phrase.forms is not None and form not in phrase.forms:
                    continue
                said = _labels(framed).union(phrase.when)
                ends = [_sparing(rest, said) for rest in phrase.rest]
                slots = [_slots(rest) - said for rest in phrase.rest]
                lacking: dict[frozenset[str], list[int | None]] = {}  # most verbs have no slots
                for words in (self._verb(verb, form) for verb in phrase.verbs):
                    if words == "-":
                        continue
                    own = _slots(words)
                    if own not in lacking:
                        lacking[own] = [
                            _missing((framed, own, each), phrase, stated, worded) for each in slots
                        ]
                    found.append((parse(words), ends, lacking[own], phrase.weight))
            counts = {missing for *_, row, _ in found for missing in row if missing is not None}
            if not counts:
                return None
            fewest = min(counts)
            pairs: list[Pair] = []
            for start, ends, row, weight in found:
                for end, missing in zip(ends, row, strict=True):
                    if missing == fewest:
                        pairs += [(start, end)] * weight
            return fewest, tuple(pairs)

        scored = [
            (frame, template, pairs)
            for frame in self.content.frames
            for template in frame.text
            if (pairs := pairs_for(frame.form, _slots(template).intersection(table)))
        ]
        fewest = min(missing for *_, (missing, _) in scored)
        return tuple(
            wording
            for frame, template, (missing, pairs) in scored
            if missing == fewest
            for wording in [Wording(frame, parse(template), pairs)] * frame.weight
        )

    # -------------------------------------------------------------- writing

    def _write(self, labels: Labels, plan: tuple[Wording, ...], rng: random.Random | None) -> str:
        wording = pick(plan, rng)
        verb, rest = pick(wording.pairs, rng)
        action = self.find_action(labels.get("action", ""))
        chosen: dict[str, str] = {}  # a word is chosen once for the whole sentence

        def fill(name: str) -> str:
            if name == "verb":
                return render(verb, fill, rng)
            if name == "rest":
                return render(rest, fill, rng)
            label = name.split(".")[0]
            if name == "action":
                return labels.get("action", "").replace("-", " ").replace("_", " ")
            words = wording.frame.words.get(name) or self.content.words.get(name)
            if words:
                if name not in chosen:
                    chosen[name] = render(parse(pick(words, rng)), fill, rng)
                return chosen[name]
            entries = self._entries(action, name, labels)
            if not entries:
                return ""
            text = pick(entries, rng).replace("{value}", str(labels[label]).replace("-", " "))
            return render(parse(text), fill, rng)

        text = tidy(render(wording.text, fill, rng), self.content.spaces)
        for pattern, contracted in self.content.contractions:
            text = re.sub(pattern, contracted, text)
        if rng is not None and rng.random() < SENTENCE_RATE:
            text = text[:1].upper() + text[1:] + self.content.sentence_end
        return text

    def _with_mirrored(self, tables: SlotTables) -> SlotTables:
        """Fill in `right` from `left`, and so on, where a table words only one side."""
        result: SlotTables = {}
        for name, table in tables.items():
            full = dict(table)
            for value, entries in table.items():
                other = mirror_value(value)
                if other not in table:
                    full[other] = [self._mirror_template(entry) for entry in entries]
            result[name] = full
        return result

    @cached_property
    def _sentences(self) -> Sentences:
        """The file's sentences by their labels, and their mirror images."""
        found: Sentences = {}
        for entry in self.content.sentences:
            mirrored = mirror_labels(entry.labels)
            for line in entry.text:
                if normalised(line) in requested(self.code):
                    continue
                found.setdefault(self._key(entry.labels), []).append(line)
                # a southpaw has no mirror image
                if mirrored != entry.labels and (image := self.mirror(line)) != line:
                    found.setdefault(self._key(mirrored), []).append(image)
        return found

    def _mirror_template(self, template: str) -> str:
        parts = _BRACES.split(template)
        return "".join(part if part.startswith("{") else self.mirror(part) for part in parts)


def spoken_labels(labels: Labels) -> Labels:
    """Without what nobody says: once, at normal speed, by a right angle."""
    silent = (("count", "1"), ("speed", "normal"), ("angle", "90"))
    return {key: str(value) for key, value in labels.items() if (key, str(value)) not in silent}


def _allowed(phrase: Phrase, labels: Labels) -> bool:
    if any(labels.get(label) not in _values(values) for label, values in phrase.when.items()):
        return False
    return all(labels.get(label) not in _values(values) for label, values in phrase.unless.items())


def _values(values: Any) -> list[str]:
    return [values] if isinstance(values, str) else list(values)


def _missing(
    parts: tuple[frozenset[str], ...],
    phrase: Phrase,
    stated: frozenset[str],
    worded: frozenset[str],
) -> int | None:
    """How many labels a wording with these slots leaves out; None if it would say one twice.

    A dotted slot ("with {side.hand}") makes no sense without its words: that counts double.
    """
    used = [label for slots in parts for label in _labels(slots)]
    used += phrase.when
    mentioned = [label for label in used if label in stated]
    if len(mentioned) > len(set(mentioned)):
        return None
    dangling = {name for slots in parts for name in slots if "." in name} - worded
    return len(stated) - len(mentioned) + 2 * len(dangling)


@cache
def _slots(template: str) -> frozenset[str]:
    return frozenset(slots_in(parse(template)))


@cache
def _labels(slots: frozenset[str]) -> frozenset[str]:
    return frozenset(name.split(".")[0] for name in slots)


@cache
def _sparing(rest: str, said: frozenset[str]) -> Sequence:
    return without(parse(rest), said)


_SIDES = re.compile(r"(?<![a-z])(left|right|clockwise|counterclockwise)(?![a-z])")
_OPPOSITE = {
    "left": "right",
    "right": "left",
    "clockwise": "counterclockwise",
    "counterclockwise": "clockwise",
}


def mirror_value(value: str) -> str:
    """A label value with left and right exchanged."""
    return _SIDES.sub(lambda match: _OPPOSITE[match.group()], value)


def mirror_labels(labels: Labels) -> Labels:
    """Labels of the mirrored motion: `left` and `right` exchanged in every value."""
    return {key: mirror_value(str(value)) for key, value in labels.items()}
