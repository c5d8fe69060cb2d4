"""Several texts, one motion: a timeline, and a motion that ends as it begins.

A timeline file (YAML or JSON) is a list of entries with text, start and end in seconds, and
optionally `parts`: joints or groups of joints that do something of their own while the body does
what the entries without parts say.

Letters: T frames, R rows (bones, root track), C channels.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ..config_loader import did_you_mean, parse_yaml
from ..errors import UsageError, UserError, has_words
from ..io.files import read_text
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import (
    FORWARD,
    LATERAL,
    ROOT_ROW,
    YAW_RATE,
    Place,
    integrate_root,
    motion_heading,
)
from ..motion.motion import Motion
from ..motion.postprocess.stitching import moved_to, place_of
from ..tensors import Tensor, torch
from .edit import ControlledMotion, all_but, chosen_joints, fill_free
from .stream import OVERLAP, WINDOW, ConstraintOf, Passage, stream_features

KEYS = ("text", "start", "end", "parts", "tag")
SHORTEST = 0.2  # seconds of an entry
LONGEST = 7200.0  # seconds of a timeline
SECONDS = 4.0  # of a text that comes without a length
SHORTEST_LOOP = 1.0  # seconds
MEANT = math.radians(45.0)  # of a round's turning: what is nearer to full circles is by chance
CREEP = 0.12  # m/s on average of a round: less is by chance, the slowest walk .4


@dataclass(frozen=True)
class Part:
    """What some joints do in frames [start, stop)."""

    text: str
    start: int
    stop: int
    joints: frozenset[str]


@dataclass(frozen=True)
class Timeline:
    """Passages one after another, and what single parts of the body do meanwhile.

    Attributes:
        timed: each takes its time, whatever it says of its length.
    """

    passages: tuple[Passage, ...]
    parts: tuple[Part, ...] = ()
    timed: bool = True

    @classmethod
    def of(
        cls,
        texts: Sequence[str],
        seconds: float | None = None,
        tags: Sequence[str | None] | None = None,
        *,
        fps: float = 30.0,
    ) -> "Timeline":
        """Texts one after another, so many seconds each that names no length; None = 4."""
        frames = round((SECONDS if seconds is None else seconds) * fps)
        pairs = zip(texts, tags or [None] * len(texts), strict=True)
        return cls(tuple(Passage(text, frames, tag) for text, tag in pairs), timed=False)

    @property
    def texts(self) -> list[str]:
        """All of them, those of single parts of the body too."""
        whole = [passage.text for passage in self.passages]
        return whole + [part.text for part in self.parts]

    @property
    def num_frames(self) -> int:
        return sum(passage.frames for passage in self.passages)

    @property
    def text(self) -> str:
        """All texts, as a caption."""
        return ", then ".join(passage.text for passage in self.passages)


# ---------------------------------------------------------------- reading


@dataclass(frozen=True)
class Entry:
    """One line of a file."""

    text: str
    start: float
    end: float
    parts: frozenset[str]
    tag: str | None


def read_timeline(path: str | Path, *, fps: float = 30.0) -> Timeline:
    """A timeline file; a gap between two entries belongs to the later one, which begins sooner.

    Raises:
        UserError: unreadable, a missing or unknown key, impossible or overlapping times.
        UsageError: no YAML or JSON, or an unknown joint.
    """
    path = Path(path)
    rows = parse_yaml(read_text(path, "a YAML or JSON file"), str(path))
    if not isinstance(rows, list) or not rows:
        raise UserError(f"{path}: holds no list; write entries - {{text: …, start: 0, end: 4}}")
    entries = [_entry(row, f"{path}: entry {number}") for number, row in enumerate(rows, start=1)]
    whole = sorted((entry for entry in entries if not entry.parts), key=lambda e: e.start)
    if not whole:
        raise UserError(f"{path}: every entry has parts; say what the body does, too")
    _check_overlaps(whole, path)
    parts = sorted((entry for entry in entries if entry.parts), key=lambda e: e.start)
    for part in parts:
        if part.end > whole[-1].end:
            raise UserError(
                f"{path}: {part.text!r} ends at {part.end:g} s, after the body's last entry"
                f" ({whole[-1].end:g} s); let it end sooner"
            )
    for joint in sorted(set().union(*(part.parts for part in parts))):
        _check_overlaps([part for part in parts if joint in part.parts], path, f" with its {joint}")
    return _timeline(whole, parts, fps)


def _entry(row: Any, where: str) -> Entry:
    if not isinstance(row, dict):
        raise UserError(f"{where} is {row!r}; write {{text: …, start: 0, end: 4}}")
    for key in row:
        if key not in KEYS:
            raise UserError(
                f"{where}: {key!r} is unknown; {did_you_mean(str(key), KEYS)}the keys are"
                f" {', '.join(KEYS)}"
            )
    text = " ".join(str(row.get("text") or "").split())
    if not has_words(text):
        raise UserError(
            f"{where} has no text of words; say what is done, e.g. text: a person waves"
        )
    start, end = (_seconds(row, key, where) for key in ("start", "end"))
    if end - start < SHORTEST - 1e-6:
        raise UserError(
            f"{where} ({text!r}) lasts from {start:g} to {end:g} s; give it {SHORTEST} s or more"
        )
    parts, tag = row.get("parts") or [], row.get("tag")
    names = [parts] if isinstance(parts, str) else parts
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise UserError(f"{where}: parts is {parts!r}; name joints or groups, e.g. [left-arm]")
    if tag is not None and not isinstance(tag, str):
        raise UserError(f"{where}: tag is {tag!r}, not a word; write one word")
    try:
        return Entry(text, start, end, frozenset(chosen_joints(names)), tag)
    except UsageError as error:
        raise UsageError(f"{where}: {error}") from None


def _seconds(row: dict[Any, Any], key: str, where: str) -> float:
    value = row.get(key)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not 0 <= float(str(value)) <= LONGEST:  # NaN is not in it either
        raise UserError(f"{where}: {key} is {value!r}; give seconds from 0 to {LONGEST:g}")
    return float(str(value))


def _check_overlaps(entries: Sequence[Entry], path: Path, what: str = "") -> None:
    for earlier, later in pairwise(entries):
        if later.start < earlier.end - 1e-6:
            raise UserError(
                f"{path}: {later.text!r} starts at {later.start:g} s{what}, before"
                f" {earlier.text!r} ends at {earlier.end:g} s; let them follow each other"
            )


def _timeline(whole: Sequence[Entry], parts: Sequence[Entry], fps: float) -> Timeline:
    stops = [round(entry.end * fps) for entry in whole]
    lengths = [stop - start for start, stop in pairwise([0, *stops])]
    return Timeline(
        tuple(
            Passage(entry.text, length, entry.tag)
            for entry, length in zip(whole, lengths, strict=True)
        ),
        tuple(
            Part(part.text, round(part.start * fps), round(part.end * fps), part.parts)
            for part in parts
        ),
    )


# ---------------------------------------------------------------- making


def make_timeline(
    generator: TextToMotion,
    timeline: Timeline,
    sampling: Sampling,
    *,
    constraint: ConstraintOf | None = None,
) -> Tensor:
    """Raw features [T,R,6] of all passages, then of the parts, one after the other.

    Raises:
        UserError: as `stream_features`.
    """
    pieces = _stream(generator, timeline.passages, sampling, constraint)
    return add_parts(generator, torch.cat(pieces), timeline.parts, sampling)


def add_parts(
    generator: TextToMotion, features: Tensor, parts: Sequence[Part], sampling: Sampling
) -> Tensor:
    """Features [T,R,6] in which some joints do what the parts say, and the rest stays."""
    for part in parts:
        known = all_but(features, part.start, part.stop, set(part.joints))
        features = fill_free(generator, part.text, known, sampling)
    return features


def make_loop(generator: TextToMotion, passages: Sequence[Passage], sampling: Sampling) -> Tensor:
    """Raw features [T,R,6] of a motion whose last frame leads into its first one.

    The last window knows both what goes before it and the first frames, which follow it.

    Raises:
        UserError: shorter than a second, or as `stream_features`.
    """
    frames = sum(passage.frames for passage in passages)
    if frames < SHORTEST_LOOP * generator.card.fps:
        seconds = frames / generator.card.fps
        raise UserError(
            f"a loop of {seconds:g} s is too short; ask for {SHORTEST_LOOP:g} s or more"
        )
    *earlier, last = passages
    closing = min(last.frames if earlier else frames // 2, WINDOW - 2 * OVERLAP)
    if last.frames > closing:
        earlier.append(Passage(last.text, last.frames - closing, last.tag))
    made = torch.cat(_stream(generator, earlier, sampling))
    shared = min(OVERLAP, len(made))
    ends = torch.cat((made[-shared:], torch.zeros(closing, *made.shape[1:]), made[:shared]))
    known = Constraint(ends, torch.ones(ends.shape, dtype=torch.bool))
    known.known[shared : shared + closing] = False
    (window,) = _stream(
        generator,
        [Passage(last.text, len(ends), last.tag)],
        sampling,
        lambda start, stop: known.window(start, stop),
    )
    return torch.cat((made, window[shared : shared + closing]))


def closed(features: Tensor, fps: float) -> Tensor:
    """A round [T,R,6] that turns by full circles, or as it did where it is far from one; and ends
    where it began, if it ended near that for its length."""
    features = features.clone()
    root = features[:, ROOT_ROW]
    turned = float(root[:, YAW_RATE].sum()) / fps
    miss = math.remainder(turned, 2 * math.pi)
    if abs(miss) < MEANT:
        root[:, YAW_RATE] -= miss * fps / len(root)
        path, heading = integrate_root(torch.cat((root, root[:1])), fps)
        away = path[-1] - path[0]
        if float(away.norm()) < CREEP * len(root) / fps:
            x, z = -away[0] * fps / len(root), -away[2] * fps / len(root)
            sine, cosine = torch.sin(heading[:-1]), torch.cos(heading[:-1])
            root[:, FORWARD] += x * sine + z * cosine
            root[:, LATERAL] += x * cosine - z * sine
    return features


def _stream(
    generator: TextToMotion,
    passages: Sequence[Passage],
    sampling: Sampling,
    constraint: ConstraintOf | None = None,
) -> list[Tensor]:
    return list(
        stream_features(
            generator,
            passages,
            constraint=constraint,
            sampling=sampling,
        )
    )


def in_a_loop(
    generator: TextToMotion,
    timeline: Timeline,
    sampling: Sampling,
    *,
    foot_lock: bool | None = None,
) -> ControlledMotion:
    """One motion whose end is its beginning, again and again: a round of N frames has a closing key
    behind them, where a player begins anew.

    Where it travels, each round goes on from where the last one led. A round that does not turn
    faces +Z on average.

    Returns:
        errors: see `join_error`; travel, turn: metres and degrees of one round.
    """
    features = closed(make_loop(generator, timeline.passages, sampling), generator.card.fps)
    features = add_parts(generator, features, timeline.parts, sampling)
    frames = len(features)
    rounds = generator.post_processor(
        torch.cat([features] * 3), None, text=timeline.text, foot_lock=foot_lock
    )
    before, after = place_of(rounds, frames), place_of(rounds, 2 * frames)
    errors = join_error(rounds, frames) | {
        "travel": float(np.hypot(after.x - before.x, after.z - before.z)),
        "turn": float(np.degrees(after.heading - before.heading)),
    }
    once = rounds.frames(frames, 2 * frames + 1)
    heading, start = motion_heading(once), Place()
    if math.radians(abs(errors["turn"])) < MEANT:
        start = Place(heading=float(heading[0] - heading[:-1].mean()))
    return ControlledMotion(moved_to(once, start), errors)


def join_error(rounds: Motion, frames: int) -> dict[str, float]:
    """What is seen where a second round meets the first.

    Args:
        rounds: two or more, one after the other.
        frames: of one round.

    Returns:
        join_acceleration: m/s², the largest of any joint within two frames of the join;
        p99_acceleration: 99th percentile of each frame's largest, elsewhere.
    """
    positions = rounds.positions()[: 2 * frames].astype(np.float64)
    sizes = np.linalg.norm(np.diff(positions, 2, axis=0), axis=-1).max(1) * rounds.fps**2
    near = np.zeros(len(sizes), dtype=bool)
    near[frames - 4 : frames + 2] = True
    return {
        "join_acceleration": float(sizes[near].max()),
        "p99_acceleration": float(np.percentile(sizes[~near], 99)),
    }
