"""Which joint of a source skeleton plays which of ours, and where its axes point."""

import json
import re
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, field_validator

from ..errors import UserError
from ..motion.skeleton import JOINT_NAMES
from .tables import load_table

Axis = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
# Joints without which a body cannot be told; the others are interpolated.
REQUIRED = tuple(
    name
    for name in JOINT_NAMES
    if name
    not in ("spine1", "spine2", "spine3", "neck", "l_collar", "r_collar", "l_foot", "r_foot")
)
COMMON_PREFIX = 0.8  # of a file's joints must share what is taken for their prefix


class SkeletonMapping(BaseModel):
    """One profile of skeletons.yaml."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    joints: dict[str, str]
    axes: dict[str, tuple[Axis, Axis, Axis]] = {}

    @field_validator("joints")
    @classmethod
    def _check_joints(cls, joints: dict[str, str]) -> dict[str, str]:
        if unknown := sorted(set(joints) - set(JOINT_NAMES)):
            raise ValueError(f"unknown joint {unknown[0]!r}; ours are {', '.join(JOINT_NAMES)}")
        if missing := [name for name in REQUIRED if name not in joints]:
            raise ValueError(f"joint {missing[0]!r} is not mapped")
        return joints

    @field_validator("axes")
    @classmethod
    def _check_axes(
        cls, axes: dict[str, tuple[Axis, Axis, Axis]]
    ) -> dict[str, tuple[Axis, Axis, Axis]]:
        for joint, directions in axes.items():
            if not np.isclose(np.linalg.det(_axes_matrix(directions)), 1):
                raise ValueError(f"axes {list(directions)} of {joint!r} are not right-handed")
        return axes

    def axes_of(self, source_joint: str) -> np.ndarray:
        """Rotation [3,3] of the source joint's axes in the T-pose."""
        return _axes_matrix(self.axes.get(source_joint, ("+X", "+Y", "+Z")))


def _axes_matrix(directions: tuple[Axis, Axis, Axis]) -> np.ndarray:
    columns = [
        (1.0 if axis[0] == "+" else -1.0) * np.eye(3)["XYZ".index(axis[1])] for axis in directions
    ]
    return np.stack(columns, -1)


class MappingFile(BaseModel):
    """skeletons.yaml."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    profiles: tuple[SkeletonMapping, ...]


@cache
def _shipped() -> MappingFile:
    """Ours; reading them takes longer than reading a clip."""
    return load_table("skeletons.yaml", MappingFile)


def load_mappings(extra: Path | None = None) -> tuple[SkeletonMapping, ...]:
    """The user's profiles first, then ours."""
    files = [_shipped()]
    if extra is not None:
        files.insert(0, load_table(extra, MappingFile))
    return tuple(profile for file in files for profile in file.profiles)


def find_mapping(names: tuple[str, ...], mappings: tuple[SkeletonMapping, ...]) -> SkeletonMapping:
    """The profile that fits a file best, in the file's own joint names.

    The first profile whose joints are all there; else, of those that miss only joints that can
    be interpolated (left out of the result), the one that finds most. Spelling counts little:
    `mixamorig:LeftUpLeg`, `left_up_leg` and `LeftUpLeg` are one joint.

    Raises:
        UserError: no profile fits; names the closest one, the joints it misses, and what to do.
    """
    spelled = _spellings(names)
    found = [_translated(mapping, names, spelled) for mapping in mappings]
    for mapping, translated in zip(mappings, found, strict=True):
        if len(translated) == len(mapping.joints):
            return _renamed(mapping, translated)
    profiles = list(zip(mappings, found, strict=True))
    best, translated = max(profiles, key=lambda p: (_required(p[1]), len(p[1]), -len(p[0].joints)))
    if _required(translated) == len(REQUIRED):
        return _renamed(best, translated)
    raise UserError(_missing_text(names, best, translated))


def _required(translated: dict[str, str]) -> int:
    return sum(name in translated for name in REQUIRED)


def _translated(
    mapping: SkeletonMapping, names: tuple[str, ...], spelled: dict[str, str]
) -> dict[str, str]:
    """Our joint -> joint of the file, for those that are there."""
    found = {
        ours: theirs if theirs in names else spelled.get(plain(theirs), "")
        for ours, theirs in mapping.joints.items()
    }
    return {ours: theirs for ours, theirs in found.items() if theirs}


def _renamed(mapping: SkeletonMapping, translated: dict[str, str]) -> SkeletonMapping:
    """The profile with the file's own names, without joints that the file lacks."""
    if translated == mapping.joints:
        return mapping
    axes = {
        theirs: mapping.axes[mapping.joints[ours]]
        for ours, theirs in translated.items()
        if mapping.joints[ours] in mapping.axes
    }
    return mapping.model_copy(update={"joints": translated, "axes": axes})


def plain(name: str) -> str:
    """A joint's name without namespace, case and punctuation."""
    name = re.sub(r"^.*[:|]", "", name)
    name = re.sub(r"^mixamorig\d*", "", name, flags=re.I)
    return re.sub(r"[\W_]", "", name).casefold()


def words(name: str) -> list[str]:
    """The words of a name, told by case, digits and punctuation, in small letters."""
    found = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[^\W\d_a-zA-Z]+", name)
    return [word.casefold() for word in found]


def _spellings(names: tuple[str, ...]) -> dict[str, str]:
    """Plain name -> name in the file, for names with and without a prefix that most share."""
    heads = Counter(head[0] for name in names if (head := re.match(r"^[^ _.\-]+[ _.\-]", name)))
    prefix, count = heads.most_common(1)[0] if heads else ("", 0)
    spelled: dict[str, str] = {}
    for name in names:
        spelled.setdefault(plain(name), name)
        if count >= COMMON_PREFIX * len(names):
            spelled.setdefault(plain(name.removeprefix(prefix)), name)
    return spelled


def _missing_text(
    names: tuple[str, ...], mapping: SkeletonMapping, translated: dict[str, str]
) -> str:
    missing = [name for name in REQUIRED if name not in translated]
    text = ", ".join(f"{ours} ({mapping.joints[ours]})" for ours in missing)
    free = [name[:40] for name in names if name not in translated.values()]
    shown = ", ".join(free[:12]) + (" …" if len(free) > 12 else "")
    return (
        f"no skeleton mapping fits; the closest, {mapping.name!r}, misses {text};"
        f" joints of the file without a part: {shown or 'none'};"
        " write a profile (`inspect FILE --write-mapping my.yaml` begins one), name the file's"
        f" joint after {missing[0]!r} in it, and give it by --mapping"
    )


def closest_joints(names: tuple[str, ...], mappings: tuple[SkeletonMapping, ...]) -> dict[str, str]:
    """Our joint -> joint of the file, of the profile that finds most."""
    spelled = _spellings(names)
    return max((_translated(mapping, names, spelled) for mapping in mappings), key=len)


def profile_text(names: tuple[str, ...], found: dict[str, str]) -> str:
    """YAML of a profile for a file, to be corrected: what was found, and `?` where nothing was."""
    lines = ["# Our joint: joint of the file. Fill in every ?; lines that no joint fits may go,",
             "# except " + ", ".join(REQUIRED) + ".",
             "# Joints of the file: " + ", ".join(names), "profiles:", "  - name: mine",
             "    joints:"]  # fmt: skip
    lines += [f"      {ours}: {json.dumps(found.get(ours, '?'), ensure_ascii=False)}"
              for ours in JOINT_NAMES]  # fmt: skip
    return "\n".join(lines) + "\n"
