"""`evaluate-audio`: does the motion keep the song's time, and are the seams seen?"""

from pathlib import Path
from typing import Annotated, Any

import typer

from src.cli import options
from src.cli.evaluate_sanity import (
    MODEL,
    Decoder,
    Model,
    OutputDir,
    Pairs,
    check_limits,
    check_pairs,
    load_model,
    show,
)
from src.cli.guard import complain
from src.shared.errors import UsageError

QUICK_SONGS, SONGS = 10, 50
LIMITS = {"num_songs": (2, 10_000), "song_seconds": (4.0, 600.0), "track_seconds": (4.0, 7200.0)}


def evaluate_audio(
    model: Model = MODEL,
    decoder_checkpoint: Decoder = None,
    data: Pairs = None,
    songs: Annotated[
        Path | None, typer.Option(help="Folder of sound files to describe as well.")
    ] = None,
    out: OutputDir = Path("outputs/audio"),
    quick: Annotated[bool, typer.Option("--quick", help="10 songs, for a first look.")] = False,
    num_songs: Annotated[int | None, typer.Option(help="Held-out synthetic songs; 50.")] = None,
    song_seconds: Annotated[float, typer.Option(help="Of each synthetic song.")] = 16.0,
    track_seconds: Annotated[float, typer.Option(help="Of each sound file, at most.")] = 30.0,
    tell_meter: Annotated[
        bool,
        typer.Option(
            "--tell-meter/--hear-meter", help="Tell the beat tracker each song's beats a bar."
        ),
    ] = True,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of songs, noise, offsets and resampling.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Hold motions against the music they were made for, on songs with tempi never trained on.

    Beside every figure: the beat tracker's own error, chance, another song, the same song half a
    beat later, and real paired motion.

    \b
    Example:
      motion-tools evaluate-audio --model starter-audio --data data/pairs --songs music
    """
    amount: dict[str, Any] = {
        "num_songs": num_songs or (QUICK_SONGS if quick else SONGS),
        "song_seconds": song_seconds,
        "track_seconds": track_seconds,
    }
    check_limits(amount, LIMITS)
    options.check_ranges(steps=steps, guidance_scale=guidance_scale, seed=seed, threads=threads)
    check_pairs(data)
    if songs is not None and not songs.is_dir():
        raise UsageError(f"--songs {songs} is no folder; name one with sound files")
    options.check_folder("--out", out)

    from src.shared.device import set_threads
    from src.shared.evaluation import audio_harness
    from src.shared.inference.song_generator import SongGenerator

    set_threads(threads)
    generator = SongGenerator(load_model(model, decoder_checkpoint, device), device=device)
    result = audio_harness.evaluate_audio(
        generator,
        data=data,
        songs=songs,
        settings=audio_harness.AudioSettings(seed=seed, tell_meter=tell_meter, **amount),
        sampling={"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale},
        about={"model": model, "decoder": decoder_checkpoint or model},
        progress=lambda text: complain(f"evaluate-audio: {text}"),
    )
    write_results(result, out)
    from src.shared.evaluation.audio_report import audio_tables

    show("Audio evaluation", result.report, list(audio_tables(result.report)), json=json)


def write_results(result: Any, folder: Path) -> None:
    """audio.json, audio.md, and phases against beats of the first songs and each sound file."""
    from src.shared.evaluation.audio_plots import plot_phase
    from src.shared.evaluation.audio_report import audio_tables
    from src.shared.evaluation.report import as_markdown, heading
    from src.shared.files import write_json, write_text

    report = result.report
    write_json(folder / "audio.json", report)
    text = as_markdown("Audio evaluation", heading(report), audio_tables(report))
    write_text(folder / "audio.md", text)
    for number, picture in enumerate(result.pictures, start=1):
        plot_phase(picture, folder / f"phase-{number:02d}.png")
