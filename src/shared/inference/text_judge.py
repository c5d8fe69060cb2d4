"""TextJudge: candidates for one prompt, scored by what the prompt says and by the body's feet.

Terms, all in [0, 1]:
- similarity: cosine of prompt and motion in the shared text-motion space, 0 where negative. Needs
  the motion tower that the generator's text tower was trained with; without one the term is left
  out.
- feet: mean of two margins, of the feet's slide in contact and of their depth below the floor.
- smoothness: margin of the mean jerk of all joints.
A margin is 1 for whatever real motion does (up to the 95th percentile of 300 mocap and synthetic
clips) and falls to 0 at three times that, ten times for the depth. It must not go on rising below:
the smoothest jump does not jump. A motion with a value that is not finite fails a check.

Letters: N candidates, T frames, K rows, D width of the shared space.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import torch
from torch import Tensor

from src.shared.errors import UserError
from src.shared.inference.selection import ScoreTable, SelectionConfig, distances, rank
from src.shared.model.checkpoint import CARD_FILE, read_card
from src.shared.model.clip import pretrained
from src.shared.model.clip.pretrained import ClipBundle
from src.shared.model.zoo import PRETRAINED, resolve_model
from src.shared.motion.motion import Motion
from src.shared.motion.root_track import encode_features
from src.shared.validation.body_measures import contact_slide, mean_jerk, penetration
from src.shared.validation.margins import share

SLIDE = (9.0, 27.0)  # cm/s: where the margin begins to fall, and where it is 0
DEPTH = (0.5, 5.0)  # cm below the floor; real feet are never deeper than 0.1
JERK = (400.0, 1200.0)  # m/s³
SCALE = 0.5  # metres between joints that count as far apart


SPACES = {"starter": "starter-space"}  # shipped generators and the motion tower of each


class MotionSpace(Protocol):
    """A frozen motion tower with its statistics."""

    def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        """Raw features [N,T,K,6], real frames [N,T] -> unit vectors [N,D]."""


class ClipSpace:
    """The motion tower of a `train_clip` folder."""

    def __init__(self, bundle: ClipBundle) -> None:
        self.clip, self.mean, self.std = bundle.clip, bundle.mean, bundle.std

    @torch.inference_mode()
    def embed_motion(self, features: Tensor, mask: Tensor | None = None) -> Tensor:
        """See `MotionSpace`."""
        return self.clip.encode_motion((features - self.mean) / self.std, mask)


class TextJudge:
    """Scores candidates for a prompt.

    Args:
        space: of the generator's text tower; None = no similarity.
        config: weights.
    """

    def __init__(
        self, space: MotionSpace | None = None, config: SelectionConfig | None = None
    ) -> None:
        self.space, self.config = space, config or SelectionConfig()

    def judge(self, candidates: Sequence[Motion], prompt: Tensor) -> ScoreTable:
        """Rank motions of equal length made for one prompt.

        Args:
            candidates: N ≥ 1, T frames each.
            prompt: its embedding [D], unit-norm.
        """
        points = np.stack([motion.positions() for motion in candidates])  # N T K 3
        bodies = [
            _body(positions.astype(np.float64), motion.fps)
            for positions, motion in zip(points, candidates, strict=True)
        ]
        terms = {name: np.array([body[name] for body in bodies]) for name in bodies[0]}
        if self.space is not None:
            features = torch.stack([encode_features(motion) for motion in candidates])
            cosine = self.space.embed_motion(features).cpu() @ prompt.detach().float().cpu()
            terms = {"similarity": cosine.clamp(0, 1).numpy().astype(np.float64)} | terms
        failed = ~np.isfinite(points).all((1, 2, 3))
        return rank(terms, failed.astype(int), distances(points, SCALE), self.config)


def _body(positions: np.ndarray, fps: float) -> dict[str, float]:
    """Terms of one motion [T,K,3] that need no prompt; feet that never touch the floor slide 0."""
    slide = float(np.nan_to_num(contact_slide(positions, fps)))
    jerk = float(np.nan_to_num(mean_jerk(positions, fps)))
    feet = _margin(slide, SLIDE) + _margin(penetration(positions), DEPTH)
    return {"feet": feet / 2, "smoothness": _margin(jerk, JERK)}


def _margin(value: float, bounds: tuple[float, float]) -> float:
    return share(value, bounds[1], bounds[0])


def load_space(name_or_folder: str | Path, embed_dim: int) -> MotionSpace:
    """A motion tower for a generator of width `embed_dim`.

    Args:
        name_or_folder: what `train_clip` wrote.

    Raises:
        UserError: no such model, another kind, damaged, or of another width.
    """
    folder = resolve_model(name_or_folder)
    card = read_card(folder)
    if card.kind != pretrained.KIND:
        raise UserError(
            f"{folder} holds a {card.kind}, which has no motion tower; name the train_clip folder"
            " that the generator was trained with"
        )
    pretrained.check_embed_dims(embed_dim, card.network.embed_dim, f"the judge in {folder}")
    return ClipSpace(ClipBundle.from_pretrained(folder))


def space_of(generator: str | Path) -> str | None:
    """The shipped motion tower that belongs to a shipped generator; None where there is none."""
    name = SPACES.get(str(generator))
    return name if name and (PRETRAINED / name / CARD_FILE).is_file() else None
