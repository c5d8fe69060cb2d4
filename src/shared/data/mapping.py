"""Which joint of a source skeleton plays which of ours, and where its axes point."""

from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, field_validator

from src.shared.data.tables import load_table
from src.shared.errors import UserError
from src.shared.motion.skeleton import JOINT_NAMES

Axis = Literal["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
# Joints without which a body cannot be told; the others are interpolated.
REQUIRED = tuple(
    name
    for name in JOINT_NAMES
    if name not in ("spine1", "spine2", "spine3", "l_collar", "r_collar", "l_foot", "r_foot")
)


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

    def axes_of(self, source_joint: str, default: np.ndarray | None = None) -> np.ndarray:
        """Rotation [3,3] of the source joint's axes in the T-pose."""
        if source_joint in self.axes or default is None:
            return _axes_matrix(self.axes.get(source_joint, ("+X", "+Y", "+Z")))
        return default

    def missing(self, names: tuple[str, ...]) -> list[str]:
        """Our joints whose source joint is not among `names`."""
        return [ours for ours, theirs in self.joints.items() if theirs not in names]


def _axes_matrix(directions: tuple[Axis, Axis, Axis]) -> np.ndarray:
    columns = [
        (1.0 if axis[0] == "+" else -1.0) * np.eye(3)["XYZ".index(axis[1])] for axis in directions
    ]
    return np.stack(columns, -1)


class MappingFile(BaseModel):
    """skeletons.yaml."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    profiles: tuple[SkeletonMapping, ...]


def load_mappings(extra: Path | None = None) -> tuple[SkeletonMapping, ...]:
    """The user's profiles first, then ours."""
    files = [load_table("skeletons.yaml", MappingFile)]
    if extra is not None:
        files.insert(0, load_table(extra, MappingFile))
    return tuple(profile for file in files for profile in file.profiles)


def find_mapping(names: tuple[str, ...], mappings: tuple[SkeletonMapping, ...]) -> SkeletonMapping:
    """The first profile whose joints are all there.

    Raises:
        UserError: no profile fits; names the closest one and the joints it misses.
    """
    for mapping in mappings:
        if not mapping.missing(names):
            return mapping
    closest = min(mappings, key=lambda mapping: len(mapping.missing(names)))
    missing = ", ".join(f"{ours} ({closest.joints[ours]})" for ours in closest.missing(names))
    raise UserError(
        f"no skeleton mapping fits; the closest, {closest.name!r}, misses {missing};"
        " add a profile with --mapping FILE (format: src/configs/skeletons.yaml)"
    )
