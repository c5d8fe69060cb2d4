"""ASF skeletons in (Acclaim): bones, their axes, degrees of freedom and the hierarchy.

The form is that of the Acclaim skeleton file as HDM05 and CMU use it: sections that begin with a
colon, `begin … end` blocks, `#` comments. A bone reaches from its parent's end along `direction`
(in world axes at rest) for `length`; its motion is given about axes turned by `axis`.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import UserError
from .limits import MAX_JOINTS, MAX_VALUE, read_bytes, remedied

ROOT = "root"
MAX_BYTES = 8 << 20
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


class _Reader:
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
        return UserError(f"{self.path}, line {self.number}: {remedied(message)}")

    def numbers(self, words: list[str], count: int, what: str) -> tuple[float, ...]:
        try:
            values = tuple(float(word) for word in words[:count])
        except ValueError:
            values = ()
        if len(values) != count:
            shown = " ".join(words)[:60]
            raise self.fault(f"{what} {shown!r} is not {_counted(count)}")
        if not np.abs(values).max() < MAX_VALUE:
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
        if len(self.bones) > MAX_JOINTS:
            raise self.fault(f"more than {MAX_JOINTS} bones")

    def hierarchy(self, words: list[str]) -> None:
        if words[0] in ("begin", "end"):
            return
        self.children.append((self.number, words[0], words[1:]))


def _counted(count: int) -> str:
    return "a number" if count == 1 else f"{count} numbers"


def read_asf(path: str | Path) -> AsfSkeleton:
    """Read an ASF skeleton.

    Raises:
        UserError: missing, too large, not ASF, or with a faulty or unconnected bone; names the
            file and the line.
    """
    path = Path(path)
    text = read_bytes(path, MAX_BYTES).decode("latin-1")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    reader = _Reader(path)
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


def _sorted(reader: _Reader) -> tuple[Bone, ...]:
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
