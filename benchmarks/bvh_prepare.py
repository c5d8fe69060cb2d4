"""How fast is mocap taken in? Reading, retargeting, encoding: multiples of real time per core.

python -m benchmarks.bvh_prepare FOLDER [--clips 40] [--json OUT]

One process, one thread; each clip goes through what `prepare` does with it. The multiple is the
length of the motion over the seconds of processor time spent, so that a busy machine does not
count; reading from the disk waits for nothing here.
"""

import argparse
import json
import random
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from src.shared.data.retarget.mapping import SkeletonMapping

FPS = 30.0
STAGES = ("read", "retarget", "encode")


def measure_clip(path: Path, mappings: "tuple[SkeletonMapping, ...]") -> dict[str, float]:
    """Seconds of motion in a file, and seconds spent on each stage, as `MotionFolder` reads it.

    Raises:
        UserError: the file is faulty, or its joints are in no mapping.
    """
    from src.shared.data.retarget.read_motion import fit, open_recording
    from src.shared.motion.features import encode_features

    start = time.process_time()
    recording = open_recording(path)
    read = time.process_time()
    motion = fit(path, recording, mappings, fps=FPS)
    retargeted = time.process_time()
    encode_features(motion)
    encoded = time.process_time()
    return {
        "motion": motion.seconds,
        "read": read - start,
        "retarget": retargeted - read,
        "encode": encoded - retargeted,
    }


def summary(clips: list[dict[str, float]]) -> dict[str, Any]:
    """Totals over clips, as multiples of real time."""
    total = {name: sum(clip[name] for clip in clips) for name in clips[0]}
    spent = sum(total[stage] for stage in STAGES)
    return {
        "clips": len(clips),
        "motion_seconds": total["motion"],
        "spent_seconds": {stage: total[stage] for stage in STAGES},
        "times_real_time": {stage: total["motion"] / total[stage] for stage in STAGES}
        | {"all": total["motion"] / spent},
    }


def show(result: dict[str, Any]) -> None:
    """The result as a table on the terminal."""
    from rich.console import Console
    from rich.table import Table

    table = Table(
        "stage",
        "CPU seconds",
        "times real time",
        title=f"{result['clips']} clips, {result['motion_seconds']:.0f} s of motion, one core",
    )
    spent = result["spent_seconds"] | {"all": sum(result["spent_seconds"].values())}
    for stage, multiple in result["times_real_time"].items():
        table.add_row(stage, f"{spent[stage]:.2f}", f"{multiple:.0f}")
    Console().print(table)


def main() -> None:
    """Parse, measure, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path, help="motion files, at any depth")
    parser.add_argument("--clips", type=int, default=40, help="how many, drawn at random")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", type=Path, help="write the result here")
    arguments = parser.parse_args()

    import torch

    from src.shared.data.retarget.mapping import load_mappings
    from src.shared.data.retarget.read_motion import FOLDER_ENDINGS
    from src.shared.errors import UserError

    torch.set_num_threads(1)
    files = sorted(p for p in arguments.folder.rglob("*") if p.suffix.lower() in FOLDER_ENDINGS)
    if not files:
        raise SystemExit(f"{arguments.folder} holds no motion file")
    chosen = random.Random(arguments.seed).sample(files, min(arguments.clips, len(files)))
    mappings = load_mappings()
    measure_clip(chosen[0], mappings)  # first use compiles and allocates
    clips = []
    for path in chosen:
        try:
            clips.append(measure_clip(path, mappings))
        except UserError as error:
            print(f"left out: {error}")
    if not clips:
        raise SystemExit("none of the files could be read")
    result = summary(clips)
    show(result)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
