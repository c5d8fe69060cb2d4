"""`evaluate-space`: do sounds, motions and texts find one another, beyond chance and tempo?"""

from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell
from .evaluate import save_and_show

MODEL, TEXT, NO_TEXT = "starter-space", "starter", "none"
SPLITS = ("test", "val")
RUNS, QUICK_RUNS = 20, 3
LIMITS = {"bars": (1, 16), "batch": (2, 1000), "replications": (1, 1000)}


def evaluate_space(
    data: Annotated[str, typer.Option(help="Pairs from `prepare-audio`, a folder or bucket.")],
    model: Annotated[
        str, typer.Option(help="A name that `models` lists, or a folder from train_audio_tower.")
    ] = MODEL,
    text: Annotated[
        str, typer.Option(help="Text generator of the same CLIP model; none leaves texts out.")
    ] = TEXT,
    split: Annotated[str, typer.Option(help="test, or val.")] = "test",
    bars: Annotated[int, typer.Option(help="Bars of a window.")] = 2,
    batch: Annotated[int, typer.Option(help="Windows to choose from.")] = 32,
    replications: Annotated[int | None, typer.Option(help="Drawings of batches; 20.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="3 drawings, for a first look.")] = False,
    out: Annotated[Path, typer.Option(help="Folder for space.json and space.md.")] = Path(
        "outputs/space"
    ),
    seed: Annotated[int, typer.Option(help="Of batches, windows and resampling.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Retrieval between sound, motion and text on songs and clips that no training saw.

    Beside every figure: what the tempo alone gives, an untrained tower, and chance.

    \b
    Example:
      motion-tools evaluate-space --model starter-space --data data/pairs
    """
    runs = replications or (QUICK_RUNS if quick else RUNS)
    options.check_limits({"bars": bars, "batch": batch, "replications": runs}, LIMITS)
    options.check_ranges(seed=seed, threads=threads)
    if split not in SPLITS:
        raise UsageError(f"--split {split} is unknown; choose from {', '.join(SPLITS)}")
    options.check_pairs(data)
    options.check_folder("--out", out)

    from ..shared.device import set_threads
    from ..shared.evaluation.report.tables import tables
    from ..shared.evaluation.suites.space import SpaceSettings, Texts, evaluate_space
    from ..shared.model.audio.shared_space import SharedSpace
    from ..shared.model.generation.motion_generator import TextToMotion

    set_threads(threads)
    space = SharedSpace.from_pretrained(model)
    texts = None
    if text != NO_TEXT:
        generator = TextToMotion.from_pretrained(text, device="cpu")
        texts = Texts(generator.text, generator.tokenizer)
    report = evaluate_space(
        space,
        data,
        split=split,
        texts=texts,
        settings=SpaceSettings(bars=bars, batch=batch, replications=runs, seed=seed),
        about={"model": model, "data": data, "text": text},
        progress=lambda what: tell(f"evaluate-space: {what}"),
    )
    title = f"Shared space of {model}"
    save_and_show(report, "space", title, list(tables(report)), out, json=json)
