"""A pretrained text encoder in training: at a rate of its own, or frozen and asked only once.

Letters: N captions, H width of the encoder.
"""

import copy
import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import torch
from safetensors import safe_open
from safetensors.torch import save_file
from torch import Tensor

from ..shared.io.files import atomic_write
from ..shared.model.clip.core import OWN, TextTower
from ..shared.model.clip.pretrained import tower_hash
from ..shared.model.clip.tokenizer import PromptTokenizer
from ..shared.model.layers.attention import masked_mean
from .run_log import announce

MEANS_FILE = "caption-means.safetensors"  # in the output folder: a resumed run reads it
CHUNK = 128  # captions of one call


def encoder_rates(tower: TextTower, prefix: str, rate: float) -> dict[str, float]:
    """Learning rates for the task protocol: a pretrained encoder learns at `rate`, 0 freezes it."""
    if tower.config.text_model in OWN:
        return {}
    for name, weight in tower.encoder.named_parameters():
        weight.requires_grad_(rate > 0 and not name.startswith("pooler."))  # which is not used
    return {f"{prefix}encoder.": rate}


@torch.no_grad()
def caption_means(
    tower: TextTower, tokenizer: PromptTokenizer, captions: Sequence[str], file: Path
) -> Tensor:
    """The encoder's mean over the tokens of each caption [N,H], float16 on the CPU.

    They are read from the file if it holds those of these captions and this encoder, else
    computed and written there.

    Raises:
        UserError: the file cannot be written.
    """
    texts = hashlib.sha256("\n".join(captions).encode()).hexdigest()
    made_of = {"captions": texts, "encoder": tower_hash(tower.encoder)}
    if file.is_file():
        with safe_open(file, "pt") as stored:
            if stored.metadata() == made_of:
                found: Tensor = stored.get_tensor("means")
                return found
    announce(f"reading {len(captions)} captions with the frozen encoder, once")
    device, rows = next(tower.parameters()).device, torch.zeros(len(captions), 0)
    by_length = sorted(range(len(captions)), key=lambda row: len(captions[row]))
    tower.eval()
    for start in range(0, len(captions), CHUNK):
        chosen = by_length[start : start + CHUNK]
        ids, mask = (each.to(device) for each in tokenizer([captions[row] for row in chosen]))
        hidden = tower.encoder(input_ids=ids, attention_mask=mask).last_hidden_state
        mean = masked_mean(hidden, mask.bool()).half().cpu()
        if start == 0:
            rows = torch.zeros(len(captions), mean.shape[1], dtype=torch.float16)
        rows[chosen] = mean
        if start // CHUNK % 50 == 49:
            announce(f"{start + len(chosen)} of {len(captions)} captions read")
    with atomic_write(file) as temporary:
        save_file({"means": rows}, temporary, metadata=made_of)
    return rows


@dataclass(frozen=True)
class ZScores:
    """Mean and spread [H] of an encoder's caption means.

    Those of a pretrained encoder have most in common with one another, and a few channels far
    larger than the rest (Ethayarajh 2019): without this, what differs between captions is lost.
    """

    shift: Tensor
    scale: Tensor

    @classmethod
    def of(cls, means: Tensor) -> Self:
        """Of [N,H]."""
        return cls(means.float().mean(0), means.float().std(0).clamp(min=1e-4))

    def __call__(self, means: Tensor) -> Tensor:
        """[N,H] -> z-scores [N,H]."""
        return (means.float() - self.shift) / self.scale

    @torch.no_grad()
    def folded(self, tower: TextTower) -> TextTower:
        """A copy on the CPU, its projection of z-scores made one of what the encoder gives."""
        tower = copy.deepcopy(tower).cpu()
        tower.text_proj.weight.div_(self.scale)
        tower.text_proj.bias.sub_(tower.text_proj.weight @ self.shift)
        return tower
