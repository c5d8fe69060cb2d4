"""BVH files in: the hierarchy, every channel in its own order, and fast joint transforms.

Pure numpy, so that worker processes of `prepare` start quickly. Legend: T frames, N nodes of
the hierarchy (end sites apart), C channels of all nodes together.
"""

import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from src.shared.errors import UserError
from src.shared.formats.bvh_header import BvhError, Node, parse_hierarchy
from src.shared.formats.source_clip import ALL, compose

N = TypeVar("N", int, float)

MAX_BYTES = 256 << 20
MAX_VALUE = 1e7  # no angle or position, in any unit, is larger: the file is damaged
FRAME_SECONDS = (1 / 2000, 1.0)  # accepted "Frame Time"
_TIMING = re.compile(rb"\s*FRAMES\s*:\s*(\S+)\s+FRAME[ \t]*TIME\s*:[ \t]*([^\n]*)\n?", re.I)
_MOTION = re.compile(rb"^[ \t]*MOTION[ \t]*$", re.I | re.M)


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

    @property
    def fps(self) -> float:
        return 1.0 / self.frame_time

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
        counts = [len(channels) for channels in self.channels]
        return [sum(counts[:joint]) for joint in range(len(counts))]

    def _rotations(self, joint: int, starts: list[int]) -> list[int]:
        """Columns of a joint's rotation channels."""
        return [
            starts[joint] + index
            for index, channel in enumerate(self.channels[joint])
            if channel.endswith("rotation")
        ]


def read_bvh(path: str | Path, *, stride: int = 1, max_bytes: int = MAX_BYTES) -> BvhClip:
    """Read a BVH file of any channel order, indentation and line ends.

    Args:
        path: the file.
        stride: keep every `stride`-th frame (4 turns 120 frames a second into 30) and lengthen
            `frame_time` accordingly; the whole file is checked all the same.
        max_bytes: refuse larger files before reading them.

    Raises:
        UserError: missing, too large, not BVH, truncated, or with impossible values; names the
            file and, where there is one, the line.
    """
    path = Path(path)
    data = _read_bytes(path, max_bytes)
    try:
        mark = _MOTION.search(data)
        header = data[: mark.start()] if mark else data
        nodes, end_sites = parse_hierarchy(header)
        if mark is None:
            raise BvhError("has no MOTION section: the file is cut off")
        frame_time, values = _parse_motion(data, mark.end(), nodes)
    except BvhError as error:
        line = f", line {error.line}" if error.line else ""
        raise UserError(f"{path}{line}: {error}") from None
    return BvhClip(
        names=tuple(node.name for node in nodes),
        parents=tuple(node.parent for node in nodes),
        offsets=np.array([node.offset for node in nodes]),
        end_sites=tuple(end_sites),
        channels=tuple(node.channels for node in nodes),
        rotation_orders=tuple(
            "".join(c[0] for c in node.channels if c.endswith("rotation")) for node in nodes
        ),
        frame_time=frame_time * stride,
        values=values[::stride],
    )


def _read_bytes(path: Path, max_bytes: int) -> bytes:
    """The file's bytes with \\n line ends."""
    try:
        size = path.stat().st_size
        if size > max_bytes:
            raise UserError(
                f"{path}: {size / 2**20:.0f} MB is over the limit of {max_bytes / 2**20:.0f} MB; "
                "split the file or raise the limit"
            )
        data = path.read_bytes()
    except OSError as error:
        raise UserError(f"{path}: cannot be read: {error.strerror or error}") from error
    if b"\0" in data:
        raise UserError(f"{path}: is binary, not BVH text; export it as BVH again")
    return data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def _parse_motion(data: bytes, start: int, nodes: list[Node]) -> tuple[float, np.ndarray]:
    """Frame time in seconds and the channel values [T,C] behind the word MOTION."""
    first_line = data.count(b"\n", 0, start) + 1
    timing = _TIMING.match(data, start)
    if timing is None:
        raise BvhError("MOTION is not followed by 'Frames:' and 'Frame Time:'", first_line)
    num_frames = _number(timing[1], "Frames", int, first_line + 1)
    if num_frames < 1:
        raise BvhError(f"Frames is {num_frames}; a motion needs at least one", first_line + 1)
    frame_time = _number(timing[2], "Frame Time", float, first_line + 2)
    low, high = FRAME_SECONDS
    if not low <= frame_time <= high:
        raise BvhError(f"Frame Time {frame_time:g} is not within {low:g} … {high:g} seconds",
                       first_line + 2)  # fmt: skip
    num_channels = sum(len(node.channels) for node in nodes)
    if num_channels == 0:
        raise BvhError("no joint has CHANNELS, so nothing moves")
    rows = data[timing.end() :].strip()
    first_row = data.count(b"\n", 0, timing.end()) + 1
    try:
        with warnings.catch_warnings():  # older numpy warns where newer numpy raises
            warnings.simplefilter("error", DeprecationWarning)
            values = np.fromstring(rows, sep=" ") if rows else np.zeros(0)
    except (ValueError, DeprecationWarning):
        values = np.zeros(0)
    if values.size != num_frames * num_channels or values.size == 0:
        raise _explain(rows, first_row, num_frames, num_channels)
    if not np.abs(values).max() < MAX_VALUE:  # also true for NaN
        worst = int(np.flatnonzero(~(np.abs(values) < MAX_VALUE))[0])
        raise BvhError(
            f"value {values[worst]:g} in frame {worst // num_channels + 1} is not a possible "
            "angle or position", first_row + worst // num_channels)  # fmt: skip
    return frame_time, values.reshape(num_frames, num_channels)


def _number(text: bytes, what: str, kind: Callable[[bytes], N], line: int) -> N:
    try:
        return kind(text)
    except ValueError:
        shown = text[:40].decode("utf-8", "replace").strip()
        raise BvhError(f"{what} is {shown!r}, not a number", line) from None


def _explain(rows: bytes, first_row: int, num_frames: int, num_channels: int) -> BvhError:
    """What is wrong with rows that do not hold the values the header promises."""
    count = 0
    for number, row in enumerate(rows.split(b"\n"), start=first_row):
        tokens = row.split()
        for token in tokens:
            try:
                float(token)
            except ValueError:
                shown = token[:40].decode("utf-8", "replace")
                return BvhError(f"{shown!r} is not a number", number)
        if tokens and len(tokens) != num_channels:
            return BvhError(
                f"row holds {len(tokens)} values, the hierarchy has {num_channels} channels; "
                "the file is damaged or cut off", number)  # fmt: skip
        count += bool(tokens)
    return BvhError(
        f"Frames says {num_frames}, but {count} rows follow; the file is cut off, "
        "or correct the number", first_row - 2)  # fmt: skip
