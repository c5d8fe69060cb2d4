"""Hardening the text tower: the space stays, the tower lands on it, denoisers go on."""

import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import torch
from safetensors.torch import load_file
from tiny_stage import (
    SETTINGS,
    clip_config,
    generation_config,
    tiny_network,
    train_clip,
    train_generation,
)

from src.shared.config_loader import load_train
from src.shared.config_schema import TrainTextConfig
from src.shared.data.captions.book import packaged_book
from src.shared.errors import UserError
from src.shared.model.clip.out_of_domain import words_of
from src.shared.model.clip.pretrained import ClipBundle, place_captions
from src.shared.model.generation.motion_generator import TextToMotion
from src.train import train_text
from src.train.engine import Trainer
from src.train.places import with_manners
from src.train.task import Part
from src.train.train_text import PLAIN, TextTask


def text_config(data: Path, clip: Path, output: Path, *overrides: str) -> TrainTextConfig:
    settings = [*SETTINGS, f"data='{data}'", f"clip='{clip}'", f"output='{output}'"]
    return load_train(
        None, TrainTextConfig, [*settings, "captions-per-group=4", "outside=0", *overrides]
    )


PAIRS = ("tower=pairs", "choice-weight=2", "least-captions=2", "captions-per-group=24")
SIZE = ("steps=200", "batch-size=64", "learning-rate=0.02", "written=0")


@dataclass
class Hardened:
    """A generator, the same one behind a tower of token pairs, and how many texts that reads right
    before and after it was trained."""

    made: Path
    hard: Path
    before: float
    after: float


@pytest.fixture(scope="module")
def paired(prepared: Path, tmp_path_factory: pytest.TempPathFactory) -> Hardened:
    folder = tmp_path_factory.mktemp("paired")
    clip, made, hard = folder / "clip", folder / "made", folder / "hard"
    train_clip(clip_config(prepared, clip, "steps=30"))
    train_generation(generation_config(prepared, clip, made, "steps=2"))
    config = text_config(prepared, made, hard, *PAIRS, *SIZE)
    before = TextTask(config, tiny_network())
    first = before.validation(before.module)["right"]
    return Hardened(made, hard, first, harden(config).figures["right"])


def test_a_place_is_learned_once_whatever_manners_ask_for_it(
    prepared: Path, paired: Hardened, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sad = {"action": "bow", "style": "sad"}
    monkeypatch.setattr(train_text, "with_manners", lambda labels, _: with_manners(labels, [sad]))
    task = TextTask(text_config(prepared, paired.made, tmp_path, *PAIRS, *SIZE), tiny_network())
    shown = {group for group in task.groups if group not in task.plain_of}
    assert task.plain_of and len(task.places) == len(shown) == task.place_of[-1]
    assert set(task.place_of[:-1].tolist()) == set(range(len(shown)))
    group = task.batch(Part(0, 0, 1)).group
    assert ((group >= 0) & (group <= len(shown))).all()


def harden(config: TrainTextConfig) -> TextTask:
    trainer = Trainer(config, lambda c: TextTask(c, tiny_network()), command="again")
    trainer.train()
    assert isinstance(trainer.task, TextTask)
    return trainer.task


def test_more_captions_land_on_their_place(prepared: Path, tmp_path: Path) -> None:
    clip = tmp_path / "clip"
    train_clip(clip_config(prepared, clip, "steps=30"))
    config = text_config(
        prepared,
        clip,
        tmp_path / "hard",
        "steps=150",
        "batch-size=32",
        "learning-rate=0.003",
        "written=0",
    )
    before = TextTask(config, tiny_network())
    first = before.validation(before.module)["right"]
    after = harden(config)
    assert after.figures["right"] > first + 0.05
    torch.testing.assert_close(after.places, before.places)  # the goal did not move
    old, new = ClipBundle.from_pretrained(clip), ClipBundle.from_pretrained(tmp_path / "hard")
    for key, value in old.clip.motion.state_dict().items():
        assert torch.equal(value, new.clip.motion.state_dict()[key])


def test_a_generator_gets_the_new_tower_and_keeps_its_denoiser(
    prepared: Path, tmp_path: Path
) -> None:
    clip, made, hard = tmp_path / "clip", tmp_path / "made", tmp_path / "hard"
    train_clip(clip_config(prepared, clip, "steps=2"))
    train_generation(generation_config(prepared, clip, made, "steps=2"))
    harden(text_config(prepared, clip, hard, "steps=4", f"generator='{made}'"))
    old, new = (load_file(folder / "model.safetensors") for folder in (made, hard))
    changed = {key for key in old if not torch.equal(old[key], new[key])}
    assert changed and all(key.startswith("text.") for key in changed)
    generator = TextToMotion.from_pretrained(hard, device="cpu")
    assert generator.scope is not None and "text-hardening" in generator.card.training
    assert np.isfinite(generator.generate(["walk"], seconds=1.0)[0].quaternions).all()


def test_a_generator_gets_a_tower_of_token_pairs(
    prepared: Path, paired: Hardened, tmp_path: Path
) -> None:
    assert paired.after > paired.before + 0.05
    made, hard = paired.made, paired.hard
    old, new = TextToMotion.from_pretrained(made), TextToMotion.from_pretrained(hard)
    assert new.network.clip.text_model == "pairs" and new.network.clip.text_pairs > 50
    for key, value in old.denoiser.state_dict().items():
        assert torch.equal(value, new.denoiser.state_dict()[key])
    assert new.generate(["a person walks"], seconds=1.5, steps=2)[0].num_frames == 45
    # and a denoiser that is trained behind it is read with it
    given = ("steps=1", f"init='{made}'", "other-tower=true")
    train_generation(generation_config(prepared, hard, tmp_path / "behind", *given))
    behind = TextToMotion.from_pretrained(tmp_path / "behind")
    assert behind.network.clip == new.network.clip
    texts = ["a person walks", "she waves"]
    assert torch.equal(behind.encode_prompts(texts).pooled, new.encode_prompts(texts).pooled)


def test_a_tower_with_places_goes_on_with_more_sentences(
    prepared: Path, paired: Hardened, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own, more = paired.hard, tmp_path / "more"
    old = TextToMotion.from_pretrained(own)
    most = old.network.clip.text_pairs - 5
    config = text_config(
        prepared, own, more, "steps=60", "batch-size=64", "learning-rate=0.02", "weight-decay=0",
        "choice-weight=2", "least-captions=2", "captions-per-group=24", f"most-rows={most}",
    )  # fmt: skip
    task = TextTask(config, tiny_network())
    assert task.plain_of  # manners that no clip shows are asked of the action itself
    for manner, plain in task.plain_of.items():
        rows = [task.groups.index(group) for group in (manner, plain)]
        assert task.place_of[rows[0]] == task.place_of[rows[1]]
        said = [row for row, at in enumerate(task.read_as.tolist()) if at == rows[1] != row]
        both = task.shares[[rows[1], *said]].sum()
        assert task.shares[said].sum() == pytest.approx(config.manners * both)
    fresh = task.module.get_submodule("encoder").get_buffer("keys")
    assert len(fresh) > most  # those of hand-written sentences, too
    assert {each["action"] for each in task.labels.values()} <= set(old.card.tags)
    loss = task.training_step(task.module.eval().train(), task.batch(Part(0, 0, 1)))
    assert loss["kept"] > 0 and torch.isfinite(loss["loss"])
    batch = task.batch(Part(0, 0, 1))
    asked = replace(batch, group=batch.group.clamp(min=0))  # without pieces, which are held anyway
    monkeypatch.setattr(train_text, "SURE", -1.0)
    held = task.training_step(task.module, asked)["kept"]
    monkeypatch.setattr(train_text, "SURE", 2.0)  # what was not sure may come nearer
    assert held > 0 and task.training_step(task.module, asked)["kept"] == 0
    monkeypatch.undo()
    first = task.validation(task.module)["right"]
    assert harden(config).figures["right"] > first - 0.02
    new = TextToMotion.from_pretrained(more)
    assert new.network.clip.text_pairs == most
    for key, value in old.denoiser.state_dict().items():
        assert torch.equal(value, new.denoiser.state_dict()[key])
    assert torch.equal(old.text.place_keys(), new.text.place_keys())
    assert old.scope is not None and new.scope is not None
    assert old.scope.words <= new.scope.words and old.scope.actions == new.scope.actions
    book = packaged_book()
    said = book.captions({"action": "jump"}, num=60, seed=0, whole_sentences=False)["en"]
    assert {word for text in said for word in words_of(text)} <= new.scope.words


def test_going_on_refuses_what_it_would_forget(
    prepared: Path, paired: Hardened, tmp_path: Path
) -> None:
    known = TextToMotion.from_pretrained(paired.hard).card
    for words, reason in (
        (f"without=[{known.tags[0]}]", "leave it out"),
        (f"languages=[{known.languages[0]}]", "would forget"),
        (f"generator='{paired.made}'", "does not know the places"),
    ):
        config = text_config(prepared, paired.hard, tmp_path, words)
        with pytest.raises(UserError, match=reason):
            TextTask(config, tiny_network())


def test_texts_are_read_by_new_keys_and_sent_to_the_places_of_a_denoiser(
    prepared: Path, paired: Hardened, tmp_path: Path
) -> None:
    own, places, read = paired.hard, tmp_path / "new", tmp_path / "read"
    network = tiny_network()
    small = network.clip.model_copy(update={"text_model": "pairs"})
    config = text_config(prepared, tmp_path, places, "clip=null", *SIZE)
    network = network.model_copy(update={"clip": small})
    Trainer(config, lambda c: TextTask(c, network), command="again").train()

    config = text_config(prepared, places, read, *PAIRS, *SIZE, f"generator='{own}'")
    assert harden(config).figures["right"] > 0.5
    old, new = TextToMotion.from_pretrained(own), TextToMotion.from_pretrained(read)
    there, answers = (each.text.get_buffer("places") for each in (old, new))
    assert torch.isin(answers, there).all() and new.text.config.text_place_keys
    assert not (new.text.place_keys()[:, None] == there).all(-1).any()  # keys of its own
    texts = ["a person walks forward", "a person jumps"]
    said = [each.encode_prompts(texts).pooled for each in (old, new)]
    assert ((said[0] * said[1]).sum(-1) > 0.8).all()  # the same requests of the same denoiser
    for key, value in old.denoiser.state_dict().items():
        assert torch.equal(value, new.denoiser.state_dict()[key])


def test_a_tower_of_token_pairs_from_nothing(prepared: Path, tmp_path: Path) -> None:
    network = tiny_network()
    clip = network.clip.model_copy(update={"text_model": "pairs"})
    task = TextTask(
        text_config(prepared, tmp_path, tmp_path / "text", "clip=null"),
        network.model_copy(update={"clip": clip}),
    )
    assert task.bundle.clip.config.clip.text_pairs > 50
    loss = task.training_step(task.module, task.batch(Part(0, 0, 1)))["loss"]
    assert torch.isfinite(loss)


def test_batches_are_a_function_of_step_and_part(prepared: Path, tmp_path: Path) -> None:
    clip = tmp_path / "clip"
    train_clip(clip_config(prepared, clip, "steps=2"))
    task = TextTask(text_config(prepared, clip, tmp_path / "x"), tiny_network())
    one, two, other = (task.batch(Part(step, 0, 1)) for step in (3, 3, 4))
    assert torch.equal(one.input_ids, two.input_ids) and torch.equal(one.group, two.group)
    assert not torch.equal(one.group, other.group)


def test_a_tower_from_nothing_learns_labels_and_a_motion_tower_meets_it(
    prepared: Path, tmp_path: Path
) -> None:
    config = text_config(
        prepared, tmp_path, tmp_path / "text", "clip=null", "steps=150", "batch-size=32",
        "learning-rate=0.003",
    )  # fmt: skip
    before = TextTask(config, tiny_network())
    first = before.validation(before.module)["right"]
    after = harden(config)
    assert after.figures["right"] > first + 0.05
    learned = ClipBundle.from_pretrained(tmp_path / "text")

    train_clip(clip_config(prepared, tmp_path / "clip", "steps=3", f"text='{tmp_path / 'text'}'"))
    met = ClipBundle.from_pretrained(tmp_path / "clip")
    for key, value in learned.clip.text.state_dict().items():
        assert torch.equal(value, met.clip.text.state_dict()[key])
    old, new = learned.clip.motion.state_dict(), met.clip.motion.state_dict()
    assert any(not torch.equal(value, new[key]) for key, value in old.items())
    train_generation(generation_config(prepared, tmp_path / "text", tmp_path / "made", "steps=2"))


def test_actions_of_few_combinations_are_drawn_as_often(prepared: Path, tmp_path: Path) -> None:
    config = text_config(prepared, tmp_path, tmp_path / "text", "clip=null")
    task = TextTask(config, tiny_network())
    shares: dict[str, float] = {}
    for group, share in zip(task.groups, task.shares, strict=True):
        action = task.labels[group]["action"]
        shares[action] = shares.get(action, 0) + share
    numbers = {a: sum(v["action"] == a for v in task.labels.values()) for a in shares}
    most, least = max(numbers, key=numbers.__getitem__), min(numbers, key=numbers.__getitem__)
    ratio = numbers[most] / numbers[least]
    assert shares[most] / shares[least] == pytest.approx(ratio**0.75)
    written = [1 + sum(map(len, some.values())) for some in task.sentences]
    labels = [task.labels[group] for group in task.groups]
    walks = [row for row, each in enumerate(labels) if each["action"] == "walk"]
    plain = [row for row in walks if "style" not in labels[row]]
    few, many = (choose(plain, key=written.__getitem__) for choose in (min, max))
    odds = (written[many] / written[few]) ** 0.5
    assert odds > 1 and task.shares[many] / task.shares[few] == pytest.approx(odds)
    for row in set(walks) - set(plain):
        odds = PLAIN * (written[many] / written[row]) ** 0.5
        assert task.shares[many] / task.shares[row] == pytest.approx(odds)


def test_sentences_of_other_things_come_near_no_place(prepared: Path, tmp_path: Path) -> None:
    clip = tmp_path / "clip"
    train_clip(clip_config(prepared, clip, "steps=3"))
    more = ("tower=pairs", "outside=0.3", "languages=[en]")
    task = harden(text_config(prepared, clip, tmp_path / "text", *SIZE, *more))
    told = task.outside["en"]
    assert told and not any(packaged_book().kept_to_calibrate(text, "en") for text in told)
    bundle = ClipBundle.from_pretrained(tmp_path / "text")
    known = [text for group in task.held_back for text in group.get("en", [])]
    near, far = (
        place_captions(bundle.clip.text, bundle.tokenizer, texts)[1] for texts in (known, told)
    )
    assert near is not None and far is not None
    assert near.median() > far.median() + 0.1


WITHOUT = """
from types import SimpleNamespace
import numpy as np
from src.train.text_stages import _without_key_words
scope = SimpleNamespace(key_words=dict.fromkeys("walk wave jump kick turn".split(), (0,)))
print(_without_key_words("walk, wave, jump, kick and turn", scope, np.random.default_rng(0)))
"""


def test_made_up_words_do_not_depend_on_how_words_hash() -> None:
    """What a detector of prompts learns, and so its file, is the same in every process."""
    said = [
        subprocess.run(
            [sys.executable, "-c", WITHOUT],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert said[0] == said[1] and said[0].strip() and "walk" not in said[0]
