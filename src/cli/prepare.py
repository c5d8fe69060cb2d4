"""`prepare`: folders of motion capture become a training set."""

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from src.cli import options
from src.cli.guard import complain
from src.shared.errors import UsageError


def prepare(
    out: Annotated[Path, typer.Option(help="Folder for the training set.")],
    source: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[SOURCE]...", help="Folders of BVH files, or single files."),
    ] = None,
    captions: Annotated[
        Path | None, typer.Option(help="CSV, TSV or JSON: clip, caption, language.")
    ] = None,
    mapping: Annotated[
        Path | None, typer.Option(help="YAML that names your skeleton's joints.")
    ] = None,
    labels: Annotated[
        Path | None, typer.Option(help="YAML rules that read labels from file names.")
    ] = None,
    templates: Annotated[
        Path | None, typer.Option(help="YAML caption templates of your own.")
    ] = None,
    synthetic: Annotated[
        int, typer.Option(help="Add this many of the project's own parametric motions.")
    ] = 0,
    mirror: Annotated[
        bool, typer.Option("--mirror/--no-mirror", help="Add mirror images, captions too.")
    ] = True,
    seed: Annotated[int, typer.Option(help="Of splits, captions and synthetic motions.")] = 0,
    workers: Annotated[int | None, typer.Option(help="Processes; one a core.")] = None,
    json: options.Json = False,
) -> None:
    """Turn motion capture into a training set.

    Reads, retargets, captions, mirrors and splits; run again, it does only what is missing.

    \b
    Examples:
      motion-tools prepare my-mocap --captions captions.csv --out data/mine
      motion-tools prepare --synthetic 400 --out data/synthetic
    """
    if not source and not synthetic:
        raise UsageError("no SOURCE; name folders of BVH files, or --synthetic N, or both")
    tables = {"--captions": captions, "--mapping": mapping, "--labels": labels}
    given = [flag for flag, path in tables.items() if path is not None]
    if given and not source:
        raise UsageError(f"{given[0]} without SOURCE; name the folder of BVH files it is about")
    options.check_ranges(synthetic=synthetic, workers=workers, seed=seed)
    options.check_folder("--out", out)

    from src.shared.data.prepare import prepare as prepare_folder
    from src.shared.data.sources import BvhFolder, Source, SyntheticSource

    sources: list[Source] = [
        BvhFolder.open(root, captions=captions, labels=labels, mapping=mapping)
        for root in source or []
    ]
    if synthetic:
        sources.append(SyntheticSource(synthetic, seed))
    report = prepare_folder(
        sources,
        out,
        templates=templates,
        mirror=mirror,
        seed=seed,
        workers=workers,
        progress=show_progress,
    )
    if unmatched := report["unmatched_captions"]:
        complain(
            f"warning: {len(unmatched)} clips in {captions} match no file, e.g."
            f" {', '.join(unmatched[:3])}; {out / 'report.json'} lists them"
        )
    if json:
        print_json(report)
    else:
        print_summary(report, out)


def show_progress(done: int, total: int) -> None:
    """A counter that stays on its line in a terminal."""
    end = "\r" if sys.stderr.isatty() and done < total else "\n"
    print(f"prepare: {done} of {total} clips", end=end, file=sys.stderr, flush=True)


def print_summary(report: dict[str, Any], out: Path) -> None:
    """What was made, what was left out, and what to do next."""
    minutes = report["seconds"] / 60
    print(f"{report['clips']} clips, {minutes:.1f} minutes, {report['groups']} label groups: {out}")
    print("  by source:", ", ".join(f"{k} {v}" for k, v in report["by_source"].items()))
    print("  by split: ", ", ".join(f"{k} {v}" for k, v in report["by_split"].items()))
    if skipped := report["skipped"]:
        complain(f"{len(skipped)} clips were left out; {out / 'report.json'} says why, e.g.:")
        for entry in skipped[:3]:
            complain(f"  {entry['clip']}: {entry['reason']}")
    print(f"next: accelerate launch -m src.train.train_clip --data {out} --output runs/clip")


def print_json(report: dict[str, Any]) -> None:
    """The report alone on stdout."""
    import json

    print(json.dumps(report, indent=1, ensure_ascii=False))
