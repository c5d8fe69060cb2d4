"""A headless Chromium that tests talk to through two pipes (the DevTools protocol)."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-3d-apis",  # without WebGL, which software makes slow
    "--disable-background-networking",
    "--disable-dev-shm-usage",  # a container may give it too little shared memory to live on
    "--no-first-run",
    "--mute-audio",
    "--autoplay-policy=no-user-gesture-required",
    "--remote-debugging-pipe",
)
NO_WEBGL = ("--disable-gpu", "--disable-3d-apis")
WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
# The browser reads from descriptor 3 and writes to 4. Either may be in the way: copies above first.
SHIM = """
import fcntl, os, sys
pipes = [int(pipe) for pipe in sys.argv[1:3]]
high = [fcntl.fcntl(pipe, fcntl.F_DUPFD, max(*pipes, 4) + 1) for pipe in pipes]
for place, pipe in zip((3, 4), high):
    os.dup2(pipe, place)
os.execv(sys.argv[3], sys.argv[3:])
"""


def chromium() -> str | None:
    """Path of a Chromium; None where none is installed."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """One page in a browser of its own; a context manager.

    `problems` collects what the page logged as an error or warning, and its exceptions; `requests`
    the addresses that it asked for.
    """

    def __init__(
        self,
        url: str,
        profile: Path,
        size: tuple[int, int] = (700, 500),
        ready: str = "typeof cards === 'object'",
        flags: tuple[str, ...] = (),
        webgl: bool = False,
    ) -> None:
        self.problems: list[str] = []
        self.requests: list[str] = []
        self._count = 0
        base = (*(each for each in FLAGS if each not in NO_WEBGL), *WEBGL) if webgl else FLAGS
        options = (*base, *flags, f"--window-size={size[0]},{size[1]}")
        self._start(*options, f"--user-data-dir={profile}")
        targets = self.call("Target.getTargets")["targetInfos"]
        page = next(target["targetId"] for target in targets if target["type"] == "page")
        attached = self.call("Target.attachToTarget", targetId=page, flatten=True)
        self._session: str | None = attached["sessionId"]
        for domain in ("Runtime", "Log", "Page", "Network"):
            self.call(f"{domain}.enable")
        self.call("Page.navigate", url=url)
        self.wait(f"document.readyState === 'complete' && {ready}")

    def _start(self, *options: str) -> None:
        there, self._out = os.pipe()
        self._in, back = os.pipe()
        shim = [sys.executable, "-c", SHIM, str(there), str(back)]
        self._process = subprocess.Popen(
            [*shim, str(chromium()), *options, "about:blank"],
            pass_fds=(there, back),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(there)
        os.close(back)
        self._rest = b""

    _session: str | None = None

    def __enter__(self) -> "Browser":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._in)
        os.close(self._out)

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """One command of the protocol and its answer."""
        self._count += 1
        message: dict[str, Any] = {"id": self._count, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._read()
            if answer.get("id") == self._count:
                assert "error" not in answer, answer
                return dict(answer["result"])

    def evaluate(self, expression: str) -> Any:
        """The value of an expression in the page; promises are awaited."""
        result = self.call(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def wait(self, condition: str, seconds: float = 60.0) -> None:
        """Until an expression is true."""
        end = time.monotonic() + seconds
        while not self.evaluate(condition):
            assert time.monotonic() < end, condition
            time.sleep(0.05)

    def press(self, key: str) -> None:
        """One key, as the user presses it."""
        for kind in ("keyDown", "keyUp"):
            text = {"text": key} if len(key) == 1 and kind == "keyDown" else {}
            self.call("Input.dispatchKeyEvent", type=kind, key=key, **text)

    def _read(self) -> dict[str, Any]:
        while b"\0" not in self._rest:
            piece = os.read(self._in, 1 << 16)
            if not piece:
                raise EOFError("the browser has gone")
            self._rest += piece
        message, self._rest = self._rest.split(b"\0", 1)
        event: dict[str, Any] = json.loads(message)
        details = event.get("params", {})
        if event.get("method") == "Runtime.exceptionThrown":
            self.problems.append(str(details["exceptionDetails"]))
        elif event.get("method") == "Log.entryAdded":
            self.problems.append(str(details["entry"].get("text")))
        elif event.get("method") == "Runtime.consoleAPICalled":
            self.problems.append(str(details["args"]))
        elif event.get("method") == "Network.requestWillBeSent":
            self.requests.append(details["request"]["url"])
        return event
