"""What tests do with the studio's page, and what they look at."""

import base64
import json
from pathlib import Path

import numpy as np
import pytest

from src.shared.data.retarget.read_motion import read_motion
from src.shared.motion.motion import Motion
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.firefox_marionette import Firefox

BROWSER = pytest.mark.skipif(not chromium(), reason="no Chromium is installed")


def made(browser: Browser, scene: str, clip: str = "") -> None:
    """Make a scene that is written in JavaScript, and wait for it."""
    browser.evaluate(f"studio.history.change({{ takes: 1, path: null, ...{scene} }}); {clip}")
    browser.wait("!studio.making")
    browser.evaluate("studio.make()")
    browser.wait("!studio.making", 180)
    assert browser.evaluate("document.getElementById('status').className") == "note"


def exported(browser: Browser | Firefox, folder: Path, kind: str = "bvh") -> Motion:
    """What the page saves, read by our own reader."""
    text = browser.evaluate(
        f"btoa(Array.from(studio.bytes('{kind}'), (b) => String.fromCharCode(b)).join(''))"
    )
    path = folder / f"page.{kind}"
    path.write_bytes(base64.b64decode(text))
    return read_motion(path)


def assert_same(page: Motion, command: Motion) -> None:
    np.testing.assert_allclose(page.positions(), command.positions(), atol=1e-4)


def opened(browser: Browser, name: str, data: bytes) -> str:
    """Drop a file; what the page says."""
    coded = base64.b64encode(data).decode()
    bytes_ = f"Uint8Array.from(atob('{coded}'), (sign) => sign.charCodeAt(0))"
    browser.evaluate(f"studio.openClip(new File([{bytes_}], {json.dumps(name)}))")
    return str(browser.evaluate("document.getElementById('status').textContent"))


def with_blocks(browser: Browser, *blocks: tuple[str, float]) -> None:
    """Put sentences into the timeline."""
    rows = [{"text": text, "seconds": seconds} for text, seconds in blocks]
    browser.evaluate(f"studio.history.change({{ blocks: {json.dumps(rows)}, path: null }})")


def text_of(browser: Browser, name: str) -> str:
    return str(browser.evaluate(f"document.getElementById('{name}').textContent"))


def typed(browser: Browser, key: str, on: str = "document.activeElement", **held: bool) -> bool:
    """One key, perhaps with others held; whether the browser is left to do its own with it."""
    options = json.dumps({"key": key, "bubbles": True, "cancelable": True, **held})
    return bool(browser.evaluate(f"{on}.dispatchEvent(new KeyboardEvent('keydown', {options}))"))


def filled(browser: Browser, name: str, value: str, event: str = "change") -> str:
    """Fill a field in; what it shows then."""
    field = f"document.getElementById('{name}')"
    browser.evaluate(f"{field}.value = {json.dumps(value)}")
    browser.evaluate(f"{field}.dispatchEvent(new Event('{event}'))")
    return str(browser.evaluate(f"{field}.value"))


PAYLOADS = (
    "<img src=x onerror=globalThis.hacked=1>",
    '"><svg/onload=globalThis.hacked=1>',
    "javascript:globalThis.hacked=1//../../etc",
)


BVH = """HIERARCHY
ROOT {}
{{
OFFSET 0 0 0
CHANNELS 3 Xrotation Yrotation Zrotation
}}
MOTION
Frames: 1
Frame Time: 0.03
0 0 0
"""
