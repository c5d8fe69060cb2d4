"""Blender add-on: a prompt or a song becomes an animated armature, by way of the command line.

One file, only Blender's own Python: install it in Preferences > Add-ons > Install from Disk, name
the `motion-tools` program there, and press Generate in the sidebar (N) of the 3D viewport. The
program runs beside Blender, which stays usable; Esc stops it. Needs Blender 4.2 or newer.
"""

import contextlib
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, ClassVar

import bpy

bl_info = {
    "name": "Motion Suite",
    "description": "Generate motions from a prompt or a song",
    "author": "motionsuite contributors",
    "version": (0, 1, 0),
    "blender": (4, 2, 0),
    "location": "3D Viewport > Sidebar > Motion",
    "category": "Animation",
}

PROGRAM = "motion-tools"
POLL_SECONDS = 0.2
CENTIMETRE = 0.01  # our BVH files are in centimetres, Blender's unit is the metre
# Set by Blender for its own interpreter; the program has another.
OWN_VARIABLES = ("PYTHONHOME", "PYTHONPATH", "PYTHONNOUSERSITE", "LD_LIBRARY_PATH")


class ProgramError(Exception):
    """The program could not be started, failed, or left no file; the text is for the user."""


class Job:
    """One run of the program, beside Blender.

    Args:
        command: program and arguments; JSON is expected on its stdout.
        wanted: the format whose file is to be loaded.

    Raises:
        ProgramError: the program cannot be started.
    """

    def __init__(self, command: list[str], wanted: str) -> None:
        self.wanted = wanted
        # Files, not pipes: nobody empties a pipe while Blender is busy.
        self._files = contextlib.ExitStack()
        self._out, self._err = (
            self._files.enter_context(tempfile.TemporaryFile())  # noqa: SIM115
            for _ in range(2)
        )
        environment = {k: v for k, v in os.environ.items() if k not in OWN_VARIABLES}
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=self._out,
                stderr=self._err,
                env=environment,
                creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
            )
        except OSError as error:
            self._files.close()
            raise ProgramError(
                f"cannot start {command[0]!r}: {error.strerror};"
                " name the program in the add-on's preferences"
            ) from error

    def is_running(self) -> bool:
        """Whether the program still works."""
        return self._process.poll() is None

    def wait(self) -> None:
        """Block until the program ends; for Blender without a window."""
        self._process.wait()

    def stop(self) -> None:
        """End the program; what it has not finished writing is not there."""
        with contextlib.suppress(OSError):
            self._process.terminate()
            self._process.wait(10)
        self._files.close()

    def result(self) -> dict[str, Any]:
        """What the finished program said of the motion: path of its file, frames, fps, warning.

        Raises:
            ProgramError: it failed, or left no file.
        """
        out, err = self._read(self._out), self._read(self._err)
        code = self._process.returncode
        self._files.close()
        if code:
            raise ProgramError(last_error(err) or f"the program ended with code {code}")
        try:
            motion = json.loads(out)["motions"][0]
            path = Path(motion["files"][self.wanted])
        except (ValueError, LookupError, TypeError) as error:
            raise ProgramError(
                f"the program's answer is not understood ({error!r});"
                " add-on and program must be of the same version"
            ) from error
        if not path.is_file():
            raise ProgramError(f"{path} is not there; choose another folder in the preferences")
        return {**motion, "path": path}

    @staticmethod
    def _read(stream: Any) -> str:
        stream.seek(0)
        return str(stream.read().decode("utf-8", "replace"))


def last_error(text: str) -> str:
    """The line in which the program says what went wrong; its last line if it says nothing."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    told = [line.removeprefix("error: ") for line in lines if line.startswith("error: ")]
    return (told or lines or [""])[-1]


def build_command(settings: Any, program: str, folder: str) -> list[str]:
    """The command line that the panel's settings stand for.

    Raises:
        ProgramError: no prompt, no song, or no such program.
    """
    found = shutil.which(bpy.path.abspath(program)) or shutil.which(program)
    if found is None:
        raise ProgramError(
            f"there is no program {program!r}; name `motion-tools` in the add-on's preferences"
        )
    # With "=": a prompt may begin with a hyphen.
    command = [found, "generate", "--json", f"--format={settings.format}", f"--out={folder}"]
    command += [f"--seed={settings.seed}"]
    if settings.source == "SONG":
        song = bpy.path.abspath(settings.song)
        if not song:
            raise ProgramError("no song is chosen; choose a wav, flac, ogg or mp3 file")
        command += [f"--audio={song}"]
        said = settings.dance.strip()
        command += [f"--prompt={said}"] if said else ["--body"]
        if settings.style.strip():
            command += [f"--style={settings.style.strip()}"]
    else:
        if not settings.prompt.strip():
            raise ProgramError('there is no prompt; write one, such as "a person waves"')
        command += [f"--prompt={settings.prompt.strip()}"]
    if settings.seconds > 0:
        command += [f"--seconds={settings.seconds:g}"]
    if settings.model.strip():
        flag = "--body-model" if settings.source == "SONG" else "--model"
        command += [f"{flag}={settings.model.strip()}"]
    return command


def load(motion: dict[str, Any], set_rate: bool) -> bpy.types.Object:
    """Load the file of a motion into the scene; returns the new armature, or the first object.

    Raises:
        ProgramError: Blender cannot read it.
    """
    scene, path = bpy.context.scene, motion["path"]
    before = set(bpy.data.objects)
    if set_rate:
        rate = float(motion.get("fps", 30.0))
        scene.render.fps = max(1, round(rate))
        scene.render.fps_base = scene.render.fps / rate
    try:
        if path.suffix == ".bvh":
            bpy.ops.import_anim.bvh(
                filepath=str(path),
                global_scale=CENTIMETRE,
                axis_forward="-Z",
                axis_up="Y",
                rotate_mode="QUATERNION",
                use_fps_scale=not set_rate,
                update_scene_duration=True,
            )
        else:
            bpy.ops.import_scene.gltf(filepath=str(path))
    except RuntimeError as error:
        raise ProgramError(f"Blender cannot load {path}: {error}") from error
    made = [item for item in bpy.data.objects if item not in before]
    if not made:
        raise ProgramError(f"{path} brought nothing into the scene")
    chosen = next((item for item in made if item.type == "ARMATURE"), made[0])
    action = chosen.animation_data and chosen.animation_data.action
    if action:
        scene.frame_end = max(scene.frame_end, round(action.frame_range[1]))
    return chosen


class MotionSuitePreferences(bpy.types.AddonPreferences):
    """Where the program is and where its files go."""

    bl_idname = __name__

    program: bpy.props.StringProperty(
        name="Program",
        description="Path of `motion-tools`, for example .venv/bin/motion-tools of the project",
        subtype="FILE_PATH",
        default=PROGRAM,
    )
    folder: bpy.props.StringProperty(
        name="Folder", description="Where motions are written; a temporary one if empty",
        subtype="DIR_PATH",
    )  # fmt: skip

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.prop(self, "program")
        self.layout.prop(self, "folder")


class MotionSuiteSettings(bpy.types.PropertyGroup):
    """What the panel asks for; kept with the scene."""

    source: bpy.props.EnumProperty(
        name="From",
        items=[("PROMPT", "Prompt", "Words say what to do"), ("SONG", "Song", "Move to a song")],
    )
    prompt: bpy.props.StringProperty(name="Prompt", default="a person walks forward")
    song: bpy.props.StringProperty(name="Song", subtype="FILE_PATH")
    dance: bpy.props.StringProperty(
        name="Prompt", description="What the body does to the song; as the music says if empty"
    )
    style: bpy.props.StringProperty(name="Style", description='For a song: "tired, elderly"')
    seconds: bpy.props.FloatProperty(
        name="Seconds", description="0: four for a prompt, all of a song", min=0.0, soft_max=60.0
    )
    seed: bpy.props.IntProperty(
        name="Seed", description="Same seed, same motion", min=0, max=2**31 - 1
    )
    model: bpy.props.StringProperty(
        name="Model", description="Name or folder; the shipped one if empty"
    )
    format: bpy.props.EnumProperty(
        name="Load as",
        items=[("bvh", "Armature", "BVH: bones alone"), ("glb", "Mannequin", "GLB: with a mesh")],
    )
    set_rate: bpy.props.BoolProperty(
        name="Set Frame Rate", description="Give the scene the motion's frame rate", default=True
    )


class MOTIONSUITE_OT_generate(bpy.types.Operator):
    """Generate a motion and load it into the scene; Esc stops."""

    bl_idname = "motion_suite.generate"
    bl_label = "Generate"

    running: ClassVar[Job | None] = None

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return cls.running is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Start the program; without a window, wait for it."""
        settings = context.scene.motion_suite
        preferences = context.preferences.addons[__name__].preferences
        folder = bpy.path.abspath(preferences.folder)
        try:
            folder = folder or tempfile.mkdtemp(prefix="motion-suite-", dir=bpy.app.tempdir or None)
            job = Job(build_command(settings, preferences.program, folder), settings.format)
        except (ProgramError, OSError) as error:
            return self._fail(str(error))
        self._job, self._set_rate = job, settings.set_rate
        if bpy.app.background:
            job.wait()
            return self._finish()
        type(self).running = job
        manager = context.window_manager
        self._timer = manager.event_timer_add(POLL_SECONDS, window=context.window)
        manager.modal_handler_add(self)
        context.workspace.status_text_set("Motion Suite: generating, Esc stops")
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Look at the program at every tick; everything else is Blender's."""
        if event.type == "ESC":
            self._job.stop()
            self._leave(context)
            self.report({"INFO"}, "stopped")
            return {"CANCELLED"}
        if event.type != "TIMER" or self._job.is_running():
            return {"PASS_THROUGH"}
        self._leave(context)
        return self._finish()

    def _leave(self, context: bpy.types.Context) -> None:
        type(self).running = None
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)

    def _finish(self) -> set[str]:
        try:
            motion = self._job.result()
            made = load(motion, self._set_rate)
        except ProgramError as error:
            return self._fail(str(error))
        if motion.get("warning"):
            self.report({"WARNING"}, motion["warning"])
        self.report({"INFO"}, f"{made.name}: {motion.get('frames', '?')} frames")
        return {"FINISHED"}

    def _fail(self, text: str) -> set[str]:
        self.report({"ERROR"}, text)
        return {"CANCELLED"}


class MOTIONSUITE_PT_panel(bpy.types.Panel):
    """The panel in the sidebar."""

    bl_label = "Motion Suite"
    bl_idname = "MOTIONSUITE_PT_panel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Motion"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.motion_suite, self.layout
        layout.prop(settings, "source", expand=True)
        of_song = settings.source == "SONG"
        for name in ("song", "dance", "style") if of_song else ("prompt",):
            layout.prop(settings, name)
        for name in ("seconds", "seed", "model", "format", "set_rate"):
            layout.prop(settings, name)
        busy = MOTIONSUITE_OT_generate.running is not None
        layout.operator(
            MOTIONSUITE_OT_generate.bl_idname, text="Generating …" if busy else "Generate"
        )


CLASSES = (
    MotionSuitePreferences,
    MotionSuiteSettings,
    MOTIONSUITE_OT_generate,
    MOTIONSUITE_PT_panel,
)


def register() -> None:
    """Called by Blender when the add-on is switched on."""
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.motion_suite = bpy.props.PointerProperty(type=MotionSuiteSettings)


def unregister() -> None:
    """Called by Blender when it is switched off; a run that goes on is stopped."""
    if MOTIONSUITE_OT_generate.running is not None:
        MOTIONSUITE_OT_generate.running.stop()
        MOTIONSUITE_OT_generate.running = None
    del bpy.types.Scene.motion_suite
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)


if __name__ == "__main__":
    register()
