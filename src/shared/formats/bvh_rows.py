"""The frames of a BVH file, read in blocks: any length in little memory.

Legend: T frames, C channels of all joints together.
"""

import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TypeVar

import numpy as np

from .bvh_header import BvhError, Node, parse_hierarchy
from .limits import (
    FRAME_RATES,
    MAX_FRAMES,
    MAX_LINE,
    MAX_VALUE,
    MAX_VALUES,
    Deadline,
)

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
    if not 1 <= num_frames <= MAX_FRAMES:
        raise BvhError(f"Frames is {num_frames}; a motion has 1 to {MAX_FRAMES}", line + 1)
    frame_time = _number(timing[2], "Frame Time", float, line + 2)
    low, high = 1 / FRAME_RATES[1], 1 / FRAME_RATES[0]
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
    count, kept, deadline = 0, head.rest, Deadline(path)
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
    if not max(values.max(), -values.min()) < MAX_VALUE:  # also true for NaN
        worst = int(np.flatnonzero(~(np.abs(values) < MAX_VALUE))[0])
        frame = worst // head.num_channels
        raise BvhError(f"value {values[worst]:g} in frame {frame + 1} is not a possible angle or "
                       "position; correct it", head.first_row + frame)  # fmt: skip
    return values.reshape(head.num_frames, head.num_channels)


def _whole_words(data: bytes) -> tuple[bytes, bytes]:
    """What may be parsed now, and a word that the next block may carry on."""
    cut = max(data.rfind(b"\n"), data.rfind(b" "), data.rfind(b"\t"), data.rfind(b"\r"))
    if len(data) - cut > MAX_LINE:
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


def _explain(path: Path, head: Head, deadline: Deadline) -> BvhError:
    """What is wrong with rows that do not hold the values the head promises."""
    count = number = 0
    with path.open(encoding="latin-1", newline=None) as lines:
        while row := lines.readline(MAX_LINE):
            number += 1
            if number < head.first_row:
                continue
            if not number % 1024:
                deadline.check()
            words = row.split()
            fault = _fault(words, head.num_channels)
            if fault or len(row) >= MAX_LINE:
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
