"""Every message that an error of the user's can have, collected from the source."""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src"
ERRORS = ("UserError", "UsageError", "MissingFile", "EmptySplit")
HOLE = "{}"  # where a value is put in


@dataclass(frozen=True)
class Message:
    """One place that makes an error.

    Attributes:
        place: file below src and line.
        error: name of the class.
        text: what it says, `{}` for each value; empty where it passes on another's text.
    """

    place: str
    error: str
    text: str

    @property
    def shown(self) -> str:
        return f"{self.place} {self.error}: {self.text}"


def messages() -> Iterator[Message]:
    """All places that call one of ERRORS."""
    for path in sorted(SOURCE.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            match node:
                case ast.Call(func=ast.Name(id=name), args=[text, *_]) if name in ERRORS:
                    place = f"{path.relative_to(SOURCE).as_posix()}:{node.lineno}"
                    yield Message(place, name, template(text))


def template(node: ast.expr) -> str:
    """The text of an expression, its values as holes."""
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.JoinedStr(values=parts):
            return "".join(template(part) for part in parts)
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return template(left) + template(right)
        case ast.IfExp(body=body, orelse=other):
            return template(body) if template(body) != HOLE else template(other)
        case _:
            return HOLE


def passes_on(text: str) -> bool:
    """Whether the text is another error's, with a place before it at most."""
    return len(re.sub(r"\{\}|captions|line|entry|profile|[^a-z]", "", text.lower())) < 3
