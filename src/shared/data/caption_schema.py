"""The shape of a caption file, and how its mistakes are reported; the format is told in en.yaml."""

import re
from collections.abc import Iterator
from typing import Any, Self

from pydantic import ConfigDict, Field, ValidationError, field_validator, model_validator

from ..config_schema import Config
from ..errors import UserError
from .caption_grammar import parse, slots_in

OTHER = "other"  # the key that stands for every action or value without an entry of its own
BUILT_IN = frozenset({"verb", "rest", "value", "action"})
SlotTables = dict[str, dict[str, list[str]]]


class _Section(Config):
    model_config = ConfigDict(coerce_numbers_to_str=True)


class Frame(_Section):
    """Sentence frames that share a verb form and its words (subject, possessive, ...)."""

    form: str
    text: list[str] = Field(min_length=1)
    words: dict[str, list[str]] = Field({})
    weight: int = Field(1, ge=1)


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
    keep: list[str] = Field([])

    @field_validator("keep")
    @classmethod
    def _compiles(cls, keep: list[str]) -> list[str]:
        for pattern in keep:
            try:
                re.compile(pattern)
            except re.error as error:
                raise ValueError(f"{pattern!r} is no regular expression: {error}") from error
        return keep


class LanguageFile(_Section):
    """One language's captions."""

    language: str = Field(min_length=2)
    name: str
    forms: list[str] = Field(min_length=1)
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
        for key, form in self._named_forms():
            if form not in self.forms:
                raise ValueError(f"{key}: form {form!r} is not one of {', '.join(self.forms)}")
        for key, verb in self._verbs():
            if len(verb.split("|")) != len(self.forms):
                raise ValueError(
                    f"{key}: verb {verb!r} needs {len(self.forms)} forms separated by '|': "
                    f"{' | '.join(self.forms)} ('-' where there is none)"
                )
        known = BUILT_IN | self.words.keys() | self.slots.keys()
        for frame in self.frames:
            known |= frame.words.keys()
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

    def _named_forms(self) -> Iterator[tuple[str, str]]:
        for i, frame in enumerate(self.frames):
            yield f"frames.{i}.form", frame.form
        for key, phrase in self._phrases():
            for form in phrase.forms or []:
                yield f"{key}.forms", form

    def _phrases(self) -> Iterator[tuple[str, Phrase]]:
        for name, action in self.actions.items():
            for i, phrase in enumerate(action.phrases):
                yield f"actions.{name}.phrases.{i}", phrase

    def _verbs(self) -> Iterator[tuple[str, str]]:
        for key, phrase in self._phrases():
            for verb in phrase.verbs:
                yield f"{key}.verbs", verb

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
        key = ".".join(str(part) for part in first["loc"])
        message = first["msg"].removeprefix("Value error, ")
        where = f"{key}: {message}" if key else message
        if first["type"] == "extra_forbidden":
            where = f"{key}: unknown key; check its spelling and its place"
        raise UserError(f"caption file {source}: {where}") from error
