"""`prepare`: folders of motion capture become a training set."""

from pathlib import Path
from typing import Annotated, Any

import typer

from ..shared.errors import UsageError
from ..shared.io.files import same_place
from . import options
from .console import complain, progress_bar, tell


def prepare(
    out: Annotated[Path, typer.Option(help="Folder for the training set.")],
    source: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[SOURCE]...",
            help="Folders of motion files (bvh, amc, glb, npz, npy), or single files.",
        ),
    ] = None,
    captions: Annotated[
        list[Path] | None,
        typer.Option(help="CSV, TSV or JSON: clip, caption; times, labels. May be repeated."),
    ] = None,
    mapping: Annotated[
        Path | None, typer.Option(help="YAML that names your skeleton's joints.")
    ] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of length in the files.")] = None,
    up: Annotated[str | None, typer.Option(help="Up axis of the files: Y, Z, -X, …")] = None,
    skeleton: Annotated[
        Path | None, typer.Option(help="ASF skeleton of AMC files; the one beside each.")
    ] = None,
    source_fps: Annotated[
        float | None, typer.Option(help="Frames a second of files that do not say.")
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
    only_gaps: Annotated[
        bool, typer.Option("--only-gaps", help="Of them only what no captured clip shows.")
    ] = False,
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
        raise UsageError("no SOURCE; name folders of motion files, or --synthetic N, or both")
    about_files = {"--captions": captions, "--mapping": mapping, "--labels": labels,
                   "--unit": unit, "--up": up, "--skeleton": skeleton,
                   "--source-fps": source_fps}  # fmt: skip
    given = [flag for flag, value in about_files.items() if value is not None]
    if given and not source:
        raise UsageError(f"{given[0]} without SOURCE; name the folder it is about")
    if only_gaps and not synthetic:
        raise UsageError("--only-gaps without --synthetic N; add it, or leave out --only-gaps")
    options.check_ranges(synthetic=synthetic, workers=workers, seed=seed, source_fps=source_fps)
    options.check_folder("--out", out)
    if any(same_place(out, root) for root in source or []):
        raise UsageError(f"--out {out} is a SOURCE, whose files it would mix with; name another")

    from ..shared.data.prepare import prepare as prepare_folder
    from ..shared.data.retarget.autodetection import axis_vector, unit_metres
    from ..shared.data.retarget.mapping import words
    from ..shared.data.sources.folders import MotionFolder, Reading, Source, SyntheticSource
    from ..shared.io.files import sole_writer

    for check, value in ((unit_metres, unit), (axis_vector, up)):
        if value is not None:
            check(value)  # before any clip is read
    reading = Reading(unit, up, skeleton, source_fps)
    folders = MotionFolder.open_all(
        source or [], captions=captions or (), labels=labels, mapping=mapping, reading=reading
    )
    for folder in folders:
        if folder.from_names and (wordless := folder.wordless()):
            example = " ".join(words(Path(wordless[0]).stem))
            complain(
                f"warning: no captions for {folder.root}: {len(wordless)} files have the words of"
                f" their names for captions, e.g. {wordless[0]}: {example!r}; give --captions"
            )
    sources: list[Source] = [*folders]
    if synthetic:
        sources.append(SyntheticSource(synthetic, seed))
    with sole_writer(out), progress_bar("clips") as progress:
        report = prepare_folder(
            sources,
            out,
            templates=templates,
            only_gaps=only_gaps,
            mirror=mirror,
            seed=seed,
            workers=workers,
            progress=progress,
        )
    if unmatched := report["unmatched_captions"]:
        tables = ", ".join(map(str, captions or []))
        complain(
            f"warning: {len(unmatched)} clips in {tables} match no file, e.g."
            f" {', '.join(unmatched[:3])}; {out / 'report.json'} lists them"
        )
    if json:
        print_json(report)
    else:
        print_summary(report, out)


def print_summary(report: dict[str, Any], out: Path) -> None:
    """What was made, what was left out, and what to do next."""
    minutes = report["seconds"] / 60
    print(f"{report['clips']} clips, {minutes:.1f} minutes, {report['groups']} label groups: {out}")
    print("  by source:", ", ".join(f"{k} {v}" for k, v in report["by_source"].items()))
    print("  by split: ", ", ".join(f"{k} {v}" for k, v in report["by_split"].items()))
    if skipped := report["skipped"]:
        tell(f"{len(skipped)} clips were left out; {out / 'report.json'} says why, e.g.:")
        for entry in skipped[:3]:
            tell(f"  {entry['clip']}: {entry['reason']}")
    print(f"next: motion-tools train clip --data {out} --output runs/clip")


def print_json(report: dict[str, Any]) -> None:
    """The report alone on stdout."""
    import json

    print(json.dumps(report, indent=1, ensure_ascii=False))
