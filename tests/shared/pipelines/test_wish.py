"""What sentences ask of figures, in six languages."""

import pytest

from src.shared.pipelines.choreography import Wish
from src.shared.pipelines.wish import CALM, LIVELY, wish_of

KINDS = {"salsa", "breakdance", "polka"}


@pytest.mark.parametrize(
    "sentence",
    ["a person dances", "una persona baila", "une personne danse", "eine Person tanzt",
     "人が踊っている", "一个人在跳舞", "Somebody dances to the music."],
)  # fmt: skip
def test_whoever_just_dances_may_dance_anything(sentence: str) -> None:
    assert wish_of(sentence, KINDS) == Wish()


@pytest.mark.parametrize(
    ("sentence", "kind", "energy"),
    [
        ("salsa", "salsa", (0.0, 1.0)),
        ("a calm person dances salsa", "salsa", CALM),
        ("una persona feliz baila salsa", "salsa", LIVELY),
        ("一个人在跳萨尔萨舞", "salsa", (0.0, 1.0)),
        ("a person is breakdancing wildly", "breakdance", LIVELY),
        ("a person dances the polka", "polka", (0.0, 1.0)),  # a memory's own kind
    ],
)
def test_kinds_and_energy(sentence: str, kind: str, energy: tuple[float, float]) -> None:
    assert wish_of(sentence, KINDS) == Wish(frozenset({kind}), energy)


@pytest.mark.parametrize(
    "sentence",
    ["an old man dances", "a person walks", "a person dances tango", "", "person",
     "a person dances ballet", "ein alter Mann tanzt"],
)  # fmt: skip
def test_what_no_figure_shows_is_left_to_the_generator(sentence: str) -> None:
    assert wish_of(sentence, KINDS) is None
