"""A new action in the shipped text tower, and what that leaves as it was."""

import torch

from src.shared.data.captions.book import packaged_book
from src.shared.model.clip.core import TextTower, TokenPairEncoder, keys_of
from src.shared.model.clip.out_of_domain import OutOfDomainDetector
from src.shared.model.clip.pretrained import encode_captions, place_captions
from src.shared.model.generation.motion_generator import TextToMotion
from src.train.places import (
    apart,
    old_captions,
    own_places,
    pooled,
    with_fewer_rows,
    with_new_places,
    within_reach,
)
from src.train.train_action import KEPT


def test_the_shipped_tower_learns_a_new_action_and_still_knows_what_it_knew() -> None:
    starter, book = TextToMotion.from_pretrained("starter", device="cpu"), packaged_book()
    tower, tokenizer, tags = starter.text, starter.tokenizer, starter.card.tags
    asked = book.language("en").sentences({"action": "karate"})
    told = old_captions(tags, ["en"])
    others = book.outside({*tags, "karate"}, "en")[::8]
    mean = encode_captions(tower, tokenizer, asked).mean(0, keepdim=True)
    places = within_reach(tower, apart(mean, [{"action": "karate"}], tags, kept=KEPT))
    taught = with_new_places(
        tower, tokenizer, places, [asked], told[::2], others, steps=100, seed=0
    )
    assert starter.scope is not None
    scope = starter.scope.with_action(
        "karate", asked, encode_captions(taught, tokenizer, asked).numpy(), told[::2]
    )

    def known(tower: TextTower, scope: OutOfDomainDetector, texts: list[str]) -> float:
        embeddings, closeness = place_captions(tower, tokenizer, texts)
        assert closeness is not None
        seen = zip(texts, embeddings.numpy(), closeness.tolist(), strict=True)
        return sum(scope.check(*each).known for each in seen) / len(texts)

    unseen, strange = told[1::16], book.outside({*tags, "karate"}, "en")[::20]
    assert known(taught, scope, asked) > 0.9
    places = [place_captions(each, tokenizer, unseen)[0] for each in (tower, taught)]
    assert ((places[0] - places[1]).norm(dim=-1) < 0.1).float().mean() > 0.97
    assert known(taught, scope, unseen) > known(tower, starter.scope, unseen) - 0.1
    assert known(taught, scope, strange) < 0.1


def test_sentences_by_hand_of_known_actions_stay_but_those_that_calibrate() -> None:
    book = packaged_book()
    language = book.language("en")
    written = set(language.sentences({"action": "squat"}))
    kept = {text for text in written if book.kept_to_calibrate(text, "en")}
    old = set(old_captions(["squat"], ["en"]))
    assert kept and written - kept <= old
    assert not kept & old - set(book.captions({"action": "squat"}, num=16, seed=0)["en"])


def test_a_combination_has_the_place_that_its_captions_go_to_or_else_one_like_the_bare_one() -> (
    None
):
    starter = TextToMotion.from_pretrained("starter", device="cpu")
    tower, tokenizer = starter.text, starter.tokenizer
    pressed = ["press the button", "he pushes a button"]
    left = ["press the button with the left hand", "he pushes a button with his left hand"]
    others = ["nod your head", "he jumps", "they clap", "she shrugs"]
    asked: list[tuple[dict[str, str | int], list[str]]] = [
        ({"action": "press-button"}, pressed),
        ({"action": "press-button", "side": "left"}, left),
        ({"action": "press-button", "side": "left"}, [*left[:1], *others[:3]]),
        ({"action": "press-button", "side": "right"}, others),
        ({"action": "press-button", "count": 2}, others[:1]),
    ]

    def places(*rows: int) -> list[int]:
        labels, texts = zip(*(asked[row] for row in rows), strict=True)
        return own_places(tower, tokenizer, texts, labels).tolist()

    bare, aside = places(0, 1)
    assert bare != aside
    assert places(0, 2) == [bare, aside]  # though most of its captions go elsewhere
    assert places(0, 3) == [bare, bare]
    assert places(0, 4) == [bare, bare]
    assert places(3) != [bare]


def test_a_tower_keeps_the_rows_that_say_most() -> None:
    starter = TextToMotion.from_pretrained("starter", device="cpu")
    tower, tokenizer = starter.text, starter.tokenizer
    assert isinstance(tower.encoder, TokenPairEncoder)
    text = ["a person walks forward"]
    own = keys_of(tokenizer(text)[0]).unique().tolist()
    fewer = with_fewer_rows(tower, dict.fromkeys(own, 10**9), 1000).freeze()
    assert isinstance(fewer.encoder, TokenPairEncoder)
    assert len(fewer.encoder.keys) == fewer.config.text_pairs == 1000
    torch.testing.assert_close(
        pooled(fewer, tokenizer, text), pooled(tower, tokenizer, text), rtol=0, atol=1e-6
    )
    assert torch.equal(fewer.place_keys(), tower.place_keys())
