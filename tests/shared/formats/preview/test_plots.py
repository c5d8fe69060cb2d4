"""Pictures of trajectories."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from src.shared.formats.preview.charts import plot_trajectory
from tests.shared.motion.trajectories import smooth_trajectory

pytest.importorskip("matplotlib")


@pytest.mark.parametrize("num_frames", [1, 90])
def test_a_trajectory_becomes_six_panels(num_frames: int, tmp_path: Path) -> None:
    motion, file = smooth_trajectory(1, num_frames), tmp_path / "a.png"
    path = plot_trajectory(motion, file, max_jerk=2000.0, title="a")
    with Image.open(path) as picture:
        assert picture.size == (1200, 1000)
        assert len(np.unique(np.asarray(picture.convert("L")))) > 10
