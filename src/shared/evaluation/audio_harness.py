"""The audio branch's evaluation: does the music matter, and does the motion hold together?

Motions are made for held-out synthetic songs whose beats are known exactly. Every family of
`FAMILIES` is measured on them, on the same motions under another song, on frozen and untrained
ones, and on real paired motion, replication by replication.
"""

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from ..formats.arrays import write_trajectory_npz
from ..pipelines.song import SongGenerator
from .audio_context import AudioContext, AudioSettings, Picture
from .audio_phase import right_tempo
from .audio_plots import plot_phase
from .audio_songs import TEMPI
from .audio_tables import alignment_tables, phase_table, seam_tables, track_table
from .engine import Bench, MetricFamily, Progress, Row, Suite, run_suite
from .families_audio import BarPhase, BeatAlignment, RootKinetics, TrajectorySanity
from .manifest import Part, Parts, Sources, model_hashes, song_hashes
from .report.tables import Grid
from .samples import DanceSample

FAMILIES: tuple[MetricFamily[DanceSample], ...] = (
    BeatAlignment(),
    BarPhase(),
    TrajectorySanity(),
    RootKinetics(),
)


def evaluate_audio(
    generator: SongGenerator,
    *,
    data: str | None = None,
    songs: Path | None = None,
    settings: AudioSettings | None = None,
    sampling: dict[str, Any] | None = None,
    about: dict[str, Any] | None = None,
    folder: Path | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data.

    Args:
        generator: a trained audio branch.
        data: folder or bucket of pairs, whose test split is the real row; None = no such row.
        songs: folder of sound files to describe; None = none.
        sampling: steps, sampler, guidance_scale; left out = the model's own.
        about: what to repeat in the report; `model` and `decoder` are names or folders.
        folder: of the report: finished parts are kept there and not measured again.
        progress: told what begins.

    Raises:
        UserError: the data or a song cannot be used, or the folder holds another report.
    """
    settings, about = settings or AudioSettings(), about or {}
    context = AudioContext(
        generator, settings, data=data, songs=songs, sampling=sampling, progress=progress
    )
    tables: dict[str, Callable[[AudioContext], list[Grid]]] = {
        "phase": phase_table,
        "alignment": alignment_tables,
        "seams": seam_tables,
        "tracks": track_table,
    }
    suite = Suite(
        "audio",
        asdict(settings),
        [song_bench(context)],
        {name: partial(make, context) for name, make in tables.items()},
        {**about, **_about_model(context)},
        facts=partial(_facts, context),
        pictures=partial(_draw, context),
        sources=partial(_sources, context, sampling or {}, about),
    )
    return run_suite(suite, Parts(folder), progress)


def song_bench(context: AudioContext) -> Bench[DanceSample]:
    """The songs: real motion where there is data, chance, a frozen pose, generated, untrained."""
    return Bench(
        "songs",
        "held-out songs",
        lambda: context.reference,
        [
            Row("real", context.real, None if context.data is not None else 0, True, True),
            Row("chance", context.chance),
            Row("frozen pose", context.frozen_pose, limit=1, fixed=True),
            Row("generated", context.generated),
            Row("untrained", context.untrained, limit=context.settings.untrained),
        ],
        FAMILIES,
        write=partial(_write, context),
        worst=context.settings.worst,
    )


def _write(context: AudioContext, sample: DanceSample, row: int, path: Path) -> dict[str, Any]:
    """A motion of the main row under its song's name and, beside it, the song."""
    dance, sound = sample.dances[row], path.with_suffix(".flac")
    context.write_song(row, sound)
    write_trajectory_npz(dance.trajectory, path)
    beside = f"{path.parent.name}/{sound.name}"
    return {"title": dance.song, "meter": dance.counted, "sound": beside}


def _draw(context: AudioContext, folder: Path) -> list[dict[str, Any]]:
    """Phases against beats of the first songs and of each sound file, as pictures."""
    shown = [*context.made(0)[: context.settings.pictures], *context.played]
    pictures = []
    for number, pair in enumerate(shown, start=1):
        name = f"phase-{number:02d}.png"
        plot_phase(Picture.of(*pair), folder / name)
        pictures.append({"file": name, "title": f"phase and beats: {pair[0].name}"})
    return pictures


# ---------------------------------------------------------------- what was measured with what


def _about_model(context: AudioContext) -> dict[str, Any]:
    card, config = context.generator.model.card, context.generator.model.config
    sampled, scale = context.sampled, config.guidance_scale
    return {
        "model_hash": card.weights.sha256[:12] if card.weights else "",
        "sampler": sampled.sampler or config.diffusion.sampler,
        "steps": sampled.steps or config.diffusion.sampling_steps,
        "guidance_scale": scale if sampled.guidance_scale is None else sampled.guidance_scale,
        "window": sampled.window,
        "overlap": sampled.overlap,
        "data": context.data or "none",
    }


def _facts(context: AudioContext) -> Part:
    """What only the songs themselves tell."""
    pieces = context.pieces
    heard = sum(right_tempo(piece) for piece in pieces)
    facts: Part = {
        "songs": f"{len(pieces)} synthetic, {context.settings.song_seconds:g} s, tempi {TEMPI} BPM",
        "tempo_heard_right": f"{heard} of {len(pieces)} songs",
    }
    if context.data is not None:
        facts |= {"data_hash": context.fingerprint[:12], "test_phrases": len(context.reference)}
    return facts


def _sources(context: AudioContext, sampling: dict[str, Any], about: dict[str, Any]) -> Sources:
    folders: dict[str, str] = {name: about[name] for name in ("model", "decoder") if name in about}
    network = context.generator.model
    return Sources(
        model=model_hashes(folders),
        data={"pairs": context.fingerprint, "songs": song_hashes(context.songs)},
        statistics=(network.mean, network.std),
        sampling=sampling,
        device=str(context.generator.device),
    )
