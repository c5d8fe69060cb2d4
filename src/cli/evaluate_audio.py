"""`evaluate-audio`: `evaluate` for motion from music, with flags of its own."""

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .evaluate import NumSongs, Quick, Replications, Request, Seed, Songs, run, show
from .evaluate_sanity import MODEL, Decoder, Model, OutputDir, Pairs


def evaluate_audio(
    model: Model = MODEL,
    decoder_checkpoint: Decoder = None,
    data: Pairs = None,
    songs: Songs = None,
    out: OutputDir = Path("outputs/audio"),
    quick: Quick = False,
    replications: Replications = None,
    num_songs: NumSongs = None,
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
    seed: Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Hold motions against the music they were made for, on songs with tempi never trained on.

    Beside every figure: the beat tracker's own error, chance, another song, the same song half a
    beat later, an untrained network, and real paired motion.

    \b
    Example:
      motion-tools evaluate-audio --model starter-audio --data data/pairs --songs music
    """
    request = Request(
        quick=quick,
        data=data,
        decoder=decoder_checkpoint,
        replications=replications,
        songs=songs,
        num_songs=num_songs,
        song_seconds=song_seconds,
        track_seconds=track_seconds,
        tell_meter=tell_meter,
        steps=steps,
        sampler=sampler,
        guidance_scale=guidance_scale,
        seed=seed,
        device=device,
        threads=threads,
    )
    show(run(model, request, out), json=json)
