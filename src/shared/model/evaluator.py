"""The judge: a small text-motion model that shares nothing with the models it scores.

Design choices:
- motion side reads joint positions and velocities (the generator reads 6D rotations), through
  strided convolutions and a bidirectional GRU (the generator's CLIP is a transformer);
- text side is a bag of hashed n-grams and an MLP (the generator's is an XLM-R);
- own mean and standard deviation, own training run, train split only;
- 32 dimensions, so that Fréchet distances need no projection and about a thousand samples.

Letters: B batch, T frames, K bones, S = ceil(T / 4) steps, H hidden, D = 32 embedding channels,
F = 130 features: pelvis height, 21 joint positions relative to the pelvis in the heading frame (m),
21 joint velocities in that frame (m/s), forward and lateral velocity (m/s), yaw rate (rad/s).
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

import numpy as np
import torch
import torch.nn.functional as F
from pydantic import ValidationError
from safetensors import SafetensorError
from safetensors.torch import load_file, save_file
from torch import Tensor, nn
from torch.nn.utils.rnn import pad_sequence

from ..config_schema import Config
from ..errors import UserError
from ..io.files import atomic_write, load_json, sha256_file, write_json
from ..metrics.retrieval import NUM_BUCKETS, caption_buckets
from ..motion.features import FORWARD, HEIGHT, LATERAL, YAW_RATE, encode_features
from ..motion.motion import Motion
from ..motion.rotations import forward_kinematics, rotation_6d_to_matrix
from ..motion.skeleton import NUM_JOINTS, canonical_skeleton
from . import checkpoint
from .checkpoint import PRETRAINED, WeightsInfo, check_weights, dequantise, quantise, weights_info

FPS = 30.0
NUM_FEATURES = 1 + 2 * 3 * (NUM_JOINTS - 1) + 3
WEIGHTS = "model.safetensors"
BAG = "text.bag.weight"
WINDOW = 120  # frames that it sees at once: it learned from clips of so many
MAX_SCALE = 50.0


class EvaluatorConfig(Config):
    """Sizes of the evaluator."""

    embed_dim: int = 32
    hidden_size: int = 128
    text_size: int = 64
    num_buckets: int = NUM_BUCKETS
    num_features: int = NUM_FEATURES
    dropout: float = 0.1
    initial_scale: float = 10.0  # factor on cosines; learned, at most 50


class MotionEncoder(nn.Module):
    """[B, T, F] and mask [B, T] to unit vectors [B, D]."""

    mean: Tensor
    std: Tensor

    def __init__(self, config: EvaluatorConfig) -> None:
        super().__init__()
        width = config.hidden_size
        self.register_buffer("mean", torch.zeros(config.num_features))
        self.register_buffer("std", torch.ones(config.num_features))
        self.conv_in = nn.Conv1d(config.num_features, width, 5, stride=2, padding=2)
        self.conv_down = nn.Conv1d(width, width, 5, stride=2, padding=2)
        self.norm_in = nn.LayerNorm(width)
        self.norm_down = nn.LayerNorm(width)
        self.gru = nn.GRU(width, width // 2, batch_first=True, bidirectional=True)
        self.dropout = nn.Dropout(config.dropout)
        self.project = nn.Linear(2 * width, config.embed_dim)

    def forward(self, joints: Tensor, mask: Tensor) -> Tensor:
        """Padded frames never reach a real one's convolution, step or pool."""
        x = (joints - self.mean) / self.std  # [B, T, F]
        x, mask = self._convolve(self.conv_in, self.norm_in, x, mask)  # [B, T/2, H]
        x, mask = self._convolve(self.conv_down, self.norm_down, x, mask)  # [B, S, H]
        steps = self._recur(self.dropout(x), mask)  # [B, S, H]
        weight = mask.unsqueeze(-1)
        mean = (steps * weight).sum(1) / weight.sum(1).clamp(min=1)  # [B, H]
        peak = steps.masked_fill(~weight, -1.0).amax(1)  # [B, H]; GRU outputs stay in -1..1
        pooled = self.dropout(torch.cat([mean, peak], dim=-1))  # [B, 2H]
        return F.normalize(self.project(pooled), dim=-1)  # [B, D]

    @staticmethod
    def _convolve(
        conv: nn.Conv1d, norm: nn.LayerNorm, x: Tensor, mask: Tensor
    ) -> tuple[Tensor, Tensor]:
        x = conv((x * mask.unsqueeze(-1)).transpose(1, 2)).transpose(1, 2)
        mask = mask[:, ::2]
        return F.gelu(norm(x)) * mask.unsqueeze(-1), mask

    def _recur(self, x: Tensor, mask: Tensor) -> Tensor:
        lengths = mask.sum(1).clamp(min=1).cpu()
        packed = nn.utils.rnn.pack_padded_sequence(
            x, lengths, batch_first=True, enforce_sorted=False
        )
        steps, _ = self.gru(packed)
        return nn.utils.rnn.pad_packed_sequence(steps, batch_first=True, total_length=x.shape[1])[0]


def bag(captions: Sequence[str], num_buckets: int = NUM_BUCKETS) -> tuple[Tensor, Tensor]:
    """Indices [sum of lengths] and offsets [B], as `torch.nn.EmbeddingBag` takes them."""
    rows = [caption_buckets(caption, num_buckets) for caption in captions]
    lengths = torch.tensor([len(row) for row in rows])
    indices = torch.tensor([bucket for row in rows for bucket in row], dtype=torch.long)
    return indices, lengths.cumsum(0) - lengths


class TextEncoder(nn.Module):
    """Captions to unit vectors [B, D]; word order counts only within word pairs."""

    def __init__(self, config: EvaluatorConfig) -> None:
        super().__init__()
        self.num_buckets = config.num_buckets
        self.bag = nn.EmbeddingBag(config.num_buckets, config.text_size, mode="mean")
        nn.init.normal_(self.bag.weight, std=0.1)
        self.norm = nn.LayerNorm(config.text_size)
        self.dropout = nn.Dropout(config.dropout)
        self.expand = nn.Linear(config.text_size, 2 * config.text_size)
        self.project = nn.Linear(2 * config.text_size, config.embed_dim)

    def forward(self, captions: Sequence[str]) -> Tensor:
        """Captions in any of the six languages; an empty one gets the vector of no words."""
        indices, offsets = bag(captions, self.num_buckets)
        device = self.bag.weight.device
        x = self.norm(self.bag(indices.to(device), offsets.to(device)))  # [B, H]
        x = F.gelu(self.expand(self.dropout(x)))  # [B, 2H]
        return F.normalize(self.project(self.dropout(x)), dim=-1)  # [B, D]


class Evaluator(nn.Module):
    """Text and motion encoders into one 32-dimensional space."""

    motion: MotionEncoder
    text: TextEncoder

    def __init__(self, config: EvaluatorConfig | None = None) -> None:
        super().__init__()
        self.config = config or EvaluatorConfig()
        self.motion = MotionEncoder(self.config)
        self.text = TextEncoder(self.config)
        self.log_scale = nn.Parameter(torch.tensor(math.log(self.config.initial_scale)))
        self.content_hash = "untrained"
        self.notes: dict[str, Any] = {}  # what config.json says of the training

    def forward(self, captions: Sequence[str], joints: Tensor, mask: Tensor) -> tuple[Tensor, ...]:
        """Text [B, D], motion [B, D] and the factor on their cosines (training)."""
        scale = self.log_scale.exp().clamp(max=MAX_SCALE)
        return self.text(captions), self.motion(joints, mask), scale

    @property
    def device(self) -> torch.device:
        """Where the weights are."""
        return self.motion.mean.device

    @property
    def trained_groups(self) -> frozenset[str]:
        """Label combinations it was trained on."""
        return frozenset(self.notes.get("groups", ()))

    @torch.no_grad()
    def fit_statistics(self, joints: Tensor, *, floor: float = 0.02) -> None:
        """Take mean and deviation from real frames [N, F]; `floor` keeps still joints finite."""
        self.motion.mean.copy_(joints.mean(0))
        self.motion.std.copy_(joints.std(0).clamp(min=floor))

    @torch.inference_mode()
    def embed_text(self, captions: Sequence[str]) -> Tensor:
        """Unit vectors [B, D] on the CPU."""
        self.eval()
        embedded: Tensor = self.text(list(captions))
        return embedded.float().cpu()

    @torch.inference_mode()
    def embed_features(self, clips: Sequence[Tensor], *, batch_size: int = 64) -> Tensor:
        """Raw motion features [T, K + 1, 6] of N clips, batched by length, to unit vectors [N, D]
        on the CPU, in the order given."""
        self.eval()
        order = sorted(range(len(clips)), key=lambda row: len(clips[row]))
        result = torch.zeros(len(clips), self.config.embed_dim)
        for start in range(0, len(order), batch_size):
            rows = order[start : start + batch_size]
            joints = joint_features([clips[row].float().to(self.device) for row in rows])
            result[rows] = self.motion(*padded(joints)).float().cpu()
        return result

    def embed_windows(self, motion: Motion) -> np.ndarray:
        """[W, D] of the windows of a motion, each as long as the clips that the judge learned from;
        a shorter last one is left out unless it is the only one."""
        features = encode_features(motion)
        whole = max(1, len(features) // WINDOW)
        windows = [features[k * WINDOW : (k + 1) * WINDOW] for k in range(whole)]
        return self.embed_features(windows).numpy()

    def embed_motion(self, motions: Sequence[Motion]) -> Tensor:
        """Unit vectors [N, D] on the CPU."""
        return self.embed_features([encode_features(motion) for motion in motions])

    def save_pretrained(self, folder: Path | str, *, notes: dict[str, Any] | None = None) -> None:
        """Write `config.json` (with `notes`: data hash, steps, figures) and fp16 weights, those of
        n-grams in int8."""
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        state = {k: v.detach().cpu() for k, v in self.state_dict().items()}
        bags = quantise({name: state.pop(name) for name in (BAG,)})
        state = {k: v.half().contiguous() for k, v in state.items()} | bags
        with atomic_write(folder / WEIGHTS) as path:
            save_file(state, path)
        vouched = {"weights": weights_info(folder / WEIGHTS).model_dump()}
        config = {"kind": "evaluator", "evaluator": self.config.model_dump()}
        write_json(folder / "config.json", {**config, **(notes or {}), **vouched})

    @classmethod
    def from_pretrained(cls, name: Path | str, device: str | torch.device = "cpu") -> Self:
        """Load a shipped evaluator by name or any folder that `save_pretrained` wrote.
        Raises UserError: no such folder, another kind of model, or weights that do not fit."""
        folder = evaluator_folder(name)
        if not (folder / "config.json").is_file():
            cards = sorted(PRETRAINED.glob("*/config.json"))
            known = [c.parent.name for c in cards if load_json(c).get("kind") == "evaluator"]
            raise UserError(
                f"no evaluator {str(name)!r}; there are: {', '.join(known) or 'none'}, or a folder"
                " from `motion-tools train evaluator`"
            )
        try:
            content = dict(load_json(folder / "config.json"))
            if vouched := content.pop("weights", None):  # older ones have none
                check_weights(folder, WeightsInfo.model_validate(vouched))
            weights = load_file(folder / WEIGHTS)
        except (OSError, ValueError, TypeError, SafetensorError) as error:
            raise UserError(
                f"the evaluator in {folder} is damaged ({error}); copy the folder again, or train"
                " one with src.train.train_evaluator"
            ) from error
        if content.get("kind") != "evaluator":
            raise UserError(
                f"{folder} holds a {content.get('kind')!r}, not an evaluator"
                "; name a folder of train_evaluator"
            )
        try:
            config = EvaluatorConfig.model_validate(content.get("evaluator"))
        except ValidationError as error:
            raise checkpoint.of_another_version(folder / "config.json", error) from error
        try:
            model = cls(config)
            model.load_state_dict({k: v.float() for k, v in dequantise(weights).items()})
        except (KeyError, ValueError, RuntimeError) as error:
            raise UserError(
                f"weights in {folder} do not fit its config.json ({error!s:.300}); copy the folder"
                " again"
            ) from error
        model.notes = {k: v for k, v in content.items() if k not in ("kind", "evaluator")}
        model.content_hash = sha256_file(folder / WEIGHTS)[:12]
        return model.to(device).eval()


def evaluator_folder(name: Path | str) -> Path:
    """That of a shipped evaluator, the one named, or one from a hub."""
    folder = Path(name)
    return folder if folder.is_dir() else checkpoint.from_hub(name) or PRETRAINED / str(name)


# ---------------------------------------------------------------- what it sees of a motion


def padded(parts: Sequence[Tensor]) -> tuple[Tensor, Tensor]:
    """[T, ...] each -> [B, T, ...] with zeros at the ends, and mask [B, T]."""
    values = pad_sequence(list(parts), batch_first=True)
    lengths = torch.tensor([len(part) for part in parts], device=values.device)
    return values, torch.arange(values.shape[1], device=values.device) < lengths[:, None]


def joint_features(clips: Sequence[Tensor]) -> list[Tensor]:
    """Raw motion features [T, K + 1, 6] of each clip to [T, F] of what the evaluator reads; the
    kinematics run at once. Velocities are forward differences; the last frame repeats (ruling 6).
    Raises ValueError: the root track is missing, or a shape is another."""
    for clip in clips:
        if clip.ndim != 3 or clip.shape[1:] != (NUM_JOINTS + 1, 6):
            raise ValueError(
                f"the evaluator reads [T, {NUM_JOINTS + 1}, 6] with a root track,"
                f" not {tuple(clip.shape)}"
            )
    # Row 0 holds no heading (ruling 19), so that positions are in the heading frame.
    features, skeleton = torch.cat(list(clips)), canonical_skeleton()
    local = rotation_6d_to_matrix(features[:, :NUM_JOINTS])
    offsets = torch.as_tensor(skeleton.offsets, dtype=features.dtype, device=features.device)
    origin = features.new_zeros(len(features), 3)
    joined = forward_kinematics(local, origin, offsets, skeleton.parents)[0][:, 1:].flatten(1)
    found, lengths = [], [len(clip) for clip in clips]
    for clip, joints in zip(clips, torch.split(joined, lengths), strict=True):
        velocities = torch.zeros_like(joints)  # T 63
        if len(joints) > 1:
            velocities[:-1] = (joints[1:] - joints[:-1]) * FPS
            velocities[-1] = velocities[-2]
        root = clip[:, NUM_JOINTS]
        track = root[:, [FORWARD, LATERAL, YAW_RATE]]
        found.append(torch.cat([root[:, [HEIGHT]], joints, velocities, track], dim=-1))
    return found
