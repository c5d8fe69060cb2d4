"""What sentences say of order and measure, in six languages; and what is no order or measure."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.pipelines.sentence import Clause, clauses

ACTIONS = {
    "walk": ("walk", "camina", "marche", "geht", "歩", "走路"),
    "wave": ("wav", "saluda", "salue", "winkt", "手を振", "挥手"),
    "jump": ("jump",),
    "turn": ("turn",),
    "bow": ("bow",),
}


def known(text: str) -> str | None:
    found = [name for name, words in ACTIONS.items() if any(word in text for word in words)]
    return found[0] if len(found) == 1 else None


ORDERS = [
    ("a person walks forward and then waves", ["a person walks forward", "waves"]),
    ("walks, then jumps, then bows", ["walks", "jumps", "bows"]),
    ("before bowing, he walks", ["he walks", "bowing"]),
    ("he walks before bowing", ["he walks", "bowing"]),
    ("after a jump, she bows", ["a jump", "she bows"]),
    ("she bows after a jump", ["a jump", "she bows"]),
    ("a walk followed by a bow", ["a walk", "a bow"]),
    ("una persona camina y luego saluda", ["una persona camina", "saluda"]),
    ("une personne marche puis salue", ["une personne marche", "salue"]),
    ("jemand geht und winkt dann", ["jemand geht", "winkt"]),
    ("er geht vorwärts, danach winkt er", ["er geht vorwärts", "winkt er"]),
    ("人が歩いてから手を振る", ["人が歩いて", "手を振る"]),
    ("人が歩いて、それから手を振る", ["人が歩いて", "手を振る"]),
    ("手を振る前に歩く", ["歩く", "手を振る"]),
    ("一个人走路然后挥手", ["一个人走路", "挥手"]),
    ("挥手之前走路", ["走路", "挥手"]),
    ("走路之后挥手", ["走路", "挥手"]),
]  # fmt: skip


@pytest.mark.parametrize(("sentence", "parts"), ORDERS)
def test_words_of_order_part_clauses(sentence: str, parts: list[str]):
    assert [clause.text for clause in clauses(sentence)] == parts


@pytest.mark.parametrize(
    ("sentence", "parts"),
    [
        ("a man walks and waves", ["a man walks", "waves"]),
        ("walk, turn left, bow", ["walk", "turn left", "bow"]),
        ("un homme marche et salue", ["un homme marche", "salue"]),
        ("jumps up and down", ["jumps up and down"]),
        ("walks and walks", ["walks and walks"]),
        ("left up, right down", ["left up, right down"]),
        ("walk slowly, sadly", ["walk slowly, sadly"]),
    ],
)
def test_commas_part_only_actions_of_their_own(sentence: str, parts: list[str]):
    assert [clause.text for clause in clauses(sentence, known)] == parts


@pytest.mark.parametrize(
    "sentence",
    [
        "a man stands next to a wall",
        "marche en avant",
        "geh nach links",
        "she waves with two hands",
        "one punch",
        "ein Mann geht",
        "两个人走路",
        "再见",
    ],
)
def test_other_words_are_left_alone(sentence: str):
    assert clauses(sentence) == [Clause(sentence)]


@pytest.mark.parametrize(
    ("sentence", "clause"),
    [
        ("jump three times", Clause("jump", count=3)),
        ("three jumps", Clause("jumps", count=3)),
        ("squats x4", Clause("squats", count=4)),
        ("kick 3x with the left leg", Clause("kick with the left leg", count=3)),
        ("clap twice", Clause("clap", count=2)),
        ("salta tres veces", Clause("salta", count=3)),
        ("saute trois fois", Clause("saute", count=3)),
        ("spring dreimal", Clause("spring", count=3)),
        ("三回ジャンプする", Clause("ジャンプする", count=3)),
        ("跳两次", Clause("跳", count=2)),
        ("turn 90 degrees to the left", Clause("turn to the left", degrees=90)),
        ("turn 180° right", Clause("turn right", degrees=-180)),
        ("a ninety-degree turn to the right", Clause("a turn to the right", degrees=-90)),
        ("a quarter turn to the left", Clause("a quarter turn to the left", degrees=90)),
        ("gira 90 grados a la izquierda", Clause("gira a la izquierda", degrees=90)),
        ("media vuelta a la derecha", Clause("media vuelta a la derecha", degrees=-180)),
        ("tourne de 45 degrés à gauche", Clause("tourne à gauche", degrees=45)),
        ("dreh dich um 90 Grad nach links", Clause("dreh dich nach links", degrees=90)),
        ("左に90度回る", Clause("左に 回る", degrees=90)),
        ("向右转180度", Clause("向右转", degrees=-180)),
        ("turn left by a right angle", Clause("turn left by a right angle", degrees=90)),
        ("half a turn to the right", Clause("half a turn to the right", degrees=-180)),
        (
            "un octavo de vuelta a la izquierda",
            Clause("un octavo de vuelta a la izquierda", degrees=45),
        ),
        ("a double kick", Clause("a kick", count=2)),
        ("3回手をたたく", Clause("手をたたく", count=3)),
        ("三连踢", Clause("踢", count=3)),
        ("walk three metres", Clause("walk", metres=3)),
        ("walk forward 2.5 m", Clause("walk forward", metres=2.5)),
        ("camina dos metros", Clause("camina", metres=2)),
        ("geh 1,5 Meter", Clause("geh", metres=1.5)),
        ("3メートル歩く", Clause("歩く", metres=3)),
        ("向前走三米", Clause("向前走", metres=3)),
        ("walk for five seconds", Clause("walk", seconds=5)),
        ("marche pendant cinq secondes", Clause("marche", seconds=5)),
        ("走五秒钟", Clause("走", seconds=5)),
    ],
)
def test_measures_are_read_and_taken_out(sentence: str, clause: Clause):
    assert clauses(sentence) == [clause]


def test_each_clause_has_its_own_measures():
    assert clauses("walk 3 m, then turn 90° left, then jump twice") == [
        Clause("walk", metres=3),
        Clause("turn left", degrees=90),
        Clause("jump", count=2),
    ]


@pytest.mark.parametrize("sentence", ["walk 900 metres", "turn 5000 degrees", "jump 1000 times"])
def test_what_nobody_means_is_left_to_the_words(sentence: str):
    assert clauses(sentence)[0].plain


@given(st.text(max_size=60))
def test_any_text_has_a_clause(text: str):
    found = clauses(text)
    assert found
    assert all(clause.text or not text.strip() for clause in found)


def actions_of(text: str) -> str | None:
    names = ("walk", "wav", "rais", "jump", "turn", "走", "挥", "歩", "振", "camina", "salud")
    return next((name for name in names if name in text), None)


def done_with_arms(text: str) -> bool:
    return actions_of(text) in ("wav", "rais", "挥", "振", "salud")


@pytest.mark.parametrize(
    ("sentence", "clause"),
    [
        ("walks while waving", Clause("walks", meanwhile="waving")),
        (
            "While walking, he waves with the right hand",
            Clause("walking", meanwhile="he waves with the right hand", side="right"),
        ),
        (
            "waves with the left hand while walking 3 m",
            Clause("walking", metres=3, meanwhile="waves with the left hand", side="left"),
        ),
        (
            "raises the left arm and waves with the right",
            Clause("raises the left arm", meanwhile="waves with the right", side="right"),
        ),
        ("camina mientras saluda", Clause("camina", meanwhile="saluda")),
        ("歩きながら右手を振る", Clause("歩き", meanwhile="右手を振る", side="right")),
        ("一边走一边挥手", Clause("走", meanwhile="挥手")),
    ],
)
def test_what_the_arms_do_meanwhile(sentence: str, clause: Clause):
    assert clauses(sentence, actions_of, done_with_arms) == [clause]


@pytest.mark.parametrize(
    "sentence", ["walks for a while", "turns left and walks right", "jumps while turning"]
)
def test_what_takes_more_than_arms_is_not_done_meanwhile(sentence: str):
    assert not any(each.meanwhile for each in clauses(sentence, actions_of, done_with_arms))
