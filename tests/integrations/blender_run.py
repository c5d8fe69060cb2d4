"""Runs a script in a Python that has `bpy`: this one, or the one that BPY_PYTHON names.

`bpy` asks for an older numpy than ours, so it lives best in an environment of its own; in a
process of its own it cannot take the tests down with it either.
"""

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
MARK = "RESULT "


def blender_python() -> str | None:
    """An interpreter with `bpy`, if there is one."""
    own = sys.executable if find_spec("bpy") else None
    return os.environ.get("BPY_PYTHON") or own


def run_in_blender(script: str, wanted: dict[str, Any], scratch: Path) -> Any:
    """What a script beside this file prints after `RESULT `, given `wanted` as JSON."""
    python = blender_python()
    assert python is not None
    done = subprocess.run(
        [python, str(HERE / script), json.dumps(wanted)],
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "BLENDER_USER_RESOURCES": str(scratch / "blender")},
    )
    lines = [line for line in done.stdout.splitlines() if line.startswith(MARK)]
    assert done.returncode == 0 and lines, done.stdout[-2000:] + done.stderr[-4000:]
    return json.loads(lines[-1].removeprefix(MARK))
