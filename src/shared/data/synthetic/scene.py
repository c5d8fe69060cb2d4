"""What every action starts from: the clock, the parameters and an idling body."""

from dataclasses import dataclass

import numpy as np

from .curves import Array, smooth_noise
from .rig import ABDUCT, ELBOW, FLEX, LEFT, RIGHT, TWIST, Body


@dataclass(frozen=True)
class Scene:
    """One clip being made: frame times [T] in seconds, labels, parameters, noise source."""

    t: Array
    labels: dict[str, str]
    params: dict[str, float]
    rng: np.random.Generator

    def standing(self, width: float = 0.19) -> Body:
        """A body at ease with this clip's posture, breathing and slowly wandering joints."""
        params, t = self.params, self.t
        body = Body.standing(len(t), width * params["width"], np.radians(params["toe_out"]))
        hunch = np.radians(params["hunch"])
        breath = np.radians(0.8) * np.sin(2 * np.pi * t / 3.6 + 6 * params["variant"])
        body.spine[:, 0] += hunch + breath
        body.head[:, 0] += np.radians(params["gaze"]) - 0.5 * hunch
        body.add_arms(ABDUCT, np.radians(params["arm_carry"]) - 0.3 * breath)
        body.add_arms(ELBOW, np.radians(params["elbow_carry"]))
        for index, degrees in enumerate((0.8, 1.2, 0.8)):
            body.spine[:, index] += self.wander(degrees, 2.5)
            body.head[:, index] += self.wander(2.0 * degrees, 2.2)
        for side in (LEFT, RIGHT):
            for joint, degrees in ((FLEX, 2.0), (ABDUCT, 1.5), (TWIST, 3.0), (ELBOW, 3.0)):
                body.arms[:, side, joint] += self.wander(degrees, 2.2)
        return body

    def wander(self, degrees: float, period: float) -> Array:
        """Slow noise [T] in radians."""
        return smooth_noise(self.rng, self.t, float(np.radians(degrees)), period)
