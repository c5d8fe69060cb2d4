"""The technical document's UNet and DDIM loop, as it prints them: the yardstick of audio_unet.

ResBlock (3.1.3), AttentionBlock (3.1.4) and the sampler (8.1) compute line by line what is printed
there; how they are put together is the drawing of 3.1.2, which both networks follow. Repaired
only where it crashes or says nothing:

- the printed cross-attention gives the context the length of the queries and breaks at T/2: the
  context keeps its own length here (ruling 3);
- resamplers, the sinusoidal code and padding are not printed: ours (rulings 1 and 4), so lengths
  must divide by the deepest factor.

The loop keeps what does not crash: keys and values of the audio are computed at every step, x0 is
limited to +-1, and the last step ends at alpha_bar of step 0 (rulings 12 and 13).

`literal_twin` copies the weights of our UNet without FiLM and rotary positions, which the printed
network does not have, so that outputs can be compared.

Letters: B batch, C channels, T frames, S context frames, E time embedding, h heads, d = C/h.
"""

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from src.shared.model.audio import FEATURE_ROWS
from src.shared.model.audio.unet import AttentionBlock, Downsample, ResBlock, UNet1D, Upsample
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.model.layers import sinusoidal


class LiteralResBlock(nn.Module):
    """3.1.3 with scale-shift norm."""

    def __init__(self, ours: ResBlock) -> None:
        super().__init__()
        assert ours.use_scale_shift_norm and ours.film is None
        self.norm1, self.conv1 = ours.norm1, ours.conv1
        self.time_mlp = ours.time_mlp
        self.norm2, self.dropout, self.conv2 = ours.norm2, ours.dropout, ours.conv2
        self.skip_conv = ours.skip_conv

    def forward(self, x: Tensor, time_emb: Tensor) -> Tensor:
        """x [B, C, T], time [B, E] -> [B, C', T]."""
        h = self.norm1(x)
        h = F.silu(h)
        h = self.conv1(h)
        time_out = self.time_mlp(time_emb)[:, :, None]
        scale, shift = time_out.chunk(2, dim=1)
        h = self.norm2(h) * (1 + scale) + shift
        h = F.silu(h)
        h = self.dropout(h)
        h = self.conv2(h)
        return h + self.skip_conv(x)


class LiteralAttention(nn.Module):
    """3.1.4: einsum and softmax."""

    def __init__(self, ours: AttentionBlock) -> None:
        super().__init__()
        assert ours.rotary is None
        self.num_heads = ours.num_heads
        self.head_dim = ours.qkv.in_features // ours.num_heads
        self.norm, self.cross_norm = ours.norm, ours.cross_norm
        self.qkv, self.proj = _conv(ours.qkv), _conv(ours.proj)
        self.q_cross, self.kv_cross = _conv(ours.q_cross), _conv(ours.kv_cross)
        self.proj_cross = _conv(ours.proj_cross)

    def forward(self, x: Tensor, context: Tensor) -> Tensor:
        """x [B, C, T], context [B, E, S] -> [B, C, T]."""
        batch, channels, frames = x.shape
        heads, dim = self.num_heads, self.head_dim
        h = self.norm(x)
        qkv = self.qkv(h).reshape(batch, 3, heads, dim, frames)
        q, k, v = qkv[:, 0], qkv[:, 1], qkv[:, 2]
        scale = dim**-0.5
        attn = torch.einsum("bhdt,bhds->bhts", q, k) * scale
        attn = F.softmax(attn, dim=-1)
        out = torch.einsum("bhts,bhds->bhdt", attn, v)
        x = x + self.proj(out.reshape(batch, channels, frames))

        h = self.cross_norm(x)
        q = self.q_cross(h).reshape(batch, heads, dim, frames)
        # repaired: the context's own length, where the document says `frames`
        kv = self.kv_cross(context).reshape(batch, 2, heads, dim, context.shape[-1])
        k, v = kv[:, 0], kv[:, 1]
        attn = torch.einsum("bhdt,bhds->bhts", q, k) * scale
        attn = F.softmax(attn, dim=-1)
        out = torch.einsum("bhts,bhds->bhdt", attn, v)
        return x + self.proj_cross(out.reshape(batch, channels, frames))


class LiteralUNet(nn.Module):
    """3.1.2, reading the audio at every step."""

    def __init__(self, ours: UNet1D) -> None:
        super().__init__()
        assert ours.context_proj is not None
        self.time_dim, self.time_embed = ours.config.time_embed_dim, ours.time_embed
        self.context_proj = nn.Linear(FEATURE_ROWS, ours.config.context_dim)
        self.context_proj.weight = nn.Parameter(
            ours.context_proj.weight.detach()[:, :FEATURE_ROWS].clone()
        )
        self.context_proj.bias = ours.context_proj.bias
        self.input_conv = ours.input_conv
        self.down = nn.ModuleList(_stage(stage) for stage in ours.down)
        self.downsample = nn.ModuleList(_resampler(layer) for layer in ours.downsample)
        self.middle = _stage(ours.middle)
        self.up = nn.ModuleList(_stage(stage) for stage in ours.up)
        self.upsample = nn.ModuleList(_resampler(layer) for layer in ours.upsample)
        self.output_norm, self.output_conv = ours.output_norm, ours.output_conv

    def forward(self, x: Tensor, t: Tensor, audio_cond: Tensor) -> Tensor:
        """x [B, 25, T], t [B], audio_cond [B, 163, T] -> [B, 25, T]."""
        time_emb = self.time_embed(sinusoidal(t, self.time_dim))
        context = self.context_proj(audio_cond.transpose(1, 2)).transpose(1, 2)  # [B, E, T]
        h, skips = self.input_conv(x), []
        for stage, halve in zip(self.down, self.downsample, strict=True):
            h = _through(stage, h, time_emb, context)
            skips.append(h)
            h = halve(h)
        h = _through(self.middle, h, time_emb, context)
        for level in reversed(range(len(self.up))):
            h = torch.cat([self.upsample[level](h), skips[level]], dim=1)
            h = _through(self.up[level], h, time_emb, context)
        return self.output_conv(F.silu(self.output_norm(h)))


def literal_twin(ours: UNet1D) -> LiteralUNet:
    """The printed network with the weights of ours: conditioning cross-attention, rotary off."""
    assert ours.config.conditioning == "cross-attention" and not ours.config.rotary
    return LiteralUNet(ours).eval()


class LiteralDDIMSampler:
    """8.1 with eta 0."""

    def __init__(self, diffusion: GaussianDiffusion, num_steps: int = 20) -> None:
        self.diffusion, self.num_steps = diffusion, num_steps

    @torch.no_grad()
    def sample(self, model: nn.Module, x: Tensor, audio_cond: Tensor) -> Tensor:
        """From noise x [B, 25, T] to samples [B, 25, T]."""
        total = self.diffusion.config.timesteps
        timesteps = list(range(total - 1, -1, -(total // self.num_steps)))[: self.num_steps]
        for i, t in enumerate(timesteps):
            t_batch = torch.full((len(x),), t, device=x.device, dtype=torch.long)
            t_next = timesteps[i + 1] if i < len(timesteps) - 1 else 0
            x = self._step(model, x, t_batch, t_next, audio_cond)
        return x

    def _step(
        self, model: nn.Module, x: Tensor, t: Tensor, t_next: int, audio_cond: Tensor
    ) -> Tensor:
        noise_pred = model(x, t, audio_cond)
        alpha = self.diffusion.alphas_cumprod[t[0]]
        alpha_next = self.diffusion.alphas_cumprod[t_next]
        x_0 = (x - torch.sqrt(1 - alpha) * noise_pred) / torch.sqrt(alpha)
        x_0 = x_0.clamp(-1, 1)
        dir_xt = torch.sqrt(1 - alpha_next) * noise_pred
        return torch.sqrt(alpha_next) * x_0 + dir_xt


def _conv(linear: nn.Linear) -> nn.Conv1d:
    """The 1x1 convolution that the document prints where we have a Linear."""
    layer = nn.Conv1d(linear.in_features, linear.out_features, 1)
    layer.weight = nn.Parameter(linear.weight.detach()[:, :, None].clone())
    layer.bias = linear.bias
    return layer


def _stage(ours: nn.Module) -> nn.ModuleList:
    """Blocks in order, the attention behind the block that it follows."""
    layers: list[nn.Module] = []
    for index, block in enumerate(ours.blocks):
        layers.append(LiteralResBlock(block))
        if index == ours.attention_after:
            layers.append(LiteralAttention(ours.attention))
    return nn.ModuleList(layers)


def _resampler(ours: nn.Module) -> nn.Module:
    assert isinstance(ours, Downsample | Upsample | nn.Identity)
    return ours


def _through(stage: nn.Module, h: Tensor, time_emb: Tensor, context: Tensor) -> Tensor:
    for layer in stage:
        h = layer(h, time_emb if isinstance(layer, LiteralResBlock) else context)
    return h
