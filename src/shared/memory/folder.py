"""A memory on disk: manifest.json vouches for three files.

    manifest.json        format version, width, counts, what it was made of, SHA-256 of the rest
    keys.safetensors     audio_keys, motion_keys [N,D] float32, start_phase, tempo [N] float32,
                         song [N], offsets [N+1] int64
    motions.safetensors  trajectories [F,25], priors [F,4] float16; mapped, read when asked for
    phrases.json         songs (S); ids, captions and clips (N)

Nothing is executed on reading, and nothing is read that the manifest does not name.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import UserError
from ..io.files import atomic_write, inside, load_json, sha256_file, write_json

if TYPE_CHECKING:
    from .index import MemoryIndex

FORMAT_VERSION = 1
MANIFEST, KEYS, MOTIONS, PHRASES = (
    "manifest.json",
    "keys.safetensors",
    "motions.safetensors",
    "phrases.json",
)
KEY_TENSORS = ("audio_keys", "motion_keys", "start_phase", "tempo", "song", "offsets")
MOTION_TENSORS = ("trajectories", "priors")
INTEGERS = ("song", "offsets")
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
        manifest = load_json(path)
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
    try:
        for name in dict.fromkeys((KEYS, MOTIONS, PHRASES, *manifest["files"])):
            _check(inside(folder, name), manifest["files"][name], verify=verify)
        fields: dict[str, Any] = {}
        for name, tensors in ((KEYS, KEY_TENSORS), (MOTIONS, MOTION_TENSORS)):
            stored = load_file(folder / name)  # mapped: pages are read when they are touched
            fields |= {part: stored[part] for part in tensors}
        names = load_json(folder / PHRASES)
        fields |= {name: tuple(names[name]) for name in NAMES}
        fields["about"] = dict(manifest["about"])
    except (OSError, ValueError, TypeError, LookupError, SafetensorError) as error:
        raise UserError(f"{folder} is damaged ({error!s:.300}); build the memory again") from error
    _check_fields(folder, fields)
    return fields


def _check_fields(folder: Path, fields: dict[str, Any]) -> None:
    """Refuse counts and numbers that do not belong together; searches rely on them."""
    count, frames = len(fields["audio_keys"]), len(fields["trajectories"])
    offsets, song = fields["offsets"], fields["song"]
    shapes = {
        "audio_keys": (count, *fields["audio_keys"].shape[1:]),
        "motion_keys": fields["audio_keys"].shape,
        **dict.fromkeys(("start_phase", "tempo", "song"), (count,)),
        "offsets": (count + 1,),
        "trajectories": (frames, 25),
        "priors": (frames, 4),
    }
    whole = all(tuple(fields[name].shape) == shape for name, shape in shapes.items())
    whole &= all(len(fields[name]) == count for name in ("ids", "captions", "clips"))
    whole &= count > 0 and fields["audio_keys"].ndim == 2
    whole &= all(fields[name].dtype.is_floating_point for name in shapes if name not in INTEGERS)
    whole = whole and not any(fields[name].dtype.is_floating_point for name in INTEGERS)
    whole = whole and bool(offsets[0] == 0) and bool(offsets[-1] == frames)
    whole = whole and bool((offsets.diff() > 0).all())
    whole = whole and bool((song >= 0).all()) and bool((song < len(fields["songs"])).all())
    finite = ("audio_keys", "motion_keys", "start_phase", "tempo")
    whole = whole and all(bool(fields[name].isfinite().all()) for name in finite)
    if not whole:
        raise UserError(
            f"{folder} is damaged: its tables do not belong together; build the memory again"
        )


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
