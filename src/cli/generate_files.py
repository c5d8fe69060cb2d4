"""What `generate` writes: names, files and pages, and a row of facts for each motion."""

import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.errors import UsageError
from .console import is_quiet, note_replaced, progress_bar
from .options import parts

if TYPE_CHECKING:
    from ..shared.audio.song import Song
    from ..shared.config_audio import PostProcessConfig
    from ..shared.formats.preview.trajectory import SongTrack
    from ..shared.motion.motion import Motion
    from ..shared.pipelines.body import Performance
    from ..shared.pipelines.dance import Dances
    from ..shared.pipelines.ranking import ScoreTable
    from ..shared.pipelines.song import SongMotions

FORMATS = ("bvh", "glb", "npz", "html")  # of a body, where nothing else is asked for
DANCE = "dance"  # ends the file names of a dance that no prompt asked for
SHOWN = 8  # candidates in the printed table


# ---------------------------------------------------------------- formats and names


def checked_formats(text: str, known: Mapping[str, Any]) -> list[str]:
    """The wanted formats, each once, of a table of `formats/registry.py`, before anything slow."""
    from ..shared.formats.registry import find_writer

    names = list(dict.fromkeys(parts(text.lower())))
    unknown = [name for name in names if name not in known]
    if unknown or not names:
        raise UsageError(
            f"--format {text!r}: {', '.join(map(repr, unknown)) or 'nothing'} is not a format"
            f" written here; choose from {', '.join(known)}"
        )
    for name in names:
        find_writer(known, name, "--format")  # what it needs is there
    return names


def check_path_formats(text: str) -> None:
    """Refuse formats that only a body has where only a path is made.

    Raises:
        UsageError: naming them.
    """
    from ..shared.formats.registry import EXPORTERS, TRAJECTORY_EXPORTERS

    bodies = sorted({*parts(text.lower())} & (EXPORTERS.keys() - TRAJECTORY_EXPORTERS.keys()))
    if bodies:
        raise UsageError(
            f"--format {text!r}: {' and '.join(bodies)} would hold a body, and --audio alone makes"
            ' its path; add --prompt "a person dances", or --body to let the music choose'
        )


def slug(text: str, length: int = 40) -> str:
    """A file name from text in any language: letters and digits, hyphens between.

    At most `length` characters, and twice as many bytes: a file's whole name may have 255.
    """
    text = unicodedata.normalize("NFC", text.lower())  # as composed letters, which file names part
    words = "".join(char if char.isalnum() else " " for char in text).split()
    cut = "-".join(words)[:length].encode()[: 2 * length].decode(errors="ignore")
    return cut.rstrip("-") or "motion"


def stems(prompts: Sequence[str], num_samples: int) -> list[str]:
    """One file name without ending a motion: `01-a-person-waves`, `01-a-person-waves-2`, …"""
    names = []
    for index, text in enumerate(prompts):
        base = f"{index // num_samples + 1:02d}-{slug(text)}"
        sample = index % num_samples
        names.append(f"{base}-{sample + 1}" if sample else base)
    return names


def song_stem(audio: Path) -> str:
    """What the files of a song are called: its name, made safe as a prompt is."""
    return slug(audio.stem, 60)


def dance_stems(audio: Path, prompts: Sequence[str | None], kept: int) -> list[str]:
    """`song-a-person-dances`, `song-a-person-dances-2`, …; `song-dance` without a prompt."""
    names: list[str] = []
    for prompt in prompts:
        said = DANCE if prompt is None else slug(prompt)
        base = f"{song_stem(audio)}-{said}"
        for _ in range(kept):
            name, number = base, 2
            while name in names:
                name, number = f"{base}-{number}", number + 1
            names.append(name)
    return names


# ---------------------------------------------------------------- files


def motion_files(
    prompts: Sequence[str], kept: int, formats: list[str], out: Path
) -> list[dict[str, Path]]:
    """Where motions will lie: the files of each by format, `kept` for a prompt."""
    from ..shared.formats.registry import ending

    names = stems([text for text in prompts for _ in range(kept)], kept)
    return [{name: out / f"{stem}.{ending(name)}" for name in formats} for stem in names]


def write_motions(
    motions: "Sequence[Motion]", files: Sequence[dict[str, Path]]
) -> list[dict[str, Any]]:
    """Write every motion into its files; a row of facts and paths for each."""
    from ..shared.formats.registry import write_motion

    rows: list[dict[str, Any]] = []
    with progress_bar("motions written") as progress:
        for motion, paths in zip(motions, files, strict=True):
            for path in paths.values():
                write_motion(motion, path)
            rows.append(
                {
                    "prompt": motion.text,
                    "frames": motion.num_frames,
                    "fps": motion.fps,
                    "files": named(paths),
                }
            )
            progress(len(rows), len(motions))
    return rows


def named(paths: dict[str, Path]) -> dict[str, str]:
    """As JSON has them."""
    return {name: str(path) for name, path in paths.items()}


def read_back(places: Sequence[dict[str, Path]], whole: Sequence[bool]) -> "list[Motion | None]":
    """The motions whose files are there, for the page that shows all; None for the others, and for
    those without an .npz.

    Raises:
        UserError: a file is damaged.
    """
    from ..shared.formats.arrays import read_npz

    there = zip(places, whole, strict=True)
    return [read_npz(each["npz"]) if one and "npz" in each else None for each, one in there]


def write_index(motions: "Sequence[Motion]", out: Path) -> str:
    """One page with all motions side by side; returns its path."""
    from ..shared.formats.registry import write_preview

    write_preview(motions, out / "index.html")
    return str(out / "index.html")


def write_trajectories(
    made: "SongMotions",
    kept: int,
    audio: Path,
    formats: list[str],
    out: Path,
    settings: "PostProcessConfig",
) -> tuple[list[dict[str, Any]], str | None]:
    """Write the first `kept` trajectories: a row of facts and paths for each.

    Several share one page, so that the song is in it once; its path is the second value.
    """
    from ..shared.formats.registry import export_trajectory, write_trajectory_preview
    from ..shared.motion.postprocess.trajectory import MotionPostProcessor

    first, track = song_stem(audio), _track(audio, made.song)
    names = [first, *(f"{first}-{number + 1}" for number in range(1, kept))]
    alone, page = _planned(names, formats, out)
    rows = []
    for rank, (path, raw, stem) in enumerate(
        zip(made.trajectories[:kept], made.raw[:kept], names, strict=True)
    ):
        paths = export_trajectory(path, out, stem, alone, track, title=stem)
        rows.append(
            {
                "frames": path.num_frames,
                "fps": path.fps,
                "clamped": MotionPostProcessor(settings).count_clamped(raw.data),
                "files": {name: str(path) for name, path in paths.items()},
                "sample": int(made.table.order[rank]),
                "rank": rank + 1,
            }
        )
    if page is not None:
        write_trajectory_preview(made.trajectories[:kept], page, track, names)
    return rows, None if page is None else str(page)


def write_dances(
    found: "Sequence[Dances]", kept: int, audio: Path, song: "Song", formats: list[str], out: Path
) -> tuple[list[dict[str, Any]], str | None]:
    """Write every dance that is kept: a row of facts and paths for each.

    Several share one page, so that the song is in it once; its path is the second value.
    """
    from ..shared.formats.registry import export_dance, write_dance_page

    track = _track(audio, song)
    dances = [dance for each in found for dance in each.ranked[:kept]]
    names = dance_stems(audio, [each.prompt for each in found], kept)
    alone, page = _planned(names, formats, out)
    places = [int(place) for each in found for place in each.table.order[:kept]]
    rows = []
    for at, (dance, stem, place) in enumerate(zip(dances, names, places, strict=True)):
        own = (dance.motion, dance.trajectory, out, stem, alone, track)
        paths = export_dance(*own, None if dance.error else dance.figures)
        rows.append(
            _told_of_dance(dance, song)
            | {"files": {name: str(path) for name, path in paths.items()}}
            | {"sample": place, "rank": at % kept + 1}
        )
    if page is not None:
        motions, paths_shown = zip(*((d.motion, d.trajectory) for d in dances), strict=True)
        shown = [None if d.error else d.figures for d in dances]
        write_dance_page(motions, paths_shown, page, track, shown)
    return rows, None if page is None else str(page)


def _planned(names: list[str], formats: list[str], out: Path) -> tuple[list[str], Path | None]:
    """The formats that each has a file of its own in, and the page that several share as HTML."""
    from ..shared.formats.registry import ending

    shared = "html" in formats and len(names) > 1
    alone = [name for name in formats if not (shared and name == "html")]
    page = out / "index.html" if shared else None
    files = [out / f"{stem}.{ending(name)}" for stem in names for name in alone]
    note_replaced([*files, *filter(None, [page])], out)
    return alone, page


def _track(audio: Path, song: "Song") -> "SongTrack":
    from ..shared.formats.preview.trajectory import SongTrack

    beats = song.beats
    return SongTrack(audio, beats.beat_times, beats.downbeat_times, beats.meter)


def _told_of_dance(dance: "Performance", song: "Song") -> dict[str, Any]:
    """What was asked for, how exactly the body stands on its path, how it keeps the beat."""
    from ..shared.pipelines.ranking import beat_report

    motion, beats = dance.motion, song.beats
    error = None if dance.error is None else asdict(dance.error)
    return {
        "prompt": motion.text,
        "passages": [{"text": p.text, "seconds": p.frames / motion.fps} for p in dance.passages],
        "figures": [figure.told() for figure in dance.figures],
        "frames": motion.num_frames,
        "fps": motion.fps,
        "root-error": error and {name.replace("_", "-"): v for name, v in error.items()},
        "beat-alignment": beat_report(motion, beats.beat_times) if beats.tempo > 0 else None,
    }


# ---------------------------------------------------------------- scores


def scored(about: str, table: "ScoreTable") -> dict[str, Any]:
    """What was chosen for one prompt or song, as plain values: weights, candidates best first."""
    return {"for": about, "weights": table.weights, "candidates": table.rows()}


def show_scores(selection: Sequence[dict[str, Any]]) -> None:
    """One short table a prompt or song on stderr."""
    if is_quiet():
        return
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False, markup=False)
    for chosen in selection:
        rows = chosen["candidates"]
        more = f", first {SHOWN} of {len(rows)}" if len(rows) > SHOWN else ""
        title = f"scores of {len(rows)} candidates{more}: {chosen['for']}"
        table = Table(title=title, title_justify="left", box=None, padding=(0, 1))
        for name in rows[0]:
            table.add_column(name, justify="right")
        for row in rows[:SHOWN]:
            table.add_row(*map(_cell, row.values()))
        console.print(table)


def _cell(value: float | int | None) -> str:
    if value is None:
        return "–"
    return str(value) if isinstance(value, int) else f"{value:.3f}"
