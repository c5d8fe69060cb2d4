#!/usr/bin/env python3
"""Golden guard: what some twenty commands write, as hashes, before and after a change of the code.

    python scripts/golden.py before.json            # on the code as it was
    python scripts/golden.py after.json --against before.json

One thread, float32, fixed seeds. Hashes hold on one machine only: another CPU rounds otherwise.
Exits with 1 where a file differs, is missing or is new; a step that means to change one says so.
"""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WAVE, WALK = "a person waves with the left hand", "a person walks forward"
STYLE = ["--style", "proud"]
OUT = "OUT"  # the folder that a command writes into; given by --out where it is not named
MADE = "made/wave/01-a-person-waves-with-the-left-hand"

INPUTS = """
import sys
from pathlib import Path
from src.shared.audio.synthetic import SongSpec
from src.shared.audio.synthetic import render_song
render_song(SongSpec(seconds=6.0, seed=1)).write_wav(Path("song.wav"))
Path("path.csv").write_text("x,z\\n0,0\\n0,2\\n1,3\\n")
Path("timeline.json").write_text('[{"text": "a person walks forward", "start": 0, "end": 3},'
    ' {"text": "a person waves", "start": 3, "end": 5}]')
"""

GENERATE = ["generate", "--threads", "1", "--device", "cpu"]
EVALUATE = ["--threads", "1", "--device", "cpu"]
COMMANDS: dict[str, list[str]] = {
    "prepare": ["prepare", "--synthetic", "60", "--seed", "3"],
    "wave": [*GENERATE, "--prompt", WAVE, "--format", "bvh,glb,npz,html"],
    "several": [*GENERATE, "--prompt", "una persona corre", "--prompt", "人が歩く", "--seed", "5"],
    "best": [*GENERATE, "--prompt", WAVE, "--num-samples", "3", "--return-all"],
    "free": [*GENERATE, "--prompt", WALK, "--model", "starter-free", "--no-foot-lock"],
    "measured": [*GENERATE, "--prompt", "turn 90 degrees to the left, then wave twice"],
    "long": [*GENERATE, "--prompt", WALK, "--seconds", "9", "--steps", "4"],
    "then": [*GENERATE, "--prompt", WALK, "--then", "a person claps", "--loop"],
    "timeline": [*GENERATE, "--timeline", "timeline.json"],
    "path": [*GENERATE, "--prompt", WALK, "--path", "path.csv"],
    "continue": [*GENERATE, "--prompt", WALK, "--start", f"{MADE}.bvh", "--keep", "0.5"],
    "edit": [*GENERATE, "--edit", f"{MADE}.bvh", "--joints", "right-arm", "--prompt", WAVE],
    "song": [*GENERATE, "--audio", "song.wav", "--format", "npz,csv,glb,png", *STYLE],
    "dance": [*GENERATE, "--audio", "song.wav", "--prompt", "a person dances", "--seed", "2"],
    "body": [*GENERATE, "--audio", "song.wav", "--body", "--num-samples", "2", "--steps", "4"],
    "convert": ["convert", f"{MADE}.bvh", OUT, "--format", "glb,usd,csv"],
    "features": ["features", "song.wav", "--out", f"{OUT}/song.npz"],
    "evaluate-text": ["evaluate", "--data", "made/prepare", "--num-samples", "12",
                      "--replications", "2", "--control-seeds", "1", "--steps", "2", *EVALUATE],
    "evaluate-audio": ["evaluate", "--model", "starter-audio", "--num-songs", "2",
                       "--song-seconds", "8", "--replications", "2", "--steps", "2", *EVALUATE],
    "evaluate-sanity": ["evaluate-sanity", "--num-samples", "4", "--num-steps", "2",
                        "--output-dir", OUT, *EVALUATE],
}  # fmt: skip
TIMES = re.compile(rb'("(?:seconds|timings|created|written)": )(?:[\d.]+|"[^"]*"|\{[^}]*\})')
UNSTABLE = ("timing.json", ".lock")


def hashes(folder: Path) -> dict[str, str]:
    """SHA-256 of every file below, by its path; without what tells of the clock."""
    found = {}
    for file in sorted(path for path in folder.rglob("*") if path.is_file()):
        if not file.name.endswith(UNSTABLE):
            content = TIMES.sub(rb"\1", file.read_bytes())
            found[file.relative_to(folder).as_posix()] = hashlib.sha256(content).hexdigest()[:16]
    return found


def run_all(root: Path, only: list[str]) -> dict[str, str]:
    """Run the commands of the tree at `root` in an empty folder."""
    with tempfile.TemporaryDirectory() as place:
        work = Path(place)
        alone = {"PYTHONPATH": str(root), "OMP_NUM_THREADS": "1", "HF_HUB_OFFLINE": "1"}
        shared = {"cwd": work, "env": os.environ | alone, "check": False}
        subprocess.run([sys.executable, "-c", INPUTS], **shared)  # type: ignore[call-overload]
        found = {}
        for name, arguments in COMMANDS.items():
            if only and name not in (*only, "wave", "prepare"):
                continue
            named = any(word.startswith(OUT) for word in arguments)
            words = [*arguments, *([] if named else ["--out", OUT])]
            words = [re.sub(f"^{OUT}", f"made/{name}", word) for word in words]
            done = subprocess.run(
                [sys.executable, "-m", "src.cli.tools", *words],
                **shared, capture_output=True, text=True,
            )  # type: ignore[call-overload]  # fmt: skip
            found[f"{name}: exit"] = str(done.returncode)
            if done.returncode:
                print(f"{name}: {done.stderr.strip()[-400:]}", file=sys.stderr)
            for file, digest in hashes(work / "made" / name).items():
                found[f"{name}: {file}"] = digest
            print(name, done.returncode, file=sys.stderr, flush=True)
        return found


def main() -> int:
    """Write the hashes; compare."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--against", type=Path, help="hashes written before")
    parser.add_argument("--root", type=Path, default=ROOT, help="the tree whose commands are run")
    parser.add_argument("--only", nargs="*", default=[], help="names of commands")
    options = parser.parse_args()
    found = run_all(options.root.resolve(), options.only)
    options.out.write_text(json.dumps(found, indent=1, ensure_ascii=False), encoding="utf-8")
    if options.against is None:
        return 0
    before = json.loads(options.against.read_text(encoding="utf-8"))
    kept = {name for name in before if not options.only or name.split(":")[0] in options.only}
    differ = [name for name in sorted(kept | found.keys()) if before.get(name) != found.get(name)]
    print(*differ or ["nothing changed"], sep="\n")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
