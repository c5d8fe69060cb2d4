"""Left and right in text: swapped in every form, and only where they are sides."""

import random
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.data.captions.book import CaptionBook, packaged_book
from src.shared.data.captions.language import mirror_labels
from src.shared.errors import UserError

sys.path.insert(0, str(Path(__file__).parent))
from caption_labels import ALL, LANGUAGES, SYNTHETIC
from caption_matcher import CaptionMatcher

combinations = st.sampled_from(ALL)
mirror_text = packaged_book().mirror_text
languages = st.sampled_from(LANGUAGES)


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
    for text in language.captions(labels, 1, random.Random(seed)):
        assert matcher.accepts(mirror_text(text, lang)), text


def test_mirrored_captions_of_one_side_differ() -> None:
    book = CaptionBook.load()
    for labels in SYNTHETIC:
        if "left" in labels.values():
            for lang in LANGUAGES:
                for seed in range(6):
                    for text in book.language(lang).captions(labels, 1, random.Random(seed)):
                        assert mirror_text(text, lang) != text


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
        ("de", "dreht entgegen dem Uhrzeigersinn", "dreht im Uhrzeigersinn"),
        ("de", "eine Linksrunde, ein Rechtshaken", "eine Rechtsrunde, ein Linkshaken"),
        ("es", "un izquierdazo", "un derechazo"),
        ("es", "en sentido contrario al reloj", "en sentido del reloj"),
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
