"""The reports of `evaluate-audio` and `evaluate-sanity` as tables."""

from collections.abc import Iterator
from typing import Any

from src.shared.evaluation.report import Table, interval, number
from src.shared.validation.sanity import SEVEN

ALIGNMENT = (
    ("motion→music", "motion_to_music", 3), ("music→motion", "music_to_motion", 3), ("F", "f", 3),
    ("hits F", "hits", 3), ("distance s", "distance", 3),
)  # fmt: skip
PHASE = (
    ("beat |error|", "beat", 3), ("in seconds", "beat_seconds", 3), ("bar |error|", "bar", 3),
    ("beat offset", "beat_offset", 3), ("steadiness", "steady", 3),
)  # fmt: skip
UNITS = {"acceleration": "m/s²", "jerk": "m/s³", "angular_acceleration": "rad/s²"}
NOTES = {
    "phase": "Mean absolute circular error in cycles; guessing scores 0.25. Frames between the"
    " first and the last true beat. generated: where the tracker finds beats its phase is"
    " taken over, so the rows agree; right tempo: songs whose tempo the tracker found within 4%;"
    " own count: the same network, not held. ± is 95% over songs.",
    "alignment": "σ = 0.05 s; hits: one to one within 70 ms; distance: median to the nearest music"
    " beat. chance: the motion turned round by random times. ± is 95% over songs.",
    "above": "own song minus the row, song by song, ± 95%; * the two rows' intervals do not"
    " overlap.",
    "seams": "Ratio of quantiles at seams and elsewhere, [95% bootstrap over songs]; (null: the"
    " same marks at random places). KS: largest distance of the distributions, p from the null.",
    "tracks": "Descriptive: nobody knows these songs' beats, the tracker's stand in.",
    "sanity": "What the decoder gave, not clamped, not made coherent. seven: TECH's five checks and"
    " ruling 18's two; suite: with liveliness, roughness and bands.",
    "inside": "Share of motions between the 5th and 95th percentile of training motions; real"
    " motion itself reaches about 0.9.",
}


# ---------------------------------------------------------------- evaluate-audio


def audio_tables(report: dict[str, Any]) -> Iterator[Table]:
    """Every table of `evaluate-audio`, in reading order."""
    yield _phase(report["phase"])
    for name, part in report["alignment"].items():
        yield from _alignment(name, part)
    if "quantities" in report["seams"]:
        yield from _seams(report["seams"])
    if report["tracks"]:
        yield _tracks(report["tracks"])


def _phase(rows: dict[str, Any]) -> Table:
    cells = [
        [name, *(interval(row[key], digits) for _, key, digits in PHASE), str(row["beat"]["count"])]
        for name, row in rows.items()
    ]
    header = ["row", *(title for title, _, _ in PHASE), "N"]
    return Table("bar and beat phase, held-out songs", header, cells, NOTES["phase"])


def _alignment(name: str, part: dict[str, Any]) -> Iterator[Table]:
    size = (
        f"{part['songs']} songs; beats a second: motion {part['motion_beats']:.2f}, music"
        f" {part['music_beats']:.2f}; {part['without_beats']} motions without beats"
    )
    rows = [
        [row, *(interval(cells[key], digits) for _, key, digits in ALIGNMENT)]
        for row, cells in part["rows"].items()
    ]
    header = ["motion against", *(title for title, _, _ in ALIGNMENT)]
    yield Table(f"{name} motion on music ({size})", header, rows, NOTES["alignment"])
    rows = [
        [
            row,
            *(
                interval(cells[key], digits) + (" *" if cells[key]["apart"] else "")
                for _, key, digits in ALIGNMENT[:-1]
            ),
        ]
        for row, cells in part["above"].items()
    ]
    yield Table(f"{name} motion: its own song above", header[:-1], rows, NOTES["above"])


def _seams(seams: dict[str, Any]) -> Iterator[Table]:
    rows = []
    for name, found in seams["quantities"].items():
        ratios = [
            f"{r['value']:.3f} [{r['low']:.3f}, {r['high']:.3f}]"
            f" ({r['null_low']:.3f}–{r['null_high']:.3f})"
            for r in (found["ratio_p50"], found["ratio_p95"])
        ]
        medians = f"{found['seam_p50']:.3g} / {found['elsewhere_p50']:.3g}"
        ks = found["ks"]
        distance = f"{ks['value']:.3f} (p {ks['p']:.2f})"
        title = f"{name.replace('_', ' ')}, {UNITS[name]}"
        rows.append([title, medians, *ratios, distance])
    header = ["quantity", "median at / elsewhere", "ratio of medians", "ratio of p95", "KS"]
    size = f"{seams['seams']} seams of {seams['songs']} songs, {seams['frames']} frames"
    yield Table(f"seams ({size})", header, rows, NOTES["seams"])
    jumps = seams["jumps"]
    rows = [
        [key.replace("_", " "), f"{at:.4g}", f"{other:.4g}"]
        for key, (at, other) in ((k, v) for k, v in jumps.items() if k != "none")
    ]
    title = "jumps at seams: none" if jumps["none"] else "jumps at seams: FOUND"
    yield Table(title, ["extreme", "at seams", "elsewhere"], rows)


def _tracks(tracks: list[dict[str, Any]]) -> Table:
    rows = []
    for track in tracks:
        scores = track.get("rows", {})
        own, chance = scores.get("own song", {}), scores.get("chance", {})
        half = scores.get("half a beat later", {})
        rows.append(
            [
                track["name"][:40],
                number(track["tempo"], 1),
                str(track["meter"]),
                number(track["confidence"], 2),
                number(track.get("phase_from_tracker"), 3),
                *(number(own.get(key), 3) for key in ("motion_to_music", "music_to_motion", "f")),
                number(chance.get("f"), 3),
                number(half.get("f"), 3),
            ]
        )
    header = ["track", "BPM", "meter", "confidence", "phase off tracker", "motion→music"]
    header += ["music→motion", "F", "chance F", "half-beat F"]
    return Table("real tracks", header, rows, NOTES["tracks"])


# ---------------------------------------------------------------- evaluate-sanity


def sanity_tables(report: dict[str, Any]) -> Iterator[Table]:
    """Every table of `evaluate-sanity`, in reading order."""
    rows = report["rows"]
    cells = [
        [name, str(row["motions"]), f"{row['passed_seven']}", f"{row['passed']}"]
        + [_count(row["checks"], key) for key in (*SEVEN, "liveliness", "roughness")]
        for name, row in rows.items()
    ]
    header = ["row", "N", "seven", "suite"]
    header += [key.replace("_", " ") for key in (*SEVEN, "liveliness", "roughness")]
    yield Table("motions that pass", header, cells, NOTES["sanity"])
    if report["bands"]:
        yield _inside(report)
    yield Table("verdict", ["what must hold", "value", "holds"], list(_verdict(report["verdict"])))


def _count(checks: dict[str, Any], key: str) -> str:
    return str(checks[key]["passed"]) if key in checks else "–"


def _inside(report: dict[str, Any]) -> Table:
    names = list(report["rows"]["generated"]["inside"])
    rows = [
        ["p5 to p95", *(_band(report["bands"][name]) for name in names)],
        *(
            [name, *(number(row["inside"].get(key), 2) for key in names)]
            for name, row in report["rows"].items()
        ),
    ]
    header = ["row", *(name.replace("_", " ") for name in names)]
    return Table("motions inside the training motions' band", header, rows, NOTES["inside"])


def _band(band: dict[str, float]) -> str:
    return f"{band['low']:.3g} – {band['high']:.3g}"


def _verdict(found: dict[str, Any]) -> Iterator[list[str]]:
    seven = found["seven_checks"]
    value = f"{seven['value']:.2f} [{seven['low']:.2f}, {seven['high']:.2f}]"
    yield ["all seven checks, share of generated (≥ 0.95)", value, _holds(seven["holds"])]
    for name in ("frozen", "untrained"):
        yield [f"{name} fails", "", _holds(found[f"{name}_fails"])]
    for name, inside in found["inside"].items():
        value = f"{number(inside['mean'], 3)}; {inside['share']:.2f} of motions inside"
        yield [
            f"{name.replace('_', ' ')}: mean of generated inside p5–p95",
            value,
            _holds(inside["holds"]),
        ]


def _holds(value: bool) -> str:
    return "yes" if value else "NO"
