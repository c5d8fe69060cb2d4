"""PromptTokenizer: ids that differ, six languages, saving, and the user's mistakes."""

import json
import logging
import math

import pytest
import torch

from src.shared.errors import UserError
from src.shared.model.clip.tokenizer import BOS, EOS, META_FILE, MODEL_FILE, PAD, PromptTokenizer


@pytest.fixture(scope="module")
def tokenizer(captions) -> PromptTokenizer:
    return PromptTokenizer.train(captions, 400, max_tokens=16)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("a person walks left", "a person walks right"),
        ("una persona camina", "una persona corre"),
        ("une personne marche", "une personne court"),
        ("eine Person geht", "eine Person läuft"),
        ("人が左を向く", "人が右を向く"),
        ("一个人向左转", "一个人向右转"),
        ("emoji 😀", "emoji 😁"),
    ],
)
def test_two_prompts_give_different_ids(tokenizer: PromptTokenizer, first: str, second: str):
    ids, mask = tokenizer([first, second])
    assert not torch.equal(ids[0], ids[1])
    assert mask.sum() == (ids != PAD).sum()


def test_ids_are_padded_between_xlm_rs_special_ids(tokenizer: PromptTokenizer):
    ids, mask = tokenizer(["walks", "a person walks forward"])
    assert ids.dtype == mask.dtype == torch.long
    assert ids[0, 0] == BOS and ids[1, -1] == EOS and ids[0, -1] == PAD
    assert ids.max() < tokenizer.vocab_size <= 400


def test_case_and_width_do_not_matter(tokenizer: PromptTokenizer):
    ids, _ = tokenizer(["A Person WALKS", "ａ person walks"])
    assert torch.equal(ids[0], ids[1])


def test_training_is_deterministic_and_saving_keeps_everything(captions, tokenizer, tmp_path):
    again = PromptTokenizer.train(reversed(list(captions)), 400, max_tokens=16)
    again.save_pretrained(tmp_path)
    loaded = PromptTokenizer.from_pretrained(tmp_path)
    prompts = [*captions, "something new"]
    assert loaded.max_tokens == 16
    assert torch.equal(loaded(prompts)[0], tokenizer(prompts)[0])


def test_long_prompts_are_cut_with_a_warning(tokenizer: PromptTokenizer, caplog):
    with caplog.at_level(logging.WARNING):
        ids, _ = tokenizer(["walks and walks " * 20], warn=True)
    assert ids.shape == (1, 16) and ids[0, -1] == EOS
    assert "only the first 16 are used" in caplog.text


@pytest.mark.parametrize("prompt", ["", "  \n"])
def test_an_empty_prompt_is_an_error(tokenizer: PromptTokenizer, prompt: str):
    with pytest.raises(UserError, match="prompt 2 is empty"):
        tokenizer(["walk", prompt])


def test_no_captions_and_too_small_a_vocabulary_are_errors(captions):
    with pytest.raises(UserError, match="no captions"):
        PromptTokenizer.train(["", " "], 400)
    with pytest.raises(UserError, match="text-vocab-size 200 is too small"):
        PromptTokenizer.train(captions, 200)


def test_a_small_vocabulary_falls_back_to_bytes(captions):
    tokenizer = PromptTokenizer.train([*captions, *map(chr, range(0x4E00, 0x4F00))], 400)
    ids, _ = tokenizer(["丂", "七"])
    assert not torch.equal(ids[0], ids[1])


def test_damaged_folders_are_errors(tokenizer: PromptTokenizer, tmp_path):
    tokenizer.save_pretrained(tmp_path)
    (tmp_path / MODEL_FILE).write_bytes(b"nonsense")
    with pytest.raises(UserError, match="damaged"):
        PromptTokenizer.from_pretrained(tmp_path)
    for meta in ({"kind": "sentencepiece"}, {"kind": "sentencepiece", "max-tokens": math.inf}):
        (tmp_path / META_FILE).write_text(json.dumps(meta))
        with pytest.raises(UserError, match="damaged"):
            PromptTokenizer.from_pretrained(tmp_path)
    with pytest.raises(UserError, match="cannot load the tokenizer"):
        PromptTokenizer.from_pretrained(tmp_path / "nowhere")


def fast_tokenizer(folder, vocabulary: list[tuple[str, float]]) -> None:
    """A folder as transformers keeps it."""
    from tokenizers import Tokenizer, models, processors
    from transformers import PreTrainedTokenizerFast

    tokenizer = Tokenizer(models.Unigram(vocabulary, unk_id=3))
    tokenizer.post_processor = processors.TemplateProcessing(
        single="<s> $A </s>", special_tokens=[("<s>", 0), ("</s>", 2)]
    )
    PreTrainedTokenizerFast(
        tokenizer_object=tokenizer,
        bos_token="<s>",
        eos_token="</s>",
        pad_token="<pad>",
        unk_token="<unk>",
    ).save_pretrained(folder)


SPECIALS = [(name, 0.0) for name in ("<s>", "<pad>", "</s>", "<unk>")]


def test_pretrained_folders_are_read_by_transformers_and_survive_saving(tmp_path):
    letters = [(letter, -1.0) for letter in "abcdefghijklmnopqrstuvwxyz "]
    fast_tokenizer(tmp_path / "hub", SPECIALS + letters)
    tokenizer = PromptTokenizer.from_pretrained(tmp_path / "hub", max_tokens=12)
    ids, mask = tokenizer(["walk", "jump up"])
    assert ids.tolist()[0][:2] == [0, 4 + ord("w") - ord("a")]
    assert mask.sum(dim=1).tolist() == [6, 9]
    tokenizer.save_pretrained(tmp_path / "ours")
    loaded = PromptTokenizer.from_pretrained(tmp_path / "ours")
    assert loaded.max_tokens == 12
    assert torch.equal(loaded(["walk", "jump up"])[0], ids)


def test_an_all_unknown_tokenizer_is_refused(tmp_path):
    fast_tokenizer(tmp_path, SPECIALS)
    with pytest.raises(UserError, match="same ids"):
        PromptTokenizer.from_pretrained(tmp_path)
