"""Train a profile's text branch by its recipe for so long, and write down what it learned.

python -m benchmarks.timed_training --data PREPARED --profile spark --seconds 3600
    [--work runs/timed] [--tower-steps 3000] [--write FILE.md] [key=value ...]

The tower of token pairs stands in for XLM-R, whose weights may not be at hand. A trial of TRIAL
steps tells how many fit into the time; then those are trained, from nothing. keys are of
`train generation`. Stopped, it goes on where it was. Figures: `short_runs`.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

from benchmarks.short_runs import text as figures

TRIAL = 20
TOWER = ("batch-size=512", "learning-rate=1e-2", "ema-decay=0.99", "babble=0.3", "precision=no",
         "captions-per-group=60")  # fmt: skip


def train(stage: str, output: Path, given: argparse.Namespace, *settings: str) -> None:
    """One stage by the profile's recipe; ends the program where it fails."""
    shared = ["--config", given.profile, "--data", given.data, "--output", str(output), "--resume"]
    words = [sys.executable, "-m", f"src.train.train_{stage}", *shared,
             "network.clip.text-model=pairs", *settings]  # fmt: skip
    print("$", *words[1:], file=sys.stderr, flush=True)
    if code := subprocess.call(words):
        sys.exit(code)


def logged(run: Path, *keys: str) -> list[tuple[float, ...]]:
    """These numbers of every line of a run's log that has them."""
    lines = [json.loads(line) for line in (run / "log.jsonl").read_text("utf-8").splitlines()]
    return [tuple(line[key] for key in keys) for line in lines if set(keys) <= line.keys()]


def report(given: argparse.Namespace, run: Path, lines: list[str]) -> str:
    """Markdown: how fast, how the validation loss fell, what the motions are."""
    rate = [each for (each,) in logged(run, "steps-per-second")]
    steps, losses = zip(*logged(run, "step", "validation/loss"), strict=True)
    return "\n".join(
        [
            f"# `{given.profile}`, trained for {given.seconds:g} s",
            "",
            f"`python -m benchmarks.timed_training {' '.join(sys.argv[1:])}`",
            "",
            f"{max(steps)} steps, {sum(rate) / len(rate):.3g} a second.",
            "",
            f"| step | {' | '.join(map(str, steps))} |",
            f"|---|{'---|' * len(steps)}",
            f"| validation loss | {' | '.join(f'{loss:.3f}' for loss in losses)} |",
            "",
            *(f"- {line}" for line in lines),
            "",
        ]
    )


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("settings", nargs="*", help="key=value of train generation")
    parser.add_argument("--data", required=True)
    parser.add_argument("--profile", default="spark")
    parser.add_argument("--seconds", type=float, default=3600.0)
    parser.add_argument("--tower-steps", type=int, default=3000)
    parser.add_argument("--num", type=int, default=256, help="captions that are judged")
    parser.add_argument("--work", type=Path, default=Path("runs/timed"))
    parser.add_argument("--write", type=Path, help="Markdown of it all")
    given = parser.parse_intermixed_args()
    tower, trial, run = (given.work / name for name in ("text", "trial", "generation"))
    train("text", tower, given, *TOWER, f"steps={given.tower_steps}")
    behind = (f"clip={tower}", *given.settings)
    train("generation", trial, given, *behind, f"steps={TRIAL}", "log-every=10")
    (rate,) = logged(trial, "steps-per-second")[-1]
    steps = max(TRIAL, round(given.seconds * rate))
    often = f"validate-every={max(1, steps // 8)}"
    train("generation", run, given, *behind, f"steps={steps}", "validate-first=true", often)
    told = report(given, run, list(figures(given.data, [str(run)], given.num)))
    print(told)
    if given.write:
        given.write.write_text(told, encoding="utf-8")


if __name__ == "__main__":
    main()
