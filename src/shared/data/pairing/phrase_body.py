"""The whole body behind a phrase's trajectory, and what it does in words.

A phrase is made of clips' pelvises; its pieces and its warp say which moment of which clip is
seen when, so the other joints follow the same seams and the same warp.

T frames of the phrase, N of its motion before the warp.
"""

import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from ...files import sha256_file, write_json
from ...motion.motion import Motion
from ...motion.root_track import LEFT_CONTACT, ROOT_ROW, encode_features
from ...motion.rotations import (
    quaternion_continuous,
    quaternion_slerp,
    rotation_6d_to_quaternion,
)
from ..phrases.layout import StoredObject, write_body
from ..prepared import PreparedData
from ..records import MIRRORED
from .clip_library import FPS, track_of
from .pair import SPARE
from .phrase_motion import Piece, join, lay
from .time_warp import Warp, resample, resample_rotations

Entry = dict[str, Any]


def add_bodies(out: Path, entries: Sequence[Entry], data: PreparedData) -> None:
    """Write the bodies that are missing, and put each into its phrase's record.

    Args:
        out: folder of the pairs; the marks in its `phrases` learn of the body.
        entries: of phrases, as `pair_song` returns them; `record` gets `body`, `tag`,
            `caption` and `clips`.
        data: the clips.
    """
    records = {record.id: record for record in data.records()}
    for entry in entries:
        stored = StoredObject(**entry["body"]) if "body" in entry else None
        if stored is None or not is_whole(out, stored):
            pieces, warp = read_pair(entry["pair"])
            frames = entry["pair"]["frames"]
            features = phrase_body(pieces, warp, frames, lambda n: data.features(records[n]))
            stored = write_body(out, entry["id"], features.numpy())
            entry["body"] = stored.model_dump()
            write_json(out / "phrases" / f"{entry['id']}.json", entry)
        parts = entry["pair"]["pieces"]
        longest = max(parts, key=lambda piece: piece["last"] - piece["first"])
        shown = records[longest["clip"]]
        captions = data.captions(shown)
        spoken = captions.get("en") or next(iter(captions.values()), [])
        entry["record"] |= {
            "body": stored.model_dump(),
            "tag": shown.tag,
            "caption": _one_of(spoken, entry["id"]),
            "clips": sorted({part["clip"].removesuffix(MIRRORED) for part in parts}),
        }


def is_whole(out: Path, stored: StoredObject) -> bool:
    """Whether a file is there with the content that its record describes."""
    path = out / stored.path
    return path.exists() and sha256_file(path) == stored.sha256


def _one_of(captions: Sequence[str], name: str) -> str:
    """A caption by the phrase's name, so that phrases of one clip are not all called alike."""
    if not captions:
        return ""
    return captions[zlib.crc32(name.encode()) % len(captions)]


def read_pair(pair: Entry) -> tuple[list[Piece], Warp]:
    """Pieces and warp as the manifest holds them."""
    warp = Warp(pair["warp"]["start"], tuple(pair["warp"]["rates"]))
    return [Piece(**piece) for piece in pair["pieces"]], warp


def phrase_body(
    pieces: Sequence[Piece],
    warp: Warp,
    num_frames: int,
    features_of: Callable[[str], Tensor],
) -> Tensor:
    """Features of a phrase's body; its pelvis is that of the phrase's trajectory.

    Args:
        pieces, warp: what the phrase is made of.
        num_frames: T.
        features_of: clip id → raw features [N',23,6].

    Returns:
        [T,23,6] float32, see root_track.py.
    """
    times = warp.times(np.arange(num_frames + SPARE) / FPS)
    motion = join(pieces, lambda name: track_of(features_of(name)))
    position, pelvis = resample(motion.position, motion.quaternion, times, FPS)
    joints = lay(pieces, lambda name: _joints(features_of(name)), quaternion_slerp)  # N 21 4
    contacts = lay(pieces, lambda name: features_of(name)[:, ROOT_ROW, LEFT_CONTACT:], torch.lerp)
    body = Motion(
        quaternions=np.concatenate(
            (pelvis[:, None], resample_rotations(joints.numpy(), times, FPS)), 1
        ),
        root_position=position,
        contacts=_resample_linear(contacts.numpy(), times),
    )
    return encode_features(body)[:num_frames]


def _joints(features: Tensor) -> Tensor:
    """Rotations [N,21,4] of all joints but the pelvis."""
    return quaternion_continuous(rotation_6d_to_quaternion(features[:, 1:ROOT_ROW]))


def _resample_linear(values: np.ndarray, times: np.ndarray) -> np.ndarray:
    """[N,C] at other seconds [T]."""
    frames = np.arange(len(values)) / FPS
    columns = [np.interp(times, frames, column) for column in values.T]
    return np.stack(columns, 1).astype(np.float32)
