"""`prepare` and `prepare-audio`: motion capture, and music beside it, become training sets;
`features`: what a network hears in a song."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.errors import UsageError
from ..shared.io.files import same_place
from ..shared.io.storage import Place, place
from . import options
from .console import complain, counted, print_json, progress_bar, tell

if TYPE_CHECKING:
    from ..shared.audio.song import Song
    from ..shared.data.prepared import PreparedData

CHROMA = ("fast", "cqt")
MOST_NEW = 4  # actions that are named as new to the model that ships


def prepare(
    out: Annotated[
        str, typer.Option(metavar="PATH", help="Folder or address for the training set.")
    ],
    source: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[SOURCE]...",
            help="Folders of motion files (bvh, amc, glb, fbx, npz, npy), or single files.",
        ),
    ] = None,
    captions: Annotated[
        list[Path] | None,
        typer.Option(help="CSV, TSV or JSON: clip, caption; times, labels. May be repeated."),
    ] = None,
    mapping: options.Mapping = None,
    unit: options.Unit = None,
    up: options.Up = None,
    skeleton: options.Skeleton = None,
    source_fps: options.SourceFps = None,
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
    workers: options.Workers = None,
    scheduler: options.Scheduler = None,
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
    options.check_scheduler(scheduler)
    target, roots = place(out), list(map(place, source or []))
    options.check_folder("--out", target)
    if any(same_place(target, root) for root in roots):
        raise UsageError(f"--out {out} is a SOURCE, whose files it would mix with; name another")

    from ..shared.data.prepare import prepare as prepare_folder
    from ..shared.data.retarget.autodetection import axis_vector, unit_metres
    from ..shared.data.retarget.mapping import words
    from ..shared.data.sources import MotionFolder, Reading, Source, SyntheticSource
    from ..shared.io.files import sole_writer

    for check, value in ((unit_metres, unit), (axis_vector, up)):
        if value is not None:
            check(value)  # before any clip is read
    reading = Reading(unit, up, skeleton, source_fps)
    folders = MotionFolder.open_all(
        roots, captions=captions or (), labels=labels, mapping=mapping, reading=reading
    )
    for folder in folders:
        if not folder.from_names:
            continue
        said = {file: " ".join(words(Path(file).stem)) for file in folder.wordless()}
        none = f"no captions for {folder.root}"
        remedy = "give --captions"
        if captions:
            tables = ", ".join(map(str, captions))
            none, remedy = f"{tables} names no file of {folder.root}", "mend the names in it"
        if named := [file for file, text in said.items() if text]:
            complain(
                f"warning: {none}: {counted(len(named), 'file')} get the words of their names,"
                f" e.g. {named[0]}: {said[named[0]]!r}; {remedy}"
            )
        if silent := [file for file, text in said.items() if not text]:
            complain(
                f"warning: {none}, and no words in the names of"
                f" {counted(len(silent), 'file')}, e.g. {silent[0]}, left out; {remedy}"
            )
    sources: list[Source] = [*folders]
    if synthetic:
        sources.append(SyntheticSource(synthetic, seed))
    with sole_writer(target), progress_bar("clips") as progress:
        report = prepare_folder(
            sources,
            target,
            templates=templates,
            only_gaps=only_gaps,
            mirror=mirror,
            seed=seed,
            workers=workers,
            scheduler=scheduler,
            progress=progress,
        )
    if unmatched := report["unmatched_captions"]:
        tables = ", ".join(map(str, captions or []))
        complain(
            f"warning: {len(unmatched)} clips in {tables} match no file, e.g."
            f" {', '.join(unmatched[:3])}; {target / 'report.json'} lists them"
        )
    if moved := report["held_back_now"]:
        complain(
            f"warning: {counted(len(moved), 'clip')} that earlier went into training"
            f" {'is' if len(moved) == 1 else 'are'} held back now, e.g. {moved[0]}: what was"
            " trained on the earlier set has seen them; train anew before evaluating on these"
        )
    if json:
        print_json(report)
    else:
        print_summary(report, target)


def print_summary(report: dict[str, Any], out: Place) -> None:
    """What was made, what was left out, and what to do next."""
    from ..shared.environment import TEXT_MODEL
    from ..shared.model.checkpoint import read_card, resolve_model

    minutes = report["seconds"] / 60
    print(f"{report['clips']} clips, {minutes:.1f} minutes, {report['groups']} label groups: {out}")
    print("  by source:", ", ".join(f"{k} {v}" for k, v in report["by_source"].items()))
    print("  by split: ", ", ".join(f"{k} {v}" for k, v in report["by_split"].items()))
    if skipped := report["skipped"]:
        tell(f"{len(skipped)} clips were left out; {out / 'report.json'} says why, e.g.:")
        for entry in sorted(skipped, key=lambda entry: "no caption" in entry["reason"])[:3]:
            tell(f"  {entry['clip']}: {entry['reason']}")
    print(f"next: motion-tools train clip --data {out} --output runs/clip")
    known = read_card(resolve_model(TEXT_MODEL)).tags
    new = [action for action in report["actions"] if action not in known]
    if 0 < len(new) <= MOST_NEW and all(new):
        teach = f"motion-tools train action --data {out} --init {TEXT_MODEL} --output runs/action"
        print(f"  or, to teach {' and '.join(map(repr, new))} to the model that ships: {teach}")


def prepare_audio(
    motion: Annotated[
        str, typer.Option(help="Folder or address from `prepare`, or of BVH files; or synthetic.")
    ],
    music: Annotated[
        list[str],
        typer.Option(help="Folder or address of sound files, or synthetic:N; several if you like."),
    ],
    out: Annotated[str, typer.Option(help="Folder or address for the pairs.")],
    meter: Annotated[
        int | None, typer.Option(help="Beats a bar of the recordings; else 3 or 4 is heard.")
    ] = None,
    min_seconds: Annotated[float, typer.Option(help="Shortest phrase.")] = 8.0,
    max_seconds: Annotated[float, typer.Option(help="Longest phrase.")] = 20.0,
    passes: Annotated[
        int, typer.Option(help="Go through each song so often, with other motion each time.")
    ] = 1,
    synthetic_clips: Annotated[
        bool,
        typer.Option(
            "--synthetic-clips/--no-synthetic-clips",
            help="Use the prepared folder's parametric motions too.",
        ),
    ] = False,
    seed: Annotated[int, typer.Option(help="Of every choice.")] = 0,
    workers: Annotated[int, typer.Option(help="Processes.")] = 1,
    scheduler: options.Scheduler = None,
    json: options.Json = False,
) -> None:
    """Pair motions with music so that motion beats fall on music beats.

    Clips that travel or step are joined to phrases and warped in time by at most 15%. Run again,
    it does only what is missing.

    \b
    Examples:
      motion-tools prepare-audio --motion data/mine --music my-songs --out data/pairs
      motion-tools prepare-audio --motion synthetic --music synthetic:100 --out data/pairs
    """
    options.check_scheduler(scheduler)
    if not 2.0 <= min_seconds <= max_seconds <= 120.0:
        raise UsageError(
            f"--min-seconds {min_seconds:g} and --max-seconds {max_seconds:g}: choose"
            " 2 <= min <= max <= 120"
        )
    if motion != "synthetic" and not place(motion).is_dir():
        raise UsageError(f"--motion {motion} is no folder; name one, or synthetic")
    folder = place(out)
    options.check_folder("--out", folder)

    from ..shared.data.pairing.music import open_music
    from ..shared.data.pairing.prepare_audio import PairOptions
    from ..shared.data.pairing.prepare_audio import prepare_audio as pair_all
    from ..shared.io.files import sole_writer

    sources = open_music(music, seed=seed, meter=meter)
    synthetic = synthetic_clips or motion == "synthetic"
    with sole_writer(folder):
        data = open_motion(motion, folder, workers, scheduler)
        with progress_bar("songs") as progress:
            report = pair_all(
                data,
                sources,
                folder,
                options=PairOptions(min_seconds, max_seconds, passes, synthetic, seed),
                workers=workers,
                scheduler=scheduler,
                progress=progress,
            )
        write_bands(folder)
    if json:
        print_json(report)
    else:
        print_pairs(report, folder)


def open_motion(motion: str, out: Place, workers: int, scheduler: str | None) -> "PreparedData":
    """A prepared folder; BVH files and synthetic motions are prepared beside the pairs, once."""
    from ..shared.data.prepare import open_data
    from ..shared.data.prepared import PreparedData

    if motion == "synthetic":
        return open_data(motion, out / ".motion")
    folder = place(motion)
    if (folder / "manifest.json").exists():
        return PreparedData.open(folder)

    from ..shared.data.pairing.prepare_audio import prepare_unlabelled

    tell(f"preparing the motion files of {folder} ...")
    beside = out / ".motion" / "bvh"
    return prepare_unlabelled(folder, beside, workers=workers, scheduler=scheduler)


def write_bands(out: Place) -> None:
    """What the training phrases measure, in bands.json: the sanity suite compares with it."""
    from ..shared.data.pairing.prepare_audio import training_trajectories
    from ..shared.metrics.sanity import Bands

    Bands.of(training_trajectories(out)).save(out / "bands.json")


def print_pairs(report: dict[str, Any], out: Place) -> None:
    """What was made, how well the beats meet, and what to do next."""
    print(f"{report['phrases']} phrases, {report['hours']:.2f} h, {report['songs']} songs: {out}")
    print("  by split: ", ", ".join(f"{k} {v}" for k, v in report["by_split"].items()))
    print("  beats meet (1 = always)   motion on music   music on motion")
    for when, name in (("before", "as recorded"), ("after", "paired"), ("chance", "by chance")):
        row = report["alignment"]["all"][when]
        print(f"    {name:<22} {row['motion_to_music']:>15.2f} {row['music_to_motion']:>17.2f}")
    rate = report["warp"]["rate_percentiles"]
    print(f"  playback rate: {rate['p5']:.2f} to {rate['p95']:.2f} (p5 to p95)")
    for reason, number in report["clips"]["left_out"].items():
        print(f"  {number} clips left out: {reason}")
    if left_out := report["left_out"]:
        tell(f"{len(left_out)} phrases or songs were left out; {out / 'report.json'} says why")
    print(f"next: motion-tools train audio --data {out} --output runs/audio")


def features(
    song: Annotated[Path, typer.Argument(help="A wav, flac, ogg or mp3 file.")],
    out: Annotated[Path, typer.Option(help="File for the arrays (.npz).")],
    plot: Annotated[Path | None, typer.Option(help="A picture as well (.png).")] = None,
    chroma: Annotated[str, typer.Option(help="fast; or cqt: librosa's own, many times slower.")] = (
        "fast"
    ),
    meter: Annotated[int | None, typer.Option(help="Beats a bar; else 3 or 4 by ear.")] = None,
    cache: Annotated[
        bool, typer.Option("--cache/--no-cache", help="Remember songs by their content.")
    ] = True,
    cache_dir: Annotated[Path | None, typer.Option(help="Remember them in this folder.")] = None,
    json: options.Json = False,
) -> None:
    """Extract 163 features, beats and bar phase of a song, 30 frames a second.

    \b
    Examples:
      motion-tools features song.mp3 --out song.npz --plot song.png
      motion-tools features waltz.ogg --meter 3 --out waltz.npz
    """
    if chroma not in CHROMA:
        raise UsageError(f"--chroma {chroma} is unknown; choose from {', '.join(CHROMA)}")
    check_suffix("--out", out, ".npz")
    if plot is not None:
        check_suffix("--plot", plot, ".png")
    if cache_dir is not None:
        options.check_folder("--cache-dir", cache_dir)

    from ..shared.audio.song import analyse

    keep = cache_dir if cache and cache_dir else cache
    analysed = analyse(song, meter=meter, chroma=chroma, cache=keep)  # type: ignore[arg-type]
    analysed.save(out)
    if plot is not None:
        from ..shared.formats.preview.charts import plot_features

        plot_features(analysed.arrays(), plot, title=describe_song(song, analysed))
    if json:
        print_json(song_facts(song, out, plot, analysed))
    else:
        print(describe_song(song, analysed))
        for path in filter(None, (out, plot)):
            print(path)


def check_suffix(flag: str, path: Path, suffix: str) -> None:
    """Refuse an output that is a folder, has another suffix or cannot be written.

    Raises:
        UsageError: naming the flag.
    """
    if path.suffix.lower() != suffix or path.is_dir():
        raise UsageError(f"{flag} {path} is no {suffix} file; name one")
    options.check_file(flag, path)


def describe_song(path: Path, song: "Song") -> str:
    """One line about a song."""
    beats = song.beats
    rhythm = f"{beats.tempo:.1f} BPM, {len(beats.beat_times)} beats in bars of {beats.meter}"
    if not beats.tempo:
        rhythm = "no beat"
    return f"{path.name}: {song.seconds:.2f} s, {song.num_frames} frames, {rhythm}"


def song_facts(path: Path, out: Path, plot: Path | None, song: "Song") -> dict[str, Any]:
    """The result for programs."""
    beats = song.beats
    return {
        "song": str(path),
        "sha256": song.sha256,
        "seconds": song.seconds,
        "frames": song.num_frames,
        "tempo": beats.tempo,
        "meter": beats.meter,
        "beats": len(beats.beat_times),
        "downbeats": len(beats.downbeat_times),
        "confidence": beats.confidence,
        "notes": list(song.notes),
        "out": str(out),
        "plot": str(plot) if plot else None,
    }
