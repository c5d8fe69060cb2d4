"""Kinetic and geometric features against frame-by-frame loops, symmetries, and known motions."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.metrics.kinetic import (
    HIPS,
    SHOULDERS,
    UPPER_ARM,
    geometric_features,
    geometric_relations,
    kinetic_features,
    root_geometric_features,
    root_kinetic_features,
    windowed_mean,
)
from src.shared.motion.skeleton import (
    JOINT_INDEX,
    MIRROR,
    PARENTS,
    REST_PELVIS_HEIGHT,
    canonical_skeleton,
)
from src.shared.motion.trajectory import MotionTrajectory

FPS = 30.0


def rest_points(num_frames: int = 20) -> np.ndarray:
    """The T-pose [T,22,3] on the floor, held."""
    points = canonical_skeleton().offsets.astype(np.float64).copy()
    for joint, parent in enumerate(PARENTS):
        points[joint] += points[parent] if parent >= 0 else (0, REST_PELVIS_HEIGHT, 0)
    return np.repeat(points[None], num_frames, 0)


def wild_points(seed: int, num_frames: int = 40) -> np.ndarray:
    """A body whose joints swing far and fast, so that every relation holds now and then."""
    rng = np.random.default_rng(seed)
    time = np.arange(num_frames)[:, None, None] / FPS
    swing = np.sin(2 * np.pi * rng.uniform(0.2, 2, (1, 22, 3)) * time + rng.uniform(0, 6, (22, 3)))
    return rest_points(num_frames) + 0.5 * swing


def rotated(points: np.ndarray, angle: float) -> np.ndarray:
    turn = np.array(
        [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    )
    return points @ turn.T


# ---------------------------------------------------------------- kinetic


def kinetic_by_loops(points: np.ndarray, fps: float) -> np.ndarray:
    """As published, frame by frame, with the acceleration mended and its last centre left out."""
    frames, joints, _ = points.shape
    found = np.zeros((joints, 3))
    for joint in range(joints):
        path, bends = points[:, joint], []
        for i in range(1, frames):
            steps = [
                path[i + j] - path[i + j - 1] for j in range(-2, 3) if 1 <= i + j <= frames - 1
            ]
            velocity = sum(steps) / (len(steps) / fps)
            found[joint, 0] += (velocity[0] ** 2 + velocity[2] ** 2) / (frames - 1)
            found[joint, 1] += velocity[1] ** 2 / (frames - 1)
        for i in range(1, frames - 1):
            bends = [
                ((path[c + 1] - path[c]) * fps - (path[c] - path[c - 1]) * fps) * fps
                for c in range(i - 2, i + 3)
                if 1 <= c <= frames - 2
            ]
            found[joint, 2] += np.linalg.norm(sum(bends) / len(bends)) / (frames - 2)
    return found


@pytest.mark.parametrize("num_frames", [3, 4, 5, 23])
def test_kinetic_features_are_those_of_the_loops(num_frames: int) -> None:
    points = np.random.default_rng(num_frames).normal(size=(num_frames, 3, 3))
    assert np.allclose(kinetic_features(points, 24.0), kinetic_by_loops(points, 24.0))


def test_a_glide_a_fall_and_a_circle_by_construction() -> None:
    time = np.arange(90)[:, None] / FPS
    glide = 5 + time[:, None] * np.array([3.0, 0.0, 4.0])
    assert np.allclose(kinetic_features(glide, FPS)[0], [25, 0, 0], atol=1e-9)
    fall = np.stack((0 * time, -0.5 * 9.81 * time**2, 0 * time), -1)
    assert kinetic_features(fall, FPS)[0, 2] == pytest.approx(9.81)
    circle = np.stack((np.cos(2 * time), 0 * time, np.sin(2 * time)), -1)
    assert kinetic_features(circle, FPS)[0] == pytest.approx([4, 0, 4], rel=0.02)
    assert np.allclose(kinetic_features(np.full((9, 2, 3), 7.0), FPS), 0)


@given(st.floats(-3, 3), st.floats(-50, 50), st.floats(-50, 50), st.integers(0, 9))
@settings(max_examples=25, deadline=None)
def test_kinetic_features_know_no_place_heading_or_direction_of_time(
    angle: float, x: float, y: float, seed: int
) -> None:
    points = wild_points(seed)
    before = kinetic_features(points, FPS)
    assert np.allclose(kinetic_features(rotated(points, angle) + (x, y, -x), FPS), before)
    assert np.allclose(kinetic_features(points[::-1], FPS), before)
    assert np.allclose(kinetic_features(points, 2 * FPS), before * (4, 4, 4))


def test_windows_are_means_of_what_is_there() -> None:
    values = np.random.default_rng(0).normal(size=(7, 2))
    plain = [values[max(0, i - 2) : i + 3].mean(0) for i in range(7)]
    assert np.allclose(windowed_mean(values), plain)


# ---------------------------------------------------------------- geometric


def relations_by_loops(points: np.ndarray, fps: float) -> dict[str, np.ndarray]:
    """Generic features of Müller et al. 2005, one frame and one relation at a time."""
    hl, sw, hw = UPPER_ARM, SHOULDERS, HIPS
    found: dict[str, list[bool]] = {}
    for t in range(len(points) - 1):

        def at(name: str, t: int = t) -> np.ndarray:
            return points[t, JOINT_INDEX[name]]

        def along(vector: np.ndarray, axis: np.ndarray) -> float:
            return float(vector @ axis / np.linalg.norm(axis))

        def speed_along(axis: np.ndarray, of: str, seen_from: str, t: int = t) -> float:
            gap = [
                points[k, JOINT_INDEX[of]] - points[k, JOINT_INDEX[seen_from]] for k in (t, t + 1)
            ]
            return float((gap[1] - gap[0]) @ axis / np.linalg.norm(axis) * fps)

        def speed(of: str, t: int = t) -> float:
            step = points[t + 1, JOINT_INDEX[of]] - points[t, JOINT_INDEX[of]]
            return float(np.sqrt((step**2).sum()) * fps)

        def angle(a: str, b: str, c: str, d: str, at: Callable[[str], np.ndarray] = at) -> float:
            u, v = at(b) - at(a), at(d) - at(c)
            cosine = u @ v / np.sqrt((u @ u) * (v @ v))
            return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))

        def plane(a: str, b: str, c: str, at: Callable[[str], np.ndarray] = at) -> np.ndarray:
            """Unit normal of the plane through three joints, on the side the body faces."""
            normal = np.cross(at(b) - at(a), at(c) - at(a))
            ahead = np.cross(at("r_hip") - at("neck"), at("l_hip") - at("neck"))
            return normal / np.linalg.norm(normal) * (1 if normal @ ahead >= 0 else -1)

        def say(name: str, holds: bool) -> None:
            found.setdefault(name, []).append(bool(holds))

        lowest = min(points[t, :, 1])
        for s, o in (("r", "l"), ("l", "r")):
            wrist, elbow, ankle = f"{s}_wrist", f"{s}_elbow", f"{s}_ankle"
            hip, knee, shoulder = f"{s}_hip", f"{s}_knee", f"{s}_shoulder"
            say(f"{s} hand forwards",
                speed_along(plane("neck", "r_hip", "l_hip"), wrist, "neck") > 1.8 * hl)  # fmt: skip
            up = at("neck") - at("spine3")
            say(
                f"{s} hand above neck",
                (at(wrist) - at("neck")) @ up / np.linalg.norm(up) > 0.2 * hl,
            )
            say(f"{s} hand upwards",
                speed_along(at("spine3") - at("spine1"), wrist, "spine3") > 1.8 * hl)  # fmt: skip
            say(f"{s} elbow bent", angle(elbow, shoulder, elbow, wrist) < 110)
            say(f"{s} hand leaves pelvis",
                speed_along(at(wrist) - at("pelvis"), wrist, "pelvis") > 1.4 * hl)  # fmt: skip
            say(f"{s} hand fast", speed(wrist) > 2.5 * hl)
            leg = plane("pelvis", f"{o}_hip", f"{o}_foot")
            say(f"{s} foot before other leg", leg @ (at(ankle) - at("pelvis")) > 0.38 * hl)
            say(f"{s} foot raised", at(ankle)[1] - lowest > 1.2 * hl)
            say(f"{s} knee bent", angle(knee, hip, knee, ankle) < 110)
            say(f"{s} foot fast", speed(ankle) > 2.5 * hl)
            say(f"{s} arm away from trunk", angle("neck", "pelvis", shoulder, elbow) > 25)
            say(f"{s} leg away from trunk", angle("neck", "pelvis", hip, knee) > 50)
            say(f"{s} hand low", at(wrist)[1] - lowest < 1.2 * hl)
        across = at("r_shoulder") - at("l_shoulder")
        span = at("r_wrist") - at("l_wrist")
        say("hands apart", along(span, across) > 2.5 * sw)
        say("hands approach", speed_along(span, "l_wrist", "r_wrist") > 1.4 * hl)
        across = at("r_hip") - at("l_hip")
        say(
            "feet apart",
            along(at("r_ankle") - at("l_ankle"), across) > 2.1 * hw,
        )
        stance = np.cross(at("l_ankle") - at("r_ankle"), at("neck") - at("r_ankle"))
        stance /= np.linalg.norm(stance)
        say("pelvis before feet", stance @ (at("pelvis") - at("r_ankle")) > 0.5 * hl)
        trunk = at("pelvis") - at("neck")
        say("trunk level", 70 < np.degrees(np.arccos(trunk[1] / np.linalg.norm(trunk))) < 110)
        say("pelvis fast", speed("pelvis") > 2.3 * hl)
    return {name: np.array(holds) for name, holds in found.items()}


@pytest.mark.parametrize("seed", [0, 1])
def test_relations_are_those_of_the_loops(seed: int) -> None:
    points = wild_points(seed)
    ours, plain = geometric_relations(points, FPS), relations_by_loops(points, FPS)
    assert set(ours) == set(plain) and len(ours) == 32
    for name, holds in plain.items():
        assert np.array_equal(ours[name], holds), name
    assert sum(0 < holds.mean() < 1 for holds in plain.values()) > 20


def test_what_holds_of_a_t_pose() -> None:
    relations = geometric_relations(rest_points(), FPS)
    true = {name for name, holds in relations.items() if holds.all()}
    assert true == {"hands apart", "r arm away from trunk", "l arm away from trunk"}
    assert geometric_features(rest_points(), FPS).sum() == 3


@given(st.floats(-3, 3), st.floats(-50, 50), st.integers(0, 9))
@settings(max_examples=15, deadline=None)
def test_relations_know_no_place_or_heading(angle: float, shift: float, seed: int) -> None:
    points = wild_points(seed)
    moved = rotated(points, angle) + (shift, -shift / 9, 2 * shift)
    # a frame on the very edge of a relation may round to the other side of it
    apart = np.abs(geometric_features(moved, FPS) - geometric_features(points, FPS))
    assert apart.max() <= 1 / (len(points) - 1) + 1e-9


def test_a_mirror_swaps_left_and_right() -> None:
    points = wild_points(3)
    ours = geometric_relations(points, FPS)
    mirrored = geometric_relations(points[:, list(MIRROR)] * (-1, 1, 1), FPS)
    for name, holds in ours.items():
        other = {"r": "l ", "l": "r "}.get(name[0]) if name[1] == " " else None
        assert np.array_equal(mirrored[other + name[2:] if other else name], holds), name


def test_lengths_of_the_skeleton() -> None:
    points = rest_points()[0]

    def apart(a: str, b: str) -> float:
        return float(np.linalg.norm(points[JOINT_INDEX[a]] - points[JOINT_INDEX[b]]))

    assert apart("l_shoulder", "l_elbow") == pytest.approx(UPPER_ARM)
    assert apart("l_shoulder", "r_shoulder") == pytest.approx(SHOULDERS)
    assert apart("l_hip", "r_hip") == pytest.approx(HIPS)


# ---------------------------------------------------------------- a pelvis alone


def path(forward: float, turn: float, *, height: float = REST_PELVIS_HEIGHT) -> MotionTrajectory:
    """Two seconds straight ahead at `forward` m/s, or on the spot turning at `turn` rad/s."""
    time = np.arange(60) / FPS
    position = np.stack((0 * time, height + 0 * time, forward * time), -1)
    half = turn * time / 2
    quaternion = np.stack((np.cos(half), 0 * half, np.sin(half), 0 * half), -1)
    return MotionTrajectory.from_pose(position, quaternion, time)


ROOT_RELATIONS = (
    "low", "high", "rising", "sinking", "fast", "forward", "backward", "to the left",
    "to the right", "turning left", "turning right", "leaning",
)  # fmt: skip


def holds(trajectory: MotionTrajectory) -> set[str]:
    shares = root_geometric_features(trajectory)
    return {name for name, share in zip(ROOT_RELATIONS, shares, strict=True) if share == 1}


def test_root_features_by_construction() -> None:
    assert root_kinetic_features(path(1.5, 0)) == pytest.approx([2.25, 0, 0, 0, 0], abs=1e-3)
    assert root_kinetic_features(path(0, 2)) == pytest.approx([0, 0, 0, 4, 0], abs=1e-3)
    assert holds(path(1.5, 0)) == {"fast", "forward"}
    assert holds(path(-0.4, 0)) == {"backward"}
    assert holds(path(0, 2)) == {"turning left"} and holds(path(0, -2)) == {"turning right"}
    assert holds(path(0, 0, height=0.5)) == {"low"} and holds(path(0, 0)) == set()


def test_a_sidestep_and_a_lean() -> None:
    time = np.arange(30) / FPS
    position = np.stack((0.5 * time, 1 + 0.5 * time, 0 * time), -1)  # to its left, and up
    angle = np.radians(25) / 2 + 0 * time
    quaternion = np.stack((np.cos(angle), np.sin(angle), 0 * time, 0 * time), -1)
    found = holds(MotionTrajectory.from_pose(position, quaternion, time))
    assert found == {"to the left", "rising", "high", "fast", "leaning"}


@given(st.floats(-3, 3), st.floats(-20, 20), st.integers(0, 9))
@settings(max_examples=15, deadline=None)
def test_root_features_know_no_place_or_heading(angle: float, shift: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    time = np.arange(40) / FPS
    position = np.cumsum(rng.normal(0, 0.02, (40, 3)), 0) + (0, 0.9, 0)
    half = (np.cumsum(rng.normal(0, 0.1, 40))) / 2

    def trajectory(turn: float, move: float) -> MotionTrajectory:
        whole = half + turn / 2
        quaternion = np.stack((np.cos(whole), 0 * whole, np.sin(whole), 0 * whole), -1)
        return MotionTrajectory.from_pose(
            rotated(position, turn) + (move, 0, -move), quaternion, time
        )

    before, after = trajectory(0, 0), trajectory(angle, shift)
    assert np.allclose(
        root_kinetic_features(after), root_kinetic_features(before), rtol=2e-2, atol=1e-3
    )  # positions are float32: 20 m away they are coarser
    shares = np.abs(root_geometric_features(after) - root_geometric_features(before))
    assert shares.max() <= 2 / 39


def test_bad_input_is_named() -> None:
    points = wild_points(0)
    with pytest.raises(ValueError, match="at least 3"):
        kinetic_features(points[:2], FPS)
    for bad in (np.nan, np.inf):
        points[5, 4, 1] = bad
        with pytest.raises(ValueError, match="NaN"):
            kinetic_features(points, FPS)
        with pytest.raises(ValueError, match="NaN"):
            geometric_features(points, FPS)
    with pytest.raises(ValueError, match="all 22"):
        geometric_features(points[:, :9], FPS)
    broken = path(1, 0)
    broken.data[3, 1] = np.nan
    with pytest.raises(ValueError, match="NaN"):
        root_geometric_features(broken)
