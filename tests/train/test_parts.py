"""The small parts of the trainer: learning rate, seeds, batches ahead, log, resume command."""

import json
import shlex
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from torch import Tensor

from src.shared.io.concurrency import prefetch
from src.train.engine import learning_rate_factor
from src.train.launch import resume_command
from src.train.run_log import RunLog, truncate_log
from src.train.task import generator, mix_seed, to_device


@given(st.integers(1, 500), st.integers(0, 600), st.sampled_from(["cosine", "linear", "constant"]))
def test_learning_rate_warms_up_and_never_rises_again(
    steps: int, warmup: int, schedule: str
) -> None:
    factors = [
        learning_rate_factor(step, steps=steps, warmup=warmup, schedule=schedule)
        for step in range(steps)
    ]
    assert all(0 < f <= 1 for f in factors)
    rising, falling = factors[:warmup], factors[warmup:]
    assert rising == sorted(rising) and falling == sorted(falling, reverse=True)


def test_learning_rate_against_torch() -> None:
    weight = torch.nn.Parameter(torch.zeros(1))
    optimizer = torch.optim.SGD([weight], lr=1.0)
    cosine = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, T_max=40)
    for step in range(40):
        ours = learning_rate_factor(step, steps=40, warmup=0, schedule="cosine")
        assert ours == pytest.approx(cosine.get_last_lr()[0], abs=1e-6)
        optimizer.step()
        cosine.step()


def test_seeds_differ_with_every_part() -> None:
    seeds = {mix_seed(a, b, c) for a in range(5) for b in range(20) for c in ("x", "y")}
    assert len(seeds) == 200 and all(0 <= seed < 2**63 for seed in seeds)
    assert mix_seed(1, 23) != mix_seed(12, 3)
    first, second = (torch.rand(3, generator=generator("a", 1)) for _ in range(2))
    assert torch.equal(first, second)


@pytest.mark.parametrize("workers", [0, 1, 3])
def test_ahead_keeps_the_order(workers: int) -> None:
    made = prefetch(lambda key: (key, threading.get_ident()), iter(range(20)), workers)
    results = list(made)
    assert [key for key, _ in results] == list(range(20))
    main = threading.get_ident()
    assert all((ident == main) is (workers == 0) for _, ident in results)


def test_ahead_hands_errors_on() -> None:
    def make(key: int) -> float:
        return 1 / (2 - key)

    with pytest.raises(ZeroDivisionError):
        list(prefetch(make, iter(range(5)), 2))


@dataclass(frozen=True)
class Pair:
    values: Tensor
    names: list[str]


def test_to_device_goes_through_containers() -> None:
    value: dict[str, Any] = {"a": Pair(torch.ones(2), ["x"]), "b": [torch.ones(1)], "c": 3}
    moved = to_device(value, torch.device("meta"))
    assert moved["a"].values.device.type == "meta" and moved["a"].names == ["x"]
    assert moved["b"][0].device.type == "meta" and moved["c"] == 3


def test_the_log_writes_json_only(tmp_path: Path) -> None:
    with RunLog(tmp_path, start=0, steps=2, main=True, tensorboard=False) as log:
        log.write(1, {"loss": 0.5, "undefined": float("nan")})
        log.write(2, {})
    line = json.loads((tmp_path / "log.jsonl").read_text())
    assert line == {"step": 1, "loss": 0.5, "undefined": None}


def test_other_processes_write_nothing(tmp_path: Path) -> None:
    with RunLog(tmp_path, start=0, steps=2, main=False, tensorboard=True) as log:
        log.write(1, {"loss": 0.5})
    assert not list(tmp_path.iterdir())


def test_tensorboard_gets_the_same_figures(tmp_path: Path) -> None:
    pytest.importorskip("tensorboard")
    with RunLog(tmp_path, start=0, steps=2, main=True, tensorboard=True) as log:
        log.write(1, {"loss": 0.5})
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

    events = EventAccumulator(str(tmp_path / "tensorboard"))
    events.Reload()
    assert [(event.step, event.value) for event in events.Scalars("loss")] == [(1, 0.5)]


def test_truncating_keeps_what_was_saved(tmp_path: Path) -> None:
    path = tmp_path / "log.jsonl"
    path.write_text('{"step": 1}\n{"step": 3}\nnot json\n{"st')
    truncate_log(path, 2)
    assert path.read_text() == '{"step": 1}\n'


def test_the_resume_command_survives_the_shell() -> None:
    command = resume_command("src.train.x", ["--output", "a folder", "--resume", "steps=3"])
    words = shlex.split(command)
    assert words[:4] == ["accelerate", "launch", "-m", "src.train.x"]
    assert words[4:] == ["--output", "a folder", "steps=3", "--resume"]
    own = resume_command("src.train.train_x", ["train", "x", "--output", "a folder"])
    assert own == "motion-tools train x --output 'a folder' --resume"


def test_a_line_says_of_how_many_steps_it_is_and_how_long_the_rest_takes(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with RunLog(tmp_path, start=0, steps=40, main=True, tensorboard=False) as log:
        log.write(20, {"loss": 1.0})
        log.write(40, {"loss": 0.5})
    first, last = capfd.readouterr().err.splitlines()
    assert first.startswith("step 20 of 40  loss 1") and first.endswith("s left")
    assert last == "step 40 of 40  loss 0.5"
