"""The harness on samplers whose score is known: a perfect one, a deaf one, a still one."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from src.cli.evaluate import draw
from src.shared.config_schema import TrainEvaluatorConfig
from src.shared.data.captions.book import CaptionBook
from src.shared.data.prepare import open_data
from src.shared.data.prepared import PreparedData
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.errors import UserError
from src.shared.evaluation.samples import HeldOut, Sampler
from src.shared.evaluation.suites import control as control
from src.shared.evaluation.suites.control import control_grid
from src.shared.evaluation.suites.text import (
    TextContext,
    TextSettings,
    evaluate_samplers,
    scores,
)
from src.shared.evaluation.tables import (
    Grid,
    grids,
    markdown,
    printed,
    tables,
)
from src.shared.model.evaluator import Evaluator, EvaluatorConfig
from src.shared.motion.motion import Motion
from src.train.train_evaluator import PairSet, contrastive_loss

SETTINGS = TextSettings(
    num_samples=96,
    replications=2,
    max_frames=64,
    language_samples=0,
    control_seeds=0,
    languages=("en", "es"),
)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    return open_data("synthetic", tmp_path_factory.mktemp("data"), synthetic_clips=90)


@pytest.fixture(scope="module")
def held_out(data: PreparedData) -> HeldOut:
    train = data.records("train")
    return HeldOut(data, {"seen": train[:96], "unseen": []}, "test clips")


@pytest.fixture(scope="module")
def judge(data: PreparedData) -> Evaluator:
    """A judge after 60 steps: far above chance, far from good."""
    torch.manual_seed(0)
    config = TrainEvaluatorConfig(min_frames=16, max_frames=64, languages=("en",))
    pairs = PairSet(data, "train", config, balance=1.0)
    model = Evaluator(EvaluatorConfig(hidden_size=48, num_buckets=1024, dropout=0.0))
    model.fit_statistics(pairs.frames())
    optimizer = torch.optim.AdamW(model.parameters(), 5e-3)
    rng = np.random.default_rng(0)
    for _ in range(60):
        batch = pairs.batch(40, rng)
        text, motion, scale = model(batch.captions, batch.joints, batch.mask)
        loss = contrastive_loss(text, motion, batch.same, scale)
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    return model.eval()


def copying_sampler(held_out: HeldOut, *, deaf: bool) -> Sampler:
    """Returns real clips: those of the caption asked for, or any."""
    from src.shared.evaluation.samples import real_clips

    clips = real_clips(held_out.data, held_out.records["seen"], num=999, max_frames=64)
    by_caption: dict[str, list[Motion]] = {}
    for caption, motion in zip(clips.captions, clips.motions, strict=True):
        by_caption.setdefault(caption, []).append(motion)

    def sample(prompts: Sequence[str], num_frames: Sequence[int], seed: int) -> list[Motion]:
        rng = np.random.default_rng(seed)
        choices = [clips.motions if deaf else by_caption[prompt] for prompt in prompts]
        return [motions[int(rng.integers(len(motions)))] for motions in choices]

    return sample


def test_a_perfect_and_a_deaf_sampler_get_one_and_zero(held_out: HeldOut, judge: Evaluator) -> None:
    samplers = {
        "perfect": copying_sampler(held_out, deaf=False),
        "deaf": copying_sampler(held_out, deaf=True),
    }
    context = TextContext(held_out, judge, samplers, SETTINGS)
    report = evaluate_samplers(context, about={"model": "x"})
    found = {grid.name: grid for grid in grids(report)}

    def value(row: str, column: str) -> float:
        seen = [grid for name, grid in found.items() if name.startswith("seen/")]
        return next(v for v in (grid.value(row, column) for grid in seen) if v == v)

    assert value("real", "r_at_3") > 0.6 > 0.3 > value("chance", "r_at_3")
    assert value("perfect", "normalised_r_at_3") == pytest.approx(1, abs=0.12)
    assert value("deaf", "normalised_r_at_3") == pytest.approx(0, abs=0.15)
    assert value("perfect", "frechet_joint_ratio") < 0.15 < 0.6
    assert value("deaf", "frechet_joint_ratio") > 0.6
    assert value("perfect", "support_slide_ratio") == pytest.approx(1, abs=0.2)
    assert value("perfect", "obeys_all") > value("deaf", "obeys_all") + 0.3
    assert value("perfect", "speed_error") < 0.1 < value("chance", "speed_error")
    assert value("frozen pose", "speed") == pytest.approx(0, abs=1e-3)
    assert found["unseen"].title == "unseen: not measured"


def test_the_report_is_json_markdown_and_tables(held_out: HeldOut, judge: Evaluator) -> None:
    from rich.console import Console

    settings = replace(SETTINGS, num_samples=32, replications=1, language_samples=32)
    two = {"seen": held_out.records["seen"][:48], "unseen": held_out.records["seen"][48:96]}
    only = replace(held_out, records=two)
    deaf = copying_sampler(held_out, deaf=True)
    samplers = {"generated": copying_sampler(held_out, deaf=False), "untrained": deaf}
    context = TextContext(only, judge, samplers, replace(settings, languages=("en",)))
    report = evaluate_samplers(context)
    json.dumps(report)
    text = markdown(report)
    assert "data-hash" in text and "| chance |" in text and "unseen" in text
    (languages,) = [grid for grid in grids(report) if grid.name == "languages"]
    assert languages.rows["en"].num == 32
    keys = ("real", "chance", "generated", "untrained", "normalised")
    assert tuple(column.key for column in languages.columns) == keys
    assert languages.value("en", "generated") > languages.value("en", "untrained")
    names = {grid.name for grid in grids(report)}
    assert {"seen/retrieval", "unseen/obedience", "unseen/scores"} < names
    assert all(len(row) == len(table.header) for table in tables(report) for row in table.rows)
    stream = StringIO()
    draw(report, Console(file=stream, width=200))
    assert "frozen pose" in stream.getvalue()


def test_scores_of_an_absent_column_are_not_a_number() -> None:
    assert all(math.isnan(value) for value in scores([], "generated").values())


def oracle_sampler(book: CaptionBook, num_seeds: int, languages: Sequence[str]) -> Sampler:
    """The synthetic source, asked with the labels behind each prompt."""
    asked: dict[str, dict[str, str]] = {}
    for language in languages:
        for wording in control.WORDINGS:
            for task in control.CONTROL_TASKS:
                for labels in (*task.labels, *([task.versus] if task.versus else [])):
                    for prompt in control.prompts_of(book, labels, language, wording, 0):
                        asked.setdefault(prompt, labels)

    def sample(prompts: Sequence[str], num_frames: Sequence[int], seed: int) -> list[Motion]:
        full = {"walk": {"speed": "normal"}, "run": {"speed": "normal"}}
        made = []
        for index, prompt in enumerate(prompts):
            labels = asked[prompt]
            labels = labels | full.get(labels["action"], {"speed": "normal"})
            if labels["action"] == "turn":
                labels = {key: labels.get(key, "90") for key in ("action", "direction", "angle")}
            made.append(generate_clip(spec_for(labels, seed + index), seed + index))
        return made

    return sample


def test_an_obedient_sampler_passes_the_control_tasks() -> None:
    book = CaptionBook.load(None)
    sampler = oracle_sampler(book, 4, ["en"])
    table = control_grid(sampler, book, None, languages=["en", "xx"], num_seeds=4)

    def deaf(prompts: Sequence[str], num_frames: Sequence[int], seed: int) -> list[Motion]:
        return sampler([prompts[0]] * len(prompts), num_frames, seed)

    def mean(grid: Grid, column: str) -> Mapping[str, Any]:
        cell = grid.rows["mean"].cells[column]
        assert isinstance(cell, Mapping)
        return cell

    num_tasks = len(control.CONTROL_TASKS)
    assert len(table.rows) == num_tasks + 1
    assert mean(table, "en templates")["value"] >= 0.9
    assert mean(table, "en paraphrases")["count"] == 4 * num_tasks
    assert mean(table, "chance")["value"] < 0.4
    assert mean(table, "still")["value"] == 0
    assert mean(table, "untrained")["count"] == 0
    assert all(math.isnan(table.value(row, "real")) for row in table.rows)
    both = control_grid(sampler, book, None, languages=["en"], num_seeds=2, untrained=deaf)
    assert mean(both, "untrained")["count"] == 2 * num_tasks
    assert mean(both, "untrained")["value"] < 0.4 < mean(both, "en templates")["value"]
    told: list[str] = []
    few = partial(control_grid, sampler, book, None, languages=["en"], num_seeds=2)
    walker = few(actions={"walk", "wave"}, progress=told.append)
    assert set(walker.rows) == {*table.rows} - {"run faster than walk"}
    assert told[0].endswith("left out: run faster than walk")
    assert not few(actions={"kata"}).rows
    drawn = printed(table)
    assert drawn.header[:3] == ["task", "en tmpl", "en para"] and drawn.rows[-1][0] == "mean"
    assert {len(row) for row in drawn.rows} == {len(drawn.header)}


def test_held_out_synthetic_clips_are_told_apart_by_what_was_trained_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from src.shared.evaluation import samples as module

    monkeypatch.setattr(module, "FRESH_CLIPS", 12)
    first = module.open_held_out("synthetic", tmp_path, frozenset())
    assert first.records["seen"] == [] and len(first.records["unseen"]) == 24
    groups = frozenset(record.group for record in first.records["unseen"][:6])
    second = module.open_held_out("synthetic", tmp_path, groups)
    assert {record.group for record in second.records["seen"]} == groups
    with pytest.raises(UserError):
        module.open_held_out(str(tmp_path / "absent"), tmp_path, frozenset())
