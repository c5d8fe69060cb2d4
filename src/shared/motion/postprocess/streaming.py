"""From features to a motion while it is still being made: the steps of `whole.py`, piece by piece.

A streamed frame settles a little behind what is made: smoothing waits for a frame or two, the foot
lock for `AHEAD` frames; there it differs from that of a whole motion, which sees to the end of
every step. Roots are summed on the CPU in float64.

Letters: T frames, R rows (bones, root track), C channels.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...tensors import Tensor, torch
from ..features import ORIGIN, ROOT_ROW, YAW_RATE, Place, decode_features, integrate_root
from ..motion import Motion
from ..rotations import (
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_multiply,
    quaternion_slerp,
)
from ..skeleton import FOOT_JOINTS
from .footskate import ease_from_kept, kept_legs, lock_feet
from .stitching import FADE, joined
from .whole import MotionPostProcessor, clamp_velocity, smooth_features

BLOCK, AHEAD, BEHIND = 15, 12, 24  # frames: locked at once, waited for, remembered
JUMP = 0.04  # metres: a foot that a plant moves farther in a block's first frame gets there slowly

LEADING, LED = 0.5, math.radians(8.0)  # 1/s, and radians a second at most, back onto a course
TURNS, SEEN = math.radians(20.0), 2.0  # radians a second that are a turn, over so many seconds

Piece = tuple[Tensor, Tensor]  # features [t,R,6] and what is known of them, bool


class Course:
    """Leads a heading back that strays from its course, slower than a body sways with its steps:
    drift bends a minute's walk by up to 250 degrees. Who turns takes a course anew."""

    def __init__(self, fps: float) -> None:
        self.fps, self._turning, self._strayed = fps, 0.0, 0.0  # radians a second; radians

    def add(self, features: Tensor, *, kept: bool) -> Tensor:
        """Features [t,R,6] whose course is `kept`, or that go as they do."""
        rates = features[:, ROOT_ROW, YAW_RATE].tolist() if features.shape[1] > ROOT_ROW else []
        for frame, rate in enumerate(rates):
            self._turning += (rate - self._turning) / (SEEN * self.fps)
            if not kept or abs(self._turning) >= TURNS:
                self._strayed = 0.0
                continue
            rates[frame] = rate - min(max(LEADING * self._strayed, -LED), LED)
            self._strayed += rates[frame] / self.fps
        led = features.clone()
        if rates:
            led[:, ROOT_ROW, YAW_RATE] = torch.as_tensor(rates)
        return led


class Smoother:
    """Smooths all but the known entries; the last frames wait for their neighbours."""

    def __init__(self, weights: Sequence[float]) -> None:
        self.weights, self.reach = weights, len(weights) // 2
        self._raw: Tensor | None = None  # what waits, and `reach` frames before it
        self._known = torch.zeros(0)
        self._behind = 0  # of them, frames that were given back

    def add(self, features: Tensor, known: Tensor) -> Piece:
        """What settles with these next frames [t,R,6]."""
        if self._raw is not None:
            features = torch.cat((self._raw, features))
            known = torch.cat((self._known, known))
        return self._settle(features, known, len(features) - self.reach)

    def finish(self) -> Piece | None:
        """The last frames; None where there were none at all."""
        if self._raw is None:
            return None
        return self._settle(self._raw, self._known, len(self._raw))

    def _settle(self, features: Tensor, known: Tensor, stop: int) -> Piece:
        smooth = features
        if len(features):
            smooth = smooth_features(features, self.weights)
            smooth = torch.where(known, features, smooth)
        start = self._behind
        stop = max(start, stop)
        keep = max(0, stop - self.reach)
        self._raw, self._known, self._behind = features[keep:], known[keep:], stop - keep
        return smooth[start:stop], known[start:stop]


class Decoder:
    """Features to motion, each piece placed where the one before led to."""

    def __init__(self, max_velocity: float | None, fps: float, place: Place) -> None:
        self.max_velocity, self.fps, self.place = max_velocity, fps, place
        self._before: Tensor | None = None  # quaternions [22,4] of the last frame

    def add(self, features: Tensor) -> Motion:
        """The next frames [t,R,6], t ≥ 1."""
        motion = decode_features(features, fps=self.fps, place=self.place)
        if features.shape[1] > ROOT_ROW:
            root = features[:, ROOT_ROW].double()
            path, heading = integrate_root(torch.cat((root, root[-1:])), self.fps, self.place)
            x, _, z = path[-1].tolist()
            self.place = Place(x, z, float(heading[-1]))
        quaternions = torch.as_tensor(motion.quaternions)
        if self._before is not None:
            quaternions = torch.cat((self._before[None], quaternions))
            quaternions = quaternion_continuous(quaternions, dim=0)
        quaternions = clamp_velocity(quaternions, self.max_velocity, self.fps)
        quaternions = quaternions[-motion.num_frames :]
        self._before = quaternions[-1]
        return replace(motion, quaternions=quaternions.numpy())


class FootLock:
    """Holds standing feet, block by block.

    A block sees the settled frames before it, whose feet stay where they are, and some frames after
    it. What the lock had corrected at the end of one block fades out in the next one unless a foot
    stands on.
    """

    def __init__(self) -> None:
        self._waiting: Motion | None = None
        self._known = torch.zeros(0)
        self._settled: Motion | None = None  # the last `BEHIND` frames
        self._unlocked: Tensor | None = None  # quaternions [22,4] of the last one, as they came

    def add(self, motion: Motion | None, known: Tensor, *, last: bool = False) -> Motion | None:
        """The blocks that settle with these next frames."""
        if motion is not None and self._waiting is not None:
            motion, known = joined(self._waiting, motion), torch.cat((self._known, known))
        elif motion is None:
            motion, known = self._waiting, self._known
        settled: Motion | None = None
        while motion is not None and (last or motion.num_frames >= BLOCK + AHEAD):
            block = self._block(motion, known)
            settled = block if settled is None else joined(settled, block)
            rest = motion.num_frames - BLOCK
            motion = motion.frames(BLOCK, motion.num_frames) if rest > 0 else None
            known = known[BLOCK:]
        self._waiting, self._known = motion, known
        return settled

    def _block(self, motion: Motion, known: Tensor) -> Motion:
        """The first `BLOCK` frames, or fewer at the end, with what is seen beyond them."""
        size = min(BLOCK, motion.num_frames)
        ahead = min(motion.num_frames, BLOCK + AHEAD)
        wanted, legs = motion.frames(0, ahead), kept_legs(known[:ahead])
        raw = torch.as_tensor(wanted.quaternions)
        behind = 0
        if self._settled is not None and self._unlocked is not None:
            behind = self._settled.num_frames
            corrected = torch.as_tensor(self._settled.quaternions[-1])
            wanted = replace(wanted, quaternions=_faded(raw, corrected, self._unlocked, legs))
            wanted = joined(self._settled, wanted)
            legs = np.concatenate((np.ones((behind, 2), dtype=bool), legs))
        locked = lock_feet(wanted, kept=legs)
        if behind:
            locked = ease_from_kept(wanted, locked, legs & _jumps(wanted, locked, behind))
        self._unlocked = raw[size - 1]
        self._settled = locked.frames(max(0, behind + size - BEHIND), behind + size)
        return locked.frames(behind, behind + size)


def _jumps(loose: Motion, locked: Motion, frame: int) -> np.ndarray:
    """Which leg [2] bool the lock has carried away at once in this frame, the first that it may."""
    balls = [ball for _, ball in FOOT_JOINTS]
    moved = (each.frames(frame, frame + 1).positions()[0, balls] for each in (loose, locked))
    return np.asarray(np.linalg.norm(np.subtract(*moved), axis=-1) > JUMP)


def _faded(raw: Tensor, corrected: Tensor, before: Tensor, legs: np.ndarray) -> np.ndarray:
    """Quaternions [T,22,4] that first differ from `raw` as `corrected` does from `before` [22,4].

    Known legs [T,2] end it at once: they are not to be touched.
    """
    miss = quaternion_multiply(quaternion_conjugate(before), corrected)
    x = torch.arange(1, len(raw) + 1).float() / (FADE + 1)
    share = (1 - x.clip(0, 1) ** 2 * (3 - 2 * x.clip(0, 1))) * ~torch.as_tensor(legs.any(1))
    still = torch.zeros_like(raw)
    still[..., 0] = 1.0
    turns = quaternion_slerp(still, miss.expand_as(raw), share[:, None, None])
    return quaternion_continuous(quaternion_multiply(raw, turns), dim=0).numpy()


class StreamingPostProcessor:
    """`MotionPostProcessor` for features that come piece by piece.

    Args:
        whole: what is done.
        place: of the first frame.
        foot_lock: hold standing feet; None = as configured.
    """

    def __init__(
        self, whole: MotionPostProcessor, *, place: Place = ORIGIN, foot_lock: bool | None = None
    ) -> None:
        config = whole.config
        self._smoother = Smoother(whole.weights)
        self._decoder = Decoder(config.max_velocity, whole.fps, place)
        locks = config.foot_lock if foot_lock is None else foot_lock
        self._lock = FootLock() if locks else None
        self._before: np.ndarray | None = None  # quaternions [22,4] of the last frame given back

    @property
    def lookahead(self) -> int:
        """Frames that must be there behind a frame before it settles, at most."""
        return self._smoother.reach + (0 if self._lock is None else AHEAD + BLOCK - 1)

    def add(self, features: Tensor, known: Tensor | None = None) -> Motion | None:
        """The frames that settle with these next ones; None where none does.

        Args:
            features: raw [t,R,6].
            known: bool [t,R,6], entries that stay as they are.
        """
        mask = torch.zeros(features.shape, dtype=torch.bool) if known is None else known
        return self._go_on(self._smoother.add(features, mask[:, : features.shape[1]]), last=False)

    def finish(self) -> Motion | None:
        """The frames that waited for more; None where there are none."""
        piece = self._smoother.finish()
        return None if piece is None else self._go_on(piece, last=True)

    def _go_on(self, piece: Piece, *, last: bool) -> Motion | None:
        smooth, mask = piece
        motion = self._decoder.add(smooth) if len(smooth) else None
        if self._lock is not None:
            motion = self._lock.add(motion, mask, last=last)
        if motion is not None and self._before is not None:
            motion = replace(motion, quaternions=_following(motion.quaternions, self._before))
        if motion is not None:
            self._before = motion.quaternions[-1]
        return motion


def _following(quaternions: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Quaternions [T,22,4] with the signs that carry on from those before them [22,4]."""
    flipped = (quaternions[0] * before).sum(-1, keepdims=True) < 0
    return np.where(flipped, -quaternions, quaternions)
