"""HTML preview: one page that plays motions side by side, offline, with our own small viewer.

The page is `preview.html` with the viewer's scripts and the data put in: the mannequin's mesh and
each motion as little-endian arrays in base64. T frames of a body that moves all its joints cost
190 T bytes before base64.
"""

import base64
import json
import re
from collections.abc import Sequence
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import UserError
from ..files import write_text
from ..motion.motion import Motion
from ..motion.skeleton import FOOT_JOINTS, canonical_skeleton
from .body import BODY, COLOURS, CONTACT, JOINT_SIDES
from .glb import whole_shares
from .mannequin import mannequin

SCRIPTS = (
    "preview_scene.js",
    "preview_body.js",
    "preview_rhythm.js",
    "preview_clock.js",
    "preview.js",
)
HINT = """A <b style="color:#2f9150">foot</b> on the ground turns green; the red line is the
    path."""
MESH_UNIT = 1e-4  # metres; the vertex shader knows it too
QUATERNION_UNIT = 32767.0
_SIDES = {"left": 1, "right": -1, "centre": 0}


def write_html(motions: Sequence[Motion] | Motion, path: str | Path) -> Path:
    """Write one self-contained page; prompts are the captions and cannot act as markup.

    Raises:
        UserError: no motion, or the file cannot be written.
    """
    shown = [motions] if isinstance(motions, Motion) else list(motions)
    if not shown:
        raise UserError(f"cannot write {path}: there is no motion to show; give one")
    return write_page({"motions": [motion_data(motion) for motion in shown]}, path)


def write_page(
    data: dict[str, Any], path: str | Path, *, hint: str = HINT, media: str = ""
) -> Path:
    """Fill the template; returns the path.

    Args:
        data: `motions`, a list of what `motion_data` made, and what else the scripts read.
        path: the page to write.
        hint: markup that explains the picture, under the controls.
        media: markup of the element with the id `song`, which then drives the clock.

    Raises:
        UserError: the file cannot be written.
    """
    resources = files(__package__)
    parts = {
        "@DATA@": script_safe_json(_body() | data),
        "@SCRIPT@": "\n".join(resources.joinpath(n).read_text("utf-8") for n in SCRIPTS),
        "@HINT@": hint,
        "@SONG@": media,
    }
    page = resources.joinpath("preview.html").read_text("utf-8")
    # In one pass, so that a prompt that holds a mark is not filled in itself.
    write_text(Path(path), re.sub("|".join(parts), lambda mark: parts[mark[0]], page))
    return Path(path)


def script_safe_json(value: Any) -> str:
    """JSON that may stand in a `<script>` element: ASCII, and `<`, `>`, `&` only as escapes."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return re.sub("[<>&]", lambda sign: f"\\u{ord(sign[0]):04x}", text)


@lru_cache(maxsize=1)
def _body() -> dict[str, Any]:
    """What all motions share: skeleton, mesh, limbs for browsers without WebGL, colours."""
    body, skeleton = mannequin(), canonical_skeleton()
    return {
        "skeleton": {
            "parents": list(skeleton.parents),
            "offsets": skeleton.offsets.astype(float).round(6).tolist(),
            "rest": body.rest.astype(float).round(6).tolist(),
            "sides": [_SIDES[side] for side in JOINT_SIDES],
            "feet": FOOT_JOINTS,
        },
        "mesh": {
            "positions": base64_array(body.vertices / MESH_UNIT, "<i2"),
            "normals": base64_array(body.normals * 127, "i1"),
            "joints": base64_array(body.joints, "u1"),
            "weights": base64_array(whole_shares(body.weights, 255), "u1"),
            "triangles": base64_array(body.triangles, "<u2"),
        },
        "cones": [[part.joint, part.start, part.end, *part.radii] for part in BODY],
        "colours": COLOURS | {"contact": CONTACT},
    }


def motion_data(motion: Motion) -> dict[str, Any]:
    """What the viewer needs of one motion; joints that never turn are stored once."""
    norms = np.linalg.norm(motion.quaternions, axis=-1, keepdims=True)
    quaternions = np.rint(motion.quaternions / norms * QUATERNION_UNIT)
    turning = np.flatnonzero((quaternions != quaternions[:1]).any((0, 2)))
    return {
        "text": motion.text,
        "fps": float(motion.fps),
        "frames": motion.num_frames,
        "turning": turning.tolist(),
        "quaternions": base64_array(quaternions[:, turning], "<i2"),
        "still": base64_array(quaternions[0], "<i2"),
        "root": base64_array(motion.root_position, "<f4"),
        "contacts": base64_array(np.clip(motion.contacts, 0, 1) * 255, "u1"),
    }


def base64_array(values: np.ndarray, kind: str) -> str:
    """Values as a little-endian type, rounded where that is an integer, in base64."""
    rounded = values if kind == "<f4" else np.rint(values)
    return base64.b64encode(np.ascontiguousarray(rounded.astype(kind)).tobytes()).decode()
