"""`calibrate`: which actions of a model come out, so that it warns of the others."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from ..shared.errors import UsageError, UserError
from . import options
from .console import print_json, tell


def calibrate(
    model: Annotated[Path, typer.Option(help="Folder of `train generation`; its scope is kept.")],
    data: Annotated[Path, typer.Option(help="Folder written by `prepare`, as it was trained on.")],
    tries: Annotated[int, typer.Option(help="Sentences of each action.")] = 12,
    seed: Annotated[int, typer.Option(help="Of sampling, and of the sentences drawn.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Ask a model for each of its actions and let it warn of those that seldom come out.

    A judge fitted on the clips of DATA says what came out. `generate` and `evaluate-requests` warn
    from then on of prompts that ask for an action shown in less than half of the tries.

    \b
    Example:
      motion-tools calibrate --model runs/generation --data data/prepared
    """
    options.check_ranges(seed=seed, threads=threads, tries=tries)
    if not (model / "config.json").is_file():
        raise UsageError(
            f"--model {model} is no model folder of yours, and what ships is not written to; name"
            " a folder of `train generation`, or copy one"
        )

    from ..shared.data.prepared import PreparedData
    from ..shared.data.text_motion import gestures
    from ..shared.device import set_threads
    from ..shared.evaluation.judge.actions import action_reliability
    from ..shared.model.clip.out_of_domain import RELIABLE
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.text import SentenceGenerator

    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device="cpu")
    if generator.scope is None:
        raise UserError(f"{model} has no scope.json to write to; train it again with this version")
    clips = PreparedData.open(data)
    found = action_reliability(
        SentenceGenerator(generator),
        clips,
        tries=tries,
        seed=seed,
        progress=lambda what: tell(f"calibrate: {what}"),
    )
    known = replace(generator.scope, reliability=found, gestures=gestures(clips))
    known.save_pretrained(model)
    if json:
        print_json({"model": str(model), "reliability": found})
    else:
        for action, share in sorted(found.items(), key=lambda each: each[1]):
            print(f"{share:.2f}  {action}{'  (warned of)' if share < RELIABLE else ''}")
