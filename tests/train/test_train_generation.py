"""Generation training on a little data: it learns, resumes exactly, its folder generates.

Of the random masks of known entries every kind occurs, and none leaves the clip.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from safetensors.torch import load_file
from tiny_stage import clip_config, generation_config, tiny_network, train_clip, train_generation

from src.shared.config_schema import ConstraintShares
from src.shared.data.prepared import PreparedData
from src.shared.data.text_motion import TextMotionDataset
from src.shared.errors import UsageError, UserError
from src.shared.model.clip.out_of_domain import caption_key
from src.shared.model.clip.pretrained import ClipBundle, tower_hash
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import FORWARD, HEIGHT, LEFT_CONTACT, ROOT_ROW, YAW_RATE
from src.shared.motion.skeleton import NUM_JOINTS
from src.train.task import Part, generator
from src.train.text_stages import fit_scope, with_labels
from src.train.train_generation import GenerationTask, draw_known, spread_timesteps


@pytest.fixture(scope="session")
def clip(prepared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("runs") / "clip"
    train_clip(clip_config(prepared, folder, "steps=2"))
    return folder


@pytest.mark.usefixtures("held_back")
def test_it_learns_and_its_folder_generates(prepared: Path, clip: Path, tmp_path: Path) -> None:
    settings = ("steps=40", "learning-rate=0.005", "log-every=10", "validate-every=20")
    train_generation(generation_config(prepared, clip, tmp_path, *settings))
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    losses = [line["validation/loss"] for line in lines if "validation/loss" in line]
    assert len(losses) == 2 and losses[1] < losses[0]
    for step in ("00000020", "00000040"):
        samples = tmp_path / "samples" / step
        assert (samples / "01.bvh").exists() and (samples / "index.html").exists()

    made = TextToMotion.from_pretrained(tmp_path, device="cpu")
    prompts = ["a person walks forward", "una persona salta"]
    motions = made.generate(prompts, seconds=1.0, num_samples=2)
    assert [motion.text for motion in motions] == [prompts[0]] * 2 + [prompts[1]] * 2
    assert all(np.isfinite(m.quaternions).all() and m.num_frames == 30 for m in motions)
    assert made.card.trained and made.scope is not None and made.card.tags


@torch.no_grad()
def test_the_scope_knows_the_words_of_every_clip(prepared: Path, clip: Path) -> None:
    """Clips of one label group have sentences of their own."""
    data, bundle = PreparedData.open(prepared), ClipBundle.from_pretrained(clip)
    said = {record.id: f"zig{number} zags" for number, record in enumerate(data.records("train"))}
    data.__dict__["_all_records"] = [
        replace(record, captions={"en": [said[record.id]]}) if record.id in said else record
        for record in data.records()
    ]
    assert len({record.group for record in data.records("train")}) < len(said)
    scope = fit_scope(data, ("en",), bundle.clip.text, bundle.tokenizer)
    assert {caption_key(text) for text in said.values()} <= scope.captions.keys()
    assert {text.split()[0] for text in said.values()} <= scope.words


@torch.no_grad()
def test_captions_stand_for_actions_where_no_clip_has_labels(prepared: Path, clip: Path) -> None:
    data, bundle = PreparedData.open(prepared), ClipBundle.from_pretrained(clip)
    verbs = [
        "zigs",
        "zags",
        "flips",
        "nods",
        "crawls",
        "swims",
        "prays",
        "sings",
        "climbs",
        "digs",
        "mows",
        "rows",
    ]
    said = [f"a person {verb} about" for verb in verbs]
    data.__dict__["_all_records"] = [
        replace(record, tag="", labels={}, captions={"en": [said[number % 12]]})
        for number, record in enumerate(data.records())
    ]
    scope = fit_scope(data, ("en",), bundle.clip.text, bundle.tokenizer)
    assert {*scope.actions} == {*said} and not {"a", "person"} & scope.key_words.keys()
    assert {*verbs} <= scope.key_words.keys()


def test_fine_tuning_starts_where_another_run_ended(
    prepared: Path, clip: Path, tmp_path: Path
) -> None:
    first = tmp_path / "first"
    train_generation(generation_config(prepared, clip, first, "steps=3", "learning-rate=0.01"))
    trained = TextToMotion.from_pretrained(first, device="cpu")
    trained.mean += 0.5  # as if it had been trained on other data, with other tags
    trained.card = trained.card.model_copy(update={"tags": tuple(reversed(trained.card.tags))})
    trained.save_pretrained(tmp_path / "other")
    config = generation_config(prepared, clip, tmp_path / "second", f"init={tmp_path / 'other'}")
    task = GenerationTask(config, tiny_network())
    denoiser = task.module.get_submodule("denoiser")
    state, old = denoiser.state_dict(), trained.denoiser.state_dict()
    tags = "tag_embed.embedding.weight"
    assert all(torch.equal(state[key], old[key]) for key in state if key != tags)
    turned = list(range(len(task.data.tags)))[::-1]
    assert torch.equal(state[tags], old[tags][[*turned, -1]])
    assert torch.equal(task.mean, trained.mean)
    plain = GenerationTask(generation_config(prepared, clip, tmp_path / "p"), tiny_network())
    ours, theirs = (t.batch(Part(0, 0, 1)).clean for t in (task, plain))
    assert torch.allclose(ours * task.std + task.mean, theirs * plain.std + plain.mean, atol=1e-5)

    wider = tiny_network("generation.num-layers=2")
    with pytest.raises(UserError, match="is another network"):
        GenerationTask(config, wider)


def test_what_ships_can_be_gone_on_from_without_its_clip_folder(
    prepared: Path, clip: Path, tmp_path: Path
) -> None:
    first = tmp_path / "first"
    trained = train_generation(generation_config(prepared, clip, first, "steps=2"))
    config = generation_config(prepared, clip, tmp_path / "second", f"init={first}", "clip=null")
    task = GenerationTask(config, tiny_network())
    assert tower_hash(task.tower) == tower_hash(trained.tower)
    assert task.tokenizer(["a person walks"])[0].equal(trained.tokenizer(["a person walks"])[0])


def test_another_text_tower_is_refused_unless_it_is_meant(
    prepared: Path, clip: Path, tmp_path: Path
) -> None:
    first, other = tmp_path / "first", tmp_path / "other"
    train_generation(generation_config(prepared, clip, first, "steps=2"))
    bundle = ClipBundle.from_pretrained(clip)
    torch.nn.init.normal_(bundle.clip.text.text_proj.weight)
    bundle.save_pretrained(other)
    settings = (prepared, other, tmp_path / "second", f"init={first}")
    with pytest.raises(UsageError, match="another text tower"):
        GenerationTask(generation_config(*settings), tiny_network())
    GenerationTask(generation_config(*settings, "other-tower=true"), tiny_network())


@pytest.mark.parametrize("precision", ["no", "bf16"])
def test_resuming_is_bitwise_the_same(
    prepared: Path, clip: Path, tmp_path: Path, precision: str
) -> None:
    same = (f"precision={precision}", "lr-schedule=constant", "validation-prompts=[jump]")
    whole, halves = tmp_path / "whole", tmp_path / "halves"
    train_generation(generation_config(prepared, clip, whole, *same))
    train_generation(generation_config(prepared, clip, halves, *same, "steps=4"))
    train_generation(generation_config(prepared, clip, halves, *same), resume=True)
    for name in ("model", "ema", "optimizer"):
        file = f"checkpoints/step-00000006/{name}.safetensors"
        first, second = load_file(whole / file), load_file(halves / file)
        assert all(torch.equal(first[key], second[key]) for key in first)


def test_clips_without_labels_do_not_teach_what_a_place_means(prepared: Path) -> None:
    data = PreparedData.open(prepared)
    assert with_labels(data) is None  # all have some
    bare = {record.id for record in data.records("train")[::3]}
    data.__dict__["_all_records"] = [
        replace(record, labels={}) if record.id in bare else record for record in data.records()
    ]
    only = with_labels(data)
    assert only is not None
    clips = TextMotionDataset(data, "train", max_frames=400, only=only)
    left = {record.id for record in clips.records}
    assert left and not left & bare
    data.__dict__["_all_records"] = [replace(r, labels={}) for r in data.records()]
    assert with_labels(data) is None  # captions of somebody's own, and nothing else


def test_tokens_epsilon_and_all_losses(prepared: Path, clip: Path, tmp_path: Path) -> None:
    network = tiny_network(
        "generation.text-conditioning=tokens", "generation.prediction-type=epsilon"
    )
    losses = "{velocity: 1, geodesic: 1, position: 1, foot-contact: 1, foot-slide: 1}"
    config = generation_config(prepared, clip, tmp_path, "steps=2", f"losses={losses}")
    train_generation(config, network)
    line = json.loads((tmp_path / "log.jsonl").read_text().splitlines()[0])
    assert {"reconstruction", "velocity", "geodesic", "foot_slide"} <= line.keys()
    TextToMotion.from_pretrained(tmp_path, device="cpu")


def test_without_a_root_track(prepared: Path, tmp_path: Path) -> None:
    network = tiny_network("root-track=false")
    train_clip(clip_config(prepared, tmp_path / "clip", "steps=2"), network)
    config = generation_config(prepared, tmp_path / "clip", tmp_path / "generation", "steps=2")
    train_generation(config, network)
    made = TextToMotion.from_pretrained(tmp_path / "generation", device="cpu")
    assert made.sample_features(["wave"], seconds=1.0)[0].shape == (30, 22, 6)


def test_dropped_rows_have_neither_text_nor_tag(prepared: Path, clip: Path, tmp_path: Path) -> None:
    config = generation_config(
        prepared, clip, tmp_path, "condition-dropout=0.5", "tag-dropout=0", "batch-size=64"
    )
    task = GenerationTask(config, tiny_network())
    batch = task.batch(Part(1, 0, 1))
    assert 10 < int(batch.drop.sum()) < 54
    assert torch.equal(batch.tag == task.num_tags, batch.drop)


def test_the_text_tower_is_not_trained(prepared: Path, clip: Path, tmp_path: Path) -> None:
    task = train_generation(generation_config(prepared, clip, tmp_path, "steps=2"))
    before, after = load_file(clip / "model.safetensors"), task.tower.state_dict()
    assert all(torch.equal(before[f"clip.text.{key}"], value) for key, value in after.items())
    saved = load_file(tmp_path / "checkpoints" / "step-00000002" / "model.safetensors")
    assert not any("encoder" in key for key in saved)


def test_another_width_than_the_text_tower(prepared: Path, clip: Path, tmp_path: Path) -> None:
    config = generation_config(prepared, clip, tmp_path)
    with pytest.raises(UserError, match=r"embed-dim.*32.*64"):
        GenerationTask(config, tiny_network("embed-dim=64"))


def test_no_clip_folder(prepared: Path, tmp_path: Path) -> None:
    config = generation_config(prepared, tmp_path / "nowhere", tmp_path)
    with pytest.raises(UserError, match="nowhere"):
        GenerationTask(config, tiny_network())


@given(st.integers(1, 80), st.integers(1, 1000), st.integers(0, 99))
def test_timesteps_cover_the_whole_range_evenly(num: int, steps: int, seed: int) -> None:
    drawn = spread_timesteps(num, steps, generator(seed)).sort().values
    assert bool(((drawn >= 0) & (drawn < steps)).all())
    width = steps / num
    low = torch.arange(num) * width
    assert bool((drawn >= low.floor() - 1).all() and (drawn <= low + width + 1).all())


# ---------------------------------------------------------------- known entries

NOTHING = dict.fromkeys(ConstraintShares.model_fields, 0)


def masks(clips: int = 64, frames: int = 60, **shares: float) -> torch.Tensor:
    real = torch.ones(clips, frames, dtype=torch.bool)
    chosen = ConstraintShares(**(NOTHING | shares))
    return draw_known(real, ROOT_ROW + 1, chosen, np.random.default_rng(0))


def test_free_clips_know_nothing():
    assert not masks(free=1, root=1, start=1, joints=1).any()
    assert not masks().any()
    share = masks(200, free=0.5, start=1).flatten(1).any(1).float().mean()
    assert 0.35 < share < 0.65


def test_padding_is_never_known():
    real = torch.arange(60) < torch.randint(20, 60, (32, 1))
    shares = ConstraintShares(free=0)
    assert not draw_known(real, 23, shares, np.random.default_rng(0))[~real].any()


def test_starts_and_ends_are_whole_frames():
    whole = masks(start=1, end=1).flatten(2)
    assert torch.equal(whole.any(2), whole.all(2))
    frames = whole.all(2)
    assert frames[:, 0].all() and frames[:, -1].all()
    gaps = (frames[:, 1:].int() - frames[:, :-1].int()).abs().sum(1)
    assert (gaps == 2).any() and (gaps <= 2).all()  # one gap between the two


def test_the_root_row_is_pinned_alone():
    known = masks(root=1)
    assert not known[:, :, 1:NUM_JOINTS].any()
    row = known[:, :, ROOT_ROW]
    path, heading = row[..., FORWARD].any(1), row[..., YAW_RATE].any(1)
    assert (path | heading).all()
    assert path.float().mean() > 0.6 and heading.float().mean() > 0.6
    assert (path & ~heading).any() and (heading & ~path).any()
    assert 0.1 < row[..., HEIGHT].any(1).float().mean() < 0.9
    assert not row[..., LEFT_CONTACT:].any()


def test_joints_are_done_again_within_one_span():
    known = masks(joints=1)
    unknown = ~known.flatten(2).all(2)  # B T
    edges = unknown.int().diff(dim=1).abs().sum(1)
    assert (edges <= 2).all() and unknown.any(1).all()
    whole = (~known[:, :, 0]).flatten(1).any(1)  # the pelvis is free where the whole body is
    assert whole.any() and not whole.all()


def test_contacts_are_given_by_themselves():
    known = masks(contacts=1)
    assert not known[:, :, :NUM_JOINTS].any() and not known[:, :, ROOT_ROW, :LEFT_CONTACT].any()
    assert known[:, :, ROOT_ROW, LEFT_CONTACT:].flatten(1).any(1).all()


@pytest.mark.parametrize("frames", [1, 2, 8])
def test_short_clips(frames: int):
    real = torch.ones(64, frames, dtype=torch.bool)
    known = draw_known(real, 23, ConstraintShares(free=0), np.random.default_rng(0))
    assert known.shape == (64, frames, 23, 6) and known.any()


def test_a_padded_batch_has_the_same_losses(prepared: Path, clip: Path, tmp_path: Path) -> None:
    config = generation_config(prepared, clip, tmp_path, "losses.foot-slide=1", "losses.position=1")
    task = GenerationTask(config, tiny_network())
    batch = task.batch(Part(3, 0, 1))
    padded = batch.padded()
    assert padded.clean.shape[1] % 30 == 0 and padded.input_ids.shape[1] % 32 == 0
    assert padded.clean.shape[1] >= batch.clean.shape[1]
    with torch.no_grad():
        one, other = (task.training_step(task.module.eval(), each) for each in (batch, padded))
    assert {key: float(value) for key, value in other.items()} == pytest.approx(
        {key: float(value) for key, value in one.items()}, rel=1e-4
    )
