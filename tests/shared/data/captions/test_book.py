"""A user's own caption files: laid over ours, or alone; faults named by file and key."""

import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from src.shared.data.captions.book import CaptionBook, packaged_book
from src.shared.data.captions.schema import parse, tidy
from src.shared.errors import UserError

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


WHO = """
language: it
name: italiano
forms: [plain]
frames: [{form: plain, text: ["{style.who} {verb} {rest}"]}]
slots:
  style: {sad: [tristemente], happy: [allegramente]}
  style.who: {sad: [un uomo triste]}
actions:
  walk:
    name: camminare
    phrases:
      - {verbs: [cammina], rest: ["piano {style}"]}
      - {verbs: [si trascina], rest: ["{style}"], when: {style: sad}}
  other: {name: altro, phrases: [{verbs: ["{action}"], rest: ["{style}"]}]}
mirror: {pairs: [[sinistra, destra]]}
extends: nothing
"""


def _sentences(book: CaptionBook, style: str) -> set[str]:
    texts = book.captions({"action": "walk", "style": style}, num=9, seed=0)["it"]
    return {text.lower().strip(".") for text in texts}


def test_what_the_frame_or_the_condition_says_is_left_out_of_the_rest(tmp_path: Path) -> None:
    assert _sentences(_book(tmp_path, WHO), "sad") == {"un uomo triste cammina piano"}
    plain = _book(tmp_path, WHO.replace("{style.who} {verb}", "{verb}"))
    assert _sentences(plain, "sad") == {"cammina piano tristemente", "si trascina"}


def test_a_dotted_slot_without_words_for_the_value_gives_way(tmp_path: Path) -> None:
    both = WHO.replace('{verb} {rest}"', '{verb} {rest}", "{verb} {rest}"')
    assert _sentences(_book(tmp_path, both), "happy") == {"cammina piano allegramente"}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("{speed}", "{sped}", r"mine\.yaml.*unknown slot \{sped\}.*known:.*speed"),
        ("{verb} {rest}", "{verb", r"mine\.yaml: frames\.0\.text: stray '\{'"),
        ("{verb} {rest}", "(a|{verb}", r"mine\.yaml: frames\.0\.text: parenthesis never closed"),
        ("[cammina]", '["a | b"]', r"actions\.walk\.phrases\.0\.verbs: .*needs 1 forms"),
        ("[plain]", "[plain]\ntenses: {past: {of: tense, steps: [[]]}}", r"tenses\.past\.of: form"),
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


def test_whole_sentences_are_half_of_the_captions(tmp_path: Path) -> None:
    (tmp_path / "en.yaml").write_text(
        "language: en\nsentences:\n  - labels: {action: wave, side: left}\n"
        "    text: [greet with your left hand, left hand says hello, left palm up and shake]\n",
        encoding="utf-8",
    )
    english = CaptionBook.load(tmp_path).language("en")
    left = english.captions({"action": "wave", "side": "left"}, 6, random.Random(0))
    assert len(left) == 6
    assert len({*left, *english.sentences({"action": "wave", "side": "left"})}) == 6
    right = english.captions({"action": "wave", "side": "right"}, 6, random.Random(0))
    assert "right palm up and shake" in right
    both = english.captions({"action": "wave", "side": "both"}, 6, random.Random(0))
    assert not any("palm" in text for text in both)
    once = {"action": "wave", "side": "left", "count": "1", "speed": "normal"}
    assert "left palm up and shake" in english.captions(once, 6, random.Random(0))
    assert len(english.sentences(once)) == 3 and english.sentences({"action": "sing"}) == []


@pytest.mark.parametrize(
    ("language", "forms", "tense", "there"),
    [
        ("en", "stop | stops | stopping | -", "past", "stopped"),
        ("en", "side-step {rest} | - | - | -", "past", "side-stepped {rest}"),
        ("en", "spin | - | - | -", "participle", "spun"),
        ("en", "throw {rest} | - | - | -", "participle", "thrown {rest}"),
        ("en", "- | walks | - | walk", "past", "-"),
        ("fr", "- | - | se tourner {rest}", "past", "s'est tourné{e} {rest}"),
        ("fr", "- | - | courir", "after", "avoir couru"),
        ("fr", "- | - | s'asseoir", "past", "s'est assis{e}"),
        ("es", "- | - | - | sentarse", "past", "se sentó"),
        ("es", "- | - | - | correr", "perfect", "corrido"),
        ("de", "- | dreht sich {rest} um | -", "inverted", "dreht {subject} sich {rest} um"),
        ("de", "- | rennt {rest} | -", "past", "rannte {rest}"),
        ("de", "- | - | sich {rest} umdrehen", "participle", "sich {rest} umgedreht"),
        ("de", "- | - | sich verbeugen", "participle", "sich verbeugt"),
        ("de", "- | - | {rest} applaudieren", "participle", "{rest} applaudiert"),
        ("ja", "- | - | - | 手を振って", "past", "手を振った"),
        ("ja", "- | - | - | 跳んで", "past", "跳んだ"),
    ],
)
def test_tenses_are_made_of_the_forms_of_a_file(
    language: str, forms: str, tense: str, there: str
) -> None:
    assert CaptionBook.load().language(language).content.verb(forms, tense) == there


def test_nothing_is_outside_in_a_language_that_is_not_here() -> None:
    assert CaptionBook.load().outside(["walk"], "tlh") == []


def test_sentences_of_other_actions_are_outside_unless_they_are_a_kind_of_one(
    tmp_path: Path,
) -> None:
    entries = ((action, f"please {action} now") for action in ("walk", "jog", "swim", "other"))
    texts = (f"  - labels: {{action: {action}}}\n    text: [{text}]\n" for action, text in entries)
    (tmp_path / "en.yaml").write_text("language: en\nsentences:\n" + "".join(texts))
    book = CaptionBook.load(tmp_path)
    assert book.outside({"walk"}, "en") == [
        "please jog now", "please other now", "please swim now"
    ]  # fmt: skip
    assert book.outside({"walk", "run"}, "en") == ["please other now", "please swim now"]


def test_one_sentence_in_twenty_calibrates_with_its_mirror_image() -> None:
    book = packaged_book()
    kept = [book.kept_to_calibrate(f"the left foot, {number}", "en") for number in range(2000)]
    images = [book.kept_to_calibrate(f"the right foot, {number}", "en") for number in range(2000)]
    assert 60 < sum(kept) < 140 and kept == images
