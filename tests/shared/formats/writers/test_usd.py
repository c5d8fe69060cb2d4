"""USD: OpenUSD's own library sees the motion, the skin and the facts of the stage."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.formats.mannequin import mannequin
from src.shared.formats.rig import motion_clip
from src.shared.formats.writers.usd import write_usd
from tests.full_disk import full_disk
from tests.shared.formats.test_rig import assert_usd_agrees
from tests.shared.formats.writers.test_bvh import random_motion


@pytest.mark.parametrize("ending", ["usd", "usda", "usdc"])
def test_the_joints_move_as_the_motion_does(tmp_path: Path, ending: str) -> None:
    pytest.importorskip("pxr")
    motion = random_motion(5, 3)
    assert_usd_agrees(motion_clip(motion), write_usd(motion, tmp_path / f"a.{ending}"))
    assert [path.name for path in tmp_path.iterdir()] == [f"a.{ending}"]


def test_the_stage_says_what_a_reader_needs(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    from pxr import Usd, UsdGeom, UsdSkel

    path = write_usd(random_motion(7), tmp_path / "a.usda", names="mixamo")
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0, 6)
    assert stage.GetTimeCodesPerSecond() == stage.GetFramesPerSecond() == 30
    assert stage.GetRootLayer().customLayerData["text"] == "random"
    skeleton = UsdSkel.Skeleton(stage.GetPrimAtPath("/Character/Skeleton"))
    assert list(skeleton.GetJointNamesAttr().Get())[:2] == ["mixamorig:Hips", "mixamorig:LeftUpLeg"]
    assert skeleton.GetJointsAttr().Get()[1] == "mixamorig_Hips/mixamorig_LeftUpLeg"


def test_the_skin_follows_the_joints(tmp_path: Path) -> None:
    """OpenUSD's own skinning against ours."""
    pytest.importorskip("pxr")
    from pxr import Usd, UsdGeom, UsdSkel

    motion, body = random_motion(3, 5), mannequin()
    stage = Usd.Stage.Open(str(write_usd(motion, tmp_path / "a.usda")))
    assert UsdSkel.BakeSkinning(UsdSkel.Root(stage.GetDefaultPrim()))
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/Character/Body"))
    for frame in range(3):
        expected = body.pose(motion.positions()[frame], motion.global_rotations()[frame])[0]
        found = np.array(mesh.GetPointsAttr().Get(frame))
        assert np.abs(found - expected).max() < 1e-4


def test_any_caption_is_text(tmp_path: Path) -> None:
    Sdf = pytest.importorskip("pxr").Sdf
    text = 'says "hi"\n\\ and 歩く # ( ) } @'
    path = write_usd(replace(random_motion(1), text=text), tmp_path / "a.usda")
    layer = Sdf.Layer.FindOrOpen(str(path))
    assert layer.customLayerData["text"] == " ".join(text.split())


def test_no_control_character_gets_into_the_text(tmp_path: Path) -> None:
    """USD knows no \\u escapes: of one, "u001b" would be left."""
    motion = replace(random_motion(1), text="walks\x1b[2J\x7f\x9bend")
    text = write_usd(motion, tmp_path / "a.usda").read_text(encoding="utf-8")
    assert 'string text = "walks\ufffd[2J\ufffd\ufffdend"' in text and "u001b" not in text


def test_a_full_disk_is_one_line(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    with full_disk(), pytest.raises(UserError, match=r"a\.usdc: File too large; free space"):
        write_usd(random_motion(5), tmp_path / "a.usdc")
    assert not list(tmp_path.iterdir())


def test_without_openusd_only_the_packed_form_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pxr", None)
    assert write_usd(random_motion(1), tmp_path / "a.usda").exists()
    with pytest.raises(UserError, match=r"a\.usdc: packed USD needs OpenUSD; .* usd-core"):
        write_usd(random_motion(1), tmp_path / "a.usdc")
