"""USD files out: a UsdSkel character as USD text, which needs no library.

One SkelRoot with a Skeleton, its SkelAnimation (a sample a frame) and a skinned mesh; metres, +Y
up, one time code a frame. `.usd` and `.usda` hold the text; `.usdc` is the same, packed by
OpenUSD's own library (`usd-core`). Legend: T frames, N joints.
"""

import json
import os
import re
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from ...errors import UserError, printable
from ...io.files import atomic_write, write_text
from ...motion.motion import Motion
from ..mannequin import Mannequin, mannequin, side_colours
from ..rig import (
    Rig,
    RigClip,
    continuous,
    matrices_to_quaternions,
    motion_clip,
    parent_frames,
    rescaled,
)

BINARY = ".usdc"


def write_usd(motion: Motion, path: str | Path, *, names: str = "canonical") -> Path:
    """Write one motion as an animated character.

    Args:
        path: a file that ends in .usd, .usda or .usdc.
        names: of the joints (`rig.SCHEMES`).

    Raises:
        UserError: the file cannot be written, or .usdc without `usd-core`.
    """
    return _write(motion_clip(motion, names), mannequin(), Path(path))


def write_usd_clip(clip: RigClip, path: str | Path) -> Path:
    """Write a rig's motion, with a simple body of its bones; raises UserError as `write_usd`."""
    from .glb import bone_mesh

    clip = rescaled(clip, 1.0)
    return _write(clip, bone_mesh(clip.rig, clip.moving()), Path(path))


def _write(clip: RigClip, body: Mannequin, path: Path) -> Path:
    text = "\n".join([*_head(clip), *_skeleton(clip.rig), *_animation(clip), *_mesh(body), "}", ""])
    if path.suffix.lower() != BINARY:
        write_text(path, text)
        return path
    try:
        from pxr import Sdf
    except ImportError as error:
        raise UserError(f"cannot write {path}: packed USD needs OpenUSD; install it with: pip "
                        "install usd-core, or write .usda") from error  # fmt: skip
    layer = Sdf.Layer.CreateAnonymous(BINARY)
    layer.ImportFromString(text)
    try:
        with (
            atomic_write(path) as temporary,
            TemporaryDirectory(
                dir=path.parent, prefix=".packed.", suffix=f".{os.getpid()}.part"
            ) as folder,
        ):
            packed = Path(folder) / f"packed{BINARY}"  # the ending says what is written
            layer.Export(str(packed))
            packed.replace(temporary)
    except RuntimeError as error:
        raise UserError(f"cannot write {path}: {error}; write .usda instead") from error
    return path


def _head(clip: RigClip) -> list[str]:
    """The layer's facts and the SkelRoot, still open."""
    fps = f"{clip.fps:.9g}"
    return [
        "#usda 1.0",
        "(",
        f"    customLayerData = {{ string text = {_string(clip.text)} }}",
        '    defaultPrim = "Character"',
        f"    endTimeCode = {clip.num_frames - 1}",
        f"    framesPerSecond = {fps}",
        "    metersPerUnit = 1",
        "    startTimeCode = 0",
        f"    timeCodesPerSecond = {fps}",
        '    upAxis = "Y"',
        ")",
        "",
        'def SkelRoot "Character" (prepend apiSchemas = ["SkelBindingAPI"])',
        "{",
        f"    float3[] extent.timeSamples = {{ {_extents(clip)} }}",
    ]


def _skeleton(rig: Rig) -> list[str]:
    above = parent_frames(rig, rig.frames).swapaxes(-1, -2)
    rest = _rows(above @ rig.frames, (above @ rig.offsets[..., None])[..., 0])
    return [
        '    def Skeleton "Skeleton" (prepend apiSchemas = ["SkelBindingAPI"])',
        "    {",
        f"        uniform matrix4d[] bindTransforms = {_rows(rig.frames, rig.rest())}",
        f"        uniform token[] jointNames = {_strings(rig.names)}",
        f"        uniform token[] joints = {_strings(joint_paths(rig))}",
        f"        uniform matrix4d[] restTransforms = {rest}",
        "        rel skel:animationSource = </Character/Animation>",
        "    }",
    ]


def _animation(clip: RigClip) -> list[str]:
    rig = clip.rig
    above = parent_frames(rig, rig.frames)
    local = above.swapaxes(-1, -2) @ clip.rotations @ rig.frames
    turns = continuous(matrices_to_quaternions(local))
    places = (above.swapaxes(-1, -2) @ clip.translations[..., None])[..., 0]
    return [
        '    def SkelAnimation "Animation"',
        "    {",
        f"        uniform token[] joints = {_strings(joint_paths(rig))}",
        f"        quatf[] rotations.timeSamples = {{ {_samples(turns)} }}",
        f"        half3[] scales = [{', '.join(['(1, 1, 1)'] * len(rig.names))}]",
        f"        float3[] translations.timeSamples = {{ {_samples(places)} }}",
        "    }",
    ]


def _mesh(body: Mannequin) -> list[str]:
    box = np.stack((body.vertices.min(0), body.vertices.max(0)))
    return [
        '    def Mesh "Body" (prepend apiSchemas = ["SkelBindingAPI"])',
        "    {",
        f"        float3[] extent = {_tuples(box)}",
        f"        int[] faceVertexCounts = {_list([3] * len(body.triangles))}",
        f"        int[] faceVertexIndices = {_list(body.triangles.reshape(-1).tolist())}",
        f"        normal3f[] normals = {_tuples(body.normals)} (",
        '            interpolation = "vertex"',
        "        )",
        f"        point3f[] points = {_tuples(body.vertices)}",
        f"        color3f[] primvars:displayColor = {_tuples(side_colours(body.side))} (",
        '            interpolation = "vertex"',
        "        )",
        "        matrix4d primvars:skel:geomBindTransform = "
        "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )",
        f"        int[] primvars:skel:jointIndices = {_list(body.joints.reshape(-1).tolist())} (",
        "            elementSize = 4",
        '            interpolation = "vertex"',
        "        )",
        f"        float[] primvars:skel:jointWeights = {_floats(body.weights.reshape(-1))} (",
        "            elementSize = 4",
        '            interpolation = "vertex"',
        "        )",
        "        rel skel:skeleton = </Character/Skeleton>",
        '        uniform token subdivisionScheme = "none"',
        "    }",
    ]


def joint_paths(rig: Rig) -> list[str]:
    """Each joint's path from the root, of names that USD allows: letters, digits, underscores."""
    paths: list[str] = []
    for joint, (name, parent) in enumerate(zip(rig.names, rig.parents, strict=True)):
        plain = re.sub(r"\W", "_", name, flags=re.ASCII)
        plain = plain if re.match(r"[A-Za-z_]", plain) else f"_{plain}"
        path = plain if parent < 0 else f"{paths[parent]}/{plain}"
        paths.append(path if path not in paths else f"{path}_{joint}")
    return paths


def _extents(clip: RigClip) -> str:
    """A box around the joints of each frame, with room for the body."""
    positions = clip.world()[0]
    boxes = np.stack((positions.min(1) - 0.3, positions.max(1) + 0.3), 1)
    return _samples(boxes)


def _samples(values: np.ndarray) -> str:
    """Time samples of arrays of tuples [T,N,width]."""
    return ", ".join(f"{frame}: {_tuples(value)}" for frame, value in enumerate(values))


def _tuples(values: np.ndarray) -> str:
    """An array of tuples [N,width]."""
    return _list(f"({', '.join(f'{v:.7g}' for v in row)})" for row in values.tolist())


def _floats(values: np.ndarray) -> str:
    return _list(f"{v:.7g}" for v in values.tolist())


def _list(values: Iterable[object]) -> str:
    return f"[{', '.join(map(str, values))}]"


def _rows(rotations: np.ndarray, places: np.ndarray) -> str:
    """Matrices as USD writes them: transposed, the place in the last row."""
    matrices = np.tile(np.eye(4), (len(rotations), 1, 1))
    matrices[:, :3, :3] = rotations.swapaxes(-1, -2)
    matrices[:, 3, :3] = places
    shown = ["( " + ", ".join(f"({', '.join(f'{v:.9g}' for v in row)})" for row in matrix) + " )"
             for matrix in matrices.tolist()]  # fmt: skip
    return _list(shown)


def _strings(values: Iterable[str]) -> str:
    return _list(map(_string, values))


def _string(text: str) -> str:
    """In quotes, with what would end them escaped; USD has no escapes for control characters."""
    return json.dumps(printable(" ".join(text.split())), ensure_ascii=False)
