"""The HIERARCHY part of a BVH file: a line-by-line parser without recursion."""

from dataclasses import dataclass, field

import numpy as np

from ..errors import printable

MAX_JOINTS = 2000
_CHANNELS = {
    f"{axis}{kind}".lower(): f"{axis}{kind}" for axis in "XYZ" for kind in ("position", "rotation")
}
_TITLES = ("ROOT", "JOINT", "END")


class BvhError(Exception):
    """A fault of a BVH file, with the line it is on (None: the file as a whole)."""

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


@dataclass
class Node:
    """A joint or an end site while the hierarchy is being read."""

    name: str
    parent: int
    is_end: bool = False
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    channels: tuple[str, ...] = ()
    seen: set[str] = field(default_factory=set)


def parse_hierarchy(
    header: bytes,
) -> tuple[list[Node], list[tuple[int, tuple[float, float, float]]]]:
    """Joints, parents first, and (parent index, offset) of each end site.

    Args:
        header: everything before the word MOTION, with \\n line ends.

    Raises:
        BvhError: not a BVH hierarchy; carries the line.
    """
    text = header.decode("utf-8-sig", "replace")
    joints: list[Node] = []
    ends: list[Node] = []
    stack: list[tuple[Node, int]] = []  # open blocks: the node and its index among the joints
    pending: Node | None = None  # a title line whose "{" has not come yet
    started = False
    number = 0
    for number, line in enumerate(text.split("\n"), start=1):
        for words in _statements(line):
            keyword = words[0].upper()
            if not started:
                if keyword != "HIERARCHY":
                    raise BvhError("does not start with HIERARCHY: not a BVH file", number)
                started = True
            elif keyword in _TITLES and pending is None:
                pending = _title(keyword, words, stack, number)
                (ends if pending.is_end else joints).append(pending)
                if len(joints) > MAX_JOINTS:
                    raise BvhError(f"more than {MAX_JOINTS} joints", number)
            elif keyword == "{" and pending is not None:
                stack.append((pending, len(joints) - 1))
                pending = None
            elif keyword == "}" and stack and pending is None:
                stack.pop()
            elif keyword in ("OFFSET", "CHANNELS") and stack and pending is None:
                _fill(stack[-1][0], keyword, words[1:], number)
            else:
                raise BvhError(f"unexpected {' '.join(words)[:60]!r}", number)
    if not started:
        raise BvhError("is empty or does not start with HIERARCHY: not a BVH file")
    if stack or pending is not None:
        raise BvhError("the hierarchy is cut off: a '}' is missing", number)
    if not joints:
        raise BvhError("the hierarchy has no ROOT", number)
    return joints, [(end.parent, end.offset) for end in ends]


def _statements(line: str) -> list[list[str]]:
    """Words of a line, with braces that share it split off."""
    words = line.split()
    if not words:
        return []
    tail: list[list[str]] = []
    while len(words) > 1 and words[-1] in "{}":
        tail.insert(0, [words.pop()])
    return [words, *tail]


def _title(keyword: str, words: list[str], stack: list[tuple[Node, int]], number: int) -> Node:
    """The node that a ROOT, JOINT or End Site line opens."""
    if keyword == "END":
        if not stack:
            raise BvhError("End Site outside a joint", number)
        return Node("End Site", stack[-1][1], is_end=True)
    if (keyword == "ROOT") == bool(stack):
        place = "inside a joint" if stack else "outside a ROOT"
        raise BvhError(f"{keyword} {place}", number)
    if stack and stack[-1][0].is_end:
        raise BvhError("JOINT inside an End Site", number)
    name = printable(" ".join(words[1:]))
    if not name:
        raise BvhError(f"{keyword} without a name", number)
    return Node(name, stack[-1][1] if stack else -1)


def _fill(node: Node, keyword: str, words: list[str], number: int) -> None:
    """Set a node's offset or channels from its line."""
    if keyword in node.seen:
        raise BvhError(f"second {keyword} of {node.name!r}", number)
    node.seen.add(keyword)
    if keyword == "OFFSET":
        try:
            x, y, z = (float(word) for word in words)
        except ValueError:
            raise BvhError(
                f"OFFSET {' '.join(words)[:60]!r} is not three numbers", number
            ) from None
        if not np.abs([x, y, z]).max() < 1e7:
            raise BvhError(f"OFFSET {' '.join(words)[:60]!r} is not a possible length", number)
        node.offset = (x, y, z)
        return
    if node.is_end:
        raise BvhError("an End Site has no CHANNELS", number)
    if not words or words[0] != str(len(words) - 1):
        raise BvhError(f"CHANNELS says {(words or ['nothing'])[0][:20]!r}, but "
                       f"{max(len(words) - 1, 0)} names follow", number)  # fmt: skip
    unknown = [word for word in words[1:] if word.lower() not in _CHANNELS]
    if unknown:
        raise BvhError(f"unknown channel {unknown[0][:40]!r}; known: "
                       f"{', '.join(_CHANNELS.values())}", number)  # fmt: skip
    node.channels = tuple(_CHANNELS[word.lower()] for word in words[1:])
    if len(set(node.channels)) != len(node.channels):
        raise BvhError(f"{node.name!r} names a channel twice", number)
