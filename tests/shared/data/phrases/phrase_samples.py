"""Phrases to store in tests, and a file system in memory that fails on demand."""

from collections import Counter
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from fsspec import register_implementation
from fsspec.implementations.memory import MemoryFileSystem

from src.shared.data.phrases.layout import PhraseRecord, write_manifest, write_phrase
from src.shared.io.storage import Backoff

ROWS = {"mel": 128, "chroma": 12, "mfcc": 20}


def make_trajectory(frames: int, seed: int = 0) -> np.ndarray:
    """A plausible [T,25]: finite, unit quaternions, a bar of 60 frames."""
    rng = np.random.default_rng(seed)
    values = rng.normal(size=(frames, 25)).astype(np.float32)
    values[:, 9:13] /= np.linalg.norm(values[:, 9:13], axis=1, keepdims=True)
    values[:, 16] = np.arange(frames) / 60 % 1
    return values


def make_features(frames: int, seed: int = 0, *, meter: int = 4) -> dict[str, Any]:
    """Arrays of features.npz."""
    rng = np.random.default_rng(seed)
    arrays: dict[str, Any] = {
        name: rng.random((height, frames), np.float32) for name, height in ROWS.items()
    }
    for name in ("rms", "spectral_centroid", "onset_strength"):
        arrays[name] = rng.random(frames, np.float32)
    if meter:
        arrays |= {"phase": np.arange(frames) / 60, "meter": meter}
    return arrays


def store_phrases(
    folder: Path, lengths: list[int], *, manifest: bool = True, meter: int = 4
) -> list[PhraseRecord]:
    """Phrases p000, p001, ... of these lengths under a folder."""
    records = [
        write_phrase(
            folder,
            f"p{number:03d}",
            make_trajectory(frames, number),
            make_features(frames, number, meter=meter),
            song=f"song{number // 2}",
            split="val" if number % 5 == 4 else "train",
        )
        for number, frames in enumerate(lengths)
    ]
    if manifest:
        write_manifest(folder, records)
    return records


def plain_encode(trajectory: np.ndarray, phase: np.ndarray) -> np.ndarray:
    """The trajectory's own columns, phase unwrapped: tells which frames a window holds."""
    window = np.array(trajectory.T)
    window[16] = phase
    return window


def no_wait(**settings: Any) -> Backoff:
    return Backoff(**({"sleep": lambda seconds: None} | settings))


class FlakyFileSystem(MemoryFileSystem):
    """`flaky://`: counts reads, and on each takes the next fault named for the path, if any.

    A fault is an exception to raise or a function of the bytes.
    """

    protocol = "flaky"
    store: ClassVar[dict[str, Any]] = {}
    pseudo_dirs: ClassVar[list[str]] = [""]
    faults: ClassVar[dict[str, list[Any]]] = {}
    reads: ClassVar[Counter[str]] = Counter()

    @classmethod
    def _strip_protocol(cls, path: str) -> str:
        return MemoryFileSystem._strip_protocol(str(path).removeprefix("flaky://"))

    def cat_file(self, path: str, start: Any = None, end: Any = None, **kwargs: Any) -> bytes:
        path = self._strip_protocol(path)
        self.reads[path] += 1
        data = super().cat_file(path, start, end, **kwargs)
        waiting = self.faults.get(path)
        if not waiting:
            return data
        fault = waiting.pop(0)
        if isinstance(fault, BaseException):
            raise fault
        return bytes(fault(data))

    def upload(self, folder: Path, root: str) -> None:
        for file in folder.rglob("*"):
            if file.is_file():
                self.pipe_file(f"{root}/{file.relative_to(folder)}", file.read_bytes())


register_implementation("flaky", FlakyFileSystem, clobber=True)


def flip_bit(data: bytes) -> bytes:
    """One bit of the last quarter, where an npy file has its numbers."""
    place = len(data) * 7 // 8
    return data[:place] + bytes([data[place] ^ 0x40]) + data[place + 1 :]
