"""Tokens and pairs of them as hidden states: what is shared counts, what nobody knows does not."""

import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_schema import PAIRS, ClipConfig
from src.shared.model.clip.core import TextTower, TokenPairEncoder, counted_keys, keys_of

BOS, PAD, EOS = 0, 1, 2
ids = st.lists(st.integers(3, 500), min_size=1, max_size=9)


def row(words: list[int], length: int = 12) -> torch.Tensor:
    return torch.tensor([[BOS, *words, EOS, *[PAD] * (length - len(words) - 2)]])


def shared_keys(texts: list[torch.Tensor], least: int) -> torch.Tensor:
    keys, counts = counted_keys(texts)
    return keys[counts >= least]


def encoder(*texts: list[int], least: int = 1) -> TokenPairEncoder:
    keys = shared_keys([row(text) for text in texts], least)
    made = TokenPairEncoder(len(keys), 8)
    made.keys = keys
    return made.eval()


@given(ids)
def test_padding_changes_nothing(words: list[int]) -> None:
    made = encoder(words)
    short, long = row(words, len(words) + 2), row(words, 20)
    first = made(short, short != PAD).last_hidden_state
    second = made(long, long != PAD).last_hidden_state
    assert torch.equal(second[:, : first.shape[1]], first)
    assert not second[:, first.shape[1] :].any()


@given(ids, ids)
def test_order_counts_and_unknown_tokens_do_not(words: list[int], others: list[int]) -> None:
    made = encoder(words)
    strange = [word + 1000 for word in others]
    text = row([*words, *strange], 24)
    hidden = made(text, text != PAD).last_hidden_state[0]
    assert not hidden[len(words) + 2 : -1].any()
    there, back = row([7, 8, 9]), row([9, 8, 7])
    pairs = {int(key) for key in keys_of(there)[..., 1].unique() if key}
    assert pairs.isdisjoint({int(key) for key in keys_of(back)[..., 1].unique() if key})


def test_a_row_is_kept_where_enough_texts_share_it() -> None:
    texts = [row([5, 6]), row([5, 6]), row([6, 7])]
    assert len(shared_keys(texts, 3)) == 1  # token 6
    assert len(shared_keys(texts, 2)) == 5  # 5, 6, their pair, bos 5, 6 eos
    assert shared_keys(texts, 1).tolist() == sorted(shared_keys(texts, 1).tolist())


def test_one_text_counts_a_key_once() -> None:
    assert len(shared_keys([row([5, 5, 5])], 2)) == 0


def test_a_text_lies_between_places_that_are_alike_only() -> None:
    """Near a walk, another walk and a bow it is between the walks, with most of the probability."""
    config = ClipConfig(text_model=PAIRS, text_pairs=3, text_hidden_size=8, text_places=3)
    tower = TextTower(config, 8).eval()
    walk, bow = torch.eye(8)[:2]
    other = torch.tensor([0.8, 0, 0.6, 0, 0, 0, 0, 0])
    tower.get_buffer("places").copy_(torch.stack([walk, other, bow]))
    with torch.no_grad():
        tower.text_proj.weight.copy_(torch.eye(8))
        tower.text_proj.bias.zero_()
        text = torch.tensor([[0.70, 0.705, 0.2, 0, 0, 0, 0, 0], [0.1, 1, 0, 0, 0, 0, 0, 0]])
        pooled = tower.pool(text)
    assert torch.allclose(pooled.norm(dim=-1), torch.ones(2))
    assert pooled[0] @ bow == 0 and pooled[0] @ walk < 0.999 and pooled[0, 2] > 0.1
    assert torch.allclose(pooled[1], bow)
