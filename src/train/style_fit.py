"""What style a caption's motions have, measured over the training clips (ruling 11)."""

import numpy as np

from ..shared.data.prepared import PreparedData
from ..shared.model.clip.core import TextTower
from ..shared.model.clip.pretrained import encode_captions
from ..shared.model.clip.style_map import StyleMap
from ..shared.model.clip.tokenizer import PromptTokenizer
from ..shared.motion.features import decode_features
from ..shared.motion.style import measure_style, style_values
from ..shared.motion.trajectory import from_motion

MAX_CLIPS = 1500
MIN_FRAMES = 40  # shorter paths say little about energy or rhythm


def fit_style_map(
    data: PreparedData,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> StyleMap | None:
    """The map of this tower; None where the data is too little for one.

    Styles are those of the pelvis path, which is what the audio branch moves.
    """
    records = [clip for clip in data.records("train") if clip.num_frames >= MIN_FRAMES]
    order = np.random.default_rng(0).permutation(len(records))
    texts: list[str] = []
    values: list[np.ndarray] = []
    for number in order[:MAX_CLIPS]:
        captions = data.captions(records[number])
        spoken = [captions[language][0] for language in languages if captions.get(language)]
        motion = decode_features(data.features(records[number]))
        measured = style_values(measure_style(from_motion(motion))).mean(axis=0)
        texts += spoken
        values += [measured] * len(spoken)
    try:
        return StyleMap.fit(encode_captions(tower, tokenizer, texts).numpy(), np.array(values))
    except ValueError:
        return None
