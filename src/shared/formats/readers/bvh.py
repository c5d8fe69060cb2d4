"""BVH files in: the hierarchy, every channel in its own order, and fast joint transforms.

The hierarchy is parsed line by line without recursion, the frames in blocks: any length in little
memory. Legend: T frames, N nodes of the hierarchy (end sites apart), C channels of all nodes."""

import re
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import accumulate
from pathlib import Path
from typing import IO, TypeVar

import numpy as np

from ...errors import UserError, printable
from ...io.arrays import MAX_VALUES
from .. import limits
from ..rig import ALL, compose

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
                if len(joints) > limits.MAX_JOINTS:
                    raise BvhError(f"more than {limits.MAX_JOINTS} joints", number)
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


N = TypeVar("N", int, float)

HEAD_BYTES = 4 << 20  # the hierarchy must end within them
BLOCK_BYTES = 4 << 20
_TIMING = re.compile(rb"\s*FRAMES\s*:\s*(\S+)\s+FRAME[ \t]*TIME\s*:[ \t]*([^\n]*)(\n|\Z)", re.I)
_MOTION = re.compile(rb"^[ \t]*MOTION[ \t]*$", re.I | re.M)


@dataclass(frozen=True)
class Head:
    """Everything before the frames.

    Attributes:
        num_frames, num_channels: T and C.
        first_row: line of the first frame.
        rest: bytes of frames that were read already.
    """

    nodes: list[Node]
    end_sites: tuple[tuple[int, tuple[float, float, float]], ...]
    num_frames: int
    num_channels: int
    frame_time: float
    first_row: int
    rest: bytes


def read_head(stream: IO[bytes]) -> Head:
    """Hierarchy and timing.

    Raises:
        BvhError: not BVH, cut off, or with impossible values; carries the line.
    """
    data = stream.read(HEAD_BYTES)
    if b"\0" in data:
        raise BvhError("is binary, not BVH text; export it as BVH again")
    data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    mark = _MOTION.search(data)
    nodes, end_sites = parse_hierarchy(data[: mark.start()] if mark else data)
    if mark is None:
        raise BvhError("has no MOTION section: the file is cut off; export it again")
    line = data.count(b"\n", 0, mark.end()) + 1
    timing = _TIMING.match(data, mark.end())
    if timing is None:
        raise BvhError("MOTION is not followed by 'Frames:' and 'Frame Time:'; "
                       "export the file again", line)  # fmt: skip
    num_frames = _number(timing[1], "Frames", int, line + 1)
    if not 1 <= num_frames <= limits.MAX_FRAMES:
        raise BvhError(f"Frames is {num_frames}; a motion has 1 to {limits.MAX_FRAMES}", line + 1)
    frame_time = _number(timing[2], "Frame Time", float, line + 2)
    low, high = 1 / limits.FRAME_RATES[1], 1 / limits.FRAME_RATES[0]
    if not low <= frame_time <= high:
        raise BvhError(f"Frame Time {frame_time:g} is not within {low:g} … {high:g} seconds; "
                       "correct it", line + 2)  # fmt: skip
    num_channels = sum(len(node.channels) for node in nodes)
    if num_channels == 0:
        raise BvhError("no joint has CHANNELS, so nothing moves; export the animation too")
    if num_frames * num_channels > MAX_VALUES:
        raise BvhError(f"{num_frames} frames of {num_channels} channels are over the limit of "
                       f"{MAX_VALUES} numbers; split the file", line + 1)  # fmt: skip
    first_row = data.count(b"\n", 0, timing.end()) + 1
    return Head(nodes, tuple(end_sites), num_frames, num_channels, frame_time, first_row,
                data[timing.end() :])  # fmt: skip


def read_rows(path: Path, stream: IO[bytes], head: Head) -> np.ndarray:
    """The channel values [T,C] float64.

    Args:
        path: the same file, read a second time to find the line of a fault.
        stream: behind what `read_head` read.

    Raises:
        BvhError: other values than the head promises, or impossible ones.
        UserError: it takes too long.
    """
    total = head.num_frames * head.num_channels
    values = np.empty(min(total, MAX_VALUES))
    count, kept, deadline = 0, head.rest, limits.Deadline(path)
    while True:
        deadline.check()
        block = stream.read(BLOCK_BYTES)
        piece, kept = _whole_words(kept + block) if block else (kept, b"")
        numbers = _parse(piece)
        if numbers is None or count + len(numbers) > total:
            raise _explain(path, head, deadline)
        values[count : count + len(numbers)] = numbers
        count += len(numbers)
        if not block:
            break
    if count != total:
        raise _explain(path, head, deadline)
    if not max(values.max(), -values.min()) < limits.MAX_VALUE:  # also true for NaN
        worst = int(np.flatnonzero(~(np.abs(values) < limits.MAX_VALUE))[0])
        frame = worst // head.num_channels
        raise BvhError(f"value {values[worst]:g} in frame {frame + 1} is not a possible angle or "
                       "position; correct it", head.first_row + frame)  # fmt: skip
    return values.reshape(head.num_frames, head.num_channels)


def _whole_words(data: bytes) -> tuple[bytes, bytes]:
    """What may be parsed now, and a word that the next block may carry on."""
    cut = max(data.rfind(b"\n"), data.rfind(b" "), data.rfind(b"\t"), data.rfind(b"\r"))
    if len(data) - cut > limits.MAX_LINE:
        return data, b""  # no number is that long: parsing tells
    return data[: cut + 1], data[cut + 1 :]


def _parse(text: bytes) -> np.ndarray | None:
    """Numbers in a text; None where it holds anything else."""
    text = text.strip()
    if not text:
        return np.zeros(0)
    try:
        with warnings.catch_warnings():  # older numpy warns where newer numpy raises
            warnings.simplefilter("error", DeprecationWarning)
            return np.fromstring(text, sep=" ")
    except (ValueError, DeprecationWarning):
        return None


def _number(text: bytes, what: str, kind: Callable[[bytes], N], line: int) -> N:
    try:
        return kind(text)
    except ValueError:
        shown = text[:40].decode("utf-8", "replace").strip()
        raise BvhError(f"{what} is {shown!r}, not a number; correct it", line) from None


def _explain(path: Path, head: Head, deadline: limits.Deadline) -> BvhError:
    """What is wrong with rows that do not hold the values the head promises."""
    count = number = 0
    with path.open(encoding="latin-1", newline=None) as lines:
        while row := lines.readline(limits.MAX_LINE):
            number += 1
            if number < head.first_row:
                continue
            if not number % 1024:
                deadline.check()
            words = row.split()
            fault = _fault(words, head.num_channels)
            if fault or len(row) >= limits.MAX_LINE:
                return BvhError(fault or "the line is impossibly long", number)
            count += bool(words)
    return BvhError(
        f"Frames says {head.num_frames}, but {count} rows follow; the file is cut off, "
        "or correct the number", head.first_row - 2)  # fmt: skip


def _fault(words: list[str], num_channels: int) -> str:
    """What is wrong with the words of a row; nothing for a good or empty one."""
    for word in words:
        try:
            float(word)
        except ValueError:
            return f"{word[:40]!r} is not a number; the file is damaged"
    if words and len(words) != num_channels:
        return (f"row holds {len(words)} values, the hierarchy has {num_channels} channels; "
                "the file is damaged or cut off")  # fmt: skip
    return ""


@dataclass(frozen=True, eq=False)
class BvhClip:
    """One BVH file, as it stands there: its own joint names, units and channel orders.

    Attributes:
        names: joint names in file order, parents before children.
        parents: index of each joint's parent; -1 for a root.
        offsets: OFFSET of each joint [N,3], in the file's unit of length.
        end_sites: (index of the parent joint, offset [3]) of each end site.
        channels: channel names of each joint, for example ("Zrotation", "Xrotation").
        rotation_orders: each joint's rotation axes in channel order, for example "ZXY".
        frame_time: seconds between two frames of `values`.
        values: channel values [T,C] float64, positions in the file's unit, angles in degrees.
    """

    names: tuple[str, ...]
    parents: tuple[int, ...]
    offsets: np.ndarray
    end_sites: tuple[tuple[int, tuple[float, float, float]], ...]
    channels: tuple[tuple[str, ...], ...]
    rotation_orders: tuple[str, ...]
    frame_time: float
    values: np.ndarray

    @property
    def num_frames(self) -> int:
        return len(self.values)

    def every(self, stride: int) -> "BvhClip":
        """Only every `stride`-th frame, `frame_time` lengthened accordingly."""
        return replace(self, values=self.values[::stride], frame_time=self.frame_time * stride)

    def local_rotations(self, frames: slice = ALL) -> np.ndarray:
        """Rotation of each joint against its parent [T,N,3,3].

        The channels of a joint are intrinsic rotations in file order: "ZXY" is Rz @ Rx @ Ry.
        """
        values = self.values[frames]
        num_frames, num_joints = len(values), len(self.names)
        # Planes [row, column, T, N]: each elementary rotation then mixes two columns of planes.
        planes = np.zeros((3, 3, num_frames, num_joints))
        planes[range(3), range(3)] = 1.0
        starts = self._channel_starts()
        for order in sorted(set(self.rotation_orders) - {""}):
            joints = [j for j, other in enumerate(self.rotation_orders) if other == order]
            block = np.zeros((3, 3, num_frames, len(joints)))
            block[range(3), range(3)] = 1.0
            for step, axis in enumerate(order):
                angle = np.deg2rad(values[:, [self._rotations(j, starts)[step] for j in joints]])
                cos, sin = np.cos(angle), np.sin(angle)
                first, second = {"X": (1, 2), "Y": (2, 0), "Z": (0, 1)}[axis]
                old_first, old_second = block[:, first].copy(), block[:, second]
                block[:, first] = old_first * cos + old_second * sin
                block[:, second] = old_second * cos - old_first * sin
            planes[..., joints] = block
        return np.ascontiguousarray(planes.transpose(2, 3, 0, 1))

    def local_translations(self, frames: slice = ALL) -> np.ndarray:
        """Position of each joint in its parent's frame [T,N,3], in the file's unit.

        A position channel replaces the same axis of the joint's OFFSET; adding both is the
        known trap of files that give six channels to every joint.
        """
        values = self.values[frames]
        translations = np.repeat(self.offsets[None].astype(np.float64), len(values), axis=0)
        for joint, start in enumerate(self._channel_starts()):
            for index, channel in enumerate(self.channels[joint]):
                if channel.endswith("position"):
                    translations[:, joint, "XYZ".index(channel[0])] = values[:, start + index]
        return translations

    def world(self, frames: slice = ALL) -> tuple[np.ndarray, np.ndarray]:
        """World positions [T,N,3], in the file's unit, and world rotations [T,N,3,3]."""
        rotations, translations = self.local_rotations(frames), self.local_translations(frames)
        return compose(self.parents, rotations, translations)

    def _channel_starts(self) -> list[int]:
        """First column of each joint in `values`."""
        return [0, *accumulate(len(channels) for channels in self.channels)][:-1]

    def _rotations(self, joint: int, starts: list[int]) -> list[int]:
        """Columns of a joint's rotation channels."""
        return [
            starts[joint] + index
            for index, channel in enumerate(self.channels[joint])
            if channel.endswith("rotation")
        ]


def read_bvh(path: str | Path) -> BvhClip:
    """Read a BVH file of any channel order, indentation and line ends.

    Raises:
        UserError: missing, too large, not BVH, truncated, or with impossible values; names the
            file and, where there is one, the line.
    """
    path = Path(path)
    limits.check_size(path)
    with _opened(path) as stream:
        head = read_head(stream)
        values = read_rows(path, stream, head)
    nodes = head.nodes
    return BvhClip(
        names=tuple(node.name for node in nodes),
        parents=tuple(node.parent for node in nodes),
        offsets=np.array([node.offset for node in nodes]),
        end_sites=head.end_sites,
        channels=tuple(node.channels for node in nodes),
        rotation_orders=tuple(
            "".join(c[0] for c in node.channels if c.endswith("rotation")) for node in nodes
        ),
        frame_time=head.frame_time,
        values=values,
    )


def check_head(path: Path) -> None:
    """Read all but the frames; raises UserError where it is broken or no motion follows it."""
    limits.check_size(path)
    with _opened(path) as stream:
        read_head(stream)


@contextmanager
def _opened(path: Path) -> Iterator[IO[bytes]]:
    """The file's bytes; what is wrong with them names file and line."""
    try:
        with limits.readable(path, "BVH file"), path.open("rb") as stream:
            yield stream
    except BvhError as error:
        place = f", line {error.line}" if error.line else ""
        raise UserError(f"{path}{place}: {limits.remedied(str(error))}") from None
