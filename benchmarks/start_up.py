"""What a command takes from the start of its process to its files: seconds, processor, memory.

    python -m benchmarks.start_up                                 # a sentence, both runtimes
    python -m benchmarks.start_up --runs 5 -- --prompt "a person waves" --then "a person jumps"

Each run is a process of its own; the runtimes take turns. *First* has no byte code, as after an
installation; the files of the libraries are in the system's cache in all of them. Processor time
is what a quiet machine's clock would say of one thread.
"""

import argparse
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROMPT = ["--prompt", "a person walks forward"]


def measured(arguments: list[str], **environment: str) -> tuple[float, float, float]:
    """Wall seconds, processor seconds and peak memory in MB of one `generate` of its own."""
    command = [sys.executable, "-m", "src.cli.tools", "generate", *arguments]
    own = {**os.environ, "PYTHONPATH": str(ROOT), **environment}
    started = time.perf_counter()
    with open(os.devnull, "wb") as nowhere:
        actions = [(os.POSIX_SPAWN_DUP2, nowhere.fileno(), stream) for stream in (1, 2)]
        process = os.posix_spawn(sys.executable, command, own, file_actions=actions)
        _, status, used = os.wait4(process, 0)
    if status:
        raise SystemExit(f"{' '.join(command)} ended with {os.waitstatus_to_exitcode(status)}")
    wall = time.perf_counter() - started
    return wall, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main() -> None:
    """Print a line for each runtime, first and warm."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("arguments", nargs="*", default=PROMPT, help="of `generate`, after --")
    options = parser.parse_args()
    print(f"{'':16}{'wall s':>8}{'CPU s':>8}{'MB':>7}")
    with tempfile.TemporaryDirectory() as folder:
        wanted = [*options.arguments, "--out", folder]
        found: dict[str, list[tuple[float, float, float]]] = {}
        for runtime in ("torch", "onnx"):
            fresh = {"PYTHONPYCACHEPREFIX": str(Path(folder, "none", runtime))}
            chosen = [*wanted, "--runtime", runtime]
            found[f"{runtime}, first"] = [measured(chosen, **fresh)]
            measured(chosen)
        for _ in range(options.runs):
            for runtime in ("torch", "onnx"):
                row = measured([*wanted, "--runtime", runtime])
                found.setdefault(f"{runtime}, warm", []).append(row)
    for name, rows in found.items():
        wall, used, memory = (statistics.median(column) for column in zip(*rows, strict=True))
        print(f"{name:16}{wall:8.2f}{used:8.2f}{memory:7.0f}")


if __name__ == "__main__":
    main()
