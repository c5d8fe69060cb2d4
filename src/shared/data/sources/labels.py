"""Labels of a clip from its file name, and of a caption from its words, by YAML rules."""

import re
from pathlib import Path

from pydantic import BaseModel, ConfigDict, field_validator

from ..captions.schema import Labels
from ..retarget.mapping import load_table


class _Rule(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    pattern: str
    labels: Labels = {}

    @field_validator("pattern")
    @classmethod
    def _compiles(cls, pattern: str) -> str:
        try:
            re.compile(pattern)
        except re.error as error:
            raise ValueError(f"{pattern!r} is not a regular expression: {error}") from None
        return pattern


class FileRule(_Rule):
    """One entry of `files` in labels.yaml."""

    groups: dict[str, dict[str, Labels]] = {}
    skip: str | None = None


class LabelRules(BaseModel):
    """labels.yaml."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    files: tuple[FileRule, ...] = ()
    captions: tuple[_Rule, ...] = ()

    def of_file(self, stem: str) -> tuple[Labels, str | None]:
        """Labels of a file name without its ending, and why to skip it, if so."""
        for rule in self.files:
            if match := re.search(rule.pattern, stem):
                labels = dict(rule.labels)
                for group, value in match.groupdict().items():
                    labels |= rule.groups.get(group, {}).get(value, {group: value})
                return labels, rule.skip
        return {}, None

    def of_caption(self, caption: str) -> Labels:
        """Labels that an English caption implies; empty when no rule fits."""
        for rule in self.captions:
            if re.search(rule.pattern, caption, re.IGNORECASE):
                return dict(rule.labels)
        return {}


def load_label_rules(extra: Path | None = None) -> LabelRules:
    """The user's rules first, then ours."""
    ours = load_table("labels.yaml", LabelRules)
    if extra is None:
        return ours
    theirs = load_table(extra, LabelRules)
    return LabelRules(files=theirs.files + ours.files, captions=theirs.captions + ours.captions)
