"""The walls of the house: who imports whom, how files look, what the lock file holds."""

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SOURCES = sorted((ROOT / "src").rglob("*.py"))
MODULES = [path for path in SOURCES if path.name != "__init__.py"]


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def test_import_contracts_hold() -> None:
    code = "from importlinter.cli import lint_imports_command as run; run()"
    result = subprocess.run(
        [sys.executable, "-c", code, "--no-logo", "--no-cache"],
        cwd=ROOT, capture_output=True, text=True,
    )  # fmt: skip
    assert result.returncode == 0, result.stdout
    assert "0 broken" in result.stdout


def test_every_package_folder_has_an_init_file() -> None:
    folders = {path.parent for path in MODULES}
    assert [relative(folder) for folder in folders if not (folder / "__init__.py").exists()] == []


@pytest.mark.parametrize("path", MODULES, ids=relative)
def test_module_says_its_subject_and_stays_small(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    subject = (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
    assert len(subject) >= 20, "the first docstring line says the module's one subject"
    assert text.count("\n") <= 600


def test_the_model_path_has_no_float64() -> None:
    """Apple GPUs have no float64 (SPEC, Text row); a file on NumPy motions may say "CPU"."""
    pattern = re.compile(r"torch\.(float64|double)|\.double\(\)")
    folders = ("src/shared/model", "src/shared/motion")
    texts = {relative(path): path.read_text("utf-8") for path in MODULES}
    found = [name for name, text in texts.items() if pattern.search(text)]
    on_the_path = [name for name in found if name.startswith(folders)]
    assert [name for name in on_the_path if "CPU in float64" not in texts[name]] == []


def test_paths_that_the_documents_name_exist() -> None:
    named = (
        "src/configs/network.yaml src/configs/train_generation.yaml src/shared/config_loader.py"
        " src/shared/model/generation/denoiser.py src/shared/model/generation/motion_generator.py"
        " src/shared/model/generation/losses.py src/shared/model/clip/core.py"
        " src/shared/model/layers.py src/cli/tools.py pyproject.toml poetry.lock"
    )
    assert [name for name in named.split() if not (ROOT / name).is_file()] == []


def test_lock_file_is_plain() -> None:
    """No address of a package index, and one version of each package."""
    text = (ROOT / "poetry.lock").read_text(encoding="utf-8")
    lock = tomllib.loads(text)
    names = [package["name"] for package in lock["package"]]
    assert len(names) == len(set(names))
    assert not any("source" in package for package in lock["package"])
