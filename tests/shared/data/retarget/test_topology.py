"""Skeletons that no profile knows: parts by tree, bones and words; left by names or by the feet."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from src.shared.data.retarget.autodetection import detect_up
from src.shared.data.retarget.mapping import (
    GUESSED,
    SkeletonMapping,
    detect_joints,
    load_mappings,
    mapping_of,
)
from src.shared.data.retarget.to_canonical import has_short_legs, retarget
from src.shared.data.retarget.to_rig import rest_clip
from src.shared.errors import UserError
from src.shared.formats.rig import Rig, RigClip, canonical_rig
from src.shared.motion.skeleton import JOINT_INDEX, JOINT_NAMES

WORDS = """
    DEF_hips DEF_thigh_L DEF_thigh_R DEF_spine_001 DEF_shin_L DEF_shin_R DEF_spine_002 DEF_foot_L
    DEF_foot_R DEF_spine_003 DEF_toe_L DEF_toe_R DEF_neck DEF_shoulder_L DEF_shoulder_R DEF_head
    DEF_upper_arm_L DEF_upper_arm_R DEF_forearm_L DEF_forearm_R DEF_hand_L DEF_hand_R
    hip lfemur rfemur lowerback ltibia rtibia upperback lfoot rfoot thorax ltoes rtoes lowerneck
    lclavicle rclavicle head lhumerus rhumerus lradius rradius lwrist rwrist
"""
DEFORMING = dict(zip(JOINT_NAMES, WORDS.split()[:22], strict=True))
ACCLAIM = dict(zip(JOINT_NAMES, WORDS.split()[22:], strict=True))
MISSPELT = {**DEFORMING, "l_knee": "Kalf.l", "r_knee": "Kalf.r", "l_wrist": "haand_l"}
NAMELESS = {name: f"bone{chr(97 + index)}" for index, name in enumerate(JOINT_NAMES)}


def renamed(names: dict[str, str]) -> RigClip:
    """Our rest pose under other names."""
    return rest_clip(replace(canonical_rig(), names=tuple(names[name] for name in JOINT_NAMES)))


def with_joint(clip: RigClip, name: str, parent: str, offset: tuple[float, ...]) -> RigClip:
    """One more joint in the tree, after all others."""
    rig = clip.rig
    return rest_clip(Rig(
        (*rig.names, name), (*rig.parents, rig.names.index(parent)),
        np.concatenate([rig.offsets, [offset]]).astype(np.float32), rig.tips,
        np.tile(np.eye(3), (len(rig.names) + 1, 1, 1)), (*rig.orders, "ZXY"),
    ))  # fmt: skip


@pytest.mark.parametrize("names", [DEFORMING, ACCLAIM, MISSPELT, NAMELESS])
def test_a_body_is_told_from_tree_bones_and_words(names: dict[str, str]) -> None:
    assert detect_joints(renamed(names)) == names


def test_fingers_helpers_and_other_leaves_do_not_confuse() -> None:
    clip = renamed(NAMELESS)
    for side, ours in ((1, "l"), (-1, "r")):
        hand, chest = NAMELESS[f"{ours}_wrist"], NAMELESS["spine3"]
        for finger in range(3):
            clip = with_joint(clip, f"f{ours}{finger}", hand, (side * 0.08, 0, 0.02 * finger))
            clip = with_joint(clip, f"g{ours}{finger}", f"f{ours}{finger}", (side * 0.04, 0, 0))
        clip = with_joint(clip, f"wing{ours}", chest, (side * 0.1, 0.1, -0.1))
    assert detect_joints(clip) == NAMELESS


def test_an_own_mapping_is_one_for_every_caller_and_says_that_it_is_guessed() -> None:
    found = mapping_of(Path("a.bvh"), renamed(DEFORMING), load_mappings())
    assert found == SkeletonMapping(name=GUESSED, joints=DEFORMING)


def test_nameless_sides_come_from_the_feet_though_the_body_turns() -> None:
    clip = renamed(NAMELESS)
    turn = np.diag([-1.0, 1.0, -1.0])  # faces -Z, its left at -X
    rotations = clip.rotations.copy()
    rotations[:, 0] = turn
    assert detect_joints(replace(clip, rotations=rotations)) == NAMELESS


def test_what_is_no_body_is_refused_in_one_line_with_the_remedy() -> None:
    clip = renamed(NAMELESS)
    offsets = clip.rig.offsets.copy()
    offsets[JOINT_INDEX["l_knee"]] *= 3
    odd = rest_clip(replace(clip.rig, offsets=offsets))
    with pytest.raises(UserError, match=r"odd\.bvh: its bones tell no body.*--mapping") as error:
        mapping_of(Path("odd.bvh"), odd, load_mappings())
    assert "\n" not in str(error.value)


def lying(clip: RigClip) -> RigClip:
    """On its back near the origin, as a sleeper in a file with +Y up."""
    rotations, translations = clip.rotations.copy(), clip.translations.copy()
    rotations[:, 0] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    translations[:, 0] = (0, 0.1, 0)
    return replace(clip, rotations=rotations, translations=translations)


def test_who_lies_all_the_time_is_not_stood_up() -> None:
    clip, mapping = lying(rest_clip(canonical_rig())), load_mappings()[0]
    assert detect_up(clip, mapping) == ("Y", False)
    heights = retarget(clip, mapping, fps=None).positions()[0, :, 1]
    assert heights.min() > 0 and heights[JOINT_INDEX["head"]] < 0.3


def test_a_cartoon_with_short_legs_is_put_on_the_floor_in_each_frame() -> None:
    rig = canonical_rig()
    offsets = rig.offsets.copy()
    for name in ("l_knee", "r_knee", "l_ankle", "r_ankle"):
        offsets[JOINT_INDEX[name]] *= 0.3
    standing = rest_clip(replace(rig, offsets=offsets))
    flat = lying(standing)
    clip = replace(
        standing,
        rotations=np.concatenate([standing.rotations, flat.rotations]),
        translations=np.concatenate([standing.translations, flat.translations]),
    )
    mapping = load_mappings()[0]
    assert has_short_legs(clip, mapping) and not has_short_legs(rest_clip(rig), mapping)
    heights = retarget(clip, mapping, fps=None, ground=True).positions()[..., 1]
    assert 0 < heights[0].min() < 0.05 and 0 < heights[1].min() < 0.12
