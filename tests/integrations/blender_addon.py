"""Inside Blender: switch the add-on on and run its operator as a user would; no test by itself.

Given {"addon": file, "program": file, "folder": folder, "runs": [settings, ...]}; prints, for
each run, what the operator answered and what came into the scene.
"""

import json
import sys
from typing import Any

import bpy


def run(settings: dict[str, Any], preferences: dict[str, str]) -> dict[str, Any]:
    """One press of the button in an empty scene."""
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    kept = bpy.context.preferences.addons["motion_suite"].preferences
    for name, value in preferences.items():
        setattr(kept, name, value)
    panel = bpy.context.scene.motion_suite
    for name, value in settings.items():
        setattr(panel, name, value)
    error = ""
    try:
        answer = sorted(bpy.ops.motion_suite.generate())
    except RuntimeError as told:  # how Blender hands a reported error to a script
        answer, error = ["CANCELLED"], str(told)
    armatures = [item for item in bpy.data.objects if item.type == "ARMATURE"]
    return {
        "answer": answer,
        "error": error,
        "objects": len(bpy.data.objects),
        "bones": [sorted(bone.name for bone in item.data.bones) for item in armatures],
        "ranges": [list(item.animation_data.action.frame_range) for item in armatures],
        "fps": bpy.context.scene.render.fps / bpy.context.scene.render.fps_base,
        "end": bpy.context.scene.frame_end,
    }


def watch(addon: Any, python: str) -> dict[str, Any]:
    """A job that runs beside us, one that is stopped, one that floods its pipes."""
    sleeping = addon.Job([python, "-c", "import time; time.sleep(60)"], "bvh")
    was_running = sleeping.is_running()
    sleeping.stop()
    flood = "import sys; sys.stderr.write('x' * 10**6 + '\\nerror: no good\\n'); sys.exit(1)"
    loud = addon.Job([python, "-c", flood], "bvh")
    loud.wait()
    garbled = addon.Job([python, "-c", "print('hello')"], "bvh")
    garbled.wait()
    errors = []
    for job in (loud, garbled):
        try:
            job.result()
        except addon.ProgramError as error:
            errors.append(str(error))
    return {"was_running": was_running, "runs": sleeping.is_running(), "errors": errors}


def main() -> None:
    wanted = json.loads(sys.argv[1])
    bpy.ops.preferences.addon_install(filepath=wanted["addon"], overwrite=True)
    bpy.ops.preferences.addon_enable(module="motion_suite")
    runs = [run(one["settings"], one["preferences"]) for one in wanted["runs"]]
    watched = watch(sys.modules["motion_suite"], sys.executable)
    bpy.ops.preferences.addon_disable(module="motion_suite")
    left = hasattr(bpy.types.Scene, "motion_suite")
    print("RESULT " + json.dumps({"runs": runs, "watched": watched, "left": left}))


main()
