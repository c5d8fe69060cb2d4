"""Motion of any length: windows of a few seconds, each beginning with the last frames before it.

A window has one text. Its first frames are known, the last ones of the window before, whatever
text that had: this is how one action leads into the next. Where a body stands still, and a new text
begins so, they are not: what follows would be in the manner of what was (a wave after a clap that
nobody recorded is one that nobody recorded). It is made as if it came first, and joined; where two
postures lie apart, by a way from one to the other (`bridge`). Features say nothing of place or
heading, so windows are chained as they are. One window is in memory at a time.

Letters: T frames, R rows (bones, root track), C channels, O frames that neighbours share.
"""

import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..errors import UsageError, check_text, in_range
from ..metrics.measurements import ends_at_rest
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..model.noise import derived_seed, retry_seeds
from ..motion.features import ROOT_ROW, Place, decode_features, mirror_features
from ..motion.motion import Motion
from ..motion.postprocess.stitching import blend_boundaries, bridge, gone_down, leaps, posture
from ..motion.postprocess.streaming import Course, StreamingPostProcessor
from ..motion.skeleton import JOINT_INDEX
from ..tensors import Tensor, torch

WINDOW, OVERLAP = 150, 30  # frames
DEFAULT_SAMPLING = Sampling()
STILL, MOVED = 10, 0.05  # frames, and metres that feet and pelvis of a standing body move in them
MEETING = 30  # frames until a piece that was made apart is as it was made
SHORTEST = 48  # frames; a shorter window is made as long as this and cut: training saw few

ConstraintOf = Callable[[int, int], Constraint | None]  # what is known of frames [start, stop)
Miss = Callable[[Tensor], float]  # raw features [t, R, 6]: how far from what is wanted, 0 = there
Plan = Callable[[str], Sequence["Passage"]]  # of a text: what is done in order, the last on and on


@dataclass(frozen=True)
class Passage:
    """A stretch of motion with one text.

    Attributes:
        text: what it shows.
        frames: its length; 1 or more.
        tag: action label beside the text.
        window: frames of its windows at most, if fewer than those of others: each repeats what
            the one before showed, and tries its noise first.
        miss: of its frames so far; a window is sampled again, TRIES times at most, while they are
            not what is wanted.
        timed: frames in which it is shown, where its time is told: a way to how it begins is a part
            of them.
        low: whether one goes down to it by a way of its own, however it would go on.
        mirrored: whether it is the mirror image of what the text shows.
        straight: whether who is live and goes goes straight on.
    """

    text: str
    frames: int
    tag: str | None = None
    window: int | None = None
    miss: Miss | None = None
    timed: int | None = None
    low: bool = False
    mirrored: bool = False
    straight: bool = False

    def __post_init__(self) -> None:
        if self.frames < 1:
            raise UsageError(f"passage {self.text!r}: {self.frames} frames; 1 or more are needed")

    def under(self, seat: str) -> "Passage":
        """What the body does of it that goes on to sit, if it does."""
        return replace(self, text=seat, window=None, miss=None, mirrored=False) if seat else self


def stream_features(
    generator: TextToMotion,
    passages: Iterable[Passage],
    sampling: Sampling = DEFAULT_SAMPLING,
    *,
    constraint: ConstraintOf | None = None,
    window: int = WINDOW,
    overlap: int = OVERLAP,
    ahead: int = 0,
    bridged: bool = False,
    told: Callable[[int], None] | None = None,
) -> Iterator[Tensor]:
    """Raw features [t, R, 6] in pieces that follow each other and never change again.

    Each piece depends on the seed, its number, its text, and what came before it.

    Args:
        generator: trained.
        passages: taken one by one, each when the motion before it is made.
        sampling: the seed of all windows, and how each is sampled.
        constraint: what is known of frames [start, stop), counted from the beginning; None where
            nothing is.
        window: frames at most, the shared ones among them.
        overlap: frames O that a window shares with the one before.
        ahead: frames made beyond a passage: the next one begins with them if it has the same text;
            else they are dropped. A text that goes on has all that its window holds. Not for
            passages with a constraint or a `miss`.
        bridged: where a text begins in another posture than the one before ended in, the way there
            is shown first: a piece beyond the passage's frames, which a constraint does not count,
            or a part of them where its time is told.
        told: hears of the frames of a way before it comes.

    Raises:
        UsageError: the overlap does not fit the window, or a constraint is not as long as asked.
        UserError: as `TextToMotion.sample_features`.
    """
    if not 1 <= overlap <= window // 2:
        raise UsageError(f"overlap {overlap} must lie between 1 and half the window ({window})")
    before = spare = torch.zeros(0, generator.network.motion_rows, 6)
    shows: tuple[str, str | None, bool] | None = None  # the spare frames
    made, number, said, fps = 0, 0, ("", False), generator.card.fps

    def sampled(passage: Passage, known: Constraint, seed: int) -> Tensor:
        asked_for = padded(known, 0, SHORTEST - len(known))
        (features,) = generator.sample_features(
            [passage.text],
            seconds=max(len(known), SHORTEST) / fps,
            tags=[passage.tag],
            seed=seed,
            steps=sampling.steps,
            sampler=sampling.sampler,
            guidance_scale=sampling.guidance_scale,
            constraints=[asked_for.mirrored() if passage.mirrored else asked_for],
        )
        features = mirror_features(features) if passage.mirrored else features
        return blend_boundaries(features[: len(known)], known.known)

    asked: dict[tuple[int, int, int], Tensor] = {}  # samples of a window: frames, seed, shared ones

    def seeds() -> Iterator[int]:
        return retry_seeds(derived_seed(sampling.seed, number))

    def bridges(passage: Passage) -> bool:
        """Whether there is time for a way, and no repetition that it would cut short."""
        free = passage.timed is None or not (passage.window or passage.frames < SHORTEST)
        return bridged and free

    def tried(
        passage: Passage, frames: int, seed: int, shared: Tensor, *, alone: bool = False
    ) -> Tensor:
        before_it, given = len(shared), None
        if constraint is not None:
            start = max(made - before_it, 0)  # ways are beyond what it counts
            given = constraint(start, made + frames)
            given = given and padded(given, before_it - made + start, 0)
        known = carried_on(shared, given, before_it + frames)
        if (key := (frames, seed, before_it)) not in asked:
            asked[key] = sampled(passage, known, seed)[before_it:]
        piece = asked[key]
        if alone or before_it or not len(before) or (bridges(passage) and is_apart(before, piece)):
            return piece
        return met(before, piece, known.known)

    def leapt(passage: Passage, frames: int, seed: int) -> bool:
        """Whether what comes first begins a leap away, or what goes on from before leaps as that
        does not; not where a pose is known of it."""
        given = None if constraint is None else constraint(made, made + frames)
        if given is not None and bool(given.known[:, :ROOT_ROW].any()):
            return False
        piece = tried(passage, frames, seed, before[:0], alone=True)
        if is_apart(before, piece) and (passage.low or leaps(before[-1], piece[:1], fps)):
            return True
        joined = tried(passage, frames, seed, before)
        return leaps(before[-1], joined, fps) and (
            is_apart(before, piece) or not leaps(piece[0], piece, fps)
        )

    bridged = bridged and generator.network.motion_rows > ROOT_ROW
    for passage in passages:
        own = before[:0]  # what there is of the passage
        same = passage.text, passage.tag, passage.mirrored
        if shows == same and len(spare) >= passage.frames:
            piece, spare = spare[: passage.frames], spare[passage.frames :]
            before = torch.cat((before, piece))[-overlap:]
            made += len(piece)
            yield piece
            continue
        lucky: list[int] = []  # the seed of the repetition before
        widest = min(window, passage.window or window)
        new, said = (passage.text, passage.mirrored) != said, (passage.text, passage.mirrored)
        asked.clear()
        apart = new and stands(before, fps) and generator.begins_standing(passage.text)
        beyond = ahead if constraint is None and passage.miss is None else 0
        if bridges(passage) and new and len(before) and not apart:
            length, *_ = window_lengths(passage.frames, len(before), widest, overlap)
            apart = leapt(passage, length + beyond, next(seeds()))
        shared = before[:0] if apart else before
        if beyond and not new:
            beyond = max(beyond, widest - len(shared) - passage.frames)
        for length in window_lengths(passage.frames, len(shared), widest, overlap):
            noises = [*lucky, *seeds()]
            tries = (tried(passage, length + beyond, seed, shared) for seed in noises)
            piece, best = nearest_to_wanted(tries, own, passage.miss)
            lucky = [noises[best]] if passage.window else []
            if bridges(passage) and not len(shared) and len(before) and is_apart(before, piece):
                way, piece, left = way_to(
                    before, piece, length, fps, within=passage.timed is not None
                )
                made, length = made + length - left, left
                before = torch.cat((before, way))
                if told is not None:
                    told(len(way))
                yield way
            piece, spare, shows = piece[:length], piece[length:], same
            before = torch.cat((before, piece))[-overlap:]
            own = torch.cat((own, piece))
            made, number, shared = made + length, number + 1, before
            asked.clear()
            yield piece


def spanned_features(
    generator: TextToMotion,
    passages: Sequence[Passage],
    sampling: Sampling = DEFAULT_SAMPLING,
    *,
    constraint: ConstraintOf | None = None,
    window: int = WINDOW,
    overlap: int = OVERLAP,
) -> tuple[Tensor, list[tuple[int, int]]]:
    """Raw features [T, R, 6] of passages with the ways between them, and from where to where each
    passage goes; see `stream_features`."""
    pieces, begun, ways = list[Tensor](), list[int](), list[int]()

    def asked() -> Iterator[Passage]:
        for passage in passages:
            begun.append(sum(map(len, pieces)))
            ways.append(0)
            yield passage

    def gone(frames: int) -> None:
        ways[-1] = frames

    for piece in stream_features(
        generator,
        asked(),
        sampling,
        constraint=constraint,
        window=window,
        overlap=overlap,
        bridged=True,
        told=gone,
    ):
        pieces.append(piece)  # as it comes: `asked` counts them
    features = torch.cat(pieces)
    stops = [*begun[1:], len(features)]
    own = [
        0 if passage.timed is not None else way for passage, way in zip(passages, ways, strict=True)
    ]
    return features, [*zip(map(sum, zip(begun, own, strict=True)), stops, strict=True)]


def way_to(
    before: Tensor, piece: Tensor, length: int, fps: float, *, within: bool
) -> tuple[Tensor, Tensor, int]:
    """The way [t, R, 6] to a piece, the piece from where it ends on, and how many of the piece's
    `length` frames that leaves; `within` these, or beyond them. Who lies down on his knees does not
    stand up for it, unless the frames are counted."""
    if within:
        cut = min(len(bridge(before, piece, fps)), length // 2)
        return bridge(before, piece[cut:], fps, cut), piece[cut:], length - cut
    piece = piece[gone_down(before[-1], piece) :]
    return bridge(before, piece, fps), piece, min(length, len(piece))


def is_apart(before: Tensor, piece: Tensor) -> bool:
    """Whether a piece [t, R, 6] begins in another posture than the frames before it end in."""
    return posture(before[-1]) != posture(piece[0])


def stands(before: Tensor, fps: float) -> bool:
    """Whether these frames [t, R, 6] end with a body that stands still, hands hanging."""
    if len(before) < STILL:
        return False
    motion = decode_features(before[-STILL:], fps=fps)
    if not ends_at_rest(motion):
        return False
    place = motion.positions()[:, [JOINT_INDEX[name] for name in ("pelvis", "l_ankle", "r_ankle")]]
    return float(np.ptp(place, axis=0).max()) < MOVED


def met(before: Tensor, piece: Tensor, known: Tensor) -> Tensor:
    """A piece [t, R, 6] that begins as the frames `before` it end; what is `known` of it stays."""
    kept = torch.cat((torch.ones_like(before, dtype=torch.bool), known[: len(piece)]))
    return blend_boundaries(torch.cat((before, piece)), kept, fade=MEETING)[len(before) :]


def nearest_to_wanted(
    tries: Iterator[Tensor], own: Tensor, miss: Miss | None
) -> tuple[Tensor, int]:
    """The first piece [t, R, 6] that, after `own`, is what is wanted, or else the nearest to it;
    and which of the tries that was."""
    if miss is None:
        return next(tries), 0
    least, best, chosen = float("inf"), own, 0
    for place, piece in enumerate(tries):
        found = miss(torch.cat((own, piece)))
        if found < least:
            least, best, chosen = found, piece, place
        if least <= 0:
            break
    return best, chosen


def window_lengths(frames: int, known: int, window: int, overlap: int) -> list[int]:
    """New frames of each window of a passage: as few windows as do, nearly alike in length.

    Args:
        frames: of the passage.
        known: frames that its first window begins with.
        window: frames at most, known ones among them.
        overlap: known frames of the other windows.
    """
    number = 1 + max(0, -(-(frames + known - window) // (window - overlap)))
    total = frames + known + (number - 1) * overlap  # frames of all windows
    cuts = [total * index // number for index in range(number + 1)]
    shared = [known] + [overlap] * (number - 1)
    return [stop - start - own for (start, stop), own in zip(pairwise(cuts), shared, strict=True)]


def carried_on(before: Tensor, given: Constraint | None, frames: int) -> Constraint:
    """What is known of a window: its first frames, and whatever else is given.

    Raises:
        UsageError: `given` is not as long as the window.
    """
    rows = before.shape[1]
    known = Constraint.free(frames, rows) if given is None else given
    if len(known) != frames:
        raise UsageError(
            f"a constraint of {len(known)} frames was given where {frames} were asked"
            "; make it as long"
        )
    values, mask = known.values[:, :rows].clone(), known.known[:, :rows].clone()
    values[: len(before)] = before
    mask[: len(before)] = True
    shown = None if known.shown is None else known.shown[:, :rows].clone()
    if shown is not None:
        shown[: len(before)] = True
    return replace(known, values=values, known=mask, shown=shown)


def padded(given: Constraint, before: int, after: int) -> Constraint:
    """So many frames more on both sides, of which nothing is known; none where the number is below
    zero."""
    rows = given.values.shape[1:]
    ends = [Constraint.free(max(frames, 0), *rows) for frames in (before, after)]
    values, known = (
        torch.cat([getattr(each, name) for each in (ends[0], given, ends[1])])
        for name in ("values", "known")
    )
    shown = given.shown
    if shown is not None:
        shown = torch.cat((ends[0].known, shown, ends[1].known))
    return replace(given, values=values, known=known, shown=shown)


# ---------------------------------------------------------------- settled motion


@dataclass(frozen=True)
class Latency:
    """How far a stream is behind.

    Attributes:
        first: seconds of computing until the first piece was there; None before.
        lookahead: seconds of motion that must be made behind a frame before it settles.
        reaction: seconds of motion, at most, between what is seen and what a new text changes,
            if it is no way to another posture.
        load: seconds of computing for a second of motion, since the first piece; below 1 it is
            faster than real time. None before.
    """

    first: float | None
    lookahead: float
    reaction: float
    load: float | None


class MotionStream:
    """Motion without end, in pieces that follow each other, while prompts change.

        stream = MotionStream(generator, "a person walks forward")
        for piece in stream:
            show(piece)
            if tired:
                stream.say("a person sits down")

    Pieces stand where the ones before led to; what has been given out never changes. Joined, they
    are the same motion however they were cut.

    Args:
        generator: trained.
        prompts: one text, that goes on until `say` or `stop`; or any iterable of texts and
            passages, taken one by one, after which the stream ends.
        seconds: of a text that comes without a length. The shorter, the sooner a new one is heard.
        constraint: see `stream_features`.
        place: of the first frame; None = the origin, facing +Z.
        window, overlap: see `stream_features`.
        ahead: seconds made beyond that, which a new text drops.
        sampling: see `stream_features`.
        foot_lock: hold standing feet; None = the model's own setting.
        plan: what is done of one text that goes on; None = the text as it stands.

    Raises:
        UserError: while it runs, as `stream_features`.
    """

    def __init__(
        self,
        generator: TextToMotion,
        prompts: str | Iterable[str | Passage],
        *,
        seconds: float = 2.0,
        constraint: ConstraintOf | None = None,
        place: Place | None = None,
        window: int = WINDOW,
        overlap: int = OVERLAP,
        ahead: float = 0.0,
        sampling: Sampling = DEFAULT_SAMPLING,
        foot_lock: bool | None = None,
        plan: Plan | None = None,
    ) -> None:
        in_range("seconds", seconds, 1 / 30, 60.0)
        if isinstance(prompts, str) or not isinstance(prompts, Iterable):
            check_text("text", prompts)
        self._fps = generator.card.fps
        self._frames = round(seconds * self._fps)
        self._prompts = [] if isinstance(prompts, str) else prompts
        self._plan = plan or (lambda text: [Passage(text, self._frames)])
        self._now: tuple[str, str | None, Sequence[Passage]] | None = None  # said, tag, and done
        if isinstance(prompts, str):
            self.say(prompts)
        self._constraint, self._course = constraint, Course(self._fps)
        self._straight = False  # what was taken last
        self._post_processor = StreamingPostProcessor(
            generator.post_processor, place=place or Place(), foot_lock=foot_lock
        )
        self._pieces = stream_features(
            generator,
            self._passages(),
            sampling,
            constraint=constraint,
            window=window,
            overlap=overlap,
            ahead=round(ahead * self._fps),
            bridged=constraint is None,
        )
        self._texts: list[tuple[int, str]] = []  # first frames of passages
        self._made, self._shown, self._window = 0, 0, window - overlap
        self._first: float | None = None
        self._spent, self._given = 0.0, 0  # since the first piece: seconds, frames

    def say(self, text: str, *, tag: str | None = None) -> None:
        """What is shown from the next window on, in place of the text so far.

        Raises:
            UsageError: no text; the stream goes on as it was.
        """
        check_text("text", text)
        if self._now is not None and self._now[:2] == (text, tag):
            return  # it goes on
        self._now = text, tag, [replace(each, tag=tag) for each in self._plan(text)]

    def stop(self) -> None:
        """End after what is made already."""
        self._now = None

    def __iter__(self) -> Iterator[Motion]:
        """Pieces of one frame or more; see the class."""
        started = time.perf_counter()
        for features in self._pieces:
            start, self._made = self._made, self._made + len(features)
            features = self._course.add(features, kept=self._straight)
            given = None if self._constraint is None else self._constraint(start, self._made)
            piece = self._post_processor.add(features, None if given is None else given.known)
            if piece is not None:
                self._count(time.perf_counter() - started, piece.num_frames)
                yield self._labelled(piece)
                started = time.perf_counter()
        piece = self._post_processor.finish()
        if piece is not None:
            yield self._labelled(piece)

    def text_at(self, frame: int) -> str:
        """What a frame shows, counted from the first one; "" before there is any."""
        return next((text for start, text in reversed(self._texts) if start <= frame), "")

    def _labelled(self, piece: Motion) -> Motion:
        start, self._shown = self._shown, self._shown + piece.num_frames
        return replace(piece, text=self.text_at(start))

    @property
    def latency(self) -> Latency:
        """As measured so far."""
        lookahead = self._post_processor.lookahead / self._fps
        window = min(self._window, self._frames) / self._fps
        load = self._spent * self._fps / self._given if self._given else None
        return Latency(self._first, lookahead, lookahead + window, load)

    def _passages(self) -> Iterator[Passage]:
        for prompt in self._prompts:
            passage = Passage(prompt, self._frames) if isinstance(prompt, str) else prompt
            self._texts.append((self._made, passage.text))
            yield passage
        while (now := self._now) is not None:
            text, _, parts = now
            if self.text_at(self._made) != text:
                self._texts.append((self._made, text))
            for part in parts:
                left = math.inf if part is parts[-1] else part.frames
                self._straight = part.straight
                while left > 0 and self._now is now:
                    yield replace(part, frames=self._frames)
                    left -= self._frames

    def _count(self, seconds: float, frames: int) -> None:
        if self._first is None:
            self._first = seconds
        else:
            self._spent, self._given = self._spent + seconds, self._given + frames
