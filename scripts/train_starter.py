#!/usr/bin/env python3
"""Make the starter weights anew: prepare, eight trainings, and the shipped folders.

    python scripts/train_starter.py SOURCE ... --captions FILE ... [--work DIR] [--ship]
    python scripts/train_starter.py CMU --captions FILE ... --free --work DIR [--ship]

SOURCES are folders of motion files (the shipped set: bandai-namco and cmu); captions come from
scripts/starter_clips.tsv, which cuts and labels the takes of four more (cmu-more, o3de-locomotion,
cc0-handmade, fair-mit), and from FILEs. Every stage resumes, and does nothing when it is finished.
The weighted mean of the second and the third generator serves combinations that training did not
see better than either; it learns constraints in a last round, and the mean of before and after is
the starter. `--ship` writes fp16 copies into src/shared/pretrained.

With `--free` SOURCES are data that is free for any use (the shipped set: cmu), beside more
synthetic clips, and one training of each kind makes starter-free in about an hour.
"""

import argparse
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLIPS = ROOT / "scripts" / "starter_clips.tsv"  # pieces and labels of the sources' takes
SHIPPED = ROOT / "src" / "shared" / "pretrained"
SYNTHETIC_CLIPS, SYNTHETIC_FREE = 3000, 4000
FIRST = ["min-frames=40", "max-frames=150", "losses.position=1.0", "losses.foot-slide=0.02"]
SECOND = ["min-frames=40", "max-frames=180", "losses.position=2.0", "losses.foot-slide=0.1"]
THIRD = [*SECOND, "losses.root=0.5"]
FREE = "network.generation.constraints=false"  # learned last, by a network that can walk
OTHER = "other-tower=true"  # hardened anew, in the same space
FOURTH = [*THIRD, "constraints.free=0.4"]
AVERAGE = "average"
MEANS = {  # what is averaged: the two runs, and the share of the second
    "mean": ("second", "third", 0.6),
    "starter": ("mean", "constrained", 0.5),
}  # the only shares that were tried
LICENCE = "CC BY-NC 4.0 (learned from the Bandai-Namco Research Motiondataset: non-commercial)"
FREE_LICENCE = "free for any use (learned from CMU motion capture and synthetic clips)"
FREE_DESCRIPTION = "text to body motion; CMU and synthetic, free for any use; en es fr de ja zh"
DESCRIPTION = "text to body motion; Bandai-Namco, CMU and synthetic; en es fr de ja zh"


def stages(options: argparse.Namespace) -> list[list[str]]:
    """The command of each stage, in order."""
    data, work = str(options.work / "data"), options.work
    train = [f"threads={options.threads}", "precision=auto", "--data", data]
    clip, hardened, first, second, again = (
        work / name for name in ("clip", "hardened", "first", "second", "hardened-again")
    )
    learn = ["-m", "src.train.train_generation", *train, "batch-size=48"]
    return [
        ["-m", "src.cli.tools", "prepare", *options.sources, *options.tables,
         "--synthetic", str(SYNTHETIC_CLIPS), "--out", data],
        ["-m", "src.train.train_clip", *train, *FIRST[:2], "batch-size=128", "steps=1800",
         "--output", str(clip), "--resume"],
        ["-m", "src.train.train_evaluator", "--data", data, f"threads={options.threads}",
         "steps=1500", "--output", str(work / "evaluator"), "--resume"],
        [*learn, *FIRST, FREE, f"clip={clip}", f"steps={options.steps}", "--output", str(first),
         "--resume"],
        ["-m", "src.train.train_text", *train, *FIRST[:2], f"clip={clip}", "steps=2500",
         "--output", str(hardened), "--resume"],
        [*learn, *SECOND, FREE, f"clip={hardened}", f"init={first}", OTHER,
         f"steps={options.steps}", "learning-rate=6e-4", "--output", str(second), "--resume"],
        ["-m", "src.train.train_text", *train, *FIRST[:2], f"clip={clip}", "steps=2000",
         "--output", str(again), "--resume"],
        [*learn, *THIRD, FREE, f"clip={again}", f"init={second}", OTHER, f"steps={options.steps}",
         "learning-rate=5e-4", "--output", str(work / "third"), "--resume"],
        [AVERAGE, "mean"],
        [*learn, *FOURTH, f"clip={again}", f"init={work / 'mean'}", OTHER, f"steps={options.steps}",
         "learning-rate=5e-4", "--output", str(work / "constrained"), "--resume"],
        [AVERAGE, "starter"],
    ]  # fmt: skip


def free_stages(options: argparse.Namespace) -> list[list[str]]:
    """The command of each stage of starter-free, in order."""
    data, work = str(options.work / "data"), options.work
    train = [f"threads={options.threads}", "precision=auto", "--data", data, *FIRST[:2]]
    clip, text, last = work / "clip", work / "text", work / "free"
    return [
        ["-m", "src.cli.tools", "prepare", *options.sources, *options.tables,
         "--synthetic", str(SYNTHETIC_FREE), "--out", data],
        ["-m", "src.train.train_clip", *train, "batch-size=128", "steps=1500",
         "--output", str(clip), "--resume"],
        ["-m", "src.train.train_text", *train, f"clip={clip}", "steps=2000",
         "--output", str(text), "--resume"],
        ["-m", "src.train.train_generation", *train, *THIRD[2:], FREE, f"clip={text}",
         "batch-size=48", "steps=4000", "learning-rate=1e-3", "--output", str(last), "--resume"],
    ]  # fmt: skip


def average(work: Path, name: str) -> None:
    """Write the mean of two generators' weights (Wortsman et al. 2022); what only the second has
    is taken as it is."""
    import torch

    from src.shared.model.generation.motion_generator import MotionGenerator

    first, second, share = MEANS[name]
    before = MotionGenerator.from_pretrained(work / first).denoiser.state_dict()
    generator = MotionGenerator.from_pretrained(work / second)
    weights = generator.denoiser.state_dict()
    mean = {key: torch.lerp(before.get(key, weights[key]), weights[key], share) for key in weights}
    generator.denoiser.load_state_dict(mean)
    summary = generator.card.training | {"averaged": {first: 1 - share, second: share}}
    generator.card = generator.card.model_copy(update={"training": summary})
    generator.save_pretrained(work / name)


def ship(trained: Path, name: str, licence: str, description: str) -> None:
    """Write a generator, in fp16, where `from_pretrained` finds it."""
    from src.shared.model.generation.motion_generator import MotionGenerator

    generator = MotionGenerator.from_pretrained(trained)
    about = {"name": name, "licence": licence, "description": description}
    generator.card = generator.card.model_copy(update=about)
    generator.save_pretrained(SHIPPED / name, half=True)


def ship_judge(trained: Path) -> None:
    """Write the evaluator beside it."""
    from src.shared.evaluation.evaluator import Evaluator

    judge = Evaluator.from_pretrained(trained)
    judge.save_pretrained(SHIPPED / "evaluator", notes=judge.notes)


def main() -> int:
    """Run the stages; stop at the first that fails."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("sources", nargs="+")
    parser.add_argument("--captions", nargs="*", default=[], help="CSV, TSV or JSON")
    parser.add_argument("--work", type=Path, default=Path("runs/starter"))
    parser.add_argument("--steps", type=int, default=5800, help="of each of four generation stages")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--free", action="store_true", help="make starter-free instead")
    parser.add_argument("--ship", action="store_true", help="write src/shared/pretrained")
    options = parser.parse_args()
    tables = [str(CLIPS), *options.captions]
    options.tables = [part for table in tables for part in ("--captions", table)]
    sys.path.insert(0, str(ROOT))
    # An exit on the way of `subprocess.call` ends the stage that it started.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    for arguments in (free_stages if options.free else stages)(options):
        if arguments[0] == AVERAGE:
            average(options.work, arguments[1])
            continue
        print("$ python", *arguments, flush=True)
        if code := subprocess.call([sys.executable, *arguments], cwd=ROOT):
            return code
    if options.ship and options.free:
        ship(options.work / "free", "starter-free", FREE_LICENCE, FREE_DESCRIPTION)
    elif options.ship:
        ship(options.work / "starter", "starter", LICENCE, DESCRIPTION)
        ship_judge(options.work / "evaluator")
    return 0


if __name__ == "__main__":
    sys.exit(main())
