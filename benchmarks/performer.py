"""How fast is a dance? A whole song to a full body, and how far ahead of real time a stream runs.

python -m benchmarks.performer [--seconds 180] [--threads 2] [--model starter] [--json OUT]

The song is synthetic and rendered before the clock starts; everything else counts: starting Python,
loading two models, listening, the path, the body, feet, and the files, as the command

    generate --audio SONG --prompt "a person dances" --format bvh,glb,html

does it in a process of its own. The stream is `MotionStream` with one prompt: *load* is seconds of
computing for a second of motion once the first piece is out (below 1 = faster than real time);
*first* the seconds of computing until the first piece; *lookahead* and *reaction*: see `Latency`.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
PROMPT = "a person dances"


def dance_command(seconds: float, threads: int, model: str) -> dict[str, Any]:
    """Seconds of the whole command for a song, from start to the last file."""
    from src.shared.audio.synthetic import SongSpec, render_song

    with tempfile.TemporaryDirectory() as folder:
        song = Path(folder) / "song.wav"
        render_song(SongSpec(seconds=seconds, tempo=112, seed=3)).write_wav(song)
        command = [
            sys.executable, "-m", "src.cli.tools", "generate", "--audio", str(song),
            "--prompt", PROMPT, "--body-model", model, "--format", "bvh,glb,html",
            "--threads", str(threads), "--out", str(Path(folder) / "out"), "--json",
        ]  # fmt: skip
        started = time.perf_counter()
        done = subprocess.run(
            command, cwd=ROOT, capture_output=True, text=True, check=False, env=environment(threads)
        )
        took = time.perf_counter() - started
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stderr}")
    parts = json.loads(done.stdout).get("timings", {})
    return {"song_seconds": seconds, "seconds": took, "factor": seconds / took, "parts": parts}


def stream(seconds: float, threads: int, model: str) -> dict[str, Any]:
    """Steady-state speed and latency of a stream of one prompt, in a process that is warm."""
    from src.shared.device import set_threads

    set_threads(threads)
    from src.shared.model.generation.motion_generator import TextToMotion
    from src.shared.pipelines.stream import MotionStream

    generator = TextToMotion.from_pretrained(model, device="cpu")
    generator.generate([PROMPT], seconds=4.0)  # the first call of all allocates
    made, running = 0.0, MotionStream(generator, PROMPT)
    for piece in running:
        made += piece.seconds
        if made >= seconds:
            break
    latency = asdict(running.latency)
    load = latency["load"]
    return {"seconds": made, **latency, "factor": 1 / load if load else None}


def environment(threads: int) -> dict[str, str]:
    """Of the command: no more threads than asked for."""
    number = str(threads)
    return os.environ | {"OMP_NUM_THREADS": number, "NUMBA_NUM_THREADS": number}


def main() -> None:
    """Time the command, then the stream."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=180.0)
    parser.add_argument("--stream-seconds", type=float, default=60.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--model", default="starter")
    parser.add_argument("--json", type=Path)
    args = parser.parse_args()
    found = {
        "command": dance_command(args.seconds, args.threads, args.model),
        "stream": stream(args.stream_seconds, args.threads, args.model),
        "threads": args.threads,
        "load": os.getloadavg()[0],
    }
    text = json.dumps(found, indent=1)
    print(text)
    if args.json is not None:
        args.json.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
