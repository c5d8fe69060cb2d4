"""Readers of tables, captions and configurations."""

import json
import re
from pathlib import Path

from tests.fuzz.target import Target


def _write_tables(folder: Path) -> None:
    from src.shared.config_loader import packaged_config

    for name in ("skeletons.yaml", "labels.yaml", "lightweight.yaml"):
        stem = "network.yaml" if name == "lightweight.yaml" else name
        (folder / name).write_bytes(packaged_config(stem).read_bytes())


def _read_table(path: Path) -> None:
    from src.shared.config_loader import load_network
    from src.shared.data.retarget.mapping import load_mappings
    from src.shared.data.sources import load_label_rules

    match path.stem:
        case "skeletons":
            load_mappings(path)
        case "labels":
            load_label_rules(path).of_file("walk_tired_001")
        case _:
            load_network("lightweight", path)


def _write_templates(folder: Path) -> None:
    """Two languages with few of their actions: one that stands alone, one laid over its own."""
    from src.shared.config_loader import packaged_config

    for name, extends in (("en", "nothing"), ("de", "packaged")):
        text = packaged_config(f"captions/{name}.yaml").read_text("utf-8")
        head, actions, rest = re.split(r"^(?=actions:|paraphrases:)", text, flags=re.M)
        few = re.split(r"^(?=  \w)", actions, flags=re.M)
        parts = (f"extends: {extends}\n", head, *few[:3], few[-1], rest)
        (folder / f"{name}.yaml").write_text("".join(parts), "utf-8")


def _read_templates(path: Path) -> None:
    from src.shared.data.captions.book import CaptionBook

    CaptionBook.load(path.parent)


def _write_captions(folder: Path) -> None:
    rows = [("walk_01", "a person walks", "en"), ("walk_02", "una persona camina", "es")]
    (folder / "a.csv").write_text("clip,caption,language\n" + "\n".join(map(",".join, rows)))
    (folder / "b.tsv").write_text("\n".join(map("\t".join, rows)), encoding="utf-8")
    nested = {"walk_01": {"en": ["a person walks", "walking"], "es": "camina"}, "walk_02": "x"}
    (folder / "c.json").write_text(json.dumps(nested))
    listed = [{"clip": clip, "caption": text, "language": tongue} for clip, text, tongue in rows]
    (folder / "d.json").write_text(json.dumps(listed))


def _read_captions(path: Path) -> None:
    from src.shared.data.captions.tables import match_captions, read_captions

    rows = read_captions(path)
    pieces = [piece for row in rows.values() for piece in row]
    assert all(isinstance(t, str) for p in pieces for ts in p.captions.values() for t in ts)
    match_captions(rows, [("set", ["walk_01.bvh", "a/walk_02.bvh"])])


YAML_WORDS = (
    b"profiles:", b"joints:", b"axes:", b"- name: x", b"pattern: '('", b"? a", b"--- !!set", b"<<:",
    b"&x [*x, *x]", b"*x", b"{a: {a: {a: 1}}}", b"|", b">-", b"pelvis: hip", b"(a+)+$",
)  # fmt: skip
TEXT_TARGETS = {
    "tables": Target(_write_tables, _read_table, words=YAML_WORDS),
    "templates": Target(_write_templates, _read_templates, words=YAML_WORDS),
    "captions": Target(_write_captions, _read_captions, words=(b"clip,text,end", b"id", b'"a\nb"')),
}
