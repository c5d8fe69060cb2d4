"""What the evaluator learns from: joint features of whole clips, kept in memory as half floats.

Letters: B clips in a batch, T frames, F features.
"""

from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

from ...data.prepared import PreparedData
from ...errors import UserError
from .evaluator import joint_features

CHUNK = 256  # clips


@dataclass(frozen=True)
class PairBatch:
    """Captions with motions; `same` [B, B] marks the pairs that belong together."""

    captions: list[str]
    joints: Tensor  # [B, T, F]
    mask: Tensor  # [B, T] bool, true on real frames
    same: Tensor  # [B, B] bool


class PairSet:
    """Captioned clips of one split.

    Args:
        data: prepared clips.
        split: which of them.
        min_frames, max_frames: shorter clips are left out, of longer ones a window is taken.
        languages: captions to draw from.
        balance: 0 draws every clip alike, 1 every label group alike.

    Raises:
        UserError: no clip of the split is long enough and has a caption in these languages.
    """

    def __init__(
        self,
        data: PreparedData,
        split: str,
        *,
        min_frames: int,
        max_frames: int,
        languages: tuple[str, ...],
        balance: float = 0.5,
    ) -> None:
        self.max_frames = max_frames
        self.records = [r for r in data.records(split) if r.num_frames >= min_frames]
        spoken = [data.captions(record) for record in self.records]
        usable = [any(texts.get(k) for k in languages) for texts in spoken]
        self.records = [r for r, ok in zip(self.records, usable, strict=True) if ok]
        self.captions = [texts for texts, ok in zip(spoken, usable, strict=True) if ok]
        if not self.records:
            raise UserError(
                f"split {split!r} holds no clip of {min_frames} frames or more"
                f" with captions in {', '.join(languages)}"
            )
        self.languages = languages
        self.joints: list[Tensor] = []
        for start in range(0, len(self.records), CHUNK):  # kinematics need room: a part at a time
            some = [data.features(record).float() for record in self.records[start : start + CHUNK]]
            self.joints += [joints.half() for joints in joint_features(some)]
        names = sorted({record.group for record in self.records})
        lookup = {name: index for index, name in enumerate(names)}
        self.groups = np.array([lookup[record.group] for record in self.records])
        size = np.bincount(self.groups)[self.groups].astype(np.float64)
        self.weights = size**-balance / (size**-balance).sum()

    def __len__(self) -> int:
        return len(self.records)

    def frames(self, limit: int = 200_000) -> Tensor:
        """Up to about `limit` evenly spaced frames [N, F] in float32, for statistics."""
        frames = torch.cat(self.joints)
        return frames[:: max(1, len(frames) // limit)].float()

    def batch(self, size: int, rng: np.random.Generator) -> PairBatch:
        """`size` clips, each with one caption in one language, all drawn from `rng`."""
        rows = rng.choice(len(self), size=size, p=self.weights)
        captions = [self._caption(row, rng) for row in rows]
        clips = [self._window(self.joints[row], rng) for row in rows]
        lengths = torch.tensor([len(clip) for clip in clips])
        joints = pad_sequence(clips, batch_first=True).float()
        mask = torch.arange(joints.shape[1])[None] < lengths[:, None]
        group = torch.from_numpy(self.groups[rows])
        text = torch.from_numpy(np.unique(captions, return_inverse=True)[1])
        same = (group[:, None] == group[None]) | (text[:, None] == text[None])
        return PairBatch(captions, joints, mask, same)

    def _caption(self, row: int, rng: np.random.Generator) -> str:
        captions = self.captions[row]
        spoken = [language for language in self.languages if captions.get(language)]
        choices = captions[spoken[int(rng.integers(len(spoken)))]]
        return choices[int(rng.integers(len(choices)))]

    def _window(self, joints: Tensor, rng: np.random.Generator) -> Tensor:
        """The whole clip, or a window of the longest length allowed; half begin at the start."""
        spare = len(joints) - self.max_frames
        start = int(rng.integers(spare + 1)) if spare > 0 and rng.random() < 0.5 else 0
        return joints[start : start + self.max_frames]
