"""HTML preview: self-contained, safe against any caption, and it runs without console errors."""

import base64
import json
import re
import shutil
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.formats.html import write_html
from src.shared.motion.motion import Motion

NASTY = [
    "</script><script>document.title='hacked'</script>",
    "<!-- <script> & <b>bold</b>",
    "@DATA@ @SCRIPT@",
    "走る人 – «ünï» \u2028 \U0001f57a",
    "",
]


def a_motion(text: str = "a person waves", frames: int = 12) -> Motion:
    quaternions = np.zeros((frames, 22, 4), np.float32)
    quaternions[..., 0] = 1.0
    root = np.zeros((frames, 3), np.float32)
    root[:, 1], root[:, 2] = 0.95, np.linspace(0, 1, frames)
    contacts = np.tile(np.array([1.0, 0.0], np.float32), (frames, 1))
    return Motion(quaternions, root, contacts, 30.0, text)


class Page(HTMLParser):
    """Collects elements and the text of the scripts."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag == "script":
            self.scripts.append("")

    def handle_data(self, data: str) -> None:
        if self.tags and self.tags[-1][0] == "script":
            self.scripts[-1] += data


def data_of(path: Path) -> tuple[Page, Any]:
    page = Page(path.read_text("utf-8"))
    return page, json.loads(page.scripts[0])


def test_captions_survive_and_cannot_act_as_markup(tmp_path: Path) -> None:
    motions = [a_motion(text) for text in NASTY]
    page, data = data_of(write_html(motions, tmp_path / "a.html"))
    assert [motion["text"] for motion in data["motions"]] == NASTY
    assert len(page.scripts) == 2
    assert "hacked" not in page.scripts[1]
    assert not [tag for tag, _ in page.tags if tag == "b" and "bold" in page.scripts[1]]


def test_arrays_decode_to_the_motion(tmp_path: Path) -> None:
    motion = a_motion()
    _, data = data_of(write_html(motion, tmp_path / "a.html"))
    held = data["motions"][0]
    turns = np.frombuffer(base64.b64decode(held["quaternions"]), "<i2").reshape(12, 22, 4)
    np.testing.assert_allclose(turns / 32767, motion.quaternions, atol=5e-5)
    root = np.frombuffer(base64.b64decode(held["root"]), "<f4").reshape(12, 3)
    np.testing.assert_array_equal(root, motion.root_position)
    contacts = np.frombuffer(base64.b64decode(held["contacts"]), "u1").reshape(12, 2)
    np.testing.assert_array_equal(contacts, motion.contacts * 255)
    assert (held["frames"], held["fps"]) == (12, 30.0)


def test_nothing_is_fetched(tmp_path: Path) -> None:
    path = write_html(a_motion(), tmp_path / "a.html")
    page, _ = data_of(path)
    for tag, attributes in page.tags:
        assert tag != "iframe"
        for name in ("src", "href", "srcset", "action"):
            assert (attributes.get(name) or "data:").startswith("data:")
    assert not re.search(r"https?://|url\(|import\(|fetch\(|XMLHttp", path.read_text("utf-8"))
    policy = [a["content"] for t, a in page.tags if t == "meta" and "http-equiv" in a]
    assert policy and "default-src 'none'" in str(policy[0])


def test_nothing_to_show(tmp_path: Path) -> None:
    with pytest.raises(UserError):
        write_html([], tmp_path / "a.html")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("graphics", ["webgl", "flat"])
def test_runs_in_a_browser_without_console_errors(tmp_path: Path, graphics: str) -> None:
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        pytest.skip("chromium is not installed")
    motions = [a_motion(NASTY[0]), a_motion(NASTY[3]), replace(a_motion(frames=1), text="still")]
    path = write_html(motions, tmp_path / "a.html")
    # Errors end up in the page's own text, so that one dump of the page tells everything.
    trap = "<script>addEventListener('error', (e) => {document.body.dataset.error = e.message});"
    path.write_text(
        path.read_text("utf-8").replace("<main>", trap + "</script><main>"), encoding="utf-8"
    )
    webgl = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    flags = webgl if graphics == "webgl" else ["--disable-gpu", "--disable-3d-apis"]
    command = [browser, "--headless", "--no-sandbox", "--virtual-time-budget=200", "--dump-dom",
               "--enable-logging=stderr", f"--user-data-dir={tmp_path / 'profile'}", *flags,
               "--window-size=360,400", path.as_uri()]  # fmt: skip
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    dom, log = result.stdout, result.stderr
    assert result.returncode == 0
    assert "data-error" not in dom
    assert not [line for line in log.splitlines() if "CONSOLE" in line and "Uncaught" in line]
    assert dom.count("<figcaption>") == len(motions)
    assert "走る人" in dom
    assert "<title>hacked" not in dom
    assert re.search(r'id="clock">\d+\.\d\d / 0\.37 s', dom)
