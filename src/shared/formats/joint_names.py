"""What our 22 joints are called in files for other tools.

`unity` are Unity's own HumanBodyBones names, `unreal` those of Epic's mannequins, `mixamo` those
of Mixamo's characters, which Blender add-ons, Unity and Unreal's auto-characterizer know as well.
"""

from ..errors import UsageError
from ..motion.skeleton import JOINT_NAMES

# Trunk, then one side; {s} is the side: Left or Right (mixamo, unity), l or r (unreal).
_MIXAMO = {
    "pelvis": "Hips", "spine1": "Spine", "spine2": "Spine1", "spine3": "Spine2",
    "neck": "Neck", "head": "Head", "collar": "{s}Shoulder", "shoulder": "{s}Arm",
    "elbow": "{s}ForeArm", "wrist": "{s}Hand", "hip": "{s}UpLeg", "knee": "{s}Leg",
    "ankle": "{s}Foot", "foot": "{s}ToeBase",
}  # fmt: skip
_UNITY = {
    "pelvis": "Hips", "spine1": "Spine", "spine2": "Chest", "spine3": "UpperChest",
    "neck": "Neck", "head": "Head", "collar": "{s}Shoulder", "shoulder": "{s}UpperArm",
    "elbow": "{s}LowerArm", "wrist": "{s}Hand", "hip": "{s}UpperLeg", "knee": "{s}LowerLeg",
    "ankle": "{s}Foot", "foot": "{s}Toes",
}  # fmt: skip
_UNREAL = {
    "pelvis": "pelvis", "spine1": "spine_01", "spine2": "spine_02", "spine3": "spine_03",
    "neck": "neck_01", "head": "head", "collar": "clavicle_{s}", "shoulder": "upperarm_{s}",
    "elbow": "lowerarm_{s}", "wrist": "hand_{s}", "hip": "thigh_{s}", "knee": "calf_{s}",
    "ankle": "foot_{s}", "foot": "ball_{s}",
}  # fmt: skip


def _scheme(table: dict[str, str], left: str, right: str) -> tuple[str, ...]:
    """The table's names in our order of joints."""
    sides = {"l_": left, "r_": right}
    return tuple(
        table[name[2:]].format(s=sides[name[:2]]) if name[:2] in sides else table[name]
        for name in JOINT_NAMES
    )


SCHEMES: dict[str, tuple[str, ...]] = {
    "canonical": JOINT_NAMES,
    "mixamo": tuple(f"mixamorig:{name}" for name in _scheme(_MIXAMO, "Left", "Right")),
    "unity": _scheme(_UNITY, "Left", "Right"),
    "unreal": _scheme(_UNREAL, "l", "r"),
}


def joint_names(scheme: str) -> tuple[str, ...]:
    """The 22 names of a scheme, in our order of joints.

    Raises:
        UsageError: no scheme has this name.
    """
    try:
        return SCHEMES[scheme]
    except KeyError:
        known = ", ".join(SCHEMES)
        raise UsageError(f"{scheme!r} names no joints; choose from {known}") from None
