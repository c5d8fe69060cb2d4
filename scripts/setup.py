#!/usr/bin/env python3
"""Make `.venv` with the locked packages: standard library only, any system, quick when done.

    python scripts/setup.py          what running needs
    python scripts/setup.py --dev    what the tests and linters need as well

Versions come from poetry.lock. On Linux without an NVIDIA card a CPU build of torch is taken
from pip's own local wheels or from the index that TORCH_INDEX names; where there is neither, the
locked (CUDA) build is installed, which runs on the CPU too and only costs disk space.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
STAMP = VENV / "setup.json"
LOG = VENV / "setup.log"
OLDEST, NEWEST = (3, 11), (3, 13)
CUDA_ONLY = ("nvidia-", "cuda-", "triton")


def venv_tool(name: str) -> Path:
    """A program inside `.venv`, wherever this system puts it."""
    return VENV / "Scripts" / f"{name}.exe" if os.name == "nt" else VENV / "bin" / name


def supported(version: tuple[int, int]) -> bool:
    """Whether the project runs on this Python."""
    return OLDEST <= version <= NEWEST


def rerun_with_supported_python() -> None:
    """Hand over to a supported interpreter on PATH when this one is too old or too new."""
    if supported(sys.version_info[:2]):
        return
    for minor in range(NEWEST[1], OLDEST[1] - 1, -1):
        other = shutil.which(f"python3.{minor}")
        # A version manager may put a launcher on PATH for a version that is not installed.
        works = other and subprocess.run([other, "-c", ""], capture_output=True).returncode == 0
        if other and works:
            raise SystemExit(subprocess.call([other, *sys.argv]))
    found = ".".join(map(str, sys.version_info[:3]))
    sys.exit(f"setup: Python 3.11, 3.12 or 3.13 is needed, this is {found}: install one")


def locked_packages(groups: set[str]) -> list[str]:
    """Requirement lines `name==version ; marker` of the lock's packages in these groups."""
    import tomllib  # here, so that an old Python reaches the message above

    lock = tomllib.loads((ROOT / "poetry.lock").read_text(encoding="utf-8"))
    lines = []
    for package in lock["package"]:
        wanted = groups & set(package["groups"])
        if not wanted:
            continue
        line = f"{package['name']}=={package['version']}"
        markers: Any = package.get("markers", "")
        if isinstance(markers, dict):  # one marker a group; a group without one needs it always
            parts = [markers.get(group, "") for group in sorted(wanted)]
            markers = " or ".join(f"({part})" for part in parts) if all(parts) else ""
        lines.append(f"{line} ; {markers}" if markers else line)
    return lines


def run(command: list[str], *, check: bool = True) -> bool:
    """Run quietly into the log; on failure show the log's end and stop, or report it."""
    with LOG.open("a", encoding="utf-8") as log:
        print("$", *command, file=log, flush=True)
        code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, cwd=ROOT).returncode
    if code and check:
        tail = LOG.read_text(encoding="utf-8", errors="replace").splitlines()[-25:]
        print(*tail, sep="\n", file=sys.stderr)
        sys.exit(f"setup: a step failed; the whole log is {LOG}. Mend the cause and run again.")
    return code == 0


def pip(*arguments: str, check: bool = True) -> bool:
    """Pip of the environment; byte code is left to the first import, which halves the time."""
    base = [str(venv_tool("python")), "-m", "pip", "install", "--disable-pip-version-check"]
    return run([*base, "--no-input", "--no-deps", "--no-compile", *arguments], check=check)


def has_nvidia_card() -> bool:
    """Whether the NVIDIA driver answers and lists a card."""
    tool = shutil.which("nvidia-smi")
    if tool is None:
        return False
    answer = subprocess.run([tool, "-L"], capture_output=True, text=True)
    return answer.returncode == 0 and "GPU" in answer.stdout


def install_cpu_torch(requirement: str) -> bool:
    """Try for a CPU build of the locked torch; True when it is in place."""
    index = os.environ.get("TORCH_INDEX", "")
    if index:
        pip(requirement, "--index-url", index)
    elif not sys.platform.startswith("linux") or has_nvidia_card():
        return False  # elsewhere the ordinary wheel is the right one
    elif not pip(requirement, "--no-index", check=False):
        return False
    probe = "import importlib.metadata as m; print(m.version('torch'))"
    answer = subprocess.run([str(venv_tool("python")), "-c", probe], capture_output=True, text=True)
    return answer.stdout.strip().endswith("+cpu")


def install(groups: set[str]) -> str:
    """Create the environment and fill it; returns which torch was taken ("cpu" or "locked")."""
    if not venv_tool("python").exists():
        step("making .venv")
        VENV.mkdir(exist_ok=True)
        run([sys.executable, "-m", "venv", str(VENV)])
    lines = locked_packages(groups)
    step("installing torch")
    torch = next(line for line in lines if line.startswith("torch=="))
    cpu = install_cpu_torch(torch)
    if cpu:
        lines = [line for line in lines if not line.startswith((*CUDA_ONLY, "torch=="))]
    step(f"installing {len(lines)} packages{'' if cpu else ', torch among them (a large one)'}")
    with tempfile.TemporaryDirectory() as folder:
        requirements = Path(folder) / "requirements.txt"
        requirements.write_text("\n".join(lines), encoding="utf-8")
        pip("-r", str(requirements))
    step("installing the project")
    pip("--editable", str(ROOT))
    return "cpu" if cpu else "locked"


def step(text: str) -> None:
    """Print one line of progress with the seconds since the start."""
    print(f"setup: {time.monotonic() - STARTED:5.0f} s  {text} …", flush=True)


STARTED = time.monotonic()


def main(arguments: list[str] | None = None) -> None:
    """Bring `.venv` up to date with poetry.lock; nothing to do when its stamp agrees."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--dev", action="store_true", help="tests and linters too")
    options = parser.parse_args(arguments)
    rerun_with_supported_python()
    digest = hashlib.sha256()
    for name in ("poetry.lock", "pyproject.toml"):
        digest.update((ROOT / name).read_bytes())
    wanted = {"files": digest.hexdigest(), "index": os.environ.get("TORCH_INDEX", "")}
    groups = {"main", "dev"} if options.dev else {"main"}
    try:
        stamp = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        stamp = {}
    same = all(stamp.get(key) == value for key, value in wanted.items())
    if same and venv_tool("python").exists():
        if groups <= set(stamp["groups"]):
            return
        groups |= set(stamp["groups"])
    torch = install(groups)
    STAMP.write_text(json.dumps({**wanted, "groups": sorted(groups), "torch": torch}))
    step(f"done (torch: {torch} build)")


if __name__ == "__main__":
    main()
