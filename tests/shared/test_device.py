"""Device and precision: the order of preference, the reasons, the errors."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
import torch

from src.shared import device as device_module
from src.shared.device import autocast, choose_compute, choose_device, set_threads
from src.shared.errors import UsageError


@pytest.fixture
def only_cpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    monkeypatch.setattr(torch.backends.mps, "is_available", lambda: False)


@pytest.mark.usefixtures("only_cpu")
def test_cpu_when_there_is_nothing_else() -> None:
    assert choose_device() == ("cpu", "no GPU found")


def test_cuda_comes_before_mps_before_cpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.backends.mps, "is_available", lambda: True)
    monkeypatch.setattr(torch.cuda, "is_available", lambda: True)
    monkeypatch.setattr(torch.cuda, "get_device_name", lambda: "a card")
    assert choose_device() == ("cuda", "a card")
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    assert choose_device()[0] == "mps"
    assert choose_device("cpu") == ("cpu", "as requested")


@pytest.mark.usefixtures("only_cpu")
@pytest.mark.parametrize(
    ("device", "precision", "parts"),
    [
        ("cuda", "auto", ["'cuda'", "not available", "cpu"]),
        ("tpu", "auto", ["'tpu'", "unknown"]),
        ("cpu", "fp16", ["'fp16'", "GPU", "bf16"]),
        ("cpu", "int8", ["'int8'", "unknown"]),
    ],
)
def test_what_is_not_there_is_an_error(device: str, precision: str, parts: list[str]) -> None:
    with pytest.raises(UsageError) as caught:
        choose_compute(device, precision)
    assert all(part in str(caught.value) for part in parts)


@pytest.mark.usefixtures("only_cpu")
@pytest.mark.parametrize("native", [True, False])
def test_bf16_only_where_the_hardware_has_it(monkeypatch: pytest.MonkeyPatch, native: bool) -> None:
    monkeypatch.setattr(device_module, "_native_bf16", lambda device: (native, "because"))
    compute = choose_compute()
    assert compute.precision == ("bf16" if native else "no")
    assert "because" in str(compute)
    asked = choose_compute("cpu", "bf16")
    assert asked.precision == "bf16" and ("because" in asked.precision_reason) is not native


@pytest.mark.usefixtures("only_cpu")
def test_the_reason_names_an_instruction_set() -> None:
    assert "bf16" in choose_compute().precision_reason.lower() or "AMX" in str(choose_compute())


@pytest.mark.usefixtures("only_cpu")
def test_autocast_follows_the_choice() -> None:
    linear = torch.nn.Linear(2, 2)
    for precision, dtype in (("bf16", torch.bfloat16), ("no", torch.float32)):
        with autocast(choose_compute("cpu", precision)):
            assert linear(torch.ones(1, 2)).dtype == dtype


def test_threads_are_set_and_told() -> None:
    before = torch.get_num_threads()
    try:
        assert set_threads(1) == 1
        assert set_threads(None) == 1
    finally:
        torch.set_num_threads(before)


@pytest.mark.usefixtures("only_cpu")
def test_what_the_launcher_asks_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ACCELERATE_MIXED_PRECISION", "bf16")
    assert choose_compute().precision == "bf16"
    assert choose_compute("auto", "no").precision == "no"
    monkeypatch.setattr(torch.backends.mps, "is_available", lambda: True)
    monkeypatch.setenv("ACCELERATE_USE_CPU", "true")
    assert choose_compute().device == "cpu"
    assert choose_compute("mps").device == "mps"


def test_sampling_leaves_busy_cores_to_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(device_module, "_chosen_threads", None)
    before = torch.get_num_threads()
    torch.set_num_threads(2)
    try:
        for idle, taken in ((5, 2), (1, 1), (-3, 1)):
            monkeypatch.setattr(device_module, "idle_cores", lambda idle=idle: idle)
            with device_module.idle_threads():
                assert torch.get_num_threads() == taken
            assert torch.get_num_threads() == 2
        device_module.set_threads(2)  # a number that somebody chose is kept
        with device_module.idle_threads():
            assert torch.get_num_threads() == 2
    finally:
        torch.set_num_threads(before)


@pytest.mark.skipif(not Path("/proc/loadavg").exists(), reason="Linux tells")
def test_a_busy_process_takes_a_core() -> None:
    def most_idle() -> int:
        found = []
        for _ in range(20):
            found.append(device_module.idle_cores())
            time.sleep(0.01)
        return max(found)

    code = "print(flush=True)\nwhile True: pass"
    alone, cores = most_idle(), os.cpu_count() or 1
    assert alone <= cores
    busy = [
        subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        for _ in range(2 * cores)
    ]
    try:
        for process in busy:
            assert process.stdout is not None
            process.stdout.readline()
        assert most_idle() <= 0
    finally:
        for process in busy:
            process.kill()
            process.communicate()
