"""Captions with a few words missing: what is left must still mean the motion."""

import numpy as np

EAST_ASIAN = 0x3000  # from here on, scripts are written without spaces
IDEOGRAPHS = (0x4E00, 0x9FFF)  # Unicode's main block, which Chinese and Japanese share


def drop_words(caption: str, share: float, rng: np.random.Generator) -> str:
    """The caption without a random share of its words; never less than one of them.

    Text without spaces (Japanese, Chinese) loses characters instead.

    Args:
        share: chance of each word to go, 0 to 1.
        rng: consumed once a word.
    """
    if share <= 0:
        return caption
    joint = "" if any(ord(letter) >= EAST_ASIAN for letter in caption) else " "
    words = caption.split() if joint else list(caption)
    kept = [word for word, draw in zip(words, rng.random(len(words)), strict=True) if draw >= share]
    shortened = joint.join(kept)
    return shortened if shortened.strip() else caption


def insert_babble(caption: str, letters_of: str, rng: np.random.Generator, *, most: int = 3) -> str:
    """The caption with up to `most` made-up words in it, as a stand-in for words never seen.

    In text without spaces a made-up word may be one character, and half of its characters are
    drawn from all ideographs: a small tokenizer does not know most of them, and the tower has to
    learn to overhear its unknown token too.

    Args:
        letters_of: a text of the same language, whose letters the words are drawn from.
        rng: consumed a varying number of times.
        most: words to insert, at most.
    """
    joint = "" if any(ord(letter) >= EAST_ASIAN for letter in caption) else " "
    words = caption.split() if joint else list(caption)
    letters = [letter for letter in letters_of if letter.isalpha()]
    if not letters:
        return caption
    for _ in range(int(rng.integers(1, most + 1))):
        length = int(rng.integers(2, 9) if joint else rng.integers(1, 5))
        word = "".join(letters[index] for index in rng.integers(len(letters), size=length))
        if not joint:
            strange = rng.integers(*IDEOGRAPHS, size=length)
            word = "".join(
                chr(code) if draw < 0.5 else letter
                for code, draw, letter in zip(strange, rng.random(length), word, strict=True)
            )
        edges = (0, len(words))  # politeness and context stand at the ends more often than inside
        place = edges[int(rng.integers(2))] if rng.random() < 0.7 else rng.integers(len(words) + 1)
        words.insert(int(place), word)
    return joint.join(words)
