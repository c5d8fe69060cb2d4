"""StyleMap: from the shared text-motion space to the 8-d style (ruling 11).

A linear map: ridge regression from embeddings to measured energy, extent, rhythm and tension, so
that a sentence sets the style of a path as words of a list do. The towers are trained to put a text
where its motion is, so the map may be fitted on either and read from either.

Letters: N samples, D channels.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from ...errors import UserError
from ...io.files import atomic_write
from ...motion.style import PAIRS, style_vector

STYLE_FILE = "style.safetensors"
_EDGE = 0.02  # measured values are kept this far from 0 and 1, whose logits are infinite
_RIDGE = 1.0  # embeddings have length 1
_HELD_OUT = 5  # the last fifth of the samples measures the correlations


@dataclass(frozen=True)
class StyleMap:
    """Weights [D, 4] and offset [4] to the logits of the four pairs.

    `correlations` [4] are Pearson's, between the map's and the measured logits of samples that it
    was not fitted on; NaN where a pair did not vary.
    """

    weight: np.ndarray
    offset: np.ndarray
    correlations: np.ndarray

    @classmethod
    def fit(cls, embeddings: np.ndarray, values: np.ndarray) -> Self:
        """Learn from embeddings [N, D] and measured pair values [N, 4] in 0 to 1.

        The order is random, except that what belongs together (captions of a clip) lies together.

        Raises:
            ValueError: fewer than ten samples.
        """
        if len(embeddings) < 2 * _HELD_OUT:
            raise ValueError(f"{len(embeddings)} samples are too few for a map of styles")
        limited = np.clip(values.astype(np.float64), _EDGE, 1 - _EDGE)
        logits = np.log(limited / (1 - limited))
        held = np.arange(len(embeddings)) >= len(embeddings) * (_HELD_OUT - 1) // _HELD_OUT
        weight, offset = _ridge(embeddings[~held], logits[~held])
        trial = embeddings[held] @ weight + offset
        with np.errstate(invalid="ignore", divide="ignore"):
            found = [np.corrcoef(trial[:, i], logits[held, i])[0, 1] for i in range(len(PAIRS))]
        weight, offset = _ridge(embeddings, logits)
        return cls(weight.astype(np.float32), offset.astype(np.float32), np.array(found))

    def __call__(self, embedding: np.ndarray) -> np.ndarray:
        """Embeddings [..., D] to unit styles [..., 8]."""
        logits = embedding.astype(np.float64) @ self.weight + self.offset
        return style_vector((1 + np.tanh(logits / 2)) / 2)  # the logistic, which cannot overflow

    def save_pretrained(self, folder: str | Path) -> None:
        """Write style.safetensors into a model folder."""
        from safetensors.numpy import save_file

        tensors = {"weight": self.weight, "offset": self.offset, "correlations": self.correlations}
        with atomic_write(Path(folder) / STYLE_FILE) as temporary:
            save_file(tensors, temporary)

    @classmethod
    def from_pretrained(cls, folder: str | Path) -> Self | None:
        """Read a map; None where the folder has none.

        Raises:
            UserError: the file is damaged.
        """
        from safetensors import SafetensorError
        from safetensors.numpy import load_file

        path = Path(folder) / STYLE_FILE
        if not path.is_file():
            return None
        try:
            found = cls(**load_file(path))
            wanted = ((*found.weight.shape[:1], len(PAIRS)), (len(PAIRS),), (len(PAIRS),))
            arrays = (found.weight, found.offset, found.correlations)
            if tuple(array.shape for array in arrays) != wanted:
                raise ValueError(f"shapes {[list(array.shape) for array in arrays]}")
            if any(array.dtype.kind != "f" or np.isinf(array).any() for array in arrays) or (
                np.isnan(found.weight).any() or np.isnan(found.offset).any()
            ):
                raise ValueError("numbers that are not finite")
            return found
        except (OSError, ValueError, TypeError, SafetensorError) as error:
            raise UserError(f"{path} is damaged ({error}); copy the model folder again") from error


def _ridge(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weights [D, C] and offset [C] of x [N, D] to y [N, C]; the offset is not held small."""
    x = x.astype(np.float64)
    mean = x.mean(axis=0)
    centred = x - mean
    gram = centred.T @ centred + _RIDGE * np.eye(x.shape[1])
    weight = np.linalg.solve(gram, centred.T @ (y - y.mean(axis=0)))
    return weight, y.mean(axis=0) - mean @ weight
