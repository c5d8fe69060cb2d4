"""What a sentence says of order and measure: its clauses, and how often, how far, how long each.

    "walks three metres, then waves twice" -> Clause("walks", metres=3), Clause("waves", count=2)

The words are those of src/configs/measures.yaml, all languages at once: a sentence need not say
which one it is in. What a clause asks to be done is left to the text tower.
"""

import re
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import groupby
from typing import Any

from ..config_loader import load_yaml, packaged_config

MAX_COUNT, MAX_METRES, MAX_DEGREES, MAX_SECONDS = 20, 100.0, 720.0, 600.0
_CJK = "\u3040-\u30ff\u3400-\u9fff"
# Classes without case: re would spell out every character of their ranges, seconds in all.
_CJK_SIGN = f"(?-i:[{_CJK}])"
_LETTER, _SIGN = rf"(?-i:[^\W\d{_CJK}])", rf"(?-i:[^\W{_CJK}])"  # of words; or a digit
_COMMAS = r"[,;、，；]"
_EDGES = " \t,;.!?。、，；！？"
_DIGITS = r"\d+(?:[.,]\d+)?"

Known = Callable[[str], str | None]  # the action that a clause alone tells of, None if of none
Arms = Callable[[str], bool]  # whether what a clause asks for is done with the arms alone


@dataclass(frozen=True)
class Clause:
    """One thing to do.

    Attributes:
        text: the sentence's own words for it, without the measures below.
        count: how often.
        degrees: to turn, positive to the left; None where nothing is said.
        metres: to go.
        seconds: to go on.
        meanwhile: the words of what the arms, or `side`'s arm alone, do at the same time.
        side: left, right or both.
    """

    text: str
    count: int = 1
    degrees: float | None = None
    metres: float | None = None
    seconds: float | None = None
    meanwhile: str = ""
    side: str = "both"

    @property
    def plain(self) -> bool:
        """Whether it says nothing but what to do."""
        return self == Clause(self.text)


def clauses(
    sentence: str, known: Known = lambda text: None, arms: Arms = lambda text: False
) -> list[Clause]:
    """The clauses of a sentence in the order in which they are to be done; at least one.

    Where no word tells of an order, a comma or an "and" parts two clauses only if `known` finds an
    action of its own in each: "walks forward and waves", but not "jumps up and down". "Walks while
    waving" and "raises the left hand and waves with the right one" are one clause, with what the
    arms do meanwhile.
    """
    text = unicodedata.normalize("NFKC", " ".join(sentence.split()))
    found: list[Clause] = []
    for whole in _ordered(text):
        both = _together(whole, known, arms)
        found += [both] if both else map(_measured, _joined(whole, known))
    return [clause for clause in found if clause.text] or [Clause(sentence)]


# ---------------------------------------------------------------- order


def _ordered(text: str) -> list[str]:
    """Parts that words of order part, first things first."""
    words = _words()
    if head := words.head_after.match(text):
        first, comma, second = text[head.end() :].partition(",")
        if comma and second.strip(_EDGES):
            return [*_ordered(first), *_ordered(second)]
    if head := words.head_before.match(text):
        second, comma, first = text[head.end() :].partition(",")
        if comma and first.strip(_EDGES):
            return [*_ordered(first), *_ordered(second)]
    for pattern, swapped in (
        (words.then, False),
        (words.earlier, False),
        (words.later, True),
        (words.before, False),
        (words.after, True),
    ):
        for match in pattern.finditer(text):
            left, right = text[: match.start()], text[match.end() :]
            if pattern is words.then:
                left, right = _around(left, right)
            if left.strip(_EDGES) and right.strip(_EDGES):
                parts = (right, left) if swapped else (left, right)
                return [part for each in parts for part in _ordered(each)]
    return [_trimmed(words.then.sub(" ", text) if words.then.match(text) else text)]


def _around(left: str, right: str) -> tuple[str, str]:
    """Clauses on both sides of a word of order; where it stands late in its own clause ("und winkt
    dann"), that begins at the conjunction or comma before it."""
    borders = list(_words().joint.finditer(left))
    own = left[borders[-1].end() :] if borders else ""
    if borders and own.strip(_EDGES) and (len(own.split()) <= 3 or not right.strip(_EDGES)):
        return left[: borders[-1].start()], f"{own.rstrip()} {right.lstrip()}"
    return left, right


def _joined(text: str, known: Known) -> list[str]:
    """The text parted at commas and "and" where each part is an action of its own."""
    pieces = [piece for piece in map(_trimmed, _words().joint.split(text)) if piece]
    if len(pieces) < 2:
        return [text]
    actions = [known(_measured(piece).text) for piece in pieces]
    if None in actions or len(set(actions)) < len(actions):
        return [text]
    return pieces


def _together(text: str, known: Known, arms: Arms) -> Clause | None:
    """A clause and what the arms do meanwhile; None where that is not what a text says."""
    words = _words()
    parts = [part for part in map(_trimmed, words.meanwhile.split(text)) if part]
    at_once = words.meanwhile.search(text) is not None
    if len(parts) == 1:
        parts = [part for part in map(_trimmed, words.joint.split(parts[0])) if part]
    sides = [side_of(part) for part in parts]
    if len(parts) != 2 or not (at_once or set(sides) == {"left", "right"}):
        return None
    if not all(map(known, parts)) or not any(map(arms, parts)):
        return None
    (body, _), (other, side) = sorted(zip(parts, sides, strict=True), key=lambda p: arms(p[0]))
    if at_once or all(map(arms, parts)):
        return replace(_measured(body), meanwhile=other, side=side)
    return None


def side_of(text: str) -> str:
    """left, right, or both where a text names neither or both."""
    left, right = (bool(side.search(text)) for side in (_words().left, _words().right))
    return "both" if left == right else "left" if left else "right"


# ---------------------------------------------------------------- measure


def _measured(text: str) -> Clause:
    """A clause with its measures taken out."""
    words, clause = _words(), Clause(text)
    said = words.angle.sub(" ", text)  # a right angle is on no side
    side = side_of(said)
    for name, pattern in words.units.items():
        match = pattern.search(clause.text)
        if match is None:
            continue
        value = _value(match["number"])
        # Japanese counts and turns with one word: a few 度 are times, many are degrees.
        if name == "degrees" and value < 15:
            continue
        if not 0 < value <= _MOST[name]:
            continue
        found: dict[str, Any] = {"text": _without(clause.text, match), name: value}
        clause = replace(clause, **found)
    if clause.degrees is None and (match := words.angle.search(clause.text)) and side != "both":
        clause = replace(clause, degrees=words.angles[match[0].casefold()])
    if clause.degrees is not None:
        sign = -1.0 if side == "right" else 1.0
        return replace(clause, degrees=sign * clause.degrees)
    if clause.metres is None and clause.seconds is None:
        return _counted(clause)
    return clause


def _counted(clause: Clause) -> Clause:
    """Times, or a bare number before what is done: "twice", "3 times", "x4", "two jumps"."""
    words = _words()
    if match := words.often.search(clause.text):
        number = words.adverbs[match[0].casefold()]
    elif match := words.times.search(clause.text) or words.bare.search(clause.text):
        number = int(_value(next(filter(None, match.groups()))))
    else:
        return clause
    if not 1 < number <= MAX_COUNT:
        return clause
    rest = _without(clause.text, match)
    return replace(clause, text=rest, count=number) if rest else clause


_MOST = {"metres": MAX_METRES, "degrees": MAX_DEGREES, "seconds": MAX_SECONDS}


def _value(text: str) -> float:
    number = _words().numbers.get(text.casefold())
    return float(text.replace(",", ".")) if number is None else float(number)


def _without(text: str, match: re.Match[str]) -> str:
    return _trimmed(f"{text[: match.start()].rstrip()} {text[match.end() :].lstrip()}")


def _trimmed(text: str) -> str:
    return _words().loose.sub("", text.strip(_EDGES)).strip(_EDGES)


# ---------------------------------------------------------------- words


class _Words:
    """The patterns of all languages."""

    def __init__(self, tables: Sequence[dict[str, Any]]) -> None:
        def all_of(key: str) -> list[str]:
            return [word for table in tables for word in table.get(key, [])]

        self.numbers: dict[str, int] = {}
        self.adverbs: dict[str, int] = {}
        self.angles: dict[str, float] = {}
        for table in tables:
            self.numbers |= {w.casefold(): i for i, w in enumerate(table["numbers"], 1)}
            self.numbers |= {w.casefold(): i for w, i in table["more_numbers"].items()}
            self.adverbs |= {w.casefold(): i for i, w in enumerate(table.get("often", []), 1)}
            self.angles |= {w.casefold(): float(i) for w, i in table["angles"].items()}
        joints = all_of("and")
        self.joint = re.compile(rf"\s*{_COMMAS}\s*(?:{_any(joints)}\s)?|{_any(joints)}", re.I)
        self.then = re.compile(rf"{_COMMAS}?\s*{_any(all_of('then'))}{_COMMAS}?", re.I)
        self.earlier = re.compile(_any(all_of("earlier")) + _COMMAS + "?", re.I)
        self.later = re.compile(_any(all_of("later")) + _COMMAS + "?", re.I)
        self.meanwhile = re.compile(rf"{_COMMAS}?\s*{_any(all_of('meanwhile'))}\s*", re.I)
        self.before = re.compile(rf"{_COMMAS}?\s*{_any(all_of('before'))}\s*", re.I)
        self.after = re.compile(rf"{_COMMAS}?\s*{_any(all_of('after'))}\s*", re.I)
        self.head_before = re.compile(rf"{_any(all_of('before'))}\s*", re.I)
        self.head_after = re.compile(rf"{_any(all_of('after'))}\s*", re.I)
        self.left, self.right = (re.compile(_any(all_of(side)), re.I) for side in ("left", "right"))
        self.angle = re.compile(_any(self.angles), re.I)
        self.often = re.compile(_any(self.adverbs), re.I)
        number = rf"(?P<number>{_DIGITS}|{_any(self.numbers)})"
        ready = rf"(?:(?<![\w.,])|(?<={_CJK_SIGN}))"
        self.units = {
            name: re.compile(rf"{_lead()}{ready}{number}[\s-]*{_any(all_of(name))}", re.I)
            for name in ("degrees", "metres", "seconds")
        }
        others = rf"(?![\s-]*{_any(all_of('uncounted'))})"
        times = rf"{_any(all_of('times'))}|(?:{_any(all_of('pieces'))}|[x×](?!\w)){others}"
        self.times = re.compile(rf"{ready}(?:{number}\s*(?:{times})|[x×]\s*(?P<after>\d+))", re.I)
        # A bare number counts what follows it; "one" is mostly somebody, "a" nothing at all.
        several = [word for word, value in self.numbers.items() if value > 1]
        self.bare = re.compile(rf"{ready}(?P<number>\d+|{_any(several)}){others}(?=[\s-]+\w)", re.I)
        self.loose = re.compile(rf"^(?:{_any(joints)})\s+|\s+(?:{_any(joints)})$", re.I)


def _lead() -> str:
    """Words before a measure that mean nothing without it."""
    return r"(?:(?<!\w)(?:for|during|by|durante|por|pendant|de|für|um|von|about)\s+)?"


def _any(words: Sequence[str] | dict[str, Any]) -> str:
    """One of the words, whole where the writing parts words; never empty."""
    longest_first = map(_whole, sorted(words, key=len, reverse=True))
    ordered = sorted(longest_first, key=lambda parts: (parts[0], parts[2]))
    alike = groupby(ordered, key=lambda parts: (parts[0], parts[2]))
    runs = [f"{before}(?:{'|'.join(word for _, word, _ in run)}){after}"
            for (before, after), run in alike]  # fmt: skip
    return "(?:" + "|".join(runs) + ")" if runs else r"(?!)"


def _whole(word: str) -> tuple[str, str, str]:
    """A word's pattern, and what must stand before and behind it."""
    stays, bar, word = word.rpartition("|")
    if bar:
        return f"(?<={stays})", word, ""
    pattern = re.escape(word).replace(r"\ ", r"\s+")
    if re.search(f"[{_CJK}°]", word):
        return "", pattern, ""
    return f"(?<!{_LETTER})", pattern, "" if word.endswith("'") else f"(?!{_SIGN})"


@cache
def _words() -> _Words:
    return _Words(list(_tables()))


def _tables() -> Iterator[dict[str, Any]]:
    yield from load_yaml(packaged_config("measures.yaml")).values()


# ---------------------------------------------------------------- the same in a browser

_WORD = r"\p{L}\p{N}_"  # what \w is here
_JAVASCRIPT = (
    (_LETTER, rf"(?![\p{{Nd}}{_CJK}])[{_WORD}]"),
    (_SIGN, rf"(?![{_CJK}])[{_WORD}]"),
    ("(?-i:", "(?:"),
    ("(?P<", "(?<"),
    (r"[\w", f"[{_WORD}"),
    (r"\w", f"[{_WORD}]"),
    (r"\d", r"\p{Nd}"),
    (r"\-", "-"),
)


def javascript_patterns() -> dict[str, Any]:
    """The patterns as JavaScript reads them, with the flags i and u, and what their words say."""
    words, found = _words(), dict[str, str]()
    for name, value in vars(words).items():
        patterns = value if name == "units" else {name: value}
        found |= {key: _translated(p.pattern) for key, p in patterns.items() if name not in _SAID}
    said = {name: getattr(words, name) for name in _SAID}
    return {"patterns": found, "most": _MOST, "maxCount": MAX_COUNT} | said


_SAID = ("numbers", "adverbs", "angles")


def _translated(pattern: str) -> str:
    for ours, theirs in _JAVASCRIPT:
        pattern = pattern.replace(ours, theirs)
    return pattern
