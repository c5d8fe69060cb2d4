"""ASF/AMC reader: transforms against scipy, written from the definition; faults by line."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.errors import UserError
from src.shared.formats.readers.acclaim import INCH, read_amc, read_asf

ASF = """# made by hand
:version 1.10
:name VICON
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   begin end hips: whatever is said here counts for nothing
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 1 0
   orientation 10 20 30
:bonedata
  begin
     id 1
     name hip
     direction 0.6 -0.8 0
     length 2.5
     axis 0 0 20 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
  end
  begin
     id 2
     name shin
     direction 0 -1 0
     length 4
     axis -90 7.6e-016 20 ZXY
    dof rz rx
  end
  begin
     id 3
     name spine
     direction 0 1 0
     length 3
     axis 0 0 0 XYZ
  end
  begin
     name head
     direction 0 0.6 0.8
     length 1
     axis 5 6 7 YZX
     dof ry
  end
:hierarchy
  begin
    root hip spine
    hip shin
    spine head
  end
"""
FRAMES = [
    "root 1 2 3 40 50 -60\nhip 10 -20 30\nshin 15 -25\nhead 35",
    "root 0 0 0 0 0 0\nshin 0 0\nhip 0 0 0\nhead 0",
    "root -1 4.5 2e1 -170 85 10\nhip 1 2 3\nshin -100 9\nhead -0.5",
]
AMC = "#!OML:ASF X:\\f\xfcr\\a.ASF\n:FULLY-SPECIFIED\n:DEGREES\n" + "".join(
    f"{number}\n{frame}\n" for number, frame in enumerate(FRAMES, 1)
)


def save(folder: Path, amc: str = AMC, asf: str = ASF) -> Path:
    (folder / "a.asf").write_bytes(asf.encode("latin-1"))
    (folder / "a_01.amc").write_bytes(amc.encode("latin-1"))
    return folder / "a_01.amc"


def reference(frame: str, asf: str = ASF) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """(start, world rotation) of each bone, by the definition: a bone at rest is turned by C M C⁻¹.

    Written bone by bone with scipy; capital letters in scipy turn with the body, small ones about
    fixed axes, which is what Acclaim means.
    """
    bones: dict[str, dict[str, list[str]]] = {}
    for block in asf.split(":bonedata")[1].split(":hierarchy")[0].split("begin")[1:]:
        lines = [line.split() for line in block.splitlines() if line.split()]
        entry = {line[0]: line[1:] for line in lines}
        bones[entry["name"][0]] = entry
    parents = {child: line.split()[0] for line in asf.split(":hierarchy")[1].splitlines()
               for child in line.split()[1:]}  # fmt: skip
    values = {line.split()[0]: [float(word) for word in line.split()[1:]]
              for line in frame.splitlines()}  # fmt: skip
    base = Rotation.from_euler("xyz", [10, 20, 30], degrees=True)
    turn = Rotation.from_euler("xyz", values["root"][3:], degrees=True)
    place = np.add([0, 1, 0], values["root"][:3])
    found = {"root": (place, base * turn * base.inv(), place)}
    for name in ("hip", "shin", "spine", "head"):
        bone = bones[name]
        axes = Rotation.from_euler(
            bone["axis"][3].lower(), [float(a) for a in sorted_axis(bone["axis"])], degrees=True
        )
        own = Rotation.identity()
        for channel, angle in zip(bone.get("dof", []), values.get(name, []), strict=True):
            own = Rotation.from_euler(channel[1], angle, degrees=True) * own
        _, above, end = found[parents[name]]
        world = above * axes * own * axes.inv()
        bone_vector = np.array(bone["direction"], float) * float(bone["length"][0])
        found[name] = (end, world, end + world.apply(bone_vector))
    return {name: (start, world.as_matrix()) for name, (start, world, _) in found.items()}


def sorted_axis(axis: list[str]) -> list[str]:
    """The angles stand in x, y, z order; scipy wants them in the order of turning."""
    return [axis["xyz".index(letter)] for letter in axis[3].lower()]


def test_world_transforms_agree_with_scipy(tmp_path: Path) -> None:
    clip = read_amc(save(tmp_path))
    assert clip.names == ("root", "hip", "spine", "shin", "head")
    assert clip.parents == (-1, 0, 0, 1, 2)
    assert 1 / clip.frame_time == pytest.approx(120) and not clip.rate_is_known
    positions, rotations = clip.world()
    for index, frame in enumerate(FRAMES):
        for joint, name in enumerate(clip.names):
            start, world = reference(frame)[name]
            np.testing.assert_allclose(positions[index, joint], start, atol=1e-9, err_msg=name)
            np.testing.assert_allclose(rotations[index, joint], world, atol=1e-12, err_msg=name)


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.floats(-360, 360), min_size=12, max_size=12))
def test_any_angles_agree_with_scipy(tmp_path: Path, angles: list[float]) -> None:
    a = [f"{angle:.6f}" for angle in angles]
    frame = f"root {' '.join(a[:6])}\nhip {' '.join(a[6:9])}\nshin {a[9]} {a[10]}\nhead {a[11]}"
    positions, rotations = (x[0] for x in read_amc(save(tmp_path, f":DEG\n1\n{frame}\n")).world())
    for joint, name in enumerate(("root", "hip", "spine", "shin", "head")):
        start, world = reference(frame)[name]
        np.testing.assert_allclose(positions[joint], start, atol=1e-8)
        np.testing.assert_allclose(rotations[joint], world, atol=1e-9)


def test_bones_keep_their_length_and_units_are_inches(tmp_path: Path) -> None:
    clip = read_amc(save(tmp_path))
    positions = clip.world()[0]
    shin = np.linalg.norm(positions[:, 3] - positions[:, 1], axis=-1)
    np.testing.assert_allclose(shin, 2.5)
    assert clip.metres == pytest.approx(INCH / 0.45)


def test_radians_rates_and_blocks(tmp_path: Path) -> None:
    radians = ASF.replace("angle deg", "angle rad")
    for name in ("orientation 10 20 30", "axis 0 0 20", "axis -90 7.6e-016 20", "axis 5 6 7"):
        words = name.split()
        turned = " ".join(repr(math.radians(float(word))) for word in words[1:])
        radians = radians.replace(name, f"{words[0]} {turned}")
    lines = []
    for line in FRAMES[0].splitlines():
        name, *values = line.split()
        keep = 3 if name == "root" else 0
        turned = [*values[:keep], *(repr(math.radians(float(v))) for v in values[keep:])]
        lines.append(" ".join([name, *turned]))
    amc = ":RADIANS\n:SAMPLES-PER-SECOND 60\n" + "".join(
        f"{number}\n" + "\n".join(lines) + "\n" for number in range(1, 8)
    )
    clip = read_amc(save(tmp_path, amc, radians))
    expected = read_amc(save(tmp_path)).world()
    assert 1 / clip.frame_time == pytest.approx(60) and clip.rate_is_known
    for found, wanted in zip(clip.world(), expected, strict=True):
        np.testing.assert_allclose(found, np.repeat(wanted[:1], 7, 0), atol=1e-9)
    parts = [clip.world(slice(start, start + 3)) for start in (0, 3, 6)]
    np.testing.assert_allclose(np.concatenate([p for p, _ in parts]), clip.world()[0])
    assert clip.every(3).num_frames == 3 and clip.every(3).frame_time == pytest.approx(0.05)
    assert 1 / read_amc(save(tmp_path), fps=100).frame_time == pytest.approx(100)


@pytest.mark.parametrize("change", [
    lambda text: text.replace("\n", "\r\n"),
    lambda text: text.replace("\n", "\r"),
    lambda text: text.replace("  ", "\t"),
    lambda text: text.replace("\n", "\n\n# a remark\n"),
    lambda text: text.rstrip("\n"),
])  # fmt: skip
def test_harmless_spellings_read_the_same(tmp_path: Path, change: object) -> None:
    expected = read_amc(save(tmp_path)).world()
    found = read_amc(save(tmp_path, change(AMC), change(ASF))).world()  # type: ignore[operator]
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)


def test_the_skeleton_beside_it_is_found_by_name(tmp_path: Path) -> None:
    path = save(tmp_path)
    (tmp_path / "other.asf").write_text("nothing")
    assert read_amc(path).num_frames == 3
    lonely = path.rename(tmp_path / "z_01.amc")
    with pytest.raises(UserError, match=r"z_01\.amc.*a\.asf, other\.asf.*--skeleton"):
        read_amc(lonely)
    assert read_amc(lonely, tmp_path / "a.asf").num_frames == 3
    (tmp_path / "a.asf").unlink()
    (tmp_path / "other.asf").unlink()
    with pytest.raises(UserError, match=r"no \.asf file"):
        read_amc(lonely)


AMC_FAULTS = {
    "no frames": ("# nothing\n", "holds no frames"),
    "before a frame": ("hip 1 2 3\n", "line 1: 'hip' before the first frame"),
    "unknown bone": (AMC.replace("head 35", "tail 35"), "line 8: 'tail' is no moving bone"),
    "too few": (AMC.replace("hip 10 -20 30", "hip 10 -20"), "line 6: 'hip' has 2 values"),
    "no number": (AMC.replace("-20 30", "-20 x"), "line 6: 'hip 10 -20 x' does not hold"),
    "nan": (AMC.replace("head 35", "head nan"), "'head' is missing from frame 1"),
    "huge": (AMC.replace("head 35", "head 1e30"), "'head' is impossibly large in frame 1"),
    "bone missing": (AMC.replace("head 35\n", ""), "'head' is missing from frame 1"),
    "cut off": (AMC[:-10], "line 17: 'head' is missing"),
    "rate": (":SAMPLES-PER-SECOND fast\n" + AMC, "line 1: SAMPLES-PER-SECOND"),
    "long line": ("x" * (2 << 20), "impossibly long"),
    "binary": ("\x00\x01\x02\n", "before the first frame"),
}


@pytest.mark.parametrize("name", AMC_FAULTS)
def test_faults_of_a_motion_name_file_and_line(tmp_path: Path, name: str) -> None:
    text, message = AMC_FAULTS[name]
    with pytest.raises(UserError) as caught:
        read_amc(save(tmp_path, text))
    assert message in str(caught.value) and "a_01.amc" in str(caught.value)
    assert "\n" not in str(caught.value)


ASF_FAULTS = {
    "not asf": ("hello\n", "no :hierarchy"),
    "no bone entry": (ASF.replace("name shin", "name calf"), "'shin' has no entry"),
    "two bones": (ASF.replace("name shin", "name hip"), "second bone 'hip'"),
    "two parents": (ASF.replace("spine head", "spine head\nhip head"), "'head' has two parents"),
    "no parent": (ASF.replace("spine head", "neck head"), "'neck' has children"),
    "direction": (ASF.replace("0.6 -0.8 0\n", "0.6 -0.8\n"), "line 19: direction"),
    "length": (ASF.replace("length 2.5", "length long"), "line 20: length 'long'"),
    "infinite": (ASF.replace("length 2.5", "length 1e400"), "impossibly large"),
    "unit": (ASF.replace("length 0.45", "length 0"), "line 6: length 0"),
    "angle": (ASF.replace("angle deg", "angle gon"), "line 7: angle 'gon'"),
    "axis": (ASF.replace("20 XYZ", "20 XYY"), "'XYY' is no order"),
    "dof": (ASF.replace("dof ry\n", "dof qy\n"), "unknown channel 'qy'"),
    "dof twice": (ASF.replace("dof rz rx", "dof rz rz"), "named twice"),
    "nameless": (ASF.replace("     name hip\n", ""), "a bone without a name"),
    "own child": (ASF.replace("hip shin", "hip root"), "'root' has two parents"),
}


@pytest.mark.parametrize("name", ASF_FAULTS)
def test_faults_of_a_skeleton_name_file_and_line(tmp_path: Path, name: str) -> None:
    text, message = ASF_FAULTS[name]
    with pytest.raises(UserError) as caught:
        read_amc(save(tmp_path, AMC, text))
    assert message in str(caught.value) and "a.asf" in str(caught.value)
    assert "\n" not in str(caught.value)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_damaged_files_raise_user_errors_only(tmp_path: Path, data: st.DataObject) -> None:
    texts = [AMC, ASF]
    which = data.draw(st.integers(0, 1))
    text = texts[which]
    start = data.draw(st.integers(0, len(text)))
    stop = data.draw(st.integers(start, min(len(text), start + 60)))
    letters = st.text(st.characters(max_codepoint=255), max_size=20)
    piece = data.draw(letters | st.sampled_from(["", text[start:stop] * 2]))
    texts[which] = text[:start] + piece + text[stop:]
    try:
        clip = read_amc(save(tmp_path, *texts))
        assert all(np.isfinite(array).all() for array in clip.world())
    except UserError as error:
        assert str(tmp_path) in str(error)


def test_the_root_alone_is_a_skeleton(tmp_path: Path) -> None:
    (tmp_path / "one.asf").write_text(":hierarchy\nbegin\nend\nroot\n")
    assert [bone.name for bone in read_asf(tmp_path / "one.asf").bones] == ["root"]
