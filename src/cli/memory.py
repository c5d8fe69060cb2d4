"""`memory build` and `memory query`: phrases and figures of real motion, found by song or text."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..shared.environment import TEXT_MODEL
from ..shared.errors import UsageError, printable
from ..shared.io.storage import Place, place
from . import options
from .console import complain, guarded, print_json, progress_bar, tell, with_quiet
from .generate_request import refuse_with
from .options import Command

if TYPE_CHECKING:
    from ..shared.config_audio import MemoryConfig
    from ..shared.memory.index import MemoryIndex
    from ..shared.memory.query import Hit, QueryResult
    from ..shared.model.audio.shared_space import SharedSpace

SPACE = "starter-space"
SOUND_FILES = (".wav", ".flac", ".ogg", ".mp3")
NAME_WIDTH = 48

memory = typer.Typer(
    no_args_is_help=True,
    help="A memory of motion phrases: build it, ask it.",
    rich_markup_mode=None,
)


def build(
    data: Annotated[
        str,
        typer.Argument(
            help="Folder or address that `prepare-audio` wrote; for --figures, of motion files."
        ),
    ],
    out: Annotated[str, typer.Option(help="Folder or address for the memory.")],
    figures: Annotated[
        bool, typer.Option("--figures", help="Figures to dance, from motion files without music.")
    ] = False,
    takes: Annotated[
        Path | None,
        typer.Option(help="Of --figures: CSV with file, kind, source, licence, repeat."),
    ] = None,
    space: Annotated[
        str | None,
        typer.Option(help=f"Shared space of sound and motion: a name or a folder; {SPACE}."),
    ] = None,
    split: Annotated[
        str | None, typer.Option(help="Of the data: train, val or test; train.")
    ] = None,
    bars: Annotated[int | None, typer.Option(help="Length of a phrase; 2.")] = None,
    workers: Annotated[int, typer.Option(help="Processes.")] = 1,
    scheduler: options.Scheduler = None,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Cut phrases at bars and remember how each sounds and moves.

    A memory that is up to date is left as it is; a stopped build goes on where it was.

    \b
    Examples:
      motion-tools memory build data/pairs --out data/memory
      motion-tools memory build my-dances --figures --takes takes.csv --out data/figures
    """
    options.check_scheduler(scheduler)
    target = place(out)
    options.check_folder("--out", target)
    if figures:
        refuse_with("--figures", space=space, split=split, bars=bars, scheduler=scheduler)
        remember_figures(place(data), takes, target, json=json)
        return
    refuse_with("a memory of phrases (--figures makes one of figures)", takes=takes)
    space, split = space or SPACE, split or "train"
    config = load_settings(bars=bars)

    from ..shared.device import set_threads
    from ..shared.io.files import sole_writer
    from ..shared.memory.build import build_memory
    from ..shared.model.audio.shared_space import SharedSpace

    set_threads(threads)
    loaded = SharedSpace.from_pretrained(space)
    with sole_writer(target), progress_bar("phrases") as progress:
        index = build_memory(
            data,
            loaded,
            target,
            config=config,
            split=split,
            workers=workers,
            scheduler=scheduler,
            progress=progress,
            space_name=space if not Path(space).is_dir() else str(Path(space).resolve()),
        )
    report = {
        "memory": str(target),
        "phrases": len(index),
        "songs": len(index.songs),
        "hours": round(int(index.offsets[-1]) / 30 / 3600, 4),
        "dim": index.dim,
        "left_out": index.about["left_out"],
    }
    if json:
        print_json(report)
        return
    for name, reason in index.about["left_out"].items():
        tell(f"left out {name}: {reason}")
    print(f"{len(index)} phrases of {len(index.songs)} songs, {report['hours']:.2f} h: {target}")
    print(f"next: motion-tools memory query SONG --memory {target}")


def query(
    ask: Annotated[str, typer.Argument(help="A sound file, or words.", metavar="SONG|TEXT")],
    memory: Annotated[
        str,
        typer.Option(help="Folder or address of `memory build`; figures: the shipped figures."),
    ],
    top_k: Annotated[int | None, typer.Option(help="Phrases to find; 8.")] = None,
    space: Annotated[
        str | None, typer.Option(help="Where the shared space is now; the one of the build.")
    ] = None,
    model: Annotated[str, typer.Option(help="Text model that reads the words.")] = TEXT_MODEL,
    meter: Annotated[int | None, typer.Option(help="Beats a bar; else 3 or 4 by ear.")] = None,
    threads: options.Threads = None,
    json: options.Json = False,
) -> None:
    """Find phrases that fit a song, bar by bar, or that move as words say; or figures likewise.

    \b
    Examples:
      motion-tools memory query song.mp3 --memory data/memory
      motion-tools memory query "a person runs" --memory data/memory --top-k 5
    """
    if not ask.strip():
        raise UsageError("the question is empty; name a sound file or give words")
    is_song = os.path.isfile(ask)  # a sentence may be too long for `Path.is_file`
    if not is_song and Path(ask).suffix.lower() in SOUND_FILES:
        raise UsageError(f"{ask}: no such file; name a sound file, or give words")

    if is_song:
        from ..shared.audio.sound import check_sound

        check_sound(ask)

    from ..shared.device import set_threads
    from ..shared.memory.figures import SHIPPED, is_figure_memory

    set_threads(threads)
    folder = SHIPPED if memory == "figures" and not Path(memory).exists() else place(memory)
    if is_figure_memory(folder):
        query_figures(ask, folder, is_song=is_song, top_k=top_k or 8, meter=meter, json=json)
        return
    from ..shared.pipelines.song_memory import open_memory

    index, loaded = open_memory(folder, space or "")
    config = load_settings(top_k=top_k, bars=index.about["bars"])
    if is_song:
        results = results_of_song(Path(ask), index, loaded, config, meter)
    else:
        results = [result_of_text(ask, index, loaded, config, model)]
    if json:
        told = {
            "query": ask,
            "kind": "song" if is_song else "text",
            "memory": str(folder),
            "answers": [result.to_json() for result in results],
        }
        print_json(told)
    elif is_song:
        print_song(results)
    else:
        print(f"confidence {results[0].confidence:.2f}")
        print_hits(results[0].hits)


def remember_figures(data: Place, table: Path | None, out: Place, *, json: bool) -> None:
    """Build and write a memory of figures.

    Raises:
        UserError: as `build_figures`.
    """
    from ..shared.io.files import sole_writer
    from ..shared.memory.build import build_figures, every_file, read_takes

    if not data.is_dir():
        raise UsageError(f"{data} is no folder; name one of motion files")
    rows = every_file(data) if table is None else read_takes(table, data)
    with sole_writer(out), progress_bar("takes") as progress:
        memory, left_out = build_figures(rows, progress=progress)
        memory.save(out)
    seconds = float(memory.offsets[-1]) / 30
    found = {"memory": str(out), "takes": len(memory.takes), "seconds": round(seconds, 1)}
    found |= {"figures": len(memory.figures(8)), "left_out": left_out}
    if json:
        print_json(found)
        return
    for name, reason in left_out.items():
        tell(f"left out {name}: {reason}")
    print(f"{found['takes']} takes, {seconds:.0f} s, {found['figures']} figures of eight: {out}")
    print(f"next: motion-tools memory query SONG --memory {out}")


def query_figures(
    ask: str, folder: Place, *, is_song: bool, top_k: int, meter: int | None, json: bool
) -> None:
    """The figures that a song is danced in, or those of a kind that words ask for."""
    from ..shared.memory.figures import FigureMemory
    from ..shared.pipelines.choreography import Choreographer, Wish
    from ..shared.pipelines.figure_dance import listed, told

    choreographer = Choreographer(FigureMemory.open(folder))
    if is_song:
        from ..shared.audio.song import analyse
        from ..shared.pipelines.song import SongCondition

        slots = SongCondition.of(analyse(ask, meter=meter)).slots()
        chosen = choreographer.choose(slots, Wish(), 0) if slots else None
        rows = [] if chosen is None else [d.told() for d in told(choreographer, slots, chosen)]
    else:
        from ..shared.pipelines.choreography import wish_of

        wish = wish_of(ask, choreographer.kinds)
        rows = [] if wish is None else listed(choreographer, wish)[:top_k]
    if json:
        print_json({"query": ask, "memory": str(folder), "figures": rows})
        return
    if not rows:
        kinds = ", ".join(sorted(choreographer.kinds))
        tell(f"no figure shows {ask!r}; there are: {kinds}")
    for row in rows:
        print("  ".join(f"{name} {value}" for name, value in row.items()))


for command in (build, query):
    memory.command(cls=Command)(with_quiet(guarded(command)))


def load_settings(**given: Any) -> "MemoryConfig":
    """memory.yaml with the command line's values on top.

    Raises:
        UsageError: a value out of range.
    """
    from ..shared.config_audio import MemoryConfig
    from ..shared.config_loader import load_config, load_yaml, packaged_config

    path = packaged_config("memory.yaml")
    overrides = [f"{name}={value}" for name, value in given.items() if value is not None]
    return load_config(MemoryConfig, load_yaml(path), str(path), overrides)


def results_of_song(
    path: Path,
    index: "MemoryIndex",
    space: "SharedSpace",
    config: "MemoryConfig",
    meter: int | None,
) -> list["QueryResult"]:
    """The phrases for each bar of a song."""
    from ..shared.audio.song import analyse
    from ..shared.memory.query import query_song
    from ..shared.pipelines.song import song_condition

    condition, phase = song_condition(analyse(path, meter=meter), None)
    if phase is None:
        tell(f"{path.name}: no beat was heard; asking every 2 s")
    return query_song(index, space, condition, phase, config=config)


def result_of_text(
    text: str, index: "MemoryIndex", space: "SharedSpace", config: "MemoryConfig", model: str
) -> "QueryResult":
    """Read the words with the text model's tower, then search."""
    from ..shared.memory.query import query_text
    from ..shared.model.generation.motion_generator import TextToMotion

    generator = TextToMotion.from_pretrained(model, device="cpu")
    for warning in filter(None, generator.scope_warnings([text])):
        complain(f"warning: {warning}")
    embedding = space.embed_text([text], generator.text, generator.tokenizer)
    return query_text(index, embedding, config=config)


def print_song(results: list["QueryResult"]) -> None:
    """A line a bar with its best phrase."""
    print("  bar   seconds      conf  score   BPM   m/s  phrase")
    for result in results:
        best = result.hits[0]
        print(
            f"{result.bar:>5}  {result.start:>5.1f}-{result.stop:<5.1f}  {result.confidence:>5.2f}"
            f"  {best.score:>5.2f}  {best.tempo:>4.0f}  {best.speed:>4.2f}  {name_of(best)}"
        )


def print_hits(hits: list["Hit"]) -> None:
    """A line a phrase."""
    print("rank  score   BPM   m/s  energy  density  tension  stability  phrase")
    for hit in hits:
        print(
            f"{hit.rank:>4}  {hit.score:>5.2f}  {hit.tempo:>4.0f}  {hit.speed:>4.2f}"
            f"  {hit.energy:>6.2f}  {hit.density:>7.2f}  {hit.tension:>7.2f}"
            f"  {hit.stability:>9.2f}  {name_of(hit)}"
        )


def name_of(hit: "Hit") -> str:
    """What a phrase shows: its caption, else its clip; and its id."""
    shown = printable(hit.caption or Path(hit.clip).name)  # "~mirrored" may follow its suffix
    return f"{shown[:NAME_WIDTH]} [{hit.phrase}]" if shown else hit.phrase
