"""`convert`: any motion file in, any format out; `inspect`: what is in one, and how it is read."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from functools import lru_cache
from operator import itemgetter
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.errors import MissingFile, UsageError, UserError
from ..shared.io.files import same_place
from ..shared.io.storage import Address, Place, fetched, place
from . import options
from .console import complain, counted, note_replaced, print_json, tell

if TYPE_CHECKING:
    from ..shared.data.retarget.read_motion import Inspection
    from ..shared.data.retarget.to_rig import Target
    from ..shared.motion.motion import Motion


@dataclass(frozen=True)
class Job:
    """One file to read and those to write from it, each with its format."""

    source: Place
    targets: tuple[tuple[str, Place], ...]


def convert(
    files: Annotated[
        list[str],
        typer.Argument(
            metavar="IN... OUT",
            help="Motion files or folders of them, then a file, or a folder with --format.",
        ),
    ],
    format: Annotated[
        str | None,
        typer.Option(
            help="Into a folder, with commas between: bvh, glb, usd, usda, usdc, fbx, vrm, vrma,"
            " npz, amass, csv, html, png, gif, mp4."
        ),
    ] = None,
    fps: Annotated[float | None, typer.Option(help="Frames a second of OUT; those of IN.")] = None,
    root: options.Root = "on",
    names: Annotated[
        str,
        typer.Option(help="Joint names in bvh, glb, fbx, usd: canonical, mixamo, unity, unreal."),
    ] = "canonical",
    skeleton: Annotated[
        Path | None,
        typer.Option(help="Move this character instead of ours: a .bvh, .glb, .vrm or .fbx."),
    ] = None,
    mapping: Annotated[
        Path | None, typer.Option(help="YAML: which joints of IN and --skeleton are which of ours.")
    ] = None,
    unit: options.Unit = None,
    up: options.Up = None,
    asf: Annotated[Path | None, typer.Option(help="Skeleton of an .amc; else beside it.")] = None,
    source_fps: options.SourceFps = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Into a folder: skip files newer than their IN.")
    ] = False,
    workers: Annotated[int, typer.Option(help="Processes.")] = 1,
    scheduler: options.Scheduler = None,
    json: options.Json = False,
) -> None:
    """Convert motion files: any mocap in, any tool out.

    \b
    Examples:
      motion-tools convert walk.bvh walk.glb
      motion-tools convert walk.npz walk.bvh --skeleton my_character.bvh --fps 60
      motion-tools convert mocap/ converted/ --format glb,amass
    """
    from ..shared.formats.rig import joint_names
    from ..shared.io.jobs import run_jobs

    options.check_root(root)
    options.check_scheduler(scheduler)
    joint_names(names)
    named = list(map(place, files))
    jobs = list(plan(named, format))
    formats = list(dict.fromkeys(name for job in jobs for name, _ in job.targets))
    check_rigged(formats, names, skeleton)
    check_sources(jobs, asf, skeleton)
    if skeleton is not None and "vrm" in formats:
        character(skeleton, mapping).check_avatar()
    kept = {job.source for job in jobs if resume and is_done(job)}
    jobs = [job for job in jobs if job.source not in kept]
    folder = named[-1] if format else named[-1].parent
    note_replaced([path for job in jobs for _, path in job.targets], folder)
    reading = {"mapping": mapping, "unit": unit, "up": up, "fps": fps, "skeleton": asf}
    how = How(reading | {"source_fps": source_fps}, root, names, skeleton, mapping)
    tasks = {anchored(job) if scheduler else job: job for job in jobs}
    how = anchored(how) if scheduler else how
    done, faults = {}, []
    todo = [(task, how) for task in tasks]
    for (task, _), (length, error) in run_jobs(attempt, todo, workers, scheduler):
        job = tasks[task]
        if error is not None:
            usage = isinstance(error, UsageError) and not isinstance(error, MissingFile)
            if len(jobs) + len(kept) == 1 or usage:
                raise error
            complain(f"error: {error}")
            faults.append({"file": str(job.source), "error": str(error)})
            continue
        made = {name: str(path) for name, path in job.targets}
        done[job] = {"source": str(job.source)} | length | {"files": made}
        if not json:
            print(*made.values(), sep="\n", flush=True)
    rows = [done[job] for job in jobs if job in done]
    faults.sort(key=itemgetter("file"))
    if json:
        skipped = sorted(map(str, kept))
        print_json({"converted": rows, "failed": faults, "skipped": skipped})
    if kept:
        tell(f"{counted(len(kept), 'file')} skipped: newer than what they were made from")
    if faults:
        raise UserError(
            f"{counted(len(faults), 'file')} of {len(jobs)} could not be converted"
            "; mend or leave out what is named above"
        )


# ---------------------------------------------------------------- what to do


def plan(files: list[Place], format: str | None) -> Iterator[Job]:
    """Which files are read and written; everything the flags get wrong is said here."""
    from ..shared.formats.registry import EXPORTERS, ending, find_writer, format_of

    if len(files) < 2:
        raise UsageError("OUT is missing: give what to read, then what to write")
    *sources, out = files
    for source in sources:
        if not source.exists():
            raise UsageError(f"{source} does not exist; name a motion file or a folder of them")
    if format is None:
        if len(sources) > 1 or sources[0].is_dir() or out.is_dir():
            raise UsageError(f"{out}: with a folder, --format says what to write; give one, e.g. "
                             "--format glb")  # fmt: skip
        name = format_of(Path(out.name))
        check_apart(sources[0], out)
        if isinstance(out, Path):
            options.check_file("OUT", out)
        yield Job(sources[0], ((name, out),))
        return
    formats = list(dict.fromkeys(options.parts(format.lower())))
    if not formats:
        raise UsageError(f"--format {format!r} names nothing; choose from {', '.join(EXPORTERS)}")
    for name in formats:
        find_writer(EXPORTERS, name, f"--format {format}")
    options.check_folder("OUT", out)
    taken: dict[Place, Place] = {}
    for source, below in found(sources):
        targets = tuple((name, out / f"{below}.{ending(name)}") for name in formats)
        for _, target in targets:
            check_apart(source, target)
            if target in taken:
                raise UsageError(f"{taken[target]} and {source} would both become {target}; "
                                 "convert them into two folders")  # fmt: skip
            taken[target] = source
        yield Job(source, targets)


def found(sources: list[Place]) -> Iterator[tuple[Place, str]]:
    """Every file to read, and its path in the output folder without the ending."""
    from ..shared.data.retarget.read_motion import ENDINGS

    for source in sources:
        if source.is_dir():
            if isinstance(source, Address):
                names = sorted(source.find())
            else:
                paths = sorted(source.rglob("*"))
                names = [path.relative_to(source).as_posix() for path in paths]
            inside = [name for name in names if PurePosixPath(name).suffix.lower() in ENDINGS]
            if not inside:
                raise UserError(f"{source} holds no motion file; known are {', '.join(ENDINGS)}")
            for name in inside:
                yield source / name, stem(name)
        else:
            yield source, stem(source.name)


def stem(name: str) -> str:
    """A name without the ending, `.amass.npz` being one."""
    return name.removesuffix(Path(name).suffix).removesuffix(".amass")


def check_apart(source: Place, target: Place) -> None:
    """Refuse to write over what is read."""
    if same_place(source, target):
        raise UsageError(f"{target} would be written over itself; name another OUT")


def check_sources(jobs: list[Job], asf: Path | None, skeleton: Path | None) -> None:
    """Refuse an ASF that no motion is on, and to write over the character."""
    if asf is not None and not any(job.source.suffix.lower() == ".amc" for job in jobs):
        raise UsageError(f"--asf {asf} is the skeleton of an .amc, and IN is none; leave it out")
    for job in jobs:
        for _, target in job.targets:
            if skeleton is not None and same_place(skeleton, target):
                raise UsageError(f"{target} is the skeleton's own file; name another OUT")


def check_rigged(formats: list[str], names: str, skeleton: Path | None) -> None:
    """Refuse names and skeletons for formats that know ours only."""
    from ..shared.formats.registry import CLIP_EXPORTERS

    able = [*CLIP_EXPORTERS, "vrm"] if skeleton else [*CLIP_EXPORTERS]
    rigged, known = set(formats) & set(able), ", ".join(able)
    if skeleton is not None:
        if names != "canonical":
            raise UsageError(
                "--names does not go with --skeleton, which has names of its own; leave one out"
            )
        if other := sorted(set(formats) - rigged):
            raise UsageError(f"--skeleton does not go with {other[0]}; choose from {known}")
        if skeleton.suffix.lower() not in (".bvh", ".glb", ".vrm", ".fbx"):
            raise UsageError(
                f"--skeleton {skeleton} is no .bvh, .glb, .vrm or .fbx file"
                "; export the character as one of them"
            )
    elif names != "canonical" and not rigged:
        raise UsageError(f"--names {names} goes with {known} only; leave it out")


def is_done(job: Job) -> bool:
    """Whether all targets are there and newer than the source; of addresses, there."""
    places = (job.source, *(target for _, target in job.targets))
    if any(isinstance(one, Address) for one in places):
        return all(target.exists() for _, target in job.targets)
    assert isinstance(job.source, Path)
    if not job.source.exists():  # a link to nowhere: reading tells
        return False
    when = job.source.stat().st_mtime
    paths = [Path(str(path)) for _, path in job.targets]
    return all(path.exists() and path.stat().st_mtime >= when for path in paths)


# ---------------------------------------------------------------- doing it


@dataclass(frozen=True)
class How:
    """What all files of a command have in common."""

    reading: dict[str, Any]
    root: str
    names: str
    skeleton: Path | None
    mapping: Path | None


def anchored(value: Any) -> Any:
    """The same with paths that lead there from anywhere, for workers of a cluster."""
    if isinstance(value, Path):
        return value.absolute()
    if isinstance(value, dict):
        return {name: anchored(one) for name, one in value.items()}
    if isinstance(value, tuple):
        return tuple(map(anchored, value))
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{f.name: anchored(getattr(value, f.name)) for f in fields(value)})
    return value


def attempt(task: tuple[Job, How]) -> tuple[dict[str, Any], UserError | None]:
    """Read one file and write its targets; how long it is, or the fault."""
    from ..shared.data.retarget.read_motion import read_motion
    from ..shared.motion.motion import in_place

    job, how = task
    try:
        with fetched(job.source) as local:
            motion = read_motion(local, **how.reading)
        motion = in_place(motion) if how.root == "in-place" else motion
        write = writer(how.skeleton, how.mapping, how.names)
        for _, path in job.targets:
            with delivered(path) as local:
                write(motion, local)
    except UserError as error:
        return {}, error
    return {"frames": motion.num_frames, "fps": motion.fps}, None


@contextmanager
def delivered(path: Place) -> Iterator[Path]:
    """The file to write: itself, or one that is put to the address in the end."""
    if isinstance(path, Path):
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="motionsuite-") as folder:
        yield (local := Path(folder, path.name))
        path.write_bytes(local.read_bytes())


@lru_cache(maxsize=1)
def character(skeleton: Path, mapping: Path | None) -> "Target":
    """The user's skeleton, which is read once a process."""
    from ..shared.data.retarget.to_rig import read_target

    return read_target(skeleton, mapping=mapping)


def writer(
    skeleton: Path | None, mapping: Path | None, names: str
) -> "Callable[[Motion, Path], Path]":
    """What writes a motion: on our skeleton, or on the user's."""
    from ..shared.formats.registry import write_motion

    if skeleton is None:
        return lambda motion, path: write_motion(motion, path, names=names)
    return character(skeleton, mapping).write


MAX_INDENT = 24  # levels; deeper joints are shown there


def inspect(
    file: Annotated[
        Path,
        typer.Argument(help="A motion or an avatar: bvh, amc, glb, vrma, vrm, npz, npy, fbx."),
    ],
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
    if skeleton is not None and file.suffix.lower() != ".amc":
        raise UsageError(
            f"--skeleton {skeleton} is the skeleton of an .amc, and {file} is none; leave it out"
        )
    check_new_mapping(write_mapping)
    if not file.exists():
        raise UsageError(f"{file} does not exist; name a motion file")
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
