"""`generate`: prompts or a song in, motion files out."""

from pathlib import Path
from typing import Annotated, Any

import typer

from ..shared import environment
from ..shared.errors import UsageError
from ..shared.io.storage import place
from . import options
from .console import check_range, counted, print_json, tell
from .directions import Directions
from .generate_files import show_scores
from .generate_request import Request, only_song, produce


def generate(
    prompt: Annotated[
        list[str] | None, typer.Option(help="What the character does; repeat for several.")
    ] = None,
    audio: Annotated[
        list[Path] | None, typer.Option(help="A song instead: wav, flac, ogg or mp3.")
    ] = None,
    body: Annotated[
        bool,
        typer.Option(
            "--body", help="For a song: a whole body that dances as the music says; or --prompt."
        ),
    ] = False,
    figures: Annotated[
        bool,
        typer.Option(
            "--figures/--no-figures",
            help="For a dance: recorded figures where they show it; or the model dances alone.",
        ),
    ] = True,
    follow_path: Annotated[
        bool,
        typer.Option(
            "--follow-path", help="For a dance: the song makes a path, which the body follows."
        ),
    ] = False,
    style: Annotated[
        str | None, typer.Option(help='How to move to the song, e.g. "tired, elderly".')
    ] = None,
    meter: Annotated[
        int | None, typer.Option(help="Beats in a bar of the song; 3 or 4, as heard.")
    ] = None,
    memory: Annotated[
        str | None,
        typer.Option(
            help="For a song: folder or address of `memory build`: figures to dance, or phrases"
            " that a --model of train_memory hears."
        ),
    ] = None,
    then: Annotated[
        list[str] | None, typer.Option(help="What it does next, in the same motion; repeat.")
    ] = None,
    timeline: Annotated[
        Path | None,
        typer.Option(help="What it does when: YAML or JSON with text, start, end, parts."),
    ] = None,
    loop: Annotated[
        bool, typer.Option("--loop", help="The last frame leads into the first one.")
    ] = False,
    path: Annotated[
        Path | None, typer.Option(help="Where it goes: CSV, JSON or YAML with x, z, t, heading.")
    ] = None,
    start: Annotated[
        Path | None, typer.Option(help="A motion file whose first seconds it begins with.")
    ] = None,
    end: Annotated[
        Path | None, typer.Option(help="A motion file whose last seconds it ends with.")
    ] = None,
    keep: Annotated[
        float | None, typer.Option(help="Seconds of --start and --end that are kept; 1.")
    ] = None,
    edit: Annotated[
        Path | None, typer.Option(help="A motion file of which something is made anew.")
    ] = None,
    joints: Annotated[
        str | None,
        typer.Option(help="Of --edit, with commas between: left-arm, legs, upper-body, head, …"),
    ] = None,
    begin: Annotated[
        float | None, typer.Option("--from", help="Of --edit: seconds at which that begins.")
    ] = None,
    until: Annotated[
        float | None, typer.Option("--to", help="Of --edit: seconds at which that ends.")
    ] = None,
    tag: Annotated[
        list[str] | None,
        typer.Option(help="Action label beside the prompt: one for all, or one a prompt."),
    ] = None,
    seconds: Annotated[
        float | None, typer.Option(help="Length of each motion: 4 for a prompt, all of a song.")
    ] = None,
    num_samples: Annotated[
        int, typer.Option(help="Candidates for each prompt or song; the best one is written.")
    ] = 1,
    return_all: Annotated[
        bool, typer.Option("--return-all", help="Write all candidates, the best one first.")
    ] = False,
    judge: Annotated[
        str | None,
        typer.Option(
            help="Folder of train_clip, to hold candidates against the prompt; starter has its own."
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Same seed, same motions (on the CPU).")] = 0,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    foot_lock: Annotated[
        bool | None,
        typer.Option("--foot-lock/--no-foot-lock", help="Hold feet still while they stand."),
    ] = None,
    post_processing: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=VALUE",
            help="Of the body, or of the path of a song alone: apply-smoothing=true, …; repeat.",
        ),
    ] = None,
    format: Annotated[
        str | None,
        typer.Option(
            help="With commas between: bvh, glb, npz, html for a body;"
            " npz, csv, glb, html, png for the path of a song."
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(envvar=environment.OUTPUT_DIR, help="Folder for the files.")
    ] = Path("outputs"),
    model: Annotated[str | None, typer.Option(help=options.NAMED)] = None,
    body_model: Annotated[
        str | None, typer.Option(help="The same for the body that dances to a song; starter.")
    ] = None,
    runtime: Annotated[
        str | None,
        typer.Option(
            help="torch; onnx, for a model that ships or a folder of export-onnx; or auto."
        ),
    ] = None,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Turn prompts, or a song, into motion files.

    \b
    Examples:
      motion-tools generate --prompt "a person walks forward" --prompt "saluda con la mano"
      motion-tools generate --prompt "a person walks" --then "a person claps"
      motion-tools generate --edit clip.bvh --joints right-arm --prompt "a person waves"
      motion-tools generate --audio song.mp3
      motion-tools generate --audio song.mp3 --prompt "a proud old man dances"
    """
    directions = Directions(
        start=start, end=end, keep=keep, edit=edit, joints=joints, begin=begin, until=until,
        path=path, timeline=timeline, then=then, loop=loop,
    )  # fmt: skip
    long = audio or directions.given()  # what is made in several windows
    check_range("seconds", seconds, *((1.0, 7200.0) if long else (0.3, 60.0)))
    options.check_folder("--out", out)
    if judge is not None and num_samples == 1:
        raise UsageError("--judge compares candidates: give --num-samples 2 or more with it")
    result = produce(
        Request(
            prompt or [], only_song(audio), directions, body=body, figures=figures,
            follow_path=follow_path, style=style, meter=meter,
            memory=None if memory is None else place(memory), tag=tag, seconds=seconds,
            num_samples=num_samples, return_all=return_all, judge=judge, seed=seed, steps=steps,
            sampler=sampler, guidance_scale=guidance_scale, foot_lock=foot_lock,
            post_processing=post_processing or [], format=format, out=out,
            model=model, body_model=body_model, runtime=runtime, device=device, threads=threads,
        )
    )  # fmt: skip
    show_scores(result["selection"])
    if json:
        print_json(result)
    else:
        print_files(result)


# ---------------------------------------------------------------- results


def print_files(result: dict[str, Any]) -> None:
    """One path a line on stdout; the times on stderr."""
    for row in result["motions"]:
        print(*row["files"].values(), sep="\n")
    if result["index"]:
        print(result["index"])
    times = result["timings"]
    parts = ", ".join(f"{name} {times[name]:.1f}" for name in times if name != "total")
    number = counted(len(result["motions"]), "motion")
    tell(f"{number} in {times['total']:.1f} s ({parts}) on {result['device']}")
