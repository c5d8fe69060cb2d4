"""What is measured: N motions and what each was asked for, of text, of song, of whole bodies.

And what they are held against: a pose held still, and a network that has learned nothing.

Letters: N motions of a sample, D embedding channels, T frames.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
import torch

from ..data.prepared import SYNTHETIC, ClipRecord, PreparedData
from ..errors import UserError
from ..metrics.rhythm import strangers
from ..motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, decode_features, encode_features
from ..motion.motion import Motion
from ..motion.trajectory import MotionTrajectory

if TYPE_CHECKING:
    from ..model.audio.audio_motion_model import AudioMotionModel
    from ..model.audio.shared_space import AudioTower, MotionTower
    from ..model.generation.motion_generator import TextToMotion

Found = TypeVar("Found")
Name = TypeVar("Name", str, int)
Moved = TypeVar("Moved", MotionTrajectory, Motion)
Tower = TypeVar("Tower", "AudioTower", "MotionTower")
# Prompts and their numbers of frames, with a seed, to one motion each, in the same order.
Sampler = Callable[[Sequence[str], Sequence[int], int], list[Motion]]


class Memo:
    """What is computed of a sample once: features, kinematics, fitted axes."""

    def __init__(self) -> None:
        self.known: dict[str, object] = {}

    def once(self, name: str, compute: Callable[[], Found]) -> Found:
        """The value kept under `name`, computed at the first call."""
        if name not in self.known:
            self.known[name] = compute()
        return self.known[name]  # type: ignore[return-value]


@dataclass(frozen=True)
class Clips:
    """N motions with what they are about; row i of each field belongs together."""

    motions: list[Motion]
    captions: list[str]
    groups: list[str]
    tags: list[str]
    labels: list[dict[str, str]]

    def __len__(self) -> int:
        return len(self.motions)

    @property
    def num_frames(self) -> list[int]:
        """Length of each motion in frames."""
        return [motion.num_frames for motion in self.motions]

    def rows(self, index: Sequence[int]) -> "Clips":
        """The clips at these rows, in this order."""
        columns = (self.motions, self.captions, self.groups, self.tags, self.labels)
        return Clips(*([column[i] for i in index] for column in columns))  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False)
class MotionSample:
    """N motions of the text branch under N captions."""

    clips: Clips
    text: np.ndarray  # the judge's embeddings [N,D]
    motion: np.ndarray  # [N,D] likewise
    source: np.ndarray  # row [N] of the reference clip whose caption was asked for, -1 = none
    memos: list[Memo]  # one a motion; it goes with the motion wherever that goes
    # `sample.memo.once("features", lambda: ...)` computes a thing once a sample
    memo: Memo = field(default_factory=Memo, repr=False)
    # of which this is a part; units fitted on halves would differ from row to row
    whole: "MotionSample | None" = field(default=None, repr=False)

    @classmethod
    def of(
        cls, clips: Clips, text: np.ndarray, motion: np.ndarray, source: np.ndarray
    ) -> "MotionSample":
        """A sample of which nothing has been computed."""
        return cls(clips, text, motion, source, [Memo() for _ in range(len(clips))])

    def __len__(self) -> int:
        return len(self.clips)

    @property
    def asked(self) -> list[str]:
        """What each motion was asked for."""
        return self.clips.captions

    def each(self, name: str, measure: Callable[[Motion], Found]) -> list[Found]:
        """What `measure` says of each of the N motions, computed once a motion."""
        pairs = zip(self.memos, self.clips.motions, strict=True)
        return [memo.once(name, partial(measure, motion)) for memo, motion in pairs]

    def rows(self, index: Sequence[int]) -> "MotionSample":
        """The pairs at these rows, in this order."""
        at = list(index)
        arrays = self.text[at], self.motion[at], self.source[at]
        memos = [self.memos[row] for row in at]
        return MotionSample(self.clips.rows(at), *arrays, memos, whole=self.whole or self)

    def reordered(self, order: Sequence[int]) -> "MotionSample":
        """Captions and labels stay, motions change places: what ignoring the prompt gives."""
        at = list(order)
        clips = replace(self.clips, motions=[self.clips.motions[row] for row in at])
        memos = [self.memos[row] for row in at]
        return MotionSample(clips, self.text, self.motion[at], self.source, memos)


@dataclass(frozen=True, eq=False)
class Dance(Generic[Moved]):
    """A motion of T frames, a pelvis's path or a whole body's, and the music it is held against."""

    song: str  # name; dances of one song are neighbours, not strangers
    motion: Moved  # as it is handed over, 30 frames a second
    beats: np.ndarray  # of the music, seconds; some may lie beyond the end
    bars: np.ndarray | None = None  # true bars [T] of the music, unwrapped; None = nobody knows
    meter: int = 4  # beats a bar of the music
    counted: int = 4  # beats a bar that the motion's phase counts
    raw: Motion | None = None  # a body before its feet were held; None = nobody held them
    path: MotionTrajectory | None = None  # that a body was to stand on; None = it has its own
    # True [T] near a seam of two windows of a body; None = one piece
    seams: np.ndarray | None = None
    # of the motion; it goes with the motion wherever that goes
    memo: Memo = field(default_factory=Memo, repr=False)

    @property
    def seconds(self) -> float:
        return self.motion.seconds


@dataclass(frozen=True, eq=False)
class DanceSample(Generic[Moved]):
    """N motions, each with its music; the rest as in `MotionSample`."""

    dances: list[Dance[Moved]]
    source: np.ndarray
    memo: Memo = field(default_factory=Memo, repr=False)
    whole: "DanceSample[Moved] | None" = field(default=None, repr=False)

    @classmethod
    def of(cls, dances: Sequence[Dance[Moved]]) -> "DanceSample[Moved]":
        """Dances that answer to no real one."""
        return cls(list(dances), np.full(len(dances), -1))

    def __len__(self) -> int:
        return len(self.dances)

    @property
    def asked(self) -> list[str]:
        """The song of each motion."""
        return [dance.song for dance in self.dances]

    def each(self, name: str, measure: Callable[[Moved], Found]) -> list[Found]:
        """What `measure` says of each of the N motions, its music apart, computed once a motion."""
        return [dance.memo.once(name, partial(measure, dance.motion)) for dance in self.dances]

    def beside(
        self, name: str, measure: Callable[[Moved], Found]
    ) -> list[tuple[Dance[Moved], Found]]:
        """Each dance with what `each` finds of it."""
        return list(zip(self.dances, self.each(name, measure), strict=True))

    def rows(self, index: Sequence[int]) -> "DanceSample[Moved]":
        """The dances at these rows, in this order."""
        rows = [self.dances[i] for i in index]
        return DanceSample(rows, self.source[list(index)], whole=self.whole or self)

    def reordered(self, order: Sequence[int]) -> "DanceSample[Moved]":
        """The music stays, motions change places: what not listening gives."""
        moved = []
        for own, row in zip(self.dances, order, strict=True):
            dance, song, bars = self.dances[row], own.song, own.bars
            moved.append(replace(dance, song=song, beats=own.beats, bars=bars, meter=own.meter))
        return DanceSample(moved, self.source)

    def on_other_songs(self, seed: int, replication: int) -> "DanceSample[Moved]":
        """Each motion on the music of another: what not listening scores."""
        rng = np.random.default_rng([seed, 4, replication])
        return self.reordered(strangers(len(self), rng))


Trajectories = DanceSample[MotionTrajectory]
Bodies = DanceSample[Motion]


# ---------------------------------------------------------------- clips held out of training

FRESH_SEED = 90210  # of synthetic clips made only to test: never one that trains
FRESH_CLIPS = 800


@dataclass(frozen=True)
class HeldOut:
    """Clips of each kind, and where they come from."""

    data: PreparedData
    records: dict[str, list[ClipRecord]]  # `seen` and `unseen` (label combinations) to their clips
    source: str  # one line for the report

    @property
    def everything(self) -> list[ClipRecord]:
        """The clips of all kinds."""
        return [record for records in self.records.values() for record in records]


def open_held_out(data: str, cache: Path, trained_groups: frozenset[str]) -> HeldOut:
    """The test splits of a prepared folder, or fresh synthetic clips.

    Fresh clips ("synthetic", kept in `cache`) are made with a seed that no training uses, so that
    all are held back; what is not among the label combinations `trained_groups` is unseen.
    Raises UserError: no such folder, or it is damaged."""
    if data != SYNTHETIC:
        prepared = PreparedData.open(data)
        splits = {name: prepared.records(f"test_{name}") for name in ("seen", "unseen")}
        return HeldOut(prepared, splits, f"test splits of {data}")
    from ..data.prepare import prepare
    from ..data.sources import SyntheticSource
    from ..io.files import sole_writer

    folder = cache / f"synthetic-test-{FRESH_CLIPS}"
    with sole_writer(folder, wait=True):
        prepare([SyntheticSource(FRESH_CLIPS, seed=FRESH_SEED)], folder)
    prepared = PreparedData.open(folder)
    splits = {"seen": [], "unseen": []}
    for record in prepared.records():
        splits["seen" if record.group in trained_groups else "unseen"].append(record)
    return HeldOut(prepared, splits, f"fresh synthetic clips, seed {FRESH_SEED}")


def choose_caption(captions: Sequence[str], key: str, seed: int) -> str:
    """One of a clip's captions, the same for the same key (the clip's id) and seed."""
    rng = np.random.default_rng([seed, *key.encode()])
    return captions[int(rng.integers(len(captions)))]


def rows_of_each(names: Iterable[Name]) -> dict[Name, list[int]]:
    """The rows of each name, ascending, names as they first come."""
    rows: dict[Name, list[int]] = {}
    for row, name in enumerate(names):
        rows.setdefault(name, []).append(row)
    return rows


def spread_over_groups(records: Sequence[ClipRecord], num: int, seed: int) -> list[ClipRecord]:
    """At most `num` different records, one of each label group in turn, in a random order: a source
    with many clips of one action (Bandai: two in three raise or wave an arm) would else decide
    every figure."""
    rng = np.random.default_rng(seed)
    mixed = [records[row] for row in rng.permutation(len(records))]
    groups = rows_of_each(record.group for record in mixed)
    queues = {group: [mixed[row] for row in rows] for group, rows in groups.items()}
    chosen: list[ClipRecord] = []
    while queues and len(chosen) < num:
        for group in rng.permutation(sorted(queues)):
            chosen.append(queues[group].pop())
            if not queues[group]:
                del queues[group]
    return chosen[:num]


def real_clips(
    data: PreparedData,
    records: Sequence[ClipRecord],
    *,
    num: int,
    max_frames: int,
    language: str = "en",
    min_frames: int = 16,
    seed: int = 0,
) -> Clips:
    """At most `num` of these clips that have a caption in the language, spread over groups; of
    longer ones the first `max_frames`.
    Raises UserError: there is no such clip."""
    long = (record for record in records if record.num_frames >= min_frames)
    usable = [record for record in long if data.captions(record).get(language)]
    if not usable:
        raise UserError(
            f"no clip of {min_frames} frames with a {language!r} caption to evaluate"
            "; prepare longer or captioned clips"
        )
    chosen = spread_over_groups(usable, num, seed)
    return Clips(
        motions=[decode_features(data.features(r)[:max_frames]) for r in chosen],
        captions=[choose_caption(data.captions(r)[language], r.id, seed) for r in chosen],
        groups=[record.group for record in chosen],
        tags=[record.tag for record in chosen],
        labels=[record.labels for record in chosen],
    )


# ---------------------------------------------------------------- floors


def frozen_pose(motion: Motion) -> Motion:
    """The first pose of a motion held for its whole length: the floor for anything that moves."""
    features = encode_features(motion)
    still = features[:1].expand_as(features).clone()
    still[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] = 0
    return decode_features(still)


def held_still(motion: Motion) -> Motion:
    """The first frame for all frames."""
    still, frames = motion.frames(0, 1), motion.num_frames
    return replace(
        motion,
        quaternions=np.repeat(still.quaternions, frames, axis=0),
        root_position=np.repeat(still.root_position, frames, axis=0),
        contacts=np.repeat(still.contacts, frames, axis=0),
    )


@contextmanager
def drawn_from(seed: int) -> Iterator[None]:
    """Inside, weights are drawn from this seed; outside, random numbers go on as before."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        yield


def untrained(generator: "TextToMotion", seed: int) -> "TextToMotion":
    """The same denoiser with fresh weights, text tower and statistics of the trained one."""
    from ..model.generation.denoiser import MotionDenoiser

    with drawn_from(seed):
        fresh = MotionDenoiser(generator.network, generator.denoiser.num_tags)
        # As training begins the last layer is zero, and every motion the mean one.
        torch.nn.init.xavier_uniform_(fresh.output_proj.weight)
    return generator.with_denoiser(fresh, scope=None, style_map=None)


def untrained_audio_model(model: "AudioMotionModel", seed: int) -> "AudioMotionModel":
    """The same network with fresh weights but the trained one's row statistics. As training begins
    the last layer is zero, and every motion stands still: here it is random too."""
    with drawn_from(seed):
        fresh = type(model)(model.config)
        torch.nn.init.xavier_uniform_(fresh.unet.output_conv.get_parameter("weight"))
    fresh.set_statistics(model.mean.cpu(), model.std.cpu())
    return fresh.to(model.mean.device).eval()


def untrained_tower(tower: Tower, config: Any, seed: int) -> Tower:
    """A tower of a shared space as its training began, but for the seed; the statistics are those
    of the trained one."""
    with drawn_from(seed):
        fresh = type(tower)(config)
    fresh.mean.copy_(tower.mean)
    fresh.std.copy_(tower.std)
    return fresh.eval()
