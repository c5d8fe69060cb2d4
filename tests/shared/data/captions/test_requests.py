"""The hand-written requests: whole, in every language, and drawn by a seed."""

from collections import Counter

import pytest

from src.shared.data.captions.book import packaged_book
from src.shared.data.captions.requests import (
    COMPOSITIONS,
    FREE,
    OUTSIDE,
    SECTIONS,
    drawn,
    load_requests,
    requested,
)
from src.shared.data.captions.schema import normalised

LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_every_kind_of_request(language: str) -> None:
    requests = load_requests((language,))
    sections = Counter(request.section for request in requests)
    assert set(sections) == {*SECTIONS, COMPOSITIONS, OUTSIDE, FREE}
    assert sections[OUTSIDE] >= 60 and sections[FREE] == 60
    plain = Counter(request.action for request in requests if request.section == "plain")
    assert len(plain) >= 90 and min(plain.values()) >= 12
    assert {"walk", "kick", "punch", "jump", "wave", "salsa", "push-up"} <= plain.keys()
    texts = [normalised(request.text) for request in requests if request.section == "plain"]
    assert len(texts) == len(set(texts))


def test_what_is_asked_is_in_the_labels() -> None:
    requests = load_requests(("en",))
    of = {section: [r for r in requests if r.section == section] for section in (*SECTIONS, FREE)}
    assert all("count" in request.labels for request in of["counts"])
    assert all("angle" in request.labels for request in of["angles"])
    assert all({"metres", "seconds"} & request.labels.keys() for request in of["lengths"])
    assert any(request.simultaneous and len(request.parts) == 2 for request in of["sides"])
    assert all(len(r.parts) >= 2 for r in requests if r.section == COMPOSITIONS)
    assert not any(request.parts for request in requests if request.section == OUTSIDE)
    assert sum(not request.parts for request in of[FREE]) == 30


def test_wordings_are_drawn_by_the_seed() -> None:
    plain = [r for r in load_requests(("en", "ja")) if r.section == "plain"]
    few = drawn(plain, 2, seed=0)
    assert few == drawn(plain, 2, seed=0) and few != drawn(plain, 2, seed=1)
    counts = Counter((r.language, str(r.parts)) for r in few)
    assert set(counts.values()) == {2}
    assert len(counts) == len({(r.language, str(r.parts)) for r in plain})


def test_no_training_caption_is_a_request() -> None:
    book = packaged_book()
    for labels in ({"action": "walk"}, {"action": "jump"}, {"action": "backflip"}):
        for language, texts in book.captions(labels, num=60, seed=0).items():
            assert requested(language).isdisjoint(map(normalised, texts))
            assert len(texts) >= 10
    assert requested("tlh") == frozenset()
