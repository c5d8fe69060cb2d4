"""`generate --audio`: a song in, trajectory files out."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.errors import UsageError
from .evaluate_sanity import shipped_bands
from .generate_text import slug
from .guard import tell
from .progress import progress_bar
from .score_table import scored
from .stopwatch import Stopwatch
from .wording import note_replaced

if TYPE_CHECKING:
    import numpy as np
    from torch import Tensor

    from ..shared.audio.song import Song
    from ..shared.memory.build import Space
    from ..shared.memory.service import MPMService
    from ..shared.motion.trajectory import MotionTrajectory
    from ..shared.pipelines.runtime import Runtime
    from ..shared.pipelines.song import SongMotions
    from ..shared.pipelines.song_sampler import SongSampling

FORMATS = ("npz", "csv", "glb", "html", "png")
MODEL = "starter-audio"
STYLE_MODEL = "starter"  # the text model that reads `--style` when it is a sentence
RUNTIMES = ("torch", "onnx")


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


def check_runtime(runtime: str | None, device: str) -> None:
    """Refuse an unknown runtime, and a device that it has not."""
    if runtime not in (None, *RUNTIMES):
        raise UsageError(f"--runtime {runtime} is unknown; choose from {', '.join(RUNTIMES)}")
    if runtime == "onnx" and device not in ("auto", "cpu"):
        raise UsageError(f"--device {device}: --runtime onnx computes on the cpu; leave one out")


def check_memory(memory: Path | None, runtime: str | None) -> None:
    """Refuse what is no memory, and a runtime that hears none."""
    if memory is None:
        return
    if runtime == "onnx":
        raise UsageError("--runtime onnx hears no memory: an export leaves it out; use torch")
    if not memory.is_dir():
        raise UsageError(f"--memory {memory} is no folder; make one with `memory build`")


def produce_song(
    wanted: dict[str, Any],
    formats: list[str],
    out: Path,
    *,
    model: str,
    runtime: str,
    device: str,
    threads: int | None,
    return_all: bool = False,
) -> dict[str, Any]:
    """Load, listen, sample, choose, write; says which trajectory lies in which files and the times.

    Args:
        wanted: audio, meter, seconds, style, memory; under `sampling`, what `SongSampling` takes.
        formats: any of `FORMATS`.
        out: folder for the files.
        model: name or folder; for onnx, a folder of `export-onnx`.
        runtime: torch or onnx.
        device: auto, cpu, cuda or mps.
        threads: CPU threads; None = torch's choice.
        return_all: write all candidates by rank, not only the best.
    """
    clock = Stopwatch()
    from ..shared.audio.sound import check_sound

    check_sound(wanted["audio"])
    from ..shared.audio.song import analyse
    from ..shared.device import set_threads
    from ..shared.pipelines.ranking import AudioJudge
    from ..shared.pipelines.runtime import load_runtime
    from ..shared.pipelines.song import SongMotions, heard
    from ..shared.pipelines.song_sampler import SongSampling

    clock.lap("import")
    style = styled(wanted["style"])
    set_threads(threads)
    loaded = load_runtime(runtime, model, device)
    remembered = open_service(wanted["memory"], loaded)
    clock.lap("load")
    song = analyse(wanted["audio"], meter=wanted["meter"])
    condition, phase = heard(song, wanted["seconds"])
    clock.lap("listen")
    settings = SongSampling(**wanted["sampling"])
    made = sample_paths(loaded, song, condition, phase, settings, style, remembered)
    judge = AudioJudge(shipped_bands(model) if runtime == "torch" else None)
    table = judge.judge(made, song.beats.beat_times if song.beats.tempo > 0 else None)
    order = [int(place) for place in table.order[: None if return_all else 1]]
    clock.lap("sample")
    kept = SongMotions([made[place] for place in order], song)
    rows, index = write_trajectories(kept, wanted["audio"], formats, out)
    for rank, (row, place) in enumerate(zip(rows, order, strict=True), start=1):
        row |= {"sample": place, "rank": rank}
    clock.lap("write")
    about = told_of_song(wanted["audio"], song) | {
        "model": model,
        "runtime": runtime,
        "device": str(loaded.mean.device),
        "seed": settings.seed,
        "memory": remembered and told_of_memory(wanted["memory"], remembered[0]),
    }
    scores = [scored(str(wanted["audio"]), table)] if len(made) > 1 else []
    results = {"motions": rows, "selection": scores, "index": index}
    return about | results | {"timings": clock.seconds()}


def sample_paths(
    loaded: "Runtime",
    song: "Song",
    condition: "Tensor",
    phase: "np.ndarray | None",
    settings: "SongSampling",
    style: "np.ndarray | None",
    remembered: "tuple[MPMService, Space] | None",
) -> "list[MotionTrajectory]":
    """Candidates for a song as the decoder gave them, with a bar on the screen."""
    from ..shared.pipelines.song import of_song
    from ..shared.pipelines.song_memory import remembering
    from ..shared.pipelines.song_sampler import SongSampler

    with progress_bar("frames of the path") as progress:
        sampler = SongSampler(loaded, of_song(settings, song))
        recall = remembered and remembering(*remembered, sampler, condition, phase)
        return sampler.sample(condition, phase=phase, style=style, progress=progress, recall=recall)


def told_of_song(audio: Path, song: "Song") -> dict[str, Any]:
    """What was heard."""
    return {
        "audio": str(audio),
        "tempo": round(song.beats.tempo, 2),
        "meter": song.beats.meter,
        "beats": len(song.beats.beat_times),
    }


def open_service(folder: Path | None, loaded: "Runtime") -> "tuple[MPMService, Space] | None":
    """The memory in a folder and the space of its keys; None without a folder.

    Raises:
        UserError: one of them cannot be used, or the model hears no memory.
    """
    if folder is None:
        return None
    from ..shared.memory.service import MPMService
    from ..shared.pipelines.motion_sampler import require_memory
    from ..shared.pipelines.song_memory import open_memory
    from .memory import load_settings

    require_memory(loaded.config, "this model")
    index, space = open_memory(folder)
    return MPMService(load_settings(folder=str(folder)), index), space


def told_of_memory(folder: Path, service: "MPMService") -> dict[str, Any]:
    """How many windows the memory answered; `null`: those made as without one."""
    counts = dict(service.counts)
    return {"folder": str(folder), **counts, "null": counts["timed_out"] + counts["failed"]}


def styled(text: str | None) -> Any:
    """The style vector of `--style`, None without it.

    A list of style words is looked up; any other text is read as a prompt, through the map of
    styles that the text model of that name has learned (ruling 11).
    """
    if text is None:
        return None
    from ..shared.motion.style import named_style, only_style_words

    if only_style_words(text):
        return named_style(text)
    from ..shared.model.generation.motion_generator import TextToMotion

    found = TextToMotion.from_pretrained(STYLE_MODEL).style_of(text)
    return named_style(text) if found is None else found  # the former says what is known


def song_stem(audio: Path) -> str:
    """What the files of a song are called: its name, made safe as a prompt is."""
    return slug(audio.stem, 60)


def write_trajectories(
    made: "SongMotions", audio: Path, formats: list[str], out: Path
) -> tuple[list[dict[str, Any]], str | None]:
    """Post-process and write every trajectory: a row of facts and paths for each.

    Several share one page, so that the song is in it once; its path is the second value.
    """
    from ..shared.formats.trajectory_beats import SongTrack
    from ..shared.formats.trajectory_registry import (
        export_trajectory,
        write_trajectory_preview,
    )
    from ..shared.motion.trajectory import MotionTrajectory
    from ..shared.motion.trajectory_postprocess import MotionPostProcessor

    beats = made.song.beats
    track = SongTrack(audio, beats.beat_times, beats.downbeat_times, beats.meter)
    processor = MotionPostProcessor()
    finished = [MotionTrajectory(processor.process(raw.data), raw.fps) for raw in made.trajectories]
    first = song_stem(audio)
    stems = [first, *(f"{first}-{number + 1}" for number in range(1, len(finished)))]
    alone = [name for name in formats if name != "html" or len(finished) == 1]
    page = out / "index.html"
    files = [out / f"{stem}.{name}" for stem in stems for name in alone]
    note_replaced(files if alone == formats else [*files, page], out)
    rows = []
    for number, (trajectory, stem) in enumerate(zip(finished, stems, strict=True)):
        paths = export_trajectory(trajectory, out, stem, alone, track, title=stem)
        rows.append(
            {
                "frames": trajectory.num_frames,
                "fps": trajectory.fps,
                "clamped": processor.count_clamped(made.trajectories[number].data),
                "files": {name: str(path) for name, path in paths.items()},
            }
        )
    if alone == formats:
        return rows, None
    write_trajectory_preview(finished, page, track, stems)
    return rows, str(page)


def warn_of_beats(result: dict[str, Any]) -> None:
    """Say so when there was nothing to keep time with."""
    if result["tempo"] == 0:
        tell(f"note: no beat was found in {result['audio']}; the motion keeps its own time")
