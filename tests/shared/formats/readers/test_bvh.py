"""BVH reader: transforms against scipy, every known trap, and no file that crashes it."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.errors import UserError
from src.shared.formats.limits import check_size
from src.shared.formats.readers.bvh import BvhClip, read_bvh

HEADER = """HIERARCHY
ROOT Hips
{
\tOFFSET 1.0 2.0 3.0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
\tJOINT Left Arm
\t{
\t\tOFFSET 0 10 0
\t\tCHANNELS 3 Yrotation Xrotation Zrotation
\t\tEnd Site
\t\t{
\t\t\tOFFSET 0 5 0
\t\t}
\t}
\tJOINT Leg {
\t\tOFFSET 0 -10 0
\t\tCHANNELS 4 Yposition Xrotation Zrotation Yrotation
\t}
}
"""
ROWS = [
    "4 5 6 10 20 30 -40 50 60 7 70 80 -90",
    "4 5 6 -10 -20 -30 40 -50 60 8 70 80 90",
    "1 1 1 0 90 0 0 90 0 9 180 0 0",
]
GOOD = HEADER + "MOTION\nFrames: 3\nFrame Time: .0083333\n" + "\n".join(ROWS) + "\n"


def save(folder: Path, text: str | bytes) -> Path:
    path = folder / "clip.bvh"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def reference(clip: BvhClip) -> tuple[np.ndarray, np.ndarray]:
    """Joint by joint, frame by frame, with scipy's intrinsic Euler angles."""
    positions = np.zeros((clip.num_frames, len(clip.names), 3))
    rotations = np.zeros((clip.num_frames, len(clip.names), 3, 3))
    for frame, row in enumerate(clip.values):
        rest = list(row)
        for joint, parent in enumerate(clip.parents):
            place, angles = clip.offsets[joint].copy(), []
            for channel in clip.channels[joint]:
                value = rest.pop(0)
                if channel.endswith("position"):
                    place["XYZ".index(channel[0])] = value
                else:
                    angles.append(value)
            order = clip.rotation_orders[joint]
            turn = Rotation.from_euler(order, angles, degrees=True).as_matrix()
            above = rotations[frame, parent] if parent >= 0 else np.eye(3)
            origin = positions[frame, parent] if parent >= 0 else np.zeros(3)
            positions[frame, joint] = origin + above @ place
            rotations[frame, joint] = above @ turn
    return positions, rotations


def test_reads_the_hierarchy_as_it_stands(tmp_path: Path) -> None:
    clip = read_bvh(save(tmp_path, GOOD))
    assert clip.names == ("Hips", "Left Arm", "Leg")
    assert clip.parents == (-1, 0, 0)
    assert clip.rotation_orders == ("ZYX", "YXZ", "XZY")
    assert clip.end_sites == ((1, (0.0, 5.0, 0.0)),)
    assert clip.values.shape == (3, 13)
    assert clip.frame_time == 0.0083333
    assert 1 / clip.frame_time == pytest.approx(120, rel=1e-4)


def test_world_transforms_agree_with_scipy(tmp_path: Path) -> None:
    clip = read_bvh(save(tmp_path, GOOD))
    positions, rotations = clip.world()
    expected_positions, expected_rotations = reference(clip)
    np.testing.assert_allclose(positions, expected_positions, atol=1e-9)
    np.testing.assert_allclose(rotations, expected_rotations, atol=1e-12)


@settings(max_examples=40, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.lists(st.permutations(["Xrotation", "Yrotation", "Zrotation"]), min_size=3, max_size=3),
       st.permutations(["Xposition", "Yposition", "Zposition"]), st.booleans(),
       st.integers(0, 2**32 - 1))  # fmt: skip
def test_any_channel_order_agrees_with_scipy(
    tmp_path: Path, turns: list[list[str]], moves: list[str], turns_first: bool, seed: int
) -> None:
    channels = [list(turn) for turn in turns]
    channels[0] = turns[0] + moves if turns_first else moves + turns[0]
    lines = [f"CHANNELS {len(names)} {' '.join(names)}" for names in channels]
    header = iter(lines)
    text = "\n".join(next(header) if "CHANNELS" in line else line for line in HEADER.splitlines())
    values = np.random.default_rng(seed).uniform(-360, 360, (2, 12)).round(4)
    rows = "\n".join(" ".join(map(str, row)) for row in values)
    clip = read_bvh(save(tmp_path, f"{text}\nMOTION\nFrames: 2\nFrame Time: 0.04\n{rows}\n"))
    assert clip.channels == tuple(map(tuple, channels))
    positions, rotations = clip.world()
    expected_positions, expected_rotations = reference(clip)
    np.testing.assert_allclose(positions, expected_positions, atol=1e-8)
    np.testing.assert_allclose(rotations, expected_rotations, atol=1e-12)


def test_bvhio_sees_the_same_world(tmp_path: Path) -> None:
    """An independent reader, on a file whose only positions are the root's."""
    bvhio = pytest.importorskip("bvhio")
    text = (
        GOOD.replace("Leg {", "Leg\n\t{")
        .replace("CHANNELS 4 Yposition", "CHANNELS 3")
        .replace("60 7 ", "60 ")
    )
    text = text.replace("60 8 ", "60 ").replace("0 9 ", "0 ").replace("Left Arm", "LeftArm")
    clip = read_bvh(save(tmp_path, text))
    root = bvhio.readAsHierarchy(str(tmp_path / "clip.bvh"))
    joints = {joint.Name: joint for joint, _, _ in root.layout()}
    for frame, expected in enumerate(clip.world()[0]):
        root.loadPose(frame, recursive=True)
        found = [list(joints[name].PositionWorld) for name in clip.names]
        np.testing.assert_allclose(found, expected, atol=0.1)  # the file is in centimetres


def test_position_channels_replace_the_offset(tmp_path: Path) -> None:
    local = read_bvh(save(tmp_path, GOOD)).local_translations()
    np.testing.assert_array_equal(local[0], [[4, 5, 6], [0, 10, 0], [0, 7, 0]])


@pytest.mark.parametrize("change", [
    lambda text: text.replace("\n", "\r\n"),
    lambda text: text.replace("\n", "\r"),
    lambda text: text.rstrip("\n"),
    lambda text: text.replace(" ", "\t\t"),
    lambda text: "\ufeff" + text,
    lambda text: text.replace("MOTION", "  motion "),
    lambda text: text.replace("Xrotation", "XROTATION").replace("JOINT", "joint"),
    lambda text: text.replace("Frames: 3", "Frames:\t3").replace("Time: .", "Time:0."),
    lambda text: text.replace("\n{", " {"),
    lambda text: text + "\n \n\t\n",
])  # fmt: skip
def test_harmless_spellings_read_the_same(tmp_path: Path, change: object) -> None:
    expected = read_bvh(save(tmp_path, GOOD))
    clip = read_bvh(save(tmp_path, change(GOOD)))  # type: ignore[operator]
    assert clip.channels == expected.channels
    np.testing.assert_array_equal(clip.values, expected.values)


def test_stride_skips_frames_and_stretches_time(tmp_path: Path) -> None:
    clip = read_bvh(save(tmp_path, GOOD)).every(2)
    assert clip.num_frames == 2
    assert clip.frame_time == pytest.approx(2 * 0.0083333)
    np.testing.assert_array_equal(clip.values, read_bvh(tmp_path / "clip.bvh").values[::2])


FAULTS = {
    "empty": ("", "is empty"),
    "other text": ("hello\n", "line 1: does not start with HIERARCHY"),
    "binary": (b"HIERARCHY\x00\xff\xfe", "binary"),
    "no motion": (HEADER, "no MOTION"),
    "cut hierarchy": (HEADER[:150], "is missing"),
    "frames missing": (GOOD.replace("Frames: 3\n", ""), "not followed by"),
    "negative frames": (GOOD.replace("Frames: 3", "Frames: -3"), "line 21: Frames is -3"),
    "huge frames": (GOOD.replace("Frames: 3", "Frames: 99999999999999"), "line 21: Frames is 99"),
    "many frames": (GOOD.replace("Frames: 3", "Frames: 1000000"), "3 rows follow"),
    "frames not a number": (GOOD.replace("Frames: 3", "Frames: many"), "'many'"),
    "frames mismatch": (GOOD.replace("Frames: 3", "Frames: 2"), "line 21: Frames says 2, but 3"),
    "frame time": (GOOD.replace(".0083333", "0"), "line 22: Frame Time 0"),
    "frame time nan": (GOOD.replace(".0083333", "nan"), "Frame Time nan"),
    "frame time words": (GOOD.replace(".0083333", "0,03"), "'0,03'"),
    "nan": (GOOD.replace("-20", "nan"), "line 24: value nan in frame 2"),
    "infinite": (GOOD.replace("-20", "-1e999"), "frame 2"),
    "absurd": (GOOD.replace("-20", "1e30"), "frame 2"),
    "word in a row": (GOOD.replace("-20", "oops"), "line 24: 'oops' is not a number"),
    "decimal comma": (GOOD.replace("-20", "-20,5"), "line 24"),
    "short row": (GOOD.replace(" -90", ""), "line 23: row holds 12 values"),
    "cut off": (GOOD[:-20], "line 25: row holds"),
    "no rows": (HEADER + "MOTION\nFrames: 3\nFrame Time: 0.03\n", "0 rows follow"),
    "trailing junk": (GOOD + "junk", "line 26: 'junk'"),
    "channel count": (GOOD.replace("CHANNELS 3", "CHANNELS 1000000000"), "line 9: CHANNELS says"),
    "unknown channel": (GOOD.replace("CHANNELS 3 Y", "CHANNELS 3 W"), "line 9: unknown channel"),
    "channel twice": (GOOD.replace("3 Yrotation X", "3 Zrotation X"), "names a channel twice"),
    "offset": (GOOD.replace("OFFSET 0 10 0", "OFFSET 0 10"), "line 8: OFFSET"),
    "offset nan": (GOOD.replace("OFFSET 0 10 0", "OFFSET 0 nan 0"), "line 8: OFFSET"),
    "stray brace": (GOOD.replace("MOTION", "}\nMOTION"), "line 20: unexpected"),
    "nameless": (GOOD.replace("JOINT Left Arm", "JOINT"), "line 6: JOINT without a name"),
    "joint outside": (GOOD.replace("ROOT", "JOINT"), "line 2: JOINT outside a ROOT"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults_name_file_and_line(tmp_path: Path, name: str) -> None:
    text, message = FAULTS[name]
    with pytest.raises(UserError) as caught:
        read_bvh(save(tmp_path, text))
    assert message in str(caught.value)
    assert "clip.bvh" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_and_oversized_files(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"none\.bvh does not exist"):
        read_bvh(tmp_path / "none.bvh")
    with pytest.raises(UserError, match="over the limit"):
        check_size(save(tmp_path, GOOD), 100)


def test_deep_nesting_is_no_recursion(tmp_path: Path) -> None:
    deep = "".join(f"{'JOINT' if i else 'ROOT'} j{i}\n{{\nOFFSET 0 1 0\n" for i in range(1500))
    tail = "CHANNELS 1 Xrotation\n" + "}\n" * 1500
    clip = read_bvh(save(tmp_path, f"HIERARCHY\n{deep}{tail}MOTION\nFrames: 1\nFrame Time: 1\n5\n"))
    assert len(clip.names) == 1500
    np.testing.assert_allclose(clip.world()[0][0, -1], [0, 1500, 0])
    too_many = deep + "JOINT more\n{\n" * 600
    with pytest.raises(UserError, match="more than 2000 joints"):
        read_bvh(save(tmp_path, f"HIERARCHY\n{too_many}"))


def test_long_files_are_read_in_blocks(tmp_path: Path) -> None:
    values = np.random.default_rng(0).uniform(-180, 180, (60_000, 13)).round(5)
    rows = "\n".join(" ".join(map(str, row)) for row in values.tolist())
    text = GOOD.replace("Frames: 3", "Frames: 60000").split(".0083333")[0] + ".01\n" + rows
    assert len(text) > 6 << 20  # more than one block
    np.testing.assert_array_equal(read_bvh(save(tmp_path, text)).values, values)
    with pytest.raises(UserError, match="line 60022: row holds 12"):
        read_bvh(save(tmp_path, text.rsplit(" ", 1)[0]))


@settings(max_examples=150, deadline=None,
          suppress_health_check=[HealthCheck.function_scoped_fixture])  # fmt: skip
@given(st.data())
def test_damaged_files_raise_user_errors_only(tmp_path: Path, data: st.DataObject) -> None:
    """Cut, repeat or overwrite a piece anywhere: a clip or a UserError, never anything else."""
    text = GOOD.encode()
    start = data.draw(st.integers(0, len(text)))
    stop = data.draw(st.integers(start, min(len(text), start + 60)))
    piece = data.draw(st.binary(max_size=20) | st.sampled_from([b"", text[start:stop] * 2]))
    try:
        clip = read_bvh(save(tmp_path, text[:start] + piece + text[stop:]))
        assert all(np.isfinite(array).all() for array in clip.world())
    except UserError as error:
        assert "clip.bvh" in str(error)
