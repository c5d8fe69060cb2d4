"""The memory suite: does it help? With, without and with randomly retrieved memory (RAG++).

Every arm is measured on the same phrases and songs, which no training saw, with the same noise:
how well real motion is denoised, what is made of held-out songs. Gains over "without" are resampled
over songs, pair by pair. Sizes of the memory and numbers of hits are told apart by the denoising
error alone, the finest and cheapest of the figures.

Letters: N phrases or songs, S songs, B of a batch or questions, D width of the space, T frames.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...config_audio import MemoryConfig
from ...data.phrases.dataset import PhraseBatch, PhraseItem, collate
from ...errors import UserError
from ...memory.index import MemoryIndex
from ...memory.priors import prior_curves
from ...memory.query import Memory, retrieve
from ...model.audio.audio_motion_model import AudioMotionModel
from ...model.audio.conditioning import MemoryCondition
from ...model.audio.shared_space import SharedSpace
from ...model.noise import standard_normal
from ...motion.trajectory import MotionTrajectory, place_window
from ...pipelines.song_memory import as_condition, bars_of_sound, bars_of_window
from ...pipelines.song_sampler import SPARE, SongSampler, SongSampling
from ..engine import Progress, Value
from ..families import BEAT_ALIGNMENT, TRAJECTORY_SANITY
from ..samples import DanceSample, rows_of_each
from ..stats import MIN_PAIRS, bootstrap_mean, paired_bootstrap
from ..tables import Column, Grid, GridRow, described, plain, report_data
from .songs import Piece, dance_of, held_out_songs, items, open_split, song_of

WITHOUT, WITH, RANDOM = "without", "with", "random"


@dataclass(frozen=True)
class Arm:
    """One way to ask."""

    name: str
    asks: bool = True  # False = the model is given no memory at all
    # somebody else's question, yet as sure of the answer as of the right one: if this does as well
    # as the right answers, what is remembered does not matter
    stray: bool = False
    top_k: int | None = None  # hits; None = as configured
    share: float = 1.0  # of the memory's songs that may be found


ARMS = (Arm(WITHOUT, asks=False), Arm(WITH), Arm(RANDOM, stray=True))


@dataclass(frozen=True)
class Asker:
    """A memory asked directly, without a deadline: the same answers on any machine."""

    index: MemoryIndex
    config: MemoryConfig  # how it is asked
    seed: int  # of what is hidden from small memories, and of stray questions

    def answer(
        self,
        arm: Arm,
        query: Tensor,
        bars: np.ndarray | Tensor | None,
        num_frames: int,
        songs: Sequence[str],
        *,
        draw: int = 0,
    ) -> MemoryCondition | None:
        """What an arm is told of B windows, of keys [B,D], unwrapped bars [B,T] (None = unknown)
        and songs [B] that are never found; None for one that does not ask. Another `draw`, other
        stray questions."""
        if not arm.asks:
            return None
        hidden = self.hidden(arm.share)
        config = self.config.model_copy(update={"top_k": arm.top_k or self.config.top_k})

        def ask(keys: Tensor) -> Memory:
            return retrieve(
                self.index,
                keys,
                config,
                num_frames=num_frames,
                phase=None if bars is None else torch.as_tensor(bars).reshape(len(keys), -1),
                exclude_songs=[hidden | {song} for song in songs],
            )

        memory = ask(query)
        if arm.stray:
            rng = np.random.default_rng([self.seed, 5, draw])
            rows = torch.from_numpy(rng.integers(len(self.index), size=len(query)))
            memory = replace(ask(self.index.audio_keys[rows]), confidence=memory.confidence)
        return as_condition(memory)

    def hidden(self, share: float) -> frozenset[str]:
        """The songs that a memory of this share lacks; a smaller one lacks those and more."""
        songs = self.index.songs
        order = np.random.default_rng([self.seed, 6]).permutation(len(songs))
        return frozenset(songs[n] for n in order[max(1, round(share * len(songs))) :])


# ---------------------------------------------------------------- what an arm is measured by

Values = dict[str, np.ndarray]  # column -> one figure for each phrase or song [N]
BATCH = 16
LEVELS = ("low", "middle", "high")  # thirds of the diffusion's steps
DENOISING, CURVES = (described(kind)["columns"] for kind in ("denoising", "curves"))
SONG_FAMILIES = (BEAT_ALIGNMENT, TRAJECTORY_SANITY)
RHYTHM = ("motion_to_music", "music_to_motion", "f", "f_above_turned")
SONGS = (
    *(column for column in BEAT_ALIGNMENT.columns if column.key in RHYTHM),
    *TRAJECTORY_SANITY.columns,
)


@dataclass(frozen=True, eq=False)
class Figures:
    """A way to measure an arm."""

    name: str  # of its table
    columns: tuple[Column, ...]
    clusters: list[str]  # song of each of the N figures: what is drawn again together
    measure: Callable[[Arm], Values]  # figures [N] of one arm
    # those of what not listening scores; None = no such row
    chance: Callable[[], Values] | None = None


@dataclass(frozen=True)
class Setting:
    """The model, its memory and the space; the seed of noise."""

    model: AudioMotionModel
    space: SharedSpace
    asker: Asker
    sampled: SongSampling


def held_back(
    data: str, splits: Sequence[str], frames: int, most: int, seed: int
) -> list[PhraseItem]:
    """Up to `most` windows without padding, a split after the other.
    Raises UserError: a split is missing."""
    found: list[PhraseItem] = []
    for split in splits:
        every = items(open_split(data, split, frames, seed))
        found += [item for item in every if bool(item.mask.all())]
    return found[:most]


def denoising(setting: Setting, items: Sequence[PhraseItem], draws: int) -> Figures:
    """Mean squared error of the predicted clean window, in z-scores, at three levels of noise, the
    same for every arm. The finest table: it judges the network where it knows what is right, not
    one of the many dances that fit a song."""
    clusters = [song_of(item.record) for item in items]

    @torch.no_grad()
    def measure(arm: Arm) -> Values:
        found: dict[str, list[Tensor]] = {level: [] for level in LEVELS}
        for number, start in enumerate(range(0, len(items), BATCH)):
            part = slice(start, start + BATCH)
            phrases = collate(items[part])
            query, bars = setting.space.embed_audio(phrases.audio), bars_of_sound(phrases.audio)
            asked = query, bars, phrases.audio.shape[-1], clusters[part]
            memory = setting.asker.answer(arm, *asked, draw=number)
            for third, level in enumerate(LEVELS):
                places = [(number, third, draw) for draw in range(draws)]
                errors = [_denoising_error(setting, phrases, memory, each) for each in places]
                found[level].append(torch.stack(errors).mean(dim=0))
        values = {level: torch.cat(each).double().numpy() for level, each in found.items()}
        return values | {"all": np.mean(list(values.values()), axis=0)}

    return Figures("error of denoising real motion", DENOISING, clusters, measure)


def _denoising_error(
    setting: Setting,
    phrases: PhraseBatch,
    memory: MemoryCondition | None,
    place: tuple[int, int, int],
) -> Tensor:
    """[B] of one draw of noise; its place is batch, third of the steps and draw."""
    model, seed = setting.model, setting.sampled.seed
    device, steps = model.mean.device, model.diffusion.config.timesteps
    entropy = np.random.SeedSequence([seed, 7, *place]).generate_state(1)[0]
    draws = torch.Generator().manual_seed(int(entropy))
    clean = model.normalise(phrases.motion.to(device))
    low, high = (third * steps // len(LEVELS) for third in (place[1], place[1] + 1))
    t = torch.randint(low, max(high, low + 1), (len(clean),), generator=draws).to(device)
    noise = standard_normal(clean.shape, draws, device=device)
    noisy = model.diffusion.q_sample(clean, t, noise)
    heard = None if memory is None else memory.to(device)
    output = model(noisy, t, phrases.audio.to(device), memory=heard)
    x_0 = model.diffusion.predict_x0(output, noisy, t)
    return (x_0 - clean).square().mean(dim=(1, 2)).cpu()


def curves(setting: Setting, items: Sequence[PhraseItem]) -> Figures:
    """How far the made motion's prior curves are from those of the motion that was danced: a sample
    a phrase, as many frames as one window makes. Chance is real motion of another song."""
    frames = setting.model.config.window - SPARE
    clusters = [song_of(item.record) for item in items]
    starts = [float(bars_of_sound(item.audio[None])[0][0]) for item in items]
    real = [
        prior_curves(place_window(item.motion.numpy(), phase=start)[:frames])
        for item, start in zip(items, starts, strict=True)
    ]

    def measure(arm: Arm) -> Values:
        made = []
        for number, item in enumerate(items):
            audio = item.audio[:, :frames]
            bars = bars_of_sound(audio[None])[0].numpy()
            motion = dance(setting, arm, audio, bars, clusters[number], number)
            made.append(prior_curves(motion.data))
        return curve_distances(made, real)

    other = np.roll(np.arange(len(items)), len(items) // 2)
    return Figures(
        "distance of prior curves from real motion",
        CURVES,
        clusters,
        measure,
        chance=lambda: curve_distances([real[number] for number in other], real),
    )


def curve_distances(made: Sequence[np.ndarray], real: Sequence[np.ndarray]) -> Values:
    """Mean absolute difference over time [N] of curves [4,T], each in [0, 1]."""
    rows = np.array([np.abs(a - b).mean(axis=1) for a, b in zip(made, real, strict=True)])  # N 4
    return {column.key: rows[:, place] for place, column in enumerate(CURVES)}


def songs(setting: Setting, pieces: Sequence[Piece]) -> Figures:
    """Beat alignment and sanity of motions for held-out synthetic songs, one sample a song."""

    def measure(arm: Arm) -> Values:
        made = [dance(setting, arm, p.condition, p.phase, p.name, n) for n, p in enumerate(pieces)]
        sample = DanceSample.of(list(map(dance_of, pieces, made)))
        found: dict[str, Value] = {}
        for family in SONG_FAMILIES:
            found |= family.compute(sample, sample, seed=setting.sampled.seed)
        return {column.key: np.asarray(found[column.key]) for column in SONGS}

    return Figures("motions for held-out songs", SONGS, [p.name for p in pieces], measure)


@torch.no_grad()
def dance(
    setting: Setting, arm: Arm, condition: Tensor, bars: np.ndarray | None, song: str, number: int
) -> MotionTrajectory:
    """One motion for a condition [C,T]; noise depends on (seed, number), not on the arm."""
    sampled = replace(setting.sampled, seed=setting.sampled.seed + 1000 * number)

    def recall(start: int, length: int) -> MemoryCondition:
        query = setting.space.embed_audio(condition[None, :, start : start + length])
        phase = None if bars is None else bars_of_window(bars, start, length)[None]
        draw = 1000 * number + start
        answer = setting.asker.answer(arm, query, phase, length, [song], draw=draw)
        assert answer is not None
        return answer

    sampler = SongSampler(setting.model, sampled)
    return sampler.sample(condition, phase=bars, recall=recall if arm.asks else None)[0]


CHANCE = "real, of another song"


@dataclass(frozen=True)
class MemorySettings:
    """How much is measured; the report repeats it."""

    num_phrases: int = 120
    splits: tuple[str, ...] = ("test", "val")
    draws: int = 2  # of noise, a phrase and level
    num_songs: int = 24
    song_seconds: float = 12.0
    shares: tuple[float, ...] = (0.1, 0.3)
    top_ks: tuple[int, ...] = (1, 32)
    tell_meter: bool = True
    seed: int = 0


def evaluate_memory(
    model: AudioMotionModel,
    index: MemoryIndex,
    space: SharedSpace,
    *,
    data: str,
    config: MemoryConfig,
    settings: MemorySettings,
    sampling: Mapping[str, Any] | None = None,
    about: Mapping[str, Any] | None = None,
    progress: Progress = lambda text: None,
) -> dict[str, Any]:
    """The whole report as plain data, with a verdict.

    Args:
        model: of train_memory.
        index, space: the memory and the space of its keys; `config` is how it is asked.
        data: folder or bucket of pairs with the splits to measure on.
        sampling: what `SongSampling` takes, the seed aside.

    Raises UserError: the data cannot be used.
    """
    sampled = SongSampling(seed=settings.seed, **(sampling or {})).resolved(model.config)
    setting = Setting(model, space, Asker(index, config, settings.seed), sampled)
    frames, seed = model.config.window, settings.seed
    items = held_back(data, settings.splits, frames, settings.num_phrases, seed)
    if len(items) < MIN_PAIRS:
        raise UserError(
            f"{data}: {len(items)} held-back phrases of {frames} frames are too few"
            "; prepare more data"
        )
    amount = settings.num_songs, settings.song_seconds, seed
    pieces = held_out_songs(*amount, tell_meter=settings.tell_meter)
    others = [Arm(f"{share:.0%} of the songs", share=share) for share in settings.shares]
    others += [Arm(f"top {top_k}", top_k=top_k) for top_k in settings.top_ks]
    tables: list[Grid] = []
    verdict: dict[str, Any] = {}
    for figures, asked in (
        (denoising(setting, items, settings.draws), [*ARMS, *others]),
        (curves(setting, items), ARMS),
        (songs(setting, list(pieces)), ARMS),
    ):
        measured = {}
        for arm in asked:
            progress(f"{figures.name}: {arm.name}")
            measured[arm.name] = over_songs(figures.measure(arm), figures.clusters)
        if figures.chance is not None:
            measured[CHANCE] = over_songs(figures.chance(), figures.clusters)
        tables += arm_tables(figures, measured, asked)
        verdict |= judged(figures, measured)
    facts = {
        **(about or {}),
        "memory": f"{len(index)} phrases of {len(index.songs)} songs",
        "phrases": f"{len(items)} of {len({item.record.song for item in items})} songs",
        "asked": plain(config.model_dump()),
    }
    said = [
        f"{name}: against no memory {words[WITHOUT]}, against a random one {words[RANDOM]}"
        for name, words in verdict.items()
    ]
    return report_data(
        "audio", facts, asdict(settings), tables, title="Memory", notes=said, verdict=verdict
    )


def over_songs(values: Values, clusters: Sequence[str]) -> Values:
    """Figures [N] -> the mean of each song [S]: phrases of a song are not independent."""
    rows = [rows for _, rows in sorted(rows_of_each(clusters).items())]
    return {key: np.array([each[row].mean() for row in rows]) for key, each in values.items()}


def arm_tables(
    figures: Figures, measured: Mapping[str, Values], asked: Sequence[Arm]
) -> Iterator[Grid]:
    """Every arm's figures; then every arm less "without", and with less random."""
    rows = {
        name: GridRow({key: bootstrap_mean(each) for key, each in found.items()})
        for name, found in measured.items()
    }
    name, columns = figures.name, figures.columns
    yield Grid.of("memory", rows, name=name, title=name, columns=columns)
    pairs = {f"{arm.name} − {WITHOUT}": (arm.name, WITHOUT) for arm in asked if arm.asks}
    pairs |= {f"{WITH} − {RANDOM}": (WITH, RANDOM)}
    rows = {
        gain: GridRow({c.key: difference(measured, *pair, c.key) for c in columns})
        for gain, pair in pairs.items()
    }
    title = f"{name}: differences"
    yield Grid(title, title, columns, rows, head="memory")


def difference(measured: Mapping[str, Values], arm: str, base: str, key: str) -> dict[str, Any]:
    """Arm less base over songs; `apart`: its interval excludes 0."""
    found = asdict(paired_bootstrap(measured[base][key], measured[arm][key]))
    return found | {"apart": bool(found["low"] > 0 or found["high"] < 0)}


def judged(figures: Figures, measured: Mapping[str, Values]) -> dict[str, Any]:
    """For each column with a good side: is the memory better than none, and than a random one?"""
    found = {}
    for column in (each for each in figures.columns if each.better != "real"):
        gains = {b: difference(measured, WITH, b, column.key) for b in (WITHOUT, RANDOM)}
        found[f"{figures.name}: {column.heading}"] = {b: word(g, column) for b, g in gains.items()}
    return found


def word(found: Mapping[str, Any], column: Column) -> str:
    """better, worse, or no difference."""
    if not found["apart"]:
        return "no difference"
    return "better" if (found["value"] > 0) == (column.better == "high") else "worse"
