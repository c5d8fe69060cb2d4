"""TokenPairEncoder: a text as its tokens and pairs of neighbouring tokens, without a transformer.

Bags of words and of pairs are hard to beat where sentences are short and few (Joulin et al. 2017,
Bag of Tricks for Efficient Text Classification, section 2.2). Rows are kept for the tokens and
pairs that training captions share; others add nothing, so a word that nobody knows cannot mislead.

Letters: B batch, L tokens, N rows, H width.
"""

from collections.abc import Iterable
from types import SimpleNamespace

import torch
from torch import Tensor, nn

PAIRS = "pairs"  # text-model name of such a tower
BASE = 1 << 15  # token ids stay below, so that keys are int32
SPECIAL = 3  # ids below are bos, pad and eos
ENTRY_DROPOUT = 0.3  # of tokens and pairs, in training


def keys_of(input_ids: Tensor) -> Tensor:
    """Key of each token and of each pair that begins there [B, L, 2] int32; 0 where there is none.

    Ids from `BASE` on are unknown.
    """
    input_ids = torch.where(input_ids < BASE, input_ids, SPECIAL).int()
    real = input_ids >= SPECIAL
    tokens = torch.where(real, input_ids, 0)
    pairs = (input_ids[:, :-1] + 1) * BASE + input_ids[:, 1:]
    # a pair with bos or eos tells what begins or ends a sentence
    pairs = torch.where((real[:, :-1] | real[:, 1:]), pairs, 0)
    pairs = torch.cat((pairs, torch.zeros_like(pairs[:, :1])), 1)
    return torch.stack((tokens, pairs), -1)


def shared_keys(batches: Iterable[Tensor], least: int) -> Tensor:
    """The keys [N], ascending, that stand in at least so many of the texts."""
    found = [torch.cat([keys_of(row[None]).unique() for row in batch]) for batch in batches]
    keys, counts = torch.cat(found).unique(return_counts=True)
    return keys[(counts >= least) & (keys > 0)]


class TokenPairEncoder(nn.Module):
    """Stands where XLM-R stands: ids in, hidden states out.

    Args:
        num_rows: N.
        hidden_size: H.
    """

    keys: Tensor  # [N] ascending

    def __init__(self, num_rows: int, hidden_size: int) -> None:
        super().__init__()
        self.config = SimpleNamespace(hidden_size=hidden_size)
        self.register_buffer("keys", torch.arange(1, num_rows + 1, dtype=torch.int32))
        self.rows = nn.Embedding(num_rows + 1, hidden_size, padding_idx=num_rows)  # last: unknown
        nn.init.normal_(self.rows.weight[:-1], std=0.1)

    def forward(self, input_ids: Tensor, attention_mask: Tensor) -> SimpleNamespace:
        """[B, L] ids and mask -> `last_hidden_state` [B, L, H]: a token with the pair it begins."""
        keys = keys_of(input_ids)  # [B, L, 2]
        unknown = len(self.keys)
        index = torch.searchsorted(self.keys, keys).clamp(max=unknown - 1)
        index = torch.where(self.keys[index] == keys, index, unknown)
        if self.training:
            dropped = torch.rand(index.shape, device=index.device) < ENTRY_DROPOUT
            index = index.masked_fill(dropped, unknown)
        hidden = self.rows(index).sum(2)  # [B, L, H]
        return SimpleNamespace(last_hidden_state=hidden * attention_mask.unsqueeze(-1))
