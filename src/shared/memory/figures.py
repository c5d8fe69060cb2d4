"""Figures of dance: recorded takes with their counts, cut into phrases of any number of counts.

A figure is a stretch of a take from one count to another, as it is or mirrored: where it starts and
ends, how fast its counts are, how much it moves, where it leads and how far it turns, on which feet
it begins and ends. Takes are kept whole, so that a figure can be entered and left while it is still
moving. Slow takes are counted twice as fast as well: a reading more.

Letters: F frames of all takes, T frames, N figures, K joints, C counts.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np
import torch
from scipy.ndimage import percentile_filter
from torch import Tensor

from ..errors import UserError
from ..io.arrays import BadArray, load_arrays, write_arrays
from ..io.files import load_json, write_json
from ..io.storage import Place, place
from ..metrics.rhythm import body_beats, landings, motion_beats, rhythm_f
from ..metrics.stage import HOVER_SECONDS, aloft, sliding, torn
from ..motion.features import (
    HEIGHT,
    LEFT_CONTACT,
    ROOT_ROW,
    encode_features,
    heading_joints,
    integrate_root,
    motion_heading,
)
from ..motion.filters import smoothed
from ..motion.motion import Motion, resample_motion
from ..motion.postprocess.contacts import detect_contacts
from ..motion.rotations import (
    matrix_to_quaternion,
    quaternion_multiply,
    rotation_6d_to_matrix,
    yaw_quaternion,
)
from ..motion.skeleton import JOINT_INDEX, MIRROR, NUM_JOINTS, REST_FOOT_HEIGHT

KIND = "figures"
CARD, TAKES = "figures.json", "figures.npz"
SHIPPED = Path(__file__).resolve().parent / "shipped"
FPS = 30.0
TURN_STEPS, PLACE_STEPS = 4096.0, 5000.0  # of a quaternion's parts, and of a metre or a radian
SLOW = 0.55  # seconds; longer counts are read as two as well
FLOOR_SECONDS, FLOOR_SHARE = 3.0, 20  # in which somebody stands for that percentage
HOVERS = 0.5 * HOVER_SECONDS * FPS  # frames: a song may be slower than the take
NEARLY, HOVERS_NEARLY = 0.02, 10  # metres lower, frames: where a recorded floor drifts
MIN_COUNTS = 5  # of a take
BESIDE = 9  # frames around a figure that are seen while it fades
STILL = 0.12  # m/s, mean of all joints over half a second: nobody dances
SNAP_PART, APART = 0.3, 0.6  # of a count: to a beat of the motion at most, and its least length
AXES = 16  # of poses, along which the dimensions of a dance are counted
SIGHTS, EVERY = 800, 15  # typical poses, and frames between those that are looked at for them
WEIGHTS = np.ones(NUM_JOINTS)  # of joints in the cost of a join
WEIGHTS[[JOINT_INDEX[f"{side}_{name}"] for side in "lr" for name in ("ankle", "foot", "wrist")]] = 2


@dataclass(frozen=True, eq=False)
class Take:
    """A recording of dance.

    Attributes:
        name: of the file.
        kind: what is danced, a word or a few.
        source, licence: whose it is, and what may be done with it.
        motion: T frames at 30 a second.
        counts: seconds [C].
        meter: counts of a bar, which the first of all opens; 0 = nobody knows.
    """

    name: str
    kind: str
    source: str
    licence: str
    motion: Motion
    counts: np.ndarray
    meter: int = 0

    @classmethod
    def of(cls, motion: Motion, name: str, kind: str, source: str = "", licence: str = "") -> Self:
        """With the counts that its motion shows; brought to 30 frames a second and the floor."""
        motion = on_floor(resample_motion(motion, FPS))
        return cls(name, kind, source, licence, motion, find_counts(motion))

    @property
    def is_dance(self) -> bool:
        """Whether it has enough counts to hold figures."""
        return len(self.counts) >= MIN_COUNTS


@dataclass(frozen=True, eq=False)
class Figures:
    """N phrases of n counts; row i of each belongs together.

    Attributes:
        take: number of the take [N].
        times: seconds of the counts in the frames of all takes [N,n+1].
        mirrored: bool [N].
        number: which count of which reading it begins with [N]; neighbours differ by 1.
        meter: counts of a bar, which it begins with [N]; 0 = nobody knows.
        energy: mean speed of the joints, m/s [N].
        clear: how well what it shows falls on its counts, 0 to 1 [N]; `rhythm`'s F.
        clear_beats: the same on every second count, from the first [N].
        low: lowest height of the pelvis, metres [N].
        slide: share of the time in which both feet slide [N].
        back: metres gone backward [N].
        travel, far: where it ends, and gets furthest, to the left and forward of the heading at
            entry, metres [N,2].
        turn: radians to the left [N].
        shown: which of the memory's typical poses it shows, bool [N,V].
        spread: sums over its frames of products of what its poses are along the memory's main
            axes, and 1 [N,A+1,A+1].
        entry, leave: poses and velocities at the first and the last count [N,E].
    """

    take: np.ndarray
    times: np.ndarray
    mirrored: np.ndarray
    number: np.ndarray
    meter: np.ndarray
    energy: np.ndarray
    clear: np.ndarray
    clear_beats: np.ndarray
    low: np.ndarray
    slide: np.ndarray
    back: np.ndarray
    travel: np.ndarray
    far: np.ndarray
    turn: np.ndarray
    shown: np.ndarray
    spread: np.ndarray
    entry: np.ndarray
    leave: np.ndarray

    def __len__(self) -> int:
        return len(self.take)

    @property
    def count(self) -> np.ndarray:
        """Seconds of a count, mean of each figure [N]."""
        return np.asarray((self.times[:, -1] - self.times[:, 0]) / (self.times.shape[1] - 1))

    def rows(self, index: np.ndarray) -> "Figures":
        """The figures at these rows, in this order."""
        return Figures(**{name: values[index] for name, values in vars(self).items()})


class FigureMemory:
    """Takes of dance, and the figures in them.

    Args:
        takes: one or more, 30 frames a second.

    Raises:
        UserError: no take has five counts.
    """

    def __init__(self, takes: list[Take]) -> None:
        self.takes = [take for take in takes if take.is_dance]
        if not self.takes:
            raise UserError(
                f"no dance in {len(takes)} motions: none has five counts; give longer takes"
            )
        lengths = [take.motion.num_frames for take in self.takes]
        self.offsets = np.concatenate(([0], np.cumsum(lengths)))

    # ------------------------------------------------------------ of every frame

    @cached_property
    def features(self) -> Tensor:
        """Raw features [F,23,6]."""
        return encode_features(*(take.motion for take in self.takes))

    @cached_property
    def poses(self) -> np.ndarray:
        """Joints [F,K,3] over the origin in the frame of the heading, metres."""
        rotations = rotation_6d_to_matrix(self.features[:, :NUM_JOINTS])
        return np.asarray(heading_joints(rotations, self.features[:, ROOT_ROW, HEIGHT]).numpy())

    @cached_property
    def _joints(self) -> np.ndarray:
        """Joints in the world [F,K,3], metres."""
        motions = [take.motion for take in self.takes]
        quaternions = np.concatenate([each.quaternions for each in motions])
        roots = np.concatenate([each.root_position for each in motions])
        return Motion(quaternions, roots, np.zeros((len(roots), 2), np.float32)).positions()

    @cached_property
    def _along(self) -> np.ndarray:
        """Poses and their mirror images along the main axes of all of them, and 1 [2,F,A+1]."""
        poses = self.poses.astype(np.float32)
        both = np.stack((poses, poses[:, list(MIRROR)] * np.array([-1, 1, 1], np.float32)))
        sides = both.reshape(2, len(poses), -1)
        some = sides[:, ::EVERY].reshape(-1, sides.shape[-1])
        axes = np.linalg.svd(some - some.mean(0), full_matrices=False)[2][:AXES]
        along = (sides - some.mean(0)) @ axes.T
        return np.concatenate((along, np.ones((*along.shape[:2], 1), np.float32)), -1)

    @cached_property
    def _typical(self) -> np.ndarray:
        """The typical pose that each pose and its mirror image is nearest to [2,F]: each typical
        one is the furthest from all before it."""
        sides = self._along[..., :-1]
        some = sides[:, ::EVERY].reshape(-1, AXES)
        away, chosen = np.full(len(some), np.inf, np.float32), [0]
        for _ in range(min(SIGHTS, len(some)) - 1):
            away = np.minimum(away, ((some - some[chosen[-1]]) ** 2).sum(1))
            chosen.append(int(away.argmax()))
        typical = some[chosen]
        return np.asarray(((typical**2).sum(1) - 2 * sides @ typical.T).argmin(-1))

    @cached_property
    def _aloft(self) -> list[tuple[int, int]]:
        """Where nothing of a body is near the floor for long, or nearly so for longer."""
        nearly = aloft(self._joints + np.array([0.0, NEARLY, 0.0]))
        runs = [run for run in nearly if run[1] - run[0] > HOVERS_NEARLY]
        return runs + [run for run in aloft(self._joints) if run[1] - run[0] > HOVERS]

    @cached_property
    def _torn(self) -> np.ndarray:
        """Frames [G] in which a joint jumps, or goes to and fro."""
        change = np.diff(self._joints, 2, axis=0) * FPS**2  # F-2 22 3
        change[np.r_[self.offsets[1:-1] - 2, self.offsets[1:-1] - 1]] = 0.0  # from take to take
        return np.flatnonzero(torn(change)) + 1

    @cached_property
    def speed(self) -> np.ndarray:
        """Mean speed of the joints in the world, m/s [F]; 0 in the last frame of a take."""
        steps = np.linalg.norm(np.diff(self._joints, axis=0, append=self._joints[-1:]), axis=-1)
        speed = steps.mean(1) * FPS
        speed[self.offsets[1:] - 1] = 0.0
        return np.asarray(speed)

    @cached_property
    def _path(self) -> tuple[np.ndarray, np.ndarray]:
        """Place [F,2] and heading [F] of each take from where it begins."""
        places, facing = [], []
        for start, stop in zip(self.offsets[:-1], self.offsets[1:], strict=True):
            path, heading = integrate_root(self.features[start:stop, ROOT_ROW].double(), FPS)
            places.append(path[:, [0, 2]].numpy())
            facing.append(heading.numpy())
        return np.concatenate(places), np.concatenate(facing)

    @cached_property
    def _back(self) -> np.ndarray:
        """Metres gone backward from each frame to the next [F]."""
        places, heading = self._path
        step = np.diff(places, axis=0, append=places[-1:])
        step[self.offsets[1:] - 1] = 0.0
        return np.asarray(np.maximum(-_seen_from(step, heading)[:, 1], 0.0))

    def bounds(self, take: int) -> tuple[int, int]:
        """First and past-the-last frame of a take."""
        return int(self.offsets[take]), int(self.offsets[take + 1])

    # ------------------------------------------------------------ figures

    def readings(self) -> list[tuple[int, np.ndarray]]:
        """Takes and seconds of their counts from the first frame of all.

        Slow ones are counted twice as fast as well, and short ones, which hold few counts of any
        pace, at several: so some of them fits any song.
        """
        found = []
        for number, take in enumerate(self.takes):
            start, paces = self.offsets[number] / FPS, [take.counts]
            if not take.meter:
                if np.median(np.diff(take.counts)) > SLOW:
                    middles = (take.counts[1:] + take.counts[:-1]) / 2
                    paces.append(np.sort(np.concatenate((take.counts, middles))))
                if take.motion.seconds < SHORT:
                    evidence = _evidence(self._beats[number], landings(take.motion), take.motion)
                    known = [float(np.median(np.diff(counts))) for counts in paces]
                    for pace in PACES:
                        if np.abs(np.log(np.divide(known, pace))).min() > 0.1:
                            paces.append(_chain(evidence, pace * GRID) / GRID)
                paces = [_snapped(each, self._beats[number]) for each in paces]
            found += [(number, counts + start) for counts in paces]
        return found

    @cached_property
    def _beats(self) -> list[np.ndarray]:
        """Beats of the motion of each take, seconds: as prominent in all of them."""
        beats, offsets = motion_beats(self._joints, FPS).times, self.offsets / FPS
        parts = np.split(beats, np.searchsorted(beats, offsets[1:-1]))
        return [part - start for part, start in zip(parts, offsets, strict=False)]

    def figures(self, counts: int) -> Figures:
        """All phrases of so many counts in which somebody dances, and their mirror images."""
        rows, take, number, before = [], [], [], 0
        for which, moments in self.readings():
            for begin in range(0, len(moments) - counts, self.takes[which].meter or 1):
                rows.append(moments[begin : begin + counts + 1])
                take.append(which)
                number.append(before + begin)
            before += len(moments) + 1000  # neighbours of different takes are no neighbours
        times, takes = np.array(rows).reshape(-1, counts + 1), np.array(take, dtype=int)
        first = np.rint(times[:, 0] * FPS).astype(int)
        last = np.minimum(np.rint(times[:, -1] * FPS).astype(int), self.offsets[takes + 1] - 2)
        spans = list(zip(first.tolist(), last.tolist(), strict=True))
        places, heading = self._path
        away = [np.linalg.norm(places[a : b + 1] - places[a], axis=1).argmax() for a, b in spans]
        ends, furthest = (
            _seen_from(places[to] - places[first], heading[first]) for to in (last, first + away)
        )
        low = [float(self.features[a:b, ROOT_ROW, HEIGHT].min()) for a, b in spans]
        slides = sliding(self._joints, FPS)
        own = Figures(
            take=takes,
            times=times,
            mirrored=np.zeros(len(takes), dtype=bool),
            number=np.array(number, dtype=int),
            meter=np.array([take.meter for take in self.takes])[takes],
            energy=np.array([self.speed[a:b].mean() for a, b in spans]),
            clear=self._clear(takes, times),
            clear_beats=self._clear(takes, times, 2),
            low=np.array(low),
            slide=np.array([slides[a:b].mean() for a, b in spans]),
            back=np.array([self._back[a:b].sum() for a, b in spans]),
            travel=ends,
            far=furthest,
            turn=heading[last] - heading[first],
            shown=self._shown(self._typical[0], spans),
            spread=self._spread(self._along[0], spans),
            entry=self._seen(first),
            leave=self._seen(last),
        )
        dances = [row for row, (start, stop) in enumerate(spans) if self._dances(start, stop)]
        danced = [spans[row] for row in dances]
        shown = self._shown(self._typical[1], danced)
        own = own.rows(np.array(dances, dtype=int))
        return _with_mirrors(own, shown, self._spread(self._along[1], danced))

    def _clear(self, take: np.ndarray, times: np.ndarray, every: int = 1) -> np.ndarray:
        """F of the motion's beats on the counts of each figure [N], or on each so many-th."""
        found = []
        for which, counts in zip(take, times, strict=True):
            start, stop = float(counts[0]), float(counts[-1])
            own = self._beats[which] + self.offsets[which] / FPS - start
            found.append(rhythm_f(own, counts[::every] - start, stop - start))
        return np.array(found)

    @staticmethod
    def _shown(typical: np.ndarray, spans: list[tuple[int, int]]) -> np.ndarray:
        found = np.zeros((len(spans), SIGHTS), dtype=bool)
        for row, (first, last) in enumerate(spans):
            found[row, typical[first : last + 1]] = True
        return found

    @staticmethod
    def _spread(along: np.ndarray, spans: list[tuple[int, int]]) -> np.ndarray:
        width = along.shape[-1]
        found = [along[a : b + 1].T @ along[a : b + 1] for a, b in spans]
        return np.array(found).reshape(-1, width, width)

    def _dances(self, first: int, last: int) -> bool:
        """Whether no joint jumps, nobody stands still for half a second, or is off the floor for
        as long."""
        torn = np.searchsorted(self._torn, (first - BESIDE, last + BESIDE))
        if (
            torn[1] > torn[0]
            or last - first < 10
            or any(min(stop, last) - max(start, first) > HOVERS for start, stop in self._aloft)
        ):
            return False
        window = np.convolve(self.speed[first:last], np.ones(15) / 15, "valid")
        return bool(len(window) == 0 or window.min() > STILL)

    def _seen(self, frames: np.ndarray) -> np.ndarray:
        """Pose, velocity and root velocity [N,E] at frames [N], in metres and comparable ones."""
        after = np.minimum(frames + 1, len(self.poses) - 1)
        before = np.maximum(frames - 1, 0)
        velocity = (self.poses[after] - self.poses[before]) * FPS / 2
        pose = self.poses[frames] * WEIGHTS[:, None]
        root = self.features[frames, ROOT_ROW].numpy()
        contact = root[:, LEFT_CONTACT:]
        parts = (pose, 0.15 * velocity, 0.6 * root[:, :2], 0.3 * root[:, 3:4], 0.5 * contact)
        return np.concatenate([part.reshape(len(frames), -1) for part in parts], 1)

    # ------------------------------------------------------------ files

    def save(self, folder: str | Place) -> None:
        """Write it: rotations in steps of 1/4096, places of 0.2 mm, differences of frames.

        Raises:
            UserError: the folder or address cannot be written.
        """
        folder = place(folder)
        packed = [_packed(take.motion) for take in self.takes]
        turns, places, contacts = (np.concatenate(parts) for parts in zip(*packed, strict=True))
        (folder / CARD).unlink(missing_ok=True)  # until all is there, this is no memory
        arrays = {
            "turns": turns,
            "places": places,
            "contacts": contacts,
            "offsets": self.offsets,
            "counts": np.concatenate([take.counts for take in self.takes]),
            "counted": np.array([len(take.counts) for take in self.takes]),
        }
        write_arrays(arrays, folder / TAKES, compressed=True)
        about = [
            {name: getattr(take, name) for name in ("name", "kind", "source", "licence", "meter")}
            for take in self.takes
        ]
        write_json(folder / CARD, {"kind": KIND, "version": 1, "takes": about})

    @classmethod
    def open(cls, folder: str | Place = SHIPPED) -> Self:
        """What `save` wrote; without a folder what is shipped.

        Raises:
            UserError: nothing there, or damaged.
        """
        folder = place(folder)
        if not is_figure_memory(folder):
            raise UserError(f"{folder} holds no figures; make them with `memory build --figures`")
        try:
            about: Any = load_json(folder / CARD)["takes"]
            arrays = load_arrays(folder / TAKES)
            motions = _unpacked(arrays)
            counts = np.split(arrays["counts"], np.cumsum(arrays["counted"])[:-1])
            takes = [
                Take(**row, motion=motion, counts=own)
                for row, motion, own in zip(about, motions, counts, strict=True)
            ]
            return cls(takes)
        except (BadArray, KeyError, TypeError, ValueError, IndexError, OSError) as error:
            raise UserError(f"{folder} is damaged ({error}); build the figures again") from error


def on_floor(motion: Motion) -> Motion:
    """A motion whose feet stand on the floor in every few seconds, and what then stands.

    One frame below the floor leaves a whole recording above it, and some drift.
    """
    low = motion.positions()[..., 1].min(1).astype(np.float64) - REST_FOOT_HEIGHT
    size = min(round(FLOOR_SECONDS * motion.fps), len(low))
    floor = percentile_filter(low, FLOOR_SHARE, size=size, mode="nearest")
    floor = smoothed(floor, FLOOR_SECONDS / 3 * motion.fps)
    place = motion.root_position - floor[:, None] * np.array([0.0, 1.0, 0.0])
    moved = replace(motion, root_position=place.astype(np.float32))
    return replace(moved, contacts=detect_contacts(moved.positions(), motion.fps))


def is_figure_memory(folder: str | Place) -> bool:
    """Whether a folder or an address is a memory of figures, and not one of phrases."""
    return (place(folder) / CARD).is_file()


def _seen_from(way: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Ways [N,2] (x, z) to the left and forward of headings [N]."""
    sine, cosine = np.sin(heading), np.cos(heading)
    left = way[:, 0] * cosine - way[:, 1] * sine
    return np.stack([left, way[:, 0] * sine + way[:, 1] * cosine], 1)


def _with_mirrors(own: Figures, shown: np.ndarray, spread: np.ndarray) -> Figures:
    """The figures, then their mirror images, which show this."""
    pose = NUM_JOINTS * 3
    signs = np.array([-1.0, 1.0, 1.0])

    def mirrored(seen: np.ndarray) -> np.ndarray:
        joints = seen[:, : 2 * pose].reshape(len(seen), 2, NUM_JOINTS, 3)
        joints = (joints[:, :, list(MIRROR)] * signs).reshape(len(seen), -1)
        rest = seen[:, 2 * pose :][:, [0, 1, 2, 4, 3]] * np.array([1.0, -1.0, -1.0, 1.0, 1.0])
        return np.concatenate((joints, rest), 1)

    other = vars(own) | {
        "mirrored": ~own.mirrored,
        "travel": own.travel * np.array([-1.0, 1.0]),
        "far": own.far * np.array([-1.0, 1.0]),
        "turn": -own.turn,
        "shown": shown,
        "spread": spread,
        "entry": mirrored(own.entry),
        "leave": mirrored(own.leave),
    }
    return Figures(
        **{name: np.concatenate((values, other[name])) for name, values in vars(own).items()}
    )


def _snapped(counts: np.ndarray, beats: np.ndarray) -> np.ndarray:
    """Counts [C] moved to the beats [B] that they mean, none much shorter than its neighbours."""
    if not len(beats):
        return counts
    near = beats[np.abs(beats[:, None] - counts).argmin(0)]
    period = float(np.median(np.diff(counts)))
    found = np.where(np.abs(near - counts) < SNAP_PART * period, near, counts)
    for number in range(1, len(found)):
        found[number] = max(found[number], found[number - 1] + APART * period)
    return np.asarray(found)


def _packed(motion: Motion) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Differences of frames: turns [T,K,3] int16, place and heading [T,4] int32; contacts [T,2]."""
    rotations = rotation_6d_to_matrix(encode_features(motion)[:, :NUM_JOINTS].double())
    quaternions = matrix_to_quaternion(rotations)
    signed = torch.where(quaternions[..., :1] < 0, -quaternions, quaternions)[..., 1:].numpy()
    heading = motion_heading(motion)
    place = np.concatenate((motion.root_position, heading[:, None]), 1).astype(np.float64)
    turns = np.rint(signed * TURN_STEPS).astype(np.int16)
    places = np.rint(place * PLACE_STEPS).astype(np.int32)
    return (
        np.diff(turns, axis=0, prepend=np.zeros_like(turns[:1])),
        np.diff(places, axis=0, prepend=np.zeros_like(places[:1])),
        (motion.contacts > 0.5).astype(np.uint8),
    )


def _unpacked(arrays: Mapping[str, np.ndarray]) -> list[Motion]:
    """The inverse of `_packed`, of takes one after another."""
    cuts = arrays["offsets"][1:-1]

    def summed(name: str) -> np.ndarray:
        parts = np.split(arrays[name], cuts)
        return np.concatenate([part.cumsum(0, dtype=np.int64) for part in parts])

    parts = torch.from_numpy(summed("turns") / TURN_STEPS)
    scalar = (1 - (parts**2).sum(-1, keepdim=True)).clamp_min(0).sqrt()
    quaternions = torch.nn.functional.normalize(torch.cat((scalar, parts), -1), dim=-1)
    place = summed("places") / PLACE_STEPS
    yaw = yaw_quaternion(torch.from_numpy(place[:, 3]))
    quaternions[:, 0] = quaternion_multiply(yaw, quaternions[:, 0])
    whole = (quaternions.float().numpy(), place[:, :3], arrays["contacts"])
    each = (np.split(values.astype(np.float32), cuts) for values in whole)
    return [Motion(q, p, c, fps=FPS) for q, p, c in zip(*each, strict=True)]


# ---------------------------------------------------------------- where the counts fall

SHORT = 12.0  # seconds; of a shorter take other paces are read as well
PACES = (0.36, 0.43, 0.51, 0.61)  # seconds a count
PERIODS = np.arange(0.34, 0.76, 0.02)  # seconds a count
GRID = 60.0  # frames a second in which counts are sought
WIDTH = 0.05  # seconds, standard deviation of a moment's evidence
LANDING = 0.6  # of a landing's evidence against that of slowing down
EVEN = 40.0  # cost of log-ratio² of two counts
SNAP = 0.06  # seconds by which a count moves to the moment that it means


def find_counts(motion: Motion) -> np.ndarray:
    """Seconds [N] of the counts, ascending; none in a motion of under two seconds."""
    slow, down = body_beats(motion), landings(motion)
    if motion.seconds < 2 or not len(slow):
        return np.zeros(0)
    evidence = _evidence(slow, down, motion)
    chains = [_chain(evidence, period * GRID) for period in PERIODS]
    # A count earns what it meets; where nothing is, it costs: else the fastest chain meets all.
    worth = [(evidence[chain] - evidence.mean()).sum() / np.sqrt(len(chain)) for chain in chains]
    counts = chains[int(np.argmax(worth))] / GRID
    moments = np.sort(np.concatenate((slow, down)))
    nearest = moments[np.abs(moments[:, None] - counts).argmin(0)]
    return np.asarray(np.where(np.abs(nearest - counts) < SNAP, nearest, counts))


def _evidence(slow: np.ndarray, down: np.ndarray, motion: Motion) -> np.ndarray:
    """How much speaks for a count in each frame [G], by slow moments and landings in seconds."""
    frames = round(motion.seconds * GRID)
    evidence = np.zeros(frames + 1)
    np.add.at(evidence, np.rint(slow * GRID).astype(int).clip(0, frames), 1.0)
    np.add.at(evidence, np.rint(down * GRID).astype(int).clip(0, frames), LANDING)
    evidence = (
        smoothed(evidence, WIDTH * GRID, mode="symmetric") * WIDTH * GRID * np.sqrt(2 * np.pi)
    )
    return np.asarray(evidence)


def _chain(evidence: np.ndarray, period: float) -> np.ndarray:
    """Frames [N] of the best chain of counts about `period` frames apart through evidence [G]."""
    steps = np.arange(round(0.8 * period), round(1.25 * period) + 1)
    cost = EVEN * np.log(steps / period) ** 2
    value, before = evidence.copy(), np.full(len(evidence), -1)
    for frame in range(int(steps[0]), len(evidence)):
        known = steps[steps <= frame]
        options = value[frame - known] - cost[: len(known)]
        best = int(options.argmax())
        if options[best] > 0:
            value[frame] += options[best]
            before[frame] = frame - known[best]
    tail = max(len(value) - int(period), 0)
    frame = tail + int(value[tail:].argmax())
    chain = [frame]
    while before[frame] >= 0:
        frame = int(before[frame])
        chain.append(frame)
    return np.array(chain[::-1])
