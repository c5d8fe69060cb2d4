"""Stopped by whatever stops it: is what goes on afterwards the very bytes of an undisturbed run?

python -m tests.faults [--times 20] [--seed 0] [--workers 1] [--only SUBJECT] [--fault FAULT]

Each subject is a command in a process forked from this one, which has imported everything, so that
a random moment falls into the work. It meets a fault and is started again until it has finished;
then its folder is compared with that of an undisturbed run, and the next begins.

    kill         signal 9, with whatever it started, at a random moment
    Ctrl-C       SIGINT likewise
    SIGTERM      to the command alone, likewise
    full disk    a file system with room for a random share of what it writes; then there is more
    read-only    killed at a random moment, its file system cannot be written; then it can again

But after a kill, it must end with the right code, no traceback and nothing half-written, with one
line of error where a disk is the reason. Whenever what is written last is there, all other files
must be those of the undisturbed run. The speed of steps is not compared.
"""

import argparse
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from src.cli import tools
from src.shared.data import prepare as preparation
from src.shared.data.sources import SyntheticSource
from src.shared.io.files import is_unfinished
from src.shared.memory import build
from src.shared.model.audio.shared_space import SharedSpace
from tests.shared.memory.tiny_memory import LinearSpace, write_dancers

sys.path.insert(0, str(Path(__file__).parent / "train"))
import tiny_audio_stage as audio
import tiny_stage as text

Subject = Callable[[Path], list[str]]
SIGNALS = {"kill": signal.SIGKILL, "Ctrl-C": signal.SIGINT, "SIGTERM": signal.SIGTERM}
DISKS = ("full disk", "read-only")
LONG = 3600.0  # seconds, for whoever is not disturbed


def subjects(folder: Path, workers: int) -> dict[str, Subject]:
    """The commands, by name; what they read is made first.

    Args:
        workers: of prepare; several take seconds to start, in which there is little to spoil.
    """
    preparation.CLIPS_PER_SHARD, build.CHUNK = 12, 8
    SharedSpace.from_pretrained = lambda name: LinearSpace()  # type: ignore[assignment, method-assign, misc]
    data, clip = folder / "data", folder / "clip"
    preparation.prepare([SyntheticSource(120)], data, workers=1)
    text.train_clip(text.clip_config(data, clip))
    circles = audio.write_circles(folder / "circles")
    dancers = write_dancers(folder / "dancers", 60)

    settings = ["steps=24", "log-every=2", "save-every=3", "validate-every=8", "keep-checkpoints=1"]
    words = [*text.SETTINGS, *settings, *(f"network.{value}" for value in text.NETWORK)]
    sound = [*audio.SETTINGS, *audio.PREFIX, *settings, *audio.NETWORK]

    def train(stage: str, read: Path, *settings: str) -> Subject:
        command = ["train", stage, "--resume", "--network-profile=lightweight", f"--data={read}"]
        return lambda out: [*command, f"--output={out}", *settings]

    return {
        "prepare": lambda out: [
            *("prepare", "--synthetic=120", f"--workers={workers}", f"--out={out}")
        ],
        "train clip": train("clip", data, *words),
        "train clip, streamed": train("clip", data, *words, "stream=true"),
        "train generation": train("generation", data, *words, f"clip={clip}", "steps=120"),
        "train audio": train("audio", circles, *sound),
        "memory build": lambda out: ["memory", "build", str(dancers), f"--out={out}"],
    }


def start(command: list[str], log: Path) -> int:
    """A process that runs a command of `motion-tools`; its id, which is that of its group."""
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    pid = os.fork()
    os.setpgid(pid, pid)  # in both: it may be killed before it comes to it
    if pid:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        return pid
    code = 1
    try:
        with log.open("wb") as stream:
            for number in (1, 2):
                os.dup2(stream.fileno(), number)
        sys.argv = ["motion-tools", *command]
        signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored where `&` began it
        with suppress(KeyboardInterrupt):  # that came before the command did
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        tools.main()
    except SystemExit as end:
        code = int(end.code or 0)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)


def ended(pid: int, seconds: float) -> int | None:
    """The exit code if it ends within so long, as a shell has it: 128 + a signal that ended it."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found, status = os.waitpid(pid, os.WNOHANG)
        if found:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else 128 - code
        time.sleep(0.005)
    return None


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


class Trial:
    """One subject and its undisturbed run, in a folder of its own."""

    def __init__(self, subject: Subject, folder: Path, rng: random.Random) -> None:
        self.subject, self.folder, self.rng = subject, folder, rng
        self.log, self.wanted = folder / "log.txt", dict[str, str]()
        folder.mkdir()
        reference, begin = folder / "out-reference", time.monotonic()
        self.run(reference)
        self.seconds = time.monotonic() - begin
        self.wanted = contents(reference)
        # What follows the steps of a training, and lets itself not be interrupted, may take longer.
        steps = [path.stat().st_mtime for path in reference.glob("log.jsonl")]
        self.steps = max(steps) - time.time() + self.seconds if steps else self.seconds
        files = [path for path in reference.rglob("*") if path.is_file()]
        self.size = sum(path.stat().st_size for path in files)
        written = {path.relative_to(reference): path.stat().st_mtime_ns for path in files}
        latest = max(written.values())  # of several, where the clock of the file system is coarse
        self.last = [name for name, when in written.items() if when == latest]

    def run(self, out: Path, *codes: int) -> int:
        """Run the command to its end; its code is 0, or one of those given."""
        return self.checked(out, ended(start(self.subject(out), self.log), LONG), 0, *codes)

    def stopped(self, out: Path, number: int) -> int:
        """Run it and send the signal at a random moment, if it still runs; its code.

        Half of the moments are before the last step.
        """
        pid = start(self.subject(out), self.log)
        code = ended(pid, self.rng.uniform(0, self.rng.choice((self.steps, self.seconds))))
        if code is None:
            (os.kill if number == signal.SIGTERM else os.killpg)(pid, number)
            code = ended(pid, LONG)
        return self.checked(out, code, 0, 128 + number)

    def checked(self, out: Path, code: int | None, *codes: int) -> int:
        """The code, if that, what was said and what was left are in order."""
        said = self.log.read_text()
        assert code in codes, f"ended with {code}, not {codes}"
        assert "Traceback" not in said
        if code in (1, 2):
            assert said.splitlines()[-1].startswith("error: ") and said.count("error: ") == 1
        if code != 128 + signal.SIGKILL and os.access(out, os.W_OK):  # it can tidy up
            left = [path.name for path in out.rglob("*") if is_unfinished(path)]
            assert not left, f"half-written: {left}"
        if self.wanted and (code == 0 or all((out / name).exists() for name in self.last)):
            found = contents(out)
            names = {*self.wanted} | (set() if code else {*found})
            differ = sorted(name for name in names if found.get(name) != self.wanted.get(name))
            assert not differ, f"other bytes: {differ}"
        return code

    def signals(self, times: int, number: int) -> int:
        """So many signals; the number of finished runs that they fell into."""
        met = finished = 0
        while met < times:
            out = self.folder / f"out-{finished:09d}"
            while met < times and self.stopped(out, number):
                met += 1
            self.run(out)
            finished += 1
            shutil.rmtree(out)
        return finished

    def disks(self, times: int, fault: str) -> int:
        """So many runs on a disk that does not take them, until it does."""
        for _ in range(times):
            with disk(self.folder / "disk") as remount:
                out = self.folder / "disk" / "out-000000000"
                if fault == "full disk":
                    remount(f"size={int(self.size * self.rng.uniform(0.05, 0.95))}")
                else:
                    self.stopped(out, signal.SIGKILL)
                    remount("ro")
                usage = () if fault == "full disk" else (2,)
                assert self.run(out, 1, *usage), "it took no notice"
                remount("rw,size=1g")
                self.run(out)
        return times


@contextmanager
def disk(folder: Path) -> Iterator[Callable[[str], object]]:
    """A file system at `folder`, in memory; its value mounts it anew with other options."""
    folder.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "faults", folder], check=True, stderr=subprocess.PIPE)
    try:
        yield lambda options: subprocess.run(
            ["mount", "-o", f"remount,{options}", folder], check=True
        )
    finally:
        subprocess.run(["umount", folder], check=True)


def main(arguments: list[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=20, help="of each subject and fault")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1, help="of prepare")
    parser.add_argument("--only", help="one subject")
    parser.add_argument("--fault", choices=(*SIGNALS, *DISKS), help="one fault")
    given = parser.parse_args(arguments)
    faults = [given.fault] if given.fault else [*SIGNALS, *DISKS]
    with tempfile.TemporaryDirectory(prefix="faults-") as name:
        try:
            with disk(Path(name, "disk")):
                pass
        except (OSError, subprocess.CalledProcessError):
            print("left out, as no file system can be mounted here:", ", ".join(DISKS))
            faults = [fault for fault in faults if fault not in DISKS]
        for subject, command in subjects(Path(name), given.workers).items():
            if given.only not in (None, subject):
                continue
            folder = Path(name, subject.replace(" ", "-") + "-runs")
            fault = "nothing"
            try:
                trial = Trial(command, folder, random.Random())
                for fault in faults:
                    trial.rng.seed(f"{given.seed} {subject} {fault}")
                    if fault in DISKS:
                        runs = trial.disks(given.times, fault)
                    else:
                        runs = trial.signals(given.times, SIGNALS[fault])
                    print(f"{subject}: {fault} {given.times} times, {runs} runs, the same bytes",
                          flush=True)  # fmt: skip
            except AssertionError as error:
                said = (folder / "log.txt").read_text()[-3000:]
                sys.exit(f"{subject}: {fault}: {error}\n{said}")


if __name__ == "__main__":
    main()
