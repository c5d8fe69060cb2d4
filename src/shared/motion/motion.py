"""A motion: local joint rotations, a pelvis path and foot contacts on the canonical skeleton."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
import torch

from .kinematics import forward_kinematics
from .rotations import quaternion_to_matrix
from .skeleton import PARENTS, canonical_skeleton


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

    @property
    def num_frames(self) -> int:
        return len(self.quaternions)

    @property
    def seconds(self) -> float:
        return self.num_frames / self.fps

    def frames(self, start: int, stop: int) -> Self:
        """The motion from frame `start` to before frame `stop`, where it is in the world."""
        own = slice(start, stop)
        return replace(
            self,
            quaternions=self.quaternions[own],
            root_position=self.root_position[own],
            contacts=self.contacts[own],
        )

    def _kinematics(self) -> tuple[torch.Tensor, torch.Tensor]:
        return forward_kinematics(
            quaternion_to_matrix(torch.as_tensor(self.quaternions)),
            torch.as_tensor(self.root_position),
            torch.as_tensor(canonical_skeleton().offsets),
            PARENTS,
        )

    def positions(self) -> np.ndarray:
        """World joint positions [T,22,3] float32, metres."""
        return np.asarray(self._kinematics()[0].numpy())

    def global_rotations(self) -> np.ndarray:
        """World joint rotations [T,22,3,3] float32."""
        return np.asarray(self._kinematics()[1].numpy())
