"""TextFeatures: what a text tower makes of texts, whoever computes it.

Letters: B batch, L tokens, D embed dim.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...errors import UserError
from ...tensors import Tensor, torch


@dataclass(frozen=True)
class TextFeatures:
    """Texts as the denoiser sees them: pooled [B, D] unit-norm, tokens [B, L, D], mask [B, L]; once
    it was asked, which of its adapters they open, [B, A] of zeros and ones; and, of a tower with
    places, their cosine with the nearest one, [B]."""

    pooled: Tensor
    tokens: Tensor
    mask: Tensor  # bool, True = real token
    opened: Tensor | None = None
    closeness: Tensor | None = None

    def __len__(self) -> int:
        return len(self.pooled)

    def __getitem__(self, rows: Tensor | slice) -> "TextFeatures":
        """The chosen rows of the batch."""
        return self._each(lambda values: values[rows])

    def to(self, device: torch.device | str) -> "TextFeatures":
        """The same on another device."""
        return self._each(lambda values: values.to(device))

    def rows(self) -> list[tuple[np.ndarray, float | None]]:
        """Of each text its embedding [D] and its closeness, on the CPU."""
        closeness = [None] * len(self) if self.closeness is None else self.closeness.tolist()
        return list(zip(self.pooled.cpu().numpy(), closeness, strict=True))

    def _each(self, change: Callable[[Tensor], Tensor]) -> "TextFeatures":
        parts = (None if each is None else change(each) for each in vars(self).values())
        return TextFeatures(*parts)  # type: ignore[arg-type]


def null_features(pooled: Tensor, token: Tensor, batch_size: int, num_tokens: int) -> TextFeatures:
    """A network's "no text" [D] and the token [D] of it, B times; one of L tokens is real."""
    mask = torch.zeros(batch_size, num_tokens, dtype=torch.bool, device=pooled.device)
    mask[:, 0] = True
    dim = len(pooled)
    tokens = token.expand(batch_size, num_tokens, dim)
    return TextFeatures(pooled.expand(batch_size, dim), tokens, mask)


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
