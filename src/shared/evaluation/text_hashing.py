"""Captions as bags of hashed n-grams: a tokenizer with nothing to train and no vocabulary file.

Words and word pairs for languages with spaces, runs of one to three characters for Japanese and
Chinese, and word beginnings, which join the inflected forms of one stem.
"""

import re
import unicodedata
import zlib
from collections.abc import Iterator, Sequence
from itertools import pairwise

import torch
from torch import Tensor

NUM_BUCKETS = 8192
STEM = 4  # characters of a word beginning
_WORD = re.compile(r"[^\W_]+")
_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uf900-\ufaff]+")


def _pieces(text: str) -> Iterator[str]:
    plain = unicodedata.normalize("NFKC", text).lower()
    for run in _CJK.findall(plain):
        for size in (1, 2, 3):
            yield from (f"c{run[i : i + size]}" for i in range(len(run) - size + 1))
    words = _WORD.findall(_CJK.sub(" ", plain))
    yield from (f"w{word}" for word in words)
    yield from (f"s{word[:STEM]}" for word in words if len(word) > STEM)
    yield from (f"p{a} {b}" for a, b in pairwise(words))


def caption_buckets(text: str, num_buckets: int = NUM_BUCKETS) -> list[int]:
    """Buckets of a caption's n-grams, the same on every machine; bucket 0 when it has none."""
    return [zlib.crc32(piece.encode()) % num_buckets for piece in _pieces(text)] or [0]


def bag(captions: Sequence[str], num_buckets: int = NUM_BUCKETS) -> tuple[Tensor, Tensor]:
    """Indices [sum of lengths] and offsets [B], as `torch.nn.EmbeddingBag` takes them."""
    rows = [caption_buckets(caption, num_buckets) for caption in captions]
    lengths = torch.tensor([len(row) for row in rows])
    indices = torch.tensor([bucket for row in rows for bucket in row], dtype=torch.long)
    return indices, lengths.cumsum(0) - lengths
