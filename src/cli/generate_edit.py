"""`generate --start, --end, --edit, --path, --timeline, --then, --loop`: one motion, directed."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.errors import UsageError, UserError
from .directions import KEEP, Directions
from .generate_text import write_motions
from .guard import complain
from .stopwatch import Stopwatch

if TYPE_CHECKING:
    from ..shared.model.diffusion.samplers import Sampling
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.motion.motion import Motion
    from ..shared.pipelines.edit import ControlledMotion, Given

SAMPLING = ("seed", "steps", "sampler", "guidance_scale")


def produce_directed(
    directions: Directions,
    wanted: dict[str, Any],
    formats: list[str],
    out: Path,
    *,
    model: str,
    device: str,
    threads: int | None,
) -> dict[str, Any]:
    """Read, load, make, write; says which files there are, what was kept how well, and the times.

    Args:
        directions: checked.
        wanted: prompts and tags (several follow each other), seconds, foot_lock; under `sampling`,
            what `Sampling` takes.
        formats: any of `generate_text.FORMATS`.
        out: folder for the files.
        model: name or folder.
        device: auto, cpu, cuda or mps.
        threads: CPU threads; None = torch's choice.
    """
    clock = Stopwatch()
    from ..shared.device import set_threads
    from ..shared.model.diffusion.samplers import Sampling
    from ..shared.model.generation.motion_generator import TextToMotion
    from .generate_timeline import make_timed, read_timed

    clock.lap("import")
    settings = Sampling(**wanted["sampling"])
    timed = directions.kind in ("path", "timeline")
    given = None if timed else read_given(directions, wanted["seconds"])
    task = read_timed(directions, wanted) if timed else None
    clock.lap("read")
    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device=device)
    clock.lap("load")
    texts = task.texts if task is not None else wanted["prompts"]
    warnings = generator.scope_warnings(texts) if texts else []
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    if task is not None:
        made = make_timed(generator, task, settings, wanted["foot_lock"])
    else:
        assert given is not None, "read above"
        made = make_edited(generator, given, wanted, settings)
    clock.lap("sample")
    rows = write_motions([made.motion], 1, formats, out)
    rows[0] |= {"seed": settings.seed, "directions": directions.given(), "errors": made.errors}
    rows[0] |= {"warning": next(filter(None, warnings), None)}
    clock.lap("write")
    about = {"model": model, "device": str(generator.device), "seed": settings.seed}
    results = {"motions": rows, "selection": [], "index": None}
    return about | results | {"timings": clock.seconds()}


def read_given(directions: Directions, seconds: float | None) -> "Given":
    """What is kept of the clips that were named.

    Raises:
        UserError: a clip cannot be read, or is shorter than what is asked of it.
    """
    from ..shared.pipelines.edit import chosen_joints

    names = [part.strip() for part in (directions.joints or "").split(",") if part.strip()]
    if directions.joints is not None and not names:
        raise UsageError("--joints is empty; name joints or groups, e.g. --joints left-arm,head")
    joints = chosen_joints(names) if names else None
    if directions.edit is not None:
        return read_edit(directions, read_clip(directions.edit), joints)
    return read_ends(directions, seconds)


def read_edit(directions: Directions, clip: "Motion", joints: set[str] | None) -> "Given":
    """A clip of which joints or a span are made anew.

    Raises:
        UserError: the span is not in it.
    """
    from ..shared.pipelines.edit import redo

    begin, until = directions.begin or 0.0, directions.until
    until = clip.seconds if until is None else until
    start, stop = round(begin * clip.fps), round(until * clip.fps)
    if begin < 0 or stop > clip.num_frames or start >= stop:
        raise UserError(
            f"--from {begin:g} --to {until:g}: {directions.edit} lasts {clip.seconds:.2f} s;"
            " choose a span of it"
        )
    return redo(clip, start, stop, joints)


def read_ends(directions: Directions, seconds: float | None) -> "Given":
    """A motion that begins or ends as clips do; of one clip at both ends the middle is made anew.

    Raises:
        UserError: a clip is shorter than what is to be kept, or nothing would be left to make.
    """
    from ..shared.pipelines.edit import keep_ends

    start = None if directions.start is None else read_clip(directions.start)
    end = None if directions.end is None else read_clip(directions.end)
    keep = KEEP if directions.keep is None else directions.keep
    clip = start or end
    assert clip is not None, "one of them was given"
    for flag, motion in (("--start", start), ("--end", end)):
        if motion is not None and motion.seconds < keep:
            raise UserError(
                f"{flag}: the clip lasts {motion.seconds:.2f} s, less than the {keep:g} s to be"
                " kept; give a smaller --keep"
            )
    same = directions.start == directions.end
    if seconds is None:
        seconds = clip.seconds if same else 2 * keep + 2.0
    frames, kept = round(seconds * clip.fps), round(keep * clip.fps)
    ends = sum(motion is not None for motion in (start, end))
    if frames - ends * kept < 1 or kept < 1:
        raise UsageError(
            f"--seconds {seconds:g} leaves nothing to make: {ends} × {keep:g} s are kept; give"
            " more --seconds or a smaller --keep"
        )
    return keep_ends(start, end, kept, frames, rejoin=same)


def read_clip(path: Path) -> "Motion":
    """A motion file of any kind that can be read.

    Raises:
        UserError: none, or not that.
    """
    from ..shared.data.read_motion import read_motion

    return read_motion(path)


def make_edited(
    generator: "TextToMotion",
    given: "Given",
    wanted: dict[str, Any],
    settings: "Sampling",
) -> "ControlledMotion":
    """What is given stays, the rest is made as the prompt says."""
    from ..shared.pipelines.edit import edited

    text = wanted["prompts"][0] if wanted["prompts"] else None
    tag = wanted["tags"][0] if wanted["tags"] else None
    return edited(generator, text, given, settings, tag=tag, foot_lock=wanted["foot_lock"])
