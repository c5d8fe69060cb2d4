"""Figures laid on the counts of a song: a body that dances what was recorded.

Each figure is warped so that its counts fall on the song's; neighbours fade into each other while
both are moving, one foot standing, the other stepping. Where nobody dances the text branch fills in
a body that stands. Then the root is pulled softly to the middle of the stage and the feet are held.
Seams filled by the text branch were measured and are rougher (docs/experiments.md).

Letters: T frames, S slots.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from string import ascii_lowercase
from typing import Any

import numpy as np
import torch
from scipy.interpolate import PchipInterpolator
from torch import Tensor

from ..memory.figures import FPS, FigureMemory, Figures
from ..metrics.rhythm import motion_beats
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import Progress, TextToMotion
from ..motion.features import (
    FORWARD,
    LATERAL,
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    mirror_features,
    world_joints,
)
from ..motion.motion import Danced, Motion
from ..motion.postprocess.whole import hanging_arms
from ..motion.rotations import (
    matrix_to_quaternion,
    matrix_to_rotation_6d,
    quaternion_continuous,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
)
from ..motion.skeleton import JOINT_INDEX, LIMBS, NUM_JOINTS
from ..motion.staging import carried, resampled, settled, staged, stepped, stopping
from .body import PELVIS
from .choreography import Choreographer, Wish
from .edit import fill_free
from .song import PACE, Slot, SongCondition

BLEND = 0.3  # seconds either side of a seam
STAND = "a person stands still"  # where nobody dances
REACH, HASTE = 0.2, 0.35  # seconds by which a beat of the body is moved; of the pace, for that
ACCENT, MARKED = 0.2, 0.1  # of the pace; seconds from a beat of the body to one of the song
MOST_ACCENT = 1.8  # times that, on beats so much longer than a count: as hard to brake
ENDING = 2  # counts in which the last figure comes to rest
CHOSEN = 0.9  # of the work, about, is to choose figures
LEGS = (*LIMBS["left-leg"], *LIMBS["right-leg"])
STEPPING = [PELVIS, *(JOINT_INDEX[joint] for joint in LEGS), ROOT_ROW]
DROP = 30  # frames in which arms come down, and go up again
LONG, LAST = 10, 60  # frames; for less the pose is held, and at the end of all


class FigureDancer:
    """Dances figures to songs.

    Args:
        choreographer: chooses them.
        generator: fills in a body that stands where nobody dances, and finishes the motion.
        at_random: draw figures that fit instead of choosing; what choosing is measured against.
    """

    def __init__(
        self, choreographer: Choreographer, generator: TextToMotion, *, at_random: bool = False
    ) -> None:
        self.choreographer, self.generator = choreographer, generator
        self._choose = choreographer.draw if at_random else choreographer.choose

    def dance(
        self,
        song: SongCondition,
        wish: Wish,
        *,
        text: str = "",
        sampling: Sampling,
        foot_lock: bool | None = None,
        progress: Progress | None = None,
    ) -> tuple[Motion, tuple[Danced, ...]] | None:
        """A body that dances figures, T frames; None where none fits the song and the wish.

        Args:
            song: with beats.
            wish: of the sentence.
            text: the caption.
            sampling: its seed decides everything; the rest is how a standing body is made.
            foot_lock: hold standing feet; None = the model's own setting.
            progress: told the frames done of T while figures are chosen, up to `CHOSEN` of them.

        Raises:
            UserError: as `TextToMotion.sample_features`.
        """
        found = self._laid(song, wish, sampling.seed, progress)
        if found is None:
            return None
        slots, chosen, features, danced = found
        last = slots[-1].counts
        features = carried(features, wish.manner, FPS)
        features[:, ROOT_ROW] = staged(features[:, ROOT_ROW], FPS, float(last[-1]), danced)
        features = settled(features, last[-1], last[-1] - last[-1 - ENDING])
        if wish.manner.stops:
            counts = np.unique(np.concatenate([slot.counts for slot in slots]).round(6))
            features = stopping(features, counts, wish.manner.stops)
        features = self._standing(features, danced, sampling)
        motion = self.generator.post_processor(features, None, text=text, foot_lock=foot_lock)
        return motion, told(self.choreographer, slots, chosen)

    def plan(
        self, song: SongCondition, wish: Wish, seed: int, where: Tensor, seen: Tensor
    ) -> tuple[Constraint, tuple[Danced, ...]] | None:
        """Steps of figures on a song of T frames, for a body whose trunk, head and arms are made of
        words: root rows, pelvis and legs are known; and those figures. None where no figure fits or
        falls there.

        Args:
            song, wish: see `dance`.
            seed: with them it decides everything.
            where: frames [T] bool that dance.
            seen: frames [T] bool in which the network is shown legs, too: it makes a dance of
                what it sees, whatever the words say.
        """
        found = self._laid(song, wish, seed)
        if found is None:
            return None
        slots, chosen, features, danced = found
        begin, end = (int(torch.nonzero(danced)[each]) for each in (0, -1))
        if begin < LAST:
            danced[:begin] = True  # in the pose of the first count
        if len(danced) - end - 1 < LAST:
            danced[end + 1 :] = True  # in that of the last one
        known = torch.zeros(features.shape, dtype=torch.bool)
        known[:, STEPPING] = (danced & where)[:, None, None]
        if not known.any():
            return None
        shown = known & seen[:, None, None]
        shown[:, ROOT_ROW] = known[:, ROOT_ROW]
        figures = (
            replace(figure, steps=True)
            for figure in told(self.choreographer, slots, chosen)
            if known[int(figure.start * FPS) : int(figure.stop * FPS), ROOT_ROW].any()
        )
        return Constraint(features, known, shown=shown), tuple(figures)

    def _laid(
        self, song: SongCondition, wish: Wish, seed: int, progress: Progress | None = None
    ) -> tuple[Sequence[Slot], Sequence[Figures], Tensor, Tensor] | None:
        """The phrases of a song, a figure for each, and both of `lay`, its beats on the song's."""
        slots = self.choreographer.parted(song.slots(), wish)
        frames = song.condition.shape[1]

        def told_of(done: int, total: int) -> None:
            if progress is not None:
                progress(int(CHOSEN * frames * done / total), frames)

        chosen = self._choose(slots, wish, seed, told_of) if slots else None
        if chosen is None:
            return None
        features, danced = lay(self.choreographer.memory, slots, chosen, frames)
        joins = [later.counts[0] for slot, later in pairwise(slots) if _adjacent(slot, later)]
        features = stepped(features, [round(float(seam) * FPS) for seam in joins], FPS)
        for _ in range(2):  # what is moved shows other beats
            features = on_beats(features, song.beats)
        return slots, chosen, accented(features, song.beats), danced

    def _standing(self, features: Tensor, danced: Tensor, sampling: Sampling) -> Tensor:
        """Features [T,23,6] in which the text branch fills in what no figure has; where that is
        long, arms hang."""
        edges = np.flatnonzero(np.diff((~danced).numpy().astype(int), prepend=0, append=0))
        for start, stop in edges.reshape(-1, 2).tolist():
            if stop - start < (LAST if stop == len(features) else LONG):
                continue
            known = torch.ones(features.shape, dtype=torch.bool)
            known[start:stop] = False
            first, last = start + DROP * (start > 0), stop - DROP * (stop < len(features))
            if last > first:
                features = features.clone()
                for joint, row in hanging_arms().items():
                    features[first:last, joint], known[first:last, joint] = row, True
            features = fill_free(self.generator, STAND, Constraint(features, known), sampling)
        return features


def named(memory: FigureMemory, figure: Figures, row: int = 0) -> str:
    """The take of a figure, and the second at which it begins there."""
    number = int(figure.take[row])
    start = float(figure.times[row, 0]) - memory.bounds(number)[0] / FPS
    return f"{memory.takes[number].name}@{start:.1f}"


def listed(choreographer: Choreographer, wish: Wish, counts: int = 8) -> list[dict[str, Any]]:
    """The figures that a wish allows, the clearest first, mirror images apart."""
    found, memory = choreographer.allowed(counts, wish)[0], choreographer.memory
    if not len(found):  # of short takes alone
        found = choreographer.allowed(counts := counts // 2, wish)[0]
    rows = [row for row in np.argsort(-found.clear).tolist() if not found.mirrored[row]]
    return [
        {
            "name": named(memory, found, row),
            "kind": memory.takes[int(found.take[row])].kind,
            "counts": counts,
            "bpm": round(60 / float(found.count[row]), 1),
            "energy": round(float(found.energy[row]), 3),
            "travel": [round(float(way), 2) for way in found.travel[row]],
            "turn": round(float(np.degrees(found.turn[row])), 1),
            "source": memory.takes[int(found.take[row])].source,
            "licence": memory.takes[int(found.take[row])].licence,
        }
        for row in rows
    ]


def told(
    choreographer: Choreographer, slots: Sequence[Slot], chosen: Sequence[Figures]
) -> tuple[Danced, ...]:
    """What is danced when. Its letters are those of what came, not of the form that was wished."""
    found: list[Danced] = []
    first: dict[str, tuple[str, bool]] = {}  # letter of a phrase, and whether it was mirrored
    for slot, figure in zip(slots, chosen, strict=True):
        name, mirrored = named(choreographer.memory, figure), bool(figure.mirrored[0])
        again, number = divmod(len(first), len(ascii_lowercase))
        letter, side = first.setdefault(
            name, (ascii_lowercase[number] + str(again or ""), mirrored)
        )
        found.append(
            Danced(
                name=name,
                kind=choreographer.memory.takes[int(figure.take[0])].kind,
                times=tuple(slot.counts.tolist()),
                mirrored=mirrored,
                part=letter + "'" * (mirrored != side),
            )
        )
    return tuple(found)


def lay(
    memory: FigureMemory,
    slots: Sequence[Slot],
    chosen: Sequence[Figures],
    frames: int,
    *,
    blend: float = BLEND,
) -> tuple[Tensor, Tensor]:
    """Figures on the counts of a song, one fading into the next.

    Args:
        memory: of the figures.
        slots: S ≥ 1.
        chosen: a figure of one row for each.
        frames: T.
        blend: seconds either side of a seam in which both are seen.

    Returns:
        Raw features [T,23,6], and which frames [T] bool belong to a figure; a frame of none repeats
        the nearest one at rest.
    """
    time = torch.arange(frames, dtype=torch.float64) / FPS
    root = torch.zeros(frames, 6)
    turns = torch.zeros(frames, NUM_JOINTS, 4)  # halfway between far poses 6D rows all but vanish
    weights, contacts = torch.zeros(frames), torch.zeros(frames, 2)
    danced = torch.zeros(frames, dtype=torch.bool)
    for index, (slot, figure) in enumerate(zip(slots, chosen, strict=True)):
        start, stop = float(slot.counts[0]), float(slot.counts[-1])
        joined = [
            index > 0 and _adjacent(slots[index - 1], slot),
            index + 1 < len(slots) and _adjacent(slot, slots[index + 1]),
        ]
        weight = torch.ones(frames, dtype=torch.float64)
        for seam, is_joined, sign in ((start, joined[0], 1.0), (stop, joined[1], -1.0)):
            share = ((time - seam) * sign / blend + 1) / 2
            x = share.clamp(0, 1) if is_joined else (sign * (time - seam) >= -1e-9).double()
            weight *= x**3 * (x * (6 * x - 15) + 10)
        weight = weight.float()
        own = torch.nonzero(weight > 0)[:, 0]
        if not len(own):
            continue
        features = _warped(memory, figure, slot.counts, time[own].numpy())
        part = weight[own]
        root[own] += part[:, None] * features[:, ROOT_ROW]
        quaternions = quaternion_continuous(
            matrix_to_quaternion(rotation_6d_to_matrix(features[:, :NUM_JOINTS])), dim=0
        )
        # One way round for all of a seam: the nearer one may change where poses are far apart.
        side = (quaternions * turns[own]).sum((0, -1), keepdim=True)
        share = (part / (weights[own] + part))[:, None, None]
        turns[own] = blended(turns[own], torch.where(side < 0, -quaternions, quaternions), share)
        foremost = part >= 0.5  # a foot stands or not
        contacts[own[foremost]] = features[foremost, ROOT_ROW, LEFT_CONTACT:]
        weights[own] += part
        danced[own] = True
    root = root / weights.clamp_min(1e-6)[:, None]
    root[:, LEFT_CONTACT:] = contacts
    turns[~danced, :, 0] = 1.0
    rotations = quaternion_to_matrix(turns)
    features = torch.cat((matrix_to_rotation_6d(rotations), root[:, None]), 1)
    return _held(features, danced), danced


def _adjacent(slot: Slot, later: Slot) -> bool:
    """Whether one phrase begins where the other ends."""
    return abs(float(slot.counts[-1] - later.counts[0])) < 1e-6


def blended(first: Tensor, second: Tensor, share: Tensor) -> Tensor:
    """Unit quaternions [...,4] at a share [...,1] of the arc between two, as they are signed
    (Shoemake 1985); one of zeros gives way to the other."""
    angle = torch.acos((first * second).sum(-1, keepdim=True).clamp(-0.9999, 0.9999))
    mixed = torch.sin((1 - share) * angle) * first + torch.sin(share * angle) * second
    return torch.nn.functional.normalize(mixed, dim=-1)


def _warped(memory: FigureMemory, figure: Figures, counts: np.ndarray, time: np.ndarray) -> Tensor:
    """Features [t,23,6] of one figure at seconds [t] of a song, its counts on the song's."""
    first, last = memory.bounds(int(figure.take[0]))
    warp = PchipInterpolator(counts, figure.times[0])
    speed = warp.derivative()
    inside = np.clip(time, counts[0], counts[-1])
    at = warp(inside) + (time - inside) * np.where(time < inside, speed(counts[0]), 1.0)
    late = time > counts[-1]
    at[late] = warp(counts[-1]) + (time[late] - counts[-1]) * float(speed(counts[-1]))
    rate = speed(inside)
    frame = at * FPS
    held = np.clip(frame, first, last - 2)
    features = resampled(memory.features, held, np.where(held == frame, rate, 0.0))
    return mirror_features(features) if figure.mirrored[0] else features


def on_beats(features: Tensor, beats: np.ndarray) -> Tensor:
    """Features [T,23,6] whose motion is a little earlier or later, where that brings its own beats
    to those of the song.

    Args:
        features: of a dance.
        beats: seconds [M] of the song, ascending, M ≥ 1.
    """
    own, end = motion_beats(world_joints(features, FPS).numpy(), FPS).times, len(features) - 1.0
    wanted = beats[np.abs(own[:, None] - beats).argmin(1)]
    near = np.abs(own - wanted) < REACH
    knots = [(0.0, 0.0), *zip(wanted[near] * FPS, own[near] * FPS, strict=True), (end, end)]
    while True:
        to, at = np.array(knots).T
        rates = np.diff(at) / np.maximum(np.diff(to), 1e-6)
        wrong = np.flatnonzero(np.abs(np.log(rates)) > np.log(1 + HASTE))
        if not len(wrong):
            break
        pair = [knot for knot in (wrong[0], wrong[0] + 1) if 0 < knot < len(knots) - 1]
        del knots[max(pair, key=lambda knot: abs(to[knot] - at[knot]))]
    warp = PchipInterpolator(to, at)
    time = np.arange(len(features))
    return resampled(features, np.clip(warp(time), 0, end), warp.derivative()(time))


def accented(features: Tensor, beats: np.ndarray) -> Tensor:
    """Features [T,23,6] that slow down on those beats of a song that nothing marks.

    Args:
        features: of a dance.
        beats: seconds [M] of the song, ascending, M ≥ 1.
    """
    own = motion_beats(world_joints(features, FPS).numpy(), FPS).times
    bare = np.abs(own[:, None] - beats).min(0, initial=np.inf) > MARKED
    time, end = np.arange(len(features)) / FPS, len(features) - 1.0
    late = np.zeros(len(features))  # seconds
    for index in np.flatnonzero(bare[1:-1]) + 1:
        before, at, after = beats[index - 1 : index + 2]
        beat = np.where(time < at, at - before, after - at)
        x = (time - at) / beat
        share = ACCENT * np.clip(beat / PACE, 1.0, MOST_ACCENT)
        late += np.where(np.abs(x) < 0.5, share * beat * np.sin(2 * np.pi * x) / (2 * np.pi), 0.0)
    shown = np.clip((time - late) * FPS, 0, end)
    return resampled(features, shown, np.gradient(shown))


def _held(features: Tensor, danced: Tensor) -> Tensor:
    """Features in which frames that no figure has repeat the nearest one, at rest."""
    known = torch.nonzero(danced)[:, 0]
    if not len(known) or len(known) == len(features):
        return features
    frames = torch.arange(len(features))
    right = torch.searchsorted(known, frames).clamp(max=len(known) - 1)
    left = (right - 1).clamp_min(0)
    nearer = (frames - known[left]).abs() <= (known[right] - frames).abs()
    source = torch.where(nearer, known[left], known[right])
    result, rest = features[source].clone(), torch.nonzero(~danced)[:, 0]
    for channel in (FORWARD, LATERAL, YAW_RATE):
        result[rest, ROOT_ROW, channel] = 0.0
    return result
