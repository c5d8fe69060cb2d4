"""kill -9 at random moments: is what goes on afterwards the very bytes of an uninterrupted run?

python -m tests.kills [--kills 20] [--seed 0] [--workers 1] [--only NAME]

Each subject works in a process forked from this one, which has imported everything, so that a
random moment falls into the work. It is killed, with whatever it started, at a random moment and
started again until it has finished; then its folder is compared with the reference, and the next
begins, until there were so many kills. Files that say how long something took are not compared.
"""

import argparse
import hashlib
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from pathlib import Path

from src.shared.data import prepare as preparation
from src.shared.data.sources.folders import SyntheticSource
from src.shared.io.files import sole_writer
from src.shared.memory import build
from src.shared.memory.build import build_memory
from tests.shared.memory.tiny_memory import LinearSpace, write_dancers

sys.path.insert(0, str(Path(__file__).parent / "train"))
from tiny_audio_stage import audio_config, train_audio, write_circles
from tiny_stage import clip_config, generation_config, train_clip, train_generation

Subject = Callable[[Path], object]


def subjects(folder: Path, workers: int) -> dict[str, Subject]:
    """What is killed, by name; what they read is made first.

    Args:
        workers: of prepare; several take seconds to start, in which there is little to spoil.
    """
    preparation.CLIPS_PER_SHARD, build.CHUNK = 12, 8
    data, clip = folder / "data", folder / "clip"
    preparation.prepare([SyntheticSource(120)], data, workers=1)
    train_clip(clip_config(data, clip))
    circles, dancers = write_circles(folder / "circles"), write_dancers(folder / "dancers", 60)

    more = ("steps=24", "log-every=2", "save-every=3", "validate-every=8")
    stream = (*more, "stream=true")
    return {
        "prepare": lambda out: preparation.prepare([SyntheticSource(120)], out, workers=workers),
        "train clip": lambda out: train_clip(clip_config(data, out, *more), resume=True),
        "train clip, streamed": lambda out: train_clip(
            clip_config(data, out, *stream), resume=True
        ),
        "train generation": lambda out: train_generation(
            generation_config(data, clip, out, *more), resume=True
        ),
        "train audio": lambda out: train_audio(audio_config(circles, out, *more), resume=True),
        "memory build": lambda out: build_memory(dancers, LinearSpace(), out),
    }


def start(work: Subject, out: Path, log: Path) -> int:
    """A process that does the work in `out`; its id, which is that of its group."""
    pid = os.fork()
    os.setpgid(pid, pid)  # in both: it may be killed before it comes to it
    if pid:
        return pid
    with log.open("ab") as stream:
        for number in (1, 2):
            os.dup2(stream.fileno(), number)
    code = 0
    try:
        with sole_writer(out):  # as every command
            work(out)
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stderr.flush()
    os._exit(code)


def ended(pid: int, seconds: float) -> bool:
    """Whether it ends by itself within so long; AssertionError where it fails."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found, status = os.waitpid(pid, os.WNOHANG)
        if found:
            assert status == 0, f"failed with {status}"
            return True
        time.sleep(0.005)
    return False


def contents(out: Path) -> dict[str, str]:
    """Hashes of all files by name, logs without the speed of steps."""
    found = {}
    for path in sorted(out.rglob("*")):
        name = path.relative_to(out).as_posix()
        if path.is_dir() or path.name == ".lock":
            continue
        data = path.read_bytes()
        if path.name == "log.jsonl":
            lines = [json.loads(line) for line in data.splitlines()]
            for line in lines:
                line.pop("steps-per-second", None)
            data = json.dumps(lines).encode()
        # the folder is named in what is written; it is not the reference's
        data = data.replace(out.name.encode(), b"OUT")
        found[name] = hashlib.sha256(data).hexdigest()
    return found


def kill(work: Subject, folder: Path, kills: int, rng: random.Random) -> tuple[int, int]:
    """Kill the work so often; kills and finished runs. AssertionError where bytes differ."""
    log, reference = folder / "log.txt", folder / "out-reference"
    begin = time.monotonic()
    assert ended(start(work, reference, log), 3600)
    whole, wanted = time.monotonic() - begin, contents(reference)
    done = finished = 0
    while done < kills:
        out = folder / f"out-{finished:09d}"
        while True:
            pid = start(work, out, log)
            if ended(pid, rng.uniform(0, whole) if done < kills else 3600):
                break
            os.killpg(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            done += 1
        found = contents(out)
        assert found == wanted, sorted(
            name for name in {*found, *wanted} if found.get(name) != wanted.get(name)
        )
        finished += 1
        shutil.rmtree(out)
    return done, finished


def main(arguments: list[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=20, help="of each subject")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1, help="of prepare")
    parser.add_argument("--only", help="one subject")
    given = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory(prefix="kills-") as name:
        found = subjects(Path(name), given.workers)
        for subject, work in found.items():
            if given.only in (None, subject):
                folder = Path(name, subject.replace(" ", "-") + "-runs")
                folder.mkdir()
                rng = random.Random(f"{given.seed} {subject}")
                try:
                    done, finished = kill(work, folder, given.kills, rng)
                except AssertionError as error:
                    sys.exit(f"{subject}: {error}\n{(folder / 'log.txt').read_text()[-3000:]}")
                print(
                    f"{subject}: killed {done} times, {finished} runs, the same bytes", flush=True
                )


if __name__ == "__main__":
    main()
