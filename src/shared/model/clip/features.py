"""TextFeatures: what a text tower makes of texts, whoever computes it.

Letters: B batch, L tokens, D embed dim.
"""

from dataclasses import dataclass

from ...errors import UserError
from ...tensors import Tensor, torch


@dataclass(frozen=True)
class TextFeatures:
    """Texts as the denoiser sees them: pooled [B, D] unit-norm, tokens [B, L, D], mask [B, L]; and,
    once it was asked, which of its adapters they open, [B, A] of zeros and ones."""

    pooled: Tensor
    tokens: Tensor
    mask: Tensor  # bool, True = real token
    opened: Tensor | None = None

    def __len__(self) -> int:
        return len(self.pooled)

    def __getitem__(self, rows: Tensor | slice) -> "TextFeatures":
        """The chosen rows of the batch."""
        opened = None if self.opened is None else self.opened[rows]
        return TextFeatures(self.pooled[rows], self.tokens[rows], self.mask[rows], opened)

    def to(self, device: torch.device | str) -> "TextFeatures":
        """The same on another device."""
        opened = None if self.opened is None else self.opened.to(device)
        parts = self.pooled.to(device), self.tokens.to(device), self.mask.to(device)
        return TextFeatures(*parts, opened)


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
