"""FBX, by way of Blender, which reads and writes it and GLB (docs/decisions.md).

Blender is a program of its own, 4.2 or newer: the one that MOTIONGEN_BLENDER names, else `blender`
on the path, else its module `bpy` in this Python. Nothing of it is needed for any other format.
"""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory

from ..environment import BLENDER, variable
from ..errors import UserError
from ..io.files import atomic_write
from ..motion.motion import Motion
from .limits import MAX_SECONDS, check_size
from .rig import RigClip
from .writers.glb import write_glb, write_glb_clip

# Run by Blender: IN OUT and the frames a second of IN, of which a .glb says nothing to Blender.
# Frames are kept one by one where their rate is a whole number, the one kind that Blender's
# importers and exporters agree on; others are sampled at the nearest, by which keys are placed. Of
# several movements one of the largest skeleton is taken. A bone's shape would become a mesh.
SCRIPT = """
import sys
import bpy

if bpy.app.version < (4, 2):
    sys.exit(f"it is Blender {bpy.app.version_string}, and 4.2 or newer is needed")
source, target, fps = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
if target.endswith(".fbx"):
    scene.render.fps = max(1, round(float(fps)))
    bpy.ops.import_scene.gltf(filepath=source, bone_heuristic="BLENDER", disable_bone_shape=True)
else:
    bpy.ops.import_scene.fbx(filepath=source)
    scene.render.fps_base = 1.0
rigs = [item for item in bpy.data.objects if item.type == "ARMATURE"]
if not rigs:
    sys.exit("no skeleton in it")
rig = max(rigs, key=lambda item: len(item.data.bones))
for item in bpy.data.objects:
    if item is not rig:
        item.animation_data_clear()
        if getattr(item.data, "shape_keys", None):
            item.data.shape_keys.animation_data_clear()
if rig.animation_data and rig.animation_data.action:
    scene.frame_start, scene.frame_end = map(round, rig.animation_data.action.frame_range)
if target.endswith(".fbx"):
    bpy.ops.export_scene.fbx(
        filepath=target, object_types={"ARMATURE", "MESH", "EMPTY"}, add_leaf_bones=False,
        path_mode="COPY", embed_textures=True,
        bake_anim_use_all_actions=False, bake_anim_use_nla_strips=False,
        bake_anim_simplify_factor=0, bake_anim_force_startend_keying=True,
    )
else:
    bpy.ops.export_scene.gltf(
        filepath=target, export_format="GLB", export_animation_mode="ACTIVE_ACTIONS",
        export_force_sampling=True, export_optimize_animation_size=False,
    )
"""


def find_blender() -> str:
    """The program, or a Python that has it as a module.

    Raises:
        UserError: there is none.
    """
    named = variable(BLENDER)
    found = which(named or "blender") or (not named and find_spec("bpy") and sys.executable)
    if not found:
        fault = f"{BLENDER}={named} is no program" if named else "FBX needs Blender, not found here"
        raise UserError(
            f"{fault}; install Blender 4.2 or newer, or `pip install bpy`, and name the program, or"
            f" the Python that has bpy, in {BLENDER}; or take .glb, which needs nothing"
        )
    return str(found)


def write_fbx(motion: Motion, path: Path, *, names: str = "canonical") -> Path:
    """Write one motion on our mannequin; returns the path.

    Raises:
        UserError: no Blender, or the file cannot be written.
    """
    return through_glb(lambda glb: write_glb(motion, glb, names=names), path, motion.fps)


def write_fbx_clip(clip: RigClip, path: Path) -> Path:
    """Write the movement of any skeleton; raises as `write_fbx`."""
    return through_glb(lambda glb: write_glb_clip(clip, glb), path, clip.fps)


def through_glb(write: Callable[[Path], object], path: Path, fps: float) -> Path:
    """Write as FBX what `write` writes as GLB; raises as `write_fbx`."""
    with TemporaryDirectory(prefix="motionsuite-") as folder:
        glb, fbx = Path(folder, "motion.glb"), Path(folder, "motion.fbx")
        write(glb)
        _convert(glb, fbx, path, fps)
        with atomic_write(path) as temporary:
            temporary.write_bytes(fbx.read_bytes())
    return path


@contextmanager
def as_glb(path: Path) -> Iterator[Path]:
    """A GLB of what an FBX holds, for as long as this is open.

    Raises:
        UserError: no such file, no Blender, or one that Blender cannot read.
    """
    check_size(path)
    with TemporaryDirectory(prefix="motionsuite-") as folder:
        glb = Path(folder, f"{path.stem}.glb")
        _convert(path.absolute(), glb, path, 30.0)
        try:
            yield glb
        except UserError as error:
            raise type(error)(str(error).replace(str(glb), str(path))) from error


def _convert(source: Path, target: Path, told: Path, fps: float) -> None:
    """Let Blender make one of the other; `told` is the user's file."""
    program = find_blender()
    script = target.with_name("convert.py")
    script.write_text(SCRIPT, encoding="utf-8")
    quiet = ["--background", "--factory-startup", "--disable-autoexec"]  # runs no script of a file
    alone = [*quiet, "--python-exit-code", "1", "--python"]
    before = [] if "python" in Path(program).name.lower() else alone
    try:
        done = subprocess.run(
            [program, *before, str(script), "--", str(source), str(target), f"{fps:.6g}"],
            capture_output=True,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
            timeout=MAX_SECONDS,
            env={**os.environ, "BLENDER_USER_RESOURCES": str(target.parent)},
        )
    except subprocess.TimeoutExpired as error:
        raise UserError(
            f"{told}: Blender ({program}) took more than {MAX_SECONDS:g} s; split the file, or take"
            " another format"
        ) from error
    except OSError as error:
        raise UserError(
            f"{program} cannot be run: {error.strerror or error}; name another Blender in {BLENDER}"
        ) from error
    if done.returncode or not target.exists():
        lines = (done.stdout + done.stderr).splitlines()
        said = [line.strip() for line in lines if line.strip() and "script failed" not in line]
        raise UserError(
            f"{told}: Blender ({program}) could not convert it: {said[-1] if said else 'no word'}"
            "; open it in Blender, or take another format"
        )
