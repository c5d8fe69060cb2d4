"""What `generate` was asked, and which of its four kinds that is: each checks it and produces."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..shared.errors import UsageError
from . import generate_audio, generate_edit, generate_performance, generate_text
from .directions import Directions


@dataclass(frozen=True)
class Request:
    """The options of `generate`, their ranges checked; None = not given.

    Attributes:
        prompt, audio, directions: what decides the kind.
        sampling: num_samples, seed, steps, sampler, guidance_scale.
        body ... threads: as the options are called.
    """

    prompt: list[str]
    audio: Path | None
    directions: Directions
    sampling: dict[str, Any]
    body: bool
    style: str | None
    meter: int | None
    memory: Path | None
    tag: list[str] | None
    seconds: float | None
    return_all: bool
    judge: str | None
    foot_lock: bool | None
    format: str | None
    out: Path
    model: str | None
    body_model: str | None
    runtime: str | None
    device: str
    threads: int | None

    @property
    def where(self) -> dict[str, Any]:
        """What it is computed on."""
        return {"device": self.device, "threads": self.threads}

    @property
    def song(self) -> dict[str, Any]:
        """What is asked of a song's path."""
        names = ("audio", "meter", "seconds", "style", "memory", "sampling")
        return {name: getattr(self, name) for name in names}

    def body_formats(self) -> list[str]:
        """Formats of a body's files."""
        return checked_formats(
            self.format or ",".join(generate_text.FORMATS), generate_text.ALL_FORMATS
        )


def produce(request: Request) -> dict[str, Any]:
    """Make and write the motions; which lie in which files, and what took how long.

    Raises:
        UsageError: options that do not go together.
        UserError: as the model, the song or the files.
    """
    if request.audio is not None:
        request.directions.refuse("--audio")
        made = dance if request.prompt or request.body else song_path
        result = made(request)
        generate_audio.warn_of_beats(result)
        return result
    for flag, value in (("--body", request.body), ("--body-model", request.body_model)):
        if value:
            raise UsageError(f"{flag} is about a dance; name a song with --audio, or leave it out")
    return directed(request) if request.directions.given() else prompted(request)


def dance(request: Request) -> dict[str, Any]:
    """A body that dances to a song."""
    generate_audio.check_runtime(request.runtime, request.device)
    generate_audio.check_memory(request.memory, request.runtime)
    if not request.prompt:
        refuse_with("--body alone", tag=request.tag)
    elif request.body:
        raise UsageError("--body lets the music say what --prompt says; leave one out")
    wanted = request.song | {
        "foot_lock": request.foot_lock,
        "prompts": checked_prompts(request.prompt) if request.prompt else [],
        "tags": checked_tags(request.tag, len(request.prompt)),
    }
    return generate_performance.produce_dances(
        wanted,
        request.body_formats(),
        request.out,
        model=given(request.model, generate_audio.MODEL),
        body_model=given(request.body_model, generate_performance.BODY_MODEL),
        runtime=given(request.runtime, "torch"),
        return_all=request.return_all,
        judge=request.judge,
        **request.where,
    )


def song_path(request: Request) -> dict[str, Any]:
    """The path of a song alone."""
    no_body = {name: getattr(request, name) for name in ("tag", "foot_lock", "judge", "body_model")}
    refuse_with("--audio alone", **no_body)
    generate_performance.check_path_formats(request.format or "")
    generate_audio.check_runtime(request.runtime, request.device)
    generate_audio.check_memory(request.memory, request.runtime)
    return generate_audio.produce_song(
        request.song,
        checked_formats(request.format or "npz,glb,html", generate_audio.FORMATS),
        request.out,
        model=given(request.model, generate_audio.MODEL),
        runtime=given(request.runtime, "torch"),
        return_all=request.return_all,
        **request.where,
    )


def directed(request: Request) -> dict[str, Any]:
    """One motion after a path, a clip, a timeline or several texts."""
    directions = request.directions
    refuse_music(request, directions.given()[0])
    directions.check(
        len(request.prompt),
        num_samples=request.sampling["num_samples"],
        seconds=request.seconds,
    )
    texts = [*request.prompt, *(directions.then or ())]
    wanted = {
        "prompts": checked_prompts(texts) if texts else [],
        "tags": checked_tags(request.tag, len(texts)),
        "seconds": request.seconds,
        "foot_lock": request.foot_lock,
        "sampling": {name: request.sampling[name] for name in generate_edit.SAMPLING},
    }
    return generate_edit.produce_directed(
        directions,
        wanted,
        request.body_formats(),
        request.out,
        model=given(request.model, generate_text.MODEL),
        **request.where,
    )


def prompted(request: Request) -> dict[str, Any]:
    """A motion for each prompt."""
    refuse_music(request, "--prompt")
    wanted = request.sampling | {
        "prompts": checked_prompts(request.prompt),
        "tags": checked_tags(request.tag, len(request.prompt)),
        "seconds": 4.0 if request.seconds is None else request.seconds,
        "foot_lock": request.foot_lock,
    }
    return generate_text.produce(
        wanted,
        request.body_formats(),
        request.out,
        model=given(request.model, generate_text.MODEL),
        return_all=request.return_all,
        judge=request.judge,
        **request.where,
    )


def given(value: str | None, default: str) -> str:
    """The value; the default only where there is none: an empty one is refused further on."""
    return default if value is None else value


def refuse_music(request: Request, flag: str) -> None:
    """Refuse what only a song can use."""
    names = ("style", "meter", "memory", "runtime")
    refuse_with(flag, **{name: getattr(request, name) for name in names})


# ---------------------------------------------------------------- arguments


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


def refuse_with(flag: str, **others: Any) -> None:
    """Refuse options that mean nothing beside this one."""
    for name, value in others.items():
        if value not in (None, []):
            raise UsageError(f"--{name.replace('_', '-')} does not go with {flag}; leave one out")


def checked_formats(text: str, known: Sequence[str]) -> list[str]:
    """The wanted formats, each once, before anything slow starts."""
    names = list(dict.fromkeys(part.strip().lower() for part in text.split(",") if part.strip()))
    unknown = [name for name in names if name not in known]
    if unknown or not names:
        raise UsageError(
            f"--format {text!r}: {', '.join(map(repr, unknown)) or 'nothing'} is not a format"
            f" written here; choose from {', '.join(known)}"
        )
    return names
