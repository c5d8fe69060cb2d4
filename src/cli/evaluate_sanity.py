"""`evaluate-sanity`: do motions for unheard sound hold together? (TECH §10.2)"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import options
from .console import tell
from .evaluate import MODEL, load_generator, save_and_show

if TYPE_CHECKING:
    from ..shared.evaluation.suites.sanity import SanityEvaluation

FULL = {"num_samples": 100, "num_frames": 120, "num_steps": 20}
QUICK = {"num_samples": 20, "num_frames": 120, "num_steps": 10}
LIMITS = {"num_samples": (1, 100_000), "num_frames": (8, 3000), "num_steps": (1, 10_000)}


def evaluate_sanity(
    quick: Annotated[bool, typer.Option("--quick", help="20 samples of 10 steps.")] = False,
    num_samples: Annotated[int | None, typer.Option(help="Motions; 100.")] = None,
    num_frames: Annotated[
        int | None, typer.Option(help="Frames of each, 30 a second; 120.")
    ] = None,
    num_steps: Annotated[int | None, typer.Option(help="Sampling steps; 20.")] = None,
    model: options.AudioModel = MODEL,
    decoder_checkpoint: options.Decoder = None,
    data: options.Pairs = None,
    output_dir: options.OutputDir = Path("outputs/sanity"),
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
    given = {"num_samples": num_samples, "num_frames": num_frames, "num_steps": num_steps}
    amount = {k: (QUICK if quick else FULL)[k] if v is None else v for k, v in given.items()}
    options.check_limits(amount, LIMITS)
    options.check_ranges(seed=seed, threads=threads)
    options.check_pairs(data)
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
    tables = list(sanity.sanity_tables(result.report))
    save_and_show(result.report, "sanity", "Sanity", tables, output_dir, json=json)
    draw_pictures(result, output_dir)


def draw_pictures(result: "SanityEvaluation", folder: Path) -> None:
    """bands.png, and the first motion as trajectory.png."""
    from ..shared.evaluation.report.plots import plot_trajectory
    from ..shared.evaluation.suites.sanity import plot_bands

    plot_bands(result.motions, result.bands, folder / "bands.png")
    first = result.motions["generated"][0]
    plot_trajectory(first, folder / "trajectory.png", title="generated, sample 1")
