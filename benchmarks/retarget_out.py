"""How exact is a motion after a way onto another skeleton and back?

    python -m benchmarks.retarget_out TARGET... --motions FOLDER --number 30 --seed 0

Each TARGET is a .bvh or .glb whose skeleton is moved. Motions are drawn at random from the folder,
read, carried over, written to a BVH file, and read again. Distances are over all joints and
frames; the feet of a skeleton stand at a height of their own, which is taken off first.
"""

import argparse
import random
import tempfile
from pathlib import Path

import numpy as np

from src.shared.data.retarget.read_motion import read_motion
from src.shared.data.retarget.to_rig import read_target
from src.shared.motion.motion import Motion

ENDINGS = (".bvh", ".amc", ".npz", ".glb")


def angles(first: Motion, second: Motion) -> np.ndarray:
    """Angles [T,22] in radians between the world rotations of two motions."""
    step = first.global_rotations().astype(np.float64) - second.global_rotations()
    return np.asarray(2 * np.arcsin(np.clip(np.linalg.norm(step, axis=(-2, -1)) / 8**0.5, 0, 1)))


def distances(first: Motion, second: Motion) -> np.ndarray:
    """Distances [T,22] in metres, after the mean height of the pelvis is made equal."""
    step = first.positions().astype(np.float64) - second.positions()
    step[..., 1] -= step[:, 0, 1].mean()
    return np.asarray(np.linalg.norm(step, axis=-1))


def main() -> None:
    """The table, a line a target."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="+", type=Path)
    parser.add_argument("--motions", required=True, type=Path)
    parser.add_argument("--number", type=int, default=30)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    files = sorted(p for p in options.motions.rglob("*") if p.suffix.lower() in ENDINGS)
    chosen = random.Random(options.seed).sample(files, options.number)
    motions = [read_motion(path) for path in chosen]
    print("| there and back | joints mapped | largest angle | largest distance | mean distance |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for path in options.targets:
            target = read_target(path)
            turned, moved = [], []
            for motion in motions:
                out = target.write(motion, Path(scratch) / "out.bvh")
                back = read_motion(out, fps=None)
                if back.num_frames != motion.num_frames:  # a jump at the start reads as a T-pose
                    continue
                turned.append(angles(motion, back))
                moved.append(distances(motion, back))
            joints = len(target.mapping.joints)
            print(f"| {path.name} ({target.mapping.name}) | {joints} of 22 | "
                  f"{max(t.max() for t in turned):.6f} rad | {max(m.max() for m in moved):.6f} m | "
                  f"{np.mean([m.mean() for m in moved]):.6f} m | N={len(turned)}")  # fmt: skip


if __name__ == "__main__":
    main()
