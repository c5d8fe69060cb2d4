"""A new action in the shipped text tower, and what that leaves as it was."""

from src.shared.data.captions.book import packaged_book
from src.shared.model.clip.core import TextTower
from src.shared.model.clip.out_of_domain import OutOfDomainDetector
from src.shared.model.clip.pretrained import encode_captions, place_captions
from src.shared.model.generation.motion_generator import TextToMotion
from src.train.places import apart, old_captions, with_new_places, within_reach
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

    unseen, strange = told[1::16], book.outside({*tags, "karate"}, "en")[1::60]
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
