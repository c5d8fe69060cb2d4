"""Training sets that do not fit: memory, steps a second and loader throughput by hours of motion.

    python benchmarks/streaming.py text --hours 1 1000 --folder /tmp/streaming
    python benchmarks/streaming.py audio --hours 1 1000 --folder /tmp/streaming

One hour is made for real, synthetic; more hours are that hour under other names, with as many
records and shards as there would be: of text by hard links, of audio by a manifest that names the
same objects again. A set is used in a process of its own, whose peak memory is told.
"""

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

CLIPS = 850  # of the synthetic source: an hour
PHRASES, FRAMES = 360, 300  # of 10 s
ROWS = {"mel": 128, "chroma": 12, "mfcc": 20, "rms": 0, "spectral_centroid": 0, "onset_strength": 0}


def text_hour(folder: Path) -> None:
    """An hour of synthetic clips, prepared."""
    from src.shared.data.prepare import prepare
    from src.shared.data.sources import SyntheticSource

    prepare([SyntheticSource(CLIPS)], folder, workers=1)


def text_copies(hour: Path, out: Path, copies: int) -> None:
    """The hour so many times: shards are hard links, their records have names of their own."""
    from src.shared.io.files import sha256_file

    (out / "shards").mkdir(parents=True)
    manifest = json.loads((hour / "manifest.json").read_text())
    files = {}
    lines = (hour / "clips.jsonl").read_text().splitlines(keepends=True)
    with (out / "clips.jsonl").open("w") as stream:
        for copy in range(copies):
            for shard in sorted((hour / "shards").glob("*.safetensors")):
                name = f"shards/{copy:04d}-{shard.name}"
                os.link(shard, out / name)
                files[name] = manifest["files"][f"shards/{shard.name}"]
            for line in lines:
                named = line.replace('"id": "', f'"id": "{copy:04d}-', 1)
                stream.write(named.replace('"shard": "', f'"shard": "{copy:04d}-', 1))
    for name in ("captions.json", "statistics.safetensors"):
        shutil.copy(hour / name, out / name)
        files[name] = manifest["files"][name]
    files["clips.jsonl"] = sha256_file(out / "clips.jsonl")
    (out / "manifest.json").write_text(json.dumps(manifest | {"files": files}))


def audio_hour(folder: Path) -> None:
    """An hour of phrases: walks on circles, with sound that is noise."""
    from src.shared.data.phrases.layout import write_manifest, write_phrase
    from src.shared.motion.trajectory import MotionTrajectory

    rng, records, time_ = np.random.default_rng(0), [], np.arange(FRAMES) / 30
    for index in range(PHRASES):
        tempo, angle = rng.uniform(80, 140), time_ * rng.uniform(-0.5, 0.5)
        bars = time_ * tempo / 240
        zero = np.zeros(FRAMES)
        bounce = 1 + 0.03 * np.cos(8 * np.pi * bars)
        path = np.stack([np.cumsum(np.sin(angle)), bounce, np.cumsum(np.cos(angle))], axis=1)
        turned = np.stack([np.cos(angle / 2), zero, np.sin(angle / 2), zero], axis=1)
        path[:, [0, 2]] /= 30
        sound: dict[str, Any] = {
            name: rng.random((rows, FRAMES) if rows else FRAMES).astype(np.float32)
            for name, rows in ROWS.items()
        }
        sound |= {"phase": bars, "meter": np.array(4), "tempo": np.array(tempo)}
        trajectory = MotionTrajectory.from_pose(path, turned, bars).data
        split = "val" if index % 25 == 0 else "train"
        records.append(write_phrase(folder, f"{index:04d}", trajectory, sound, split=split))
    write_manifest(folder, records)


def audio_copies(hour: Path, out: Path, copies: int) -> None:
    """A manifest of so many times the phrases, whose objects are those of the hour."""
    out.mkdir(parents=True)
    for name in ("motion", "audio_features"):
        (out / name).symlink_to(hour / name)
    phrases = json.loads((hour / "manifest.json").read_text())["phrases"]
    with (out / "manifest.json").open("w") as stream:
        stream.write('{"version": 1, "fps": 30.0, "phrases": [\n')
        for copy in range(copies):
            named = (json.dumps(p | {"id": f"{copy:05d}-{p['id']}"}) for p in phrases)
            stream.write(("," if copy else "") + ",\n".join(named))
        stream.write("]}\n")


def use(kind: str, data: Path, steps: int, batch: int) -> dict[str, float]:
    """Train, then read batches alone; what that took."""
    from src.shared.config_loader import load_audio_network, load_network, load_train
    from src.shared.config_schema import TrainClipConfig
    from src.train.engine import Trainer
    from src.train.train_audio import AudioTask, TrainAudioConfig
    from src.train.train_clip import ClipTask

    output = tempfile.mkdtemp()
    settings = [
        *(f"data='{data}'", f"output='{output}'", f"steps={steps}", f"batch-size={batch}"),
        *("device=cpu", "precision=no", "threads=1", "tensorboard=false", "log-every=1"),
        *("warmup-steps=2", "validation-batches=1"),
    ]
    begun = time.perf_counter()
    trainer: Trainer[Any]
    if kind == "text":
        config = load_train(None, TrainClipConfig, [*settings, "stream=true"])
        network = load_network("lightweight")
        trainer = Trainer(config, lambda c: ClipTask(c, network), command="")
    else:
        audio = load_train(None, TrainAudioConfig, settings)
        sounding = load_audio_network("lightweight")
        trainer = Trainer(audio, lambda c: AudioTask(c, sounding), command="")
    start = time.perf_counter() - begun
    whole, spent = trainer._optimize, []

    def optimize(step: int, batches: Any) -> None:
        before = time.perf_counter(), time.process_time()
        whole(step, batches)
        spent.append((time.perf_counter() - before[0], time.process_time() - before[1]))

    trainer._optimize = optimize  # type: ignore[method-assign]
    trainer.train()
    wall, cpu = np.array(spent)[2:].T
    shutil.rmtree(output)
    task: Any = trainer.task
    seconds, frames, before = 0.0, 0, time.process_time()
    for step in range(steps + 1, 2 * steps + 1):
        item = task.train.batch(step, batch, **({"count": 1} if kind == "audio" else {}))
        frames += int(item.mask.sum())
    seconds = time.process_time() - before
    return {
        "start_s": start,
        "steps_a_second": float(1 / np.mean(wall)),
        "cpu_s_a_step": float(np.mean(cpu)),
        "cpu_s_a_step_median": float(np.median(cpu)),
        "loader_hours_a_cpu_second": frames / 30 / 3600 / seconds,
        "peak_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("kind", choices=["text", "audio"])
    parser.add_argument("--hours", type=int, nargs="+", default=[1, 1000])
    parser.add_argument("--folder", type=Path, default=Path(tempfile.gettempdir(), "streaming"))
    parser.add_argument("--steps", type=int, default=30)
    parser.add_argument("--batch", type=int, default=32)
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--use", type=Path, help="one set, in this process")
    given = parser.parse_args()
    if given.use:
        print(json.dumps(use(given.kind, given.use, given.steps, given.batch)))
        return
    hour = given.folder / f"{given.kind}-hour"
    if not (hour / "manifest.json").exists():
        {"text": text_hour, "audio": audio_hour}[given.kind](hour)
    for _ in range(given.repeats):
        for hours in given.hours:
            data = given.folder / f"{given.kind}-{hours}"
            if not (data / "manifest.json").exists():
                {"text": text_copies, "audio": audio_copies}[given.kind](hour, data, hours)
            flags = ["--steps", str(given.steps), "--batch", str(given.batch), "--use", str(data)]
            done = subprocess.run(
                [sys.executable, __file__, given.kind, *flags],
                stdout=subprocess.PIPE,
                env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[1])},
                check=True,
            )
            print(f"{hours} h:", {k: round(v, 3) for k, v in json.loads(done.stdout).items()})


if __name__ == "__main__":
    main()
