"""How long repetitions are, and with which hand."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.pipelines.clause import LAP, LONG_REST, ONCE, Clause, Reading, without_hand


@given(
    count=st.integers(2, 20),
    rest=st.floats(0.3, 1.5),
    period=st.floats(0.3, 1.2),
)
def test_cycles_have_the_time_of_so_many(count: int, rest: float, period: float) -> None:
    frames, once = Clause("nods", count).repeated(4.0, 30.0, (rest, period))
    windows = round((frames / 30 - count * period) / rest)
    assert frames == round((windows * rest + count * period) * 30)
    if rest + count * period <= ONCE:
        assert windows == 1 and once == frames
    assert once <= round(max(ONCE, LAP, rest + period) * 30) + 1 + round(period * 30)
    if count % windows == 0:
        assert once == round((rest + count // windows * period) * 30)
    assert windows < count or rest >= LONG_REST or windows == 1 or rest + 2 * period > LAP


def test_without_cycles_each_has_a_window() -> None:
    assert Clause("bows", 3).repeated(4.0, 30.0) == (225, 75)
    assert Clause("bows", 2).repeated(9.0, 30.0) == (180, 90)


def reading(text: str) -> Reading:
    """What a model makes of texts that has learned salutes of the right hand, waves of both."""
    for word, found in (
        ("left hand", Reading("wave", 1.0)),
        ("right hand", Reading("wave", 1.0)),
        ("waves", Reading("wave", 3.0)),
        ("salute", Reading("salute", 3.0, handed="right")),
        ("forward on one", Reading("hop", 2.0, handed="right")),
        ("in a circle on one", Reading("jump", 2.0)),
        ("one leg", Reading("hop", 2.0, handed="right")),
        ("foot", Reading("hop", 2.0, handed="right")),
    ):
        if word in text:
            return found
    return Reading()


@pytest.mark.parametrize(
    ("text", "rest", "hand"),
    [("salutes with the left hand", "salutes", "left"),
     ("with his right hand he salutes", "he salutes", "right"),
     ("salute de la main gauche", "salute", "left"),
     ("hops on her left foot", "hops on one leg", "left"),
     ("hops forward on her left foot", "hops forward on one leg", "left"),
     ("hops in a circle on the left foot", "hops on one leg", "left"),
     ("左手で敬礼 salute", "敬礼 salute", "left")],
)  # fmt: skip
def test_the_hand_is_taken_out_where_one_was_learned(text: str, rest: str, hand: str) -> None:
    clause = without_hand(text, reading)
    assert clause is not None and clause.text == rest
    assert clause.mirrored == (hand == "left") and clause.plain == (hand == "right")


@pytest.mark.parametrize(
    "text",
    ["waves with the left hand", "salutes", "salutes with both hands", "turns to the left",
     "salutes, but not with the left hand", "salutes with the left leg",
     "with his left hand on his hip he salutes"],
)  # fmt: skip
def test_it_stays_where_both_were_learned_or_none_is_named(text: str) -> None:
    assert without_hand(text, reading) is None
