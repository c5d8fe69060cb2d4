"""Previews as tests read them: the elements, the scripts and the data of a page."""

import base64
import json
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

HOSTILE = ["</script><script>alert(1)</script>", "<!--<script>", "a & b \u2028 \ud800 ' \"",
           "@DATA@ @SCRIPT@", "\\1 \\g<0>", "歩く", "", "x" * 5000]  # fmt: skip


class Page(HTMLParser):
    """Elements of a page, and the text of its scripts."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))
        self.data = json.loads(self.scripts[0])

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag == "script":
            self.scripts.append("")

    def handle_data(self, data: str) -> None:
        if self.scripts and self.lasttag == "script":
            self.scripts[-1] += data


def array(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), kind)
