"""One process that reads damaged files under limits, and says what came of each.

    python -m tests.fuzz.worker READER[,READER...] SEED FIRST STOP FOLDER

Prints one JSON line a reader: counts of outcomes, the first of each kind of finding, the
slowest case and the memory. The number of the case at hand is in FOLDER/now, so that whoever
started the process knows which case ended it.
"""

import contextlib
import io
import json
import os
import random
import resource
import signal
import sys
import tempfile
import time
import traceback
import unicodedata
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.fuzz.mutations import (
    Mutation,
    crc32,
    mutate_bytes,
    mutate_glb,
    mutate_json,
    mutate_json_lines,
    mutate_npy,
    mutate_npz,
    mutate_safetensors,
    mutate_sound,
    text_mutation,
)
from tests.fuzz.target import Target
from tests.fuzz.targets import TARGETS

MEMORY = 500 << 20  # bytes beyond what reading whole files took
CPU_SECONDS = 5.0
WALL_SECONDS = 60  # a machine may be busy; a reader that only waits is caught here
LONGEST_MESSAGE = 2000  # characters
OURS = str(Path(__file__).parents[2] / "src")
STRUCTURED: dict[str, Mutation] = {
    ".npz": mutate_npz,
    ".npy": mutate_npy,
    ".glb": mutate_glb,
    ".json": mutate_json,
    ".jsonl": mutate_json_lines,
    ".safetensors": mutate_safetensors,
    ".wav": mutate_sound,
    ".flac": mutate_sound,
    ".ogg": mutate_sound,
    ".mp3": mutate_sound,
}


class TooSlow(BaseException):
    """A case used more than `CPU_SECONDS`; no `except Exception` of a reader hides it."""


def mutation_of(target: Target, path: Path, rng: random.Random) -> Mutation:
    """Bytes in a third of the cases, else what suits the format."""
    if rng.random() < 1 / 3:
        return mutate_bytes
    return STRUCTURED.get(path.suffix) or text_mutation(target.words)


@contextlib.contextmanager
def limits() -> Iterator[None]:
    """Processor time of one case; one that never comes back to Python ends the process."""

    def stop(_number: int, _frame: Any) -> None:
        raise TooSlow

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_REAL, WALL_SECONDS)  # nobody handles its signal
    signal.setitimer(signal.ITIMER_PROF, CPU_SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGPROF, before)


def outcome(target: Target, path: Path) -> tuple[str, str, BaseException | None]:
    """(kind, detail, exception) of reading one file; parsed and refused are right."""
    said = io.StringIO()
    try:
        with warnings.catch_warnings(record=True) as warned, limits():
            warnings.simplefilter("always", RuntimeWarning)
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                target.read(path)
    except TooSlow as error:
        return "hang", place(error), error
    except MemoryError as error:
        return "memory", place(error), error
    except target.refusals as error:
        if any(isinstance(cause, MemoryError) for cause in chain(error)):
            return "memory", place(error), error
        return judge_message(str(error)), place(error), error
    except BaseException as error:
        return "crash", f"{type(error).__name__} {place(error)}", error
    noise = [w for w in warned if issubclass(w.category, RuntimeWarning)]
    if noise:
        where = f"{Path(noise[0].filename).name}:{noise[0].lineno}"
        return "warning", f"{noise[0].message} {where}", None
    if len(said.getvalue()) > LONGEST_MESSAGE:
        return "noise", "prints", None
    return "parsed", "", None


def judge_message(text: str) -> str:
    """Is a refusal something to show to a user?"""
    hidden = any(unicodedata.category(c) in ("Cc", "Cf", "Cs") and c not in "\n\t" for c in text)
    if len(text) > LONGEST_MESSAGE or hidden:
        return "unreadable-message"
    return "refused"


def chain(error: BaseException | None) -> Iterator[BaseException]:
    """An exception and what it came from."""
    seen: set[int] = set()
    while error is not None and id(error) not in seen:
        seen.add(id(error))
        yield error
        error = error.__cause__ or error.__context__


def place(error: BaseException) -> str:
    """The innermost line of our own code."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename.startswith(OURS)]
    return f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "?"


def limit_memory() -> None:
    """No more address space than `MEMORY` beyond what there is."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    most = pages * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (most, resource.getrlimit(resource.RLIMIT_AS)[1]))


def peak_bytes() -> int:
    """Largest resident size of this process so far."""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


class Run:
    """Cases of one reader, one after another, and what they came to."""

    def __init__(self, name: str, seed: int, folder: Path) -> None:
        self.name, self.seed, self.folder = name, seed, folder
        self.target = TARGETS[name]
        folder.mkdir(parents=True, exist_ok=True)
        memory = Path("/dev/shm")  # tens of thousands of files are written
        self.scratch = tempfile.TemporaryDirectory(dir=memory if memory.is_dir() else None)
        self.data = Path(self.scratch.name)
        self.target.prepare(self.data)
        self.whole = {p: p.read_bytes() for p in sorted(self.data.rglob("*")) if p.is_file()}
        self.choices = [p for p in self.whole if p.match(self.target.damaged)]
        self.counts: Counter[str] = Counter()
        self.findings: dict[str, dict[str, Any]] = {}
        self.slowest = (0.0, -1)

    def warm_up(self) -> None:
        """Whole files are read without complaint; imports and caches are paid for."""
        for path in self.choices:
            kind, detail, error = outcome(self.target, path)
            if kind != "parsed":
                raise AssertionError(f"{path}: {kind} {detail}: {error!r}") from error

    def case(self, number: int) -> None:
        """Damage one file, read, restore."""
        rng = random.Random(f"{self.seed}:{self.name}:{number}")
        path = rng.choice(self.choices)
        whole = self.whole[path]
        damaged = mutation_of(self.target, path, rng)(rng, whole)
        path.write_bytes(damaged)
        try:
            if self.target.mend and rng.random() < 0.7:
                with contextlib.suppress(Exception):
                    self.target.mend(path)
            start = time.process_time()
            kind, detail, error = outcome(self.target, path)
            self.slowest = max(self.slowest, (time.process_time() - start, number))
        finally:
            for other, data in self.whole.items():
                if other == path or self.target.mend:
                    other.write_bytes(data)
        self.counts["same" if damaged == whole and kind == "parsed" else kind] += 1
        if kind not in ("parsed", "refused"):
            self.keep(number, kind, detail, error, path, damaged)

    def keep(
        self, number: int, kind: str, detail: str, error: Any, path: Path, damaged: bytes
    ) -> None:
        """The first case of each kind of finding, with its file."""
        key = f"{kind} {detail}"
        found = self.findings.setdefault(key, {"case": number, "count": 0})
        found["count"] += 1
        if found["count"] == 1:
            name = f"{kind}-{crc32(key.encode()):08x}-{path.name}"
            (self.folder / name).write_bytes(damaged[: 4 << 20])
            trace = "".join(traceback.format_exception(error))[-6000:] if error else detail
            (self.folder / f"{name}.txt").write_text(f"case {number}\n{trace}", "utf-8", "replace")
            found |= {"file": name, "message": str(error)[:300]}


def main(names: str, seed: int, first: int, stop: int, folder: Path) -> None:
    """Run the cases of each reader and print what came of them."""
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    several = "," in names
    runs = [Run(name, seed, folder / name if several else folder) for name in names.split(",")]
    for run in runs:
        run.warm_up()
    limit_memory()
    with (folder / "now").open("w") as now:
        for run in runs:
            base = peak_bytes()
            for number in range(first, stop):
                os.pwrite(now.fileno(), f"{number:012d}".encode(), 0)
                run.case(number)
            report = {
                "reader": run.name,
                "counts": dict(run.counts),
                "findings": run.findings,
                "slowest": {"cpu_seconds": round(run.slowest[0], 3), "case": run.slowest[1]},
                "megabytes": round((peak_bytes() - base) / 2**20, 1),
            }
            print(json.dumps(report), flush=True)
            run.scratch.cleanup()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), Path(sys.argv[5]))
