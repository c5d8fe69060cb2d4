"""Blender itself reads our BVH and GLB: every bone where we say it is, at ten frames."""

import numpy as np
import pytest

from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.formats.registry import export_motion
from src.shared.motion.skeleton import JOINT_NAMES
from tests.integrations.blender_run import blender_python, run_in_blender

pytestmark = pytest.mark.skipif(blender_python() is None, reason="no bpy; BPY_PYTHON names one")


@pytest.fixture(scope="module")
def imported(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[str, np.ndarray, dict]]:
    """(format, our positions [10,22,3], what Blender says) of two motions in two formats."""
    scratch = tmp_path_factory.mktemp("blender")
    motions, files = [], []
    for index, spec in enumerate(sample_specs(40, 0)[::20]):
        motion = generate_clip(spec, seed=index)
        motions.append(motion)
        paths = export_motion(motion, scratch, f"motion-{index}", ("bvh", "glb"))
        files.append({name: str(path) for name, path in paths.items()})
    shortest = min(motion.num_frames for motion in motions)
    frames = [round(x) for x in np.linspace(0, shortest - 1, 10)]
    wanted = {"files": [path for pair in files for path in pair.values()], "frames": frames}
    said = run_in_blender("blender_import.py", wanted, scratch)
    return [
        (name, motion.positions()[frames], said[path] | {"frames": motion.num_frames})
        for motion, pair in zip(motions, files, strict=True)
        for name, path in pair.items()
    ]


@pytest.mark.parametrize("wanted", ["bvh", "glb"])
def test_bones_are_where_we_say(imported: list, wanted: str) -> None:
    for name, ours, said in imported:
        if name != wanted:
            continue
        assert all(set(heads) == set(JOINT_NAMES) for heads in said["heads"])
        theirs = np.array([[heads[joint] for joint in JOINT_NAMES] for heads in said["heads"]])
        assert np.linalg.norm(theirs - ours, axis=-1).max() < 1e-3


def test_every_frame_arrives(imported: list) -> None:
    for _name, _ours, said in imported:
        first, last = said["range"]
        assert round(last - first) + 1 == said["frames"]
