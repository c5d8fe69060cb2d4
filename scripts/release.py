#!/usr/bin/env python3
"""Make a release: version, changelog, wheel and sdist, tried in an environment of its own.

    python scripts/release.py 0.2.0            everything; leaves a commit and a tag, pushes nothing
    python scripts/release.py 0.2.0 --build    build and try what is there; change nothing

Standard library only; pip fetches poetry-core and, for the trial, what the wheel needs (a CPU build
of torch by PIP_INDEX_URL, PIP_EXTRA_INDEX_URL or PIP_FIND_LINKS, as pip knows them).
`--site FOLDER` lends the trial the packages of an environment instead.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import venv
import zipfile
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSION = re.compile(r"\d+\.\d+\.\d+(?:(?:a|b|rc)\d+)?")
PLACES = (("pyproject.toml", r'^version = "(.*)"$'), ("CITATION.cff", r"^version: (.*)$"))
BUILD = "from poetry.core.masonry.api import build_sdist, build_wheel; {0}({1!r})"
TRIAL = (
    ("--version",),
    ("models",),
    ("generate", "--prompt", "a person waves", "--seconds", "2", "--format", "bvh", "--out", "out"),
)


def number(root: Path, version: str) -> None:
    """Write the version and date the changelog; SystemExit where there is nothing to release."""
    if not VERSION.fullmatch(version):
        raise SystemExit(f"release: version {version!r} is no 1.2.3 or 1.2.3rc1; give one")
    log = root / "CHANGELOG.md"
    text = log.read_text(encoding="utf-8")
    _, heading, rest = text.partition("## [Unreleased]\n")
    if not rest.partition("\n## ")[0].strip():
        raise SystemExit(f"release: {log} tells of nothing under [Unreleased]; write what changed")
    if f"## [{version}]" in text:
        raise SystemExit(f"release: {log} has {version} already; choose a later version")
    dated = f"{heading}\n## [{version}] - {date.today().isoformat()}\n"
    log.write_text(text.replace(heading, dated, 1), encoding="utf-8")
    for name, pattern in PLACES:
        path = root / name
        line = re.search(pattern, path.read_text(encoding="utf-8"), re.MULTILINE)
        assert line, name
        new = line[0].replace(line[1], version)
        path.write_text(path.read_text(encoding="utf-8").replace(line[0], new, 1), encoding="utf-8")


def python_of(folder: Path) -> str:
    """The interpreter of an environment."""
    return str(folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python"))


def build(folder: Path) -> tuple[Path, Path]:
    """Wheel and sdist in dist/, made by poetry-core in an environment in `folder`."""
    dist = ROOT / "dist"
    shutil.rmtree(dist, ignore_errors=True)
    dist.mkdir()
    venv.create(folder, with_pip=True)
    python = python_of(folder)
    subprocess.run([python, "-m", "pip", "install", "-q", "poetry-core>=2.1,<3"], check=True)
    for what in ("build_wheel", "build_sdist"):
        subprocess.run([python, "-c", BUILD.format(what, str(dist))], cwd=ROOT, check=True)
    return next(dist.glob("*.whl")), next(dist.glob("*.tar.gz"))


def try_out(wheel: Path, folder: Path, site: str | None) -> None:
    """Install the wheel into a fresh environment and use it, far from this checkout."""
    venv.create(folder, with_pip=True)
    python = python_of(folder)
    install = [python, "-m", "pip", "install", "-q", str(wheel)]
    if site is not None:
        packages = subprocess.run(
            [python, "-c", "import site; print(site.getsitepackages()[0])"],
            check=True,
            capture_output=True,
            text=True,
        ).stdout.strip()
        Path(packages, "lent.pth").write_text(f"{site}\n")
        install += ["--no-deps", "--ignore-installed"]
    subprocess.run(install, check=True)
    alone = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {"HF_HUB_OFFLINE": "1"}
    for arguments in TRIAL:
        command = [python, "-m", "motionsuite", *arguments]
        subprocess.run(command, check=True, cwd=folder, env=alone)
    assert list(folder.glob("out/*.bvh"))


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("version")
    parser.add_argument("--build", action="store_true", help="change nothing")
    parser.add_argument("--site", help="site-packages that the trial borrows")
    given = parser.parse_args()
    git = ["git", "-C", str(ROOT)]
    if not given.build:
        if subprocess.run([*git, "status", "--porcelain"], capture_output=True).stdout:
            sys.exit("release: there are uncommitted changes; commit them first")
        number(ROOT, given.version)
    try:
        with tempfile.TemporaryDirectory(prefix="release-") as name:
            wheel, sdist = build(Path(name, "build"))
            files, size = len(zipfile.ZipFile(wheel).namelist()), wheel.stat().st_size / 1e6
            print(f"{wheel.name}: {files} files, {size:.1f} MB; {sdist.name}")
            try_out(wheel, Path(name, "trial"), given.site)
    except BaseException as error:
        if not given.build:  # nothing else was changed
            subprocess.run([*git, "restore", "."], check=True)
        if isinstance(error, subprocess.CalledProcessError):
            sys.exit(f"release: {' '.join(map(str, error.cmd))} failed; nothing was changed")
        raise
    if not given.build:
        subprocess.run([*git, "commit", "-qam", f"Release {given.version}"], check=True)
        subprocess.run([*git, "tag", f"v{given.version}"], check=True)
        print(f"release: v{given.version} is made; now `make test`, then git push --follow-tags")


if __name__ == "__main__":
    main()
