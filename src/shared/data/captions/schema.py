"""Caption files: the template language, the shape of a file, and how its mistakes are reported.

A template holds `{slot}`, `(a|b|)` alternatives and plain text; it is parsed once into a tree, and
a caption is one walk through the tree. The format of a file is described in en.yaml.
"""

import random
import re
import unicodedata
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, Self, TypeVar

from pydantic import AfterValidator, ConfigDict, Field, ValidationError, model_validator

from ...config_schema import Config
from ...errors import UserError, first_fault

T = TypeVar("T")
Labels = dict[str, str]


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
    """Parse one template; raises ValueError for what is not closed or a slot without a name."""
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
    return "".join(filter(str.isalnum, folded))


OTHER = "other"  # the key that stands for every action or value without an entry of its own
BUILT_IN = frozenset({"verb", "rest", "value", "action"})
SlotTables = dict[str, dict[str, list[str]]]


class _Section(Config):
    model_config = ConfigDict(coerce_numbers_to_str=True)


def _compiles(pattern: str) -> str:
    try:
        re.compile(pattern)
    except re.error as error:
        raise ValueError(f"{pattern!r} is no regular expression: {error}") from error
    return pattern


Pattern = Annotated[str, AfterValidator(_compiles)]


class Frame(_Section):
    """Sentence frames that share a verb form and its words (subject, possessive, ...)."""

    form: str
    text: list[str] = Field(min_length=1)
    words: dict[str, list[str]] = Field({})
    weight: int = Field(1, ge=1)


class Tense(_Section):
    """A verb form made of another one: in each step the first rule that fits changes it once.

    A verb that no rule of a step fits stays as it is there; one that a rule makes "-" has no such
    form.
    """

    of: str
    steps: list[list[tuple[Pattern, str]]] = Field(min_length=1)

    def __call__(self, verb: str) -> str:
        """The form of a verb, both as templates."""
        for step in self.steps if verb != "-" else ():
            for pattern, replacement in step:
                changed, times = re.subn(pattern, replacement, verb, count=1)
                if times:
                    verb = changed
                    break
        return verb


class Phrase(_Section):
    """A set of exchangeable verbs with the wordings that may follow them."""

    verbs: list[str] = Field(min_length=1)
    rest: list[str] = Field([""], min_length=1)
    when: dict[str, list[str] | str] = Field({})
    unless: dict[str, list[str] | str] = Field({})
    forms: list[str] | None = None
    weight: int = Field(1, ge=1)


class Action(_Section):
    """How one action is put into words."""

    name: str
    aliases: list[str] = Field([])
    slots: SlotTables = Field({})
    phrases: list[Phrase] = Field(min_length=1)


class Paraphrases(_Section):
    """Whole sentences that ask for the given labels."""

    labels: dict[str, str]
    text: list[str] = Field(min_length=1)


class MirrorTable(_Section):
    """Words that change places when a motion is mirrored, and phrases that do not."""

    pairs: list[tuple[str, str]] = Field(min_length=1)
    one_way: list[tuple[str, str]] = Field([])
    keep: list[Pattern] = Field([])


class LanguageFile(_Section):
    """One language's captions."""

    language: str = Field(min_length=2)
    name: str
    forms: list[str] = Field(min_length=1)
    tenses: dict[str, Tense] = Field({})
    spaces: bool = True
    sentence_end: str = "."
    contractions: list[tuple[str, str]] = Field([])
    words: dict[str, list[str]] = Field({})
    frames: list[Frame] = Field(min_length=1)
    slots: SlotTables = Field({})
    actions: dict[str, Action] = Field(min_length=1)
    sentences: list[Paraphrases] = Field([])
    paraphrases: list[Paraphrases] = Field([])
    mirror: MirrorTable

    @model_validator(mode="after")
    def _check(self) -> Self:
        if OTHER not in self.actions:
            raise ValueError(f"actions.{OTHER}: missing; it words the actions without an entry")
        forms = list(self.forms)
        for name, tense in self.tenses.items():  # of one that stands before it
            _check_form(f"tenses.{name}.of", tense.of, forms)
            forms.append(name)
        for i, frame in enumerate(self.frames):
            _check_form(f"frames.{i}.form", frame.form, forms)
        for key, phrase in self._phrases():
            for form in phrase.forms or []:
                _check_form(f"{key}.forms", form, forms)
        for key, verb in ((key, verb) for key, phrase in self._phrases() for verb in phrase.verbs):
            if len(verb.split("|")) != len(self.forms):
                raise ValueError(
                    f"{key}.verbs: verb {verb!r} needs {len(self.forms)} forms separated by '|': "
                    f"{' | '.join(self.forms)} ('-' where there is none)"
                )
        known = BUILT_IN | self.words.keys() | self.slots.keys()
        known = known.union(*(frame.words for frame in self.frames))
        for key, template, more in self._templates():
            try:
                names = set(slots_in(parse(template)))
            except ValueError as error:
                raise ValueError(f"{key}: {error}") from error
            if unknown := sorted(names - known - more):
                raise ValueError(
                    f"{key}: unknown slot {{{unknown[0]}}} in {template!r}; "
                    f"known: {', '.join(sorted(known | more))}"
                )
        return self

    def verb(self, forms: str, form: str) -> str:
        """A form of a verb, of which a file holds some; "-" where there is none."""
        if tense := self.tenses.get(form):
            return tense(self.verb(forms, tense.of))
        return forms.split("|")[self.forms.index(form)].strip()

    def _phrases(self) -> Iterator[tuple[str, Phrase]]:
        for name, action in self.actions.items():
            for i, phrase in enumerate(action.phrases):
                yield f"actions.{name}.phrases.{i}", phrase

    def _templates(self) -> Iterator[tuple[str, str, frozenset[str]]]:
        """Yield (key, template, slots known only there) of every template of the file."""
        nothing: frozenset[str] = frozenset()
        yield from _lists("words", self.words, nothing)
        for i, frame in enumerate(self.frames):
            yield from _lists(f"frames.{i}.words", frame.words, nothing)
            yield from _lists(f"frames.{i}", {"text": frame.text}, nothing)
        for name, table in self.slots.items():
            yield from _lists(f"slots.{name}", table, nothing)
        for action_name, action in self.actions.items():
            own, key = frozenset(action.slots), f"actions.{action_name}"
            for name, table in action.slots.items():
                yield from _lists(f"{key}.slots.{name}", table, own)
            for i, phrase in enumerate(action.phrases):
                verbs = [form for verb in phrase.verbs for form in verb.split("|")]
                yield from _lists(f"{key}.phrases.{i}", {"verbs": verbs, "rest": phrase.rest}, own)


def _check_form(key: str, form: str, forms: Collection[str]) -> None:
    if form not in forms:
        raise ValueError(f"{key}: form {form!r} is not one of {', '.join(forms)}")


def _lists(
    key: str, lists: dict[str, list[str]], more: frozenset[str]
) -> Iterator[tuple[str, str, frozenset[str]]]:
    for name, templates in lists.items():
        for template in templates:
            yield f"{key}.{name}", template, more


def validate_language(content: dict[str, Any], source: str) -> LanguageFile:
    """Check one language's content.

    Raises:
        UserError: something is missing, misspelt or of the wrong type; names file and key.
    """
    try:
        return LanguageFile.model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        fault = first_fault(error)
        if first["type"] == "extra_forbidden":
            fault = fault.replace(first["msg"], "unknown key; check its spelling and its place")
        raise UserError(f"caption file {source}: {fault}") from error
