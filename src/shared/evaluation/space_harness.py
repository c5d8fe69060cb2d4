"""What a shared space is worth on held-out songs: retrieval, and what neighbours have in common.

Every table has a row of the space, one that knows the tempo alone, one of an untrained
tower, and one by chance, under the same batches.

Letters: N windows, P phrases, D embed dim.
"""

from collections.abc import Callable
from dataclasses import asdict, dataclass

import torch
from torch import Tensor

from ..data.phrases.dataset import MotionPhraseDataset
from ..metrics.retrieval import BATCH
from ..model.audio.shared_space import AudioTower, MotionTower, SharedSpace
from ..model.clip.core import TextTower
from ..model.clip.tokenizer import PromptTokenizer
from .metrics_space import TOP
from .report.tables import Column, Grid, GridRow, report_data
from .space_neighbours import Neighbours
from .space_retrieval import Bench
from .space_windows import Windows

TEMPO_WIDTH = 0.05  # of the kernel, in log tempo: 5%
SPACE, TEMPO, UNTRAINED, CHANCE = "shared space", "tempo alone", "untrained tower", "chance"
COLUMNS = (
    *(Column(f"r_at_{k}", f"R@{k}", 3, "high") for k in TOP),
    Column("median_rank", "median rank", 1, "low"),
)
NEAREST = (
    Column("tempo", "tempo off (octaves)", 3, "low"),
    Column("speed", "speed off (m/s)", 3, "low"),
    Column("action", "same action", 3, "high"),
)


@dataclass(frozen=True)
class SpaceSettings:
    """How much is measured: bars and frames of a window, windows of a batch, replications, seed."""

    bars: int = 2
    min_frames: int = 40
    max_frames: int = 150
    batch: int = BATCH
    replications: int = 20
    seed: int = 0


@dataclass(frozen=True)
class Texts:
    """A text tower with its tokenizer."""

    tower: TextTower
    tokenizer: PromptTokenizer


def evaluate_space(
    space: SharedSpace,
    data: str,
    *,
    split: str = "test",
    texts: Texts | None = None,
    settings: SpaceSettings | None = None,
    about: dict[str, str] | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> dict[str, object]:
    """Measure a space on one split of prepared phrases.

    Args:
        space: on the CPU.
        data: folder of `prepare-audio`, with bodies.
        split: whose songs and clips no training saw: test, or val.
        texts: measure text as well, if every phrase has a caption.
        settings: amounts and seed.
        about: what is measured with what.
        progress: told what comes next.

    Returns:
        Plain data, see `report_data`.

    Raises:
        UserError: no such phrases, no bodies, or a text tower of another space.
    """
    settings = settings or SpaceSettings()
    progress(f"reading {data}")
    held_out, train = (_windows(data, part, settings) for part in (split, "train"))
    bench = Bench.draw(
        held_out,
        batch=settings.batch,
        replications=settings.replications,
        seed=settings.seed,
    )
    progress(f"embedding {len(held_out.items)} windows of {len(held_out.records)} phrases")
    motion = held_out.embed_bodies(space.embed_motion)
    sounds = {
        SPACE: held_out.embed_sounds(space.embed_audio),
        TEMPO: tempo_alone(train, train.embed_bodies(space.embed_motion), held_out),
        UNTRAINED: held_out.embed_sounds(untrained(space, settings.seed)),
    }
    tables = [
        _table(bench, "sound → motion", sounds, {SPACE: motion}),
        _table(bench, "motion → sound", {SPACE: motion}, sounds),
    ]
    captions = [record.caption for record in held_out.records]
    if texts is not None and not all(captions):
        progress("phrases without captions: texts are left out")
    elif texts is not None:
        spoken = space.embed_text(captions, texts.tower, texts.tokenizer)
        blind = held_out.embed_bodies(untrained_motion(space, settings.seed))
        text = {SPACE: spoken[[window.phrase for window in held_out.items]]}
        tables += [
            _table(bench, "text → sound", text, sounds, by_action=True),
            _table(bench, "sound → text", sounds, text, by_action=True),
            _table(bench, "text → motion", text, {SPACE: motion, UNTRAINED: blind}, by_action=True),
        ]
    neighbours = Neighbours.of(held_out, bench)
    tables.append(_nearest(neighbours, sounds, motion))
    songs = len({record.song for record in held_out.records})
    facts = {"split": split, "phrases": len(held_out.records), "songs": songs}
    facts |= {"windows": len(held_out.items), "fingerprint": space.fingerprint}
    return report_data("space", {**(about or {}), **facts}, asdict(settings), tables, [])


def _windows(data: str, split: str, settings: SpaceSettings) -> Windows:
    return Windows.cut(
        MotionPhraseDataset(data, split=split, bodies=True, cache_in_memory=False),
        bars=settings.bars,
        min_frames=settings.min_frames,
        max_frames=settings.max_frames,
    )


def untrained(space: SharedSpace, seed: int) -> AudioTower:
    """The audio tower as its training began, but for the seed; the statistics are the same."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        tower = AudioTower(space.config)
    tower.set_statistics(space.audio.mean, space.audio.std)
    return tower.eval()


def untrained_motion(space: SharedSpace, seed: int) -> MotionTower:
    """The motion tower with random weights and the statistics of the trained one."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        tower = MotionTower(space.card.network)
    tower.mean.copy_(space.motion.mean)
    tower.std.copy_(space.motion.std)
    return tower


def tempo_alone(train: Windows, motion: Tensor, held_out: Windows) -> Tensor:
    """What motion to expect at a tempo [N,D]: Nadaraya-Watson regression on the training windows.

    Args:
        train: windows with tempi.
        motion: their keys [N',D].
        held_out: windows with tempi that are asked about.
    """
    known, asked = (
        torch.tensor([w.records[i.phrase].tempo for i in w.items]).clamp_min(1.0).log()
        for w in (train, held_out)
    )
    distance = (asked[:, None] - known[None]) / TEMPO_WIDTH
    weights = (-(distance**2) / 2).softmax(dim=1)
    return torch.nn.functional.normalize(weights @ motion - motion.mean(0), dim=1)


def _table(
    bench: Bench,
    title: str,
    query: dict[str, Tensor],
    items: dict[str, Tensor],
    *,
    by_action: bool = False,
) -> Grid:
    """One direction; the side with several rows names them."""
    rows = {}
    count, runs = len(bench.songs), len(bench.batches)
    for name in query if len(query) > 1 else items:
        asking, found = query.get(name, query[SPACE]), items.get(name, items[SPACE])
        figures = bench.measure(asking, found, by_action=by_action)
        rows[name] = GridRow({k: v.as_dict() for k, v in figures.items()}, count // runs, runs)
    chance = bench.measure(query[SPACE], items[SPACE], by_action=by_action, shuffled=True)
    rows[CHANCE] = GridRow({k: v.as_dict() for k, v in chance.items()}, count // runs, runs)
    note = "Of the same song or clip: neither right nor wrong. A real row would be 1 throughout."
    if by_action:
        note += " Nor are phrases of the same action: a caption fits them all."
    return Grid(title, title, COLUMNS, rows, note, head="keys")


def _nearest(neighbours: Neighbours, sounds: dict[str, Tensor], motion: Tensor) -> Grid:
    rows = {
        name: GridRow({k: v.as_dict() for k, v in neighbours.measure(keys, motion).items()})
        for name, keys in sounds.items()
    }
    blind = neighbours.measure(sounds[SPACE], motion, shuffled=True)
    rows[CHANCE] = GridRow({k: v.as_dict() for k, v in blind.items()})
    own = (
        "The nearest motion of another song and other clips, held against the sound's own motion,"
        " which would be the real row: 0, 0 and 1."
    )
    return Grid(
        "nearest", "what the nearest motion has in common", NEAREST, rows, own, "keys of sound"
    )
