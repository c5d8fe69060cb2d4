"""Joint names in the wild: every dialect finds its profile, and a missing joint is named."""

from pathlib import Path

import pytest

from src.shared.data.retarget.mapping import (
    closest_joints,
    find_mapping,
    load_mappings,
    plain,
    profile_text,
)
from src.shared.errors import UserError
from src.shared.motion.skeleton import JOINT_NAMES

OURS = load_mappings()
SIDES = ("Left", "Right")


def limbs(pattern: str) -> list[str]:
    """Joint names of both sides: @ stands for Left and Right."""
    return [word.replace("@", side) for side in SIDES for word in pattern.split()]


MOTIONBUILDER = limbs("@Shoulder @Arm @ForeArm @Hand @UpLeg @Leg @Foot @ToeBase")
DIALECTS = {
    "cmu": ["Hips", "LowerBack", "Spine", "Spine1", "Neck", "Neck1", "Head", "LHipJoint",
            *MOTIONBUILDER],
    "mixamo-like": ["Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "HeadTop_End",
                    *MOTIONBUILDER],
    "motionbuilder": ["Reference", "Hips", "Spine", "Spine1", "Spine2", "Spine3", "Neck", "Neck1",
                      "Head", *MOTIONBUILDER],
    "lafan1": ["Hips", "Spine", "Spine1", "Spine2", "Neck", "Head",
               *limbs("@Shoulder @Arm @ForeArm @Hand @UpLeg @Leg @Foot @Toe")],
    "rokoko": ["Root", "Hips", "Spine1", "Spine2", "Spine3", "Spine4", "Neck", "Head",
               *limbs("@Shoulder @Arm @ForeArm @Hand @Thigh @Shin @Foot @Toe @ToeTip")],
    "xsens": ["Hips", "Chest", "Chest2", "Chest3", "Chest4", "Neck", "Head",
              *limbs("@Collar @Shoulder @Elbow @Wrist @Hip @Knee @Ankle @Toe")],
    "biovision": ["Hips", "Chest", "Neck", "Head",
                  *limbs("@Collar @Shoulder @Elbow @Wrist @Hip @Knee @Ankle")],
    "optitrack": ["Hip", "Ab", "Chest", "Neck", "Head",
                  *(name for s in "LR" for name in f"{s}Shoulder {s}UArm {s}FArm {s}Hand {s}Thigh"
                    f" {s}Shin {s}Foot {s}Toe".split())],
    "poser": ["hip", "abdomen", "chest", "neck", "head", "leftEye",
              *(name for s in "lr" for name in f"{s}Collar {s}Shldr {s}ForeArm {s}Hand {s}Thigh"
                f" {s}Shin {s}Foot".split())],
    "unreal": ["root", "pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head",
               *(name for s in "lr" for name in f"clavicle_{s} upperarm_{s} lowerarm_{s} hand_{s}"
                 f" thigh_{s} calf_{s} foot_{s} ball_{s}".split())],
    "biped": ["Bip01", "Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Neck", "Bip01 Head",
              *(f"Bip01 {s} {word}" for s in "LR" for word in ("Clavicle", "UpperArm", "Forearm",
                "Hand", "Thigh", "Calf", "Foot", "Toe0"))],
    "unity": ["Hips", "Spine", "Chest", "UpperChest", "Neck", "Head",
              *limbs("@Shoulder @UpperArm @LowerArm @Hand @UpperLeg @LowerLeg @Foot @Toes")],
    "smpl": ["pelvis", "spine1", "spine2", "spine3", "neck", "head", "jaw",
             *(name for s in ("left", "right") for name in f"{s}_collar {s}_shoulder {s}_elbow"
               f" {s}_wrist {s}_hip {s}_knee {s}_ankle {s}_foot".split())],
    "acclaim": ["root", "lhipjoint", "lowerback", "upperback", "thorax", "lowerneck", "upperneck",
                "head", *(s + name for s in "lr" for name in ("clavicle", "humerus", "radius",
                "wrist", "hand", "femur", "tibia", "foot", "toes"))],
}  # fmt: skip


@pytest.mark.parametrize("name", DIALECTS)
@pytest.mark.parametrize("spelling", ["{}", "mixamorig:{}", "mixamorig7:{}", "Actor|{}", "A1_{}"])
def test_every_dialect_is_known(name: str, spelling: str) -> None:
    if name == "biped" and spelling == "A1_{}":
        pytest.skip("a prefix before its own prefix")
    names = tuple(spelling.format(joint) for joint in DIALECTS[name])
    found = find_mapping(names, OURS)
    assert found.name == name
    assert set(found.joints.values()) <= set(names) and len(found.joints) >= 18
    wrong = [(ours, theirs) for ours, theirs in found.joints.items()
             if ours.startswith(("l_", "r_")) and side(theirs) not in ("", ours[0])]  # fmt: skip
    assert not wrong


def side(name: str) -> str:
    """l or r where a name says so."""
    word = name.rpartition(":")[2].removeprefix("A1_").removeprefix("Actor|")
    return next((s[0].lower() for s in SIDES if s in word), "")


def test_spellings_are_one_name() -> None:
    names = ("LeftUpLeg", "left_up_leg", "mixamorig:LeftUpLeg", "Left Up Leg", "rig|LEFTUPLEG")
    assert {plain(name) for name in names} == {"leftupleg"}


def test_a_joint_that_can_be_interpolated_may_be_missing() -> None:
    names = tuple(name for name in DIALECTS["mixamo-like"] if "Toe" not in name)
    found = find_mapping(names, OURS)
    assert "l_foot" not in found.joints and len(found.joints) == 20


def test_an_exact_fit_wins_over_a_bigger_one_and_the_users_over_ours(tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    names = tuple(DIALECTS["lafan1"])
    mine.write_text(profile_text(names, closest_joints(names, OURS)))
    assert find_mapping(names, load_mappings(mine)).name == "mine"


def test_what_is_missing_is_named_with_the_remedy() -> None:
    names = tuple("Kneecap" if name == "LeftLeg" else name for name in DIALECTS["mixamo-like"])
    with pytest.raises(UserError, match=r"misses l_knee \(LeftLeg\).*Kneecap.*--write-mapping"):
        find_mapping(names, OURS)


def test_a_begun_profile_needs_only_the_question_marks(tmp_path: Path) -> None:
    names = tuple("Knee: cap" if name == "LeftLeg" else name for name in DIALECTS["mixamo-like"])
    text = profile_text(names, closest_joints(names, OURS))
    assert text.count('"?"') == 1 and all(f"{ours}: " in text for ours in JOINT_NAMES)
    path = tmp_path / "my.yaml"
    path.write_text(text.replace('"?"', '"Knee: cap"'))
    assert find_mapping(names, load_mappings(path)).joints["l_knee"] == "Knee: cap"


def test_names_that_mean_nothing_are_no_crash() -> None:
    for names in ((), ("",), ("::", "__", "|"), ("a" * 10_000,) * 3):
        with pytest.raises(UserError, match="no skeleton mapping fits"):
            find_mapping(names, OURS)
