"""kill -9, Ctrl-C and several processes, on real processes."""

import os
import shlex
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
import torch
from click.testing import Result
from safetensors.torch import load_file
from tiny_task import STAGE
from typer.testing import CliRunner

from tests.shared.holder import held

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX signals")
ROOT = Path(__file__).parents[2]
PROGRAM = str(Path(__file__).with_name("tiny_task.py"))
SETTINGS = """
device: cpu
precision: no
threads: 1
batch-size: 4
steps: 16
save-every: 2
log-every: 4
warmup-steps: 2
tensorboard: false
"""


def arguments(output: Path) -> list[str]:
    """The program's flags for a run in `output`."""
    config = output.with_suffix(".yaml")
    config.write_text(SETTINGS)
    return ["--config", str(config), "--output", str(output)]


def environment(**extra: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1", **extra}


def start(output: Path, *more: str, **extra: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, PROGRAM, *arguments(output), *more],
        env=environment(**extra),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
    )


def here(output: Path, *more: str) -> Result:
    """The same command in this process, where nothing is told of processes."""
    return CliRunner().invoke(STAGE.app(), [*arguments(output), *more])


def finish(output: Path, *more: str, **extra: str) -> str:
    process = start(output, *more, **extra)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    return errors


def wait_for_checkpoint(process: "subprocess.Popen[str]", output: Path) -> None:
    deadline = time.monotonic() + 120
    while not list(output.glob("checkpoints/step-*")):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)


def final(output: Path, name: str) -> dict[str, torch.Tensor]:
    return load_file(output / "checkpoints" / "step-00000016" / f"{name}.safetensors")


def assert_same_run(first: Path, second: Path) -> None:
    for name in ("model", "ema", "optimizer"):
        one, other = final(first, name), final(second, name)
        assert one.keys() == other.keys()
        assert all(torch.equal(one[key], other[key]) for key in one), name


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that nothing stops."""
    output = tmp_path_factory.mktemp("runs") / "whole"
    done = here(output)
    assert done.exit_code == 0, done.output
    return output


def test_resume_after_kill_9_is_bitwise_the_same(whole: Path, tmp_path: Path) -> None:
    killed = start(tmp_path / "killed", TINY_SLEEP="0.05")
    wait_for_checkpoint(killed, tmp_path / "killed")
    killed.send_signal(signal.SIGKILL)
    killed.communicate()
    assert killed.returncode == -signal.SIGKILL
    assert not (tmp_path / "killed" / "finished.json").exists()
    errors = finish(tmp_path / "killed", "--resume")
    assert "resuming" in errors
    assert_same_run(whole, tmp_path / "killed")


def test_ctrl_c_saves_prints_the_command_and_exits_130(whole: Path, tmp_path: Path) -> None:
    process = start(tmp_path / "stopped", TINY_SLEEP="0.05")
    wait_for_checkpoint(process, tmp_path / "stopped")
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in errors
    command = shlex.split(errors.strip().splitlines()[-1].partition("continue with: ")[2])
    assert command[:3] == ["accelerate", "launch", "-m"] and command[-1] == "--resume"
    assert str(tmp_path / "stopped") in command
    done = here(tmp_path / "stopped", "--resume")
    assert done.exit_code == 0 and "resuming" in done.stderr
    assert_same_run(whole, tmp_path / "stopped")


def test_a_mistake_is_one_line_and_exit_code_2(tmp_path: Path) -> None:
    done = here(tmp_path / "wrong", "stepz=3")
    assert done.exit_code == 2
    assert done.output.strip().splitlines() == [
        "error: command line: unknown key stepz (value 3); the nearest valid key is steps"
    ]


def test_several_processes_are_started_and_equal_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    errors = finish(tmp_path / "two", "--num-processes", "2", TINY_DROPOUT="0")
    assert "2 process(es)" in errors and "Warning" not in errors
    monkeypatch.setenv("TINY_DROPOUT", "0")
    assert here(tmp_path / "one", "batch-size=8").exit_code == 0
    for name in ("model", "ema"):
        two, one = final(tmp_path / "two", name), final(tmp_path / "one", name)
        assert all(torch.allclose(two[key], one[key], atol=1e-5) for key in one)
    again = start(tmp_path / "two", "--num-processes", "2")
    _, errors = again.communicate(timeout=120)
    assert again.returncode == 2
    assert errors.startswith("error: ") and len(errors.splitlines()) == 1


def test_ctrl_c_stops_several_processes_with_one_line(tmp_path: Path) -> None:
    process = start(tmp_path / "stopped", "--num-processes", "2", TINY_SLEEP="0.05")
    wait_for_checkpoint(process, tmp_path / "stopped")
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in errors
    told = [line for line in errors.splitlines() if "continue with: " in line]
    assert len(told) == 1 and told == errors.splitlines()[-1:]
    assert "--num-processes 2" in told[0]


def test_several_processes_do_not_outlive_the_one_that_started_them(tmp_path: Path) -> None:
    process = start(tmp_path / "run", "--num-processes", "2", "steps=9999", TINY_SLEEP="0.05")
    wait_for_checkpoint(process, tmp_path / "run")
    process.kill()
    _, errors = process.communicate(timeout=60)  # ends when nobody holds stderr any more
    assert "stopped and saved" in errors


def test_a_second_run_in_the_same_folder_is_refused(tmp_path: Path) -> None:
    output = tmp_path / "run"
    with held(output):
        done = here(output)
    assert done.exit_code == 1
    assert done.output.startswith(f"error: another process is writing {output}; wait")
    assert len(done.output.splitlines()) == 1


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.mark.slow
@pytest.mark.parametrize("launcher", ["accelerate", "torchrun"])
def test_two_processes_equal_one_with_twice_the_batch(tmp_path: Path, launcher: str) -> None:
    port = str(_free_port())
    if launcher == "accelerate":
        module = "accelerate.commands.launch"
        flags = ["--multi_gpu", "--num_processes", "2", "--main_process_port", port]
    else:
        module, flags = "torch.distributed.run", ["--nproc_per_node", "2", "--master_port", port]
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            module,
            *flags,
            PROGRAM,
            *arguments(tmp_path / "two"),
            "processes=2",
        ],
        env=environment(TINY_DROPOUT="0", ACCELERATE_USE_CPU="true"),
        cwd=ROOT,
        stderr=subprocess.PIPE,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "2 process(es)" in done.stderr
    finish(tmp_path / "one", "batch-size=8", TINY_DROPOUT="0")
    for name in ("model", "ema"):
        two, one = final(tmp_path / "two", name), final(tmp_path / "one", name)
        assert all(torch.allclose(two[key], one[key], atol=1e-5) for key in one)
