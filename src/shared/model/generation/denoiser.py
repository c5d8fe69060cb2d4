"""MotionDenoiser: the diffusion network of the text branch, layer by layer (TEXT).

Letters: B batch, T frames, K rows (bones, root track), C channels, D embed dim,
L text tokens, H heads.
"""

from dataclasses import replace

import torch
from torch import Tensor, nn
from torch.nn.functional import one_hot, pad, silu

from ...config_schema import PROVENANCES, NetworkConfig
from ..checkpoint import ADAPTERS
from ..clip.features import TextFeatures, null_features
from ..layers import (
    AdaptedLinear,
    CrossAttention,
    DenoiserBlock,
    KeyValue,
    TagEmbedding,
    TimestepEmbedding,
    without_full_mask,
    zeroed,
)

TAG_WEIGHT = "tag_embed.embedding.weight"  # [tags + 1, D]; the last stands for none


class FrameRefiner(nn.Module):
    """What tokens of several frames leave out: two convolutions over the frames themselves.

    They see the noisy motion and what the tokens made of it, so that no seam shows between
    tokens; they start at zero.
    """

    def __init__(self, motion_dim: int, hidden: int) -> None:
        super().__init__()
        self.expand = nn.Conv1d(2 * motion_dim, hidden, 3, padding=1)
        self.contract = zeroed(nn.Conv1d(hidden, motion_dim, 3, padding=1))

    def forward(self, noisy: Tensor, coarse: Tensor, mask: Tensor | None = None) -> Tensor:
        """Both [B, T, K*C], mask [B, T], True = real frame -> [B, T, K*C], to be added."""
        seen = torch.cat([noisy, coarse], dim=-1).transpose(1, 2)  # [B, 2*K*C, T]
        real = 1 if mask is None else mask[:, None]  # [B, 1, T]
        hidden = silu(self.expand(seen * real)) * real  # [B, hidden, T]
        change: Tensor = self.contract(hidden)  # [B, K*C, T]
        return change.transpose(1, 2)  # [B, T, K*C]


class OneStep(nn.Module):
    """What a denoiser becomes, to go from noise to motion at once: low-rank changes of its matrices
    and changes of its vectors, learned by distillation with guidance folded in (Meng et al. 2023).

    Kept beside the weights, as Luo et al. 2023 (LCM-LoRA, section 3) do; starts as no change. The
    matrices are those that see frames: of the blocks' maps, and the projections into and out of
    them. Adapters stay what they are.
    """

    def __init__(self, denoiser: "MotionDenoiser", rank: int) -> None:
        super().__init__()
        self.down, self.up = nn.ParameterDict(), nn.ParameterDict()  # [r, D] and [D', r]
        width = denoiser.config.embed_dim
        for name, weight in denoiser.named_parameters():
            if _seen_by_frames(denoiser, name):
                key, (out_dim, dim) = name.replace(".", "_"), weight.shape
                self.down[key] = nn.Parameter(torch.randn(rank, dim) * dim**-0.5)
                self.up[key] = nn.Parameter(torch.zeros(out_dim, rank))
        rows = sum(-(-len(weight) // width) for weight in vectors(denoiser).values())
        self.shifts = nn.Parameter(torch.zeros(rows, width))  # of the vectors, one after another

    def weights(self, denoiser: "MotionDenoiser") -> dict[str, Tensor]:
        """The changed weights of the denoiser, by their names."""
        found, at, width = dict[str, Tensor](), 0, self.shifts.shape[1]
        for name, weight in denoiser.named_parameters():
            if (key := name.replace(".", "_")) in self.down:
                found[name] = weight + self.up[key] @ self.down[key]
        for name, vector in vectors(denoiser).items():
            rows = -(-len(vector) // width)
            found[name] = vector + self.shifts[at : at + rows].flatten()[: len(vector)]
            at += rows
        return found


def _seen_by_frames(denoiser: nn.Module, name: str) -> bool:
    """Whether a parameter is a matrix that OneStep changes."""
    whole, _, last = name.rpartition(".")
    if last != "weight" or ADAPTERS in name:
        return False
    part = denoiser.get_submodule(whole)
    return isinstance(part, AdaptedLinear) or whole in ("motion_proj", "known_proj")


def vectors(denoiser: nn.Module) -> dict[str, Tensor]:
    """The vectors that OneStep changes, by their names, in the order of its `shifts`; sharded over
    processes a scalar is a vector, too."""
    return {
        name: weight
        for name, weight in denoiser.named_parameters()
        if weight.ndim == 1 and not name.startswith(("null_", "one_step", "text_scale"))
    }


class MotionDenoiser(nn.Module):
    """Noisy motion, step, text and tag -> noise, clean motion or v, as the config says.

    With `adapter-ranks` the blocks and the output projection have low-rank adapters. A text opens
    the one that the nearest of `places` [P, D] belongs to: `adapter_of` [P]; 0 is none, and the
    network is what it was without.

    The output projection starts at zero, so the first prediction is the mean motion. With
    `frames-per-token` above 1 the blocks see so many frames as one token (the patches of Peebles
    and Xie 2023, DiT, section 3.2, along time) and a FrameRefiner mends the seams. With
    `one-step-rank` it holds what it becomes for one step, see `in_one_step`.
    """

    one_adapter = False  # samples of a batch may open different ones

    def __init__(self, config: NetworkConfig, num_tags: int) -> None:
        super().__init__()
        generation, dim = config.generation, config.embed_dim
        self.config = config
        self.num_tags = num_tags
        self.uses_tokens = generation.text_conditioning == "tokens"
        self.shows_known = generation.constraints  # known entries are an input
        self.stride = generation.frames_per_token
        motion_dim = config.motion_rows * generation.motion_channels
        token_dim = self.stride * motion_dim

        self.motion_proj = nn.Linear(token_dim, dim)
        self.known_proj = None
        if self.shows_known:  # starts at zero: a network without it can be gone on from
            self.known_proj = zeroed(nn.Linear(token_dim, dim, bias=False))
        self.text_scale = nn.Parameter(torch.tensor(float(dim) ** 0.5))  # unit-norm -> unit RMS
        self.text_proj = nn.Linear(dim, dim)
        self.null_pooled = nn.Parameter(torch.randn(dim) * dim**-0.5)  # ruling 14
        if self.uses_tokens:
            self.token_norm = nn.LayerNorm(dim)
            self.null_token = nn.Parameter(torch.randn(dim))
        self.timestep_embed = TimestepEmbedding(dim)
        self.tag_embed = TagEmbedding(num_tags, dim)
        self.provenance_embed = None
        if generation.provenance:
            self.provenance_embed = TagEmbedding(len(PROVENANCES), dim)
        self.blocks = nn.ModuleList(
            DenoiserBlock(
                dim,
                generation.num_heads,
                dropout=generation.dropout,
                tokens=self.uses_tokens,
                ranks=generation.adapter_ranks,
            )
            for _ in range(generation.num_layers)
        )
        if generation.adapter_ranks:
            self.register_buffer("places", torch.zeros(config.clip.text_places, dim))
            self.register_buffer("adapter_of", torch.zeros(config.clip.text_places).long())
        self.output_norm = nn.LayerNorm(dim)
        # Its input has a fixed length, so that it reaches no further from the mean than what was
        # trained on: what an adapter learns may lie beyond.
        self.output_proj = zeroed(AdaptedLinear(dim, token_dim, generation.adapter_ranks))
        self.refiner = FrameRefiner(motion_dim, dim // 2) if self.stride > 1 else None
        rank = generation.one_step_rank
        self.one_step = OneStep(self, rank) if rank else None

    def forward(
        self,
        noisy: Tensor,
        timesteps: Tensor,
        text: TextFeatures,
        tag: Tensor,
        mask: Tensor | None = None,
        *,
        known: Tensor | None = None,
        provenance: Tensor | None = None,
        keys_values: list[KeyValue] | None = None,
    ) -> Tensor:
        """One prediction.

        Args:
            noisy: [B, T, K, C] z-scored motion with noise, known entries clean.
            timesteps: [B] diffusion steps.
            text: B texts; see TextFeatures.
            tag: [B] long, `num_tags` where there is none.
            mask: [B, T] bool, True = real frame, or None.
            known: [B, T, K, C] bool, the entries that are; for networks with `constraints`.
            provenance: [B] long, index in PROVENANCES, its length where it is not known; for
                networks with `provenance`.
            keys_values: what `text_keys_values(text)` gave, to spare computing it each step.

        Returns:
            [B, T, K, C] in float32 outside autocast.
        """
        frame_mask = mask = without_full_mask(mask)
        frames = noisy.shape[1]
        if self.refiner is not None and mask is not None:
            noisy = noisy * mask[:, :, None, None]  # a token may hold frames that are none
        motion = noisy.flatten(2)  # [B, T, K*C]
        # From here on T counts tokens.
        mask = None if mask is None else self._tokens(mask[..., None]).any(dim=-1)  # [B, T]
        motion_h = self.motion_proj(self._tokens(motion))  # [B, T, D]
        text_h = self.text_proj(text.pooled * self.text_scale)[:, None]  # [B, 1, D]
        h = motion_h + text_h  # [B, T, D]
        if known is not None:
            assert self.known_proj is not None, "this network was not made for constraints"
            flags = known.flatten(2).to(noisy.dtype)  # [B, frames, K*C]
            h = h + self.known_proj(self._tokens(flags))  # [B, T, D]
        label_h = self.tag_embed(tag)  # [B, D]
        if provenance is not None:
            assert self.provenance_embed is not None, "this network was not made for provenance"
            label_h = label_h + self.provenance_embed(provenance)  # [B, D]
        condition = torch.cat([self.timestep_embed(timesteps), label_h], dim=-1)  # [B, 2D]
        condition = silu(condition)
        if keys_values is None:
            keys_values = self.text_keys_values(text)
        for index, block in enumerate(self.blocks):
            own = keys_values[index] if keys_values else None
            h = block(h, condition, mask, own, text.mask, text.opened)  # [B, T, D]
        out = self.output_proj(self.output_norm(h), text.opened)  # [B, T, stride*K*C]
        out = out.unflatten(-1, (self.stride, -1)).flatten(1, 2)[:, :frames]  # [B, frames, K*C]
        if self.refiner is not None:
            out = out + self.refiner(motion, out, frame_mask)  # [B, frames, K*C]
        result: Tensor = out.view_as(noisy)  # [B, frames, K, C]
        return result

    def in_one_step(self) -> "MotionDenoiser | None":
        """The network that goes from noise to motion at once, without guidance; None if that was
        not learned."""
        if self.one_step is None:
            return None
        generation = self.config.generation.model_copy(update={"one_step_rank": 0})
        network = self.config.model_copy(update={"generation": generation})
        changed = MotionDenoiser(network, self.num_tags)
        with torch.no_grad():
            changed.load_state_dict(self.plain_state() | self.one_step.weights(self))
        return changed.to(self.null_pooled.device).eval().requires_grad_(False)

    def plain_state(self) -> dict[str, Tensor]:
        """The weights without what it becomes for one step."""
        return {k: v for k, v in self.state_dict().items() if not k.startswith("one_step.")}

    def _tokens(self, values: Tensor) -> Tensor:
        """Rows of `stride` frames side by side: [B, frames, N] -> [B, T, stride * N]."""
        if self.stride == 1:
            return values
        lacking = -values.shape[1] % self.stride
        padded = pad(values, (0, 0, 0, lacking))
        return padded.reshape(len(values), -1, self.stride * values.shape[2])

    def text_keys_values(self, text: TextFeatures) -> list[KeyValue]:
        """Keys and values of every block's cross-attention; empty for pooled conditioning."""
        if not self.uses_tokens:
            return []
        tokens = self.token_norm(text.tokens)  # [B, L, D]
        layers = [block.cross_attention for block in self.blocks]
        return [layer.keys_values(tokens) for layer in layers if isinstance(layer, CrossAttention)]

    def null_text(self, batch_size: int, num_tokens: int = 1) -> TextFeatures:
        """The learned "no text" (ruling 14): pooled [B, D], tokens [B, L, D], one of them real."""
        token = self.null_token if self.uses_tokens else torch.zeros_like(self.null_pooled)
        return null_features(self.null_pooled, token, batch_size, num_tokens)

    def drop_text(self, text: TextFeatures, drop: Tensor) -> TextFeatures:
        """The same texts with the learned null where drop [B] bool is True; what is open stays
        open, so that guidance compares like with like."""
        null = self.null_text(len(text), text.tokens.shape[1])
        return replace(
            text,
            pooled=torch.where(drop[:, None], null.pooled, text.pooled),
            tokens=torch.where(drop[:, None, None], null.tokens, text.tokens),
            mask=torch.where(drop[:, None], null.mask, text.mask),
        )

    def with_adapters(self, text: TextFeatures) -> TextFeatures:
        """The same texts, and which adapters they open."""
        if not self.config.generation.adapter_ranks:
            return text
        opened = self.opened(text.pooled)
        unread = opened.is_cuda and torch.cuda.is_current_stream_capturing()
        return replace(text, opened=opened) if unread or opened.any() else text

    def opened(self, pooled: Tensor) -> Tensor:
        """Which of the A adapters texts [B, D] open: [B, A] of zeros and ones."""
        places, adapter_of = self.get_buffer("places"), self.get_buffer("adapter_of")
        nearest = (pooled @ places.T).argmax(-1)  # [B]
        number = len(self.config.generation.adapter_ranks)
        return one_hot(adapter_of[nearest], number + 1)[:, 1:].to(pooled)
