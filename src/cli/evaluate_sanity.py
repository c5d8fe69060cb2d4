"""`evaluate-sanity`: do motions for unheard sound hold together? (TECH §10.2)"""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared import environment
from ..shared.errors import UsageError
from . import options
from .console import tell

if TYPE_CHECKING:
    from ..shared.evaluation.suites.sanity import SanityEvaluation
    from ..shared.model.audio.audio_motion_model import AudioMotionModel
    from ..shared.pipelines.song import SongGenerator

MODEL = "starter-audio"
FULL = {"num_samples": 100, "num_frames": 120, "num_steps": 20}
QUICK = {"num_samples": 20, "num_frames": 120, "num_steps": 10}
LIMITS = {"num_samples": (1, 100_000), "num_frames": (8, 3000), "num_steps": (1, 10_000)}
Model = Annotated[
    str,
    typer.Option(
        "--model",
        "--diffusion-checkpoint",
        envvar=environment.DIFFUSION_CHECKPOINT,
        help="A name that `models` lists, or a folder from training; it holds UNet and decoder.",
    ),
]
OutputDir = Annotated[
    Path,
    typer.Option(envvar=environment.OUTPUT_DIR, help="Folder for report, table and plots."),
]
Pairs = Annotated[
    str | None,
    typer.Option(
        envvar=environment.DATA_DIR,
        help="Pairs from `prepare-audio`, a folder or bucket: its test split is used.",
    ),
]
Decoder = Annotated[
    str | None,
    typer.Option(
        envvar=environment.DECODER_CHECKPOINT,
        help="Another model folder, to take the decoder from.",
    ),
]


def evaluate_sanity(
    quick: Annotated[bool, typer.Option("--quick", help="20 samples of 10 steps.")] = False,
    num_samples: Annotated[int | None, typer.Option(help="Motions; 100.")] = None,
    num_frames: Annotated[
        int | None, typer.Option(help="Frames of each, 30 a second; 120.")
    ] = None,
    num_steps: Annotated[int | None, typer.Option(help="Sampling steps; 20.")] = None,
    model: Model = MODEL,
    decoder_checkpoint: Decoder = None,
    data: Pairs = None,
    output_dir: OutputDir = Path("outputs/sanity"),
    seed: Annotated[int, typer.Option(help="Of songs, phrases and noise.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Check motions made for sound that training never saw: seven checks, and the real bands.

    They are sampled as `generate` samples them. Real motion, a frozen one and an untrained model
    stand beside them; the last two must fail. Without --data the sound is synthetic songs with
    tempi that no training song has, and real motion is missing.

    \b
    Example:
      motion-tools evaluate-sanity --quick --model starter-audio --data data/pairs
    """
    amount = (QUICK if quick else FULL) | {
        name: value
        for name, value in (
            ("num_samples", num_samples),
            ("num_frames", num_frames),
            ("num_steps", num_steps),
        )
        if value is not None
    }
    check_limits(amount, LIMITS)
    options.check_ranges(seed=seed, threads=threads)
    check_pairs(data)
    options.check_folder("--output-dir", output_dir)

    from ..shared.device import set_threads
    from ..shared.evaluation.suites import sanity

    set_threads(threads)
    result = sanity.evaluate_sanity(
        load_generator(model, decoder_checkpoint, device),
        data=data,
        settings=sanity.SanitySettings(seed=seed, **amount),
        about={"model": model, "decoder": decoder_checkpoint or model},
        progress=lambda text: tell(f"evaluate-sanity: {text}"),
    )
    write_results(result, output_dir)
    show("Sanity", result.report, list(sanity.sanity_tables(result.report)), json=json)


# ---------------------------------------------------------------- arguments


def check_limits(values: Mapping[str, float], limits: Mapping[str, tuple[float, float]]) -> None:
    """Refuse numbers out of range, naming the flag."""
    for name, value in values.items():
        low, high = limits[name]
        if not low <= value <= high:
            flag = "--" + name.replace("_", "-")
            raise UsageError(f"{flag} {value:g} is out of range; choose from {low:g} to {high:g}")


def check_pairs(data: str | None) -> None:
    """Refuse a local folder that is not there; a bucket is asked when it is opened."""
    if data is not None and "://" not in data and not Path(data).is_dir():
        raise UsageError(f"--data {data} is no folder; name one that `prepare-audio` wrote")


# ---------------------------------------------------------------- model and results


def load_generator(
    name: str, decoder: str | None, device: str
) -> "SongGenerator[AudioMotionModel]":
    """A trained audio branch on a device, with another folder's decoder if one is named."""
    from ..shared.pipelines.song import SongGenerator

    generator = SongGenerator.from_pretrained(name, device=device)
    if decoder is not None:
        from ..shared.model.audio.audio_motion_model import load_decoder

        generator.model.decoder = load_decoder(decoder).to(generator.device).eval()
    return generator


def write_results(result: "SanityEvaluation", folder: Path) -> None:
    """sanity.json, sanity.md, bands.png and the first motion as trajectory.png."""
    from ..shared.evaluation.report.plots import plot_trajectory
    from ..shared.evaluation.report.tables import as_markdown, heading
    from ..shared.evaluation.suites.sanity import plot_bands, sanity_tables
    from ..shared.io.files import write_json, write_text

    report = result.report
    write_json(folder / "sanity.json", report)
    tables = sanity_tables(report)
    write_text(folder / "sanity.md", as_markdown("Sanity", heading(report), tables))
    plot_bands(result.motions, result.bands, folder / "bands.png")
    first = result.motions["generated"][0]
    plot_trajectory(first, folder / "trajectory.png", title="generated, sample 1")


def show(title: str, report: dict[str, Any], tables: list[Any], *, json: bool) -> None:
    """JSON, or tables: drawn in a terminal, Markdown in a pipe."""
    import sys

    from ..shared.evaluation.report.tables import as_markdown, draw, heading

    if json:
        from .evaluate import print_json

        print_json(report)
    elif sys.stdout.isatty():
        from rich.console import Console

        draw(heading(report), tables, Console(markup=False))
    else:
        print(as_markdown(title, heading(report), tables))
