"""The suite of a shared space: retrieval on held-out songs, and what neighbours have in common.

Every table has a row of the space, one that knows the tempo alone, one of an untrained tower, and
one by chance, under the same batches, which hold each phrase once. A window is a few bars of a
phrase: sound, and the body that moves to it.

Letters: N or B windows, P phrases, M windows of a batch, Q queries, C = 167 rows of sound,
T frames, D embed dim.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import torch
from torch import Tensor

from ...data.phrases.dataset import MotionPhraseDataset
from ...data.phrases.layout import PhraseRecord
from ...memory.build import cut_at_bars
from ...metrics.retrieval import BATCH, Ranks, batches, best_ranks
from ...model.audio import BEAT, with_phase_rows
from ...model.audio.shared_space import SharedSpace
from ...model.clip.core import TextTower
from ...model.clip.tokenizer import PromptTokenizer
from ...model.evaluator import padded
from ...motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE
from ..engine import Progress
from ..samples import rows_of_each, untrained_tower
from ..stats import Estimate
from ..tables import Grid, GridRow, Report, report_data
from .songs import song_of

Embed = Callable[[Tensor, Tensor], Tensor]
EMBEDDED = 64  # windows at a time


@dataclass(frozen=True, eq=False)
class Window:
    """A few bars of a phrase."""

    phrase: int  # its number in `Windows.records`
    audio: np.ndarray  # condition [167,T] float32
    body: np.ndarray  # raw features [T,23,6] float16

    @property
    def num_frames(self) -> int:
        """T."""
        return len(self.body)


@dataclass(frozen=True, eq=False)
class Windows:
    """All windows of a split, by phrase."""

    items: list[Window]
    records: list[PhraseRecord]  # the phrases they are cut from
    of_phrase: list[list[int]]  # numbers of each phrase's windows

    @classmethod
    def cut(
        cls,
        dataset: MotionPhraseDataset,
        *,
        bars: int,
        step: int | None = None,
        min_frames: int,
        max_frames: int,
        rates: Callable[[int], Sequence[float]] = lambda number: (1.0,),
    ) -> "Windows":
        """Cut every good phrase of a data set with bodies at its bars.

        Args:
            bars, step: length of a window, and from one to the next; None = `bars`.
            min_frames, max_frames: of a window; longer ones lose their end.
            rates: how fast the phrase of that number is shown; each rate is a phrase of its own.
        """
        items: list[Window] = []
        records: list[PhraseRecord] = []
        for number, record in enumerate(dataset.phrases):
            phrase = dataset.whole(number)
            if phrase is None:
                continue
            assert phrase.body is not None, "open the data set with bodies=True"
            audio = with_phase_rows(torch.from_numpy(phrase.audio)[None])[0].numpy()
            for rate in rates(number):
                shown = stretched(audio, phrase.phase, phrase.body, rate)
                cuts = cut_at_bars(shown[1], bars=bars, step=step, min_frames=min_frames)
                parts = [slice(start, min(stop, start + max_frames)) for start, stop in cuts]
                items += [Window(len(records), shown[0][:, p], shown[2][p]) for p in parts]
                records += [record] if parts else []
        return cls(items, records, list(rows_of_each(item.phrase for item in items).values()))

    def sounds(self, index: Sequence[int]) -> tuple[Tensor, Tensor]:
        """Conditions [B,167,T] of windows, padded with zeros, and their mask [B,T]."""
        values, mask = padded([torch.from_numpy(self.items[i].audio.T) for i in index])
        return values.transpose(1, 2), mask

    def bodies(self, index: Sequence[int]) -> tuple[Tensor, Tensor]:
        """Raw features [B,T,23,6] of windows, padded with zeros, and their mask [B,T]."""
        return padded([torch.from_numpy(self.items[i].body).float() for i in index])

    def embed_sounds(self, embed: Embed, device: torch.device | str = "cpu") -> Tensor:
        """Every window's sound through `embed(condition, mask)`: [N,D] float32 on the CPU."""
        return self._embedded(embed, self.sounds, device)

    def embed_bodies(self, embed: Embed, device: torch.device | str = "cpu") -> Tensor:
        """Every window's body through `embed(features, mask)`: [N,D] float32 on the CPU."""
        return self._embedded(embed, self.bodies, device)

    @torch.no_grad()
    def _embedded(
        self,
        embed: Embed,
        read: Callable[[Sequence[int]], tuple[Tensor, Tensor]],
        device: torch.device | str,
    ) -> Tensor:
        order = sorted(range(len(self.items)), key=lambda n: self.items[n].num_frames)
        parts = []
        for start in range(0, len(order), EMBEDDED):  # of like length, so that little is padding
            values, mask = read(order[start : start + EMBEDDED])
            parts.append(embed(values.to(device), mask.to(device)).float().cpu())
        found = torch.cat(parts)
        return found[torch.tensor(order).argsort()]


def stretched(
    audio: np.ndarray, phase: np.ndarray, body: np.ndarray, rate: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sound [167,T], unwrapped bars [T] and raw features [T,23,6] `rate` times as fast: the same
    of T' frames by linear interpolation, velocities and turning `rate` times as large."""
    if rate == 1:
        return audio, phase, body
    at = np.arange(0, len(phase) - 1, rate)
    before, part = at.astype(int), (at % 1).astype(np.float32)
    audio = audio[:, before] * (1 - part) + audio[:, before + 1] * part
    for rows in (slice(BEAT.start, BEAT.start + 2), slice(BEAT.start + 2, BEAT.stop)):
        audio[rows] /= np.maximum(np.linalg.norm(audio[rows], axis=0), 1e-6)  # back on the circle
    weight = part[:, None, None]
    moved = body[before].astype(np.float32) * (1 - weight) + body[before + 1] * weight
    moved[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] *= rate
    phase = phase[before] * (1 - part) + phase[before + 1] * part
    return audio, phase, moved.astype(np.float16)


def related(records: Sequence[PhraseRecord]) -> np.ndarray:
    """Which phrases [N,N] bool are of one song or share a clip; each is related to itself."""
    songs = np.array([song_of(record) for record in records])
    same = songs[:, None] == songs[None]
    owned = [(clip, number) for number, record in enumerate(records) for clip in record.clips]
    for rows in rows_of_each(clip for clip, _ in owned).values():
        owners = [owned[row][1] for row in rows]
        same[np.ix_(owners, owners)] = True
    return np.asarray(same)


# ---------------------------------------------------------------- retrieval

TOP = (1, 5, 10)
RESAMPLES = 500


def ranks(query: np.ndarray, items: np.ndarray, kin: np.ndarray) -> Ranks:
    """Rank of item i for query i, by cosine of unit vectors [M, D]; `kin` [M, M] bool: items that
    are neither right nor wrong for a query (same song, say), whatever it says of the diagonal."""
    own = np.eye(len(kin), dtype=bool)
    similarity = query.astype(np.float64) @ items.astype(np.float64).T  # M M
    return best_ranks(np.where(kin & ~own, np.inf, -similarity), own)


def by_song(
    values: np.ndarray,
    songs: Sequence[str],
    statistic: Callable[[np.ndarray], float],
    *,
    seed: int = 0,
) -> Estimate:
    """A figure of queries [Q] with a bootstrap interval over songs (`count`): those of one are not
    independent, so whole songs are drawn again (Field and Welsh 2007, cluster bootstrap)."""
    names, owner = np.unique(np.asarray(songs), return_inverse=True)
    groups = [values[owner == number] for number in range(len(names))]
    rng = np.random.default_rng(seed)
    drawn = rng.integers(0, len(groups), (RESAMPLES, len(groups)))
    found = [statistic(np.concatenate([groups[g] for g in row])) for row in drawn]
    low, high = np.percentile(found, [2.5, 97.5])
    return Estimate(float(statistic(values)), float(low), float(high), len(groups))


def retrieval_figures(
    found: Sequence[Ranks], songs: Sequence[str], *, seed: int = 0
) -> dict[str, Estimate]:
    """`r_at_1`, `r_at_5`, `r_at_10` (fractions) and `median_rank` over all batches; `songs`: of
    each query, batch after batch."""
    hits = {f"r_at_{k}": np.concatenate([part.hits(k) for part in found]) for k in TOP}
    figures = {key: by_song(values, songs, np.mean, seed=seed) for key, values in hits.items()}
    places = np.concatenate([part.mean() for part in found])
    return figures | {"median_rank": by_song(places, songs, np.median, seed=seed)}


Figures = dict[str, Estimate]


@dataclass(frozen=True)
class Bench:
    """Batches of windows, drawn once, so that every row of a table answers the same questions."""

    batches: list[np.ndarray]  # numbers of the windows [M] of each
    phrase: np.ndarray  # of each window [N]
    songs: list[str]  # of each query, batch after batch
    kin: np.ndarray  # phrases [P,P] bool of one song or that share a clip
    same_action: np.ndarray  # phrases [P,P] bool whose motion goes by the same tag
    seed: int  # of everything random

    @classmethod
    def draw(
        cls, windows: Windows, *, batch: int = BATCH, replications: int = 20, seed: int = 0
    ) -> "Bench":
        """Replications of: all phrases in any order, full batches of them (one of all where they
        are fewer), a window of each."""
        records, rng = windows.records, np.random.default_rng(seed)
        drawn = []
        for _ in range(replications):
            for phrases in batches(len(records), min(batch, len(records)), rng):
                drawn.append(np.array([rng.choice(windows.of_phrase[p]) for p in phrases]))
        phrase = np.array([window.phrase for window in windows.items])
        songs = [song_of(records[p]) for p in phrase[np.concatenate(drawn)]]
        tags = np.array([record.tag for record in records])
        same_action = (tags[:, None] == tags[None]) & (tags != "")[:, None]
        return cls(drawn, phrase, songs, related(records), same_action, seed)

    def measure(
        self, query: Tensor, items: Tensor, *, by_action: bool = False, shuffled: bool = False
    ) -> Figures:
        """How well queries [N,D] find the items [N,D] of their own windows.

        Args:
            by_action: phrases of the same tag are neither right nor wrong: a caption fits them all.
            shuffled: each asks in another's place, which is what knowing nothing gives.
        """
        kin = self.kin | self.same_action if by_action else self.kin
        found = [
            ranks(query.numpy()[asking], items.numpy()[windows], kin[np.ix_(phrases, phrases)])
            for asking, windows, phrases in self.questions(shuffled=shuffled)
        ]
        return retrieval_figures(found, self.songs, seed=self.seed)

    def questions(self, *, shuffled: bool) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Of each batch: the windows that ask, those they are asked for, and their phrases [M]."""
        rng = np.random.default_rng(self.seed)
        for windows in self.batches:
            yield rng.permutation(windows) if shuffled else windows, windows, self.phrase[windows]


def in_common(
    windows: Windows, bench: Bench, sound: Tensor, motion: Tensor, *, shuffled: bool = False
) -> Figures:
    """What each sound's nearest motion of another song has in common with its own; keys [N,D].
    `shuffled`: another sound asks in each one's place."""
    given = []
    for asking, asked, phrases in bench.questions(shuffled=shuffled):
        similarity = sound.numpy()[asking] @ motion.numpy()[asked].T  # M M
        similarity[bench.kin[np.ix_(phrases, phrases)]] = -np.inf
        given.append(asked[similarity.argmax(1)])
    own, found = np.concatenate(bench.batches), np.concatenate(given)
    tempo = np.array([windows.records[phrase].tempo for phrase in bench.phrase])  # N
    tag = np.array([windows.records[phrase].tag for phrase in bench.phrase])  # N
    root = [window.body[:, ROOT_ROW].astype(np.float32) for window in windows.items]
    speed = np.array([np.hypot(r[:, FORWARD], r[:, LATERAL]).mean() for r in root])  # N
    octaves = np.log2(tempo[found] / tempo[own])
    values = {
        "tempo": np.abs(octaves - np.rint(octaves)),  # half and double tempo are the same
        "speed": np.abs(speed[found] - speed[own]),  # m/s over ground
        "action": (tag[found] == tag[own]).astype(float),
    }
    return {k: by_song(each, bench.songs, np.mean, seed=bench.seed) for k, each in values.items()}


TEMPO_WIDTH = 0.05  # of the kernel, in log tempo: 5%
SPACE, TEMPO, UNTRAINED, CHANCE = "shared space", "tempo alone", "untrained tower", "chance"


@dataclass(frozen=True)
class SpaceSettings:
    """How much is measured: bars and frames of a window, windows of a batch, replications, seed."""

    bars: int = 2
    min_frames: int = 40
    max_frames: int = 150
    batch: int = BATCH
    replications: int = 20
    seed: int = 0


def evaluate_space(
    space: SharedSpace,
    data: str,
    *,
    split: str = "test",
    texts: tuple[TextTower, PromptTokenizer] | None = None,
    settings: SpaceSettings | None = None,
    about: dict[str, str] | None = None,
    progress: Progress = lambda text: None,
) -> Report:
    """Measure a space on one split of prepared phrases; plain data, see `report_data`.

    Args:
        space: on the CPU.
        data: folder of `prepare-audio`, with bodies; no training saw its `split`, test or val.
        texts: measure text as well, if every phrase has a caption.

    Raises UserError: no such phrases, no bodies, or a text tower of another space.
    """
    settings = settings or SpaceSettings()
    progress(f"reading {data}")
    splits = (MotionPhraseDataset(data, split=part, bodies=True, cache_in_memory=False)
              for part in (split, "train"))  # fmt: skip
    low, high = settings.min_frames, settings.max_frames
    held_out, train = (
        Windows.cut(each, bars=settings.bars, min_frames=low, max_frames=high) for each in splits
    )
    amount = {"batch": settings.batch, "replications": settings.replications}
    bench = Bench.draw(held_out, **amount, seed=settings.seed)
    progress(f"embedding {len(held_out.items)} windows of {len(held_out.records)} phrases")
    motion = held_out.embed_bodies(space.embed_motion)
    sounds = {
        SPACE: held_out.embed_sounds(space.embed_audio),
        TEMPO: tempo_alone(train, train.embed_bodies(space.embed_motion), held_out),
        UNTRAINED: held_out.embed_sounds(untrained_tower(space.audio, space.config, settings.seed)),
    }
    tables = [
        _table(bench, "sound → motion", sounds, {SPACE: motion}),
        _table(bench, "motion → sound", {SPACE: motion}, sounds),
    ]
    captions = [record.caption for record in held_out.records]
    if texts is not None and not all(captions):
        progress("phrases without captions: texts are left out")
    elif texts is not None:
        spoken = space.embed_text(captions, *texts)
        blind = untrained_tower(space.motion, space.card.network, settings.seed)
        bodies = {SPACE: motion, UNTRAINED: held_out.embed_bodies(blind)}
        text = {SPACE: spoken[[window.phrase for window in held_out.items]]}
        tables += [
            _table(bench, "text → sound", text, sounds, by_action=True),
            _table(bench, "sound → text", sounds, text, by_action=True),
            _table(bench, "text → motion", text, bodies, by_action=True),
        ]
    rows = {}
    for name, keys in {**sounds, CHANCE: sounds[SPACE]}.items():
        rows[name] = GridRow(in_common(held_out, bench, keys, motion, shuffled=name == CHANCE))
    tables.append(Grid.of("nearest", rows))
    songs = len({record.song for record in held_out.records})
    facts = {"split": split, "phrases": len(held_out.records), "songs": songs}
    facts |= {"windows": len(held_out.items), "fingerprint": space.fingerprint}
    return report_data("space", {**(about or {}), **facts}, asdict(settings), tables, [])


def tempo_alone(train: Windows, motion: Tensor, held_out: Windows) -> Tensor:
    """What motion to expect at a tempo [N,D]: Nadaraya-Watson regression on the training windows,
    whose keys are `motion` [N',D]."""
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
    count, runs = len(bench.songs), len(bench.batches)
    names = list(query if len(query) > 1 else items)
    rows = {}
    for name in [*names, CHANCE]:
        sides = query.get(name, query[SPACE]), items.get(name, items[SPACE])
        cells = bench.measure(*sides, by_action=by_action, shuffled=name == CHANCE)
        rows[name] = GridRow(cells, count // runs, runs)
    nor = " Nor are phrases of the same action: a caption fits them all." if by_action else ""
    return Grid.of("space", rows, {"by_action": nor}, name=title, title=title)
