#!/usr/bin/env python3
"""Make text-to-motion weights like the starter's: prepare, trainings, and a calibration.

    python scripts/train_starter.py SOURCE ... [--captions FILE ...] [--free] [--work DIR] [--ship]

SOURCES are folders of motion files: for `starter` bandai-namco and cmu, for `starter-free` (with
`--free`) cmu alone; cmu-more, o3de-locomotion, cc0-handmade and fair-mit add actions of a few clips
each. The whole of CMU's 2,500 files is one folder, too: `CMU --captions cmu_index.tsv --free`.
Captions come from scripts/starter_clips.tsv, which cuts and labels takes, and from FILEs: those of
CMU are its own descriptions, which scripts/cmu_captions.py makes a table of (the cmu_captions.tsv
of the model cards is its 75 rows of subjects 01 to 07, word for word). Bandai's labels are in its
file names, all other words in src/configs.

The text tower is taught from captions alone, twice: the first finds a place for each combination of
labels, the second reads hand-written sentences, too, and sends each to such a place. The denoiser
learns behind it. What it has few clips of, or moves too little in, low-rank adapters learn once
more, one after another, where the data has such clips; the last one learns actions that hardly any
capture shows, from clips that gesture_clips.py makes. The result is asked for every action so that
it warns of those that it cannot do, and a motion tower learns to meet the text tower. Every stage
resumes, and does nothing when it is finished (a --work folder of before there were gestures cannot
be gone on with). `--ship` writes int8 copies into src/shared/pretrained.
"""

import argparse
import json
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CLIPS = ROOT / "scripts" / "starter_clips.tsv"  # pieces and labels of the sources' takes
BLOWS = ROOT / "scripts" / "blow_clips.tsv"  # so that blows fall at the same times
SHIPPED = ROOT / "src" / "shared" / "pretrained"
SYNTHETIC_CLIPS, SYNTHETIC_FREE = 3000, 4000  # before those that no gap needs are left out
TEXT = ["batch-size=512", "learning-rate=1e-2", "ema-decay=0.99", "babble=0.3", "precision=no"]
MOTION = ["min-frames=40", "max-frames=180"]
DENOISER = [*MOTION, "batch-size=48", "learning-rate=1e-3", "warmup-steps=200", "ema-decay=0.998",
            "losses.position=1", "losses.foot-slide=0.1", "losses.root=0.5"]  # fmt: skip
ADAPTER = ["rank=32", "batch-size=24", "warmup-steps=50", "ema-decay=0.99", "captured-share=1",
           "balance=0.75", "min-frames=32", "max-frames=150",
           *[word for word in DENOISER if word.startswith("losses")]]  # fmt: skip
WHOLE = ["whole=true", "first-share=0.3", "losses.movement=0.05", "ema-decay=0.998"]
# What adapters learn (docs/experiments.md, sections 30, 33, 41, 44, 47, 48): prepared folder,
# actions, styles, settings.
ADAPTED = {
    "few": ("data", ("bow", "call", "respond"), (), ("steps=1500",)),
    "blows": ("blows", ("slash",), (),
              ("steps=3000", "max-frames=180", "batch-size=16", "ema-decay=0.998")),
    "strokes": ("blows", ("kick", "punch"), (), ("steps=2000", "rank=16", "batch-size=16", *WHOLE)),
    "gestures": ("data", ("raise", "wave"), ("plain",), ("steps=900", "min-clips=6")),
    "styled": ("data", ("walk",), ("angry", "childish", "chimpira", "giant", "happy", "musical",
                                   "not-confident", "proud", "sad"), ("steps=1000",)),
    "run": ("data", ("run",), ("plain",), ("steps=500",)),
    "walk": ("data", ("walk",), ("plain",), ("steps=400", "min-clips=20")),
    "masculine": ("data", ("walk",), ("masculine",), ("steps=400", "rank=8")),
    "still": ("data", ("drink", "kneel", "meditate", "push-up", "sit", "zombie"), (),
              ("steps=4000",)),
}  # fmt: skip
GESTURES = ["rank=20", "steps=3600", "tower-steps=4500", "learning-rate=2e-3", *WHOLE]
LEAST_CLIPS = 2  # of an action, to be learned
TEXT_SHARE = 0.1  # least of a text tower's steps: with fewer no style has a place of its own
LICENCE = "CC BY-NC 4.0 (learned from the Bandai-Namco Research Motiondataset: non-commercial)"
FREE_LICENCE = "free for any use (learned from CMU and synthetic clips)"
DESCRIPTION = "text to body motion; Bandai-Namco, CMU and synthetic; en es fr de ja zh"
FREE_DESCRIPTION = "text to body motion, free for any use; en es fr de ja zh"


def stages(options: argparse.Namespace) -> Iterator[list[str]]:
    """The command of each stage, in order; each is asked for when those before it are finished."""
    data, work = str(options.work / "data"), options.work
    synthetic = SYNTHETIC_FREE if options.free else SYNTHETIC_CLIPS
    places, text, starter = work / "places", work / "text", work / "starter"
    pairs = "network.clip.text-model=pairs"

    def train(stage: str, output: Path, *settings: str, folder: str = "data") -> list[str]:
        shared = ["--data", str(work / folder), "--output", str(output), "--resume"]
        share = max(options.share, TEXT_SHARE) if stage == "text" else options.share
        own = [f"threads={options.threads}", *(scaled(word, share) for word in settings)]
        return ["-m", f"src.train.train_{stage}", *shared, *own]

    def scaled(setting: str, share: float) -> str:
        key, _, value = setting.partition("=")
        counts = key in ("steps", "tower-steps")
        return f"{key}={max(1, round(int(value) * share))}" if counts else setting

    yield ["-m", "src.cli.tools", "prepare", *options.sources, *options.tables,
           "--synthetic", str(synthetic), "--only-gaps", "--out", data]  # fmt: skip
    yield train("text", places, "steps=3000", *TEXT, "clip=null", pairs, "captions-per-group=60")
    yield train("text", text, "steps=12000", *TEXT, f"clip={places}", "tower=pairs", "scale=30",
                "choice-weight=2", "captions-per-group=150", "outside=0.12")  # fmt: skip
    if files := files_of_blows(options.sources):
        yield ["-m", "src.cli.tools", "prepare", *files, "--captions", str(BLOWS),
               "--out", str(work / "blows")]  # fmt: skip
    clips = work / "gesture-clips"
    yield ["-m", "scripts.gesture_clips", str(clips)]
    yield ["-m", "src.cli.tools", "prepare", str(clips), "--captions", str(clips / "clips.tsv"),
           "--no-mirror", "--out", str(work / "gestures")]  # fmt: skip
    learned = [*adapters(work), *by_rule(work)]
    folders = [*(work / f"before-{name}" for name, *_ in learned), starter]
    yield train("generation", folders[0], f"steps={options.steps}", *DENOISER, f"clip={text}")
    for (before, after), (_, folder, own) in zip(pairwise(folders), learned, strict=True):
        yield train("action", after, f"init={before}", *ADAPTER, *own, folder=folder)
    yield ["-m", "src.cli.tools", "calibrate", "--model", str(starter), "--data", data,
           "--threads", str(options.threads)]  # fmt: skip
    yield train("clip", work / "clip", "steps=450", *MOTION, f"text={text}", pairs,
                "batch-size=128")  # fmt: skip
    yield train("evaluator", work / "evaluator", "steps=1500")


def files_of_blows(sources: Sequence[str]) -> list[str]:
    """Those of the takes in blow_clips.tsv that are there, the first of each name."""
    names = {line.partition("\t")[0] for line in BLOWS.read_text(encoding="utf-8").splitlines()}
    files = (file for source in sources for file in sorted(Path(source).rglob("*.bvh")))
    found = {file.stem: str(file) for file in reversed([*files]) if file.stem in names}
    return sorted(found.values())


def adapters(work: Path) -> Iterator[tuple[str, str, list[str]]]:
    """Name, data and settings of each adapter that there are captured or hand-made clips for."""
    for name, (folder, actions, styles, settings) in ADAPTED.items():
        least = dict(setting.split("=") for setting in settings).get("min-clips", "1")
        groups: dict[tuple[str, str, str], int] = Counter()
        for line in lines_of(work / folder / "clips.jsonl"):
            clip = json.loads(line)
            if clip["split"] == "train" and clip["provenance"] != "procedural":
                groups[clip["tag"], clip["labels"].get("style", "plain"), clip["group"]] += 1
        shown: dict[tuple[str, str], int] = Counter()
        for (action, look, _), number in groups.items():
            shown[action, look if styles else ""] += number if number >= int(least) else 0
        wanted = [(a, look) for a in actions for look in styles or ("",)]
        there = [pair for pair in wanted if shown[pair] >= LEAST_CLIPS]
        if there:
            of, looks = (dict.fromkeys(column) for column in zip(*there, strict=True))
            own = [f"styles=[{','.join(looks)}]"] if styles else []
            yield name, folder, [f"actions=[{','.join(of)}]", *own, *settings]


def by_rule(work: Path) -> Iterator[tuple[str, str, list[str]]]:
    """Likewise of clips made by rule: of actions that are new, and of those that are not."""
    known, made = (
        {json.loads(line)["tag"] for line in lines_of(work / folder / "clips.jsonl")}
        for folder in ("data", "gestures")
    )
    if made - known:
        yield "made", "gestures", GESTURES
    if made & known:
        yield "made-again", "gestures", [f"actions=[{','.join(sorted(made & known))}]", *GESTURES]


def lines_of(path: Path) -> list[str]:
    """Of a text file, none where there is no such file."""
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def calibrated(arguments: list[str]) -> bool:
    """Whether a stage is a calibration that is finished; all others see that themselves."""
    if "calibrate" not in arguments:
        return False
    scope = Path(arguments[arguments.index("--model") + 1]) / "scope.json"
    return bool(json.loads(scope.read_text(encoding="utf-8"))["reliability"])


def ship(trained: Path, name: str, licence: str, description: str) -> None:
    """Write a generator, in int8, where `from_pretrained` finds it."""
    from src.shared.model.generation.motion_generator import TextToMotion
    from src.shared.model.generation.onnx import export_text

    generator = TextToMotion.from_pretrained(trained)
    about = {"name": name, "licence": licence, "description": description}
    generator.card = generator.card.model_copy(update=about)
    if generator.scope is not None:  # 0.3 MB: captions of training are judged as others are
        generator.scope = replace(generator.scope, captions={})
    generator.save_pretrained(SHIPPED / name, int8=True)
    export_text(SHIPPED / name, SHIPPED / name)  # graphs belong to their weights


def ship_judge(trained: Path) -> None:
    """Write the evaluator beside it."""
    from src.shared.model.evaluator import Evaluator

    judge = Evaluator.from_pretrained(trained)
    judge.save_pretrained(SHIPPED / "evaluator", notes=judge.notes)


def main() -> int:
    """Run the stages; stop at the first that fails."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("sources", nargs="+")
    parser.add_argument("--captions", nargs="*", default=[], help="CSV, TSV or JSON")
    parser.add_argument("--work", type=Path, default=Path("runs/starter"))
    parser.add_argument("--steps", type=int, default=4000, help="of the denoiser")
    parser.add_argument("--share", type=float, default=1.0, help="of all steps: 0.01 is a trial")
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
        if calibrated(arguments):
            continue
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
