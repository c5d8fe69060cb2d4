"""`evaluate-…`: the suites of `evaluate` that have flags of their own, a command each."""

from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer

from ..shared.errors import UsageError
from . import options
from .console import check_range, tell, told
from .evaluate import MODEL, given, keep_and_show, load_generator, show_report


def check_report(out: Path | None) -> None:
    """Refuse a report file that cannot be written, before anything slow starts."""
    if out is not None:
        options.check_folder("--out", out.parent)


def set_threads(threads: int | None) -> None:
    """torch's CPU threads; it is imported here, not for `--help`."""
    from ..shared.device import set_threads

    set_threads(threads)


# ---------------------------------------------------------------- memory

Number = TypeVar("Number", int, float)


def evaluate_memory(
    model: Annotated[str, typer.Option(help="Folder of train_memory, or a shipped name.")],
    memory: Annotated[str, typer.Option(help="Folder or address that `memory build` wrote.")],
    data: Annotated[
        str, typer.Option(help="Folder or bucket of pairs, held back from training in part.")
    ],
    splits: Annotated[str, typer.Option(help="Its held-back splits, with commas.")] = "test,val",
    space: Annotated[
        str, typer.Option(help="Where the memory's shared space is now, if it moved.")
    ] = "",
    num_phrases: Annotated[int, typer.Option(help="Held-back phrases, at most.")] = 120,
    num_songs: Annotated[int, typer.Option(help="Held-out synthetic songs.")] = 24,
    song_seconds: Annotated[float, typer.Option(help="Of each of them.")] = 12.0,
    shares: Annotated[
        str, typer.Option(help="Smaller memories: shares of the songs, with commas.")
    ] = "0.1,0.3",
    top_k: Annotated[str, typer.Option(help="Other numbers of hits, with commas.")] = "1,32",
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of songs, noise and what is hidden.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: options.ReportFile = None,
    json: options.Json = False,
) -> None:
    """Measure a model with its memory, without it, and with randomly retrieved memory.

    \b
    Example:
      motion-tools evaluate-memory --model runs/memory-audio --memory data/memory --data data/pairs
    """
    sampling = {"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale}
    options.check_pairs(data)
    found_shares = numbers("--shares", shares, float)
    if not all(0 < share <= 1 for share in found_shares):
        raise UsageError(f"--shares {shares}: each must lie between 0 and 1")
    top_ks = numbers("--top-k", top_k, int)
    if not all(k >= 1 for k in top_ks):
        raise UsageError(f"--top-k {top_k}: each must be 1 or more")
    check_report(out)

    from ..shared.evaluation.suites import memory as suite
    from ..shared.pipelines.runtime import load_trained
    from ..shared.pipelines.song_memory import open_memory, require_memory
    from .memory import load_settings

    set_threads(threads)
    loaded = load_trained(model, device)
    require_memory(loaded.config, model)
    index, found_space = open_memory(memory, space)
    report = suite.evaluate_memory(
        loaded,
        index,
        found_space,
        data=data,
        config=load_settings(folder=memory),
        settings=suite.MemorySettings(
            splits=tuple(splits.split(",")),
            shares=found_shares,
            top_ks=top_ks,
            num_phrases=num_phrases,
            num_songs=num_songs,
            song_seconds=song_seconds,
            seed=seed,
        ),
        sampling=sampling,
        about={"model": model, "data": data, "threads": threads},
        progress=told("evaluate-memory"),
    )
    keep_and_show(report, *filter(None, [out]), json=json)


def numbers(flag: str, text: str, kind: type[Number]) -> tuple[Number, ...]:
    """Numbers with commas between them; none for an empty text.

    Raises:
        UsageError: one is no number.
    """
    try:
        return tuple(map(kind, options.parts(text)))
    except ValueError as error:
        raise UsageError(f"{flag} {text}: give numbers with commas between them") from error


# ---------------------------------------------------------------- performer

QUICK_DANCES = {"num_songs": 4, "replications": 1, "style_songs": 2, "edits": 6}


def evaluate_performer(
    model: options.Model = "starter",
    audio_model: Annotated[
        str, typer.Option(help="What makes the paths: a name, or a folder from training.")
    ] = "starter-audio",
    other: Annotated[
        str | None, typer.Option(help="Another text model, for a row of its own.")
    ] = None,
    data: options.Pairs = None,
    clips: Annotated[
        str, typer.Option(help="What editing is measured on: a prepared folder, or synthetic.")
    ] = "synthetic",
    dances: Annotated[
        Path | None, typer.Option(help="Folder of captured dances, for the real row.")
    ] = None,
    songs: options.Songs = None,
    evaluator: options.Judge = "evaluator",
    out: Annotated[Path, typer.Option(help="Folder of the report. Begun ones go on.")] = Path(
        "outputs/performer"
    ),
    quick: options.Quick = False,
    replications: options.Replications = None,
    num_songs: Annotated[int | None, typer.Option(help="Held-out synthetic songs; 20.")] = None,
    song_seconds: Annotated[float, typer.Option(help="Of each synthetic song.")] = 16.0,
    track_seconds: Annotated[float, typer.Option(help="Of each sound file, at most.")] = 16.0,
    style_songs: Annotated[
        int | None, typer.Option(help="Songs danced to different prompts; 8.")
    ] = None,
    edits: Annotated[
        int | None, typer.Option(help="Clips that are edited; 24. 0 = no editing.")
    ] = None,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: options.Seed = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Measure whole-body dances and edited motions: beats, prompts, paths, feet, seams.

    Beside every figure: real dances, another song, a frozen pose, a dance that is pinned to the
    song's path, the path alone, an untrained network. With --quick: 4 songs, one replication.

    \b
    Example:
      motion-tools evaluate-performer --data data/pairs --clips data/mine --songs music
    """
    amount = (QUICK_DANCES if quick else {}) | given(
        num_songs=num_songs, replications=replications, style_songs=style_songs, edits=edits
    )
    options.check_pairs(data)
    options.check_songs(songs)
    if dances is not None and not dances.is_dir():
        raise UsageError(f"--dances {dances} is no folder; name one of captured dances")
    if amount.get("edits") != 0:
        options.check_data(clips)
    options.check_folder("--out", out)

    from ..shared.evaluation.pages import save_report
    from ..shared.evaluation.samples import open_held_out
    from ..shared.evaluation.suites import dance
    from ..shared.evaluation.suites.editing import EditContext, EditSettings
    from ..shared.io.files import sole_writer
    from ..shared.model.evaluator import Evaluator
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.body import PerformerSettings
    from ..shared.pipelines.song import SongGenerator

    set_threads(threads)
    with sole_writer(out):
        judge = Evaluator.from_pretrained(evaluator)
        generator = TextToMotion.from_pretrained(model, device=device)
        settings = dance.DanceSettings(
            song_seconds=song_seconds, track_seconds=track_seconds, seed=seed, **amount
        )
        context = dance.DanceContext(
            generator,
            SongGenerator.from_pretrained(audio_model, device=device),
            judge,
            settings,
            data=data,
            dances=dances,
            songs=songs,
            other=TextToMotion.from_pretrained(other, device=device) if other else None,
            sampling=PerformerSettings(steps=steps, sampler=sampler, guidance_scale=guidance_scale),
            progress=told("evaluate-performer"),
        )
        editing = None
        if settings.edits:
            editing = EditContext(
                generator,
                open_held_out(clips, Path("runs"), judge.trained_groups),
                EditSettings(settings.edits, untrained=settings.untrained, seed=seed),
                progress=told("evaluate-performer"),
            )
        about = {"model": model, "audio_model": audio_model, "other": other, "evaluator": evaluator}
        report = dance.evaluate_performer(context, editing, about=about, folder=out)
        save_report(report, out)
    tell(str(out / "report.html"))
    show_report(report, json=json)


# ---------------------------------------------------------------- requests


def evaluate_requests(
    data: Annotated[Path, typer.Option(help="Folder written by `prepare`, with captured clips.")],
    model: options.Model = "starter",
    wordings: Annotated[int, typer.Option(help="Sentences of each action, side and language.")] = 3,
    languages: Annotated[str, typer.Option(help="Codes, with commas.")] = "en,es,fr,de,ja,zh",
    seconds: Annotated[float, typer.Option(help="Length of each motion.")] = 4.0,
    out: Annotated[Path, typer.Option(help="Folder for requests.json and requests.md.")] = Path(
        "outputs/requests"
    ),
    steps: options.Steps = None,
    seed: Annotated[int, typer.Option(help="Of sampling, and of the sentences drawn.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Hand-written sentences in, captured motion as the measure.

    Obedience by action and language, distance from captured clips, counts, angles, lengths, sides,
    sequences, styles, and whether what goes wrong is warned of. Beside it: held-out captured
    clips, procedural ones, a frozen pose and an untrained network.

    \b
    Example:
      motion-tools evaluate-requests --model starter --data data/prepared
    """
    from ..shared.evaluation.suites.text import LANGUAGES

    check_range("seconds", seconds, 1, 20)
    codes = tuple(options.parts(languages))
    if unknown := sorted(set(codes) - set(LANGUAGES)):
        raise UsageError(f"--languages {unknown[0]} is unknown; choose from {', '.join(LANGUAGES)}")
    options.check_folder("--out", out)

    from ..shared.data.prepared import PreparedData
    from ..shared.evaluation.samples import untrained
    from ..shared.evaluation.suites.requests import evaluate_requests
    from ..shared.evaluation.suites.yardstick import RequestSettings
    from ..shared.model.generation.motion_generator import TextToMotion
    from ..shared.pipelines.text import SentenceGenerator

    set_threads(threads)
    generator = TextToMotion.from_pretrained(model, device="cpu")
    settings = RequestSettings(
        wordings=wordings, languages=codes, seconds=seconds, seed=seed, steps=steps
    )
    report = evaluate_requests(
        SentenceGenerator(generator),
        PreparedData.open(data),
        floors={"untrained": untrained(generator, seed)},
        settings=settings,
        about={"model": model, "data": str(data)},
        progress=told("evaluate-requests"),
    )
    report["title"] = f"What people ask of {model}"
    keep_and_show(report, out / "requests.json", out / "requests.md", json=json)


# ---------------------------------------------------------------- sanity

FULL_SANITY = {"num_samples": 100, "num_frames": 120, "num_steps": 20}
QUICK_SANITY = {"num_samples": 20, "num_frames": 120, "num_steps": 10}


def evaluate_sanity(
    quick: Annotated[bool, typer.Option("--quick", help="20 samples of 10 steps.")] = False,
    num_samples: Annotated[int | None, typer.Option(help="Motions; 100.")] = None,
    num_frames: Annotated[
        int | None, typer.Option(help="Frames of each, 30 a second; 120.")
    ] = None,
    num_steps: Annotated[int | None, typer.Option(help="Sampling steps; 20.")] = None,
    model: options.AudioModel = MODEL,
    decoder_checkpoint: options.Decoder = None,
    data: options.Pairs = None,
    output_dir: options.OutputDir = Path("outputs/sanity"),
    seed: Annotated[int, typer.Option(help="Of songs, phrases and noise.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Check motions made for sound that training never saw: seven checks, and the real bands.

    They are sampled as `generate` samples them. Real motion, a frozen one and an untrained model
    stand beside them; the last two must fail. Without --data the sound is synthetic songs with
    tempi that no training song has, and real motion is missing.

    \b
    Example:
      motion-tools evaluate-sanity --quick --model starter-audio --data data/pairs
    """
    amount = (QUICK_SANITY if quick else FULL_SANITY) | given(
        num_samples=num_samples, num_frames=num_frames, num_steps=num_steps
    )
    options.check_pairs(data)
    options.check_folder("--output-dir", output_dir)

    from ..shared.evaluation.suites import sanity
    from ..shared.formats.preview.charts import plot_trajectory
    from ..shared.metrics.sanity import SanityThresholds

    set_threads(threads)
    result = sanity.evaluate_sanity(
        load_generator(model, decoder_checkpoint, device),
        data=data,
        settings=sanity.SanitySettings(seed=seed, **amount),
        about={"model": model, "decoder": decoder_checkpoint or model},
        progress=told("evaluate-sanity"),
    )
    files = [output_dir / name for name in ("sanity.json", "sanity.md")]
    keep_and_show(result.report, *files, json=json)
    sanity.plot_bands(result.motions, result.bands, output_dir / "bands.png")
    first = result.motions["generated"][0]
    picture, bound = output_dir / "trajectory.png", SanityThresholds().max_jerk
    plot_trajectory(first, picture, max_jerk=bound, title="generated, sample 1")


# ---------------------------------------------------------------- selection

SYNTHETIC = "synthetic"
MODELS = {"text": "starter", "audio": "starter-audio"}


def evaluate_selection(
    branch: Annotated[str, typer.Option(help="text, or audio.")] = "text",
    model: Annotated[str | None, typer.Option(help=options.NAMED)] = None,
    judge: Annotated[
        str | None, typer.Option(help="Text: a folder of train_clip; starter has its own.")
    ] = None,
    data: Annotated[
        str, typer.Option(help="Text: a prepared folder; audio: pairs, for the real row.")
    ] = SYNTHETIC,
    evaluator: Annotated[
        str, typer.Option(help="Text: a shipped name, or a folder from train_evaluator.")
    ] = "evaluator",
    num_subjects: Annotated[int | None, typer.Option(help="Prompts (64) or songs (24).")] = None,
    num_candidates: Annotated[int, typer.Option(help="To choose from, N.")] = 8,
    replications: Annotated[
        int | None, typer.Option(help="Times N motions of each, for intervals; 4, songs 2.")
    ] = None,
    unseen: Annotated[
        bool, typer.Option("--unseen", help="Text: label combinations that no training saw.")
    ] = False,
    steps: options.Steps = None,
    sampler: options.Sampler = None,
    guidance_scale: options.GuidanceScale = None,
    seed: Annotated[int, typer.Option(help="Of prompts or songs, noise and resampling.")] = 0,
    device: options.Device = "auto",
    threads: options.Threads = None,
    out: options.ReportFile = None,
    json: options.Json = False,
) -> None:
    """Measure the best of 1, 2, 4, … N candidates by figures that choose nothing themselves.

    \b
    Examples:
      motion-tools evaluate-selection --model starter --data data/mine
      motion-tools evaluate-selection --branch audio --data data/pairs
    """
    if branch not in MODELS:
        raise UsageError(f"--branch {branch} is unknown; choose from {', '.join(MODELS)}")
    check_report(out)
    wanted: dict[str, Any] = {"steps": steps, "sampler": sampler, "guidance_scale": guidance_scale}
    wanted |= {"device": device, "progress": told("evaluate-selection")}
    amount = given(num_candidates=num_candidates, replications=replications, seed=seed)
    model = model or MODELS[branch]

    set_threads(threads)
    report: dict[str, Any]
    if branch == "text":
        options.check_data(data)
        from ..shared.evaluation.suites.selection import PromptSettings, evaluate_prompts

        split = "unseen" if unseen else "seen"
        prompts = PromptSettings(**given(num_prompts=num_subjects), **amount, split=split)
        report = evaluate_prompts(
            model, data, judge=judge, evaluator=evaluator, settings=prompts, **wanted
        )
    else:
        if judge is not None or unseen:
            raise UsageError("--judge and --unseen go with --branch text; leave them out")
        if data != SYNTHETIC:
            options.check_pairs(data)
        from ..shared.evaluation.suites.selection import SongSettings, evaluate_songs
        from ..shared.pipelines.song import shipped_bands

        songs = SongSettings(**given(num_songs=num_subjects), **amount)
        pairs, bands = None if data == SYNTHETIC else data, shipped_bands(model)
        report = evaluate_songs(model, pairs, bands=bands, settings=songs, **wanted)
    keep_and_show(report, *filter(None, [out]), json=json)


# ---------------------------------------------------------------- space

SPACE, TEXT, NO_TEXT = "starter-space", "starter", "none"
SPLITS = ("test", "val")
RUNS, QUICK_RUNS = 20, 3


def evaluate_space(
    data: Annotated[str, typer.Option(help="Pairs from `prepare-audio`, a folder or bucket.")],
    model: Annotated[
        str, typer.Option(help="A name that `models` lists, or a folder from train_audio_tower.")
    ] = SPACE,
    text: Annotated[
        str, typer.Option(help="Text generator of the same CLIP model; none leaves texts out.")
    ] = TEXT,
    split: Annotated[str, typer.Option(help="test, or val.")] = "test",
    bars: Annotated[int, typer.Option(help="Bars of a window.")] = 2,
    batch: Annotated[int, typer.Option(help="Windows to choose from.")] = 32,
    replications: Annotated[int | None, typer.Option(help="Drawings of batches; 20.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="3 drawings, for a first look.")] = False,
    out: Annotated[Path, typer.Option(help="Folder for space.json and space.md.")] = Path(
        "outputs/space"
    ),
    seed: Annotated[int, typer.Option(help="Of batches, windows and resampling.")] = 0,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Retrieval between sound, motion and text on songs and clips that no training saw.

    Beside every figure: what the tempo alone gives, an untrained tower, and chance.

    \b
    Example:
      motion-tools evaluate-space --model starter-space --data data/pairs
    """
    runs = replications or (QUICK_RUNS if quick else RUNS)
    check_range("bars", bars, 1, 16)
    check_range("batch", batch, 2, 1000)
    if split not in SPLITS:
        raise UsageError(f"--split {split} is unknown; choose from {', '.join(SPLITS)}")
    options.check_pairs(data)
    options.check_folder("--out", out)

    from ..shared.evaluation.suites.space import SpaceSettings, evaluate_space
    from ..shared.model.audio.shared_space import SharedSpace
    from ..shared.model.generation.motion_generator import TextToMotion

    set_threads(threads)
    space = SharedSpace.from_pretrained(model)
    texts = None
    if text != NO_TEXT:
        generator = TextToMotion.from_pretrained(text, device="cpu")
        texts = generator.text, generator.tokenizer
    report = evaluate_space(
        space,
        data,
        split=split,
        texts=texts,
        settings=SpaceSettings(bars=bars, batch=batch, replications=runs, seed=seed),
        about={"model": model, "data": data, "text": text},
        progress=told("evaluate-space"),
    )
    report["title"] = f"Shared space of {model}"
    keep_and_show(report, out / "space.json", out / "space.md", json=json)
