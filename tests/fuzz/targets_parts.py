"""Readers of what lies beside weights and runs: scopes, style maps, tokenizers, bands, logs."""

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from src.shared.model.checkpoint import PRETRAINED
from src.train.run_log import Epoch, read_losses
from tests.fuzz.target import Target, check_arrays

SHIPPED = (
    "starter/scope.json",
    "starter/scope.safetensors",
    "starter/style.safetensors",
    "starter/tokenizer/prompt_tokenizer.json",
    "starter/tokenizer/sentencepiece.bpe.model",
    "starter-audio/bands.json",
)


def _write(folder: Path) -> None:
    for name in SHIPPED:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes((PRETRAINED / name).read_bytes())
    rows = [{"step": step, "loss": 1.0 / (step + 1)} for step in range(5)]
    (folder / "log.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    epochs = [asdict(Epoch(n, 3 * n, {"loss": 3.0 - n}, {"loss": 2.0})) for n in range(3)]
    (folder / "training_log.json").write_text(json.dumps(epochs))


def _read(path: Path) -> None:
    from src.shared.metrics.sanity import Bands
    from src.shared.model.clip.out_of_domain import OutOfDomainDetector
    from src.shared.model.clip.style_map import StyleMap
    from src.shared.model.clip.tokenizer import PromptTokenizer

    match path.name.partition(".")[0]:
        case "scope":
            scope = OutOfDomainDetector.from_pretrained(path.parent)
            assert scope is not None
            there = np.ones(scope.means.shape[1], np.float32)
            scope.warning("a person juggles", scope.check("a person juggles", there))
        case "style":
            style = StyleMap.from_pretrained(path.parent)
            assert style is not None
            check_arrays([style(np.ones(len(style.weight)))])
        case "prompt_tokenizer" | "sentencepiece":
            PromptTokenizer.from_pretrained(path.parent).pieces("a person walks")
        case "bands":
            Bands.load(path)
        case _:
            read_losses(path)


PART_TARGETS = {"parts": Target(_write, _read)}
