"""A memory on disk: manifest.json vouches for three files.

    manifest.json        format version, width, counts, what it was made of, SHA-256 of the rest
    keys.safetensors     audio_keys, motion_keys [N,D] float32, start_phase, tempo [N] float32,
                         song [N], offsets [N+1] int64
    motions.safetensors  trajectories [F,25], priors [F,4] float16; mapped, read when asked for
    phrases.json         songs (S); ids, captions and clips (N)

Nothing is executed on reading, and nothing is read that the manifest does not name.
"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from src.shared.errors import UserError
from src.shared.files import atomic_write, sha256_file, write_json

if TYPE_CHECKING:
    from src.shared.memory.index import MemoryIndex

FORMAT_VERSION = 1
MANIFEST, KEYS, MOTIONS, PHRASES = (
    "manifest.json",
    "keys.safetensors",
    "motions.safetensors",
    "phrases.json",
)
KEY_TENSORS = ("audio_keys", "motion_keys", "start_phase", "tempo", "song", "offsets")
MOTION_TENSORS = ("trajectories", "priors")
NAMES = ("songs", "ids", "captions", "clips")


def save_index(index: "MemoryIndex", folder: Path) -> None:
    """Write the files, then the manifest that makes them a memory.

    Raises:
        UserError: the folder cannot be written.
    """
    from safetensors.torch import save_file

    (folder / MANIFEST).unlink(missing_ok=True)  # until all is there, this is no memory
    for name, tensors in ((KEYS, KEY_TENSORS), (MOTIONS, MOTION_TENSORS)):
        with atomic_write(folder / name) as temporary:
            save_file({part: getattr(index, part).contiguous() for part in tensors}, temporary)
    write_json(folder / PHRASES, {name: list(getattr(index, name)) for name in NAMES})
    files = {
        name: {"sha256": sha256_file(folder / name), "bytes": (folder / name).stat().st_size}
        for name in (KEYS, MOTIONS, PHRASES)
    }
    counts = {
        "phrases": len(index),
        "songs": len(index.songs),
        "frames": int(index.offsets[-1]),
    }
    manifest = {
        "format-version": FORMAT_VERSION,
        "kind": "motion-memory",
        "dim": index.dim,
        "counts": counts,
        "about": index.about,
        "files": files,
    }
    write_json(folder / MANIFEST, manifest)


def read_manifest(folder: Path) -> dict[str, Any]:
    """The manifest of a memory.

    Raises:
        UserError: there is none, or not one that this version reads.
    """
    path = folder / MANIFEST
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise UserError(
            f"{folder} is no memory: it has no {MANIFEST}; make one with `memory build`"
        ) from error
    except (OSError, ValueError) as error:
        raise UserError(f"{path} cannot be read ({error}); build the memory again") from error
    if not isinstance(manifest, dict) or manifest.get("kind") != "motion-memory":
        raise UserError(f"{path} describes no memory; name the folder that `memory build` wrote")
    version = manifest.get("format-version")
    if version != FORMAT_VERSION:
        raise UserError(
            f"{path}: format-version {version}, this program reads {FORMAT_VERSION};"
            " build the memory again"
        )
    return manifest


def read_index(folder: Path, *, verify: bool) -> dict[str, Any]:
    """The fields of a MemoryIndex.

    Raises:
        UserError: see `MemoryIndex.open`.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    manifest = read_manifest(folder)
    for name, told in manifest["files"].items():
        _check(folder / name, told, verify=verify)
    try:
        fields: dict[str, Any] = {}
        for name, tensors in ((KEYS, KEY_TENSORS), (MOTIONS, MOTION_TENSORS)):
            stored = load_file(folder / name)  # mapped: pages are read when they are touched
            fields |= {part: stored[part] for part in tensors}
        names = json.loads((folder / PHRASES).read_text(encoding="utf-8"))
        fields |= {name: tuple(names[name]) for name in NAMES}
    except (OSError, ValueError, KeyError, SafetensorError) as error:
        raise UserError(f"{folder} is damaged ({error}); build the memory again") from error
    return fields | {"about": manifest["about"]}


def _check(path: Path, told: dict[str, Any], *, verify: bool) -> None:
    size = path.stat().st_size if path.is_file() else None
    if size != told["bytes"]:
        found = "is missing" if size is None else f"has {size} bytes, not {told['bytes']}"
        raise UserError(f"{path} {found}; copy the memory's folder again or build it anew")
    if verify and sha256_file(path) != told["sha256"]:
        raise UserError(
            f"{path} does not match the SHA-256 in {MANIFEST}; copy the memory's folder again or"
            " build it anew"
        )
