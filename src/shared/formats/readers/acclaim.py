"""Acclaim files in: an AMC motion with the ASF skeleton it moves, as HDM05 and CMU use them.

ASF: sections that begin with a colon, `begin … end` blocks, `#` comments. A bone reaches from its
parent's end along `direction` (in world axes at rest) for `length`; its motion is given about axes
turned by `axis`. The world rotation of a bone is its parent's · C M C⁻¹, C the bone's `axis` and M
its motion, both turned about fixed axes in the order given ("XYZ" is Rz Ry Rx). That makes a bone
a joint whose axes are the world's at rest, as in BVH. Legend: T frames, N bones (root first), C
channels."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from ...errors import UserError, printable
from ...io.arrays import MAX_VALUES
from .. import limits
from ..rig import ALL, compose

ROOT = "root"
MAX_ASF_BYTES = 8 << 20
INCH = 0.0254  # metres: Acclaim files count in inches divided by the `length` unit
_CHANNELS = ("rx", "ry", "rz", "tx", "ty", "tz", "l")


@dataclass
class Bone:
    """One bone while the file is being read; the root is one of no length.

    Attributes:
        vector: from the bone's start to its end at rest [3], in the file's unit.
        axis: angles of the motion's axes, as they stand in the file.
        order: of `axis`, for example "XYZ": first about x.
        dof: channels in the order in which AMC lines give them.
        turns: order in which the channels' rotations are carried out; the root has its own.
    """

    name: str
    direction: tuple[float, ...] = (0.0, 0.0, 0.0)
    length: float = 0.0
    axis: tuple[float, ...] = (0.0, 0.0, 0.0)
    order: str = "XYZ"
    dof: tuple[str, ...] = ()
    turns: str = ""
    parent: int = -1
    place: tuple[float, ...] = field(default=(0.0, 0.0, 0.0))


@dataclass(frozen=True, eq=False)
class AsfSkeleton:
    """A skeleton, bones sorted so that parents come first; bone 0 is the root.

    Attributes:
        degrees: angles of the file are in degrees, not radians.
        metres: length of one unit of the file.
    """

    bones: tuple[Bone, ...]
    degrees: bool
    metres: float


class _SkeletonReader:
    """State of one pass over the lines."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.number = 0
        self.bones: dict[str, Bone] = {ROOT: Bone(ROOT, dof=())}
        self.children: list[tuple[int, str, list[str]]] = []
        self.degrees = True
        self.unit = 1.0
        self.bone: Bone | None = None

    def fault(self, message: str) -> UserError:
        return UserError(f"{self.path}, line {self.number}: {limits.remedied(message)}")

    def numbers(self, words: list[str], count: int, what: str) -> tuple[float, ...]:
        try:
            values = tuple(float(word) for word in words[:count])
        except ValueError:
            values = ()
        if len(values) != count:
            shown = " ".join(words)[:60]
            wanted = "a number" if count == 1 else f"{count} numbers"
            raise self.fault(f"{what} {shown!r} is not {wanted}")
        if not np.abs(values).max() < limits.MAX_VALUE:
            raise self.fault(f"{what} {' '.join(words)[:60]!r} is impossibly large")
        return values

    def order(self, word: str) -> str:
        if sorted(word.upper()) != ["X", "Y", "Z"]:
            raise self.fault(f"{word[:20]!r} is no order of axes; write one such as XYZ")
        return word.upper()

    def channels(self, words: list[str]) -> tuple[str, ...]:
        found = tuple(word.lower() for word in words)
        unknown = [word for word in found if word not in _CHANNELS]
        if unknown:
            raise self.fault(f"unknown channel {unknown[0][:20]!r}; known: {', '.join(_CHANNELS)}")
        if len(set(found)) != len(found):
            raise self.fault("a channel is named twice")
        return found

    # ------------------------------------------------------------ sections

    def units(self, words: list[str]) -> None:
        if words[0] == "length":
            (self.unit,) = self.numbers(words[1:], 1, "length")
            if not self.unit > 0:
                raise self.fault(f"length {self.unit:g} is not above zero")
        elif words[0] == "angle":
            word = (words + [""])[1].lower()
            if word[:3] not in ("deg", "rad"):
                raise self.fault(f"angle {word[:20]!r} is neither deg nor rad")
            self.degrees = word.startswith("deg")

    def root(self, words: list[str]) -> None:
        root = self.bones[ROOT]
        if words[0] == "order":
            root.dof = self.channels(words[1:])
        elif words[0] == "axis":
            root.turns = root.order = self.order((words + [""])[1])
        elif words[0] == "position":
            root.place = self.numbers(words[1:], 3, "position")
        elif words[0] == "orientation":
            root.axis = self.numbers(words[1:], 3, "orientation")

    def bonedata(self, words: list[str]) -> None:
        if words[0] == "begin":
            self.bone = Bone("")
        elif words[0] == "end":
            self._close_bone()
        elif self.bone is None:
            raise self.fault(f"{words[0][:20]!r} outside begin … end")
        elif words[0] == "name":
            self.bone.name = " ".join(words[1:])
        elif words[0] == "direction":
            self.bone.direction = self.numbers(words[1:], 3, "direction")
        elif words[0] == "length":
            (self.bone.length,) = self.numbers(words[1:], 1, "length")
        elif words[0] == "axis":
            self.bone.axis = self.numbers(words[1:], 3, "axis")
            self.bone.order = self.order((words + ["", "", "", ""])[4])
        elif words[0] == "dof":
            self.bone.dof = self.channels(words[1:])
            self.bone.turns = "".join(c[1].upper() for c in self.bone.dof if c[0] == "r")

    def _close_bone(self) -> None:
        if self.bone is None or not self.bone.name:
            raise self.fault("a bone without a name")
        if self.bone.name in self.bones:
            raise self.fault(f"second bone {self.bone.name[:40]!r}")
        self.bones[self.bone.name] = self.bone
        self.bone = None
        if len(self.bones) > limits.MAX_JOINTS:
            raise self.fault(f"more than {limits.MAX_JOINTS} bones")

    def hierarchy(self, words: list[str]) -> None:
        if words[0] in ("begin", "end"):
            return
        self.children.append((self.number, words[0], words[1:]))


def read_asf(path: str | Path) -> AsfSkeleton:
    """Read an ASF skeleton.

    Raises:
        UserError: missing, too large, not ASF, or with a faulty or unconnected bone; names the
            file and the line.
    """
    path = Path(path)
    text = limits.read_bytes(path, MAX_ASF_BYTES).decode("latin-1")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    reader = _SkeletonReader(path)
    sections = {"units": reader.units, "root": reader.root, "bonedata": reader.bonedata,
                "hierarchy": reader.hierarchy}  # fmt: skip
    section = ""
    for reader.number, line in enumerate(text.split("\n"), start=1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        if words[0].startswith(":"):
            section = words[0][1:].lower()
        elif section in sections:
            words[0] = words[0] if section == "hierarchy" else words[0].lower()
            sections[section](words)
    if not reader.children:
        raise UserError(
            f"{path}: has no :hierarchy: not an ASF skeleton, or cut off; export it again"
        )
    return AsfSkeleton(_sorted(reader), reader.degrees, INCH / reader.unit)


def _sorted(reader: _SkeletonReader) -> tuple[Bone, ...]:
    """Bones in the hierarchy's order, each with its parent's index."""
    index = {ROOT: 0}
    sorted_bones = [reader.bones[ROOT]]
    for number, parent, names in reader.children:
        reader.number = number
        if parent not in index:
            raise reader.fault(f"{parent[:40]!r} has children, but no parent yet")
        for name in names:
            if name not in reader.bones:
                raise reader.fault(f"{name[:40]!r} has no entry in :bonedata")
            if name in index:
                raise reader.fault(f"{name[:40]!r} has two parents")
            bone = reader.bones[name]
            bone.parent = index[parent]
            index[name] = len(sorted_bones)
            sorted_bones.append(bone)
    return tuple(sorted_bones)


USUAL_RATE = 120.0  # AMC files do not say; HDM05 and nearly all of CMU are at 120
_RATE_LINE = ":SAMPLES-PER-SECOND"


@dataclass(frozen=True, eq=False)
class AmcClip:
    """One AMC file with its skeleton; bones are joints at the bone's start.

    Attributes:
        values: channel values [T,C] float64, bones in the skeleton's order, angles in radians.
        rate_is_known: the file gives its frame rate (few do).
    """

    skeleton: AsfSkeleton
    frame_time: float
    values: np.ndarray
    rate_is_known: bool = False

    @property
    def num_frames(self) -> int:
        return len(self.values)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(printable(bone.name) for bone in self.skeleton.bones)

    @property
    def parents(self) -> tuple[int, ...]:
        return tuple(bone.parent for bone in self.skeleton.bones)

    @cached_property
    def offsets(self) -> np.ndarray:
        """Where each bone starts: its parent's end [N,3]."""
        vectors = [np.multiply(bone.direction, bone.length) for bone in self.skeleton.bones]
        return np.array([vectors[parent] if parent >= 0 else np.zeros(3)
                         for parent in self.parents])  # fmt: skip

    @property
    def metres(self) -> float:
        """Length of the file's unit."""
        return self.skeleton.metres

    def every(self, stride: int) -> "AmcClip":
        return replace(self, values=self.values[::stride], frame_time=self.frame_time * stride)

    def world(self, frames: slice = ALL) -> tuple[np.ndarray, np.ndarray]:
        """World positions of the bones' starts [T,N,3] and world rotations [T,N,3,3]."""
        values = self.values[frames]
        bones = self.skeleton.bones
        rotations = np.empty((len(values), len(bones), 3, 3))
        translations = np.repeat(self.offsets[None], len(values), axis=0)
        column = 0
        for index, bone in enumerate(bones):
            angles = {}
            for channel in bone.dof:
                if channel[0] == "r":
                    angles[channel[1].upper()] = values[:, column]
                elif index == 0:  # a bone's own translation or stretch would part the body
                    axis = "xyz".index(channel[1])
                    translations[:, 0, axis] = bone.place[axis] + values[:, column]
                column += 1
            motion = _turn([(a, angles[a]) for a in bone.turns if a in angles], len(values))
            factor = np.pi / 180 if self.skeleton.degrees else 1.0
            fixed = _turn([(a, np.array([factor * bone.axis["XYZ".index(a)]])) for a in bone.order])
            rotations[:, index] = fixed @ motion @ fixed[0].T
        return compose(self.parents, rotations, translations)


def _turn(steps: list[tuple[str, np.ndarray]], count: int = 1) -> np.ndarray:
    """Rotations [count,3,3] about fixed axes, the first step first: the last stands leftmost."""
    result = np.tile(np.eye(3), (count, 1, 1))
    for axis, angle in steps:
        cos, sin = np.cos(angle), np.sin(angle)
        first, second = {"X": (1, 2), "Y": (2, 0), "Z": (0, 1)}[axis]
        row, other = result[:, first].copy(), result[:, second]
        result[:, first] = cos[:, None] * row - sin[:, None] * other
        result[:, second] = sin[:, None] * row + cos[:, None] * other
    return result


def read_amc(
    path: str | Path, skeleton: str | Path | None = None, *, fps: float | None = None
) -> AmcClip:
    """Read an AMC motion and the skeleton it is for.

    Args:
        skeleton: the ASF file; default: the one beside it that its name begins with, or the only.
        fps: frames a second of the recording, which AMC files do not say; default 120.

    Raises:
        UserError: a file is missing, too large, damaged, or does not fit the skeleton; names the
            file and, where there is one, the line.
    """
    path = Path(path)
    limits.check_size(path)
    asf = read_asf(Path(skeleton) if skeleton else find_skeleton(path))
    reader = _MotionReader(path, asf)
    with limits.readable(path):
        with path.open("rb") as start:
            head = start.read(limits.MAX_LINE)
        newline = "\r" if b"\r" in head and b"\n" not in head else "\n"
        with path.open(encoding="latin-1", newline=newline) as stream:
            while line := stream.readline(limits.MAX_LINE):
                reader.take(line)
    reader.finish_frame()
    if not reader.frames:
        raise UserError(f"{path}: holds no frames: not an AMC motion, or cut off; export it again")
    values = np.frombuffer(reader.frames).reshape(-1, reader.count)
    rate = fps or reader.rate or USUAL_RATE
    if asf.degrees if reader.degrees is None else reader.degrees:
        turning = [c[0] == "r" for bone in asf.bones for c in bone.dof]
        values *= np.where(turning, np.pi / 180, 1.0)
    return AmcClip(asf, 1.0 / rate, values, rate_is_known=bool(fps or reader.rate))


def find_skeleton(path: Path) -> Path:
    """The ASF file that belongs to an AMC file, by name.

    Raises:
        UserError: none lies beside it, or several that could be meant.
    """
    found = sorted(p for p in path.parent.iterdir() if p.suffix.lower() == ".asf")
    named = [p for p in found if path.stem.lower().startswith(p.stem.lower())]
    best = sorted(named, key=lambda p: -len(p.stem))[:1] or found
    if len(best) == 1:
        return best[0]
    what = ", ".join(p.name for p in found[:5]) if found else "no .asf file"
    raise UserError(f"{path}: an AMC motion needs its ASF skeleton, beside it is {what}; "
                    "name it by --skeleton FILE")  # fmt: skip


class _MotionReader:
    """State of one pass over the lines; a frame is a row of all channels."""

    def __init__(self, path: Path, skeleton: AsfSkeleton) -> None:
        self.path, self.number = path, 0
        self.degrees: bool | None = None
        self.rate: float | None = None
        self.frames, self.done = bytearray(), 0  # rows of float64, and how many
        self.row: list[float] | None = None
        self.deadline = limits.Deadline(path)
        self.columns: dict[str, slice] = {}
        count = 0
        for bone in skeleton.bones:
            if bone.dof:
                self.columns[bone.name] = slice(count, count + len(bone.dof))
                count += len(bone.dof)
        self.count = count
        self.empty = [np.nan] * count
        self.max_frames = min(limits.MAX_FRAMES, MAX_VALUES // max(count, 1))

    def fault(self, message: str) -> UserError:
        return UserError(f"{self.path}, line {self.number}: {limits.remedied(message)}")

    def take(self, line: str) -> None:
        """The next line of the file."""
        self.number += 1
        if len(line) >= limits.MAX_LINE:
            raise self.fault("the line is impossibly long: not an AMC motion")
        words = line.split()
        if not words or line.startswith("#"):
            return
        if words[0].startswith(":"):
            self.header(words)
        elif len(words) == 1 and words[0].isdecimal():
            self.finish_frame()
            self.row = self.empty.copy()
        else:
            self.bone(words)

    def header(self, words: list[str]) -> None:
        word = words[0].upper()
        if word.startswith(":DEG"):
            self.degrees = True
        elif word.startswith(":RAD"):
            self.degrees = False
        elif word == _RATE_LINE:
            try:
                rate = float(words[1])
            except (IndexError, ValueError):
                raise self.fault("SAMPLES-PER-SECOND is not followed by a number; "
                                 "correct it") from None  # fmt: skip
            if not limits.FRAME_RATES[0] <= rate <= limits.FRAME_RATES[1]:
                raise self.fault(f"{rate:g} samples a second are not possible")
            self.rate = rate

    def bone(self, words: list[str]) -> None:
        """`name value value …`"""
        columns = self.columns.get(words[0])
        if columns is None or self.row is None:
            if self.row is None:
                raise self.fault(f"{words[0][:40]!r} before the first frame's number: "
                                 "not an AMC motion")  # fmt: skip
            raise self.fault(f"{words[0][:40]!r} is no moving bone of the skeleton; name the "
                             "right one by --skeleton FILE")  # fmt: skip
        try:
            values = [float(word) for word in words[1:]]
        except ValueError:
            shown = " ".join(words)[:60]
            raise self.fault(f"{shown!r} does not hold numbers only") from None
        if len(values) != columns.stop - columns.start:
            raise self.fault(f"{words[0][:40]!r} has {len(values)} values, the "
                             f"skeleton says {columns.stop - columns.start}")  # fmt: skip
        self.row[columns] = values

    def finish_frame(self) -> None:
        """Keep the frame that ends here."""
        if self.row is None:
            return
        row = np.array(self.row)
        if not np.abs(row).max(initial=0.0) < limits.MAX_VALUE:  # also true for NaN
            column = int(np.flatnonzero(~(np.abs(row) < limits.MAX_VALUE))[0])
            name = next(n for n, c in self.columns.items() if c.start <= column < c.stop)
            what = "is missing from" if np.isnan(row[column]) else "is impossibly large in"
            raise self.fault(f"{name[:40]!r} {what} frame {self.done + 1}, "
                             "which ends here; the file is damaged or cut off")  # fmt: skip
        if self.done >= self.max_frames:
            raise self.fault(f"more than {self.max_frames} frames; split the file")
        self.frames += row.tobytes()
        self.done += 1
        self.row = None
        if not self.done % 256:
            self.deadline.check()
