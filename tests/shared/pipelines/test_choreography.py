"""Phrases of songs, and the figures that are chosen for them."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.memory.figures import FigureMemory, Figures, Take
from src.shared.memory.steps import STEPS, made_take
from src.shared.motion.staging import PLAIN, Manner
from src.shared.pipelines import choreography
from src.shared.pipelines.choreography import (
    CALM,
    LIVELY,
    WARP,
    Choreographer,
    Wish,
    says_dance,
    unshown,
    wish_of,
)
from src.shared.pipelines.figure_dance import listed
from src.shared.pipelines.song import Slot, song_slots
from tests.shared.memory.tiny_figures import stepping, tiny_figures


def song(tempo: float = 120.0, seconds: float = 20.0, meter: int = 4) -> tuple[np.ndarray, ...]:
    """Beats, bars and silence but for the loudness."""
    frames = round(seconds * 30)
    beats = np.arange(0.1, seconds, 60 / tempo)
    phase = (np.arange(frames) / 30 - 0.1) * tempo / 60 / meter
    condition = np.zeros((167, frames))
    condition[160] = np.linspace(0, 1, frames)
    return beats, phase, condition


@given(tempo=st.floats(50, 210), meter=st.sampled_from([3, 4]), seconds=st.floats(6, 60))
def test_phrases_follow_each_other_at_a_pace_that_is_danced(
    tempo: float, meter: int, seconds: float
) -> None:
    slots = song_slots(*song(tempo, seconds, meter))
    edges = [(slot.counts[0], slot.counts[-1]) for slot in slots]
    assert all(a[1] == pytest.approx(b[0]) for a, b in pairwise(edges))
    assert edges[0][0] < 3 and edges[-1][1] > seconds - 3
    for slot in slots:
        assert 0.28 < np.diff(slot.counts).mean() < 0.75 and 2 <= len(slot.counts) - 1 <= 16
        assert slot.same is None or len(slots[slot.same].counts) == len(slot.counts)


def test_phrases_begin_with_bars_and_have_a_form() -> None:
    slots = song_slots(*song())
    whole = [slot for slot in slots if len(slot.counts) == 9]
    assert len(whole) >= 4
    starts = np.array([slot.counts[0] for slot in whole])
    assert np.abs((starts - 0.1) / 4 - np.rint((starts - 0.1) / 4)).max() < 0.02
    assert [slot.part for slot in slots[:4]] == ["a", "a'", "b", "a'"]
    assert slots[1].same == 0 and slots[3].same == 1 and slots[2].same is None
    assert slots[-1].loudness > slots[0].loudness


@pytest.mark.parametrize(("meter", "danced"), [(3, 3), (4, 4)])
def test_a_song_is_danced_in_steps_of_its_bars(meter: int, danced: int) -> None:
    takes = [made_take(STEPS[number], 0.5, number) for number in (0, 9)]
    assert [take.meter for take in takes] == [4, 3]
    slots = song_slots(*song(meter=meter))
    opens = [slot for slot in slots if slot.meter]
    assert len(opens) > 2 and {slot.meter for slot in opens} == {danced}
    chosen = Choreographer(FigureMemory(takes)).choose(opens, Wish(), 0)
    assert chosen is not None and {int(figure.meter[0]) for figure in chosen} == {danced}


def test_who_asks_for_a_kind_is_not_thrown_to_the_floor() -> None:
    bent = stepping(0.5, bend=0.5)
    low = replace(Take.of(bent, "low", "salsa"), motion=bent)
    takes = [*tiny_figures().takes, low]
    found, _ = Choreographer(FigureMemory(takes)).allowed(4, Wish(frozenset({"salsa"})))
    assert len(found) and 3 not in found.take
    alone, _ = Choreographer(FigureMemory([low])).allowed(4, Wish(frozenset({"salsa"})))
    assert len(alone)


def test_other_kinds_stand_in_where_one_has_too_little() -> None:
    takes = tiny_figures().takes
    party = replace(Take.of(stepping(0.5, sway=0.2), "party", "party dance"))
    choreographer = Choreographer(FigureMemory([*takes, party]))
    salsa, slots = Wish(frozenset({"salsa"})), song_slots(*song())
    assert 3 not in choreographer.allowed(8, salsa)[0].take
    assert 3 in choreographer.allowed(8, salsa, beside=True)[0].take
    chosen = choreographer.choose(slots, salsa, 0)
    assert chosen is not None
    other = {slot.part[0] for slot, each in zip(slots, chosen, strict=True) if each.take[0] == 3}
    assert other <= {"b"}
    alone = Choreographer(FigureMemory([takes[1], party])).choose(slots, salsa, 0)
    assert alone is not None and {int(each.take[0]) for each in alone} == {1}


def test_a_dance_shows_more_poses_than_figures_drawn() -> None:
    takes = [
        made_take(steps, 0.5, number) for number, steps in enumerate(STEPS) if steps.meter == 4
    ]
    choreographer = Choreographer(FigureMemory(takes))
    slots = song_slots(*song(seconds=40))
    chosen, drawn = (
        np.mean([np.any([each.shown[0] for each in make(slots, Wish(), seed) or ()], 0).sum()
                 for seed in range(3)])
        for make in (choreographer.choose, choreographer.draw)
    )  # fmt: skip
    assert chosen > drawn


def test_slow_beats_are_halved() -> None:
    assert {slot.halved for slot in song_slots(*song(60.0))} == {True}
    assert {slot.halved for slot in song_slots(*song(120.0))} == {False}


def test_nobody_dances_in_a_gap() -> None:
    slots = song_slots(*song(), waits=[(240, 360)])
    for slot in slots:
        assert slot.counts[-1] <= 8.1 or slot.counts[0] >= 11.9


def test_a_gap_without_a_beat_parts_the_phrases() -> None:
    beats, phase, condition = song()
    beats = beats[(beats < 8) | (beats > 12)]
    for slot in (found := song_slots(beats, phase, condition, waits=[(243, 357)])):
        assert slot.counts[-1] <= 8.1 or slot.counts[0] >= 11.9
        assert np.diff(slot.counts).max() < 1.0
    assert found[0].counts[0] < 8 < 12 < found[-1].counts[-1]
    assert song_slots(beats, phase, condition, waits=[(0, len(phase))]) == []


def test_calm_is_the_calmest_of_the_kind_that_is_asked_for() -> None:
    lively = replace(Take.of(stepping(0.5, sway=0.5), "lively", "salsa"))
    party = replace(Take.of(stepping(0.5, sway=0.01), "party", "party dance"))
    choreographer = Choreographer(FigureMemory([lively, party]))
    wish = Wish(frozenset({"salsa"}), (0.0, 0.4))
    found, rank = choreographer.allowed(8, wish, beside=True)
    assert {0, 1} == set(found.take.tolist()) and rank.min() >= 0 and rank.max() <= 1
    slots = song_slots(*song())
    chosen = choreographer.choose(slots, wish, 0)
    assert chosen is not None
    for slot, figure in zip(slots, chosen, strict=True):
        assert figure.take[0] == 0 or slot.part.startswith("b")


def test_a_kind_of_short_takes_is_danced_in_halves_of_phrases() -> None:
    short = replace(Take.of(stepping(0.5, frames=70), "short", "tango"))
    choreographer = Choreographer(FigureMemory([*tiny_figures().takes, short]))
    tango, slots = Wish(frozenset({"tango"})), song_slots(*song())
    counts = len(slots[0].counts) - 1
    assert not len(choreographer.allowed(counts, tango)[0])
    halves = choreographer.parted(slots, tango)
    assert len(halves) > len(slots) == len(choreographer.parted(slots, Wish()))
    assert [h.counts[0] for h in halves[1:]] == [h.counts[-1] for h in halves[:-1]]
    assert all(half.same is None or half.same < index for index, half in enumerate(halves))
    chosen = choreographer.choose(halves, tango, 0)
    assert chosen is not None and {int(figure.take[0]) for figure in chosen} == {3}
    assert {row["counts"] for row in listed(choreographer, tango)} == {4}


def test_the_same_seed_chooses_the_same_and_warps_little() -> None:
    slots, choreographer = song_slots(*song()), Choreographer(tiny_figures())
    chosen, again, other = (choreographer.choose(slots, Wish(), seed) for seed in (1, 1, 2))
    assert chosen is not None and again is not None and other is not None
    names = [[float(figure.times[0, 0]) for figure in dance] for dance in (chosen, again, other)]
    assert names[0] == names[1] != names[2]
    for slot, figure in zip(slots, chosen, strict=True):
        period = np.diff(slot.counts).mean()
        assert abs(figure.count[0] / period - 1) <= WARP
        assert figure.times.shape[1] == len(slot.counts)


def test_a_wish_restricts_and_what_nobody_dances_is_told() -> None:
    choreographer = Choreographer(tiny_figures())
    slots = song_slots(*song())
    assert choreographer.kinds == {"salsa", "polka"}
    for kind, take in (("polka", {1}), ("salsa", {0, 2})):
        chosen = choreographer.choose(slots, Wish(frozenset({kind})), 0)
        assert chosen is not None and {int(figure.take[0]) for figure in chosen} <= take
    assert choreographer.choose(slots, Wish(frozenset({"tango"})), 0) is None
    fast = [Slot(np.arange(9) * 0.2)]
    assert choreographer.choose(fast, Wish(), 0) is None
    drawn = choreographer.draw(slots, Wish(), 0)
    assert drawn is not None and len(drawn) == len(slots)
    assert choreographer.draw(fast, Wish(), 0) is None


def test_a_phrase_that_nothing_fits_leaves_the_rest_danced() -> None:
    choreographer = Choreographer(tiny_figures())
    polka = Wish(frozenset({"polka"}))
    whole = song_slots(*song(seconds=17))
    quick = Slot(whole[-1].counts[-1] + np.arange(4) * 0.2)
    assert not choreographer._fits(quick, polka)
    stretched = Slot(whole[-1].counts[-1] + np.arange(7) * 0.39)  # by more than WARP
    for slots in ([*whole, stretched], [stretched]):  # of a kind that is asked for, a third faster
        chosen = choreographer.choose(slots, polka, 0)
        assert chosen is not None and {int(each.take[0]) for each in chosen} == {1}
    assert choreographer.choose([quick], polka, 0) is None


def test_a_dance_ends_with_a_whole_figure_to_the_front() -> None:
    for seconds in np.arange(12.2, 16.2, 0.5):  # cut anywhere in a phrase of four seconds
        slots = song_slots(*song(seconds=float(seconds)))
        assert 4 < len(slots[-1].counts) - 1 <= 12, seconds
    slots = song_slots(*song(seconds=20))
    ends = []
    for gain in (0.0, 1000.0):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(choreography, "AT_END", gain)
            choreographer = Choreographer(tiny_figures())
            usual = choreographer.figures

            def turning(counts: int, usual: Any = usual) -> Figures:
                found = usual(counts)  # every other one turns by a third of a circle
                return replace(found, turn=np.where(np.arange(len(found)) % 2, 2.1, 0.0))

            patch.setattr(choreographer, "figures", turning)
            found = [choreographer.choose(slots, Wish(), seed) for seed in range(4)]
            turned = [sum(float(each.turn[0]) for each in chosen or ()) for chosen in found]
            ends.append(float(np.cos(turned).mean()))
    assert ends[1] > ends[0] + 0.1


def test_one_figure_alone_is_quiet_and_lively() -> None:
    choreographer = Choreographer(tiny_figures())
    longest = max(n for n in range(2, 40) if len(choreographer.figures(n)))
    for energy in (CALM, LIVELY):
        found, rank = choreographer.allowed(longest, Wish(energy=energy))
        assert len(found) and (rank >= 0).all() and (rank <= 1).all()


def test_calm_is_calmer_than_lively() -> None:
    choreographer = Choreographer(tiny_figures())
    calm, lively = (
        choreographer.allowed(8, Wish(energy=share))[0].energy for share in ((0, 0.4), (0.5, 1))
    )
    assert calm.max() <= lively.min()


def test_a_repetition_is_danced_again() -> None:
    slots = song_slots(*song(seconds=40))
    chosen = Choreographer(tiny_figures()).choose(slots, Wish(), 0)
    assert chosen is not None
    asked = [(slot.same, number) for number, slot in enumerate(slots) if slot.same is not None]
    again = [chosen[a].number[0] == chosen[b].number[0] for a, b in asked]
    by_chance = [chosen[a].number[0] == chosen[b].number[0] for a in (0, 2) for b in (4, 5)]
    assert np.mean(again) >= 0.5 > np.mean(by_chance)


def test_a_change_of_kind_costs_where_none_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(choreography, "CHANGE", 1000.0)
    choreographer = Choreographer(tiny_figures())
    slots = song_slots(*song(seconds=40))

    def kinds(wish: Wish) -> set[str]:
        chosen = choreographer.choose(slots, wish, 0)
        assert chosen is not None
        return {choreographer.memory.takes[figure.take[0]].kind for figure in chosen}

    assert len(kinds(Wish())) == 1
    assert len(kinds(Wish(kinds=frozenset({"salsa", "polka"})))) == 2


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
    ("sentence", "kind"),
    [("une femme danse le tango", "my tango"), ("a person dances my tango", "my tango"),
     ("a person dances an Indian dance", "indian"),
     ("eine Frau tanzt einen indischen Tanz", "indian"),
     ("los hombres bailan salsa", "salsa")],
)  # fmt: skip
def test_kinds_of_a_memory_of_ones_own(sentence: str, kind: str) -> None:
    wish = wish_of(sentence, {"my tango", "indian", "salsa"}, choreography.named_kinds())
    assert wish == Wish(frozenset({kind}))


@pytest.mark.parametrize(
    ("sentence", "left"),
    [("a person dances hip hop", "hip hop"), ("une femme danse le tango", "tango"),
     ("two people dance", "two"), ("人がタンゴを踊る", "タンゴ"), ("a knight dances", "knight"),
     ("un uomo balla la salsa", "uomo balla"), ("a person dances", ""), ("a person walks", ""),
     ("a person walks, then dances", "")],
)  # fmt: skip
def test_what_is_not_shown_of_a_dance_is_known(sentence: str, left: str) -> None:
    assert unshown(sentence, KINDS) == left


def test_what_else_is_said_is_told_without_its_comma() -> None:
    wish = wish_of("dos personas bailan salsa", KINDS)
    assert wish is not None and wish.kinds == {"salsa"} and wish.unread == "dos"
    bows = wish_of("a person dances salsa, then bows", KINDS)
    assert bows is not None and bows.unread == "then bows"


def test_a_kind_is_danced_whatever_else_is_said() -> None:
    wish = wish_of("a knight dances salsa, then freezes", KINDS)
    assert wish == Wish(frozenset({"salsa"}), unread="knight , then freezes")


@pytest.mark.parametrize(
    "sentence",
    ["an old man dances", "ein alter Mann tanzt", "un homme âgé danse", "老人在跳舞",
     "una mujer anciana baila", "老人が踊っている"],
)  # fmt: skip
def test_who_dances_carries_it(sentence: str) -> None:
    wish = wish_of(sentence, KINDS)
    assert wish is not None and wish.manner.stoop > 10 and wish.manner.knees > 5
    assert not wish.kinds and wish.energy[1] < 1
    proud = wish_of("a proud old man dances salsa", KINDS)
    assert proud is not None and proud.kinds == {"salsa"}
    assert 0 < proud.manner.stoop < wish.manner.stoop and proud.energy == wish.energy


@pytest.mark.parametrize(
    "sentence",
    ["a knight dances", "an old man walks", "a person dances tango", "", "person",
     "a person dances ballet", "ein Ritter tanzt", "a man breaking into a run",
     "salsa is what she walks to"],
)  # fmt: skip
def test_what_no_figure_shows_is_left_to_the_generator(sentence: str) -> None:
    assert wish_of(sentence, KINDS) is None


@pytest.mark.parametrize(
    ("sentence", "dances"),
    [
        ("she dances slowly and elegantly", True), ("people dancing at a party", True),
        ("她独自起舞", True), ("eine Frau tanzt im Club", True), ("彼女は優雅に踊る", True),
        ("someone does the charleston at a club", True),
        ("an indian man on stage", False), ("a person does a break", False),
        ("a modern person at a party", False), ("a person does not dance", False),
    ],
)  # fmt: skip
def test_where_somebody_dances_is_no_dance(sentence: str, dances: bool) -> None:
    kinds = {"indian dance", "modern dance", "breakdance", "charleston"}
    assert (wish_of(sentence, kinds) is not None) is dances


@pytest.mark.parametrize(
    "sentence",
    [
        "a zombie dances",
        "a robot dances without moving its arms",
        "a zombie doesn't walk, it dances",
        "a person never stops dancing",
        "er rennt nicht und tanzt",
        "sie hört nicht auf zu tanzen",
        "un robot danse sans bouger les bras",
        "ella no para de bailar",
        "ロボットは跳ばずに踊る",
        "一个机器人不走路，跳舞",
    ],
)
def test_what_is_said_to_be_danced(sentence: str) -> None:
    assert says_dance(sentence)


@pytest.mark.parametrize(
    ("sentence", "kinds"),
    [("don't dance salsa", None), ("no baila salsa", None),
     ("a person dances, but not salsa", None),
     ("sie tanzt nicht Salsa", None), ("サルサは踊りません", None),
     ("she doesn’t dance polka", None),
     ("a woman who does not smile dances salsa", {"salsa"}),
     ("she does not dance breakdance, she dances salsa", {"salsa"})],
)  # fmt: skip
def test_a_kind_that_is_denied_is_not_danced(sentence: str, kinds: set[str] | None) -> None:
    wish = wish_of(sentence, KINDS)
    assert (wish and set(wish.kinds)) == kinds


def test_who_dances_otherwise_dances_other_figures() -> None:
    takes = [made_take(each, 0.5, number) for number, each in enumerate(STEPS) if each.meter == 4]
    choreographer, slots = Choreographer(FigureMemory(takes)), song_slots(*song(seconds=40))
    manners = PLAIN, Manner(stoop=30)
    chosen = [choreographer.choose(slots, Wish(manner=manner), 0) for manner in manners]
    numbers = [[int(each.number[0]) for each in some or ()] for some in chosen]
    assert all(numbers) and numbers[0] != numbers[1]


@pytest.mark.parametrize(
    "sentence",
    [
        "she does not dance",
        "a robot never dances",
        "he does not want to dance",
        "a robot stands instead of dancing",
        "ein Roboter tanzt heute nicht",
        "un robot ne danse jamais",
        "elle n'aime pas danser",
        "elle n’aime pas danser la salsa",
        "una persona no está bailando",
        "ロボットは踊りません",
        "不跳舞而是走路",
        "a zombie walks",
    ],
)
def test_what_is_denied_or_no_dance(sentence: str) -> None:
    assert not says_dance(sentence)


@pytest.mark.parametrize("kind", ["rock'n'roll", "drum'n'bass"])
def test_an_apostrophe_denies_nothing_within_a_word(kind: str) -> None:
    wish = wish_of(f"a person dances {kind}", {kind})
    assert wish is not None and wish.kinds == {kind}
