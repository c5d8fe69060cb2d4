#!/usr/bin/env python3
"""Feed damaged files to readers: each must parse or refuse, never crash, hang or fill the memory.

    python scripts/fuzz.py READER... --runs 10000 --seed 0

READER is a name that --list prints, or `all`. Findings (file and traceback) go to --out. A case
is named by reader, seed and number alone: --first 123 --runs 1 runs it again.
"""

import argparse
import json
import shutil
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

GOOD = ("parsed", "refused", "same")
BATCH = 2500  # cases a process: what leaks does not add up


def run_worker(reader: str, seed: int, first: int, stop: int, folder: Path) -> dict[str, Any]:
    """One process over these cases; a case that ended it is a finding, and the rest goes on."""
    command = [sys.executable, "-m", "tests.fuzz.worker", reader]
    command += [str(seed), str(first), str(stop), str(folder)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode == 0:
        return dict(json.loads(done.stdout.splitlines()[-1]))
    now = folder / "now"
    text = now.read_text().strip() if now.exists() else ""
    if not text:  # it never began: whole files are not read
        raise SystemExit(done.stderr[-3000:])
    case = int(text)
    (folder / f"ended-{case}.txt").write_text(done.stderr[-6000:])
    found = {"case": case, "count": 1, "message": f"the process ended ({done.returncode})"}
    report = {
        "counts": {"ended": 1},
        "findings": {f"ended {done.returncode}": found},
        "slowest": {"cpu_seconds": 0.0, "case": case},
        "megabytes": 0.0,
    }
    now.unlink()
    for part in ((first, case), (case + 1, stop)):
        if part[0] < part[1]:
            report = merged(report, run_worker(reader, seed, *part, folder))
    return report


def merged(one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    """Two reports of the same reader as one."""
    findings = {name: dict(found) for name, found in one["findings"].items()}
    for name, found in other["findings"].items():
        if name in findings:
            findings[name]["count"] += found["count"]
        else:
            findings[name] = found
    return {
        "counts": dict(Counter(one["counts"]) + Counter(other["counts"])),
        "findings": findings,
        "slowest": max(one["slowest"], other["slowest"], key=lambda row: row["cpu_seconds"]),
        "megabytes": max(one["megabytes"], other["megabytes"]),
    }


def fuzz(reader: str, seed: int, first: int, runs: int, out: Path) -> dict[str, Any]:
    """All cases of one reader, a batch a process."""
    folder = out / reader
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start, report = time.perf_counter(), None
    for begin in range(first, first + runs, BATCH):
        part = run_worker(reader, seed, begin, min(begin + BATCH, first + runs), folder)
        report = part if report is None else merged(report, part)
    assert report is not None
    return {"reader": reader, "seconds": round(time.perf_counter() - start, 1), **report}


def main() -> int:
    """Run and print one line a reader; 1 if anything was found."""
    from tests.fuzz.targets import TARGETS

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("readers", nargs="*", metavar="READER")
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=ROOT / "outputs" / "fuzz")
    parser.add_argument("--list", action="store_true")
    wanted = parser.parse_args()
    if wanted.list or not wanted.readers:
        print(*TARGETS, sep="\n")
        return 0 if wanted.list else 2
    readers = list(TARGETS) if "all" in wanted.readers else wanted.readers
    if unknown := [reader for reader in readers if reader not in TARGETS]:
        print(f"no reader {unknown[0]!r}; there are: {', '.join(TARGETS)}", file=sys.stderr)
        return 2
    bad = 0
    for reader in readers:
        report = fuzz(reader, wanted.seed, wanted.first, wanted.runs, wanted.out)
        bad += sum(count for kind, count in report["counts"].items() if kind not in GOOD)
        print(json.dumps(report), flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
