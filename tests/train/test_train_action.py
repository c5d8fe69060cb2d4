"""A new action from a few clips: its sentences find a place of their own, the others stay."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from tiny_stage import (
    SETTINGS,
    clip_config,
    generation_config,
    tiny_network,
    train_clip,
    train_generation,
)

from src.shared.config_loader import load_train
from src.shared.config_schema import TrainActionConfig, TrainTextConfig
from src.shared.data.prepare import open_data, prepare
from src.shared.data.sources import MotionFolder
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.errors import UsageError, UserError
from src.shared.formats.writers.bvh import write_bvh
from src.shared.model.clip.pretrained import tower_hash
from src.shared.model.generation.denoiser import MotionDenoiser
from src.shared.model.generation.motion_generator import SampleRequest, TextToMotion, sample_batch
from src.train.engine import Trainer
from src.train.task import Part
from src.train.text_stages import as_features
from src.train.train_action import (
    ActionTask,
    OftenInOneStep,
    aside,
    begun_as,
    network_of,
    unshared,
)
from src.train.train_text import TextTask

OLD = ["a person walks forward", "someone waves with the left hand", "she jumps"]
PAIRED = (
    "tower=pairs",
    "choice-weight=2",
    "least-captions=2",
    "captions-per-group=24",
    "written=0",
    "outside=0",
)
NEW = ["a person is flopping", "flopping about", "someone flops down"]


@pytest.fixture(scope="module")
def model(prepared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny generator behind a tower of token pairs."""
    folder = tmp_path_factory.mktemp("model")
    clip, made, paired = folder / "clip", folder / "made", folder / "paired"
    train_clip(clip_config(prepared, clip, "steps=20"))
    train_generation(generation_config(prepared, clip, made, "steps=2"))
    given = [*SETTINGS, f"data='{prepared}'", f"clip='{made}'", f"output='{paired}'", *PAIRED]
    given += ["steps=80", "batch-size=64", "learning-rate=0.03"]
    config = load_train(None, TrainTextConfig, given)
    Trainer(config, lambda c: TextTask(c, tiny_network()), command="again").train()
    return paired


@pytest.fixture(scope="module")
def flops(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A prepared folder of six clips that no caption book knows, and one without a label."""
    return prepared_clips(tmp_path_factory.mktemp("flops"), "flop", NEW)


def prepared_clips(folder: Path, action: str, captions: list[str], last: str = "") -> Path:
    lines = ["clip,action,caption"]
    for number in range(7):
        clip = generate_clip(spec_for({"action": "bow", "count": "1"}, number), seed=number)
        write_bvh(clip, folder / "clips" / f"take{number}.bvh")
        own = action if number < 6 else last  # one clip has no label
        said = captions[number % len(captions)] if own == action else "a person stands"
        lines.append(f"take{number},{own},{said}")
    (folder / "captions.csv").write_text("\n".join(lines))
    source = MotionFolder.open(folder / "clips", captions=[folder / "captions.csv"])
    prepare([source], folder / "data", workers=1)
    return folder / "data"


def action_config(data: Path, init: Path | str, output: Path, *more: str) -> TrainActionConfig:
    given = [*SETTINGS, f"data='{data}'", f"init='{init}'", f"output='{output}'"]
    return load_train(None, TrainActionConfig, [*given, "tower-steps=120", *more])


def test_a_new_action_has_a_place_and_the_old_ones_keep_theirs(
    model: Path, flops: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    config = action_config(flops, model, tmp_path / "taught", "steps=3", "batch-size=4")
    network = network_of(str(model))
    trainer = Trainer(config, lambda c: ActionTask(c, network), command="again")
    trainer.train()
    old, new = (TextToMotion.from_pretrained(each, device="cpu") for each in (model, config.output))
    assert set(new.card.tags) == {*old.card.tags, "flop"}
    before, after = (each.text.get_buffer("places") for each in (old, new))
    assert torch.equal(after[:-1], before) and len(after) == len(before) + 1
    near = new.encode_prompts(NEW).pooled @ torch.nn.functional.normalize(after[-1], dim=-1)
    assert (near > 0.9).all()
    kept = (old.encode_prompts(OLD).pooled * new.encode_prompts(OLD).pooled).sum(-1)
    assert (kept > 0.9).all()
    assert new.scope is not None and old.scope is not None
    assert new.scope.actions == (*old.scope.actions, "flop")
    assert {"flop", "flops", "flopping"} <= new.scope.key_words.keys()
    for kind in ("gestures", "still"):  # the clips are bows
        assert {*getattr(new.scope, kind)} == {*getattr(old.scope, kind), "flop"}
    assert new.generate(["a person flops"], seconds=1.0, steps=2, tags=["flop"])[0].num_frames == 30
    figures = trainer.task.figures  # a tiny network is not near; nobody is nearer than a copy
    assert figures.keys() == {"flop-cm", "flop-speed"} and min(figures.values()) > 0
    # who resumes reads the tower that was taught, and sends sentences where it sent them
    before = capsys.readouterr().err
    resumed = ActionTask(config, network)
    assert "teaching the text tower" in before
    assert "teaching the text tower" not in capsys.readouterr().err
    assert tower_hash(resumed.tower) == tower_hash(trainer.task.tower)
    # and once more, on top of that: nothing is new any longer
    with pytest.raises(UserError, match=r"no action that .* does not know"):
        ActionTask(action_config(flops, config.output, tmp_path / "again"), network)


def test_an_action_without_a_clip_left_is_not_told_of(
    model: Path, prepared: Path, tmp_path: Path
) -> None:
    config = action_config(prepared, model, tmp_path, "actions=['walk','bow']", "min-clips=2")
    task = ActionTask(config, network_of(str(model)))
    task.train.records = [record for record in task.train.records if record.tag == "walk"]
    assert {name.partition("-")[0] for name in task.validation(task.module)} == {"walk"}


def test_nothing_that_was_known_changes(model: Path, flops: Path, tmp_path: Path) -> None:
    """Adapters are closed for texts that come out at the old places, to the last bit; and open for
    the new one, with a guidance that compares like with like. A second action leaves the first."""
    short = ("learning-rate=0.05", "tower-steps=20")
    first = action_config(flops, model, tmp_path / "first", "steps=4", *short)
    Trainer(first, lambda c: ActionTask(c, network_of(str(model))), command="again").train()
    old, new = (TextToMotion.from_pretrained(each, device="cpu") for each in (model, first.output))
    places = new.text.get_buffer("places")
    request = SampleRequest("", 30, len(new.card.tags), (0, 0, 0))

    def sampled(generator: TextToMotion, place: torch.Tensor) -> torch.Tensor:
        tag = replace(request, tag=len(generator.card.tags))
        return sample_batch(
            generator.denoiser, generator.diffusion, [tag], as_features(place[None]),
            guidance_scale=2.0, sampler="ddim", steps=2,
        )  # fmt: skip

    for place in places[:-1]:
        assert torch.equal(sampled(old, place), sampled(new, place))
    assert not torch.equal(sampled(old, places[-1]), sampled(new, places[-1]))
    slumps = prepared_clips(tmp_path / "slumps", "slump", ["a person slumps", "slumping down"])
    second = action_config(slumps, first.output, tmp_path / "second", "steps=2", "rank=3", *short)
    network = network_of(str(first.output))
    Trainer(second, lambda c: ActionTask(c, network), command="again").train()
    both = TextToMotion.from_pretrained(second.output, device="cpu")
    assert both.network.generation.adapter_ranks == (16, 3)
    assert torch.equal(sampled(new, places[-1]), sampled(both, places[-1]))


@pytest.mark.parametrize(
    ("prediction", "limit", "kept"),
    [("sample", 0.5, None), ("sample", 1e3, 1e3), ("epsilon", 0.5, 0.5), ("sample", None, None)],
)
def test_a_limit_goes_where_what_is_learned_is_beyond_it(
    model: Path,
    flops: Path,
    tmp_path: Path,
    prediction: str,
    limit: float | None,
    kept: float | None,
) -> None:
    """Ruling 105: whoever teaches the starter to lie down must get a body that lies."""
    network = network_of(str(model))
    told = {"prediction_type": prediction, "clip_sigma": limit}
    generation = network.generation.model_copy(update=told)
    network = network.model_copy(update={"generation": generation})
    task = ActionTask(action_config(flops, model, tmp_path, "tower-steps=1"), network)
    assert task.network.generation.clip_sigma == kept
    task.save_pretrained(task.module, tmp_path)
    saved = TextToMotion.from_pretrained(tmp_path, device="cpu")
    assert saved.diffusion.config.clip_sigma == kept


def test_a_known_action_is_learned_better_where_it_is(model: Path, tmp_path: Path) -> None:
    """The tower stays, and adapters open for that action alone."""
    data = prepared_clips(tmp_path, "bow", ["a person bows", "someone takes a bow"])
    config = action_config(data, model, tmp_path / "better", "steps=4", "actions=[bow]")
    Trainer(config, lambda c: ActionTask(c, network_of(str(model))), command="again").train()
    old, new = (TextToMotion.from_pretrained(each, device="cpu") for each in (model, config.output))
    for key, value in old.text.state_dict().items():
        assert torch.equal(value, new.text.state_dict()[key])
    texts = ["a person bows", "someone takes a bow", *OLD]
    opened = new.denoiser.opened(new.encode_prompts(texts).pooled)[:, 0] > 0
    assert new.denoiser.get_buffer("adapter_of").sum() == 1 and not opened.all()
    assert new.card.tags == old.card.tags
    both = [each.generate(texts, seconds=1.0, steps=2) for each in (old, new)]
    for before, after, better in zip(*both, opened, strict=True):
        if not better:
            torch.testing.assert_close(before.quaternions, after.quaternions)
    with pytest.raises(UserError, match="does not know that action"):
        ActionTask(
            action_config(data, model, tmp_path / "x", "actions=[sing]"), network_of(str(model))
        )


@pytest.mark.parametrize("rank", [20, 2])
def test_an_adapter_goes_on_from_the_one_that_was_there(
    model: Path, flops: Path, tmp_path: Path, rank: int
) -> None:
    """It begins as that one, whatever its rank can hold of it."""
    config = action_config(flops, model, tmp_path / "flop", "steps=4", "rank=4")
    Trainer(config, lambda c: ActionTask(c, network_of(str(model))), command="again").train()
    more = ("actions=[flop]", f"rank={rank}")
    config = action_config(flops, config.output, tmp_path / "better", *more)
    task = ActionTask(config, network_of(str(config.init)))
    state = task._denoiser().state_dict()
    downs = [name for name in state if ".adapters.0.0." in name]
    assert downs
    silent = {name: value * ("adapters.0.1." not in name) for name, value in state.items()}
    begun = begun_as(0, 1, silent, rank)  # of what is all zeros, one that can learn
    assert all(value.any() == (".1.0.weight" in name) for name, value in begun.items())
    for name in downs:
        old, new = (
            state[each.replace(".0.weight", ".1.weight")] @ state[each]
            for each in (name, name.replace(".adapters.0.", ".adapters.1."))
        )
        if rank > 4:
            torch.testing.assert_close(new, old, rtol=1e-4, atol=1e-7)
        lost = float((new - old).square().sum() / old.square().sum().clamp(min=1e-12))
        assert lost < 0.75


def test_a_share_of_a_batch_is_noise_alone(model: Path, flops: Path, tmp_path: Path) -> None:
    given = ("batch-size=64", "first-share=0.5")
    task = ActionTask(action_config(flops, model, tmp_path / "x", *given), network_of(str(model)))
    timesteps = task.batch(Part(0, 0, 1)).timesteps
    last = int(timesteps.max())
    assert last == task.diffusion.config.timesteps - 1
    assert 16 < int((timesteps == last).sum()) < 48


def test_every_other_clip_that_is_noise_alone_takes_the_learned_step(model: Path) -> None:
    before = TextToMotion.from_pretrained(model, device="cpu")
    generation = before.network.generation.model_copy(update={"one_step_rank": 2})
    network = before.network.model_copy(update={"generation": generation})
    torch.manual_seed(0)
    denoiser = MotionDenoiser(network, len(before.card.tags)).eval()
    with torch.no_grad():
        for weight in denoiser.parameters():
            weight.add_(0.1 * torch.randn_like(weight))
    at_once = denoiser.in_one_step()
    assert at_once is not None
    last = generation.diffusion_steps - 1
    heard = (
        torch.randn(4, 8, network.motion_rows, generation.motion_channels),
        torch.tensor([last, last, last - 1, 3]),
        as_features(torch.randn(4, network.embed_dim)),
        torch.zeros(4).long(),
    )
    with torch.no_grad():
        shown = OftenInOneStep(denoiser).predicted(*heard)
        slow, fast = denoiser(*heard), at_once(*heard)
    assert (slow - fast).abs().max() > 1e-3
    torch.testing.assert_close(shown[0], fast[0])
    torch.testing.assert_close(shown[1:], slow[1:])
    denoiser.text_scale = torch.nn.Parameter(denoiser.text_scale.detach()[None])  # as FSDP has it
    assert denoiser.one_step is not None
    changed = denoiser.one_step.weights(denoiser)
    kept = {name for name in changed if name != "text_scale"}
    assert kept == changed.keys()


def test_a_style_is_learned_better_where_nothing_else_comes_out(
    model: Path, tmp_path: Path
) -> None:
    """Refused where the same words ask for another style."""
    others = [torch.tensor([4] * 7 + [1] * 3), torch.tensor([2]), torch.tensor([7] + [0] * 19)]
    assert unshared({"sad": 7, "angry": 4, "proud": 2}, others) == {"sad": 7}
    prepared_clips(tmp_path, "bow", ["a person bows"])
    rows = [f"take{n},bow,{'sad' if n < 3 else ''},a person bows" for n in range(6)]
    (tmp_path / "captions.csv").write_text("\n".join(["clip,action,style,caption", *rows]))
    source = MotionFolder.open(tmp_path / "clips", captions=[tmp_path / "captions.csv"])
    prepare([source], tmp_path / "both", workers=1)
    wanted = ("actions=[bow]", "styles=[sad]")
    config = action_config(tmp_path / "both", model, tmp_path / "x", *wanted)
    with pytest.raises(UserError, match="place of its own"):
        ActionTask(config, network_of(str(model)))
    plain = action_config(tmp_path / "both", model, tmp_path / "z", wanted[0], "styles=[plain]")
    learned = ActionTask(plain, network_of(str(model))).train.records
    assert learned and all("style" not in record.labels for record in learned)
    for given, error, told in (
        ((wanted[0], "min-clips=99"), UserError, "no clip"),
        (wanted[1:], UsageError, "actions=walk styles=sad"),
        ((wanted[0], "styles=[sda]"), UserError, "styles=sda: .* name one of plain, sad"),
    ):
        config = action_config(tmp_path / "both", model, tmp_path / "y", *given)
        with pytest.raises(error, match=told):
            ActionTask(config, network_of(str(model)))


def test_a_new_action_that_keeps_no_clip_is_told(model: Path, tmp_path: Path) -> None:
    prepared_clips(tmp_path, "flop", NEW)
    rows = [f"take{n},{'slump' if n < 3 else 'flop'},a person moves" for n in range(7)]
    (tmp_path / "captions.csv").write_text("\n".join(["clip,action,caption", *rows]))
    source = MotionFolder.open(tmp_path / "clips", captions=[tmp_path / "captions.csv"])
    prepare([source], tmp_path / "both", workers=1)
    clips = Counter(r.tag for r in open_data(str(tmp_path / "both"), tmp_path).records("train"))
    assert clips["slump"] < clips["flop"]
    config = action_config(
        tmp_path / "both", model, tmp_path / "x", f"min-clips={clips['flop']}", "tower-steps=1"
    )
    with pytest.raises(UserError, match="no clip of slump, which is new"):
        ActionTask(config, network_of(str(model)))


def test_a_style_moves_aside_from_where_plain_clips_are() -> None:
    places = torch.eye(8)[[0, 1, 1, 2]]
    moved = aside(places, {0, 2})
    assert torch.equal(moved[[0, 1, 3]], places[[0, 1, 3]])
    assert 0.8 < float(moved[2] @ places[2]) < 0.99
    torch.testing.assert_close(moved.norm(dim=-1), torch.ones(4))


def test_a_tower_taught_anew_opens_the_adapters(model: Path, tmp_path: Path) -> None:
    """The combinations that adapters learned lie where these open; an action that the new tower is
    not taught is gone."""
    data = prepared_clips(tmp_path, "karate", ["she does karate", "karate"], last="bow")
    first = action_config(data, model, tmp_path / "first", "steps=4", "learning-rate=0.05")
    Trainer(first, lambda c: ActionTask(c, network_of(str(model))), command="again").train()
    given = [*SETTINGS, f"data='{data}'", f"clip='{model}'", f"generator='{first.output}'"]
    given += [*PAIRED, "steps=60", "batch-size=64", "learning-rate=0.03"]

    def taught(name: str, *more: str) -> TextToMotion:
        folder = tmp_path / name
        config = load_train(None, TrainTextConfig, [*given, f"output='{folder}'", *more])
        Trainer(config, lambda c: TextTask(c, tiny_network()), command="again").train()
        return TextToMotion.from_pretrained(folder, device="cpu")

    before, new = TextToMotion.from_pretrained(first.output, device="cpu"), taught("anew")
    assert torch.equal(new.denoiser.get_buffer("places"), new.text.get_buffer("places"))
    opened = [
        each.denoiser.opened(each.encode_prompts(["she does karate", "a person bows"]).pooled)
        for each in (before, new)
    ]
    assert opened[0].tolist() == opened[1].tolist() == [[1.0], [0.0]]
    assert new.card.tags == before.card.tags
    less = taught("less", "without=[karate]")
    assert "karate" not in less.card.tags and not less.denoiser.get_buffer("adapter_of").any()
    assert less.generate(["a person bows"], seconds=1.0, steps=2)[0].num_frames == 30
    with pytest.raises(UserError, match="has no such action"):
        taught("none", "without=[kung-fu]")


def test_models_that_cannot_learn_say_why(prepared: Path, model: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="starter-audio is a"):
        network_of("starter-audio")
    with pytest.raises(UsageError, match="text tower without places"):
        network_of(str(model.parent / "made"))
    with pytest.raises(UserError, match=r"no action that .* does not know"):
        ActionTask(action_config(prepared, model, tmp_path / "x"), network_of(str(model)))
