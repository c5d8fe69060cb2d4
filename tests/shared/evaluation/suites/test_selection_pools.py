"""Pools of prompts and songs from tiny real models: every figure, floor and candidate in place."""

import json

import numpy as np
import pytest
import torch

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.evaluation.samples import Clips
from src.shared.evaluation.suites.selection import (
    FIGURES,
    _retrieval,
    choices,
    measured,
    prompt_pool,
    report_of,
    song_pool,
)
from src.shared.evaluation.suites.songs import held_out_songs
from src.shared.metrics.retrieval import guo_retrieval
from src.shared.model.evaluator import Evaluator, EvaluatorConfig
from src.shared.pipelines.ranking import AudioJudge, PromptSampler
from src.shared.pipelines.song import SongGenerator
from src.shared.pipelines.song_sampler import SongSampling
from tests.shared.evaluation.tiny_pairs import nod, tiny_model
from tests.shared.model.conftest import tiny_generator

WALK = {"action": "walk", "direction": "forward", "speed": "normal"}


def clips(number: int = 32, frames: int = 30) -> Clips:
    """Walks of as many label groups as there are."""
    motions = [generate_clip(spec_for(WALK, seed), seed) for seed in range(4)]
    short = [
        type(m)(m.quaternions[:frames], m.root_position[:frames], m.contacts[:frames])
        for m in motions
    ]
    return Clips(
        motions=[short[i % 4] for i in range(number)],
        captions=[f"a person walks forward {i}" for i in range(number)],
        groups=[str(i) for i in range(number)],
        tags=["walk"] * number,
        labels=[WALK] * number,
    )


@pytest.fixture(scope="module")
def evaluator() -> Evaluator:
    torch.manual_seed(0)
    return Evaluator(EvaluatorConfig(hidden_size=16, num_buckets=256))


def test_a_pool_of_prompts_holds_every_figure(evaluator: Evaluator) -> None:
    told: list[str] = []
    pool = prompt_pool(
        PromptSampler(tiny_generator()),
        evaluator,
        clips(),
        num_candidates=2,
        seed=0,
        progress=told.append,
        steps=1,
        sampler="ddim",
    )
    assert pool.score.shape == (32, 2) and len(told) == 5
    found, _ = measured(pool, choices(pool.score, 2))
    assert {figure.key for figure in FIGURES} <= set(found)
    report = report_of(pool, 2, "32 prompts", {}, {})
    rows = report["rows"]
    assert list(rows) == ["real", "chance", "best of 1", "best of 2", "worst of 2"]
    assert rows["real"]["obeys"]["value"] > 0.7 > rows["best of 1"]["obeys"]["value"]
    assert "speed_error" not in rows["real"] and "speed_error" in rows["chance"]
    json.dumps(report)


def test_retrieval_per_prompt_averages_to_guos(evaluator: Evaluator) -> None:
    rng = np.random.default_rng(0)
    text = rng.normal(size=(64, 8))
    motion = text + rng.normal(size=(64, 8))
    data = clips(64)
    rates = _retrieval(text, motion, data, 0)
    guo = [guo_retrieval(text, motion, [data.groups], seed=s).mean(1) for s in range(20)]
    assert rates["r_at_1"].mean() == pytest.approx(np.mean(guo, 0)[0], abs=0.02)
    assert rates["r_at_3"].mean() == pytest.approx(np.mean(guo, 0)[2], abs=0.02)
    assert rates["r_at_1"].min() >= 0 and rates["r_at_3"].max() <= 1


def test_a_pool_of_songs_has_distances_where_there_is_real_motion() -> None:
    generator = SongGenerator(tiny_model(), device="cpu")
    pieces = list(held_out_songs(3, 4.0, 0))
    settings = SongSampling(2, steps=1)
    real = [nod(np.arange(122) / 30 * tempo / 240, 0.2) for tempo in (80, 90, 100, 110)]
    pool = song_pool(generator, AudioJudge(), pieces, real, settings=settings)
    assert pool.score.shape == (3, 2)
    report = report_of(pool, 2, "3 songs", {}, {})
    rows = report["rows"]
    assert list(rows) == ["real", "chance", "best of 1", "best of 2", "worst of 2"]
    assert {"fid_g", "fid_k", "hits", "sanity"} <= set(rows["best of 2"])
    assert rows["real"]["fid_g"]["value"] >= 0 and rows["best of 1"]["fid_g"]["count"] == 2
    bare = song_pool(generator, AudioJudge(), pieces, [], settings=settings)
    assert "fid_g" not in report_of(bare, 2, "3 songs", {}, {})["rows"]["best of 2"]
