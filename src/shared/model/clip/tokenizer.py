"""PromptTokenizer: prompts -> token ids, by a SentencePiece model of our own or a pretrained one.

Letters: B batch, L tokens. Special ids are XLM-R's: bos 0, pad 1, eos 2, unk 3.
"""

import io
import logging
import unicodedata
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Self

from ...errors import UserError
from ...io.files import atomic_write, load_json, write_json
from ...tensors import Tensor, torch

BOS, PAD, EOS, UNK = 0, 1, 2, 3
MODEL_FILE = "sentencepiece.bpe.model"
META_FILE = "prompt_tokenizer.json"
TOKENIZER_FOLDER = "tokenizer"  # of a model folder
BYTES_AND_SPECIALS = 256 + 4
CHARACTER_SHARE = 0.75  # of the other pieces may be single characters; rarer ones become bytes

log = logging.getLogger(__name__)


class _SentencePiece:
    """A SentencePiece model used directly: transformers' tokenizers cost seconds to import."""

    kind = "sentencepiece"
    pad_id = PAD

    def __init__(self, proto: bytes) -> None:
        from sentencepiece import SentencePieceProcessor

        self.proto = proto
        self.processor = SentencePieceProcessor(model_proto=proto)
        self.vocab_size = int(self.processor.vocab_size())

    def encode(self, prompt: str) -> list[int]:
        return [BOS, *self.processor.encode(prompt), EOS]

    def pieces(self, prompt: str) -> list[str]:
        return list(self.processor.encode(prompt, out_type=str))

    def save(self, folder: Path) -> None:
        with atomic_write(folder / MODEL_FILE) as temporary:
            temporary.write_bytes(self.proto)


class _Pretrained:
    """A tokenizer that transformers reads from a folder or the hub."""

    kind = "transformers"

    def __init__(self, name: str) -> None:
        from transformers import AutoTokenizer

        try:
            self.tokenizer: Any = AutoTokenizer.from_pretrained(name, trust_remote_code=False)
        except (OSError, ValueError, ImportError) as error:
            raise UserError(
                f"cannot load the tokenizer of {name!r} ({str(error).splitlines()[0]});"
                " download the model once, name a local folder, or set clip.text-model to small"
            ) from error
        if self.encode("walk forward") == self.encode("jump back"):
            # transformers can make an all-unknown tokenizer of a folder it half understands
            raise UserError(
                f"the tokenizer of {name!r} gives different prompts the same ids; its folder needs"
                " tokenizer.json beside the weights"
            )
        self.vocab_size = len(self.tokenizer)
        pad = self.tokenizer.pad_token_id
        self.pad_id = PAD if pad is None else int(pad)

    def encode(self, prompt: str) -> list[int]:
        return list(self.tokenizer(prompt)["input_ids"])

    def pieces(self, prompt: str) -> list[str]:
        return list(self.tokenizer.tokenize(prompt))

    def save(self, folder: Path) -> None:
        self.tokenizer.save_pretrained(folder)


class PromptTokenizer:
    """Turns prompts into padded ids; warns when a prompt is longer than `max_tokens`.

    Make one with `train` or `from_pretrained`.
    """

    def __init__(self, backend: _SentencePiece | _Pretrained, max_tokens: int) -> None:
        self._backend = backend
        self.vocab_size = backend.vocab_size  # number of ids
        self.kind = backend.kind  # sentencepiece or transformers: who reads its folder
        self.max_tokens = max_tokens

    @classmethod
    def train(cls, captions: Iterable[str], vocab_size: int, *, max_tokens: int = 48) -> Self:
        """A unigram SentencePiece model of the captions, the same for the same captions.

        Raises:
            UserError: there are no captions, or `vocab_size` has no room for the 256 bytes and
                the characters.
        """
        from sentencepiece import SentencePieceTrainer

        corpus = sorted({caption.strip() for caption in captions} - {""})
        if not corpus:
            raise UserError("cannot train a tokenizer: no captions; prepare the data with captions")
        proto = io.BytesIO()
        try:
            SentencePieceTrainer.train(
                sentence_iterator=iter(_without_rare_characters(corpus, vocab_size)),
                model_writer=proto,
                model_type="unigram",
                vocab_size=vocab_size,
                hard_vocab_limit=False,
                character_coverage=1.0,
                byte_fallback=True,
                normalization_rule_name="nmt_nfkc_cf",
                num_threads=1,
                bos_id=BOS,
                pad_id=PAD,
                eos_id=EOS,
                unk_id=UNK,
                minloglevel=2,
            )
        except RuntimeError as error:
            raise UserError(
                f"clip.text-vocab-size {vocab_size} is too small for {len(corpus)} captions;"
                f" raise it ({str(error).splitlines()[-1].strip()})"
            ) from error
        return cls(_SentencePiece(proto.getvalue()), max_tokens)

    @classmethod
    def from_pretrained(cls, name: str | Path, *, max_tokens: int = 48) -> Self:
        """Read a folder that `save_pretrained` wrote, or a folder or hub name of transformers.

        Raises:
            UserError: nothing readable there.
        """
        meta_file = Path(name) / META_FILE
        if (Path(name).parent / "config.json").is_file() and not Path(name).exists():
            raise UserError(f"{name} is missing; copy the model folder again")
        if not meta_file.is_file():
            return cls(_Pretrained(str(name)), max_tokens)
        try:
            meta = load_json(meta_file)
            kind, max_tokens = str(meta["kind"]), int(meta["max-tokens"])
            if kind == _Pretrained.kind:
                return cls(_Pretrained(str(name)), max_tokens)
            return cls(_SentencePiece((Path(name) / MODEL_FILE).read_bytes()), max_tokens)
        except (OSError, ValueError, OverflowError, LookupError, TypeError, RuntimeError) as error:
            raise UserError(
                f"the tokenizer in {name} is damaged ({error}); copy the whole folder again"
            ) from error

    def save_pretrained(self, folder: str | Path) -> None:
        """Write the tokenizer and its `max_tokens` into a folder."""
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        self._backend.save(folder)
        meta = {"kind": self.kind, "max-tokens": self.max_tokens}
        write_json(folder / META_FILE, meta)

    def pieces(self, prompt: str) -> list[str]:
        """The prompt cut into pieces, without special tokens."""
        return self._backend.pieces(prompt)

    def __call__(self, prompts: Sequence[str], *, warn: bool = False) -> tuple[Tensor, Tensor]:
        """Prompts -> input_ids [B, L] long and attention_mask [B, L] long, L the longest.

        Args:
            prompts: B texts; what is beyond `max_tokens` is cut.
            warn: say which are cut.

        Raises:
            UserError: a prompt is empty.
        """
        rows = [self._encode(index, prompt, warn) for index, prompt in enumerate(prompts)]
        length = max(map(len, rows), default=0)
        ids = torch.full((len(rows), length), self._backend.pad_id, dtype=torch.long)
        mask = torch.zeros_like(ids)
        for row, tokens in enumerate(rows):
            ids[row, : len(tokens)] = torch.tensor(tokens)
            mask[row, : len(tokens)] = 1
        return ids, mask

    def _encode(self, index: int, prompt: str, warn: bool) -> list[int]:
        if not prompt.strip():
            raise UserError(f"prompt {index + 1} is empty; describe the motion in a few words")
        tokens = self._backend.encode(prompt)
        if len(tokens) > self.max_tokens:
            if warn:
                log.warning(
                    "prompt %d has %d tokens; only the first %d are used: %.60s",
                    index + 1,
                    len(tokens),
                    self.max_tokens,
                    prompt,
                )
            tokens = [*tokens[: self.max_tokens - 1], tokens[-1]]
        return tokens


def _without_rare_characters(corpus: Sequence[str], vocab_size: int) -> list[str]:
    """The corpus with blanks for the characters that the vocabulary has no room for."""
    texts = [unicodedata.normalize("NFKC", text).casefold() for text in corpus]
    room = int(CHARACTER_SHARE * (vocab_size - BYTES_AND_SPECIALS))
    counts = Counter(character for text in texts for character in text)
    if len(counts) <= room:
        return list(corpus)
    by_count = sorted(counts, key=lambda character: (-counts[character], character))
    common = set(by_count[: max(room, 0)])
    return ["".join(c if c in common else " " for c in text) for text in texts]
