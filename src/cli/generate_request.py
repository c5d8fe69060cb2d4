"""What `generate` was asked, and which of its four kinds that is: each checks, makes and writes."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.environment import TEXT_MODEL, default_audio_model
from ..shared.errors import UsageError
from ..shared.io.storage import Place
from . import generate_files as files
from .console import Stopwatch, complain, flag_of, progress_bar, tell
from .directions import Directions, read_given, read_timed

if TYPE_CHECKING:
    from ..shared.audio.song import Song
    from ..shared.model.diffusion import Sampling
    from ..shared.model.generation.motion_generator import Progress
    from ..shared.pipelines.motion_generator import MotionGenerator
    from ..shared.pipelines.ranking import ScoreTable

STAGES = {"path": "frames of the path", "body": "frames of the body"}


@dataclass(frozen=True)
class Request:
    """The options of `generate`, their ranges checked; None = not given.

    Attributes:
        prompt, audio, directions: what decides the kind.
        body ... threads: as the options are called.
    """

    prompt: list[str]
    audio: Path | None
    directions: Directions
    body: bool
    figures: bool
    follow_path: bool
    style: str | None
    meter: int | None
    memory: Place | None
    tag: list[str] | None
    seconds: float | None
    num_samples: int
    return_all: bool
    judge: str | None
    seed: int
    steps: int | None
    sampler: str | None
    guidance_scale: float | None
    foot_lock: bool | None
    post_processing: list[str]
    format: str | None
    out: Path
    model: str | None
    body_model: str | None
    runtime: str | None
    device: str
    threads: int | None

    @property
    def sampling(self) -> "Sampling":
        """Seed, steps, sampler and guidance."""
        from ..shared.model.diffusion import Sampling

        return Sampling(
            seed=self.seed,
            steps=self.steps,
            sampler=self.sampler,
            guidance_scale=self.guidance_scale,
        )

    @property
    def kept(self) -> int:
        """Candidates that are written."""
        return self.num_samples if self.return_all else 1

    @property
    def text_model(self) -> str:
        """What makes bodies; an empty name is refused where it is loaded."""
        name = self.model if self.audio is None else self.body_model
        return TEXT_MODEL if name is None else name

    @property
    def audio_model(self) -> str:
        """What makes the paths of songs."""
        return default_audio_model() if self.model is None else self.model

    @property
    def path_alone(self) -> bool:
        """Whether a song is asked for, and no body."""
        return self.audio is not None and not (self.prompt or self.body)

    @property
    def pathed(self) -> bool:
        """Whether the audio model makes a path."""
        return self.path_alone or self.follow_path

    def generator(self) -> "MotionGenerator":
        """With these models; none is loaded yet."""
        from ..shared.device import set_threads
        from ..shared.pipelines.motion_generator import MotionGenerator

        set_threads(self.threads)
        return MotionGenerator(
            self.text_model,
            self.audio_model,
            device=self.device,
            runtime=self.runtime or "auto",
            memory=self.memory,
            judge=self.judge,
            post_processing=[] if self.path_alone else self.post_processing,
            path_post_processing=self.post_processing if self.path_alone else [],
        )

    def keep_light(self) -> None:
        """Leave PyTorch unimported where onnxruntime does all that is asked."""
        from ..shared.environment import compute_without_torch
        from ..shared.model.onnx_card import chosen_runtime

        alone = self.audio is None and self.num_samples == 1  # songs and judges are PyTorch's
        runtime = self.runtime or "auto"
        if alone and chosen_runtime(runtime, self.text_model, self.device) == "onnx":
            compute_without_torch()

    def body_formats(self) -> list[str]:
        """Formats of a body's files."""
        wanted = ",".join(files.FORMATS) if self.format is None else self.format
        from ..shared.formats.registry import EXPORTERS

        return files.checked_formats(wanted, EXPORTERS)


def produce(request: Request) -> dict[str, Any]:
    """Make and write the motions; which lie in which files, and what took how long.

    Raises:
        UsageError: options that do not go together.
        UserError: as the model, the song or the files.
    """
    check_runtime(request)
    request.keep_light()
    if request.audio is not None:
        from ..shared.audio.sound import check_sound

        replace(request.directions, path=None).refuse("--audio")
        check_sound(request.audio)
        made = song_path if request.path_alone else dance
        result = made(request, request.audio)
        if result["tempo"] == 0:
            tell(f"note: no beat was found in {result['audio']}; the motion keeps its own time")
        return result
    dancing = ("body", "body_model", "follow_path")
    for name in dancing:
        if getattr(request, name):
            raise UsageError(
                f"{flag_of(name)} is about a dance; name a song with --audio, or leave it out"
            )
    return controlled(request) if request.directions.given() else prompted(request)


# ---------------------------------------------------------------- the four kinds


def prompted(request: Request) -> dict[str, Any]:
    """A motion for each prompt."""
    refuse_music(request, "--prompt")
    prompts = checked_prompts(request.prompt)
    tags, formats = checked_tags(request.tag, len(prompts)), request.body_formats()
    clock = Stopwatch()
    generator = request.generator()
    clock.lap("import")
    several = request.num_samples > 1
    _ = generator.text, generator.tower if several else None
    clock.lap("load")
    warnings = warn(generator.sentences.scope_warnings(prompts))
    with progress_bar("motions") as progress:
        found = generator.candidates(
            prompts,
            request.num_samples,
            return_all=request.return_all,
            seconds=4.0 if request.seconds is None else request.seconds,
            tags=tags,
            sampling=request.sampling,
            foot_lock=request.foot_lock,
            progress=progress,
        )
    clock.lap("sample")
    kept = request.kept
    motions = [motion for result in found for motion in result.ranked()]
    rows = files.write_motions(motions, kept, formats, request.out)
    places = [int(place) for result in found for place in result.table.order[:kept]]
    for at, (row, place, motion) in enumerate(zip(rows, places, motions, strict=True)):
        warning = warnings[at // kept] or generator.sentences.missed(prompts[at // kept], motion)
        row |= {"sample": place, "rank": at % kept + 1}
        row |= {"seed": request.seed, "warning": warning}
    paged = "html" in formats and len(motions) > 1
    index = files.write_index(motions, request.out) if paged else None
    clock.lap("write")
    judged = zip(prompts, (result.table for result in found), strict=True) if several else ()
    return told_of_text(request, generator) | results(rows, clock, judged, index)


def controlled(request: Request) -> dict[str, Any]:
    """One motion after a path, a clip, a timeline or several texts."""
    directions = request.directions
    refuse_music(request, directions.given()[0])
    directions.check(len(request.prompt), num_samples=request.num_samples, seconds=request.seconds)
    texts = [*request.prompt, *(directions.then or ())]
    texts = checked_prompts(texts) if texts else []
    tags, formats = checked_tags(request.tag, len(texts)), request.body_formats()
    clock = Stopwatch()
    generator = request.generator()
    clock.lap("import")
    options: dict[str, Any] = {"sampling": request.sampling, "foot_lock": request.foot_lock}
    if directions.kind in ("path", "timeline"):
        path, timeline = read_timed(directions, texts, tags, request.seconds)
        texts = timeline.texts
        clock.lap("read")
        _ = generator.text
        clock.lap("load")
        plain = path is None and not directions.loop
        warnings = warn((generator.sentences if plain else generator.text).scope_warnings(texts))
        made = generator.timeline(
            timeline, path=path, seconds=request.seconds, loop=directions.loop, **options
        )
    else:
        given = read_given(directions, request.seconds)
        clock.lap("read")
        _ = generator.text
        clock.lap("load")
        warnings = warn(generator.text.scope_warnings(texts)) if texts else []
        text, tag = (each[0] if each else None for each in (texts, tags))
        made = generator.edit(given, text, tag=tag, **options)
    clock.lap("sample")
    rows = files.write_motions([made.motion], 1, formats, request.out)
    rows[0] |= {"seed": request.seed, "directions": directions.given(), "errors": made.errors}
    rows[0] |= {"warning": next(filter(None, warnings), None)}
    clock.lap("write")
    return told_of_text(request, generator) | results(rows, clock)


def song_path(request: Request, audio: Path) -> dict[str, Any]:
    """The path of a song alone."""
    no_body = {name: getattr(request, name) for name in ("tag", "foot_lock", "judge", "body_model")}
    refuse_with("--audio alone", **no_body, path=request.directions.path)
    if request.follow_path:
        raise UsageError('--follow-path is about a body: add --prompt "a person dances", or --body')
    files.check_path_formats(request.format or "")
    from ..shared.formats.registry import TRAJECTORY_EXPORTERS

    formats = files.checked_formats(request.format or "npz,glb,html", TRAJECTORY_EXPORTERS)
    generator, song, clock, style = listen(request, audio, bodies=False)
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
    clock.lap("write")
    selection = [(str(audio), made.table)] if request.num_samples > 1 else []
    return told_of_song(request, generator, song, rows, index, selection, clock)


def dance(request: Request, audio: Path) -> dict[str, Any]:
    """A body that dances to a song."""
    drawn = request.directions.path
    if drawn is not None and request.follow_path:
        raise UsageError("--path does not go with --follow-path; leave one out")
    if not request.follow_path:
        refuse_with("a dance that follows no path (--follow-path)", style=request.style)
        check_figures(request)
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
    warnings = warn(generator.text.scope_warnings(said)) if said else [None]
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
    rows, index = files.write_dances(found, request.kept, audio, song, formats, request.out)
    for place, row in enumerate(rows):
        row |= {"seed": request.seed, "warning": warnings[place // request.kept]}
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
        remembered = {"folder": str(request.memory), **counts, "null": unanswered}
    return {
        "audio": str(request.audio),
        "tempo": round(song.beats.tempo, 2),
        "meter": song.beats.meter,
        "beats": len(song.beats.beat_times),
        "model": request.audio_model if request.pathed else None,
        **({"body-model": request.text_model} if dancing else {}),
        "runtime": request.runtime or "torch",
        "device": str(generator.text.device if dancing else generator.audio.device),
        "seed": request.seed,
        "memory": remembered,
        **results(rows, clock, selection, index),
    }


def only_song(paths: list[Path] | None) -> Path | None:
    """The one song that was named, None without; refused before anything slow starts."""
    if not paths:
        return None
    if len(paths) > 1:
        raise UsageError(f"--audio is given {len(paths)} times; name one song")
    (path,) = paths
    if path.is_dir():
        raise UsageError(f"--audio {path} is a folder; name a wav, flac, ogg or mp3 file in it")
    if not path.is_file():
        raise UsageError(f"--audio {path}: no such file; name a wav, flac, ogg or mp3 file")
    return path


def check_runtime(request: Request) -> None:
    """Refuse an unknown runtime, a device or memory that it has not, and what is no memory."""
    from ..shared.model.onnx_card import RUNTIMES

    runtime, device, memory = request.runtime, request.device, request.memory
    if runtime not in (None, *RUNTIMES):
        raise UsageError(f"--runtime {runtime} is unknown; choose from {', '.join(RUNTIMES)}")
    if runtime == "onnx" and device not in ("auto", "cpu"):
        raise UsageError(f"--device {device}: --runtime onnx computes on the cpu; leave one out")
    if memory is not None and runtime == "onnx":
        raise UsageError("--runtime onnx hears no memory: an export leaves it out; use torch")
    if memory is not None and not memory.is_dir():
        raise UsageError(f"--memory {memory} is no folder; make one with `memory build`")


# ---------------------------------------------------------------- arguments


def check_figures(request: Request) -> None:
    """Refuse a memory that holds no figures to dance."""
    from ..shared.memory.figures import is_figure_memory

    if request.memory is not None and not is_figure_memory(request.memory):
        raise UsageError(
            f"--memory {request.memory} holds no figures; make some with `memory build --figures`,"
            " or give --follow-path for a memory of phrases"
        )


def checked_prompts(prompts: list[str] | None) -> list[str]:
    """The prompts without stray blanks; at least one, none empty."""
    cleaned = [" ".join(text.split()) for text in prompts or []]
    if not cleaned or not all(cleaned):
        raise UsageError('--prompt is missing or empty; give one, e.g. --prompt "a person waves"')
    return cleaned


def checked_tags(tags: list[str] | None, num_prompts: int) -> list[str | None] | None:
    """One tag a prompt, from one for all or one each."""
    if not tags:
        return None
    if len(tags) == 1:
        return list(tags * num_prompts)
    if len(tags) != num_prompts:
        raise UsageError(
            f"--tag is given {len(tags)} times for {num_prompts} prompts;"
            " give one for all or one a prompt"
        )
    return list(tags)


def refuse_music(request: Request, flag: str) -> None:
    """Refuse what only a song can use."""
    names = ("style", "meter", "memory")
    refuse_with(flag, **{name: getattr(request, name) for name in names})


def refuse_with(flag: str, **others: Any) -> None:
    """Refuse options that mean nothing beside this one."""
    for name, value in others.items():
        if value not in (None, []):
            raise UsageError(f"{flag_of(name)} does not go with {flag}; leave one out")


def warn(warnings: list[str | None]) -> list[str | None]:
    """Say those that there are."""
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    return warnings
