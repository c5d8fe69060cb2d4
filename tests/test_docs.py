"""The documentation is true: names import, snippets run, links lead somewhere, commands exist."""

import ast
import importlib
import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from typer.main import get_command

from src.cli.tools import app
from src.shared.motion.skeleton import canonical_skeleton
from src.train.launch import STAGES

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / name for name in ("README.md", "CONTRIBUTING.md")] + sorted(ROOT.glob("docs/*.md"))
API_MAP = (ROOT / "docs" / "api-map.md").read_text(encoding="utf-8")
OURS = sorted(set(re.findall(r"\| `(src\.[\w.]+)` \|$", API_MAP, re.MULTILINE)))
SNIPPETS = re.findall(r"```python\n(.*?)```", API_MAP, re.DOTALL)
SEEDS = ROOT.parent / "shared" / "seeds"


@pytest.mark.parametrize("name", OURS)
def test_mapped_names_exist(name: str) -> None:
    try:
        importlib.import_module(name)
    except ModuleNotFoundError:
        module, _, attribute = name.rpartition(".")
        assert hasattr(importlib.import_module(module), attribute)


def test_the_documents_snippets_run_through_the_map(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # the second writes a model for those after it
    for snippet in SNIPPETS:
        exec(compile(snippet, "docs/api-map.md", "exec"), {"__name__": "snippet"})  # asserts inside


@pytest.mark.skipif(not SEEDS.is_dir(), reason="the source documents are not beside this checkout")
def test_every_printed_import_is_in_the_map() -> None:
    for path in SEEDS.glob("*.txt"):
        for line in path.read_text(encoding="utf-8").splitlines():
            found = re.match(r"from (cc_\w+[\w.]*) import (.+)", line.strip())
            for name in found[2].split(",") if found else []:
                row = rf"from {re.escape(found[1])} import [^`]*\b{name.strip()}\b"
                assert re.search(row, API_MAP), f"{path.name}: {line}"


@pytest.mark.parametrize("profile", ["lightweight", "default", "spark"])
def test_readme_counts_parameters_right(profile: str) -> None:
    import torch

    from src.cli.shape_tables import NUM_TAGS, count, without_download
    from src.shared.config_loader import load_network
    from src.shared.model.clip.core import TextTower
    from src.shared.model.generation.denoiser import MotionDenoiser

    row = re.search(rf"^\| `{profile}` .*$", PAGES[0].read_text(encoding="utf-8"), re.MULTILINE)
    printed = [float(number) for number in re.findall(r"([\d.]+)M", row[0] if row else "")]
    network = load_network(profile)
    with torch.device("meta"):
        tower = TextTower(without_download(network.clip), network.embed_dim)
        denoiser = MotionDenoiser(network, NUM_TAGS)
    for shown, module in zip(printed, (tower, denoiser), strict=True):
        assert shown == pytest.approx(count(module) / 1e6, rel=0.03)


@pytest.mark.parametrize("profile", ["lightweight", "default", "spark"])
def test_readme_counts_audio_parameters_right(profile: str) -> None:
    import torch

    from src.cli.shape_tables import count
    from src.shared.config_loader import load_audio_network
    from src.shared.model.audio.decoder import DerivedMotionDecoder, MotionDecoder
    from src.shared.model.audio.unet import UNet1D

    rows = re.findall(rf"^\| `{profile}` .*$", PAGES[0].read_text(encoding="utf-8"), re.MULTILINE)
    printed = [float(number) for number in re.findall(r"([\d.]+)M", rows[1])]
    network = load_audio_network(profile)
    with torch.device("meta"):
        unet = UNet1D(network.unet, network.condition)
        decoders = [kind(network.decoder) for kind in (MotionDecoder, DerivedMotionDecoder)]
    assert unet.conditioner is not None
    for shown, module in zip(printed, (unet, unet.conditioner, *decoders), strict=True):
        assert shown == pytest.approx(count(module) / 1e6, rel=0.02)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_snippets_import_what_exists(page: Path) -> None:
    for snippet in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL):
        for line in ast.parse(snippet).body:
            if isinstance(line, ast.ImportFrom):
                module = importlib.import_module(line.module or "")
                for name in line.names:
                    assert hasattr(module, name.name), f"{page.name}: {line.module}.{name.name}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)", page.read_text(encoding="utf-8")):
        if not target.startswith(("http://", "https://", "mailto:")):
            assert (page.parent / target).exists(), f"{page.name}: {target}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_commands_in_the_docs_have_only_real_flags(page: Path) -> None:
    commands = get_command(app).commands  # type: ignore[attr-defined]
    text = re.sub(r"\\\n\s*", " ", page.read_text(encoding="utf-8"))
    for name, rest in re.findall(r"(?:motion-tools|src\.cli\.tools) ([a-z][\w-]*)([^\n`|]*)", text):
        assert name in commands, f"{page.name}: {name}"
        command = commands[name]
        if hasattr(command, "commands"):  # a group: the next word is its command
            inner, _, rest = rest.strip().partition(" ")
            if not inner or inner.isupper():  # the group alone, or `train STAGE`
                continue
            command = command.commands[inner]
            if name == "train":  # its stages read their own flags
                command = get_command(STAGES[inner].app())
        known = {f for p in command.params for f in [*p.opts, *p.secondary_opts, "--help"]}
        used = {w for w in shlex.split(rest.replace("…", ""), comments=True) if w.startswith("--")}
        assert used <= known, f"{page.name}: {name} {used - known}"


def test_the_page_on_exports_gives_the_skeleton() -> None:
    text = (ROOT / "docs" / "onnx.md").read_text(encoding="utf-8")
    rows = json.loads(text.split("```json\n")[1].split("```")[0])
    ours = canonical_skeleton()
    assert [row[0] for row in rows] == list(ours.names)
    assert [row[1] for row in rows] == list(ours.parents)
    np.testing.assert_allclose([row[2] for row in rows], ours.offsets, atol=1e-6)
