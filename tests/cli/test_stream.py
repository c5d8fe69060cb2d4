"""`stream`: sentences piped in, frames out, on stdout and by VMC."""

import itertools
import json
import os
import signal
import socket
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from src.cli import stream as stream_module
from src.cli.tools import app

ROOT = Path(__file__).parents[2]


def test_sentences_from_a_pipe() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as listener:
        listener.bind(("127.0.0.1", 0))
        listener.settimeout(60)
        port = listener.getsockname()[1]
        command = ["-m", "src.cli.tools", "stream", "--seconds", "2", "--no-real-time", "--json"]
        command += ["--prompt", "a person juggles"]
        result = subprocess.run(
            [sys.executable, *command, "--steps", "2", "--vmc", str(port)],
            input="a person waves\n\n", capture_output=True, text=True, cwd=ROOT,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )  # fmt: skip
        assert result.returncode == 0, result.stderr
        assert listener.recv(65536).startswith(b"#bundle\0")
    frames = [json.loads(line) for line in result.stdout.splitlines()]
    assert [frame["frame"] for frame in frames] == list(range(60))
    assert frames[-1]["text"] == "a person waves"
    assert "60 frames" in result.stderr and "torch" not in result.stderr
    assert "warning: prompt 'a person juggles' asks for 'juggles'" in result.stderr


@pytest.mark.parametrize(("apart", "late"), [(2.0, False), (0.0, True)])
def test_lines_of_a_pipe_are_heard_as_they_come_those_of_a_file_are_each_seen(
    apart: float, late: bool
) -> None:
    command = [sys.executable, "-m", "src.cli.tools", "stream", "--steps", "1", "--no-foot-lock"]
    pipes: dict[str, Any] = dict.fromkeys(("stdin", "stdout"), subprocess.PIPE)
    with subprocess.Popen([*command, "--seconds", "8"], cwd=ROOT, text=True, **pipes) as process:
        assert process.stdin is not None and process.stdout is not None
        first = process.stdout.readline()
        for sentence in ("a person waves", "a person jumps"):
            process.stdin.write(sentence + "\n")
            process.stdin.flush()
            time.sleep(apart)
        rest, _ = process.communicate(timeout=120)
    texts = [json.loads(line)["text"] for line in [first, *rest.splitlines()]]
    assert len(texts) == 240
    waves, jumps = (texts.index(f"a person {does}") for does in ("waves", "jumps"))
    assert (jumps - waves >= 115) == late  # four seconds of frames


def test_lines_that_came_while_it_loaded_are_each_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    now = time.monotonic()
    lines = [(now - 9, "a person waves"), (now - 6, "a person jumps"), (now - 3, "a person bows")]
    monkeypatch.setattr(stream_module, "_as_they_come", lambda: iter(lines))
    command = ["stream", "--no-real-time", "--json", "--steps", "1", "--seconds", "14"]
    result = CliRunner().invoke(app, command)
    assert result.exit_code == 0, result.output
    texts = [json.loads(line)["text"] for line in result.stdout.splitlines()]
    seen = [text for text, _ in itertools.groupby(texts)]
    assert seen[-3:] == [text for _, text in lines]


def test_a_pipe_that_never_ends_is_read_no_further_than_a_bit_ahead(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read = []
    endless = ((0.0, str(number)) for number in itertools.count() if not read.append(number))
    monkeypatch.setattr(stream_module, "_lines", lambda: endless)
    lines = stream_module._as_they_come()
    assert [next(lines)[1] for _ in range(3)] == ["0", "1", "2"]
    time.sleep(0.5)
    assert len(read) < stream_module.AHEAD + 10


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT there")
def test_it_can_be_stopped_while_it_waits_for_a_line() -> None:
    """A thread that waits in Python's buffer of stdin aborted one in six of interpreters."""
    command = [sys.executable, "-m", "src.cli.tools", "stream", "--steps", "2"]
    heard, line = os.pipe()  # `communicate` would close a pipe of its own, and end the stream by 0
    pipes: dict[str, Any] = {"stdin": heard, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    # a shell that runs tests in the background has them ignore Ctrl-C, and so would the stream
    pipes["preexec_fn"] = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    with subprocess.Popen(command, cwd=ROOT, **pipes) as process:
        assert process.stdout.readline().startswith(b"{")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    for end in (heard, line):
        os.close(end)
    assert process.returncode == 130 and b"Fatal" not in errors


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--prompt", " "], "--prompt is empty"),
        (["--websocket", "70000"], "--websocket 70000"),
        (["--vmc", "here:there"], "is no address"),
        (["--window", "9"], "--window 9"),
        (["--root", "off"], "--root 'off'"),
    ],
)
def test_wrong_usage(arguments: list[str], words: str) -> None:
    result = CliRunner().invoke(app, ["stream", *arguments])
    assert result.exit_code == 2 and words in result.stderr
