"""How long do questions to a large memory take, and from which size does the index library pay?

python -m benchmarks.memory_index [--sizes 2000 20000 1000000] [--dim 256] [--threads 1]
    [--json OUT]

Synthetic phrases: keys on a smooth sheet of 24 dimensions in D, with a little noise, as learned
embeddings lie; queries are other points of it. Exact search (a matrix product) against faiss, each
in a process of its own: seconds to build, milliseconds a call of 1 and of 32 queries (best of
several), what the process holds, and the share of the exact search's eight best phrases that the
library finds too. The library pays where it is faster for both calls and finds at least 95%. With
one thread the clock is the process's own CPU time, which other work on the machine disturbs least.

Letters: N phrases, D width, k = 8 hits.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from torch import Tensor

    from src.shared.memory.index import MemoryIndex

SIZES = (2_000, 20_000, 50_000, 100_000, 200_000, 1_000_000)
PER_SONG = 40
SHEET, NOISE = 24, 0.1  # dimensions; noise by length of the key
TOP_K, QUERIES = 8, 32
SECONDS = 0.5  # repeat a call for so long at least
FORGIVEN = 0.95  # of the hits, what a library must find to count
MARK = "@result "


def synthetic(count: int, dim: int) -> tuple["MemoryIndex", "Tensor"]:
    """A memory of N phrases without motions, and queries [32,D]."""
    import torch
    from torch.nn.functional import normalize

    from src.shared.memory.index import MemoryIndex

    generator = torch.Generator().manual_seed(0)
    sheet = torch.randn(SHEET, dim, generator=generator) / SHEET**0.5

    def points(number: int) -> "Tensor":
        place = torch.randn(number, SHEET, generator=generator)
        noise = torch.randn(number, dim, generator=generator)
        return normalize(place @ sheet + NOISE * noise, dim=-1)

    keys = torch.empty(count, dim)
    for start in range(0, count, 65_536):  # block by block: the peak is what is measured
        part = keys[start : start + 65_536]
        part[:] = points(len(part))
    song = torch.arange(count) // PER_SONG
    index = MemoryIndex(
        audio_keys=keys,
        motion_keys=keys,
        start_phase=torch.zeros(count),
        tempo=torch.zeros(count),
        song=song,
        offsets=torch.zeros(count + 1, dtype=torch.int64),
        trajectories=torch.zeros(0, 25),
        priors=torch.zeros(0, 4),
        songs=tuple(map(str, range(-(-count // PER_SONG)))),
        ids=("",) * count,
        captions=("",) * count,
        clips=("",) * count,
    )
    return index, points(QUERIES)


def milliseconds(call: Callable[[], Any], clock: Callable[[], float]) -> float:
    """The best of several calls: other work on the machine only adds."""
    best, end = float("inf"), clock() + SECONDS
    repeats = 0
    while clock() < end or repeats < 3:
        start = clock()
        call()
        best = min(best, clock() - start)
        repeats += 1
    return 1000 * best


def measure(count: int, dim: int, threads: int, method: str) -> dict[str, Any]:
    """One method at one size, in this process."""
    import torch

    torch.set_num_threads(threads)
    clock = time.process_time if threads == 1 else time.perf_counter
    index, query = synthetic(count, dim)
    exact = index.search(query, top_k=TOP_K).index
    held, start = resident(), clock()
    if method == "faiss":
        import faiss  # type: ignore[import-untyped,import-not-found,unused-ignore]

        from src.shared.memory.index import LibraryIndex, make_table

        faiss.omp_set_num_threads(threads)
        index = LibraryIndex.of(index, {"audio": make_table(index, "audio")})
    built = clock() - start
    found = index.search(query, top_k=TOP_K).index
    shared = [len(set(a.tolist()) & set(b.tolist())) for a, b in zip(exact, found, strict=True)]
    return {
        "phrases": count,
        "dim": dim,
        "method": method,
        "build_s": built,
        "query_1_ms": milliseconds(lambda: index.search(query[:1], top_k=TOP_K), clock),
        "query_32_ms": milliseconds(lambda: index.search(query, top_k=TOP_K), clock),
        "keys_mb": count * dim * 4 / 1e6,
        "added_mb": max(0.0, resident() - held),
        "peak_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3,
        "recall": sum(shared) / (TOP_K * QUERIES),
    }


def resident() -> float:
    """MB that this process holds now; its peak where the system tells no more."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def measured(count: int, dim: int, threads: int, method: str) -> dict[str, Any]:
    """The same in a process of its own."""
    arguments = ["--one", method, "--sizes", str(count), "--dim", str(dim)]
    command = [sys.executable, "-m", "benchmarks.memory_index", *arguments]
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    run = subprocess.run(
        [*command, "--threads", str(threads)], env=environment, stdout=subprocess.PIPE, text=True
    )
    lines = [line for line in run.stdout.splitlines() if line.startswith(MARK)]
    if run.returncode or not lines:
        raise SystemExit(f"{method} at {count} phrases ended with {run.returncode}")
    row: dict[str, Any] = json.loads(lines[0].removeprefix(MARK))
    print(
        f"{count:>9}  {method:<6} {row['build_s']:>8.1f} {row['query_1_ms']:>9.2f}"
        f" {row['query_32_ms']:>10.2f} {row['keys_mb']:>8.0f} {row['added_mb']:>9.0f}"
        f" {row['recall']:>7.3f}",
        flush=True,
    )
    return row


def verdict(rows: list[dict[str, Any]]) -> list[str]:
    """From which of the sizes the library pays, and after how many calls its table has."""
    lines = []
    for size in sorted({row["phrases"] for row in rows}):
        exact, library = (
            next(row for row in rows if (row["phrases"], row["method"]) == (size, method))
            for method in ("exact", "faiss")
        )
        gain = exact["query_1_ms"] - library["query_1_ms"]
        faster = gain > 0 and exact["query_32_ms"] > library["query_32_ms"]
        if faster and library["recall"] >= FORGIVEN:
            calls = 1000 * library["build_s"] / gain
            lines.append(
                f"{size:,} phrases: pays; saves {gain:.1f} ms a query, its table's cost after"
                f" {calls:,.0f} calls"
            )
        else:
            lines.append(f"{size:,} phrases: does not pay")
    return lines


def main() -> None:
    """Measure and print, a line a size and method."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES)
    parser.add_argument("--dim", type=int, default=256)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--one", choices=("exact", "faiss"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        row = measure(given.sizes[0], given.dim, given.threads, given.one)
        print(MARK + json.dumps(row))
        return
    print("  phrases  method  build s  1 query/ms  32 queries/ms  keys/MB  added/MB  recall@8")
    rows = [
        measured(count, given.dim, given.threads, method)
        for count in given.sizes
        for method in ("exact", "faiss")
    ]
    lines = verdict(rows)
    print("\n".join(lines))
    if given.json:
        given.json.write_text(json.dumps({"rows": rows, "verdict": lines}, indent=1) + "\n")


if __name__ == "__main__":
    main()
