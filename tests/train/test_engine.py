"""The training loop: exact resuming, parts that add up, errors that help."""

import json
import math
import sys
from pathlib import Path
from typing import Any, ClassVar

import pytest
import torch
from safetensors import SafetensorError
from safetensors.torch import load_file
from tiny_task import TinyTask

from src.shared.config_schema import TrainConfig
from src.shared.errors import UsageError, UserError
from src.train.checkpoint import latest_checkpoint, require_same_run
from src.train.engine import Trainer

BASE: dict[str, Any] = {
    "device": "cpu",
    "precision": "no",
    "threads": 1,
    "steps": 12,
    "batch_size": 4,
    "warmup_steps": 2,
    "log_every": 4,
    "validate_every": 6,
    "save_every": 4,
    "tensorboard": False,
}


def run(output: Path, *, resume: bool = False, **settings: Any) -> Trainer[TrainConfig]:
    config = TrainConfig(**{**BASE, "output": str(output), **settings})
    trainer = Trainer(config, TinyTask, command="again", resume=resume)
    trainer.train()
    return trainer


def final(output: Path, name: str = "model") -> dict[str, torch.Tensor]:
    newest = sorted((output / "checkpoints").iterdir())[-1]
    return load_file(newest / f"{name}.safetensors")


def same(first: dict[str, torch.Tensor], second: dict[str, torch.Tensor]) -> bool:
    return first.keys() == second.keys() and all(torch.equal(first[k], second[k]) for k in first)


def close(first: dict[str, torch.Tensor], second: dict[str, torch.Tensor]) -> bool:
    return all(torch.allclose(first[k], second[k], atol=1e-6) for k in first)


def test_a_run_learns_and_leaves_everything_behind(tmp_path: Path) -> None:
    run(tmp_path, steps=300, learning_rate=0.05, validate_every=100, log_every=50, ema_decay=0.9)
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    losses = [line["validation/loss"] for line in lines if "validation/loss" in line]
    assert losses[-1] < 0.5 * losses[0]
    assert {"loss", "error", "grad-norm", "learning-rate", "steps-per-second"} <= lines[0].keys()
    assert (tmp_path / "weights.pt").exists() and (tmp_path / "finished.json").exists()
    assert (tmp_path / "samples" / "00000300" / "sample.txt").exists()
    assert len(list((tmp_path / "checkpoints").iterdir())) == 2  # the last two are kept
    assert not list(tmp_path.rglob("*.part"))


def test_resuming_is_bitwise_the_same(tmp_path: Path) -> None:
    whole, halves = tmp_path / "whole", tmp_path / "halves"
    run(whole)
    # the schedule must not see the shorter run: constant after warm-up
    run(tmp_path / "whole-constant", lr_schedule="constant")
    run(halves, steps=8, lr_schedule="constant")
    run(halves, resume=True, lr_schedule="constant")
    for name in ("model", "ema", "optimizer"):
        assert same(final(tmp_path / "whole-constant", name), final(halves, name))
    assert not same(final(whole), final(halves))


def test_a_finished_run_says_so_and_does_nothing(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    run(tmp_path)
    (tmp_path / "weights.pt").unlink()
    run(tmp_path, resume=True)
    assert "finished (12 steps): nothing to do" in capfd.readouterr().err
    assert not (tmp_path / "weights.pt").exists()


def test_a_run_killed_before_its_export_only_exports(tmp_path: Path) -> None:
    run(tmp_path)
    before = final(tmp_path)
    (tmp_path / "finished.json").unlink()
    (tmp_path / "weights.pt").unlink()
    run(tmp_path, resume=True)
    assert (tmp_path / "weights.pt").exists() and same(before, final(tmp_path))


def test_a_folder_with_a_run_is_never_overwritten(tmp_path: Path) -> None:
    run(tmp_path)
    with pytest.raises(UsageError, match="--resume"):
        run(tmp_path)


def test_resuming_with_other_settings_names_the_setting(tmp_path: Path) -> None:
    run(tmp_path)
    with pytest.raises(UsageError, match=r"was 4 and is now 8"):
        run(tmp_path, resume=True, batch_size=8)


def test_other_settings_are_told_before_the_task_is_made(tmp_path: Path) -> None:
    run(tmp_path)
    config = TrainConfig(**{**BASE, "output": str(tmp_path), "batch_size": 8})
    with pytest.raises(UsageError, match="batch"):
        Trainer(config, lambda _: pytest.fail("made"), command="again", resume=True)


def test_resuming_a_run_of_another_stage_says_so(tmp_path: Path) -> None:
    run(tmp_path)
    checkpoint = latest_checkpoint(tmp_path / "checkpoints")
    assert checkpoint is not None
    with pytest.raises(UsageError, match=r"a run of another stage, .*\(cosine\)"):
        require_same_run(checkpoint, {**checkpoint.state["identity"], "cosine": 0.2})


def test_fewer_steps_than_done_is_refused(tmp_path: Path) -> None:
    run(tmp_path)
    with pytest.raises(UsageError, match=r"steps 8 is below step 12"):
        run(tmp_path, resume=True, steps=8)


def test_a_full_disk_is_one_line_and_leaves_no_checkpoint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise SafetensorError("I/O error: No space left on device")

    monkeypatch.setattr("src.train.checkpoint.save_file", full)
    with pytest.raises(UserError, match=r"step-00000004: .*No space left.*--resume"):
        run(tmp_path)
    monkeypatch.undo()
    run(tmp_path, resume=True)
    assert not list((tmp_path / "checkpoints").glob(".*"))


def test_a_damaged_checkpoint_is_skipped_and_named(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    run(tmp_path / "whole")
    run(tmp_path / "damaged")
    (tmp_path / "damaged" / "finished.json").unlink()
    path = tmp_path / "damaged" / "checkpoints" / "step-00000012" / "model.safetensors"
    data = bytearray(path.read_bytes())
    data[-1] ^= 1
    path.write_bytes(bytes(data))
    run(tmp_path / "damaged", resume=True)
    error = capfd.readouterr().err
    assert "step-00000012" in error and "SHA-256" in error
    assert "resuming" in error and "after step 8" in error
    assert same(final(tmp_path / "whole"), final(tmp_path / "damaged"))


def test_all_checkpoints_damaged_is_an_error(tmp_path: Path) -> None:
    run(tmp_path)
    for state in tmp_path.rglob("state.json"):
        state.write_text("{")
    with pytest.raises(UserError, match="damaged"):
        run(tmp_path, resume=True)


def test_a_resumed_log_has_each_step_once(tmp_path: Path) -> None:
    run(tmp_path, steps=8)
    with (tmp_path / "log.jsonl").open("a") as stream:
        stream.write('{"step": 10, "loss": 1.0}\n{"step": 11, "lo')  # after the checkpoint, cut
    run(tmp_path, resume=True)
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert [line["step"] for line in lines if "loss" in line] == [4, 8, 12]


def log_of(output: Path) -> list[dict[str, Any]]:
    """Lines of log.jsonl without what time makes of them."""
    lines = [json.loads(line) for line in (output / "log.jsonl").read_text().splitlines()]
    return [{k: v for k, v in line.items() if k != "steps-per-second"} for line in lines]


def killed_at(
    output: Path, monkeypatch: pytest.MonkeyPatch, what: str, step: int, **settings: Any
) -> None:
    """A run that ends, as with `kill -9`, where `what` of the trainer is called for a step."""
    whole = getattr(Trainer, what)

    def killed(self: Trainer[TrainConfig], at: int, *rest: Any) -> Any:
        if at == step:
            raise SystemExit("killed")
        return whole(self, at, *rest)

    monkeypatch.setattr(Trainer, what, killed)
    with pytest.raises(SystemExit):
        run(output, **settings)
    monkeypatch.undo()


@pytest.mark.parametrize("log_every", [4, 5])
def test_a_killed_and_resumed_run_logs_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, log_every: int
) -> None:
    """A mean over steps before and after the checkpoint is that of all of them."""
    run(tmp_path / "whole", log_every=log_every)
    killed_at(tmp_path / "killed", monkeypatch, "_optimize", 10, log_every=log_every)
    run(tmp_path / "killed", resume=True, log_every=log_every)
    assert log_of(tmp_path / "killed") == log_of(tmp_path / "whole")
    assert same(final(tmp_path / "whole"), final(tmp_path / "killed"))


@pytest.mark.parametrize("step", [6, 12])
def test_a_kill_between_checkpoint_and_samples_loses_neither(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: int
) -> None:
    run(tmp_path / "whole", save_every=6)
    killed_at(tmp_path / "killed", monkeypatch, "_validate", step, save_every=6)
    assert not (tmp_path / "killed" / "samples" / f"{step:08d}").exists()
    run(tmp_path / "killed", resume=True, save_every=6)
    for output in ("whole", "killed"):
        assert sorted(p.name for p in (tmp_path / output / "samples").iterdir()) == [
            "00000006",
            "00000012",
        ]
    assert log_of(tmp_path / "killed") == log_of(tmp_path / "whole")


def test_a_kill_before_the_export_logs_the_last_step_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(tmp_path / "whole")
    killed_at(tmp_path / "killed", monkeypatch, "_finish", 12)
    run(tmp_path / "killed", resume=True)
    assert log_of(tmp_path / "killed") == log_of(tmp_path / "whole")


def test_an_early_stop_that_was_killed_stays_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings: dict[str, Any] = {"validate_every": 3, "save_every": 100}
    monkeypatch.setattr(Patient, "save_pretrained", lambda *_: sys.exit("killed"))
    with pytest.raises(SystemExit):
        run_patient(tmp_path, **settings)
    monkeypatch.undo()
    run_patient(tmp_path, resume=True, **settings)
    assert json.loads((tmp_path / "finished.json").read_text()) == {"steps": 6, "planned": 12}


def test_accumulation_equals_a_larger_batch(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TINY_DROPOUT", "0")
    run(tmp_path / "large", batch_size=8)
    run(tmp_path / "parts", batch_size=4, gradient_accumulation=2)
    assert close(final(tmp_path / "large"), final(tmp_path / "parts"))


def test_batches_made_ahead_change_nothing(tmp_path: Path) -> None:
    run(tmp_path / "now")
    run(tmp_path / "ahead", num_workers=2)
    assert same(final(tmp_path / "now"), final(tmp_path / "ahead"))


def test_another_seed_gives_other_weights(tmp_path: Path) -> None:
    run(tmp_path / "a")
    run(tmp_path / "b", seed=1)
    assert not same(final(tmp_path / "a"), final(tmp_path / "b"))


def test_bf16_trains_and_keeps_float32_weights(tmp_path: Path) -> None:
    run(tmp_path, precision="bf16")
    weights = final(tmp_path)
    assert all(w.dtype == torch.float32 and torch.isfinite(w).all() for w in weights.values())


@pytest.mark.parametrize("spoilt", [1, 7])
def test_a_loss_that_is_not_finite_stops_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spoilt: int
) -> None:
    monkeypatch.setenv("TINY_NAN", str(spoilt))
    with pytest.raises(UserError, match=r"loss is nan .* step .*learning-rate 0\.001"):
        run(tmp_path)
    saved = sorted(p.name for p in (tmp_path / "checkpoints").glob("step-*"))
    assert saved == (["step-00000004"] if spoilt == 7 else [])


def test_failing_samples_do_not_end_a_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise RuntimeError("no paint")

    monkeypatch.setattr(TinyTask, "export_samples", broken)
    run(tmp_path)
    assert "RuntimeError: no paint" in capfd.readouterr().err
    assert (tmp_path / "finished.json").exists()


def test_wrong_number_of_processes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"1 process.* 2 were asked for"):
        run(tmp_path, processes=2)


def test_the_average_follows_its_definition() -> None:
    from src.train.engine import ExponentialMovingAverage

    module = torch.nn.Linear(1, 1, bias=False)
    ema = ExponentialMovingAverage(module, decay=0.5)
    expected = module.weight.item()
    for update in range(6):
        with torch.no_grad():
            module.weight.add_(1)
        ema.update(update)
        decay = min(0.5, (1 + update) / (10 + update))
        expected = decay * expected + (1 - decay) * module.weight.item()
    assert math.isclose(ema.module.weight.item(), expected, rel_tol=1e-5)
    assert not ema.module.weight.requires_grad


class Patient(TinyTask):
    """Gives up after two looks; the last layer learns at a rate of its own."""

    learning_rates: ClassVar[dict[str, float]] = {"2.": 0.01}

    def has_converged(self) -> bool:
        return len((Path(self.config.output) / "log.jsonl").read_text().split("validation")) > 3


def run_patient(output: Path, *, resume: bool = False, **settings: Any) -> Trainer[TrainConfig]:
    config = TrainConfig(**{**BASE, "output": str(output), "validate_first": True, **settings})
    trainer = Trainer(config, Patient, command="again", resume=resume)
    trainer.train()
    return trainer


def test_a_task_may_end_early(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    settings: dict[str, Any] = {"validate_every": 3, "save_every": 100}
    run_patient(tmp_path, **settings)
    lines = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert [line["step"] for line in lines if "validation/loss" in line] == [0, 3, 6]
    assert json.loads((tmp_path / "finished.json").read_text()) == {"steps": 6, "planned": 12}
    assert (tmp_path / "checkpoints" / "step-00000006").is_dir()
    capfd.readouterr()
    run_patient(tmp_path, resume=True, **settings)
    assert "finished (6 steps): nothing to do" in capfd.readouterr().err


def test_parts_of_a_module_have_their_own_learning_rates(tmp_path: Path) -> None:
    trainer = run_patient(tmp_path, steps=4, warmup_steps=0, lr_schedule="linear")
    rates = {
        weight.shape: (group["initial_lr"], group["lr"], group["weight_decay"])
        for group in trainer.optimizer.param_groups
        for weight in group["params"]
    }
    assert rates[(1, 8)] == pytest.approx((0.01, 0.0025, 0.01))  # a quarter is left at the end
    assert rates[(1,)] == pytest.approx((0.01, 0.0025, 0.0))
    assert rates[(8, 3)] == pytest.approx((0.001, 0.00025, 0.01))
    assert rates[(8,)] == pytest.approx((0.001, 0.00025, 0.0))


def test_a_new_run_forgets_the_log_of_an_old_one(tmp_path: Path) -> None:
    (tmp_path / "log.jsonl").write_text('{"step": 0, "loss": 9.0}\n')
    run(tmp_path, steps=4)
    assert '"loss": 9.0' not in (tmp_path / "log.jsonl").read_text()


@pytest.mark.gpu
@pytest.mark.skipif(not torch.cuda.is_available(), reason="no CUDA device")
def test_a_gpu_follows_the_cpu_and_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TINY_DROPOUT", "0")
    run(tmp_path / "cpu", lr_schedule="constant")
    run(tmp_path / "gpu", device="cuda", lr_schedule="constant", steps=8)
    run(tmp_path / "gpu", device="cuda", lr_schedule="constant", resume=True)
    assert all(
        torch.allclose(value, final(tmp_path / "gpu")[name], atol=1e-3)
        for name, value in final(tmp_path / "cpu").items()
    )


@pytest.mark.gpu
@pytest.mark.skipif(not torch.cuda.is_available(), reason="no CUDA device")
def test_captured_passes_learn_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TINY_DROPOUT", "0")
    monkeypatch.setattr(TinyTask, "can_be_captured", True)
    run(tmp_path / "graphs", device="cuda")
    run(tmp_path / "kernels", device="cuda", cuda_graphs=False)
    one, other = final(tmp_path / "graphs"), final(tmp_path / "kernels")
    assert all(torch.allclose(value, other[name], atol=1e-6) for name, value in one.items())
