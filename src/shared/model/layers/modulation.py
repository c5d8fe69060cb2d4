"""What carries a condition into a network: FiLM, adaptive layer norm, embeddings of step and tag.

Letters: B batch, T frames, D embed dim, E condition channels.
"""

from torch import Tensor, nn

from .attention import sinusoidal


class FiLM(nn.Module):
    """x * (1 + scale) + shift, both read off the condition; starts as the identity.

    Perez et al. 2018, FiLM, equation 1.
    """

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.modulation = nn.Linear(condition_dim, 2 * dim)
        nn.init.zeros_(self.modulation.weight)
        nn.init.zeros_(self.modulation.bias)

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        scale, shift = self.modulation(condition)[:, None].chunk(2, dim=-1)  # [B, 1, D] each
        return x * (1 + scale) + shift


class AdaLN(nn.Module):
    """Layer norm whose scale and shift come from the condition; starts as a plain layer norm.

    Peebles and Xie 2023, DiT, section 3.2.
    """

    def __init__(self, dim: int, condition_dim: int) -> None:
        super().__init__()
        self.norm = nn.LayerNorm(dim, elementwise_affine=False)
        self.film = FiLM(dim, condition_dim)

    def forward(self, x: Tensor, condition: Tensor) -> Tensor:
        """x [B, T, D], condition [B, E] -> [B, T, D]."""
        return self.film(self.norm(x), condition)


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
