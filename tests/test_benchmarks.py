"""The development sentences are nobody's else, and the command that reads them works."""

from benchmarks.reading import SENTENCES, figures
from src.shared.config_loader import parse_yaml
from src.shared.data.captions.book import packaged_book
from src.shared.data.captions.requests import load_requests
from src.shared.data.captions.schema import normalised

LANGUAGES = ("en", "es", "fr", "de", "ja", "zh")


def test_development_sentences_are_neither_requests_nor_training() -> None:
    entries = parse_yaml(SENTENCES.read_text(encoding="utf-8"), SENTENCES.name)
    taken = {normalised(request.text) for request in load_requests(LANGUAGES)}
    book, taught = packaged_book(), set[str]()
    for entry in entries:
        written = book.language(entry["language"]).sentences(entry["labels"])
        taught |= {normalised(text) for text in written}
    texts = {normalised(text) for entry in entries for text in entry["text"]}
    assert taught and not texts & (taken | taught)


def test_most_development_sentences_are_read() -> None:
    found = figures("starter")
    assert found["sentences"] == 702 and set(LANGUAGES) <= set(found["read"])
    assert found["read"]["all"] > 0.9
    assert found["warned-of"]["read"] < 0.1 and found["warned-of"]["misread"] > 0.4
    assert all(share > 0.75 for share in found["of-another-hand"].values())
