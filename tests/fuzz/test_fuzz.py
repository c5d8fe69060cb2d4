"""Every reader against a few hundred damaged files; `scripts/fuzz.py` runs ten thousand each."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.fuzz.targets import TARGETS

ROOT = Path(__file__).parents[2]
CASES = 100
GOOD = {"parsed", "refused", "same"}

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits are those of Linux")


def worker(readers: str, cases: int, folder: Path) -> list[dict[str, Any]]:
    """Reports of one process that runs several readers."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.fuzz.worker", readers, "1", "0", str(cases), str(folder)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return [json.loads(line) for line in done.stdout.splitlines()]


def test_damaged_files_are_parsed_or_refused(tmp_path: Path) -> None:
    reports = worker(",".join(TARGETS), CASES, tmp_path)
    assert [report["reader"] for report in reports] == list(TARGETS)
    for report in reports:
        assert not report["findings"], report
        assert report["counts"].keys() <= GOOD
        assert sum(report["counts"].values()) == CASES
        assert report["counts"]["refused"] and report["counts"].get("parsed"), report
        assert report["megabytes"] < 500
