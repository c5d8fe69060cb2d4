"""Frames as lines and as VMC: read back by a reader of their own, and in Unity's hand."""

import json
import struct
from typing import Any

import numpy as np

from src.shared.formats.rig import SCHEMES
from src.shared.motion.skeleton import JOINT_NAMES, canonical_skeleton
from src.shared.pipelines.live import Frame, json_line, vmc_bundle


def frame(**changes: Any) -> Frame:
    quaternions = np.tile(np.array([1.0, 0.0, 0.0, 0.0], np.float32), (22, 1))
    parts = {
        "number": 3, "seconds": 0.1, "text": "a “person” 歩く", "root": np.array([0.5, 0.9, 2.0]),
        "quaternions": quaternions, "contacts": np.array([0.0, 1.0]),
    }  # fmt: skip
    return Frame(**(parts | changes))


def texts(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(b"\0", at)
    return data[at:end].decode(), at + (end - at) // 4 * 4 + 4


def messages(bundle: bytes) -> list[tuple[str, list[Any]]]:
    """By the words of the OSC 1.0 specification."""
    assert bundle[:8] == b"#bundle\0" and len(bundle) % 4 == 0
    found, at = [], 16
    while at < len(bundle):
        (size,) = struct.unpack_from(">i", bundle, at)
        data, at = bundle[at + 4 : at + 4 + size], at + 4 + size
        address, here = texts(data, 0)
        kinds, here = texts(data, here)
        values: list[Any] = []
        for kind in kinds[1:]:
            if kind == "s":
                value, here = texts(data, here)
                values.append(value)
            else:
                values.append(struct.unpack_from(f">{kind}", data, here)[0])
                here += 4
        assert here == size
        found.append((address, values))
    return found


def test_a_line_is_whole() -> None:
    line = json_line(frame())
    assert "\n" not in line
    found = json.loads(line)
    assert found["frame"] == 3 and found["text"] == "a “person” 歩く"
    assert np.shape(found["rotations"]) == (22, 4) and found["root"] == [0.5, 0.9, 2.0]


def test_vmc_tells_every_bone_once() -> None:
    found = messages(vmc_bundle(frame()))
    bones = {values[0]: values[1:] for address, values in found if address == "/VMC/Ext/Bone/Pos"}
    assert len(bones) == 22 and set(bones) == set(SCHEMES["unity"])
    np.testing.assert_allclose(bones["Hips"], [-0.5, 0.9, 2.0, 0, 0, 0, 1], atol=1e-6)
    x, y, z = canonical_skeleton().offsets[JOINT_NAMES.index("l_elbow")]
    np.testing.assert_allclose(bones["LeftLowerArm"][:3], [-x, y, z], atol=1e-6)
    assert x > 0, "the left of who faces +Z is +X here, and -X in Unity"
    assert [values for address, values in found if address == "/VMC/Ext/OK"] == [[1]]
    assert dict(found)["/VMC/Ext/T"][0] == np.float32(0.1)


def test_turns_change_hands() -> None:
    """A turn to the left by 90°: about +Y by +90° here, by -90° where +X is the right."""
    quaternions = np.tile(np.array([1.0, 0.0, 0.0, 0.0]), (22, 1))
    quaternions[0] = [np.cos(np.pi / 4), 0.0, np.sin(np.pi / 4), 0.0]
    found = messages(vmc_bundle(frame(quaternions=quaternions)))
    (hips,) = [values for _, values in found if values[0] == "Hips"]
    half = np.sqrt(0.5)
    np.testing.assert_allclose(hips[4:], [0.0, -half, 0.0, half], atol=1e-6)
