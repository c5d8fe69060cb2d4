"""ClipBundle: MotionClip with its tokenizer and statistics, as one folder; StyleMap beside it.

The map is a linear one from the shared text-motion space to the 8-d style (ruling 11): ridge
regression from embeddings to measured energy, extent, rhythm and tension, so that a sentence sets
the style of a path as words of a list do. The towers are trained to put a text where its motion is,
so the map may be fitted on either and read from either.

Letters: N samples, D channels.
"""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
import torch
from torch import Tensor, nn

from ...errors import UserError
from ...io.files import atomic_write
from ...motion.style import PAIRS, style_vector
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
from .tokenizer import PromptTokenizer

KIND = "motion-clip"
TOKENIZER_FOLDER = "tokenizer"
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


def check_embed_dims(text_dim: int, denoiser_dim: int, where: str) -> None:
    """TEXT's constraint, caught at load.

    Raises:
        UserError: naming both numbers.
    """
    if text_dim != denoiser_dim:
        raise UserError(
            f"embed-dim mismatch: {where} gives text embeddings of {text_dim}, the denoiser takes"
            f" {denoiser_dim}; train both with one profile, or set embed-dim to {text_dim}"
        )


@torch.no_grad()
def encode_captions(
    tower: TextTower, tokenizer: PromptTokenizer, captions: list[str], *, batch_size: int = 256
) -> Tensor:
    """Pooled embeddings [N, D] unit-norm of many captions, float32 on the CPU."""
    device = next(tower.parameters()).device
    parts = []
    for start in range(0, len(captions), batch_size):
        ids, mask = tokenizer(captions[start : start + batch_size])
        parts.append(tower(ids.to(device), mask.to(device)).pooled.cpu())
    return torch.cat(parts) if parts else torch.zeros(0, tower.embed_dim)


# ---------------------------------------------------------------- style


STYLE_FILE = "style.safetensors"
_EDGE = 0.02  # measured values are kept this far from 0 and 1, whose logits are infinite
_RIDGE = 1.0  # embeddings have length 1
_HELD_OUT = 5  # the last fifth of the samples measures the correlations


@dataclass(frozen=True)
class StyleMap:
    """Weights [D, 4] and offset [4] to the logits of the four pairs.

    `correlations` [4] are Pearson's, between the map's and the measured logits of samples that it
    was not fitted on; NaN where a pair did not vary.
    """

    weight: np.ndarray
    offset: np.ndarray
    correlations: np.ndarray

    @classmethod
    def fit(cls, embeddings: np.ndarray, values: np.ndarray) -> Self:
        """Learn from embeddings [N, D] and measured pair values [N, 4] in 0 to 1.

        The order is random, except that what belongs together (captions of a clip) lies together.

        Raises:
            ValueError: fewer than ten samples.
        """
        if len(embeddings) < 2 * _HELD_OUT:
            raise ValueError(f"{len(embeddings)} samples are too few for a map of styles")
        limited = np.clip(values.astype(np.float64), _EDGE, 1 - _EDGE)
        logits = np.log(limited / (1 - limited))
        held = np.arange(len(embeddings)) >= len(embeddings) * (_HELD_OUT - 1) // _HELD_OUT
        weight, offset = _ridge(embeddings[~held], logits[~held])
        trial = embeddings[held] @ weight + offset
        with np.errstate(invalid="ignore", divide="ignore"):
            found = [np.corrcoef(trial[:, i], logits[held, i])[0, 1] for i in range(len(PAIRS))]
        weight, offset = _ridge(embeddings, logits)
        return cls(weight.astype(np.float32), offset.astype(np.float32), np.array(found))

    def __call__(self, embedding: np.ndarray) -> np.ndarray:
        """Embeddings [..., D] to unit styles [..., 8]."""
        logits = embedding.astype(np.float64) @ self.weight + self.offset
        return style_vector((1 + np.tanh(logits / 2)) / 2)  # the logistic, which cannot overflow

    def save_pretrained(self, folder: str | Path) -> None:
        """Write style.safetensors into a model folder."""
        from safetensors.numpy import save_file

        tensors = {"weight": self.weight, "offset": self.offset, "correlations": self.correlations}
        with atomic_write(Path(folder) / STYLE_FILE) as temporary:
            save_file(tensors, temporary)

    @classmethod
    def from_pretrained(cls, folder: str | Path) -> Self | None:
        """Read a map; None where the folder has none.

        Raises:
            UserError: the file is damaged.
        """
        from safetensors import SafetensorError
        from safetensors.numpy import load_file

        path = Path(folder) / STYLE_FILE
        if not path.is_file():
            return None
        try:
            found = cls(**load_file(path))
            wanted = ((*found.weight.shape[:1], len(PAIRS)), (len(PAIRS),), (len(PAIRS),))
            arrays = (found.weight, found.offset, found.correlations)
            if tuple(array.shape for array in arrays) != wanted:
                raise ValueError(f"shapes {[list(array.shape) for array in arrays]}")
            if any(array.dtype.kind != "f" or np.isinf(array).any() for array in arrays) or (
                np.isnan(found.weight).any() or np.isnan(found.offset).any()
            ):
                raise ValueError("numbers that are not finite")
            return found
        except (OSError, ValueError, TypeError, SafetensorError) as error:
            raise UserError(f"{path} is damaged ({error}); copy the model folder again") from error


def _ridge(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weights [D, C] and offset [C] of x [N, D] to y [N, C]; the offset is not held small."""
    x = x.astype(np.float64)
    mean = x.mean(axis=0)
    centred = x - mean
    gram = centred.T @ centred + _RIDGE * np.eye(x.shape[1])
    weight = np.linalg.solve(gram, centred.T @ (y - y.mean(axis=0)))
    return weight, y.mean(axis=0) - mean @ weight
