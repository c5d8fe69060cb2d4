"""Dropping words never leaves nothing and never invents anything."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from src.shared.data.captions.book import drop_words, insert_babble, insert_word


@given(st.text(min_size=1, max_size=60), st.floats(0, 0.99), st.integers(0, 1000))
def test_what_is_left_is_part_of_the_caption(caption: str, share: float, seed: int) -> None:
    left = drop_words(caption, share, np.random.default_rng(seed))
    assert left == caption or left.strip()
    rest = iter(caption)
    assert all(letter in rest for letter in left if not letter.isspace())  # in order


def test_words_and_characters_go_at_the_given_rate() -> None:
    rng = np.random.default_rng(0)
    words = " ".join(["word"] * 1000)
    assert 680 < len(drop_words(words, 0.3, rng).split()) < 720 + 20
    assert 660 < len(drop_words("歩" * 1000, 0.3, rng)) < 740
    assert drop_words(words, 0.0, rng) == words


def test_babble_adds_words_and_keeps_all_others() -> None:
    rng = np.random.default_rng(1)
    for _ in range(50):
        words = insert_babble("walk to the left", "corre hacia adelante", rng).split()
        rest = iter(words)
        assert all(word in rest for word in ["walk", "to", "the", "left"])
        assert 4 < len(words) <= 7
    longer = insert_babble("左手を振る", "人が歩く", rng)
    assert len(longer) > 5 and all(letter in longer for letter in "左手を振る")
    assert insert_babble("walk", "123 !", rng) == "walk"


def test_a_single_word_stays_a_word_of_its_own_script() -> None:
    rng = np.random.default_rng(2)
    for _ in range(50):
        made = insert_babble("walk", "corre", rng)
        assert "walk" in made.split() and made.isascii()


def test_a_word_of_another_sentence_comes_in() -> None:
    rng = np.random.default_rng(0)
    for _ in range(20):
        words = insert_word("a person walks", "she throws", rng).split()
        assert len(words) == 4 and {"she", "throws"} & {*words}
        assert insert_word("bow", "nod", rng) in ("bow nod", "nod bow")
        longer = insert_word("人が歩く", "投げる", rng)
        assert len(longer) == 6 and ("投げ" in longer or "げる" in longer)
