"""HTML preview: one page that plays motions side by side, offline, with our own small viewer.

The page is `preview.html` with the viewer's scripts and the data put in: the mannequin's mesh and
each motion as little-endian arrays in base64. T frames cost 189 T bytes before base64.
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

from src.shared.errors import UserError
from src.shared.files import write_text
from src.shared.formats.body import BODY, COLOURS, CONTACT, JOINT_SIDES
from src.shared.formats.glb import whole_shares
from src.shared.formats.mannequin import mannequin
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import FOOT_JOINTS, canonical_skeleton

SCRIPTS = ("preview_scene.js", "preview_body.js", "preview.js")
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
        raise UserError(f"cannot write {path}: there is no motion to show")
    data = dict(_body()) | {"motions": [_motion(motion) for motion in shown]}
    resources = files("src.shared.formats")
    parts = {
        "@DATA@": script_safe_json(data),
        "@SCRIPT@": "\n".join(resources.joinpath(n).read_text("utf-8") for n in SCRIPTS),
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
            "positions": _base64(body.vertices / MESH_UNIT, "<i2"),
            "normals": _base64(body.normals * 127, "i1"),
            "joints": _base64(body.joints, "u1"),
            "weights": _base64(whole_shares(body.weights, 255), "u1"),
            "triangles": _base64(body.triangles, "<u2"),
        },
        "cones": [[part.joint, part.start, part.end, *part.radii] for part in BODY],
        "colours": COLOURS | {"contact": CONTACT},
    }


def _motion(motion: Motion) -> dict[str, Any]:
    quaternions = motion.quaternions / np.linalg.norm(motion.quaternions, axis=-1, keepdims=True)
    return {
        "text": motion.text,
        "fps": float(motion.fps),
        "frames": motion.num_frames,
        "quaternions": _base64(quaternions * QUATERNION_UNIT, "<i2"),
        "root": _base64(motion.root_position, "<f4"),
        "contacts": _base64(np.clip(motion.contacts, 0, 1) * 255, "u1"),
    }


def _base64(values: np.ndarray, kind: str) -> str:
    """Values rounded to a little-endian type, as base64."""
    rounded = values if kind == "<f4" else np.rint(values)
    return base64.b64encode(np.ascontiguousarray(rounded.astype(kind)).tobytes()).decode()
