"""GLB of a trajectory: the stand-in body as an animated, skinned mannequin.

The pelvis node carries the trajectory as translation and rotation keys, one a frame; legs bend
with its height, all other joints have one key.
"""

from pathlib import Path

from ..motion.trajectory import MotionTrajectory
from .glb import write_glb
from .trajectory_figure import stand_in


def write_trajectory_glb(trajectory: MotionTrajectory, path: str | Path, title: str = "") -> Path:
    """Write one trajectory as an animated GLB.

    Raises:
        UserError: the file cannot be written.
    """
    return write_glb(stand_in(trajectory, title), path)
