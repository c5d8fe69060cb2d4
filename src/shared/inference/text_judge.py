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

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from ..errors import UserError
from ..model.audio import shared_space
from ..model.audio.shared_space import MotionTower, SharedSpace
from ..model.checkpoint import read_card
from ..model.clip import pretrained
from ..model.clip.core import TextTower
from ..model.clip.pretrained import ClipBundle, tower_hash
from ..model.zoo import list_models, resolve_model
from ..motion.motion import Motion
from ..motion.root_track import encode_features
from ..validation.body_measures import contact_slide, mean_jerk, penetration
from ..validation.margins import share
from .selection import ScoreTable, SelectionConfig, distances, rank

SLIDE = (9.0, 27.0)  # cm/s: where the margin begins to fall, and where it is 0
DEPTH = (0.5, 5.0)  # cm below the floor; real feet are never deeper than 0.1
JERK = (400.0, 1200.0)  # m/s³
SCALE = 0.5  # metres between joints that count as far apart


Tower = Callable[[Tensor], Tensor]  # raw features [N,T,K,6] -> unit vectors [N,D]


class TextJudge:
    """Scores candidates for a prompt.

    Args:
        tower: motions into the space of the generator's text tower; None = no similarity.
        config: weights.
    """

    def __init__(self, tower: Tower | None = None, config: SelectionConfig | None = None) -> None:
        self.tower, self.config = tower, config or SelectionConfig()

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
        if self.tower is not None:
            features = torch.stack([encode_features(motion) for motion in candidates])
            with torch.inference_mode():
                cosine = self.tower(features).cpu() @ prompt.detach().float().cpu()
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


def load_tower(name_or_folder: str | Path, text: TextTower) -> MotionTower:
    """The motion tower of a folder that `train_clip`, `train_text` or `train_audio_tower` wrote.

    Args:
        name_or_folder: of the model, or a shipped shared space.
        text: the generator's, which it must have been trained with.

    Raises:
        UserError: no such model, another kind, damaged, or trained with another text tower.
    """
    folder = resolve_model(name_or_folder)
    kind = read_card(folder).kind
    if kind == shared_space.KIND:
        space = SharedSpace.from_pretrained(folder)
        tower, trained_with = space.motion, space.card.text_tower
    elif kind == pretrained.KIND:
        bundle = ClipBundle.from_pretrained(folder)
        tower, trained_with = MotionTower.of(bundle), tower_hash(bundle.clip.text)
    else:
        raise UserError(
            f"{folder} holds a {kind}, which has no motion tower; name the folder of train_clip,"
            " or of train_text, that the generator's text tower comes from"
        )
    if trained_with != tower_hash(text):
        raise UserError(
            f"{folder} was trained with another text tower than the generator's, so prompts and"
            " motions cannot be compared; name the CLIP folder that the generator was trained from"
        )
    return tower


def own_tower(text: TextTower) -> MotionTower | None:
    """The motion tower of the first listed shared space that a text tower belongs to, or None."""
    own = tower_hash(text)
    for row in list_models():
        if row["kind"] == shared_space.KIND:
            space = SharedSpace.from_pretrained(row["name"])
            if space.card.text_tower == own:
                return space.motion
    return None
