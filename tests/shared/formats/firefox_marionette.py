"""A headless Firefox that tests talk to by its Marionette protocol (lines of JSON, each after its
length)."""

import json
import shutil
import socket
import subprocess
import time
from pathlib import Path
from typing import Any

NAMES = ("firefox", "firefox-esr")


def firefox() -> str | None:
    """Path of a Firefox; None where none is installed."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


def free_port() -> int:
    """A port of this machine that nobody listens on."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


class Firefox:
    """One page in a browser of its own; a context manager.

    Args:
        url: of the page.
        profile: an empty folder.
        ready: an expression that is true once the page can be asked.
    """

    def __init__(self, url: str, profile: Path, ready: str) -> None:
        port = free_port()
        profile.mkdir(exist_ok=True)
        (profile / "user.js").write_text(f'user_pref("marionette.port", {port});\n')
        command = [
            str(firefox()),
            "--headless",
            "--marionette",
            "--no-remote",
            "--profile",
            profile,
        ]
        quiet = subprocess.DEVNULL
        self._process = subprocess.Popen(command, stdout=quiet, stderr=quiet)
        self._count = 0
        self._socket = connected(port, 60.0)
        self._read()  # who it is
        self.call("WebDriver:NewSession")
        self.call("WebDriver:SetTimeouts", script=300_000)
        self.call("WebDriver:Navigate", url=url)
        self.wait(ready)

    def __enter__(self) -> "Firefox":
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()
        self._process.kill()
        self._process.wait()

    def call(self, command: str, **parameters: Any) -> Any:
        """One command of the protocol and its answer."""
        self._count += 1
        data = json.dumps([0, self._count, command, parameters]).encode()
        self._socket.sendall(f"{len(data)}:".encode() + data)
        _, number, error, result = self._read()
        assert error is None and number == self._count, error
        return result

    def evaluate(self, expression: str) -> Any:
        """The value of an expression in the page; promises are awaited."""
        script = f"return (async () => ({expression}))()"
        answer = self.call("WebDriver:ExecuteScript", script=script, args=[], sandbox=None)
        return answer["value"]

    def wait(self, condition: str, seconds: float = 60.0) -> None:
        """Until an expression is true."""
        end = time.monotonic() + seconds
        while not self.evaluate(f"Boolean({condition})"):
            assert time.monotonic() < end, f"{condition} is not true after {seconds} s"
            time.sleep(0.1)

    def _read(self) -> Any:
        length = b""
        while (digit := self._socket.recv(1)) != b":":
            assert digit, "Firefox is gone"
            length += digit
        data = b""
        while len(data) < int(length):
            data += self._socket.recv(int(length) - len(data))
        return json.loads(data)


def connected(port: int, seconds: float) -> socket.socket:
    """To a port of this machine, as soon as somebody listens there."""
    end = time.monotonic() + seconds
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=300)
        except OSError:
            assert time.monotonic() < end, f"nobody listens on {port} after {seconds} s"
            time.sleep(0.1)
