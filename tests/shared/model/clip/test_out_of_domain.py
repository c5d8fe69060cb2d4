"""OutOfDomainDetector: nonsense is flagged, paraphrases are not, and it survives saving."""

import json
from dataclasses import replace

import numpy as np
import pytest

from src.shared.data.captions.book import packaged_book
from src.shared.errors import UserError
from src.shared.model.clip.out_of_domain import (
    FALSE_WARNINGS,
    META_FILE,
    OutOfDomainDetector,
    caption_key,
    words_of,
)

LABELS = [
    {"action": "walk", "direction": "forward", "speed": "slow"},
    {"action": "walk", "direction": "backward"},
    {"action": "walk", "turn": "left"},
    {"action": "run", "speed": "fast"},
    {"action": "turn", "direction": "right", "angle": "90"},
    {"action": "wave", "side": "left"},
    {"action": "raise", "side": "both"},
    {"action": "jump", "count": "2"},
    {"action": "kick", "side": "right"},
    {"action": "bow"},
    {"action": "dance"},
]


def warning_of(
    scope: OutOfDomainDetector, prompt: str, embedding: np.ndarray, closeness: float | None = None
) -> str | None:
    return scope.warning(prompt, scope.check(prompt, embedding, closeness))


@pytest.fixture(scope="module")
def book():
    from src.shared.data.captions.book import CaptionBook

    return CaptionBook.load()


@pytest.fixture(scope="module")
def scope(book) -> OutOfDomainDetector:
    captions, actions = [], []
    for labels in LABELS:
        for texts in book.captions(labels, num=120, seed=0).values():
            captions += texts
            actions += [labels["action"]] * len(texts)
    names = sorted(set(actions))
    one_hot = np.eye(len(names))[[names.index(action) for action in actions]]
    return OutOfDomainDetector.fit(captions, actions, one_hot)


@pytest.mark.parametrize(
    "prompt",
    [
        "purple quarterly tax report",
        "bake a chocolate cake",
        "a person reads a book",
        "the stock market crashed",
        "a person",
        "informe trimestral de impuestos",
        "税務報告書を書いて",
        "给我做一个三明治",
        "?!",
    ],
)
def test_far_prompts_are_flagged(scope: OutOfDomainDetector, prompt: str):
    embedding = np.eye(len(scope.actions))[scope.actions.index("bow")]
    result = scope.check(prompt, embedding)
    assert not result.known
    assert result.nearest[0] == "bow"
    assert len(result.nearest) == 3


def test_places_tell_apart_what_lies_on_one_side_of_its_mean():
    rng = np.random.default_rng(0)
    spread = np.array([0.05, 0.6, 0.05])
    first = np.array([1.0, 0.5, 0.0]) + rng.normal(size=(300, 3)) * spread
    second = np.array([1.0, -0.2, 0.5]) + rng.normal(size=(300, 3)) * spread
    points = np.concatenate((first, second))
    labels = ["first"] * 300 + ["second"] * 300
    scope = OutOfDomainDetector.fit([f"do the {each} thing" for each in labels], labels, points)
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    found = [scope.actions[row] for row in (unit @ scope.means.T).argmax(1)]
    assert np.mean([one == other for one, other in zip(found, labels, strict=True)]) > 0.97


def test_clips_without_an_action_are_not_named(scope: OutOfDomainDetector):
    unlabelled = replace(scope, actions=("", *scope.actions[1:]))
    result = unlabelled.check("bake a chocolate cake", np.eye(len(scope.actions))[0])
    assert len(result.nearest) == 3 and all(result.nearest)


def test_clips_without_an_action_are_no_rival(scope: OutOfDomainDetector):
    unlabelled = replace(scope, actions=("", *scope.actions[1:]))
    cosines = np.linspace(1, 0, len(scope.actions))
    assert unlabelled.ranked(cosines) == list(range(1, len(scope.actions)))
    first, margin, *_ = unlabelled.evidence("a person walks", cosines)
    assert first == cosines[1] and margin == pytest.approx(cosines[1] - cosines[2])


def test_actions_do_not_make_way_for_clips_without_one():
    """Captions of clips that nobody labelled tell of walks, too; walks stay where they were."""
    rng = np.random.default_rng(0)
    points = np.repeat(np.eye(3)[[0, 1]], 200, axis=0) + rng.normal(size=(400, 3)) * 0.1
    labels = ["walk"] * 200 + ["stand"] * 200
    texts = [f"he does {label}" for label in labels]
    alone = OutOfDomainDetector.fit(texts, labels, points)
    found = OutOfDomainDetector.fit(
        [*texts, *["he is out and about"] * 200],
        [*labels, *[""] * 200],
        points[[*range(400), *range(200)]],
    )
    assert found.actions == ("", "stand", "walk")
    np.testing.assert_allclose(found.means[1:], alone.means, atol=1e-3)


def test_paraphrases_are_known_in_every_language(scope: OutOfDomainDetector, book):
    sentences = [
        text for labels in LABELS for texts in book.paraphrases(labels).values() for text in texts
    ]
    flagged = [text for text in sentences if not scope.check(text, np.ones(9)).known]
    assert len(sentences) > 20
    assert len(flagged) <= 0.05 * len(sentences), flagged


def test_held_out_captions_calibrate_it(scope: OutOfDomainDetector):
    assert scope.false_alarms <= 0.05  # sentences written by hand share few words


def test_other_forms_of_a_word_count_among_known_words(scope: OutOfDomainDetector):
    assert scope.check("a person walked", np.ones(9)).known


def test_a_filler_is_no_form_of_a_key_word(scope: OutOfDomainDetector):
    named = replace(scope, key_words={**scope.key_words, "perso": (0,)})
    assert {"a", "person"} <= named.fillers
    assert not named.familiar("a person")
    assert named.familiar("the persos"), "an untrained word may be another form of it"


def test_a_pretrained_tower_knows_synonyms(scope: OutOfDomainDetector):
    captions, actions = ["walks", "runs"] * 10, ["walk", "run"] * 10
    embeddings = np.tile(np.eye(2), (10, 1))
    with_tower = OutOfDomainDetector.fit(captions, actions, embeddings, pretrained_tower=True)
    without = OutOfDomainDetector.fit(captions, actions, embeddings)
    assert with_tower.check("ambles", np.array([0.0, 1.0])).known
    assert not with_tower.check("ambles", np.array([0.5, -0.5])).known
    assert not without.check("ambles", np.array([0.0, 1.0])).known


def test_words_of_six_scripts():
    assert words_of("Éric's WAVE ２") == ["éric", "s", "wave", "2"]
    assert words_of("手を振る") == ["手を", "を振", "振る", "手", "振"]
    assert words_of("") == []


def test_clips_that_nobody_labelled_are_judged_by_their_words():
    scope = OutOfDomainDetector.fit(["clip one", "clip two"], ["", ""], np.eye(2))
    assert scope.check("clip one", np.eye(2)[0], 0.9).nearest == []


def test_saving_keeps_the_verdicts(scope: OutOfDomainDetector, tmp_path):
    scope.save_pretrained(tmp_path)
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None
    assert (loaded.key_words, loaded.words) == (scope.key_words, scope.words)
    assert np.allclose(loaded.means, scope.means, atol=1e-3)
    (tmp_path / META_FILE).write_text("{}")
    with pytest.raises(UserError, match=r"actions: Field required; .*another version") as error:
        OutOfDomainDetector.from_pretrained(tmp_path)
    assert "pydantic" not in str(error.value)
    assert OutOfDomainDetector.from_pretrained(tmp_path / "nowhere") is None


def test_an_older_folder_judges_as_it_did(scope: OutOfDomainDetector, tmp_path):
    """Before there were fillers only key words told, not trained words alone; and words stood in
    lists."""
    scope.save_pretrained(tmp_path)
    meta = json.loads((tmp_path / META_FILE).read_text())
    del meta["fillers"]
    meta["words"] = meta["words"].split()
    (tmp_path / META_FILE).write_text(json.dumps(meta))
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None and loaded.fillers == loaded.words
    assert loaded.check("a person bows", np.ones(9)).known
    assert not loaded.check("a person", np.ones(9)).known


def test_no_captions_is_an_error():
    with pytest.raises(UserError, match="no captions"):
        OutOfDomainDetector.fit([], [], np.zeros((0, 4)))


def test_evidence_is_weighed_where_right_answers_are_known():
    rng = np.random.default_rng(0)
    verbs = {"walk": ["walks", "strolls"], "jump": ["jumps", "leaps"], "wave": ["waves", "greets"]}
    captions, actions, embeddings = [], [], []
    for place, (action, words) in enumerate(verbs.items()):
        for number in range(40):
            captions.append(f"a person {words[number % 2]} by tree{number}")
            actions.append(action)
            embeddings.append(np.eye(3)[place] + 0.1 * rng.normal(size=3))
    scope = OutOfDomainDetector.fit(captions, actions, np.array(embeddings))
    empty = ["a person qzx by house"] * 60
    between = np.abs(rng.normal(size=(60, 3))) * 0.1 + 0.5
    weighed = scope.calibrated(
        captions + empty, np.concatenate((embeddings, between)), [True] * 120 + [False] * 60
    )
    known = [weighed.check(*each).known for each in zip(captions, embeddings, strict=True)]
    assert np.mean(known) > 0.9
    assert not weighed.check(empty[0], between[0]).known
    # a word of one action at the place of another is no longer enough
    assert not weighed.check("a person jumps", np.array([0.55, 0.5, 0.5])).known


def test_what_comes_near_no_place_is_warned_of(scope: OutOfDomainDetector):
    """Whatever its words; how sure its action is does not change by it."""
    rng = np.random.default_rng(0)
    walk = np.eye(len(scope.actions))[scope.actions.index("walk")]
    texts = ["a person walks"] * 100
    closeness = np.concatenate((rng.uniform(0.7, 1, 50), rng.uniform(0, 0.5, 50)))
    right = [True] * 50 + [False] * 50
    warning = scope.with_warnings(texts, np.tile(walk, (100, 1)), closeness, right)
    near, far = (warning.check(texts[0], walk, each) for each in (0.9, 0.2))
    assert (
        near.known
        and not far.known
        and "far from anything" in (warning_of(warning, texts[0], walk, 0.2) or "")
    )
    assert near.certainty == far.certainty == scope.check(texts[0], walk).certainty
    assert warning.check(texts[0], walk).known  # a tower without places
    alarms = [not warning.check(t, walk, c).known for t, c in zip(texts, closeness, strict=True)]
    assert sum(alarms[:50]) <= FALSE_WARNINGS * 50 + 1 and all(alarms[50:])


def test_weights_survive_saving(scope: OutOfDomainDetector, tmp_path):
    asked = ["walks", "flies"], np.eye(len(scope.means))[:2]
    weighed = scope.calibrated(*asked, [True, False])
    weighed = weighed.with_warnings(*asked, np.array([0.9, 0.1]), [True, False])
    weighed.save_pretrained(tmp_path)
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None
    assert loaded.weights == weighed.weights
    assert loaded.warning_weights == weighed.warning_weights


def test_an_action_that_seldom_comes_out_is_warned_of(scope: OutOfDomainDetector, tmp_path):
    measured = replace(scope, reliability={"kick": 1 / 12, "bow": 0.9})
    place = np.eye(len(scope.actions))
    kick, bow = place[scope.actions.index("kick")], place[scope.actions.index("bow")]
    result = measured.check("a person kicks", kick)
    assert not result.known and result.unreliable == "kick"
    assert "'kick', which this model shows in about 8% of tries" in (
        warning_of(measured, "a person kicks", kick) or ""
    )
    assert warning_of(measured, "a person bows", bow) is None
    assert warning_of(scope, "a person kicks", kick) is None  # nobody measured it
    measured.save_pretrained(tmp_path)
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None and loaded.reliability == measured.reliability


def test_a_training_caption_is_not_unknown(scope: OutOfDomainDetector, tmp_path):
    """Where a tower of a few steps tells nothing, and so every prompt would be warned of."""
    doubting = replace(scope, weights=(0.0, 0.0, 0.0, 0.0, 0.0, -9.0))
    place = np.eye(len(scope.actions))
    kick, bow = place[scope.actions.index("kick")], place[scope.actions.index("bow")]
    drawn = packaged_book().captions({"action": "bow"}, num=500, seed=0)["en"]
    plain = [text for text in sorted(drawn, key=len) if text.isascii() and text.islower()]
    caption = next(text for text in plain if caption_key(text) in scope.captions)
    assert warning_of(doubting, caption, bow) is None
    assert warning_of(doubting, caption.capitalize() + "!", bow) is None
    assert doubting.check(caption, bow).certainty > 0
    assert "far from anything" in (warning_of(doubting, f"{caption} in an office", bow) or "")
    result = doubting.check(caption, kick)
    assert not result.known and result.mistaken == "bow" and result.certainty < 0
    told = warning_of(doubting, caption, kick) or ""
    assert "is a training caption of 'bow' that this model takes for 'kick'" in told
    assert "far from anything" not in told
    doubting.save_pretrained(tmp_path)
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None and loaded.captions == scope.captions
    older = replace(doubting, captions={})
    assert "far from anything" in (warning_of(older, caption, bow) or "")
    older.save_pretrained(tmp_path)
    loaded = OutOfDomainDetector.from_pretrained(tmp_path)
    assert loaded is not None and not loaded.captions


def test_a_new_actions_captions_are_known_to_the_word(scope: OutOfDomainDetector):
    place = np.full((1, len(scope.actions)), 1.0)
    more = scope.with_action("crawl", ["a person crawls"], place, ["a person bows"])
    assert more.captions[caption_key("A person crawls.")] == len(scope.actions)
    assert scope.captions.items() <= more.captions.items()


def test_one_gesture_under_two_names_is_no_rival_of_itself():
    texts = ["bye now", "wave now", "walk now"] * 4
    names = ["bye", "wave", "walk"] * 4
    places = np.array([[1.0, 0.3], [1.0, 0.2], [0.0, 1.0]] * 4)
    scope = OutOfDomainDetector.fit(texts, names, places)
    weighed = replace(scope, weights=(0.0, 1.0, 0.0, 1.0, 0.0, -0.5))  # margin and agreement
    between = np.array([1.0, 0.25])
    for word in ("bye", "wave"):
        found = weighed.check(word, between)
        assert set(found.nearest[:2]) == {"bye", "wave"}
        assert found.known and found.certainty > 0.9
    assert weighed.check("walk", between).certainty < 0
