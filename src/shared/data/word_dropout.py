"""Captions with a few words missing: what is left must still mean the motion."""

import numpy as np


def drop_words(caption: str, share: float, rng: np.random.Generator) -> str:
    """The caption without a random share of its words; never less than one of them.

    Text without spaces (Japanese, Chinese) loses characters instead.

    Args:
        caption: any text.
        share: chance of each word to go, 0 to 1.
        rng: consumed once a word.
    """
    if share <= 0:
        return caption
    joint = " " if " " in caption.strip() else ""
    words = caption.split() if joint else list(caption)
    kept = [word for word, draw in zip(words, rng.random(len(words)), strict=True) if draw >= share]
    shortened = joint.join(kept)
    return shortened if shortened.strip() else caption
