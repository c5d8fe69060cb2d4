"""What `prepare-audio` made, in figures: alignment, warps, seams, and what was left out."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...io.arrays import load_array, load_arrays
from ...io.files import inside, load_json, write_json
from ...metrics.rhythm import motion_beats
from ...motion.trajectory import MotionTrajectory
from ...motion.window import encode_window
from .clip_library import FPS, MARGIN, ClipLibrary

WINDOW_FRAMES = 120  # TECH §6.1's target length
STD_FLOOR = 1e-4  # a row that does not vary is not blown up
RATE_EDGES = np.round(np.arange(0.85, 1.151, 0.05), 2)

Entry = dict[str, Any]


def load_trajectory(out: Path, entry: Entry) -> np.ndarray:
    """Trajectory [T,25] of a phrase."""
    return load_array(out / entry["record"]["motion"]["path"])


def load_phase(out: Path, entry: Entry) -> np.ndarray:
    """Unwrapped bars [T] of a phrase."""
    return load_arrays(out / entry["record"]["features"]["path"], ["phase"])["phase"]


def encoded_windows(out: Path, entries: Sequence[Entry]) -> Iterator[np.ndarray]:
    """Windows [25,T] of phrases, half overlapping; a shorter phrase is one window."""
    for entry in entries:
        trajectory, phase = load_trajectory(out, entry), load_phase(out, entry)
        for start in range(0, max(1, len(phase) - WINDOW_FRAMES + 1), WINDOW_FRAMES // 2):
            part = slice(start, start + WINDOW_FRAMES)
            yield encode_window(trajectory[part], phase[part])


def training_trajectories(out: Path) -> Iterator[MotionTrajectory]:
    """Every trajectory of the training split, or of all where there is none."""
    phrases = load_json(out / "manifest.json")["phrases"]
    train = [phrase for phrase in phrases if phrase["split"] == "train"] or phrases
    for phrase in train:
        yield MotionTrajectory(load_array(inside(out, phrase["motion"]["path"])))


def write_statistics(out: Path, entries: Sequence[Entry]) -> None:
    """Mean and std [25] of encoded windows over the training phrases, in statistics.json."""
    train = [entry for entry in entries if entry["record"]["split"] == "train"] or entries
    rows = np.concatenate(list(encoded_windows(out, train)), 1).astype(np.float64)  # 25 N
    std = np.maximum(rows.std(1), STD_FLOOR)
    write_json(
        out / "statistics.json",
        {
            "mean": [float(np.float32(v)) for v in rows.mean(1)],
            "std": [float(np.float32(v)) for v in std],
            "window_frames": WINDOW_FRAMES,
            "phrases": len(train),
        },
    )


def make_report(
    out: Path, entries: Sequence[Entry], left_out: Sequence[Entry], library: ClipLibrary
) -> dict[str, Any]:
    """The content of report.json."""
    splits = Counter(entry["record"]["split"] for entry in entries)
    rates = np.concatenate([entry["pair"]["warp"]["rates"] for entry in entries])
    return {
        "phrases": len(entries),
        "hours": round(sum(entry["pair"]["frames"] for entry in entries) / FPS / 3600, 3),
        "songs": len({entry["record"]["song"] for entry in entries}),
        "by_split": dict(splits),
        "hours_by_split": {
            split: round(
                sum(e["pair"]["frames"] for e in entries if e["record"]["split"] == split)
                / (FPS * 3600),
                3,
            )
            for split in splits
        },
        "alignment": {"all": _alignment(entries)}
        | {
            split: _alignment([e for e in entries if e["record"]["split"] == split])
            for split in splits
        },
        "warp": {
            "rate_percentiles": _percentiles(rates),
            "edges": RATE_EDGES.tolist(),
            "share": (np.histogram(rates, RATE_EDGES)[0] / len(rates)).round(4).tolist(),
        },
        "seams": _seams(out, entries),
        "clips": {
            "usable": len(library.clips),
            "left_out": library.left_out,
            "speed_threshold": round(library.threshold, 4),
            "usable_by_kind": library.used,
            "seconds_by_source": _seconds_by_source(entries, library),
        },
        "left_out": list(left_out),
    }


def _alignment(entries: Sequence[Entry]) -> dict[str, dict[str, float]]:
    """Mean over phrases of each direction: as recorded, warped, and by chance."""
    return {
        when: {
            way: round(
                float(np.mean([entry["pair"]["alignment"][when][way] for entry in entries])), 4
            )
            for way in ("motion_to_music", "music_to_motion")
        }
        for when in ("before", "after", "chance")
    }


def _seams(out: Path, entries: Sequence[Entry]) -> dict[str, Any]:
    """Size of the acceleration in m/s² within seams, around other motion beats, elsewhere.

    Seams lie on motion beats, where the pelvis turns from braking to pushing in any case, so the
    second of the three is what the first is to be compared with.
    """
    found: dict[str, list[np.ndarray]] = {"at_seams": [], "at_other_beats": [], "elsewhere": []}
    for entry in entries:
        trajectory = MotionTrajectory(load_trajectory(out, entry))
        size = np.linalg.norm(trajectory.acceleration, axis=1)
        seam = _near(entry["pair"]["seams"], len(size))
        beats = motion_beats(trajectory.position, FPS).times * FPS
        beat = _near(np.rint(beats).astype(int), len(size)) & ~seam
        found["at_seams"].append(size[seam])
        found["at_other_beats"].append(size[beat])
        found["elsewhere"].append(size[~seam & ~beat])
    return {"number": sum(len(entry["pair"]["seams"]) for entry in entries)} | {
        f"acceleration_{name}": _percentiles(np.concatenate(sizes)) for name, sizes in found.items()
    }


def _near(frames: Iterable[int], num_frames: int) -> np.ndarray:
    """Frames [T] bool within half a seam of any of `frames`."""
    near = np.zeros(num_frames, dtype=bool)
    for frame in frames:
        near[max(0, frame - MARGIN) : frame + MARGIN + 1] = True
    return near


def _percentiles(values: np.ndarray) -> dict[str, float]:
    """Five points of a distribution; empty without values."""
    if not len(values):
        return {}
    points = (5, 25, 50, 75, 95)
    return {
        f"p{p}": round(float(v), 4)
        for p, v in zip(points, np.percentile(values, points), strict=True)
    }


def _seconds_by_source(entries: Sequence[Entry], library: ClipLibrary) -> dict[str, float]:
    """Seconds of motion that each source of clips gave, seams counted twice."""
    source = {clip.id: clip.source for clip in library.clips}
    total: Counter[str] = Counter()
    for entry in entries:
        for piece in entry["pair"]["pieces"]:
            total[source[piece["clip"]]] += piece["last"] - piece["first"] + 1
    return {source: round(frames / FPS, 1) for source, frames in total.most_common()}
