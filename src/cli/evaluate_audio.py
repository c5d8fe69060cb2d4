"""`evaluate-audio`: `evaluate` for motion from music, with flags of its own."""

from pathlib import Path
from typing import Annotated

import typer

from . import options
from .evaluate import MODEL, Request, run, show_report


def evaluate_audio(
    model: options.AudioModel = MODEL,
    decoder_checkpoint: options.Decoder = None,
    data: options.Pairs = None,
    songs: options.Songs = None,
    out: options.OutputDir = Path("outputs/audio"),
    quick: options.Quick = False,
    replications: options.Replications = None,
    num_songs: options.NumSongs = None,
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
    seed: options.Seed = 0,
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
    given = {**locals(), "decoder": decoder_checkpoint}
    show_report(run(model, Request.of(given), out), json=json)
