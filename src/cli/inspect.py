"""`inspect`: what a motion file holds, and how it would be read."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..shared.errors import UsageError
from . import options
from .console import print_json, tell

if TYPE_CHECKING:
    from ..shared.data.retarget.read_motion import Inspection

MAX_INDENT = 24  # levels; deeper joints are shown there


def inspect(
    file: Annotated[Path, typer.Argument(help="A motion file: bvh, amc, glb, npz or npy.")],
    mapping: options.Mapping = None,
    unit: options.Unit = None,
    up: options.Up = None,
    skeleton: options.Skeleton = None,
    source_fps: options.SourceFps = None,
    write_mapping: Annotated[
        Path | None, typer.Option(help="Begin a skeleton profile for this file, to be filled in.")
    ] = None,
    json: options.Json = False,
) -> None:
    """Show skeleton, length, units, axes and mapping of a motion file.

    \b
    Examples:
      motion-tools inspect dance.bvh
      motion-tools inspect dance.bvh --write-mapping my.yaml
    """
    options.check_ranges(source_fps=source_fps)
    if skeleton is not None and file.suffix.lower() != ".amc":
        raise UsageError(
            f"--skeleton {skeleton} is the skeleton of an .amc, and {file} is none; leave it out"
        )
    check_new_mapping(write_mapping)
    from ..shared.data.retarget.read_motion import inspect_motion

    found = inspect_motion(
        file, mapping=mapping, unit=unit, up=up, skeleton=skeleton, source_fps=source_fps
    )
    if write_mapping is not None:
        begin_mapping(found, mapping, write_mapping)
    if json:
        joints = [{"name": name, "parent": parent} for name, parent in found.joints]
        print_json(asdict(found) | {"joints": joints})
    else:
        print(file)
        print("\n".join(lines(found)))


def check_new_mapping(path: Path | None) -> None:
    """Refuse to write a profile over anything: a recording, or what somebody filled in."""
    if path is None:
        return
    if path.suffix.lower() not in (".yaml", ".yml"):
        raise UsageError(f"--write-mapping {path} is no .yaml file; name one")
    if path.exists():
        raise UsageError(f"--write-mapping {path} is there already; name another file")


def begin_mapping(found: "Inspection", mapping: Path | None, out: Path) -> None:
    """Write a profile of what was found, with a ? for each joint that was not."""
    from ..shared.data.retarget.mapping import closest_joints, load_mappings, profile_text
    from ..shared.io.files import write_text

    names = tuple(name for name, _ in found.joints)
    joints = found.matched or closest_joints(names, load_mappings(mapping))
    write_text(out, profile_text(names, joints))
    tell(f"{out}: fill in every ?, then give it by --mapping")


def lines(found: "Inspection") -> list[str]:
    """The report for people."""
    unit = found.unit or "unknown"
    roles = {theirs: ours for ours, theirs in found.matched.items()}
    result = [
        f"  format    {found.format}",
        f"  length    {found.seconds:.2f} s: {found.frames} frames, {found.fps:.5g} a second",
        f"  unit      {unit}{' (guessed)' if 'unit' in found.guessed else ''}",
        f"  up axis   {found.up}{' (guessed)' if 'up' in found.guessed else ''}",
        f"  mapping   {found.mapping or 'none fits'}; {len(roles)} of our 22 joints",
        f"  skeleton  {len(found.joints)} joints" + (", ours on the right" if roles else ""),
    ]
    for level, name in tree(found.joints):
        label = "    " + "  " * min(level, MAX_INDENT) + name
        result.append(f"{label:<44}{roles.get(name, '')}".rstrip())
    return result + [f"  warning: {warning}" for warning in found.warnings]


def tree(joints: tuple[tuple[str, int], ...]) -> list[tuple[int, str]]:
    """(level, name) of each joint, every child below its parent."""
    children: dict[int, list[int]] = {}
    for joint, (_, parent) in enumerate(joints):
        children.setdefault(parent, []).append(joint)
    result, todo = [], [(0, joint) for joint in reversed(children.get(-1, []))]
    while todo:
        level, joint = todo.pop()
        result.append((level, joints[joint][0]))
        todo += [(level + 1, child) for child in reversed(children.get(joint, []))]
    return result
