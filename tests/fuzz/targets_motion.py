"""Readers of motions and trajectories, and of what directs them: timelines and drawn paths."""

import contextlib
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np

from tests.fuzz.target import FRAMES, Target, check_arrays, check_motion, some_motion

MIXAMO = {
    "pelvis": "Hips", "l_hip": "LeftUpLeg", "l_knee": "LeftLeg", "l_ankle": "LeftFoot",
    "l_foot": "LeftToeBase", "r_hip": "RightUpLeg", "r_knee": "RightLeg", "r_ankle": "RightFoot",
    "r_foot": "RightToeBase", "spine1": "Spine", "spine2": "Spine1", "spine3": "Spine2",
    "neck": "Neck", "head": "Head", "l_collar": "LeftShoulder", "l_shoulder": "LeftArm",
    "l_elbow": "LeftForeArm", "l_wrist": "LeftHand", "r_collar": "RightShoulder",
    "r_shoulder": "RightArm", "r_elbow": "RightForeArm", "r_wrist": "RightHand",
}  # fmt: skip
# name, parent, direction, length: a skeleton as HDM05's, without fingers
BONES = (
    ("lhipjoint", "root", (0.6, -0.8, 0.0), 2.4), ("lfemur", "lhipjoint", (0.3, -0.95, 0.0), 7.5),
    ("ltibia", "lfemur", (0.3, -0.95, 0.0), 7.4), ("lfoot", "ltibia", (0.0, -0.2, 0.98), 2.2),
    ("ltoes", "lfoot", (0.0, 0.0, 1.0), 1.1), ("rhipjoint", "root", (-0.6, -0.8, 0.0), 2.4),
    ("rfemur", "rhipjoint", (-0.3, -0.95, 0.0), 7.5), ("rtibia", "rfemur", (-0.3, -0.95, 0.0), 7.4),
    ("rfoot", "rtibia", (0.0, -0.2, 0.98), 2.2), ("rtoes", "rfoot", (0.0, 0.0, 1.0), 1.1),
    ("lowerback", "root", (0.0, 1.0, 0.0), 2.0), ("upperback", "lowerback", (0.0, 1.0, 0.0), 2.0),
    ("thorax", "upperback", (0.0, 1.0, 0.0), 2.0), ("lowerneck", "thorax", (0.0, 1.0, 0.0), 1.7),
    ("upperneck", "lowerneck", (0.0, 1.0, 0.1), 1.7), ("head", "upperneck", (0.0, 1.0, 0.1), 1.7),
    ("lclavicle", "thorax", (0.9, 0.4, 0.0), 3.7), ("lhumerus", "lclavicle", (1.0, 0.0, 0.0), 5.0),
    ("lradius", "lhumerus", (1.0, 0.0, 0.0), 3.2), ("lwrist", "lradius", (1.0, 0.0, 0.0), 1.7),
    ("lhand", "lwrist", (1.0, 0.0, 0.0), 0.7), ("rclavicle", "thorax", (-0.9, 0.4, 0.0), 3.7),
    ("rhumerus", "rclavicle", (-1.0, 0.0, 0.0), 5.0),
    ("rradius", "rhumerus", (-1.0, 0.0, 0.0), 3.2), ("rwrist", "rradius", (-1.0, 0.0, 0.0), 1.7),
    ("rhand", "rwrist", (-1.0, 0.0, 0.0), 0.7),
)  # fmt: skip


# ---------------------------------------------------------------- whole files


def _write_bvh(folder: Path) -> None:
    from src.shared.formats.writers.bvh import write_bvh

    text = write_bvh(some_motion(), folder / "ours.bvh").read_text()
    write_bvh(some_motion(5), folder / "more.bvh")
    for ours, theirs in MIXAMO.items():
        text = text.replace(f" {ours}\n", f" mixamorig:{theirs}\n")
    (folder / "mixamo.bvh").write_text(text)


def _write_asf(folder: Path) -> None:
    """A skeleton and a motion of it, as Acclaim files have them."""
    lines = [
        "# a skeleton", ":version 1.10", ":name body", ":units", "  mass 1.0", "  length 0.45",
        "  angle deg", ":documentation", "  none", ":root", "  order TX TY TZ RX RY RZ",
        "  axis XYZ", "  position 0 0 0", "  orientation 0 0 0", ":bonedata",
    ]  # fmt: skip
    for number, (name, _, direction, length) in enumerate(BONES, 1):
        lines += ["  begin", f"    id {number}", f"    name {name}"]
        lines += ["    direction " + " ".join(map(str, direction)), f"    length {length}"]
        lines += [f"    axis {3 * number} 0 -5 XYZ", "    dof rx ry rz"]
        lines += ["    limits (-160.0 20.0)", "      (-70.0 70.0)", "      (-60.0 70.0)", "  end"]
    lines += [":hierarchy", "  begin"]
    for parent in dict.fromkeys(parent for _, parent, *_ in BONES):
        children = [name for name, above, *_ in BONES if above == parent]
        lines.append("    " + " ".join((parent, *children)))
    (folder / "body.asf").write_text("\n".join([*lines, "  end", ""]))
    rng = np.random.default_rng(0)
    rows = ["#!OML:ASF body.asf", ":FULLY-SPECIFIED", ":DEGREES"]
    for frame in range(1, 9):
        rows += [str(frame), f"root 0 17 {frame / 10} 0 {frame} 0"]
        angles = rng.normal(0, 5, (len(BONES), 3)).round(3)
        names = [name for name, *_ in BONES]
        rows += [f"{n} " + " ".join(map(str, a)) for n, a in zip(names, angles, strict=True)]
    (folder / "body.amc").write_text("\n".join(rows) + "\n")


def _write_amass(folder: Path) -> None:
    from src.shared.formats.amass import write_amass

    write_amass(some_motion(), folder / "ours.npz")
    rng = np.random.default_rng(0)
    common = {"trans": rng.normal(size=(FRAMES, 3)), "betas": np.zeros(16), "gender": "neutral"}
    poses = rng.normal(0, 0.3, (FRAMES, 156))
    np.savez(folder / "smplh.npz", poses=poses, mocap_framerate=np.array(120.0), **common)
    parts = {"root_orient": poses[:, :3], "pose_body": poses[:, 3:66]}
    np.savez(folder / "smplx.npz", mocap_frame_rate=np.array(60), **parts, **common)


def _write_humanml(folder: Path) -> None:
    np.save(folder / "joints.npy", some_motion().positions())


def _write_motions(*endings: str) -> Callable[[Path], None]:
    def prepare(folder: Path) -> None:
        from src.shared.formats.registry import write_motion

        for ending in endings:
            write_motion(some_motion(), folder / f"0.{ending}")

    return prepare


def _write_trajectories(folder: Path) -> None:
    from src.shared.formats.registry import write_trajectory
    from src.shared.motion.trajectory import from_motion

    trajectory = from_motion(some_motion())
    np.save(folder / "0.npy", trajectory.data)
    for ending in ("npz", "csv"):
        write_trajectory(trajectory, folder / f"0.{ending}")


def _write_directions(folder: Path) -> None:
    entries = [
        {"text": "a person walks", "start": 0, "end": 3},
        {"text": "a person waves", "start": 1, "end": 2.5, "parts": ["left-arm"]},
        {"text": "a person sits", "start": 3, "end": 6, "tag": "sit"},
    ]
    (folder / "timeline.json").write_text(json.dumps(entries))
    lines = [f"- {{text: {e['text']}, start: {e['start']}, end: {e['end']}}}" for e in entries[::2]]
    (folder / "timeline.yaml").write_text("\n".join(lines) + "\n")
    points = [[0, 0, 0, 0], [1, 0.5, 1.5, 20], [2, 2, 3.5, 45]]
    (folder / "path.json").write_text(json.dumps({"points": points}))
    rows = ["x,z,t,heading", *(",".join(map(str, point)) for point in points)]
    (folder / "path.csv").write_text("\n".join(rows) + "\n")


# ---------------------------------------------------------------- reading


def _read_any(path: Path) -> None:
    from src.shared.data.retarget.read_motion import read_motion

    check_motion(read_motion(path))


def _read_acclaim(path: Path) -> None:
    from src.shared.data.retarget.read_motion import read_motion

    check_motion(read_motion(path.with_suffix(".amc"), skeleton=path.with_suffix(".asf")))


def _read_rig(path: Path) -> None:
    """As a motion, and as the skeleton of somebody's character."""
    from src.shared.data.retarget.to_rig import read_target
    from src.shared.errors import UserError

    with contextlib.suppress(UserError):
        read_target(path)
    _read_any(path)


def _read_trajectory(path: Path) -> None:
    from src.shared.formats.registry import read_trajectory

    trajectory = read_trajectory(path)
    check_arrays([trajectory.data])
    assert trajectory.data.shape[1] == 25 and 0 < trajectory.fps <= 10_000


def _read_direction(path: Path) -> None:
    from src.shared.pipelines.path import read_path
    from src.shared.pipelines.timeline import read_timeline

    if path.stem == "timeline":
        read_timeline(path, fps=30.0)
        return
    drawn = read_path(path)
    check_arrays(part for part in (drawn.points, drawn.times, drawn.headings) if part is not None)


BVH_WORDS = (
    b"HIERARCHY", b"ROOT", b"JOINT", b"End Site", b"OFFSET 0 0 0", b"CHANNELS 3 Zrotation",
    b"CHANNELS 6", b"MOTION", b"Frames: 5", b"Frame Time: 0.0", b"Zrotation", b"Xposition",
    b"JOINT a {", b"{ {", b"} }",
)  # fmt: skip
ASF_WORDS = (
    b":units", b":root", b":bonedata", b":hierarchy", b"begin", b"end", b"dof rx",
    b"axis 0 0 0 ZYX", b"name root", b"order RX RY", b"length 0", b"direction 0 0 0", b"root root",
    b"angle rad",
)  # fmt: skip
AMC_WORDS = (b":DEGREES", b":RADIANS", b":FULLY-SPECIFIED", b"root 0 0 0", b"lfemur 1 2", b"7")
MOTION_TARGETS = {
    "bvh": Target(_write_bvh, _read_any, words=BVH_WORDS),
    "asf": Target(_write_asf, _read_acclaim, damaged="*.asf", words=ASF_WORDS),
    "amc": Target(_write_asf, _read_acclaim, damaged="*.amc", words=AMC_WORDS),
    "npz": Target(_write_motions("npz"), _read_any),
    "amass": Target(_write_amass, _read_any),
    "humanml": Target(_write_humanml, _read_any),
    "csv": Target(_write_motions("csv"), _read_any, words=(b"time", b"pelvis_x", b"1,2,3")),
    "glb": Target(_write_motions("glb"), _read_rig),
    "rig": Target(_write_bvh, _read_rig, words=BVH_WORDS),
    "trajectory": Target(_write_trajectories, _read_trajectory, words=(b"time", b"1,2,3")),
    "directions": Target(_write_directions, _read_direction, words=(b"- text: a", b"x,z", b"0,0")),
}
