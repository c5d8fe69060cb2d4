"""The evaluator's training stage: a short run writes a judge that knows more than chance."""

from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.config_loader import load_train
from src.shared.config_schema import TrainEvaluatorConfig
from src.shared.data.prepared import PreparedData
from src.shared.errors import UserError
from src.shared.model.evaluator import Evaluator
from src.train.launch import STAGES
from src.train.task import Part
from src.train.train_evaluator import EvaluatorTask, PairSet, contrastive_loss

SETTINGS = {
    "steps": 24, "batch-size": 32, "hidden-size": 32, "threads": 1, "device": "cpu",
    "tensorboard": "false", "warmup-steps": 4, "log-every": 12, "validate-every": 24,
    "save-every": 12, "validation-batches": 2, "max-frames": 64, "min-frames": 16,
    "learning-rate": 0.004, "ema-decay": 0.5,
}  # fmt: skip
SHORT = [f"{key}={value}" for key, value in SETTINGS.items()]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from src.shared.data.prepare import open_data

    folder = tmp_path_factory.mktemp("data")
    return open_data("synthetic", folder, synthetic_clips=120).folder


def test_its_file_matches_its_configuration() -> None:
    config = load_train(None, TrainEvaluatorConfig)
    assert config.data == "synthetic" and config.word_dropout > 0


def test_a_short_run_learns_and_resumes(data: Path, tmp_path: Path) -> None:
    from typer.testing import CliRunner

    def run(*arguments: str) -> str:
        result = CliRunner().invoke(STAGES["evaluator"].app(), [*SHORT, f"data={data}", *arguments])
        assert result.exit_code == 0, result.output
        return result.output

    run(f"output={tmp_path / 'whole'}")
    judge = Evaluator.from_pretrained(tmp_path / "whole")
    figures = (tmp_path / "whole" / "config.json").read_text(encoding="utf-8")
    assert '"data-hash"' in figures and judge.config.hidden_size == 32
    run(f"output={tmp_path / 'whole'}", "--resume")


def test_few_held_back_clips_give_no_retrieval_figure(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    overrides = [f"data={data}", f"output={tmp_path}", *SHORT]
    monkeypatch.setattr(PreparedData, "records", lambda self, split=None: self._all_records[:4])
    task = EvaluatorTask(load_train(None, TrainEvaluatorConfig, overrides))
    with torch.no_grad():
        assert list(task.validation(task.module)) == ["loss"]


def test_batches_are_pure_functions_of_their_part(data: Path, tmp_path: Path) -> None:
    overrides = [f"data={data}", f"output={tmp_path}", *SHORT]
    task = EvaluatorTask(load_train(None, TrainEvaluatorConfig, overrides))
    first, again = task.batch(Part(3, 0, 2)), task.batch(Part(3, 0, 2))
    other = task.batch(Part(3, 1, 2))
    assert first.captions == again.captions and torch.equal(first.joints, again.joints)
    assert len(first.captions) == 16 and first.captions != other.captions
    loss = task.training_step(task.module, first)["loss"]
    assert torch.isfinite(loss)


def test_batches_depend_on_nothing_but_their_generator(data: Path) -> None:
    clips = PreparedData.open(data)
    config = TrainEvaluatorConfig(min_frames=16, max_frames=48, languages=("en",))
    pairs = PairSet(clips, "train", config)
    first, again = (pairs.batch(8, np.random.default_rng(5)) for _ in range(2))
    assert first.captions == again.captions and torch.equal(first.joints, again.joints)
    assert first.joints.shape[:2] == first.mask.shape and first.mask.shape[1] <= 48
    assert first.same.diagonal().all() and torch.equal(first.same, first.same.T)
    assert torch.isfinite(pairs.frames()).all()
    with pytest.raises(UserError, match="captions in xx"):
        PairSet(clips, "train", config.model_copy(update={"languages": ("xx",)}))


def test_contrastive_loss_of_one_positive_is_cross_entropy() -> None:
    torch.manual_seed(0)
    text, motion = torch.randn(2, 6, 8).unbind()
    logits, target = 3 * text @ motion.T, torch.arange(6)
    expected = (
        torch.nn.functional.cross_entropy(logits, target)
        + torch.nn.functional.cross_entropy(logits.T, target)
    ) / 2
    ours = contrastive_loss(text, motion, torch.eye(6, dtype=torch.bool), 3.0)
    assert torch.allclose(ours, expected)


def test_contrastive_loss_does_not_push_equal_labels_apart() -> None:
    same = torch.ones(4, 4, dtype=torch.bool)
    collapsed = torch.nn.functional.normalize(torch.ones(4, 8), dim=-1).requires_grad_()
    contrastive_loss(collapsed, collapsed.detach(), same, 10.0).backward()
    assert collapsed.grad is not None
    assert torch.allclose(collapsed.grad, torch.zeros_like(collapsed), atol=1e-6)
