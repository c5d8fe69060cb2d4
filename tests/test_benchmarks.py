"""The development sentences are nobody's else, and the command that reads them works."""

from itertools import product
from pathlib import Path

import pytest

from benchmarks.reading import MOODS, SENTENCES, USERS, figures
from src.shared.config_loader import parse_yaml
from src.shared.data.captions.book import packaged_book
from src.shared.data.captions.requests import load_requests
from src.shared.data.captions.schema import normalised

LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")


@pytest.mark.parametrize("file", [SENTENCES, USERS, MOODS])
def test_sentences_that_measure_are_neither_requests_nor_training(file: Path) -> None:
    entries = parse_yaml(file.read_text(encoding="utf-8"), file.name)
    taken = {normalised(request.text) for request in load_requests(LANGUAGES)}
    book, taught = packaged_book(), set[str]()
    every = book.combinations() if file != SENTENCES else [entry["labels"] for entry in entries]
    for code, labels in product(LANGUAGES, every):
        taught |= {normalised(text) for text in book.language(code).sentences(labels)}
    texts = {normalised(text) for entry in entries for text in entry["text"]}
    assert taught and not texts & (taken | taught)


def test_most_development_sentences_are_read() -> None:
    found = figures("starter")
    users = found["users"]
    assert users["read"] > 0.95 and users["wrong-in-silence"] < 0.01
    assert users["warned-though-read"] < 0.12 and users["others-in-silence"] < 0.2
    assert found["moods"]["read"] > 0.85 and found["moods"]["wrong-in-silence"] < 0.07
    assert found["sentences"] == 702 and set(LANGUAGES) <= set(found["read"])
    assert found["read"]["all"] > 0.9
    assert found["warned-of"]["read"] < 0.1 and found["warned-of"]["misread"] > 0.4
    assert all(share > 0.75 for share in found["of-another-hand"].values())
