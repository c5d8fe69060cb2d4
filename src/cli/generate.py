"""`generate`: prompts or a song in, motion files out; four kinds, each checks, makes and writes."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.environment import compute_without_torch
from ..shared.errors import UsageError
from . import generate_files as files
from . import options
from .console import (
    Stopwatch,
    check_range,
    counted,
    flag_of,
    note_replaced,
    of_fields,
    print_json,
    progress_bar,
    tell,
)
from .generate_request import (
    LONGEST,
    SHORTEST,
    Request,
    check_figures,
    check_runtime,
    check_song,
    checked_prompts,
    checked_tags,
    refuse_music,
    refuse_with,
    warn,
)

if TYPE_CHECKING:
    from ..shared.audio.song import Song
    from ..shared.model.generation.motion_generator import Progress
    from ..shared.motion.motion import Motion
    from ..shared.pipelines.edit import Given
    from ..shared.pipelines.motion_generator import MotionGenerator
    from ..shared.pipelines.path import DrawnPath
    from ..shared.pipelines.ranking import ScoreTable
    from ..shared.pipelines.timeline import Timeline

LONG_SONG = 150.0  # seconds
GROUP = 8  # prompts
STAGES = {"path": "frames of the path", "body": "frames of the body"}


@of_fields(Request)
def generate(request: Request) -> None:
    """Turn prompts, or a song, into motion files.

    \b
    Examples:
      motion-tools generate --prompt "a person walks forward" --prompt "saluda con la mano"
      motion-tools generate --prompt "a person walks" --then "a person claps"
      motion-tools generate --edit clip.bvh --joints right-arm --prompt "a person waves"
      motion-tools generate --audio song.mp3
      motion-tools generate --audio song.mp3 --prompt "a proud old man dances"
    """
    limits = (1.0, 7200.0) if request.audio or request.given() else (SHORTEST, LONGEST)
    check_range("seconds", request.seconds, *limits)
    options.check_folder("--out", request.out)
    if request.judge is not None and request.num_samples == 1:
        raise UsageError("--judge compares candidates: give --num-samples 2 or more with it")
    if request.audio:
        check_song(request.audio)
        check_range("meter", request.meter, 3, 4)
    result = produce(request)
    if result["selection"]:
        files.show_scores(result["selection"])
    if request.json:
        print_json(result)
    else:
        print_files(result)


def produce(request: Request) -> dict[str, Any]:
    """Make and write the motions; which lie in which files, and what took how long.

    Raises:
        UsageError: options that do not go together.
        UserError: as the model, the song or the files.
    """
    check_runtime(request)
    if request.light:
        compute_without_torch()
    if (song := request.song) is not None:
        from ..shared.audio.sound import check_sound

        if others := [flag for flag in request.given() if flag != "--path"]:
            raise UsageError(f"{others[0]} does not go with --audio; leave one out")
        refuse_with("--audio", prompts=request.prompts, resume=request.resume or None)
        check_figures(request)
        check_sound(song)
        return (song_path if request.path_alone else dance)(request, song)
    dancing = ("body", "body_model", "follow_path")
    for name in dancing:
        if getattr(request, name):
            raise UsageError(
                f"{flag_of(name)} is about a dance; name a song with --audio, or leave it out"
            )
    if given := request.given():
        refuse_with(given[0], prompts=request.prompts, resume=request.resume or None)
        return controlled(request)
    return prompted(request)


# ---------------------------------------------------------------- the four kinds


def prompted(request: Request) -> dict[str, Any]:
    """A motion for each prompt."""
    refuse_music(request, "--prompt")
    prompts, lengths, tags, formats = *request.asked(), request.body_formats()
    clock = Stopwatch()
    generator = request.generator()
    clock.lap("import")
    several = request.num_samples > 1
    _ = generator.text, generator.tower if several else None
    clock.lap("load")
    warnings = warn(generator.sentences.scope_warnings(prompts))
    kept, number, sampling = request.kept, request.num_samples, request.sampling
    places = files.motion_files(prompts, kept, formats, request.out)
    whole = [all(path.exists() for path in each.values()) for each in places]
    done = [request.resume and all(whole[at * kept :][:kept]) for at in range(len(prompts))]
    groups = in_groups(prompts, done)
    fresh = [each for group in groups for at in group for each in places[at * kept :][:kept]]
    rows: list[dict[str, Any]] = [{} for _ in places]
    motions: list[Motion | None] = [None for _ in places]
    paged = "html" in formats and len(places) > 1
    if any(done):
        rows = [{"prompt": prompts[at // kept], "files": files.named(each), "resumed": True}
                for at, each in enumerate(places)]  # fmt: skip
        motions = files.read_back(places, [paged and one for one in whole])
    judged: list[tuple[str, ScoreTable]] = []
    note_replaced([path for each in fresh for path in each.values()], request.out)
    for group in groups:
        before, total = number * len(judged), number * sum(map(len, groups))
        with progress_bar("motions") as progress:
            found = generator.candidates(
                [prompts[at] for at in group],
                number,
                return_all=request.return_all,
                seconds=[lengths[at] for at in group],
                tags=None if tags is None else [tags[at] for at in group],
                sampling=sampling,
                foot_lock=request.foot_lock,
                progress=partial(_onward, progress, before, total),
            )
        clock.lap("sample")
        for at, result in zip(group, found, strict=True):
            own = result.ranked()
            written = files.write_motions(own, places[at * kept :][:kept])
            for rank, (row, motion) in enumerate(zip(written, own, strict=True)):
                warning = result.warning
                if rank and warnings[at] is None:
                    warning = generator.sentences.missed(prompts[at], motion)
                row |= {"sample": int(result.table.order[rank]), "rank": rank + 1}
                row |= {"seed": request.seed, "warning": warning}
                row |= {"clauses": [clause.said for clause in result.clauses]}
                rows[at * kept + rank], motions[at * kept + rank] = row, motion
            judged.append((prompts[at], result.table))
        clock.lap("write")
    shown = [motion for motion in motions if motion is not None]
    index = None
    if paged and groups and len(shown) == len(places):
        index = files.write_index(shown, request.out)
        clock.lap("write")
    selection = judged if several else ()
    return told_of_text(request, generator) | results(rows, clock, selection, index)


def _onward(progress: "Progress", before: int, total: int, made: int, _: int) -> None:
    progress(before + made, total)


def in_groups(prompts: Sequence[str], done: Sequence[bool]) -> list[list[int]]:
    """The numbers of the prompts still to be sampled, GROUP at once, and then written: what a stop
    can cost. Equal prompts differ by their order in a group, and so are in one."""
    left = [at for at, one in enumerate(done) if not one]
    if len({*prompts}) < len(prompts):
        return [[*range(len(prompts))]] if left else []
    return [left[at : at + GROUP] for at in range(0, len(left), GROUP)]


def controlled(request: Request) -> dict[str, Any]:
    """One motion after a path, a clip, a timeline or several texts."""
    refuse_music(request, request.given()[0])
    request.check_directions()
    texts = [*(request.prompt or ()), *(request.then or ())]
    texts = checked_prompts(texts) if texts else []
    tags, formats = checked_tags(request.tag, len(texts)), request.body_formats()
    clock = Stopwatch()
    generator = request.generator()
    clock.lap("import")
    options: dict[str, Any] = {"sampling": request.sampling, "foot_lock": request.foot_lock}
    if request.kind in ("path", "timeline"):
        path, timeline = read_timed(request, texts, tags)
        texts = timeline.texts
        clock.lap("read")
        _ = generator.text
        clock.lap("load")
        plain = path is None and not request.loop
        warnings = warn((generator.sentences if plain else generator.text).scope_warnings(texts))
        made = generator.timeline(
            timeline,
            path=path,
            seconds=None if path is None or path.times is not None else request.seconds,
            loop=request.loop,
            **options,
        )
    else:
        given = read_given(request)
        clock.lap("read")
        _ = generator.text
        clock.lap("load")
        warnings = warn(generator.text.scope_warnings(texts)) if texts else []
        text, tag = (each[0] if each else None for each in (texts, tags))
        made = generator.edit(given, text, tag=tag, **options)
    clock.lap("sample")
    (place,) = files.motion_files([made.motion.text], 1, formats, request.out)
    note_replaced(place.values(), request.out)
    rows = files.write_motions([made.motion], [place])
    rows[0] |= {"seed": request.seed, "directions": request.given(), "errors": made.errors}
    rows[0] |= {"warning": "; ".join(filter(None, [*warnings, made.warning])) or None}
    if request.kind == "timeline" and plain:
        rows[0] |= {"clauses": [x.said for t in texts for x in generator.sentences.clauses(t)]}
    clock.lap("write")
    return told_of_text(request, generator) | results(rows, clock)


def song_path(request: Request, audio: Path) -> dict[str, Any]:
    """The path of a song alone."""
    no_body = {name: getattr(request, name) for name in ("tag", "foot_lock", "judge", "body_model")}
    refuse_with("--audio alone", **no_body, path=request.path)
    if request.follow_path:
        raise UsageError('--follow-path is about a body: add --prompt "a person dances", or --body')
    files.check_path_formats(request.format or "")
    from ..shared.formats.registry import TRAJECTORY_EXPORTERS
    from ..shared.motion.trajectory import FPS
    from ..shared.pipelines.song import BEATLESS, frames_of

    formats = files.checked_formats(request.format or "npz,glb,html", TRAJECTORY_EXPORTERS)
    generator, song, clock, style = listen(request, audio, bodies=False)
    if "html" in formats:
        from ..shared.formats.preview.html import begin_song_uri

        begin_song_uri(audio, frames_of(song, request.seconds) / FPS)
    made = generator.trajectory(
        song,
        seconds=request.seconds,
        style=style,
        num_samples=request.num_samples,
        sampling=request.sampling,
        stage=staged(clock, {"path": "sample"}),
    )
    settings = generator.audio.post_processing
    rows, index = files.write_trajectories(
        made, request.kept, audio, formats, request.out, settings
    )
    (beatless,) = warn([None if song.beats.tempo else BEATLESS])
    for row in rows:
        row["warning"] = beatless
    clock.lap("write")
    selection = [(str(audio), made.table)] if request.num_samples > 1 else []
    return told_of_song(request, generator, song, rows, index, selection, clock)


def left_out(generator: "MotionGenerator", prompt: str | None) -> str | None:
    """A line if a dance makes nothing of some words of its sentence."""
    parts = [] if prompt is None else generator.sentences.clauses(prompt)
    unheard = [repr(part.unheard) for part in parts if part.unheard]
    return f"nothing is made of {', '.join(unheard)}" if unheard and len(parts) > 1 else None


def dance(request: Request, audio: Path) -> dict[str, Any]:
    """A body that dances to a song."""
    drawn = request.path
    if drawn is not None and request.follow_path:
        raise UsageError("--path does not go with --follow-path; leave one out")
    if not request.follow_path:
        refuse_with("a dance that follows no path (--follow-path)", style=request.style)
    elif not request.figures:
        raise UsageError(
            "--no-figures does not go with --follow-path, which has none; leave it out"
        )
    if not request.prompt:
        refuse_with("--body alone", tag=request.tag)
    elif request.body:
        raise UsageError("--body lets the music say what --prompt says; leave one out")
    said = checked_prompts(request.prompt) if request.prompt else []
    prompts: list[str | None] = [*said] or [None]
    tags = checked_tags(request.tag, len(said)) or [None] * len(prompts)
    formats, path = request.body_formats(), None
    if drawn is not None:
        from ..shared.pipelines.path import read_path

        path = read_path(drawn)
    generator, song, clock, style = listen(request, audio, bodies=True)
    if (seconds := min(song.seconds, request.seconds or song.seconds)) > LONG_SONG:
        tell(f"{seconds / 60:.0f} minutes of song: this takes a while, --seconds for less")
    lines = generator.text.scope_warnings(said) if said else [None]
    lines = [line or left_out(generator, each) for line, each in zip(lines, prompts, strict=True)]
    found = [
        generator.dance(
            song,
            prompt,
            tag=tag,
            seconds=request.seconds,
            figures=request.figures,
            follow_path=request.follow_path,
            path=path,
            style=style,
            num_samples=request.num_samples,
            sampling=request.sampling,
            foot_lock=request.foot_lock,
            stage=staged(clock),
        )
        for prompt, tag in zip(prompts, tags, strict=True)
    ]
    # what is danced in figures the text model need not know
    warnings = warn([None if each.ranked[0].figures else line
                     for each, line in zip(found, lines, strict=True)])  # fmt: skip
    rows, index = files.write_dances(found, request.kept, audio, song, formats, request.out)
    for place, row in enumerate(rows):
        of_dance = found[place // request.kept].warning, warnings[place // request.kept]
        row |= {"seed": request.seed, "warning": next(filter(None, of_dance), None)}
    clock.lap("write")
    several = found if request.num_samples > 1 else []
    selection = [(each.prompt or str(audio), each.table) for each in several]
    return told_of_song(request, generator, song, rows, index, selection, clock)


# ---------------------------------------------------------------- songs


def listen(
    request: Request, audio: Path, *, bodies: bool
) -> "tuple[MotionGenerator, Song, Stopwatch, Any]":
    """Models loaded, and the song analysed: generator, song, clock, and what `--style` says."""
    clock = Stopwatch()
    from ..shared.audio.song import analyse
    from ..shared.pipelines.song import styled

    generator = request.generator()
    clock.lap("import")
    style = styled(request.style)
    _ = generator.audio if request.pathed else None
    if bodies:
        _ = generator.text, generator.tower if request.num_samples > 1 else None
        _ = None if request.prompt else generator.prompter
    clock.lap("load")
    song = analyse(audio, meter=request.meter)
    clock.lap("listen")
    return generator, song, clock, style


def staged(clock: Stopwatch, names: dict[str, str] | None = None) -> Any:
    """A bar for each stage, and its time; under another name where `names` has one."""

    @contextmanager
    def stage(name: str) -> "Iterator[Progress]":
        with progress_bar(STAGES[name]) as progress:
            yield progress
        clock.lap((names or {}).get(name, name))

    return stage


def told_of_text(request: Request, generator: "MotionGenerator") -> dict[str, Any]:
    """What motions of a prompt were made with."""
    device = str(generator.text.device)
    return {"model": request.text_model, "device": device, "seed": request.seed}


def results(
    rows: list[dict[str, Any]],
    clock: Stopwatch,
    judged: "Iterable[tuple[str, ScoreTable]]" = (),
    index: str | None = None,
) -> dict[str, Any]:
    """The motions, how several were judged, the page that shows all, what took how long."""
    return {
        "motions": rows,
        "selection": [files.scored(about, table) for about, table in judged],
        "index": index,
        "timings": clock.seconds(),
    }


def told_of_song(
    request: Request,
    generator: "MotionGenerator",
    song: "Song",
    rows: list[dict[str, Any]],
    index: str | None,
    selection: list[tuple[str, Any]],
    clock: Stopwatch,
) -> dict[str, Any]:
    """What was heard, what it was made with, and the results."""
    memory = generator.audio.memory if request.pathed else None
    dancing = not request.path_alone
    remembered = None
    if memory is not None:
        counts = dict(memory.service.counts)
        unanswered = counts["timed_out"] + counts["failed"]
        remembered = {"folder": str(request.memory_folder), **counts, "null": unanswered}
    return {
        "audio": str(request.song),
        "tempo": round(song.beats.tempo, 2),
        "meter": song.beats.meter,
        "beats": len(song.beats.beat_times),
        "model": request.audio_model if request.pathed else None,
        **({"body-model": request.text_model} if dancing else {}),
        "runtime": (generator.audio if request.pathed else generator.text).runtime,
        **({"body-runtime": generator.text.runtime} if dancing else {}),
        "device": str(generator.text.device if dancing else generator.audio.device),
        "seed": request.seed,
        "memory": remembered,
        **results(rows, clock, selection, index),
    }


# ---------------------------------------------------------------- clips, paths, timelines


def read_timed(
    request: Request, texts: list[str], tags: list[str | None] | None
) -> "tuple[DrawnPath | None, Timeline]":
    """The files that were named, and the prompts one after another.

    Raises:
        UserError: a file cannot be read or says what cannot be.
    """
    from ..shared.pipelines.path import read_path
    from ..shared.pipelines.timeline import Timeline, read_timeline

    path = None if request.path is None else read_path(request.path)
    if path is not None and path.times is not None and request.seconds is not None:
        raise UsageError(
            f"--seconds does not go with {request.path}, which has times; leave it out"
        )
    if request.timeline is not None:
        return path, read_timeline(request.timeline)
    return path, Timeline.of(texts, request.seconds, tags)


def read_given(request: Request) -> "Given":
    """What is kept of the clips that were named.

    Raises:
        UserError: a clip cannot be read, or is shorter than what is asked of it.
    """
    from ..shared.data.retarget.read_motion import read_motion
    from ..shared.pipelines.edit import KEEP, chosen_joints, continue_clips, edit_clip

    names = options.parts(request.joints or "")
    if request.joints is not None and not names:
        raise UsageError("--joints is empty; name joints or groups, e.g. --joints left-arm,head")
    joints = chosen_joints(names) if names else None  # before a clip is read
    if request.edit is not None:
        clip = read_motion(request.edit)
        return edit_clip(clip, request.begin or 0.0, request.until, joints)
    start, end = (
        None if path is None else read_motion(path) for path in (request.start, request.end)
    )
    return continue_clips(
        start,
        end,
        keep=KEEP if request.keep is None else request.keep,
        seconds=request.seconds,
        rejoin=request.start == request.end,
    )


# ---------------------------------------------------------------- results


def print_files(result: dict[str, Any]) -> None:
    """One path a line on stdout; the times on stderr."""
    for row in result["motions"]:
        if row["files"]:  # a page of several is named below
            print(*row["files"].values(), sep="\n")
    if result["index"]:
        print(result["index"])
    times = result["timings"]
    parts = ", ".join(f"{name} {times[name]:.1f}" for name in times if name != "total")
    number = counted(len(result["motions"]), "motion")
    tell(f"{number} in {times['total']:.1f} s ({parts}) on {result['device']}")
