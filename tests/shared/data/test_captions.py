"""Captions: enough of them, grammatical slots, held-out paraphrases, mirrored text, user files."""

import random
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.data.caption_grammar import normalised, parse, tidy
from src.shared.data.captions import (
    CaptionBook,
    known_actions,
    mirror_labels,
    mirror_text,
    packaged_book,
)
from src.shared.data.synthetic.labels import label_combinations
from src.shared.errors import UserError

sys.path.insert(0, str(Path(__file__).parent))
from caption_matcher import CaptionMatcher

LANGUAGES = ("de", "en", "es", "fr", "ja", "zh")
STYLES = (
    "normal happy sad angry proud not-confident masculine feminine childish elderly tired active "
    "musical giant chimpira youthful"
).split()
SYNTHETIC = label_combinations()
STYLED = [
    {"action": action, "style": style} | more
    for style in STYLES
    for action, more in [
        ("walk", {"direction": "forward"}),
        ("run", {"direction": "forward", "speed": "fast"}),
        ("walk", {"direction": "backward"}),
        ("walk", {"direction": "forward", "turn": "left"}),
        ("wave", {"side": "left"}),
        ("raise", {"side": "both"}),
        ("guide", {}),
        ("bye", {}),
    ]
]
OTHERS = [
    {"action": action}
    for action in "call respond slash dance climb balance dribble shoot swordplay wash bend".split()
]
ALL = SYNTHETIC + STYLED + OTHERS
combinations = st.sampled_from(ALL)
languages = st.sampled_from(LANGUAGES)


@pytest.fixture(scope="module")
def book() -> CaptionBook:
    return CaptionBook.load()


# ---------------------------------------------------------------- training captions


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_synthetic_combination_has_many_captions(book: CaptionBook, lang: str) -> None:
    for labels in SYNTHETIC:
        texts = book.language(lang).captions(labels, 16, random.Random(0))
        assert len({normalised(text) for text in texts}) == 16, labels


@given(combinations, st.integers(0, 9))
def test_captions_are_tidy_and_repeatable(labels: dict[str, str], seed: int) -> None:
    captions = packaged_book().captions(labels, num=4, seed=seed)
    assert captions == packaged_book().captions(labels, num=4, seed=seed)
    assert tuple(captions) == LANGUAGES
    for lang, texts in captions.items():
        assert len(texts) == 4
        for text in texts:
            assert not set(text) & set("{}()|") and "  " not in text and text == text.strip()
            if lang in ("ja", "zh"):
                assert " " not in text


def test_seeds_differ(book: CaptionBook) -> None:
    labels = {"action": "walk", "direction": "forward"}
    assert book.captions(labels, num=4, seed=0) != book.captions(labels, num=4, seed=1)


@pytest.mark.parametrize(
    ("labels", "expected"),
    [
        (
            {"action": "walk", "direction": "backward"},
            {
                "en": "walk backward",
                "es": "camina hacia atrás",
                "fr": "marche en arrière",
                "de": "geh rückwärts",
                "ja": "後ろに歩く",
                "zh": "向后走",
            },
        ),
        (
            {"action": "wave", "side": "left", "speed": "normal"},
            {
                "en": "wave your left hand",
                "es": "saluda con la mano izquierda",
                "fr": "salue de la main gauche",
                "de": "wink mit der linken Hand",
                "ja": "左手を振る",
                "zh": "挥左手",
            },
        ),
    ],
)
def test_canonical_captions_are_the_plainest(
    book: CaptionBook, labels: dict[str, str], expected: dict[str, str]
) -> None:
    assert book.canonical(labels) == expected


@pytest.mark.parametrize(
    ("lang", "labels", "prompts"),
    [
        ("en", {"action": "walk", "direction": "forward"}, ["walk", "a person walks"]),
        ("en", {"action": "run", "speed": "fast"}, ["run fast", "run quickly"]),
        ("en", {"action": "turn", "direction": "left", "angle": "90"}, ["turn left"]),
        (
            "en",
            {"action": "walk", "direction": "backward", "speed": "slow"},
            ["a person is walking backwards slowly", "slowly walk in reverse"],
        ),
        ("es", {"action": "run", "speed": "fast"}, ["corre rápido"]),
        ("de", {"action": "walk", "direction": "backward"}, ["geh rückwärts"]),
        ("ja", {"action": "wave", "side": "left"}, ["左手を振る"]),
        ("zh", {"action": "turn", "direction": "left"}, ["向左转"]),
    ],
)
def test_what_users_type_can_be_a_training_caption(
    book: CaptionBook, lang: str, labels: dict[str, str], prompts: list[str]
) -> None:
    matcher = CaptionMatcher(book.language(lang), labels)
    assert [prompt for prompt in prompts if not matcher.accepts(prompt)] == []


@pytest.mark.parametrize("lang", LANGUAGES)
def test_labels_are_stated(book: CaptionBook, lang: str) -> None:
    """Another value of a label never gives the same caption."""
    rng = random.Random(0)
    for key, a, b, rest in [
        ("direction", "forward", "backward", {"action": "walk", "speed": "slow"}),
        ("speed", "slow", "fast", {"action": "run", "direction": "forward"}),
        ("side", "left", "right", {"action": "raise", "speed": "normal"}),
        ("count", "2", "3", {"action": "jump", "direction": "forward"}),
        ("turn", "left", "right", {"action": "walk", "direction": "forward", "speed": "fast"}),
        ("style", "sad", "happy", {"action": "walk", "direction": "forward"}),
    ]:
        one, other = (
            set(map(normalised, book.language(lang).captions(rest | {key: value}, 150, rng)))
            for value in (a, b)
        )
        assert not one & other, key


def test_unknown_actions_and_values_are_worded_as_they_are(book: CaptionBook) -> None:
    for texts in book.captions({"action": "moon-walk", "style": "dreamy"}, num=4, seed=0).values():
        assert texts and all("moon walk" in t.lower() and "dreamy" in t.lower() for t in texts)


def test_aliases_and_spelling_of_actions(book: CaptionBook) -> None:
    english = book.language("en")
    assert english.find_action("Side_Step") == english.find_action("strafe") == "side-step"


def test_known_actions_are_named() -> None:
    assert known_actions("de")["walk"] == "gehen"
    assert "other" not in known_actions("en")
    expected = set(known_actions("en"))
    assert all(set(known_actions(lang)) == expected for lang in LANGUAGES)


# ---------------------------------------------------------------- held-out paraphrases

CONTROL = [
    {"action": "walk", "direction": "forward"},
    {"action": "walk", "direction": "backward"},
    {"action": "walk"},
    {"action": "run"},
    *(
        {"action": action, "side": side}
        for action in ("wave", "raise")
        for side in ("left", "right")
    ),
    *({"action": "turn", "direction": side, "angle": "90"} for side in ("left", "right")),
    *({"action": "walk", "direction": "forward", "turn": side} for side in ("left", "right")),
]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_control_task_has_paraphrases(book: CaptionBook, lang: str) -> None:
    seen: dict[str, dict[str, str]] = {}
    for labels in CONTROL:
        texts = book.paraphrases(labels)[lang]
        assert len({normalised(text) for text in texts}) >= (6 if lang == "en" else 4), labels
        for text in texts:
            assert seen.setdefault(normalised(text), labels) == labels


def test_the_most_specific_paraphrases_are_taken(book: CaptionBook) -> None:
    labels = {"action": "walk", "direction": "forward", "turn": "right", "speed": "slow"}
    assert book.paraphrases(labels) == book.paraphrases({"action": "walk", "turn": "right"})
    assert book.paraphrases({"action": "moonwalk"}) == {lang: [] for lang in LANGUAGES}


@pytest.mark.parametrize("lang", LANGUAGES)
def test_no_template_writes_a_paraphrase(book: CaptionBook, lang: str) -> None:
    """Not for any labels: the matcher mixes every frame, verb, wording and value."""
    matcher = CaptionMatcher(book.language(lang))
    for entry in book.language(lang).control_tasks:
        for text in entry.text:
            assert not matcher.accepts(text), text


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_matcher_accepts_what_the_templates_write(book: CaptionBook, lang: str) -> None:
    """Without this the test above would prove nothing."""
    rng = random.Random(1)
    language = book.language(lang)
    matcher = CaptionMatcher(language)
    for labels in rng.sample(ALL, 40):
        for text in language.captions(labels, 2, rng):
            assert matcher.accepts(text), text


# ---------------------------------------------------------------- mirrored text


@given(combinations, languages, st.integers(0, 3))
def test_mirroring_twice_changes_nothing(labels: dict[str, str], lang: str, seed: int) -> None:
    for text in packaged_book().language(lang).captions(labels, 4, random.Random(seed)):
        assert mirror_text(mirror_text(text, lang), lang) == text


@given(combinations, languages, st.integers(0, 3))
def test_mirrored_captions_are_captions_of_mirrored_labels(
    labels: dict[str, str], lang: str, seed: int
) -> None:
    language = packaged_book().language(lang)
    matcher = CaptionMatcher(language, mirror_labels(labels))
    assert mirror_text(language.canonical(labels), lang) == language.canonical(
        mirror_labels(labels)
    )
    for text in language.captions(labels, 3, random.Random(seed)):
        assert matcher.accepts(mirror_text(text, lang)), text


def test_mirrored_captions_of_one_side_differ(book: CaptionBook) -> None:
    for labels in SYNTHETIC:
        if "left" in labels.values():
            for lang, texts in book.captions(labels, num=6, seed=0).items():
                assert all(mirror_text(text, lang) != text for text in texts)


@pytest.mark.parametrize(
    ("lang", "text", "mirrored"),
    [
        ("en", "Left, RIGHT or left-handed", "Right, LEFT or right-handed"),
        ("en", "stand upright, all right?", None),
        ("en", "turn right now", "turn left now"),
        ("en", "wave right now, at right angles", None),
        ("en", "sway left and right", None),
        ("en", "he has left the room", None),
        ("en", "Spin counter-clockwise", "Spin clockwise"),
        ("en", "clockwise to the leftmost", "counterclockwise to the rightmost"),
        ("es", "levanta el brazo derecho", "levanta el brazo izquierdo"),
        ("es", "Derecha, izquierdas", "Izquierda, derechas"),
        ("es", "camina todo derecho", None),
        ("es", "anda derecho, bien erguido", None),
        ("es", "gira en sentido horario", "gira en sentido antihorario"),
        ("fr", "lève le bras gauche et la main gauche", "lève le bras droit et la main droite"),
        ("fr", "le pied droit, la jambe droite", "le pied gauche, la jambe gauche"),
        ("fr", "marche tout droit", None),
        ("fr", "va droit devant toi, debout bien droit", None),
        ("fr", "À GAUCHE", "À DROITE"),
        ("de", "linke Linker linken linkes linkem", "rechte Rechter rechten rechtes rechtem"),
        ("de", "nach links, rechtsherum, Linkskurve", "nach rechts, linksherum, Rechtskurve"),
        ("de", "rechtzeitig aufrecht, ein rechter Winkel", None),
        ("de", "gegen den Uhrzeigersinn", "im Uhrzeigersinn"),
        ("ja", "左手を左右に振って右へ", "右手を左右に振って左へ"),
        ("ja", "反時計回りに回る", "時計回りに回る"),
        ("zh", "左手左右摇摆，向右走", "右手左右摇摆，向左走"),
        ("zh", "左顾右盼，顺时针", "左顾右盼，逆时针"),
    ],
)
def test_mirrored_words_and_idioms(lang: str, text: str, mirrored: str | None) -> None:
    assert mirror_text(text, lang) == (text if mirrored is None else mirrored)


def test_mirrored_labels() -> None:
    labels = {"action": "wave-left-hand", "side": "both", "turn": "right", "style": "upright"}
    assert mirror_labels(labels) == {
        "action": "wave-right-hand",
        "side": "both",
        "turn": "left",
        "style": "upright",
    }


def test_an_unknown_language_names_the_others_and_the_way_to_add_it() -> None:
    with pytest.raises(UserError, match=r"'ru'.*de, en, es, fr, ja, zh.*mirror:"):
        mirror_text("налево", "ru")


# ---------------------------------------------------------------- the user's own files

ITALIAN = """
language: it
name: italiano
forms: [plain]
frames: [{form: plain, text: ["{verb} {rest}"]}]
slots: {speed: {slow: [piano], fast: [veloce]}, side.mano: {left: ["la mano sinistra"]}}
actions:
  walk: {name: camminare, phrases: [{verbs: [cammina], rest: ["{speed}"]}]}
  raise: {name: alzare, phrases: [{verbs: [alza], rest: ["{side.mano} {speed}"]}]}
  other: {name: altro, phrases: [{verbs: ["{action}"], rest: ["{speed}"]}]}
mirror: {pairs: [[sinistra, destra]], keep: ["destra e sinistra"]}
"""


def _book(folder: Path, text: str, name: str = "mine.yaml") -> CaptionBook:
    (folder / name).write_text(text, encoding="utf-8")
    return CaptionBook.load(folder / name)


def test_a_new_language_joins_the_packaged_ones(tmp_path: Path) -> None:
    book = _book(tmp_path, ITALIAN)
    assert book.languages == ("de", "en", "es", "fr", "it", "ja", "zh")
    assert book.canonical({"action": "walk", "speed": "slow"})["it"] == "cammina piano"
    assert book.canonical({"action": "raise", "side": "right"})["it"] == "alza la mano destra"
    assert book.mirror_text("a destra", "it") == "a sinistra"


def test_a_file_that_extends_nothing_stands_alone(tmp_path: Path) -> None:
    book = _book(tmp_path, ITALIAN + "extends: nothing\n")
    assert book.languages == ("it",)
    assert CaptionBook.load(tmp_path).languages == ("it",)


def test_a_user_adds_an_action_and_a_style_to_english(tmp_path: Path) -> None:
    book = _book(
        tmp_path,
        "language: en\n"
        "slots: {style: {zombie: [like a zombie]}}\n"
        "actions: {limp: {name: limp, phrases: [{verbs: ['limp | limps | limping | limp'],"
        " rest: ['{direction} {style}']}]}}\n",
    )
    labels = {"action": "limp", "direction": "forward", "style": "zombie"}
    assert book.canonical(labels)["en"] == "limp forward like a zombie"
    assert book.canonical({"action": "walk", "style": "sad"})["en"] == "walk sadly"
    assert CaptionBook.load().language("en").find_action("limp") == "other"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("{speed}", "{sped}", r"mine\.yaml.*unknown slot \{sped\}.*known:.*speed"),
        ("{verb} {rest}", "{verb", r"mine\.yaml: frames\.0\.text: stray '\{'"),
        ("{verb} {rest}", "(a|{verb}", r"mine\.yaml: frames\.0\.text: parenthesis never closed"),
        ("[cammina]", '["a | b"]', r"actions\.walk\.phrases\.0\.verbs: .*needs 1 forms"),
        ("form: plain", "form: noun", r"frames\.0\.form: form 'noun' is not one of plain"),
        ("pairs:", "pears:", r"mine\.yaml: mirror\.(pairs: Field required|pears)"),
        ("name: italiano", "nome: italiano", r"mine\.yaml: (name: Field required|nome)"),
        ("keep: [", "keep: ['(', ", r"mine\.yaml: mirror\.keep"),
        ("  other:", "  others:", r"actions\.other: missing"),
        ("language: it", "language: it\nextends: all", r"extends: 'all'"),
    ],
)
def test_faults_name_file_and_key(tmp_path: Path, old: str, new: str, message: str) -> None:
    with pytest.raises(UserError, match=message) as caught:
        _book(tmp_path, ITALIAN.replace(old, new))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["absent.yaml", "empty"])
def test_a_missing_file_is_named(tmp_path: Path, name: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(UserError, match=name):
        CaptionBook.load(tmp_path / name)


# ---------------------------------------------------------------- the template language


@given(st.text(alphabet="ab{}()| ", max_size=12))
def test_any_template_parses_or_is_refused(template: str) -> None:
    try:
        parse(template)
    except ValueError as error:
        assert repr(template) in str(error)


def test_dropped_slots_leave_nothing_behind() -> None:
    assert tidy(" a  person , walks ,  ", True) == "a person, walks"
    assert tidy("人 が、 、 moon walk を", False) == "人が、moon walkを"
