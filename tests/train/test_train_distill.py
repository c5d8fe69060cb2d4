"""Distillation: a student takes one step where its teacher takes several, as told as it."""

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
from src.shared.config_schema import TrainDistillConfig
from src.shared.errors import UsageError, UserError
from src.shared.model.diffusion import guided, make_sampler
from src.shared.model.generation.constraint import Constraint
from src.shared.model.generation.motion_generator import TextToMotion
from src.train.engine import Trainer
from src.train.task import Part
from src.train.text_stages import as_features
from src.train.train_distill import DistillTask, network_of

PROMPTS = ["a person walks forward", "someone waves with the left hand"]


@pytest.fixture(scope="module")
def teacher(prepared: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny generator that has learned enough to differ from one step to four."""
    folder = tmp_path_factory.mktemp("teacher")
    train_clip(clip_config(prepared, folder / "clip", "steps=10"))
    made = generation_config(
        prepared, folder / "clip", folder / "made", "steps=60", "learning-rate=0.01"
    )
    train_generation(made)
    return folder / "made"


def distill(data: Path, init: Path, output: Path, *more: str, resume: bool = False) -> DistillTask:
    given = [*SETTINGS, f"data='{data}'", f"init='{init}'", f"output='{output}'"]
    given += ["min-frames=24", "pair-batches=3", "teacher-steps=4", *more]
    config = load_train(None, TrainDistillConfig, given)
    network = network_of(str(init))
    trainer = Trainer(config, lambda c: DistillTask(c, network), command="again", resume=resume)
    trainer.train()
    assert isinstance(trainer.task, DistillTask)
    return trainer.task


@torch.no_grad()
def missed(task: DistillTask) -> float:
    """The loss over one turn of the pairs."""
    parts = [Part(step, 0, 1) for step in range(1, 4)]
    losses = [task.training_step(task.module, task.batch(part))["loss"] for part in parts]
    return float(torch.stack(losses).mean())


def test_a_student_learns_the_steps_of_its_teacher(
    prepared: Path, teacher: Path, tmp_path: Path
) -> None:
    untaught = distill(prepared, teacher, tmp_path / "student", "steps=1", "learning-rate=1e-9")
    more = ("steps=60", "learning-rate=0.005")
    taught = distill(prepared, teacher, tmp_path / "taught", *more)
    before, after = (missed(task) for task in (untaught, taught))
    assert after < 0.8 * before

    more = (f"student='{tmp_path / 'taught'}'", "steps=1", "learning-rate=1e-9", "ema-decay=0")
    assert missed(distill(prepared, teacher, tmp_path / "on", *more)) < 0.8 * before

    student = TextToMotion.from_pretrained(tmp_path / "taught", device="cpu")
    generation = student.network.generation
    assert (generation.guidance_scale, generation.sampling_steps) == (1.0, 2)
    assert student.card.training["distilled"]["from"] == "made"
    assert student.scope is not None
    once = student.generate(PROMPTS, seconds=1.0, steps=1)
    assert [motion.num_frames for motion in once] == [30, 30]
    values = student.sample_features(["a person jumps"], seconds=1.0)[0]
    known = torch.zeros(values.shape, dtype=torch.bool)
    known[:5] = True
    held = Constraint(values, known)
    again = student.sample_features(PROMPTS[:1], seconds=1.0, constraints=[held])[0]
    assert torch.equal(again[:5], values[:5]) and again.isfinite().all()


def test_a_step_is_learned_beside_the_weights(
    prepared: Path, teacher: Path, tmp_path: Path
) -> None:
    more = ("rank=6", "pair-batches=0", "steps=1", "learning-rate=1e-9")
    untaught = distill(prepared, teacher, tmp_path / "none", *more)
    assert not list((tmp_path / "none" / "pairs").glob("train-*"))
    more = ("rank=6", "steps=60", "learning-rate=0.01", "ema-decay=0.5")
    taught = distill(prepared, teacher, tmp_path / "taught", *more)
    seen = missed(untaught)
    assert missed(taught) < 0.8 * seen

    before, after = (
        TextToMotion.from_pretrained(folder, device="cpu")
        for folder in (teacher, tmp_path / "taught")
    )
    assert after.network.generation.one_step_rank == 6
    kept, now = (model.sample_features(PROMPTS, seconds=1.0, steps=4) for model in (before, after))
    assert all(map(torch.equal, kept, now))  # many steps are what they were
    learned = after.sample_features(PROMPTS, seconds=1.0, steps=1)
    plain = before.sample_features(PROMPTS, seconds=1.0, steps=1)
    assert not torch.allclose(learned[0], plain[0])
    aimed = [
        sum(float((x - y).square().mean()) for x, y in zip(found, kept, strict=True))
        for found in (learned, plain)
    ]
    assert aimed[0] < aimed[1]
    scale = before.network.generation.guidance_scale
    guided_once = [
        model.sample_features(PROMPTS, seconds=1.0, steps=1, guidance_scale=scale)[0]
        for model in (before, after)
    ]
    assert torch.equal(*guided_once)  # who names a scale asks the network itself

    on = distill(prepared, tmp_path / "taught", tmp_path / "on", "rank=6", "steps=1",
                 "learning-rate=1e-9")  # fmt: skip
    assert missed(on) < 0.8 * seen


def test_pairs_are_what_the_teacher_samples(prepared: Path, teacher: Path, tmp_path: Path) -> None:
    from src.train.train_distill import _read

    more = ("steps=1", "condition-dropout=0.5", "tag-dropout=1", "constraints.free=0.5")
    task = distill(prepared, teacher, tmp_path / "student", *more)
    pairs = _read(tmp_path / "student" / "pairs" / "train-00000.safetensors")
    assert pairs.states.shape[1] == 2 and pairs.known.any() and pairs.drop.any()
    assert torch.equal(pairs.states[:, 0][pairs.known], pairs.states[:, 1][pairs.known])
    assert torch.equal(pairs.aims[:, 1][pairs.known], pairs.states[:, 0][pairs.known])
    free = ~pairs.known.flatten(1).any(1)
    assert free.any() and pairs.mask[free].all()

    denoiser, size = task.teacher.denoiser, int(free.sum())
    text = denoiser.drop_text(as_features(pairs.place[free]), pairs.drop[free])
    null = denoiser.drop_text(text, torch.ones(size, dtype=torch.bool))
    shared = {"tag": pairs.tag[free], "known": pairs.known[free]}
    shared["provenance"] = torch.zeros(size, dtype=torch.long)  # captured
    scale = tiny_network().generation.guidance_scale
    model_fn = guided(denoiser, {"text": text, **shared}, {"text": null, **shared}, scale)
    noise = pairs.states[free, 0]
    end = task.diffusion.sample(model_fn, noise.shape, sampler="ddim", num_steps=4, x_T=noise)
    assert torch.allclose(end, pairs.aims[free, 1], atol=0.02)  # kept in half precision
    # One step towards an aim is two of the teacher's.
    halfway = make_sampler(task.diffusion, "ddim", 2).step(
        pairs.aims[free, 0], task.steps[0], noise
    )
    assert torch.allclose(halfway, pairs.states[free, 1], atol=0.02)


def test_a_stopped_run_goes_on_with_its_pairs(
    prepared: Path, teacher: Path, tmp_path: Path
) -> None:
    distill(prepared, teacher, tmp_path / "parts", "steps=2", "lr-schedule=constant")
    files = sorted((tmp_path / "parts" / "pairs").iterdir())
    made = [file.stat().st_mtime_ns for file in files]
    task = distill(
        prepared, teacher, tmp_path / "parts", "steps=4", "lr-schedule=constant", resume=True
    )
    assert [file.stat().st_mtime_ns for file in files] == made
    whole = distill(prepared, teacher, tmp_path / "again", "steps=4", "lr-schedule=constant")
    for one, other in zip(task.module.parameters(), whole.module.parameters(), strict=True):
        assert torch.equal(one, other)


def test_what_cannot_be_distilled_says_why(prepared: Path, teacher: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="starter-audio is a"):
        network_of("starter-audio")
    with pytest.raises(UsageError, match="is not of init"):
        distill(prepared, teacher, tmp_path / "y", "student=starter", "steps=1")
    with pytest.raises(UsageError, match="has no step of rank 5; leave it out, or give rank=None"):
        distill(prepared, teacher, tmp_path / "z", f"student='{teacher}'", "rank=5", "steps=1")
    with pytest.raises(UsageError, match="choose a multiple of student-steps 3"):
        distill(prepared, teacher, tmp_path / "x", "student-steps=3")
    assert not (tmp_path / "x").exists()
