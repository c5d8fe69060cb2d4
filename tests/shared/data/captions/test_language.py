"""Training captions and held-out paraphrases: enough of them, stating the labels, kept apart."""

import random
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.data.captions.book import CaptionBook, packaged_book
from src.shared.data.captions.schema import normalised

sys.path.insert(0, str(Path(__file__).parent))
from caption_labels import ALL, LANGUAGES, OTHERS, STYLES, SYNTHETIC
from caption_matcher import CaptionMatcher

combinations = st.sampled_from(ALL)


@pytest.fixture(scope="module")
def book() -> CaptionBook:
    return CaptionBook.load()


# ---------------------------------------------------------------- training captions


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_synthetic_combination_has_many_captions(book: CaptionBook, lang: str) -> None:
    for labels in SYNTHETIC:
        texts = book.language(lang).captions(labels, 16, random.Random(0))
        assert len({normalised(text) for text in texts}) == 16, labels


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_action_has_wordings_of_its_own(book: CaptionBook, lang: str) -> None:
    language = book.language(lang)
    for labels in OTHERS:
        phrases = language.content.actions[labels["action"]].phrases
        assert sum(len(phrase.verbs) for phrase in phrases) >= 4, labels
        assert len(language.captions(labels, 24, random.Random(0))) == 24, labels


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_style_is_worded_as_adverb_subject_and_gait(book: CaptionBook, lang: str) -> None:
    language = book.language(lang)
    for style in set(STYLES) - {"normal"}:
        for slot in ("style", "style.who", "style.gait"):
            assert language._slots["walk"].get(slot, {}).get(style), (style, slot)


@settings(max_examples=40)
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
        (
            "en",
            {"action": "walk", "style": "sad"},
            ["a sad man walks", "trudge along", "he walks shoulders slumped", "a sad walk"],
        ),
        ("en", {"action": "kick", "side": "left"}, ["swing your left leg up"]),
        ("en", {"action": "roundhouse-kick"}, ["roundhouse kick", "do a roundhouse"]),
        ("es", {"action": "walk", "style": "sad"}, ["una mujer triste camina"]),
        ("fr", {"action": "walk", "style": "elderly"}, ["un vieil homme marche"]),
        ("de", {"action": "walk", "style": "tired"}, ["ein müder Mann geht", "sich schleppen"]),
        ("ja", {"action": "walk", "style": "sad"}, ["とぼとぼと歩く", "悲しい人が歩く"]),
        ("zh", {"action": "walk", "style": "sad"}, ["一个伤心的男人走"]),
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


def test_every_language_words_the_same_actions(book: CaptionBook) -> None:
    actions = {lang: book.language(lang).content.actions for lang in LANGUAGES}
    assert actions["de"]["walk"].name == "gehen"
    assert all(named.keys() == actions["en"].keys() for named in actions.values())


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
        for text in language.captions(labels, 1, rng):  # of one caption none is a whole sentence
            assert matcher.accepts(text), text
