"""`evaluate-memory`: does what the model remembers help it?"""

from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell
from .evaluate import print_and_keep

Number = TypeVar("Number", int, float)
LIMITS = {"num_phrases": (2, 10_000), "num_songs": (2, 10_000), "song_seconds": (4.0, 600.0)}


def evaluate_memory(
    model: Annotated[str, typer.Option(help="Folder of train_memory, or a shipped name.")],
    memory: Annotated[Path, typer.Option(help="Folder that `memory build` wrote.")],
    data: Annotated[
        str, typer.Option(help="Folder or bucket of pairs, held back from training in part.")
    ],
    splits: Annotated[str, typer.Option(help="Its held-back splits, with commas.")] = "test,val",
    space: Annotated[
        str, typer.Option(help="Where the memory's shared space is now, if it moved.")
    ] = "",
    num_phrases: Annotated[int, typer.Option(help="Held-back phrases, at most.")] = 120,
    num_songs: Annotated[int, typer.Option(help="Held-out synthetic songs.")] = 24,
    song_seconds: Annotated[float, typer.Option(help="Of each of them.")] = 12.0,
    shares: Annotated[
        str, typer.Option(help="Smaller memories: shares of the songs, with commas.")
    ] = "0.1,0.3",
    top_k: Annotated[str, typer.Option(help="Other numbers of hits, with commas.")] = "1,32",
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of songs, noise and what is hidden.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: options.ReportFile = None,
    json: options.Json = False,
) -> None:
    """Measure a model with its memory, without it, and with randomly retrieved memory.

    \b
    Example:
      motion-tools evaluate-memory --model runs/memory-audio --memory data/memory --data data/pairs
    """
    options.check_ranges(steps=steps, guidance_scale=guidance_scale, seed=seed, threads=threads)
    amount: dict[str, Any] = {
        "num_phrases": num_phrases,
        "num_songs": num_songs,
        "song_seconds": song_seconds,
    }
    options.check_limits(amount, LIMITS)
    options.check_pairs(data)
    found_shares = numbers("--shares", shares, float)
    if not all(0 < share <= 1 for share in found_shares):
        raise UsageError(f"--shares {shares}: each must lie between 0 and 1")
    top_ks = numbers("--top-k", top_k, int)
    if not all(k >= 1 for k in top_ks):
        raise UsageError(f"--top-k {top_k}: each must be 1 or more")
    if out is not None:
        options.check_folder("--out", out.parent)

    from ..shared.device import set_threads
    from ..shared.evaluation.report.tables import as_markdown, heading, tables
    from ..shared.evaluation.suites import memory as suite
    from ..shared.pipelines.runtime import load_trained
    from ..shared.pipelines.song_memory import open_memory, require_memory
    from .memory import load_settings

    set_threads(threads)
    loaded = load_trained(model, device)
    require_memory(loaded.config, model)
    index, found_space = open_memory(memory, space)
    report = suite.evaluate_memory(
        loaded,
        index,
        found_space,
        data=data,
        config=load_settings(folder=str(memory)),
        settings=suite.MemorySettings(
            splits=tuple(splits.split(",")),
            shares=found_shares,
            top_ks=top_ks,
            seed=seed,
            **amount,
        ),
        sampling={"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale},
        about={"model": model, "data": data, "threads": threads},
        progress=lambda text: tell(f"evaluate-memory: {text}"),
    )
    said = [
        f"{name}: against no memory {words['without']}, against a random one {words['random']}"
        for name, words in report["verdict"].items()
    ]
    text = as_markdown("Memory", [*heading(report), *said], tables(report))
    print_and_keep(report, text, out, json=json)


def numbers(flag: str, text: str, kind: type[Number]) -> tuple[Number, ...]:
    """Numbers with commas between them; none for an empty text.

    Raises:
        UsageError: one is no number.
    """
    try:
        return tuple(kind(part) for part in text.split(",") if part.strip())
    except ValueError as error:
        raise UsageError(f"{flag} {text}: give numbers with commas between them") from error
