"""`generate --audio --prompt`, and `--audio --body`: a song in, a dancing body out."""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.errors import UsageError
from . import generate_audio, generate_text
from .evaluate_sanity import shipped_bands
from .guard import complain
from .progress import progress_bar
from .score_table import scored
from .stopwatch import Stopwatch
from .wording import note_replaced

if TYPE_CHECKING:
    from ..shared.audio.song import Song
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.body import Performance
    from ..shared.pipelines.dance import Dances, SongPerformer
    from ..shared.pipelines.ranking import PerformanceJudge
    from ..shared.pipelines.runtime import Runtime
    from ..shared.pipelines.song import SongCondition

BODY_MODEL = "starter"
DANCE = "dance"  # ends the file names of a dance that no prompt asked for
SAMPLING = ("steps", "sampler", "guidance_scale")


def produce_dances(
    wanted: dict[str, Any],
    formats: list[str],
    out: Path,
    *,
    model: str,
    body_model: str,
    runtime: str,
    device: str,
    threads: int | None,
    return_all: bool = False,
    judge: str | None = None,
) -> dict[str, Any]:
    """Load, listen, sample paths and bodies, choose, write; says what lies where, and the times.

    Args:
        wanted: audio, meter, seconds, style, memory; prompts (none = what the music says), tags,
            foot_lock; under `sampling`, what `SongSampling` takes: the guidance is the body's.
        formats: any of `generate_text.ALL_FORMATS`.
        out: folder for the files.
        model: of the path: name or folder, for onnx a folder of `export-onnx`.
        body_model: name or folder.
        runtime: of the path: torch or onnx.
        device: auto, cpu, cuda or mps.
        threads: CPU threads; None = torch's choice.
        return_all: write all candidates by rank, not only the best.
        judge: folder of `train_clip`; None = the body model's own where one is shipped.
    """
    clock = Stopwatch()
    from ..shared.audio.sound import check_sound

    check_sound(wanted["audio"])
    from ..shared.audio.song import analyse
    from ..shared.device import set_threads
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.runtime import load_runtime
    from ..shared.pipelines.song import SongCondition

    clock.lap("import")
    style = generate_audio.styled(wanted["style"])
    set_threads(threads)
    loaded = load_runtime(runtime, model, device)
    remembered = generate_audio.open_service(wanted["memory"], loaded)
    generator = TextToMotion.from_pretrained(body_model, device=device)
    bands = shipped_bands(model) if runtime == "torch" else None
    number = wanted["sampling"]["num_samples"]
    judging = open_judge(generator, bands, judge) if number > 1 else None
    dancers = open_dancers(generator, wanted, judging)
    clock.lap("load")
    song = analyse(wanted["audio"], meter=wanted["meter"])
    heard = SongCondition.of(song, wanted["seconds"])
    clock.lap("listen")
    found, warnings = dance_prompts(
        dancers, loaded, song, heard, wanted, (style, remembered), clock
    )
    kept = number if return_all else 1
    rows, index = write_dances(found, kept, wanted["audio"], song, formats, out)
    seed = wanted["sampling"]["seed"]
    for place, row in enumerate(rows):
        row |= {"seed": seed, "warning": warnings[place // kept]}
    clock.lap("write")
    about = generate_audio.told_of_song(wanted["audio"], song) | {
        "model": model,
        "body-model": body_model,
        "runtime": runtime,
        "device": str(generator.device),
        "seed": seed,
        "memory": remembered and generate_audio.told_of_memory(wanted["memory"], remembered[0]),
    }
    judged = found if number > 1 else []
    scores = [scored(each.prompt or str(wanted["audio"]), each.table) for each in judged]
    results = {"motions": rows, "selection": scores, "index": index}
    return about | results | {"timings": clock.seconds()}


def dance_prompts(
    dancers: "SongPerformer",
    loaded: "Runtime",
    song: "Song",
    heard: "SongCondition",
    wanted: dict[str, Any],
    path: tuple[Any, Any],
    clock: Stopwatch,
) -> "tuple[list[Dances], list[str | None]]":
    """Paths and bodies for each prompt, or for none; and the warning of each.

    Args:
        dancers: who dances.
        loaded: the audio branch.
        song, heard: whole, and as long as asked for.
        wanted: see `produce_dances`.
        path: the style of `--style`, and the memory; None where there is none.
        clock: told of `path` and `body`.
    """
    from ..shared.pipelines.song_sampler import SongSampling

    generator, (style, remembered) = dancers.performer.generator, path
    settings = SongSampling(**wanted["sampling"] | {"guidance_scale": None})
    prompts: list[str | None] = wanted["prompts"] or [None]
    warnings: list[str | None] = [None]
    if wanted["prompts"]:
        warnings = generator.scope_warnings(wanted["prompts"])
    for warning in filter(None, warnings):
        complain(f"warning: {warning}")
    found: list[Dances] = []
    for prompt, tag in zip(prompts, wanted["tags"] or [None] * len(prompts), strict=True):
        own = generator.style_of(prompt) if style is None and prompt else style
        raw = generate_audio.sample_paths(
            loaded, song, heard.condition, heard.phase, settings, own, remembered
        )
        clock.lap("path")
        with progress_bar("frames of the body") as progress:
            dances = dancers.dance(
                raw, heard, prompt, tag=tag, seed=settings.seed, progress=progress
            )
        found.append(dances)
        clock.lap("body")
    return found, warnings


def open_dancers(
    generator: "TextToMotion", wanted: dict[str, Any], judge: "PerformanceJudge | None"
) -> "SongPerformer":
    """Who dances: with the prompts that were given, or with what the music says."""
    from ..shared.pipelines.body import Performer, PerformerSettings
    from ..shared.pipelines.dance import DancePrompter, SongPerformer

    own = {name: wanted["sampling"][name] for name in SAMPLING}
    performer = Performer(generator, PerformerSettings(**own, foot_lock=wanted["foot_lock"]))
    prompter = None if wanted["prompts"] else DancePrompter.beside(generator)
    return SongPerformer(performer, prompter=prompter, judge=judge)


def open_judge(generator: "TextToMotion", bands: Any, judge: str | None) -> "PerformanceJudge":
    """A judge of several candidates, with the motion tower that belongs to the generator."""
    from ..shared.pipelines.ranking import PerformanceJudge, load_tower, own_tower

    text = generator.text
    return PerformanceJudge(bands, own_tower(text) if judge is None else load_tower(judge, text))


# ---------------------------------------------------------------- files


def check_path_formats(text: str) -> None:
    """Refuse formats that only a body has where only a path is made.

    Raises:
        UsageError: naming them.
    """
    names = {part.strip().lower() for part in text.split(",")}
    bodies = sorted(names & (set(generate_text.ALL_FORMATS) - set(generate_audio.FORMATS)))
    if bodies:
        raise UsageError(
            f"--format {text!r}: {' and '.join(bodies)} would hold a body, and --audio alone makes"
            ' its path; add --prompt "a person dances", or --body to let the music choose'
        )


def stems(audio: Path, prompts: Sequence[str | None], kept: int) -> list[str]:
    """`song-a-person-dances`, `song-a-person-dances-2`, …; `song-dance` without a prompt."""
    names: list[str] = []
    for prompt in prompts:
        said = DANCE if prompt is None else generate_text.slug(prompt)
        base = f"{generate_audio.song_stem(audio)}-{said}"
        for _ in range(kept):
            name, number = base, 2
            while name in names:
                name, number = f"{base}-{number}", number + 1
            names.append(name)
    return names


def write_dances(
    found: "Sequence[Dances]", kept: int, audio: Path, song: "Song", formats: list[str], out: Path
) -> tuple[list[dict[str, Any]], str | None]:
    """Write every dance that is kept: a row of facts and paths for each.

    Several share one page, so that the song is in it once; its path is the second value.
    """
    from ..shared.formats.performance_files import export_dance, write_dance_page
    from ..shared.formats.registry import ending
    from ..shared.formats.trajectory_beats import SongTrack

    beats = song.beats
    track = SongTrack(audio, beats.beat_times, beats.downbeat_times, beats.meter)
    dances = [dance for each in found for dance in each.ranked[:kept]]
    names = stems(audio, [each.prompt for each in found], kept)
    shared = "html" in formats and len(dances) > 1
    alone = [name for name in formats if not (shared and name == "html")]
    page = out / "index.html"
    files = [out / f"{stem}.{ending(name)}" for stem in names for name in alone]
    note_replaced([*files, page] if shared else files, out)
    places = [int(place) for each in found for place in each.table.order[:kept]]
    rows = []
    for at, (dance, stem, place) in enumerate(zip(dances, names, places, strict=True)):
        paths = export_dance(dance.motion, dance.trajectory, out, stem, alone, track)
        rows.append(
            told_of_dance(dance, beats.beat_times if beats.tempo > 0 else None)
            | {"files": {name: str(path) for name, path in paths.items()}}
            | {"sample": place, "rank": at % kept + 1}
        )
    if not shared:
        return rows, None
    write_dance_page([d.motion for d in dances], [d.trajectory for d in dances], page, track)
    return rows, str(page)


def told_of_dance(dance: "Performance", beats: Any) -> dict[str, Any]:
    """What was asked for, how exactly the body stands on its path, how it keeps the beat."""
    from ..shared.pipelines.ranking import beat_report

    motion = dance.motion
    return {
        "prompt": motion.text,
        "passages": [{"text": p.text, "seconds": p.frames / motion.fps} for p in dance.passages],
        "frames": motion.num_frames,
        "fps": motion.fps,
        "root-error": {name.replace("_", "-"): v for name, v in asdict(dance.error).items()},
        "beat-alignment": None if beats is None else beat_report(motion, beats),
    }
