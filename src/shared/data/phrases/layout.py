"""How motion phrases are stored, what the manifest says of them, and what is valid content.

T frames at 30 fps. TECH §1.3: `audio_features/{id}/features.npz` beside
`motion/{id}/trajectory.npy`; `manifest.json` with the size and SHA-256 of each is ours, because a
flipped bit in an npy file loads without an error. So is `motion/{id}/body.npz`, which folders of
before lack: `features` [T,23,6] float16 of the whole body (motion/features.py).
"""

import hashlib
import json
import os
import re
import tempfile
import weakref
from array import array
from bisect import bisect_left
from codecs import getincrementaldecoder
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import IO, Any

import numpy as np
from pydantic import BaseModel, ValidationError, field_validator

from ...audio.features import AudioFeatures
from ...errors import UserError, first_fault
from ...io.arrays import BadArray, load_array, load_arrays, write_arrays
from ...io.files import atomic_write, sha256_file, write_text
from ...io.storage import Place, size_of

MANIFEST = "manifest.json"
MIN_FRAMES = 8  # what the UNet takes at least (ruling 4)
_LARGEST = 1e4  # metres, m/s, ...: beyond is a flipped exponent bit
_LENGTH_TOLERANCE = 30  # frames by which motion and sound may differ


class BadContent(Exception):
    """An object or phrase that cannot be used; the message is the reason."""


class StoredObject(BaseModel, frozen=True):
    """One object.

    Attributes:
        path: relative to the root of the data.
        size: bytes; 0 where only the hash is known.
        sha256: hex digest from the manifest; empty where there is no manifest.
        version: without a manifest, the store's own mark of this version (an etag, say).
        md5: without a manifest, hex digest that the store tells, if it does.
    """

    path: str
    size: int = 0
    sha256: str = ""
    version: str = ""
    md5: str = ""

    @field_validator("path")
    @classmethod
    def _is_inside(cls, path: str) -> str:
        """A manifest of somebody else's names nothing outside its folder."""
        if path.startswith("/") or ".." in path.split("/") or "\\" in path or ":" in path:
            raise ValueError(f"{path!r:.60} leads out of the folder")
        return path

    @property
    def key(self) -> str:
        """Names this content: changes when the object does."""
        name = f"{self.path}\n{self.size}\n{self.version}"
        return self.sha256 or hashlib.sha256(name.encode()).hexdigest()


class PhraseRecord(BaseModel, frozen=True):
    """One phrase of the manifest: its objects, where it comes from, what its motion is.

    Attributes:
        tempo: beats a minute; 0 = unknown.
        tag, caption: what is done, in a word and in a sentence; "" = unknown.
        clips: that it is made of; a mirror image goes by the name of its original.
        body: None in folders of before.
    """

    id: str
    split: str = "train"
    song: str = ""
    tempo: float = 0.0
    tag: str = ""
    caption: str = ""
    clips: tuple[str, ...] = ()
    motion: StoredObject
    features: StoredObject
    body: StoredObject | None = None

    @property
    def key(self) -> str:
        """Changes when the content of any object does."""
        parts = (self.motion, self.features, self.body)
        keys = "".join(part.key for part in parts if part is not None)
        return hashlib.sha256(keys.encode()).hexdigest()


class Manifest(BaseModel, frozen=True):
    """The content of manifest.json."""

    version: int = 1
    fps: float = 30.0
    phrases: list[PhraseRecord]


@dataclass(frozen=True, eq=False)
class SoundContent:
    """What features.npz holds: stacked [163,T] float32, unwrapped bars [T] float64, beats a bar."""

    stacked: np.ndarray
    phase: np.ndarray | None
    meter: int


# ------------------------------------------------------------------ writing and listing


def features_path(phrase: str) -> str:
    """Relative path of a phrase's sound."""
    return f"audio_features/{phrase}/features.npz"


def trajectory_path(phrase: str) -> str:
    """Relative path of a phrase's motion."""
    return f"motion/{phrase}/trajectory.npy"


def body_path(phrase: str) -> str:
    """Relative path of a phrase's whole body."""
    return f"motion/{phrase}/body.npz"


def write_body(root: Place, phrase: str, features: np.ndarray) -> StoredObject:
    """Write the body [T,23,6] of a phrase under a folder; returns what the manifest says of it."""
    arrays = {"features": np.asarray(features, np.float16)}
    write_arrays(arrays, root / body_path(phrase), compressed=True)
    return _stored(root, body_path(phrase))


def _stored(root: Place, path: str) -> StoredObject:
    file = root / path
    return StoredObject(path=path, size=size_of(file), sha256=sha256_file(file))


def write_phrase(
    root: Place, phrase: str, trajectory: np.ndarray, features: Mapping[str, Any], **about: Any
) -> PhraseRecord:
    """Write one phrase under a folder.

    Args:
        trajectory: [T,25].
        features: arrays of features.npz (TECH §4.2; `phase` [T] and `meter` if known).
        about: `split`, `song`, `tempo` of the record.
    """
    motion, sound = root / trajectory_path(phrase), root / features_path(phrase)
    with atomic_write(motion) as temporary, temporary.open("wb") as stream:
        np.save(stream, np.asarray(trajectory, np.float32))
    write_arrays(features, sound)
    (root / body_path(phrase)).unlink(missing_ok=True)  # of another motion
    return record_phrase(root, phrase, **about)


def record_phrase(root: Place, phrase: str, **about: Any) -> PhraseRecord:
    """The record of a phrase whose files are there; `about` as for `write_phrase`."""
    motion, features = (_stored(root, f(phrase)) for f in (trajectory_path, features_path))
    body = _stored(root, body_path(phrase)) if (root / body_path(phrase)).exists() else None
    return PhraseRecord(id=phrase, motion=motion, features=features, body=body, **about)


def write_manifest(root: Path, phrases: Iterable[PhraseRecord]) -> Path:
    """Write manifest.json for these phrases, in the order of their names."""
    manifest = Manifest(version=1, fps=30.0, phrases=sorted(phrases, key=lambda phrase: phrase.id))
    write_text(root / MANIFEST, manifest.model_dump_json(indent=1, exclude_unset=True) + "\n")
    return root / MANIFEST


_BEGIN = re.compile(r'"phrases"\s*:\s*\[')
_BETWEEN = re.compile(r"[\s,]*")
_JSON = json.JSONDecoder()


def parse_manifest(blocks: Iterable[bytes], where: str) -> Iterator[PhraseRecord]:
    """The phrases of a manifest of any length, in its order; one block is kept at a time.

    Raises:
        UserError: it is not a manifest.
    """
    decode, more = getincrementaldecoder("utf-8")().decode, iter(blocks)
    text, begin, number = "", None, 0
    try:
        while begin is None and (block := next(more, None)) is not None:
            text += decode(block)
            begin = _BEGIN.search(text)
        if begin is None:
            Manifest.model_validate_json(text)  # which it is not
            return
        head, text, at = text[: begin.end()], text[begin.end() :], 0
        while True:
            between = _BETWEEN.match(text, at)
            at = between.end() if between else at
            try:
                if text[at : at + 1] == "]":
                    break
                phrase, end = _JSON.raw_decode(text, at)
            except ValueError:
                if (block := next(more, None)) is None:
                    raise
                text, at = text[at:] + decode(block), 0
                continue
            at = end
            yield PhraseRecord.model_validate(phrase)
            number += 1
        rest = text[at:] + "".join(decode(block) for block in more)
        Manifest.model_validate_json(head + rest)
    except (ValueError, RecursionError) as error:  # pydantic's is a ValueError
        told = str(error)
        if isinstance(error, ValidationError):
            of_phrase = error.title == PhraseRecord.__name__
            told = of_phrase * f"phrases.{number}." + first_fault(error)
        raise UserError(
            f"{where} is not a manifest: {told}; write it again with"
            " prepare-audio, or remove it to read the folder without checksums"
        ) from error


def phrases_of_listing(objects: Mapping[str, StoredObject]) -> list[PhraseRecord]:
    """Phrases of a folder without a manifest: every id that has both objects.

    A tenth of the ids, by hash, is the split `val`.
    """
    ids = sorted(p.split("/")[1] for p in objects if p.startswith("motion/") and p.count("/") == 2)
    return [
        PhraseRecord(
            id=phrase,
            split="train" if hashlib.sha256(phrase.encode()).digest()[0] >= 26 else "val",
            motion=objects[trajectory_path(phrase)],
            features=objects[features_path(phrase)],
            body=objects.get(body_path(phrase)),
        )
        for phrase in ids
        if {trajectory_path(phrase), features_path(phrase)} <= objects.keys()
    ]


# ------------------------------------------------------------------ reading and checking


def decode_trajectory(data: bytes) -> np.ndarray:
    """[T,25] float32 of trajectory.npy.

    Raises:
        BadContent: not an array of that shape, values not finite or out of any range.
    """
    try:
        values = load_array(data)
    except BadArray as error:
        raise BadContent(f"not an npy file ({error})") from error
    _require_usable("trajectory", values, 25)
    lengths = np.linalg.norm(values[:, 9:13], axis=1)
    if (np.abs(lengths - 1) > 0.01).any():
        raise BadContent(f"a quaternion has length {lengths[np.abs(lengths - 1).argmax()]:.3g}")
    return values.astype(np.float32)


def decode_body(data: bytes) -> np.ndarray:
    """[T,23,6] float32 of body.npz.

    Raises:
        BadContent: not an array of that shape, or values not finite or out of any range.
    """
    try:
        values = load_arrays(data, ["features"])["features"]
    except (BadArray, KeyError) as error:
        raise BadContent(f"not an npz file with `features` ({error})") from error
    _require_usable("body", values, 23, 6)
    return values.astype(np.float32)


def decode_features(data: bytes) -> SoundContent:
    """The content of features.npz.

    Raises:
        BadContent: an array is missing, has another shape, or is not finite.
    """
    try:
        arrays = load_arrays(data)
        features = AudioFeatures.from_arrays(arrays, "features.npz")
        known = "phase" in arrays and "meter" in arrays
        phase = arrays["phase"].astype(np.float64) if known else None
        meter = int(arrays["meter"]) if known else 0
    except UserError as error:
        raise BadContent(str(error)) from error
    except (BadArray, TypeError, ValueError) as error:
        raise BadContent(f"not an npz file ({error})") from error
    for name, values in features.arrays().items():
        _require_usable(name, values)
    frames = features.num_frames
    if phase is not None and (phase.shape != (frames,) or not np.isfinite(phase).all()):
        raise BadContent(f"phase {list(phase.shape)} is not [{frames}] finite values")
    return SoundContent(features.stack(), phase, meter)


def _require_usable(name: str, values: np.ndarray, *frame: int) -> None:
    """Refuse what are no finite numbers, or no rows [T,*frame] where that is given."""
    if frame and values.shape[1:] != frame:
        wanted = ", ".join(map(str, frame))
        raise BadContent(f"a {name} is [T, {wanted}], this is {list(values.shape)}")
    if not np.issubdtype(values.dtype, np.floating):
        raise BadContent(f"{name} holds {values.dtype}, not floating-point numbers")
    if not np.isfinite(values).all():
        raise BadContent(f"{name} has values that are not finite")
    if values.size and np.abs(values).max() > _LARGEST:
        raise BadContent(f"{name} has a value of {np.abs(values).max():.3g}")


def common_length(trajectory: np.ndarray, sound: SoundContent) -> int:
    """Frames that motion and sound share.

    Raises:
        BadContent: fewer than 8, or the two differ by more than a second.
    """
    motion, music = len(trajectory), int(sound.stacked.shape[1])
    if abs(motion - music) > _LENGTH_TOLERANCE:
        raise BadContent(f"motion has {motion} frames, the sound {music}")
    if min(motion, music) < MIN_FRAMES:
        raise BadContent(f"only {min(motion, music)} frames")
    return min(motion, music)


def phase_rows(phase: np.ndarray, meter: int) -> np.ndarray:
    """Cosine and sine of beat phase, then of bar phase: unwrapped bars [T] -> [4,T] float32."""
    bar = 2 * np.pi * np.asarray(phase, np.float64)
    beat = bar * meter
    return np.stack([np.cos(beat), np.sin(beat), np.cos(bar), np.sin(bar)]).astype(np.float32)


# ---------------------------------------------------------------- the phrases of a folder


class PhraseTable(Sequence[PhraseRecord]):
    """Phrases by name, in a temporary file that goes when this does.

    Args:
        phrases: in any order; that of the names costs no memory.
        most: keep only the first so many.
        where: they come from, for messages.

    Raises:
        UserError: two have one name.
    """

    def __init__(self, phrases: Iterable[PhraseRecord], most: int | None, where: str) -> None:
        self._begins, self._ends = array("q"), array("q")
        last, ordered = "", True
        with self._new_file() as stream:
            for phrase in phrases:
                self._begins.append(stream.tell())
                stream.write(phrase.model_dump_json(exclude_unset=True).encode())
                self._ends.append(stream.tell())
                ordered, last = ordered and last < phrase.id, phrase.id
        if not ordered:
            self._sort(where)
        if most is not None:
            del self._begins[most:], self._ends[most:]

    def _new_file(self) -> IO[bytes]:
        handle, name = tempfile.mkstemp(prefix="motionsuite-", suffix=".jsonl")
        self._path = Path(name)
        weakref.finalize(self, self._path.unlink, missing_ok=True)
        return os.fdopen(handle, "wb")

    def _sort(self, where: str) -> None:
        names = [phrase.id for phrase in self]
        if len(set(names)) < len(names):
            raise UserError(f"{where} names a phrase twice; write it again with prepare-audio")
        order = sorted(range(len(names)), key=names.__getitem__)
        for places in (self._begins, self._ends):
            places[:] = array("q", [places[number] for number in order])

    @cached_property
    def fingerprint(self) -> str:
        """Changes when any phrase's content or the selection of phrases does."""
        digest = hashlib.sha256()
        for phrase in self:
            digest.update(f"{phrase.id} {phrase.key}\n".encode())
        return digest.hexdigest()

    def __len__(self) -> int:
        return len(self._begins)

    def __getitem__(self, index: int) -> PhraseRecord:  # type: ignore[override]  # no slices
        begin, end = self._begins[index], self._ends[index]
        with self._path.open("rb") as stream:  # anew: threads and processes read at once
            stream.seek(begin)
            return PhraseRecord.model_validate_json(stream.read(end - begin))

    def named(self, name: str) -> PhraseRecord | None:
        """The phrase of this name."""
        index = bisect_left(self, name, key=lambda phrase: phrase.id)
        found = self[index] if index < len(self) else None
        return found if found is not None and found.id == name else None

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_path": self._path.read_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        with self._new_file() as stream:
            stream.write(state["_path"])
