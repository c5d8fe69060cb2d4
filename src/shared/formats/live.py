"""Frames for whoever listens while a body moves: lines of JSON, and the VMC protocol over OSC.

VMC (protocol.vmc.info, "Marionette to Performer"): one OSC bundle a frame with the root, the bones
by their Unity names, and the time. Unity is left-handed with +X to the right of who faces +Z; here
+X is the left, so x changes its sign, and with it the turns about y and z.
"""

import json
import struct
from dataclasses import dataclass

import numpy as np

from ..motion.skeleton import canonical_skeleton
from .rig import SCHEMES

_OSC_AT_ONCE = (1).to_bytes(8, "big")  # the time tag that means now


@dataclass(frozen=True, eq=False)
class Frame:
    """One moment of a body.

    Attributes:
        number: counted from 0.
        seconds: from the first frame.
        text: what it shows.
        root: world position of the pelvis [3], metres.
        quaternions: local rotations [22,4], w x y z; the pelvis' in the world.
        contacts: left and right foot on the ground [2].
    """

    number: int
    seconds: float
    text: str
    root: np.ndarray
    quaternions: np.ndarray
    contacts: np.ndarray


def json_line(frame: Frame) -> str:
    """One line, without its end."""
    numbers = {
        "root": frame.root.round(5).tolist(),
        "rotations": frame.quaternions.round(6).tolist(),
        "contacts": frame.contacts.round(3).tolist(),
    }
    head = {"frame": frame.number, "time": round(frame.seconds, 4), "text": frame.text}
    return json.dumps(head | numbers, ensure_ascii=False)


def vmc_bundle(frame: Frame) -> bytes:
    """An OSC bundle: root at the origin, bones in their parents, the pelvis in the world."""
    offsets = canonical_skeleton().offsets.copy()
    offsets[0] = frame.root
    messages = [_message("/VMC/Ext/Root/Pos", "root", *(0.0,) * 6, 1.0)]
    for name, offset, turn in zip(SCHEMES["unity"], offsets, frame.quaternions, strict=True):
        (x, y, z), (w, i, j, k) = offset.tolist(), turn.tolist()
        messages.append(_message("/VMC/Ext/Bone/Pos", name, -x, y, z, i, -j, -k, w))
    messages.append(_message("/VMC/Ext/OK", 1))
    messages.append(_message("/VMC/Ext/T", float(frame.seconds)))
    sized = (struct.pack(">i", len(message)) + message for message in messages)
    return _padded(b"#bundle") + _OSC_AT_ONCE + b"".join(sized)


def _message(address: str, *values: str | int | float) -> bytes:
    kinds = "".join({str: "s", int: "i", float: "f"}[type(value)] for value in values)
    parts = [_padded(address.encode()), _padded(f",{kinds}".encode())]
    for value in values:
        if isinstance(value, str):
            parts.append(_padded(value.encode()))
        else:
            parts.append(struct.pack(">i" if isinstance(value, int) else ">f", value))
    return b"".join(parts)


def _padded(text: bytes) -> bytes:
    """With a zero, and more up to a multiple of four."""
    return text + b"\0" * (4 - len(text) % 4)
