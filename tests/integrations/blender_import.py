"""Inside Blender: import motion files and say where their bones are; no test by itself.

Given {"files": [...], "frames": [...]}, the first frame being 0.
Blender is +Z up, its (x, y, z) is our (x, z, -y).
"""

import json
import sys
from pathlib import Path
from typing import Any

import bpy


def load(path: Path) -> bpy.types.Object:
    """Import one file into an empty scene; its armature."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.suffix == ".bvh":
        bpy.ops.import_anim.bvh(
            filepath=str(path), global_scale=0.01, axis_forward="-Z", axis_up="Y"
        )
    else:
        bpy.context.scene.render.fps = 30
        bpy.ops.import_scene.gltf(filepath=str(path))
    (armature,) = (item for item in bpy.data.objects if item.type == "ARMATURE")
    return armature


def heads(armature: bpy.types.Object, frame: int) -> dict[str, list[float]]:
    """World position of every bone's head at a frame, in our axes."""
    bpy.context.scene.frame_set(frame)
    found = {}
    for bone in armature.pose.bones:
        x, y, z = armature.matrix_world @ bone.head
        found[bone.name] = [x, z, -y]
    return found


def main() -> None:
    wanted = json.loads(sys.argv[1])
    results: dict[str, Any] = {}
    for name in wanted["files"]:
        armature = load(Path(name))
        first, last = armature.animation_data.action.frame_range
        results[name] = {
            "range": [first, last],
            "heads": [heads(armature, round(first) + frame) for frame in wanted["frames"]],
        }
    print("RESULT " + json.dumps(results))


main()
