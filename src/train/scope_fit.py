"""What prompts the training captions are near, as one text tower sees them.

Letters: N prompts, D embed dim.
"""

import numpy as np

from ..shared.data.captions.book import packaged_book
from ..shared.data.captions.word_dropout import insert_babble
from ..shared.data.prepared import PreparedData
from ..shared.model.clip.core import OWN, TextTower
from ..shared.model.clip.pretrained import encode_captions
from ..shared.model.clip.scope import PromptScope, words_of
from ..shared.model.clip.tokenizer import PromptTokenizer

SCOPE_CAPTIONS = 20_000  # at most so many captions teach PromptScope
CALIBRATING = 3_000  # at most, each also with words that nobody knows, and without its key words
LEAST_UNSEEN = 200  # sentences, for a calibration on them
IDEOGRAPHS = (0x4E00, 0x9FFF)
LETTERS = "abcdefghijklmnopqrstuvwxyz"


def fit_scope(
    data: PreparedData,
    languages: tuple[str, ...],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> PromptScope:
    """The scope of a tower that was trained on the captions of `data`.

    It is calibrated on the sentences that `CaptionBook.captions` never gives, or on the captions
    themselves where there are none for these actions.
    """
    book = packaged_book()
    action_of: dict[str, str] = {}
    unseen: dict[str, str] = {}
    for record in {record.group: record for record in data.records("train")}.values():
        held_back = book.held_back(record.labels) if record.labels else {}
        captions = data.captions(record)
        for language in languages:
            for text in held_back.get(language, []):
                unseen.setdefault(text, record.tag)
            for text in captions.get(language, []):
                action_of.setdefault(text, record.tag)
    for text in unseen.keys() & action_of.keys():
        del action_of[text]
    texts = sorted(action_of)
    texts = texts[:: -(-len(texts) // SCOPE_CAPTIONS)]
    embeddings = encode_captions(tower, tokenizer, texts).numpy()
    actions = [action_of[text] for text in texts]
    pretrained = tower.config.text_model not in OWN
    scope = PromptScope.fit(texts, actions, embeddings, pretrained_tower=pretrained)
    if len(scope.actions) < 2:  # nothing to take one for another
        return scope
    if len(unseen) < LEAST_UNSEEN:
        return _calibrated(scope, texts, actions, tower, tokenizer)
    return _calibrated(scope, sorted(unseen), [unseen[t] for t in sorted(unseen)], tower, tokenizer)


def _calibrated(
    scope: PromptScope,
    texts: list[str],
    actions: list[str],
    tower: TextTower,
    tokenizer: PromptTokenizer,
) -> PromptScope:
    """Texts as they are, with made-up words in them, and with made-up words for what tells."""
    rng = np.random.default_rng(0)
    chosen = rng.permutation(len(texts))[:CALIBRATING]
    asked = [texts[row] for row in chosen]
    strange = [insert_babble(text, text, rng) for text in asked]
    empty = [_without_key_words(text, scope, rng) for text in asked]
    prompts = [*asked, *strange, *empty]
    embeddings = encode_captions(tower, tokenizer, prompts).numpy()
    nearest = [scope.actions[row] for row in (embeddings @ scope.means.T).argmax(1)]
    wanted = [actions[row] for row in chosen] * 2
    right = [is_near == wish for is_near, wish in zip(nearest, wanted, strict=False)]
    return scope.calibrated(prompts, embeddings, right + [False] * len(empty))


def _without_key_words(text: str, scope: PromptScope, rng: np.random.Generator) -> str:
    """The text with made-up words for all that tell of an action."""
    found = text.casefold()
    for word in sorted(set(words_of(text)) & scope.key_words.keys(), key=len, reverse=True):
        if ord(word[0]) >= 0x3000:
            other = "".join(map(chr, rng.integers(*IDEOGRAPHS, size=len(word))))
        else:
            other = "".join(rng.choice(list(LETTERS), size=max(3, len(word))))
        found = found.replace(word, other)
    return found
