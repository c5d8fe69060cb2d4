"""From features to a motion, whole or while it is still being made.

Smoothing, decoding, velocity clamp and foot lock are those of `motion/postprocess`. Here is what a
controlled or streamed motion needs besides: known entries that stay as they were, borders between
known and made frames without a jump, and the same steps piece by piece. A streamed frame settles
a little behind what is made: smoothing waits for a frame or two, the foot lock for `AHEAD` frames;
there it differs from that of a whole motion, which sees to the end of every step.

Letters: T frames, R rows (bones, root track), C channels, N columns (one channel of one row).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any

import numpy as np
import torch
from scipy.ndimage import distance_transform_edt, gaussian_filter1d
from torch import Tensor

from ..config_schema import PostProcessingConfig
from ..model.generation.motion_generator import TextToMotion
from ..motion.carried_feet import hold_carried_feet
from ..motion.features import LEFT_CONTACT, ROOT_ROW, decode_features, headings, integrate_root
from ..motion.foot_lock import kept_legs, lock_feet
from ..motion.motion import Motion
from ..motion.postprocess import MotionPostProcessor, clamp_velocity, smooth_features
from ..motion.rotations import (
    matrix_to_rotation_6d,
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_multiply,
    quaternion_slerp,
    quaternion_to_matrix,
    rotation_6d_to_matrix,
    turn_about_y,
    yaw_quaternion,
    yaw_to_matrix,
)
from ..motion.skeleton import JOINT_INDEX, LIMBS

FADE = 10  # frames until a correction at a border has faded out


@dataclass(frozen=True)
class Place:
    """Where a pelvis is on the ground and where it faces: metres and radians about +Y."""

    x: float = 0.0
    z: float = 0.0
    heading: float = 0.0


ORIGIN = Place()


def place_of(motion: Motion, frame: int) -> Place:
    """Where a body is in a frame."""
    pelvis = quaternion_to_matrix(torch.as_tensor(motion.quaternions[:, 0]))
    x, _, z = motion.root_position[frame].tolist()
    return Place(x, z, float(headings(pelvis)[frame]))


def moved_to(motion: Motion, place: Place) -> Motion:
    """The same motion with its first frame somewhere else on the ground."""
    here = place_of(motion, 0)
    turn = place.heading - here.heading
    path = torch.as_tensor(motion.root_position, dtype=torch.float64)
    path = turn_about_y(path - torch.tensor([here.x, 0.0, here.z]), turn)
    path = path + torch.tensor([place.x, 0.0, place.z])
    quaternions = motion.quaternions.copy()
    pelvis = torch.as_tensor(quaternions[:, 0], dtype=torch.float64)
    yaw = yaw_quaternion(torch.tensor(turn, dtype=torch.float64))
    quaternions[:, 0] = quaternion_multiply(yaw.expand_as(pelvis), pelvis).numpy()
    return replace(motion, quaternions=quaternions, root_position=path.float().numpy())


BLUR, REACH = 1.5, 4.0  # frames, standard deviations: of the average at a cut, of where it is made


def smooth_borders(features: Tensor, known: Tensor, *, fade: int = FADE) -> Tensor:
    """Features with unknown entries moved to meet the known ones; contacts stay as they are.

    Args:
        features: raw [T,R,C].
        known: bool [T,R,C]; these entries are left alone.
        fade: frames; no more than half of a gap.
    """
    smooth = features.double().flatten(1).numpy().copy()  # T N
    fixed = known.flatten(1).numpy().copy()  # T N
    contacts = ROOT_ROW * features.shape[2] + LEFT_CONTACT
    fixed[:, contacts:] = True
    _meet(smooth, fixed, fade)
    _meet(smooth[::-1], fixed[::-1], fade)
    return torch.from_numpy(smooth).to(features.dtype).view_as(features)


def soften_cuts(features: Tensor, cuts: Sequence[int]) -> Tensor:
    """Features averaged over time near the first frames of new pieces; contacts stay.

    Args:
        features: raw [T,R,C].
        cuts: frames at which a piece begins.
    """
    if not cuts:
        return features
    away = np.abs(np.arange(len(features))[:, None] + 0.5 - np.asarray(cuts)).min(1)
    share = np.where(away < 4 * REACH, np.exp(-0.5 * (away / REACH) ** 2), 0.0)
    rows = features.double().numpy()
    mean = gaussian_filter1d(rows, BLUR, axis=0, mode="nearest")
    soft = torch.from_numpy(rows + share[:, None, None] * (mean - rows)).to(features.dtype)
    soft[:, ROOT_ROW:, LEFT_CONTACT:] = features[:, ROOT_ROW:, LEFT_CONTACT:]
    return soft


def _meet(values: np.ndarray, fixed: np.ndarray, fade: int) -> None:
    """Mend the borders behind fixed entries [T,N] in place."""
    starts = fixed[:-1] & ~fixed[1:]  # T-1 N, the next frame is the first free one
    for last in np.flatnonzero(starts.any(1)):
        columns = np.flatnonzero(starts[last])
        lengths = _free_frames(fixed[last + 1 :, columns])
        for length in np.unique(lengths):
            same = columns[lengths == length]
            part = values[last + 1 : last + 1 + length, same]
            miss = _expected(values[: last + 1, same], fixed[: last + 1, same], part) - part[0]
            open_ended = last + 1 + length == len(values)
            reach = fade if open_ended else min(fade, max(1, length // 2))
            values[last + 1 : last + 1 + length, same] += _weights(length, reach)[:, None] * miss


def _free_frames(fixed: np.ndarray) -> np.ndarray:
    """How many frames [N] pass until a column [T,N] is fixed again."""
    return np.where(fixed.any(0), fixed.argmax(0), len(fixed))


def _expected(before: np.ndarray, fixed: np.ndarray, after: np.ndarray) -> np.ndarray:
    """The first free values [N]: the last fixed ones, and the mean step of both sides on."""
    steps = [after[1] - after[0]] if len(after) > 1 else []
    if len(before) > 1:
        own = before[-1] - before[-2]
        steps.append(np.where(fixed[-2], own, steps[0] if steps else 0.0))
    return np.asarray(before[-1] + np.mean(steps, axis=0) if steps else before[-1])


def _weights(frames: int, reach: int) -> np.ndarray:
    """[frames] from 1 to 0 over `reach` frames; first and second derivative vanish at both ends."""
    x = np.clip(np.arange(frames) / reach, 0, 1)
    return np.asarray(1 - x**3 * (x * (6 * x - 15) + 10))


PELVIS = 0  # its row


def untwisted(features: Tensor) -> Tensor:
    """Features [T,R,6] whose pelvis row has no heading left: that is the path's alone."""
    pelvis = rotation_6d_to_matrix(features[:, PELVIS])
    level = yaw_to_matrix(-headings(pelvis)) @ pelvis
    return torch.cat((matrix_to_rotation_6d(level)[:, None], features[:, 1:]), 1)


EASE = 10  # frames until a leg is held as if nothing of it had been kept


def finish(
    generator: TextToMotion,
    features: Tensor,
    known: Tensor | None,
    *,
    text: str,
    place: Place | None = None,
    foot_lock: bool | None = None,
    carried: bool = False,
) -> Motion:
    """Post-processed as the generator's own motions are, in its place; known entries stay.

    Args:
        generator: whose settings count.
        features: raw [T,R,6].
        known: bool [T,R,6].
        text: its caption.
        place: of the first frame; None = the origin, facing +Z.
        foot_lock: hold standing feet; None = the model's own setting.
        carried: a path that is not the body's own is known.
    """
    config = generator.network.generation.post_processing
    smooth = smooth_features(features, config.smoothing_kernel)
    if known is not None:
        # Neither what was made of the pelvis nor an average has a heading of its own to add.
        smooth = untwisted(torch.where(known[:, : features.shape[1]], features, smooth))
        smooth = torch.where(known[:, : features.shape[1]], features, smooth)
    place = place or Place()
    locks = config.foot_lock if foot_lock is None else foot_lock
    loose = MotionPostProcessor(
        config.model_copy(update={"smoothing_kernel": 1, "foot_lock": False})
    )(
        smooth,
        known=known,
        fps=generator.card.fps,
        text=text,
        start_position=(place.x, place.z),
        start_heading=place.heading,
    )
    if not locks:
        return loose
    kept = None if known is None else kept_legs(known)
    if kept is None or not kept.any():
        return (hold_carried_feet if carried else lock_feet)(loose)
    locked = (hold_carried_feet if carried else lock_feet)(loose, kept=kept)
    return eased(loose, locked, kept)


def eased(loose: Motion, locked: Motion, kept: np.ndarray) -> Motion:
    """Legs held little by little from where they are kept [T,2] bool: no foot jumps to its hold."""
    quaternions = torch.as_tensor(locked.quaternions).clone()
    before = torch.as_tensor(loose.quaternions)
    for side, limb in enumerate(("left-leg", "right-leg")):
        away = distance_transform_edt(~kept[:, side]) if kept[:, side].any() else np.inf
        x = torch.as_tensor(np.minimum(away / EASE, 1.0), dtype=torch.float32)
        share = (x**2 * (3 - 2 * x)).expand(len(before))[:, None, None]
        joints = [JOINT_INDEX[name] for name in LIMBS[limb]]
        quaternions[:, joints] = quaternion_slerp(before[:, joints], quaternions[:, joints], share)
    return replace(locked, quaternions=quaternion_continuous(quaternions, dim=0).numpy())


BLOCK, AHEAD, BEHIND = 15, 12, 24  # frames: locked at once, waited for, remembered

Piece = tuple[Tensor, Tensor]  # features [t,R,6] and what is known of them, bool


class Smoother:
    """Smooths all but the known entries; the last frames wait for their neighbours."""

    def __init__(self, kernel_size: int) -> None:
        self.kernel_size, self.reach = kernel_size, kernel_size // 2
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
            smooth = smooth_features(features, self.kernel_size)
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
        place: dict[str, Any] = {
            "start_position": (self.place.x, self.place.z),
            "start_heading": self.place.heading,
        }
        motion = decode_features(features, fps=self.fps, **place)
        if features.shape[1] > ROOT_ROW:
            root = features[:, ROOT_ROW].double()
            path, heading = integrate_root(torch.cat((root, root[-1:])), self.fps, **place)
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
            motion = frames_of(motion, BLOCK, motion.num_frames) if rest > 0 else None
            known = known[BLOCK:]
        self._waiting, self._known = motion, known
        return settled

    def _block(self, motion: Motion, known: Tensor) -> Motion:
        """The first `BLOCK` frames, or fewer at the end, with what is seen beyond them."""
        size = min(BLOCK, motion.num_frames)
        ahead = min(motion.num_frames, BLOCK + AHEAD)
        wanted, legs = frames_of(motion, 0, ahead), kept_legs(known[:ahead])
        raw = torch.as_tensor(wanted.quaternions)
        behind = 0
        if self._settled is not None and self._unlocked is not None:
            behind = self._settled.num_frames
            corrected = torch.as_tensor(self._settled.quaternions[-1])
            wanted = replace(wanted, quaternions=_faded(raw, corrected, self._unlocked, legs))
            wanted = joined(self._settled, wanted)
            legs = np.concatenate((np.ones((behind, 2), dtype=bool), legs))
        locked = lock_feet(wanted, kept=legs)
        self._unlocked = raw[size - 1]
        self._settled = frames_of(locked, max(0, behind + size - BEHIND), behind + size)
        return frames_of(locked, behind, behind + size)


def _faded(raw: Tensor, corrected: Tensor, before: Tensor, legs: np.ndarray) -> np.ndarray:
    """Quaternions [T,22,4] that first differ from `raw` as `corrected` does from `before` [22,4].

    Known legs [T,2] end it at once: they are not to be touched.
    """
    miss = quaternion_multiply(quaternion_conjugate(before), corrected)
    x = torch.arange(1, len(raw) + 1) / (FADE + 1)
    share = (1 - x.clamp(0, 1) ** 2 * (3 - 2 * x.clamp(0, 1))) * ~torch.as_tensor(legs.any(1))
    still = torch.zeros_like(raw)
    still[..., 0] = 1.0
    turns = quaternion_slerp(still, miss.expand_as(raw), share[:, None, None])
    return quaternion_continuous(quaternion_multiply(raw, turns), dim=0).numpy()


class Settler:
    """All of it, as configured.

    Args:
        config: what is done.
        fps: frames a second.
        place: of the first frame; None = the origin, facing +Z.
    """

    def __init__(
        self, config: PostProcessingConfig, *, fps: float, place: Place | None = None
    ) -> None:
        self._smoother = Smoother(config.smoothing_kernel)
        self._decoder = Decoder(config.max_velocity, fps, place or Place())
        self._lock = FootLock() if config.foot_lock else None
        self._before: np.ndarray | None = None  # quaternions [22,4] of the last frame given back

    @classmethod
    def of(
        cls,
        generator: TextToMotion,
        *,
        place: Place | None = None,
        foot_lock: bool | None = None,
    ) -> "Settler":
        """As a generator's own motions are finished; `foot_lock` goes before its setting."""
        config = generator.network.generation.post_processing
        if foot_lock is not None:
            config = config.model_copy(update={"foot_lock": foot_lock})
        return cls(config, fps=generator.card.fps, place=place)

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


def settled(generator: TextToMotion, features: Tensor, *, foot_lock: bool | None = None) -> Motion:
    """All of some features [T,R,6] at once: what their pieces, joined, would be."""
    settler = Settler.of(generator, foot_lock=foot_lock)
    pieces = [settler.add(features), settler.finish()]
    return reduce(joined, [piece for piece in pieces if piece is not None])


def _following(quaternions: np.ndarray, before: np.ndarray) -> np.ndarray:
    """Quaternions [T,22,4] with the signs that carry on from those before them [22,4]."""
    flipped = (quaternions[0] * before).sum(-1, keepdims=True) < 0
    return np.where(flipped, -quaternions, quaternions)


def joined(first: Motion, second: Motion) -> Motion:
    """Two motions one after the other, both where they are; quaternion signs go on."""
    quaternions = np.concatenate((first.quaternions, second.quaternions))
    return replace(
        first,
        quaternions=quaternion_continuous(torch.as_tensor(quaternions), dim=0).numpy(),
        root_position=np.concatenate((first.root_position, second.root_position)),
        contacts=np.concatenate((first.contacts, second.contacts)),
    )


def frames_of(motion: Motion, start: int, stop: int) -> Motion:
    """Frames [start, stop) of a motion."""
    return replace(
        motion,
        quaternions=motion.quaternions[start:stop],
        root_position=motion.root_position[start:stop],
        contacts=motion.contacts[start:stop],
    )
