"""What two busy processes cost sampling, by how many threads it takes and how they wait.

python -m benchmarks.contention [--seconds 10] [--rounds 5] [--busy 2] [--json OUT]

One process for each way of waiting loads the shipped models once; then they take turns, first
alone, then beside `--busy` processes that only compute. A turn is 4 s of motion from a prompt, the
path of a song, and the body that dances along it; the seconds are those of sampling. CPU seconds
stand beside: on a machine that others use too, they are the steadier figure.
"""

import argparse
import contextlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WAYS = {
    "idle cores, as shipped": {},
    "all cores, always": {"OMP_NUM_THREADS": str(os.cpu_count() or 1)},
    "one thread": {"OMP_NUM_THREADS": "1"},
    "all cores, sleeping": {
        "OMP_NUM_THREADS": str(os.cpu_count() or 1),
        "OMP_WAIT_POLICY": "passive",
    },
}
Turn = tuple[float, float]  # wall and CPU seconds


def jobs(song_file: Path, seconds: float) -> dict[str, Callable[[], object]]:
    """What is timed, its models and its song loaded."""
    from src.shared.audio.song import analyse
    from src.shared.model.generation.motion_generator import TextToMotion
    from src.shared.pipelines.body import Performer
    from src.shared.pipelines.dance import SongPerformer
    from src.shared.pipelines.song import SongCondition, SongGenerator, of_song
    from src.shared.pipelines.song_sampler import SongSampling

    generator = TextToMotion.from_pretrained("starter", device="cpu")
    paths = SongGenerator.from_pretrained("starter-audio", device="cpu")
    song = analyse(song_file)
    heard, settings = SongCondition.of(song, seconds), of_song(SongSampling(), song)
    dancers = SongPerformer(Performer(generator))
    return {
        "text": lambda: generator.generate(["a person walks and waves"], seconds=4.0),
        "path": lambda: paths.generate(heard.condition, phase=heard.phase, settings=settings),
        "dance": lambda: dancers.dance(heard, "a person dances"),
    }


def work(song_file: Path, seconds: float) -> None:
    """In a process of its own: do the job that a line of stdin names, and answer with seconds."""
    known = jobs(song_file, seconds)
    for run in known.values():  # first calls allocate and choose kernels
        run()
    print("ready", flush=True)
    for line in sys.stdin:
        wall, cpu = time.perf_counter(), time.process_time()
        known[line.strip()]()
        print(json.dumps((time.perf_counter() - wall, time.process_time() - cpu)), flush=True)


class Worker:
    """A process that waits in one way."""

    def __init__(self, way: str, song_file: Path, seconds: float) -> None:
        command = [sys.executable, "-m", "benchmarks.contention", "--seconds", str(seconds)]
        own = {name: text for name, text in os.environ.items() if "OMP" not in name}
        self.process = subprocess.Popen(
            [*command, "--worker", str(song_file)],
            cwd=ROOT, env=own | WAYS[way], text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip
        self.answer()

    def answer(self) -> str:
        """Its next line."""
        assert self.process.stdout is not None
        if line := self.process.stdout.readline():
            return line
        raise SystemExit("a worker ended: its error is above")

    def time(self, job: str) -> Turn:
        """Seconds of one turn."""
        print(job, file=self.process.stdin, flush=True)
        wall, cpu = json.loads(self.answer())
        return wall, cpu


@contextlib.contextmanager
def busy(number: int) -> Iterator[None]:
    """So many processes that only compute, as long as the block lasts."""
    code = "while True: pass"
    others = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(number)]
    try:
        yield
    finally:
        for other in others:
            other.kill()


def turns(workers: dict[str, Worker], rounds: int) -> dict[str, dict[str, Turn]]:
    """Median seconds of each job and way; who begins changes from round to round."""
    ways, found = list(workers), {}
    for job in ("text", "path", "dance"):
        times: dict[str, list[Turn]] = {way: [] for way in ways}
        for place in range(rounds):
            for way in ways[place % len(ways) :] + ways[: place % len(ways)]:
                times[way].append(workers[way].time(job))
        found[job] = {
            way: (statistics.median(t[0] for t in each), statistics.median(t[1] for t in each))
            for way, each in times.items()
        }
    return found


def main() -> None:
    """Time alone, then beside busy processes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="of song and dance")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--busy", type=int, default=2, help="processes beside")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--worker", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.worker is not None:
        work(options.worker, options.seconds)
        return

    from src.shared.audio.synthetic import SongSpec, render_song

    with tempfile.TemporaryDirectory() as folder:
        song = Path(folder) / "song.wav"
        render_song(SongSpec(seconds=options.seconds + 2, tempo=112, seed=3)).write_wav(song)
        workers = {way: Worker(way, song, options.seconds) for way in WAYS}
        alone = turns(workers, options.rounds)
        with busy(options.busy):
            beside = turns(workers, options.rounds)
        for worker in workers.values():
            worker.process.kill()
    print(
        f"seconds of sampling (of CPU), median of {options.rounds}; load {os.getloadavg()[0]:.1f}"
    )
    for job, by_way in alone.items():
        for way, (wall, cpu) in by_way.items():
            then, then_cpu = beside[job][way]
            print(f"{job:6} {way:22} alone {wall:6.2f} ({cpu:6.2f})  beside {options.busy} busy"
                  f" {then:6.2f} ({then_cpu:6.2f})  times slower {then / wall:.2f}")  # fmt: skip
    if options.json is not None:
        found = {"alone": alone, "beside": beside, "seconds": options.seconds}
        options.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
