"""`features`: what the network hears in a song."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.errors import UsageError
from . import options
from .console import print_json

if TYPE_CHECKING:
    from ..shared.audio.song import Song

CHROMA = ("fast", "cqt")


def features(
    song: Annotated[Path, typer.Argument(help="A wav, flac, ogg or mp3 file.")],
    out: Annotated[Path, typer.Option(help="File for the arrays (.npz).")],
    plot: Annotated[Path | None, typer.Option(help="A picture as well (.png).")] = None,
    chroma: Annotated[str, typer.Option(help="fast; or cqt: librosa's own, many times slower.")] = (
        "fast"
    ),
    meter: Annotated[int | None, typer.Option(help="Beats a bar; else 3 or 4 by ear.")] = None,
    cache: Annotated[
        bool, typer.Option("--cache/--no-cache", help="Remember songs by their content.")
    ] = True,
    cache_dir: Annotated[Path | None, typer.Option(help="Remember them in this folder.")] = None,
    json: options.Json = False,
) -> None:
    """Extract 163 features, beats and bar phase of a song, 30 frames a second.

    \b
    Examples:
      motion-tools features song.mp3 --out song.npz --plot song.png
      motion-tools features waltz.ogg --meter 3 --out waltz.npz
    """
    if chroma not in CHROMA:
        raise UsageError(f"--chroma {chroma} is unknown; choose from {', '.join(CHROMA)}")
    check_suffix("--out", out, ".npz")
    if plot is not None:
        check_suffix("--plot", plot, ".png")
    if cache_dir is not None:
        options.check_folder("--cache-dir", cache_dir)

    from ..shared.audio.song import analyse

    keep = cache_dir if cache and cache_dir else cache
    analysed = analyse(song, meter=meter, chroma=chroma, cache=keep)  # type: ignore[arg-type]
    analysed.save(out)
    if plot is not None:
        from ..shared.formats.preview.charts import plot_features

        plot_features(analysed.arrays(), plot, title=describe(song, analysed))
    if json:
        print_json(facts(song, out, plot, analysed))
    else:
        print(describe(song, analysed))
        for path in filter(None, (out, plot)):
            print(path)


def check_suffix(flag: str, path: Path, suffix: str) -> None:
    """Refuse an output that is a folder, has another suffix or cannot be written.

    Raises:
        UsageError: naming the flag.
    """
    if path.suffix.lower() != suffix or path.is_dir():
        raise UsageError(f"{flag} {path} is no {suffix} file; name one")
    options.check_file(flag, path)


def describe(path: Path, song: "Song") -> str:
    """One line about a song."""
    beats = song.beats
    rhythm = f"{beats.tempo:.1f} BPM, {len(beats.beat_times)} beats in bars of {beats.meter}"
    if not beats.tempo:
        rhythm = "no beat"
    return f"{path.name}: {song.seconds:.2f} s, {song.num_frames} frames, {rhythm}"


def facts(path: Path, out: Path, plot: Path | None, song: "Song") -> dict[str, Any]:
    """The result for programs."""
    beats = song.beats
    return {
        "song": str(path),
        "sha256": song.sha256,
        "seconds": song.seconds,
        "frames": song.num_frames,
        "tempo": beats.tempo,
        "meter": beats.meter,
        "beats": len(beats.beat_times),
        "downbeats": len(beats.downbeat_times),
        "confidence": beats.confidence,
        "notes": list(song.notes),
        "out": str(out),
        "plot": str(plot) if plot else None,
    }
