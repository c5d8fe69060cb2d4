"""A motion: local joint rotations, a pelvis path and foot contacts on the canonical skeleton.

Of a dance also its figures: what is danced when, on which counts.
"""

from dataclasses import dataclass, replace
from numbers import Real
from typing import Any, Self

import numpy as np

from ..tensors import torch
from .rotations import (
    forward_kinematics,
    quaternion_continuous,
    quaternion_slerp,
    quaternion_to_matrix,
)
from .skeleton import PARENTS, canonical_skeleton

SAME_RATE, ROUNDED = 1e-3, 2e-5  # relative; files say 0.033333 s for 30 fps
NO_ROTATION = 1e-6  # length of a quaternion


@dataclass(frozen=True, eq=False)
class Motion:
    """What readers return and writers take.

    Attributes:
        quaternions: local rotations [T,22,4] float32, w x y z; joint 0 is the pelvis' world
            orientation, heading included.
        root_position: world position of the pelvis [T,3] float32, metres.
        contacts: left and right foot on the ground [T,2] float32 in [0, 1].
        fps: frames per second.
        text: the caption or prompt, may be empty.
    """

    quaternions: np.ndarray
    root_position: np.ndarray
    contacts: np.ndarray
    fps: float = 30.0
    text: str = ""

    def __repr__(self) -> str:
        return f"Motion({self.num_frames} frames, {self.seconds:.2f} s, {self.text!r})"

    @property
    def num_frames(self) -> int:
        return len(self.quaternions)

    @property
    def seconds(self) -> float:
        return self.num_frames / self.fps

    def fault(self) -> str | None:
        """What no program could show, and what to do about it; None where all is well."""
        shapes = {"quaternions": (22, 4), "root_position": (3,), "contacts": (2,)}
        frames = (np.shape(self.quaternions) or (0,))[0]
        for name, shape in shapes.items():
            array: Any = getattr(self, name)
            numbers = isinstance(array, np.ndarray) and array.dtype.kind in "fiu"
            if not numbers or array.shape != (frames, *shape):
                kind = getattr(array, "dtype", type(array).__name__)
                given = f"{kind} of {list(np.shape(array))}"
                wanted = [frames, *shape]
                return f"the motion's {name} are {given}; give numbers in an array of {wanted}"
            if not np.isfinite(array).all():
                return (
                    f"the motion's {name} hold NaN or infinite values; mend them, or train the"
                    " model anew that made them: it may have diverged"
                )
        if not frames:
            return "the motion has no frames; give one with some"
        if np.linalg.norm(self.quaternions, axis=-1).min() < NO_ROTATION:
            return "the motion holds a quaternion of zeros, which is no rotation; make it again"
        fps, text = vars(self)["fps"], vars(self)["text"]
        if not (isinstance(fps, Real) and 0 < float(fps) < np.inf):
            return f"the motion's fps is {fps!r}; give frames a second, more than 0"
        return None if isinstance(text, str) else f"the motion's text is {text!r}; give a str"

    def frames(self, start: int, stop: int) -> Self:
        """The motion from frame `start` to before frame `stop`, where it is in the world."""
        own = slice(start, stop)
        return replace(
            self,
            quaternions=self.quaternions[own],
            root_position=self.root_position[own],
            contacts=self.contacts[own],
        )

    def kinematics(self) -> tuple[np.ndarray, np.ndarray]:
        """World joint positions [T,22,3] in metres and rotations [T,22,3,3], float32."""
        positions, rotations = forward_kinematics(
            quaternion_to_matrix(torch.as_tensor(self.quaternions)),
            torch.as_tensor(self.root_position),
            torch.as_tensor(canonical_skeleton().offsets),
            PARENTS,
        )
        return positions.numpy(), rotations.numpy()

    def positions(self) -> np.ndarray:
        """World joint positions [T,22,3] float32, metres."""
        return self.kinematics()[0]

    def global_rotations(self) -> np.ndarray:
        """World joint rotations [T,22,3,3] float32."""
        return self.kinematics()[1]


def in_place(motion: Motion) -> Motion:
    """The motion on the spot, as game engines want loops: the pelvis stays over x = z = 0.

    Height, rotations and contacts are kept: a jump still rises and a turn still turns, but feet
    that stood now slide backwards under the body.
    """
    flat = np.array([0.0, 1.0, 0.0], np.float32)
    return replace(motion, root_position=motion.root_position * flat)


def resample_motion(motion: Motion, fps: float) -> Motion:
    """The same motion at `fps`: slerp for rotations, linear for positions, nearest for contacts.

    The first frame stays, the last lies within one frame.

    Raises:
        ValueError: `fps` is not positive.
    """
    if fps <= 0:
        raise ValueError(f"fps {fps} must be positive")
    if abs(fps / motion.fps - 1) < SAME_RATE or motion.num_frames < 2:
        return replace(motion, fps=fps)
    last = motion.num_frames - 1
    steps = last / motion.fps * fps  # but for how many digits a file gives its frame time
    number = int(steps + min(ROUNDED * steps, 0.5) + 1e-6) + 1
    times = np.minimum(np.arange(number) * (motion.fps / fps), last)
    before = np.minimum(times.astype(int), last - 1)
    part = (times - before).astype(np.float32)
    q = torch.as_tensor(motion.quaternions)
    q = quaternion_slerp(q[before], q[before + 1], torch.as_tensor(part)[:, None, None])
    p = motion.root_position
    return replace(
        motion,
        quaternions=quaternion_continuous(q, dim=0).numpy(),
        root_position=p[before] + part[:, None] * (p[before + 1] - p[before]),
        contacts=motion.contacts[np.minimum(np.rint(times).astype(int), last)],
        fps=fps,
    )


@dataclass(frozen=True)
class Danced:
    """A figure in a dance.

    Attributes:
        name: the take that it is from, and the second at which it begins there.
        kind: of dance.
        times: seconds of its n counts, and of its end [n+1].
        mirrored: left and right swapped.
        part: a letter for each phrase of a take, in the order that they are first danced; a' is the
            mirror image of a.
        steps: only its steps are danced, below a body that is made of words.
    """

    name: str
    kind: str
    times: tuple[float, ...]
    mirrored: bool
    part: str
    steps: bool = False

    @property
    def start(self) -> float:
        """Second of the first count."""
        return self.times[0]

    @property
    def stop(self) -> float:
        """Second at which it ends."""
        return self.times[-1]

    def told(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "name": self.name,
            "kind": self.kind,
            "start": round(self.start, 3),
            "stop": round(self.stop, 3),
            "counts": len(self.times) - 1,
            "mirrored": self.mirrored,
            "part": self.part,
            "steps": self.steps,
        }
