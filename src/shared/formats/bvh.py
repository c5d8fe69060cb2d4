"""BVH files in: the hierarchy, every channel in its own order, and fast joint transforms.

Pure numpy, so that worker processes of `prepare` start quickly. Legend: T frames, N nodes of
the hierarchy (end sites apart), C channels of all nodes together.
"""

from dataclasses import dataclass, replace
from itertools import accumulate
from pathlib import Path

import numpy as np

from ..errors import UserError
from .bvh_header import BvhError
from .bvh_rows import read_head, read_rows
from .limits import MAX_BYTES, check_size, remedied
from .source_clip import ALL, compose


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
        return [0, *accumulate(len(channels) for channels in self.channels)][:-1]

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
    check_size(path, max_bytes)
    try:
        with path.open("rb") as stream:
            head = read_head(stream)
            values = read_rows(path, stream, head)
    except BvhError as error:
        raise _user_error(path, error) from None
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a BVH file that may be read"
        ) from error
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
        frame_time=head.frame_time * stride,
        values=values[::stride],
    )


def check_head(path: Path) -> None:
    """Read everything but the frames.

    Raises:
        UserError: it is broken, or no motion follows it.
    """
    check_size(path)
    try:
        with path.open("rb") as stream:
            read_head(stream)
    except BvhError as error:
        raise _user_error(path, error) from None
    except OSError as error:
        raise UserError(
            f"{path}: cannot be read: {error.strerror or error}; name a BVH file that may be read"
        ) from error


def _user_error(path: Path, error: BvhError) -> UserError:
    place = f", line {error.line}" if error.line else ""
    return UserError(f"{path}{place}: {remedied(str(error))}")
