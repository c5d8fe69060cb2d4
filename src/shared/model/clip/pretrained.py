"""ClipBundle: MotionClip with its tokenizer and statistics, as one folder.

Letters: N samples, D channels.
"""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import torch
from torch import Tensor, nn

from ..checkpoint import (
    ModelCard,
    load_state,
    read_card,
    read_tensors,
    resolve_model,
    with_prefix,
    write_checkpoint,
    wrong_kind,
)
from .core import MotionClip, TextTower
from .features import TextFeatures, check_embed_dims
from .tokenizer import TOKENIZER_FOLDER, PromptTokenizer

KIND = "motion-clip"
TOWER_OF = {KIND: "clip.text", "motion-generator": "text"}  # kind of model -> prefix of its tower


@dataclass
class ClipBundle:
    """What CLIP pretraining leaves behind.

    Attributes:
        clip: both towers.
        tokenizer: the text tower's.
        mean: [K(+1), 6] of the data; motion goes in z-scored.
        std: [K(+1), 6].
        card: name, network, training summary.
    """

    clip: MotionClip
    tokenizer: PromptTokenizer
    mean: Tensor
    std: Tensor
    card: ModelCard

    def save_pretrained(self, folder: str | Path, *, half: bool = False) -> None:
        """Write the folder; raises UserError when that fails."""
        self.tokenizer.save_pretrained(Path(folder) / TOKENIZER_FOLDER)
        card = self.card.model_copy(
            update={
                "kind": KIND,
                "network": self.clip.config,
                "text_encoder": self.clip.text.encoder_config(),
            }
        )
        tensors = with_prefix("clip", self.clip.state_dict())
        tensors |= {"statistics.mean": self.mean, "statistics.std": self.std}
        self.card = write_checkpoint(Path(folder), card, tensors, half=half)

    @classmethod
    def from_pretrained(cls, folder: str | Path) -> Self:
        """Read what `save_pretrained` wrote; the towers come in eval mode.

        Raises:
            UserError: no such folder, another kind of model, damaged or wrong weights.
        """
        folder = Path(folder)
        card = read_card(folder)
        if card.kind != KIND:
            raise wrong_kind(folder, card.kind, KIND, "name a folder of train_clip")
        tensors = read_tensors(folder, card)
        clip = MotionClip(card.network, encoder_config=card.text_encoder)
        load_state(clip, tensors, "clip", folder)
        return cls(
            clip=clip.eval(),
            tokenizer=PromptTokenizer.from_pretrained(folder / TOKENIZER_FOLDER),
            mean=tensors["statistics.mean"],
            std=tensors["statistics.std"],
            card=card,
        )


def load_text_tower(
    name_or_folder: str | Path, embed_dim: int
) -> tuple[TextTower, PromptTokenizer]:
    """The frozen text tower of a CLIP folder or of a generator, for a denoiser of `embed_dim`.

    Raises:
        UserError: the two widths differ, or there is no such folder, model or tower.
    """
    folder = resolve_model(name_or_folder)
    card = read_card(folder)
    if card.kind not in TOWER_OF:
        raise wrong_kind(folder, card.kind, KIND, "name a folder of train_clip, or a generator")
    check_embed_dims(card.network.embed_dim, embed_dim, f"the text tower in {folder}")
    tower = TextTower(card.network.clip, embed_dim, encoder_config=card.text_encoder)
    load_state(tower, read_tensors(folder, card), TOWER_OF[card.kind], folder)
    return tower.freeze(), PromptTokenizer.from_pretrained(folder / TOKENIZER_FOLDER)


def tower_hash(tower: nn.Module) -> str:
    """SHA-256 of the weights of a text tower, or of its encoder, as float16, as generators may
    store them."""
    digest = hashlib.sha256()
    for name, tensor in sorted(tower.state_dict().items()):
        if tensor.is_floating_point():
            digest.update(name.encode())
            digest.update(tensor.detach().cpu().half().numpy().tobytes())
    return digest.hexdigest()


@torch.no_grad()
def encode_captions(
    tower: TextTower, tokenizer: PromptTokenizer, captions: list[str], *, batch_size: int = 256
) -> Tensor:
    """Pooled embeddings [N, D] unit-norm of many captions, float32 on the CPU."""
    return place_captions(tower, tokenizer, captions, batch_size=batch_size)[0]


@torch.no_grad()
def place_captions(
    tower: TextTower, tokenizer: PromptTokenizer, captions: list[str], *, batch_size: int = 256
) -> tuple[Tensor, Tensor | None]:
    """`encode_captions`, and their cosines with the nearest place [N]; None without places."""
    device = next(tower.parameters()).device
    pooled, closeness = [torch.zeros(0, tower.embed_dim)], [torch.zeros(0)]
    for start in range(0, len(captions), batch_size):
        ids, mask = tokenizer(captions[start : start + batch_size])
        found: TextFeatures = tower(ids.to(device), mask.to(device))
        pooled.append(found.pooled.cpu())
        if found.closeness is not None:
            closeness.append(found.closeness.cpu())
    return torch.cat(pooled), torch.cat(closeness) if len(closeness) == len(pooled) else None
