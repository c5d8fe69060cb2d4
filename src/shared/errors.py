"""The two errors a user can cause, which become exit codes; text that is safe to show."""

import re
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydantic import ValidationError

LONGEST = 2000  # characters of a message; what is quoted may be a whole file
# Control characters, marks that turn the direction of writing or show nothing, half characters.
_UNSHOWN = re.compile(
    "[\0-\x08\x0b-\x1f\x7f-\x9f\xad\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ud800-\udfff]"
)


def printable(text: str) -> str:
    """The text with U+FFFD for what a terminal obeys or hides, and for bytes that were not UTF-8.

    For whatever a file or an argument says: names, captions, paths.
    """
    return _UNSHOWN.sub("\N{REPLACEMENT CHARACTER}", text)


class UserError(Exception):
    """Something the user gave cannot be worked with (exit code 1).

    The message is one line: what is wrong, the value, the file or key, what to do. As it may
    quote a file, control characters are not shown, and of a long one only beginning and end.
    """

    exit_code = 1

    def __str__(self) -> str:
        text = printable(super().__str__())
        if len(text) > LONGEST:
            return f"{text[: LONGEST // 2]} … {text[-LONGEST // 4 :]}"
        return text


class UsageError(UserError):
    """The command or its configuration is wrong, so nothing was started (exit code 2)."""

    exit_code = 2


class MissingFile(UsageError):
    """A file that is to be read does not exist: of many, the fault of that one alone."""


def has_words(text: str) -> bool:
    """Whether a text holds a letter or digit: dots and emoji say nothing of a motion."""
    return any(map(str.isalnum, text))


def check_text(name: str, text: Any) -> None:
    """Refuse a text without a letter or digit, and one with half characters.

    Raises:
        UsageError: naming it.
    """
    whole = isinstance(text, str) and text.encode(errors="ignore").decode() == text
    if not (whole and has_words(text)):
        raise UsageError(f"{name} {text!r} holds no word; say in a few what is done")


def in_range(name: str, value: Any, least: float, most: float, *, whole: bool = False) -> None:
    """Refuse what is no number from `least` to `most`; NaN is none, and no bool.

    Raises:
        UsageError: naming it and the range.
    """
    kind: Any = Integral if whole else Real  # mypy knows no order of numbers in the abstract
    if isinstance(value, bool) or not (isinstance(value, kind) and least <= value <= most):
        given = repr(value) if whole else _digits(value)
        low, high = map(_digits, (least, most))
        what = "a whole number from" if whole else "from"
        raise UsageError(f"{name} {given} is out of range; choose {what} {low} to {high}")


def _digits(value: Any) -> str:
    """All of a number: no 1e+08."""
    if isinstance(value, float):
        return f"{value:.12g}"
    return str(value) if isinstance(value, Real) else repr(value)


def first_fault(error: "ValidationError") -> str:
    """The first thing that a model found wrong with a file: `key: what`, without web addresses."""
    first = error.errors()[0]
    place = ".".join(map(str, first["loc"]))
    what = first["msg"].removeprefix("Value error, ")
    return f"{place}: {what}" if place else what
