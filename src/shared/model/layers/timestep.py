"""Embeddings of the diffusion step and of the action tag (TEXT, conditioning).

Letters: B batch, D embed dim.
"""

from torch import Tensor, nn

from .positions import sinusoidal


class TimestepEmbedding(nn.Module):
    """Sinusoidal code of the step, then an MLP D -> 4D -> D."""

    def __init__(self, dim: int) -> None:
        super().__init__()
        self.dim = dim
        self.mlp = nn.Sequential(nn.Linear(dim, 4 * dim), nn.SiLU(), nn.Linear(4 * dim, dim))

    def forward(self, timesteps: Tensor) -> Tensor:
        """Steps [B] -> [B, D]."""
        code = sinusoidal(timesteps, self.dim)  # [B, D]
        return self.mlp(code)


class TagEmbedding(nn.Module):
    """One vector a tag; the last index, `num_tags`, stands for "no tag" (ruling 25)."""

    def __init__(self, num_tags: int, dim: int) -> None:
        super().__init__()
        self.num_tags = num_tags
        self.embedding = nn.Embedding(num_tags + 1, dim)
        nn.init.normal_(self.embedding.weight, std=dim**-0.5)

    def forward(self, tags: Tensor) -> Tensor:
        """Tag indices [B], `num_tags` where there is none -> [B, D]."""
        return self.embedding(tags)
