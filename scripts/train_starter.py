#!/usr/bin/env python3
"""Make the starter weights anew: prepare, four trainings, and the shipped folders.

    python scripts/train_starter.py SOURCE ... --captions FILE [--work DIR] [--ship]

SOURCES are folders of BVH files (the shipped set: bandai-namco and cmu). Every stage resumes, and
does nothing when it is finished. `--ship` writes fp16 copies into src/shared/pretrained.
"""

import argparse
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SYNTHETIC_CLIPS = 3000
WINDOWS = ["min-frames=40", "max-frames=150"]
LICENCE = "CC BY-NC 4.0 (learned from the Bandai-Namco Research Motiondataset: non-commercial)"
DESCRIPTION = "text to body motion; Bandai-Namco, CMU and synthetic; en es fr de ja zh"


def stages(options: argparse.Namespace) -> list[list[str]]:
    """The command of each stage, in order."""
    data, work = str(options.work / "data"), options.work
    train = [f"threads={options.threads}", "precision=auto", *WINDOWS, "--data", data]
    return [
        ["-m", "src.cli.tools", "prepare", *options.sources, "--captions", options.captions,
         "--synthetic", str(SYNTHETIC_CLIPS), "--out", data],
        ["-m", "src.train.train_clip", *train, "batch-size=128", "steps=1800",
         "--output", str(work / "clip"), "--resume"],
        ["-m", "src.train.train_evaluator", "--data", data, f"threads={options.threads}",
         "steps=1500", "--output", str(work / "evaluator"), "--resume"],
        ["-m", "src.train.train_generation", *train, "batch-size=48",
         f"clip={work / 'clip'}", f"steps={options.steps}", "losses.position=1.0",
         "losses.foot-slide=0.02", "--output", str(work / "generation"), "--resume"],
        ["-m", "src.train.train_text", *train, f"clip={work / 'clip'}", "steps=2500",
         f"generator={work / 'generation'}", "--output", str(work / "starter"), "--resume"],
    ]  # fmt: skip


def ship(work: Path) -> None:
    """Write the generator and the evaluator, in fp16, where `from_pretrained` finds them."""
    sys.path.insert(0, str(ROOT))
    from src.shared.evaluation.evaluator import Evaluator
    from src.shared.model.generation.motion_generator import MotionGenerator

    shipped = ROOT / "src" / "shared" / "pretrained"
    generator = MotionGenerator.from_pretrained(work / "starter")
    generator.card = generator.card.model_copy(
        update={"name": "starter", "licence": LICENCE, "description": DESCRIPTION}
    )
    generator.save_pretrained(shipped / "starter", half=True)
    judge = Evaluator.from_pretrained(work / "evaluator")
    judge.save_pretrained(shipped / "evaluator", notes=judge.notes)


def main() -> int:
    """Run the stages; stop at the first that fails."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("sources", nargs="+")
    parser.add_argument("--captions", required=True, help="CSV, TSV or JSON")
    parser.add_argument("--work", type=Path, default=Path("runs/starter"))
    parser.add_argument("--steps", type=int, default=6300, help="of generation training")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--ship", action="store_true", help="write src/shared/pretrained")
    options = parser.parse_args()
    for arguments in stages(options):
        print("$ python", *arguments, flush=True)
        if code := subprocess.call([sys.executable, *arguments], cwd=ROOT):
            return code
    if options.ship:
        ship(options.work)
    return 0


if __name__ == "__main__":
    sys.exit(main())
