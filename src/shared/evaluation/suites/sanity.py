"""The sanity suite: do motions for unheard sound hold together, and move as people do? (TECH §10.2)

They are sampled as `generate --audio` samples them, and looked at before and after post-processing.
Real motion, a frozen one and an untrained network stand beside them; the last two must fail.

Letters: T frames, C rows of sound.
"""

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import UserError
from ...formats.preview.drawing import new_figure, save_figure
from ...metrics.sanity import MEASURES, SEVEN, UNITS, Bands, SanityChecker, frozen, sanity_row
from ...model.audio.audio_motion_model import AudioMotionModel
from ...motion.trajectory import MotionTrajectory
from ...pipelines.song import SongCondition, SongGenerator, finished
from ...pipelines.song_sampler import SongSampling
from ..engine import Progress
from ..samples import untrained_audio_model
from ..stats import success_rate
from ..tables import Column, Grid, GridRow, Report, number, report_data
from .songs import TEMPI, conditions_of_songs, open_split, phrases

PASS_SHARE = 0.95  # of samples, all seven checks and the whole suite
FREE = ("mean_speed", "path_rate", "turning")  # the figures that the verdict holds against bands
COLUMNS = (*SEVEN, "liveliness", "roughness")
COLOURS = {
    "generated": "tab:red", "written": "tab:orange", "real": "tab:green", "untrained": "grey",
    "frozen": "tab:blue",
}  # fmt: skip


@dataclass(frozen=True)
class SanitySettings:
    """How much is measured; the report repeats it."""

    num_samples: int = 100
    num_frames: int = 120
    num_steps: int = 20
    max_training: int = 1000  # windows behind the bands
    seed: int = 0


@dataclass(eq=False)
class SanityEvaluation:
    """The report as plain data, the motions by row, and the bands of training motions."""

    report: Report
    motions: dict[str, list[MotionTrajectory]]
    bands: Bands | None


def evaluate_sanity(
    generator: SongGenerator[AudioMotionModel],
    *,
    data: str | None = None,
    settings: SanitySettings | None = None,
    about: Mapping[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> SanityEvaluation:
    """Sample, check, compare.

    Args:
        generator: trained; its own bands count where there is no data.
        data: folder or bucket of pairs: the sound of its test split is danced to, its training
            split gives the bands, at the same number of frames. None = held-out synthetic songs.
        about: what to repeat in the report.

    Raises UserError: the data cannot be used.
    """
    settings, started = settings or SanitySettings(), time.perf_counter()
    model = generator.model
    progress("sound that training never saw")
    if data is None:
        songs = conditions_of_songs(settings.num_samples, settings.num_frames, settings.seed)
        facts: dict[str, Any] = {"sound": f"held-out synthetic songs, tempi {TEMPI} BPM"}
        real, bands = list[MotionTrajectory](), generator.bands
    else:
        songs, real, bands, facts = _from_data(data, model, settings)
    few = songs[: max(1, len(songs) // 5)]
    blind = SongGenerator(untrained_audio_model(model, settings.seed), device=str(generator.device))
    generated = sampled(generator, songs, settings, progress)
    motions = {
        "generated": generated,
        "written": [finished(motion) for motion in generated],
        "untrained": sampled(blind, few, settings, progress),
        "frozen": [frozen(motion) for motion in real or generated],
    } | ({"real": real} if real else {})
    checker = SanityChecker(bands=bands)
    rows = {name: sanity_row(name, group, checker) for name, group in motions.items()}
    said = verdict(rows, bands)
    report = report_data(
        "audio",
        {**(about or {}), "model_hash": model.card.content_hash[:12], **facts},
        asdict(settings),
        list(sanity_grids(rows, bands, said)),
        title="Sanity",
        rows=rows,
        bands=None if bands is None else {k: asdict(b) for k, b in bands.bands.items()},
        verdict=said,
        seconds=round(time.perf_counter() - started, 1),
    )
    return SanityEvaluation(report, motions, bands)


def _from_data(
    data: str, model: AudioMotionModel, settings: SanitySettings
) -> tuple[list[SongCondition], list[MotionTrajectory], Bands, dict[str, Any]]:
    """Sound and motion of test phrases, bands of training phrases, and what the hashes tell."""
    test = open_split(data, "test", settings.num_frames, settings.seed)
    train = open_split(data, "train", settings.num_frames, settings.seed)
    held_back = phrases(test, settings.num_samples, whole=True)
    if not held_back:
        raise UserError(
            f"{data}: no test phrase has {settings.num_frames} frames; ask for --num-frames fewer"
        )
    learned = phrases(train, settings.max_training, whole=True)
    bands = Bands.of(phrase.motion for phrase in learned)
    kept = "yes: the model was trained on this data's train split"
    unknown = "unknown: the model was trained on other data than this train split"
    facts = {
        "sound": f"test split of {data}",
        "held_out": kept if model.card.data == train.fingerprint else unknown,
        "test_phrases": len(held_back),
        "training_windows": len(learned),
        "data_hash": test.fingerprint[:12],
    }
    heard = list(held_back)
    for draw in range(1, math.ceil(settings.num_samples / len(held_back))):
        heard += phrases(test, len(held_back), whole=True, draw=draw)  # other windows of the same
    asked = enumerate(heard[: settings.num_samples])
    songs = [SongCondition(each.audio, each.bars, each.beats, number) for number, each in asked]
    return songs, [phrase.motion for phrase in held_back], bands, facts


def sampled(
    generator: SongGenerator[AudioMotionModel],
    songs: Sequence[SongCondition],
    settings: SanitySettings,
    progress: Progress = lambda text: None,
) -> list[MotionTrajectory]:
    """A motion for each song, each with noise of its own, as `generate` samples it."""
    sampling = SongSampling(seed=settings.seed, steps=settings.num_steps)
    made = []
    for index, song in enumerate(songs, start=1):
        progress(f"sample {index} of {len(songs)}")
        made += generator.sample(song, sampling)
    return made


def verdict(rows: Mapping[str, dict[str, Any]], bands: Bands | None) -> dict[str, Any]:
    """What must hold of `sanity_row` by name, with the bands of training motions if known.

    Returns:
        seven_checks: share of generated motions that pass all of the documents' checks, Wilson
        interval; whole_suite likewise; frozen_fails, untrained_fails: no such motion passes the
        suite; inside: for each of `FREE` the share of generated motions between p5 and p95, their
        mean, and whether that lies there.
    """
    generated = rows["generated"]
    result: dict[str, Any] = {"checks": list(SEVEN)}
    for name, key in (("seven_checks", "passed_seven"), ("whole_suite", "passed")):
        share = asdict(success_rate(generated[key], generated["motions"]))
        result[name] = share | {"holds": share["value"] >= PASS_SHARE}
    for name in ("frozen", "untrained"):
        result[f"{name}_fails"] = rows[name]["passed"] == 0
    means = {} if bands is None else {k: generated["checks"][f"band_{k}"]["mean"] for k in FREE}
    result["inside"] = {
        name: {
            "share": generated["inside"][name],
            "mean": mean,
            "holds": bands is not None and mean is not None and bands.bands[name].holds(mean),
        }
        for name, mean in means.items()
    }
    return result


def sanity_grids(
    rows: Mapping[str, dict[str, Any]], bands: Bands | None, found: Mapping[str, Any]
) -> Iterator[Grid]:
    """Every table of the report, in reading order; `found` is the verdict."""
    named = [Column(key, key.replace("_", " "), 0) for key in COLUMNS]
    columns = (Column("passed_seven", "seven", 0), Column("passed", "suite", 0), *named)
    passed = {}
    for name, row in rows.items():
        cells = {key: row["checks"][key]["passed"] for key in COLUMNS if key in row["checks"]}
        cells |= {key: row[key] for key in ("passed_seven", "passed")}
        passed[name] = GridRow(cells, row["motions"])
    yield Grid.of("motions that pass", passed, name="sanity", columns=columns)
    if bands is not None:
        known = {k: bands.bands[k] for k in rows["generated"]["inside"]}
        columns = tuple(Column(name, name.replace("_", " "), 2) for name in known)
        limits = {name: f"{band.low:.3g} – {band.high:.3g}" for name, band in known.items()}
        shares = {name: GridRow(row["inside"]) for name, row in rows.items()}
        yield Grid.of("inside", {"p5 to p95": GridRow(limits)} | shares, columns=columns)
    said = {what: GridRow({"value": value, "holds": "yes" if holds else "NO"})
            for what, value, holds in _said(found)}  # fmt: skip
    yield Grid.of("verdict", said)


def _said(found: Mapping[str, Any]) -> Iterator[tuple[str, str, bool]]:
    """The lines of the verdict."""
    for key, what in (("seven_checks", "all seven checks"), ("whole_suite", "the whole suite")):
        share = found[key]
        value = f"{share['value']:.2f} [{share['low']:.2f}, {share['high']:.2f}]"
        yield f"{what}, share of generated (≥ {PASS_SHARE})", value, share["holds"]
    for name in ("frozen", "untrained"):
        yield f"{name} fails", "", found[f"{name}_fails"]
    for name, inside in found["inside"].items():
        what = f"{name.replace('_', ' ')}: mean of generated inside p5–p95"
        value = f"{number(inside['mean'], 3)}; {inside['share']:.2f} of motions inside"
        yield what, value, inside["holds"]


def plot_bands(
    motions: Mapping[str, Sequence[MotionTrajectory]], bands: Bands | None, path: str | Path
) -> Path:
    """Every motion as a dot for each measure, over the band of training motions.
    Raises UserError: matplotlib is missing, or the file cannot be written."""
    figure = new_figure(14, 7)
    for axes, (name, measure) in zip(figure.subplots(2, 3).flat, MEASURES.items(), strict=True):
        band = bands.bands.get(name) if bands else None
        if band is not None:
            axes.axhspan(band.low, band.high, color="tab:green", alpha=0.15)
        top = band.high if band else 0.0
        for place, (row, group) in enumerate(motions.items()):
            values = np.array([measure(motion) for motion in group])
            spread = np.linspace(-0.3, 0.3, len(values))
            top = max(top, float(values.max()))
            axes.plot(place + spread, values, ".", color=COLOURS.get(row, "black"), ms=4)
        axes.set_xticks(range(len(motions)), list(motions))
        axes.set_title(f"{name.replace('_', ' ')}, {UNITS[name]}")
        axes.set_yscale("symlog", linthresh=0.1)
        axes.set_ylim(-0.01, 2 * max(top, 0.1))
    figure.suptitle("dots: motions; green: 5th to 95th percentile of training motions")
    return save_figure(figure, Path(path))
