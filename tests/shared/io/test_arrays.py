"""Arrays out of files: what torch may share without a warning."""

from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.io.arrays import load_array, load_arrays


@pytest.mark.filterwarnings("error")
def test_arrays_of_a_file_may_be_written_to(tmp_path: Path) -> None:
    values = np.arange(6, dtype=np.float32).reshape(2, 3)
    np.save(tmp_path / "a.npy", values)
    np.savez(tmp_path / "a.npz", x=values)
    for found in (load_array(tmp_path / "a.npy"), load_arrays(tmp_path / "a.npz", ["x"])["x"]):
        torch.from_numpy(found)[0] = 7.0
        assert (found[0] == 7).all() and (found[1] == values[1]).all()
