#!/usr/bin/env python3
"""Make the starter weights anew: prepare, five trainings, and the shipped folders.

    python scripts/train_starter.py SOURCE ... [--captions FILE ...] [--free] [--work DIR] [--ship]

SOURCES are folders of motion files: for `starter` bandai-namco, cmu, cmu-more, o3de-locomotion,
cc0-handmade and fair-mit, for `starter-free` (with `--free`) all but the first. The whole of CMU's
2,500 files is one folder, too: `CMU --captions cmu_index.tsv --free`. Captions come from
scripts/starter_clips.tsv, which cuts and labels takes, and from FILEs: those of CMU are its own
descriptions (scripts/cmu_captions.py). Bandai's labels are in its file names, all other words in
src/configs.

The text tower is taught from captions alone, the denoiser learns behind it, the tower reads more
captions, and a motion tower learns to meet it. Every stage resumes, and does nothing when it is
finished. `--ship` writes fp16 copies into src/shared/pretrained.
"""

import argparse
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLIPS = ROOT / "scripts" / "starter_clips.tsv"  # pieces and labels of the sources' takes
SHIPPED = ROOT / "src" / "shared" / "pretrained"
SYNTHETIC_CLIPS, SYNTHETIC_FREE = 3000, 4000  # before those that no gap needs are left out
VOCABULARY = "network.clip.text-vocab-size=8000"
TEXT = ["min-frames=40", "max-frames=150", "scale=20", "ema-decay=0.99", "babble=0.5", VOCABULARY]
MOTION = ["min-frames=40", "max-frames=180", "losses.position=2.0", "losses.foot-slide=0.1",
          "losses.root=0.5", "constraints.free=0.6", "network.generation.frames-per-token=4",
          VOCABULARY]  # fmt: skip
LICENCE = "CC BY-NC 4.0 (learned from the Bandai-Namco Research Motiondataset: non-commercial)"
FREE_LICENCE = "free for any use (learned from CMU, O3DE, CC0, MIT and synthetic clips)"
DESCRIPTION = "text to body motion; captured, hand-made and procedural clips; en es fr de ja zh"
FREE_DESCRIPTION = "text to body motion, free for any use; en es fr de ja zh"


def stages(options: argparse.Namespace) -> list[list[str]]:
    """The command of each stage, in order."""
    data, work = str(options.work / "data"), options.work
    synthetic = SYNTHETIC_FREE if options.free else SYNTHETIC_CLIPS
    text, generation = work / "text", work / "generation"
    again, clip, judge = work / "starter", work / "clip", work / "evaluator"

    def train(stage: str, output: Path, *settings: str) -> list[str]:
        shared = ["--data", data, "--output", str(output), "--resume"]
        return ["-m", f"src.train.train_{stage}", *shared, f"threads={options.threads}", *settings]

    return [
        ["-m", "src.cli.tools", "prepare", *options.sources, *options.tables,
         "--synthetic", str(synthetic), "--only-gaps", "--out", data],
        train("text", text, *TEXT, "clip=null", "batch-size=192", "steps=1500",
              "learning-rate=1.5e-3", "captions-per-group=90"),
        train("generation", generation, *MOTION, f"clip={text}", "batch-size=64",
              f"steps={options.steps}", "learning-rate=1e-3", "warmup-steps=200"),
        train("text", again, *TEXT[:-1], f"clip={text}", f"generator={generation}",
              "batch-size=160", "steps=800", "learning-rate=6e-4", "captions-per-group=110"),
        train("clip", clip, *TEXT[:2], VOCABULARY, f"text={again}", "batch-size=128", "steps=450"),
        train("evaluator", judge, "steps=1500"),
    ]  # fmt: skip


def ship(trained: Path, name: str, licence: str, description: str) -> None:
    """Write a generator, in fp16, where `from_pretrained` finds it."""
    from src.shared.model.generation.motion_generator import TextToMotion
    from src.shared.model.generation.onnx import export_text

    generator = TextToMotion.from_pretrained(trained)
    about = {"name": name, "licence": licence, "description": description}
    generator.card = generator.card.model_copy(update=about)
    generator.save_pretrained(SHIPPED / name, half=True)
    export_text(SHIPPED / name, SHIPPED / name)  # graphs belong to their weights


def ship_judge(trained: Path) -> None:
    """Write the evaluator beside it."""
    from src.shared.evaluation.judge.evaluator import Evaluator

    judge = Evaluator.from_pretrained(trained)
    judge.save_pretrained(SHIPPED / "evaluator", notes=judge.notes)


def main() -> int:
    """Run the stages; stop at the first that fails."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("sources", nargs="+")
    parser.add_argument("--captions", nargs="*", default=[], help="CSV, TSV or JSON")
    parser.add_argument("--work", type=Path, default=Path("runs/starter"))
    parser.add_argument("--steps", type=int, default=6000, help="of the denoiser")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--free", action="store_true", help="make starter-free instead")
    parser.add_argument("--ship", action="store_true", help="write src/shared/pretrained")
    options = parser.parse_args()
    tables = [str(CLIPS), *options.captions]
    options.tables = [part for table in tables for part in ("--captions", table)]
    sys.path.insert(0, str(ROOT))
    # An exit on the way of `subprocess.call` ends the stage that it started.
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    for arguments in stages(options):
        print("$ python", *arguments, flush=True)
        if code := subprocess.call([sys.executable, *arguments], cwd=ROOT):
            return code
    if options.ship and options.free:
        ship(options.work / "starter", "starter-free", FREE_LICENCE, FREE_DESCRIPTION)
    elif options.ship:
        ship(options.work / "starter", "starter", LICENCE, DESCRIPTION)
        ship_judge(options.work / "evaluator")
    return 0


if __name__ == "__main__":
    sys.exit(main())
