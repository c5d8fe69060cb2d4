#!/usr/bin/env python3
"""Make walks ahead of styles that nobody was captured in going ahead.

    python scripts/walk_clips.py PREPARED OUT --styles happy,not-confident

Captured walks "to the left" and "to the right" go at an angle to where the body faces. Here the
body faces the way that it goes: pelvis and all above it turn by that angle, the legs stay in the
world, so that feet slide as they were captured to, and each foot turns most of the way. OUT gets
BVH files for `motion-tools prepare`, named as the takes are, of which the labels are read.

T frames.
"""

import argparse
import re
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import torch

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from src.shared.data.prepared import PreparedData
from src.shared.formats.registry import write_motion
from src.shared.motion.features import FORWARD, LATERAL, ROOT_ROW, decode_features
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.footskate import move_legs
from src.shared.motion.rotations import (
    forward_kinematics,
    quaternion_conjugate,
    quaternion_continuous,
    quaternion_multiply,
    quaternion_to_matrix,
    yaw_quaternion,
)
from src.shared.motion.skeleton import JOINT_INDEX, PARENTS, canonical_skeleton

FEET = 0.6  # of the angle, that feet turn by
FIRST = 901  # number of the first take of a style
SIDES = ("left", "right")


def faced(motion: Motion, angle: float) -> Motion:
    """The motion, facing `angle` radians further to the left, on the legs that it has."""
    local = torch.as_tensor(motion.quaternions, dtype=torch.float64)
    turned, before = local.clone(), local[:, 0]
    whole, part = (
        torch.as_tensor(yaw_quaternion(torch.tensor(each))).double().expand_as(before)
        for each in (angle, FEET * angle)
    )
    turned[:, 0] = quaternion_multiply(whole, before)
    for side in SIDES:
        hip, knee, ankle = (JOINT_INDEX[f"{side[0]}_{n}"] for n in ("hip", "knee", "ankle"))
        thigh = quaternion_multiply(before, local[:, hip])
        shin = quaternion_multiply(thigh, local[:, knee])
        foot = quaternion_multiply(part, quaternion_multiply(shin, local[:, ankle]))
        turned[:, hip] = quaternion_multiply(quaternion_conjugate(turned[:, 0]), thigh)
        turned[:, ankle] = quaternion_multiply(quaternion_conjugate(shin), foot)
    return on_its_feet(motion, replace(motion, quaternions=turned.float().numpy()))


def on_its_feet(before: Motion, motion: Motion) -> Motion:
    """The motion, its feet moving as they did before, each a constant way off."""
    local = torch.as_tensor(motion.quaternions, dtype=torch.float64)
    offsets = torch.as_tensor(canonical_skeleton().offsets, dtype=torch.float64)
    root = torch.as_tensor(motion.root_position, dtype=torch.float64)
    places, world = forward_kinematics(quaternion_to_matrix(local), root, offsets, PARENTS)
    there, level = torch.as_tensor(before.positions()), torch.eye(3, dtype=torch.float64)
    for side in SIDES:
        leg = [JOINT_INDEX[f"{side[0]}_{name}"] for name in ("hip", "knee", "ankle", "foot")]
        off = there[:, leg[-1]] - places[:, leg[-1]]
        shift = off - off.mean(0) * torch.tensor([1.0, 0.0, 1.0])
        joints = np.tile(leg, (len(local), 1))
        still = level.expand(len(local), 3, 3)
        local[:, leg] = move_legs(joints, places, world, offsets, shift, still)
    return replace(motion, quaternions=quaternion_continuous(local, dim=0).float().numpy())


def main(arguments: list[str] | None = None) -> int:
    """Write them; 1 where a style has none."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("prepared", type=Path, help="folder of `motion-tools prepare`")
    parser.add_argument("out", type=Path)
    parser.add_argument("--styles", required=True, help="with commas")
    given = parser.parse_args(arguments)
    data, made = PreparedData.open(given.prepared), Counter[str]()
    styles = given.styles.split(",")
    for record in data.records("train"):
        style = record.labels.get("style", "")
        ahead = record.tag == "walk" and record.labels.get("direction") in SIDES
        if record.mirrored or not ahead or style not in styles:
            continue
        features = data.features(record)
        speed = features[:, ROOT_ROW, [LATERAL, FORWARD]].mean(0).tolist()
        motion = faced(decode_features(features), float(np.arctan2(*speed)))
        name = re.sub(r"walk-\w+?_", "walk_", record.take.rpartition("/")[2])
        number = f"{FIRST + made[style]:03d}"
        write_motion(motion, given.out / f"{re.sub(r'[0-9]+$', number, name)}.bvh")
        made[style] += 1
    if lacking := [style for style in styles if not made[style]]:
        print(f"walk_clips: no walk to a side of {', '.join(lacking)} in {given.prepared}; name"
              " styles that it has", file=sys.stderr)  # fmt: skip
        return 1
    print(", ".join(f"{style}: {made[style]}" for style in styles))
    return 0


if __name__ == "__main__":
    sys.exit(main())
