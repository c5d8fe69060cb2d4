"""Captions from labels, in every language that has a caption file, and their mirror image.

And captions for training with a few words missing, or with made-up ones: what is left must still
mean the motion.
"""

import random
import zlib
from collections.abc import Collection, Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...config_loader import load_yaml, packaged_config
from ...errors import UsageError, UserError
from .language import CaptionLanguage
from .schema import Labels, validate_language

KEPT = 20  # of so many sentences one calibrates
EAST_ASIAN = 0x3000  # from here on, scripts are written without spaces
IDEOGRAPHS = (0x4E00, 0x9FFF)  # Unicode's main block, which Chinese and Japanese share
KIND_OF = {  # actions whose sentences are not outside where this one is known
    "jog": "run", "hop": "jump", "jump-turn": "jump", "jumping-jacks": "jump", "pivot": "turn",
    "whirl": "spin", "circle": "walk", "zigzag": "walk", "zombie": "walk", "crouch": "squat",
    "roundhouse-kick": "kick", "soccer-kick": "kick", "karate": "kick", "stab": "slash",
    "salsa": "dance", "breakdance": "dance", "indian-dance": "dance", "charleston": "dance",
    "jackson-dance": "dance", "body-roll": "dance", "fist-pump": "raise", "reach": "raise",
    "direct-traffic": "guide", "fight-stance": "punch", "taunt": "call", "listen": "respond",
}  # fmt: skip
HOW_TO_ADD = (
    "add a caption file with 'language: {code}' and a 'mirror:' table "
    "(the format is described in src/configs/captions/en.yaml)"
)


class CaptionBook:
    """Captions in several languages.

    Labels are `{key: value}` with at least an `action`; keys and values that the caption files do
    not know are worded by their `other` entries or left out.
    """

    def __init__(self, languages: Iterable[CaptionLanguage]) -> None:
        self._languages = {language.code: language for language in languages}

    @classmethod
    def load(cls, path: Path | str | None = None) -> "CaptionBook":
        """The packaged captions, extended or replaced by a user's file or folder of files.

        A file is one language; its tables are laid over the packaged ones of that language, or
        stand alone where it says `extends: nothing` (then only such languages are in the book).

        Raises:
            UserError: the path does not exist, is not YAML, or breaks the format (file and key).
        """
        if path is None:
            return packaged_book()
        packaged = _packaged_content()
        merged: dict[str, dict[str, Any]] = {}
        source: dict[str, str] = {}
        alone = False
        for file in _caption_files(Path(path)):
            content = dict(load_yaml(file))
            code = str(content.get("language", ""))
            extends = content.pop("extends", "packaged")
            if extends not in ("packaged", "nothing"):
                raise UserError(
                    f"caption file {file}: extends: {extends!r} is neither 'packaged' nor 'nothing'"
                    "; write one of them"
                )
            alone |= extends == "nothing"
            base = packaged.get(code, {}) if extends == "packaged" else {}
            merged[code] = overlay(merged.get(code, base), content)
            source[code] = str(file)
        languages = [
            CaptionLanguage(validate_language(content, source[code]))
            for code, content in merged.items()
        ]
        if not alone:
            languages += [
                language
                for code, language in packaged_book()._languages.items()
                if code not in merged
            ]
        return cls(languages)

    @property
    def languages(self) -> tuple[str, ...]:
        """Language codes, sorted."""
        return tuple(sorted(self._languages))

    def language(self, code: str) -> CaptionLanguage:
        """One language of the book; raises UserError where it is not here."""
        if code not in self._languages:
            raise UserError(
                f"no captions in language {code!r}; supported: {', '.join(self.languages)}; "
                + HOW_TO_ADD.format(code=code)
            )
        return self._languages[code]

    def captions(
        self, labels: Labels, *, num: int, seed: int, whole_sentences: bool = True
    ) -> dict[str, list[str]]:
        """Training captions: up to `num` different ones per language, the same for one seed.

        Without whole sentences they are those of the grammar alone.
        """
        key = "|".join(f"{name}={labels[name]}" for name in sorted(labels))
        return {
            code: self._languages[code].captions(
                labels, num, random.Random(f"{seed}|{code}|{key}"), whole_sentences=whole_sentences
            )
            for code in self.languages
        }

    def canonical(self, labels: Labels) -> dict[str, str]:
        """One plain caption per language."""
        return {code: self._languages[code].canonical(labels) for code in self.languages}

    def paraphrases(self, labels: Labels) -> dict[str, list[str]]:
        """Held-out sentences that ask for (at most) these labels; `captions` never writes them.

        A language without a fitting entry gives an empty list.
        """
        return {code: self._languages[code].paraphrases(labels) for code in self.languages}

    def control_tasks(self) -> list[Labels]:
        """Every label set that has paraphrases, in the order of the caption files."""
        tasks: list[Labels] = []
        for code in self.languages:
            for entry in self._languages[code].control_tasks:
                if entry.labels not in tasks:
                    tasks.append(dict(entry.labels))
        return tasks

    def combinations(self) -> list[Labels]:
        """Every label set that has whole sentences in some language, sorted."""
        keys = {key for language in self._languages.values() for key in language.sentence_keys()}
        return [dict(key) for key in sorted(keys)]

    def outside(self, actions: Collection[str], lang: str) -> list[str]:
        """Hand-written sentences of a language that ask for none of these actions, nor for a kind
        of one; none of a language that is not here."""
        if lang not in self._languages:
            return []
        language, found = self.language(lang), []
        for labels in self.combinations():
            action = labels.get("action", "")
            if action not in actions and KIND_OF.get(action) not in actions:
                found += language.sentences(labels)
        return found

    def written(self, labels: Labels, lang: str) -> list[str]:
        """The hand-written training sentences of these labels, without those that calibrate."""
        texts = self.language(lang).sentences(labels)
        return [text for text in texts if not self.kept_to_calibrate(text, lang)]

    def written_of(self, actions: Collection[str], lang: str) -> set[str]:
        """Those of all labels of these actions."""
        every = map(dict, self.language(lang).sentence_keys())
        chosen = (labels for labels in every if labels.get("action") in actions)
        return {text for labels in chosen for text in self.written(labels, lang)}

    def mirror_text(self, text: str, lang: str) -> str:
        """Text of the mirrored motion: left and right exchanged in all their forms.

        Raises:
            UserError: the language has no mirror table.
        """
        return self.language(lang).mirror(text)

    def kept_to_calibrate(self, text: str, lang: str) -> bool:
        """One caption in twenty, with its mirror image, that a text tower does not train on and its
        detector learns from."""
        return zlib.crc32(min(text, self.mirror_text(text, lang)).encode()) % KEPT == 0


@lru_cache(maxsize=1)
def _packaged_content() -> dict[str, dict[str, Any]]:
    contents: dict[str, dict[str, Any]] = {}
    for file in sorted(packaged_config("captions").glob("*.yaml")):
        content = load_yaml(file)
        contents[content["language"]] = content
    for file in sorted(packaged_config("sentences").glob("*.yaml")):  # apart, as they are long
        content = load_yaml(file)
        contents[content["language"]]["sentences"] = content["sentences"]
    return contents


@lru_cache(maxsize=1)
def packaged_book() -> CaptionBook:
    """The captions that come with the project."""
    return CaptionBook(
        CaptionLanguage(validate_language(content, f"captions/{code}.yaml"))
        for code, content in _packaged_content().items()
    )


def overlay(base: dict[str, Any], update: dict[str, Any]) -> dict[str, Any]:
    """`update` laid over `base`: mappings merge key by key, everything else is replaced."""
    result = dict(base)
    for key, value in update.items():
        old = result.get(key)
        if isinstance(old, dict) and isinstance(value, dict):
            value = overlay(old, value)
        result[key] = value
    return result


def drop_words(caption: str, share: float, rng: np.random.Generator) -> str:
    """The caption without a random share of its words; never less than one of them.

    Text without spaces (Japanese, Chinese) loses characters instead.

    Args:
        share: chance of each word to go, 0 to 1.
        rng: consumed once a word.
    """
    if share <= 0:
        return caption
    joint, words = _words(caption)
    kept = [word for word, draw in zip(words, rng.random(len(words)), strict=True) if draw >= share]
    shortened = joint.join(kept)
    return shortened if shortened.strip() else caption


def insert_babble(caption: str, letters_of: str, rng: np.random.Generator) -> str:
    """The caption with up to three made-up words in it, as a stand-in for words never seen.

    In text without spaces a made-up word may be one character, and half of its characters are
    drawn from all ideographs: a small tokenizer does not know most of them, and the tower has to
    learn to overhear its unknown token too.

    Args:
        letters_of: a text of the same language, whose letters the words are drawn from.
        rng: consumed a varying number of times.
    """
    joint, words = _words(caption)
    letters = [letter for letter in letters_of if letter.isalpha()]
    if not letters:
        return caption
    for _ in range(int(rng.integers(1, 4))):
        length = int(rng.integers(2, 9) if joint else rng.integers(1, 5))
        word = "".join(letters[index] for index in rng.integers(len(letters), size=length))
        if not joint:
            strange = rng.integers(*IDEOGRAPHS, size=length)
            word = "".join(
                chr(code) if draw < 0.5 else letter
                for code, draw, letter in zip(strange, rng.random(length), word, strict=True)
            )
        edges = (0, len(words))  # politeness and context stand at the ends more often than inside
        place = edges[int(rng.integers(2))] if rng.random() < 0.7 else rng.integers(len(words) + 1)
        words.insert(int(place), word)
    return joint.join(words)


def insert_word(caption: str, of: str, rng: np.random.Generator) -> str:
    """The caption with a word of another text in it, or, of a text without spaces, two letters."""
    (joint, words), (apart, others) = _words(caption), _words(of)
    if not apart:
        others = [of[at : at + 2] for at in range(max(1, len(of) - 1))]
    words.insert(int(rng.integers(len(words) + 1)), others[int(rng.integers(len(others)))])
    return joint.join(words)


def piece_of(caption: str, following: str, rng: np.random.Generator) -> str:
    """Up to six words of the caption that follow each other, or, in half of the cases, of its
    end and the beginning of another: what parting a sentence asks about. Of text without spaces
    twice as many letters."""
    joint, words = _words(caption)
    more = following.split() if joint else list(following)
    start = int(rng.integers(len(words)))
    length = int(rng.integers(1, 7 if joint else 13))
    words += more if rng.random() < 0.5 else []
    piece = joint.join(words[start : start + length])
    return piece if any(letter.isalnum() for letter in piece) else caption


def _words(text: str) -> tuple[str, list[str]]:
    """What stands between the words of a text, and these; letters in scripts without spaces."""
    if any(ord(letter) >= EAST_ASIAN for letter in text):
        return "", list(text)
    return " ", text.split()


def _caption_files(path: Path) -> list[Path]:
    if path.is_dir():
        found = sorted([*path.glob("*.yaml"), *path.glob("*.yml")])
        if not found:
            raise UserError(
                f"no caption files (*.yaml) in {path}; name a file or a folder that holds some"
            )
        return found
    if not path.is_file():
        raise UsageError(f"caption file {path} does not exist; check the path")
    return [path]
