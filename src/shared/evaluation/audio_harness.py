"""The audio branch's evaluation: does the music matter, and does the motion hold together?

Motions are made for held-out synthetic songs whose beats are known exactly. Every family of
`registry.py` is measured on them, on the same motions under another song, on frozen and untrained
ones, and on real paired motion, replication by replication.
"""

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from ..files import sha256_file
from ..model.zoo import resolve_model
from ..pipelines.song import SongGenerator
from . import manifest
from .audio_context import AudioContext, AudioSettings, Picture
from .audio_phase import right_tempo
from .audio_plots import plot_phase
from .audio_songs import TEMPI
from .engine import Bench, Progress, part_name, run_bench
from .families import DanceSample
from .grids import Grid, report_data
from .parts import Part, Parts
from .registry import AUDIO_EXTRAS, AUDIO_FAMILIES, AUDIO_ROWS
from .worst import Keeper, write_dance


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
    if folder is not None:
        manifest.claim(folder, _manifest(context, sampling or {}, about))
    parts = Parts(folder)
    bench = song_bench(context, folder)
    tables = run_bench(bench, parts, settings.replications, settings.seed, progress)
    for name, extra in AUDIO_EXTRAS.items():
        part = parts.once(name, partial(_as_part, extra, context))
        tables += [Grid.from_dict(grid) for grid in part["grids"]]
    pictures = parts.once("pictures", partial(_draw, context, folder))["pictures"]
    facts = parts.once("facts", partial(_facts, context))
    samples = parts.once(part_name(bench.name, bench.main, 0), dict).get("samples", [])
    facts = {**about, **_about_model(context), **facts}
    return report_data("audio", facts, asdict(settings), tables, samples, pictures)


def song_bench(context: AudioContext, folder: Path | None) -> Bench[DanceSample]:
    """The rows of the registry over the songs."""
    return Bench(
        "songs",
        "held-out songs",
        lambda: context.reference,
        [kind.bind(context) for kind in AUDIO_ROWS if kind.when(context)],
        AUDIO_FAMILIES,
        keep=Keeper(
            folder, "songs", context.settings.worst, AUDIO_FAMILIES, partial(_write, context)
        ),
    )


def _write(context: AudioContext, sample: DanceSample, row: int, path: Path) -> dict[str, Any]:
    """A motion of the main row and, beside it, its song."""
    sound = path.with_suffix(".flac")
    context.write_song(row, sound)
    return {**write_dance(sample, row, path), "sound": f"{path.parent.name}/{sound.name}"}


def _as_part(extra: Callable[[AudioContext], list[Grid]], context: AudioContext) -> Part:
    return {"grids": [grid.as_dict() for grid in extra(context)]}


def _draw(context: AudioContext, folder: Path | None) -> Part:
    """Phases against beats of the first songs and of each sound file, as pictures."""
    if folder is None:
        return {"pictures": []}
    shown = [*context.made(0)[: context.settings.pictures], *context.played]
    pictures = []
    for number, pair in enumerate(shown, start=1):
        name = f"phase-{number:02d}.png"
        plot_phase(Picture.of(*pair), folder / name)
        pictures.append({"file": name, "title": f"phase and beats: {pair[0].name}"})
    return {"pictures": pictures}


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


def _manifest(
    context: AudioContext, sampling: dict[str, Any], about: dict[str, Any]
) -> dict[str, Any]:
    folders = {name: about[name] for name in ("model", "decoder") if name in about}
    model = {
        f"{name}/{file}": digest
        for name, folder in folders.items()
        for file, digest in manifest.folder_hashes(resolve_model(folder)).items()
    }
    files = sorted(context.songs.rglob("*")) if context.songs is not None else []
    tracks = {path.name: sha256_file(path) for path in files if path.is_file()}
    network = context.generator.model
    return manifest.build(
        "audio",
        model=model,
        evaluator={},
        data={"pairs": context.fingerprint, "songs": tracks},
        statistics=(network.mean, network.std),
        settings=asdict(context.settings),
        sampling=sampling,
        families=AUDIO_FAMILIES,
        device=str(context.generator.device),
    )
