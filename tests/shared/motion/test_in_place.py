"""On the spot: no travel, everything else as it was."""

import numpy as np

from src.shared.motion.in_place import in_place
from src.shared.motion.motion import Motion


def test_only_the_travel_goes() -> None:
    rng = np.random.default_rng(0)
    quaternions = rng.normal(size=(7, 22, 4)).astype(np.float32)
    contacts = rng.uniform(0, 1, (7, 2)).astype(np.float32)
    motion = Motion(quaternions, rng.normal(size=(7, 3)).astype(np.float32), contacts, 24.0, "a")
    still = in_place(motion)
    assert not still.root_position[:, [0, 2]].any()
    np.testing.assert_array_equal(still.root_position[:, 1], motion.root_position[:, 1])
    assert still.quaternions is motion.quaternions
    assert still.contacts is motion.contacts
    assert (still.fps, still.text) == (24.0, "a")
    assert still.root_position.dtype == np.float32
