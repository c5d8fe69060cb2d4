#!/usr/bin/env python3
"""The project's everyday tasks, each with all the set-up it needs; the Makefile calls this.

python scripts/tasks.py TASK [further arguments]
"""

import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import setup

PROMPTS = (
    "a person walks forward",
    "una persona saluda con la mano derecha",  # waves with the right hand
    "someone runs forward quickly",
    "人が左を向く",  # turns to the left
)
DEMO = "outputs/demo"
SONG = f"""
from pathlib import Path
from src.shared.audio.synthetic import SongSpec, render_song

path = Path("{DEMO}/song.wav")
path.parent.mkdir(parents=True, exist_ok=True)
render_song(SongSpec(seconds=16.0, tempo=112.0, seed=1)).write_wav(path)
"""


def run(program: Path, *arguments: str, threads: int | None = None) -> int:
    """Run a program of the environment in the project's folder.

    Where Python is told to leave no byte code, it goes into the environment: the tests start
    hundreds of processes, and compiling what they import takes each one seconds.
    """
    environment = dict(os.environ)
    if environment.pop("PYTHONDONTWRITEBYTECODE", ""):
        environment["PYTHONPYCACHEPREFIX"] = str(setup.VENV / "pycache")
    if threads is not None:
        environment["OMP_NUM_THREADS"] = str(threads)
    return subprocess.call([str(program), *arguments], cwd=setup.ROOT, env=environment)


def python(*arguments: str, threads: int | None = None) -> int:
    """Run the environment's interpreter."""
    return run(setup.venv_tool("python"), *arguments, threads=threads)


def demo(arguments: list[str]) -> int:
    """Generate a few motions, in three languages, one dance to a song, and the studio's page."""
    setup.main([])
    generate = ("-m", "src.cli.tools", "generate", "--out", DEMO)
    prompts = [word for prompt in PROMPTS for word in ("--prompt", prompt)]
    options = ["--seconds", "4", "--format", "bvh,glb,npz,html"]
    return (
        python(*generate, *prompts, *options, *arguments)
        or python("-c", SONG)
        or python(*generate, "--audio", f"{DEMO}/song.wav", "--body", "--format", "glb,html")
        or python("-m", "src.cli.tools", "studio", "--out", f"{DEMO}/studio.html", "--no-open")
    )


def pytest(marks: str, arguments: list[str]) -> int:
    """Run the tests with these marks, one worker a core."""
    setup.main(["--dev"])
    # One thread a worker: two busy thread pools on two cores slow each other down tenfold.
    shared = "-n", "auto", "--dist", "worksteal"  # else one process ends a minute after the others
    return python("-m", "pytest", *shared, "-q", "-m", marks, *arguments, threads=1)


def test(arguments: list[str]) -> int:
    """Every test that takes seconds."""
    return pytest("not slow", arguments)


def test_slow(arguments: list[str]) -> int:
    """The tests that take minutes, training from files to motions among them."""
    return pytest("slow", arguments)


def lint(_arguments: list[str]) -> int:
    """Style, formatting, types and the import contracts; every one runs, any one fails."""
    setup.main(["--dev"])
    commands = (
        ["ruff", "check", "."],
        ["ruff", "format", "--check", "."],
        ["mypy"],
        ["lint-imports", "--no-logo"],
    )
    codes = []
    for command in commands:
        print("lint:", *command, flush=True)
        codes.append(run(setup.venv_tool(command[0]), *command[1:]))
    return max(codes)


def format(_arguments: list[str]) -> int:
    """Let ruff mend what it can."""
    setup.main(["--dev"])
    ruff = setup.venv_tool("ruff")
    return max(run(ruff, "check", "--fix", "."), run(ruff, "format", "."))


def benchmark(arguments: list[str]) -> int:
    """Time sampling against a plain transformer of MDM's size, and the whole command."""
    setup.main([])
    return python("-m", "benchmarks.sampling", "--model", "starter", *arguments)


def gpu_check(arguments: list[str]) -> int:
    """Tests marked gpu, training steps by batch and an hour of `spark`, into docs/gpu-*.md."""
    nothing = "gpu-check: no CUDA device here; nothing was checked"
    if not setup.has_nvidia_card():
        print(nothing, file=sys.stderr)
        return 1
    setup.main(["--dev"])
    if python("-c", "import sys, torch; sys.exit(not torch.cuda.is_available())"):
        print(f"{nothing} (PyTorch sees none)", file=sys.stderr)
        return 1
    steps = ("-m", "benchmarks.training_steps", "--device", "cuda", "--batches")
    batches = "16,32,64,128,256,512,1024,2048"
    table = (*steps, batches, "--write", "docs/gpu-steps.md", *arguments)
    compiled = (*steps, "64,256", "--precisions", "bf16", "--compile", *arguments)
    data = "runs/gpu/data"
    prepare = ("-m", "src.cli.tools", "prepare", "--synthetic", "3000", "--out", data)
    hour = ("-m", "benchmarks.timed_training", "--profile", "spark", "--seconds", "3600", "--data",
            data, "--work", "runs/gpu", "--write", "docs/gpu-spark.md")  # fmt: skip
    sampling = ("-m", "benchmarks.sampling", "--model", "starter", "--device", "cuda", "--json",
                "docs/gpu-sampling.json")  # fmt: skip
    tables = ("-m", "benchmarks.audio_unet", "--parts", "tables", "--device", "cuda", "--json",
              "docs/gpu-tables.json")  # fmt: skip
    return max(
        python("-m", "pytest", "-q", "-m", "gpu"),
        python(*tables),
        python(*table),
        python(*compiled, "--write", "docs/gpu-compiled.md"),
        python(*sampling),
        python(*prepare) or python(*hour),
    )


def release(arguments: list[str]) -> int:
    """Version, changelog, wheel and its trial: ARGS="0.2.0", see scripts/release.py."""
    return subprocess.call([sys.executable, str(setup.ROOT / "scripts" / "release.py"), *arguments])


def train_small(arguments: list[str]) -> int:
    """Train both stages on the built-in synthetic motions, small, into runs/small."""
    setup.main([])
    data, clip, model = "runs/small/data", "runs/small/clip", "runs/small/generation"
    prepare = ["-m", "src.cli.tools", "prepare", "--synthetic", "400", "--out", data]
    train_clip = ["-m", "src.train.train_clip", "--data", data, "--output", clip]
    train_generation = ["-m", "src.train.train_generation", "--data", data, f"clip={clip}"]
    for stage in (prepare, train_clip, [*train_generation, "--output", model, *arguments]):
        if code := python(*stage):
            return code
    print(f"trained: try  motion-tools generate --model {model} --prompt 'a person walks forward'")
    return 0


def clean(_arguments: list[str]) -> int:
    """Remove the environment, caches and outputs; training runs stay."""
    for name in (".venv", ".pytest_cache", ".mypy_cache", ".ruff_cache", ".hypothesis", "outputs"):
        shutil.rmtree(setup.ROOT / name, ignore_errors=True)
    return 0


TASKS: dict[str, Callable[[list[str]], int]] = {
    task.__name__.replace("_", "-"): task
    for task in (
        demo,
        test,
        test_slow,
        lint,
        format,
        benchmark,
        gpu_check,
        release,
        train_small,
        clean,
    )
}


def main() -> int:
    """Run the task named by the first argument; the rest is handed on to it."""
    if len(sys.argv) < 2 or sys.argv[1] not in TASKS:
        print(__doc__)
        for name, task in TASKS.items():
            print(f"  {name:12} {str(task.__doc__).splitlines()[0]}")
        return 2
    # An exit on the way of `subprocess.call` ends what it started.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    try:
        return TASKS[sys.argv[1]](sys.argv[2:])
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
