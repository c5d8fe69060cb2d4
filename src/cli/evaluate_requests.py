"""`evaluate-requests`: does a model do what people ask for in their own words?"""

from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError
from . import options
from .console import tell
from .evaluate import save_and_show

LIMITS = {"wordings": (1, 100), "seconds": (1, 20)}


def evaluate_requests(
    data: Annotated[Path, typer.Option(help="Folder written by `prepare`, with captured clips.")],
    model: options.Model = "starter",
    wordings: Annotated[int, typer.Option(help="Sentences of each action, side and language.")] = 3,
    languages: Annotated[str, typer.Option(help="Codes, with commas.")] = "en,es,fr,de,ja,zh",
    seconds: Annotated[float, typer.Option(help="Length of each motion.")] = 4.0,
    out: Annotated[Path, typer.Option(help="Folder for requests.json and requests.md.")] = Path(
        "outputs/requests"
    ),
    seed: Annotated[int, typer.Option(help="Of sampling, and of the sentences drawn.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Hand-written sentences in, captured motion as the measure.

    Obedience by action and language, distance from captured clips, counts, angles, lengths, sides,
    sequences, styles, and whether what goes wrong is warned of. Beside it: held-out captured
    clips, procedural ones, a frozen pose and an untrained network.

    \b
    Example:
      motion-tools evaluate-requests --model starter --data data/prepared
    """
    from ..shared.evaluation.suites.text import LANGUAGES

    options.check_limits({"wordings": wordings, "seconds": seconds}, LIMITS)
    options.check_ranges(seed=seed, threads=threads)
    codes = tuple(code.strip() for code in languages.split(",") if code.strip())
    if unknown := sorted(set(codes) - set(LANGUAGES)):
        raise UsageError(f"--languages {unknown[0]} is unknown; choose from {', '.join(LANGUAGES)}")
    options.check_folder("--out", out)

    from ..shared.data.prepared import PreparedData
    from ..shared.device import set_threads
    from ..shared.evaluation.floors import untrained
    from ..shared.evaluation.report.tables import tables
    from ..shared.evaluation.suites.requests import RequestSettings, evaluate_requests
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.text import SentenceGenerator

    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device="cpu")
    report = evaluate_requests(
        SentenceGenerator(generator),
        PreparedData.open(data),
        floors={"untrained": untrained(generator, seed)},
        settings=RequestSettings(wordings=wordings, languages=codes, seconds=seconds, seed=seed),
        about={"model": model, "data": str(data)},
        progress=lambda what: tell(f"evaluate-requests: {what}"),
    )
    title = f"What people ask of {model}"
    save_and_show(report, "requests", title, list(tables(report)), out, json=json)
