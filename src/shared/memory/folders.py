"""A memory's files: written to a folder or an address, checked, and read.

Motions are mapped when they are asked for, so that of a memory at an address there is a copy on
this machine: readers bring it up to date, and who builds works in it.
"""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..data.phrases.store import default_cache
from ..errors import UserError
from ..io.files import (
    atomic_write,
    inside,
    is_whole,
    load_json,
    sha256_file,
    sole_writer,
    write_json,
)
from ..io.storage import Address, Place, place, read_blocks, size_of

if TYPE_CHECKING:
    from .index import MemoryIndex

FORMAT_VERSION = 1
MANIFEST, PHRASES = "manifest.json", "phrases.json"
KEYS, MOTIONS = "keys.safetensors", "motions.safetensors"
KEY_TENSORS = ("audio_keys", "motion_keys", "start_phase", "tempo", "song", "offsets")
MOTION_TENSORS = ("trajectories", "priors")
INTEGERS = ("song", "offsets")
TEXTS = ("ids", "captions", "clips")
NAMES = ("songs", *TEXTS)


def save_index(index: "MemoryIndex", folder: Place) -> None:
    """Write the files, then the manifest that makes them a memory and vouches for them.

        manifest.json        format version, width, counts, what it was made of, SHA-256 of the rest
        keys.safetensors     KEY_TENSORS, see `MemoryIndex`
        motions.safetensors  MOTION_TENSORS; mapped, read when asked for
        phrases.json         songs (S); ids, captions and clips (N)

    Nothing is executed on reading, and nothing is read that the manifest does not name.

    Raises:
        UserError: the folder cannot be written.
    """
    from safetensors.torch import save_file

    (folder / MANIFEST).unlink(missing_ok=True)  # until all is there, this is no memory
    for name, tensors in ((KEYS, KEY_TENSORS), (MOTIONS, MOTION_TENSORS)):
        with atomic_write(folder / name) as temporary:
            save_file({part: getattr(index, part).contiguous() for part in tensors}, temporary)
    write_json(folder / PHRASES, {name: list(getattr(index, name)) for name in NAMES})
    files = {name: entry_of(folder / name) for name in (KEYS, MOTIONS, PHRASES)}
    frames = int(index.offsets[-1])
    manifest = {
        "format-version": FORMAT_VERSION,
        "kind": "motion-memory",
        "dim": index.dim,
        "counts": {"phrases": len(index), "songs": len(index.songs), "frames": frames},
        "about": index.about,
        "files": files,
    }
    write_json(folder / MANIFEST, manifest)


def entry_of(path: Place) -> dict[str, Any]:
    """What a manifest tells of a file."""
    return {"sha256": sha256_file(path), "bytes": size_of(path)}


def read_manifest(folder: Place) -> dict[str, Any]:
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


def read_index(folder: Path) -> dict[str, Any]:
    """The fields of a MemoryIndex.

    Raises:
        UserError: see `MemoryIndex.open`.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    manifest = read_manifest(folder)
    try:
        for name in dict.fromkeys((KEYS, MOTIONS, PHRASES, *manifest["files"])):
            _check(inside(folder, name), manifest["files"][name])
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
    finite = ("audio_keys", "motion_keys", "start_phase", "tempo")
    if not (
        count > 0
        and fields["audio_keys"].ndim == 2
        and all(tuple(fields[name].shape) == shape for name, shape in shapes.items())
        and all(len(fields[name]) == count for name in TEXTS)
        and all(fields[name].dtype.is_floating_point != (name in INTEGERS) for name in shapes)
        and (offsets[0], offsets[-1]) == (0, frames)
        and (offsets.diff() > 0).all()
        and ((song >= 0) & (song < len(fields["songs"]))).all()
        and all(fields[name].isfinite().all() for name in finite)
    ):
        raise UserError(
            f"{folder} is damaged: its tables do not belong together; build the memory again"
        )


def _check(path: Path, entry: dict[str, Any]) -> None:
    size = path.stat().st_size if path.is_file() else None
    if size != entry["bytes"]:
        found = "is missing" if size is None else f"has {size} bytes, not {entry['bytes']}"
        raise UserError(f"{path} {found}; copy the memory's folder again or build it anew")
    if sha256_file(path) != entry["sha256"]:
        raise UserError(
            f"{path} does not match the SHA-256 in {MANIFEST}; copy the memory's folder again or"
            " build it anew"
        )


# ---------------------------------------------------------------- at an address


def readable(memory: str | Place) -> Path:
    """The folder of a memory; of one at an address its copy, which is brought up to date.

    Raises:
        UserError: there is none at the address, it is damaged, or cannot be reached.
    """
    source = place(memory)
    if isinstance(source, Path):
        return source
    folder = _copy_of(source)
    if _missing(folder, source):
        with sole_writer(folder, wait=True):
            _copy(source, folder)
    return folder


@contextmanager
def writable(memory: Place) -> Iterator[Path]:
    """The folder to build a memory in; of an address its copy, which is put there afterwards.

    Raises:
        UserError: another process builds it here, or the address cannot be written.
    """
    if isinstance(memory, Path):
        yield memory
        return
    folder = _copy_of(memory)
    with sole_writer(folder):
        with suppress(UserError):  # nothing there, or nothing to go on from
            _copy(memory, folder)
        yield folder
        _copy(folder, memory)


def _copy_of(memory: Address) -> Path:
    return default_cache().parent / "memories" / Path(*memory.parts)


def _missing(folder: Place, source: Place) -> dict[str, str]:
    """Files of the memory in `source` that `folder` has not, with their SHA-256; the manifest is
    the last."""
    try:
        files = read_manifest(source)["files"]
        hashes = {str(name): str(entry["sha256"]) for name, entry in files.items()}
    except (AttributeError, LookupError, TypeError) as error:
        raise UserError(f"{source}/{MANIFEST} is damaged; build the memory again") from error
    hashes[MANIFEST] = sha256_file(source / MANIFEST)

    def path(name: str) -> Place:
        return folder / name if isinstance(folder, Address) else inside(folder, name)

    return {name: sha256 for name, sha256 in hashes.items() if not is_whole(path(name), sha256)}


def _copy(source: Place, target: Place) -> None:
    """Put a memory's files where they are missing, the manifest last."""
    missing = _missing(target, source)
    if MANIFEST in missing:
        (target / MANIFEST).unlink(missing_ok=True)
    for name, sha256 in missing.items():
        with atomic_write(target / name) as temporary:
            with suppress(FileNotFoundError), temporary.open("wb") as stream:
                stream.writelines(read_blocks(source / name))
            if not is_whole(temporary, sha256):
                raise UserError(
                    f"{source / name} is missing, or not what {MANIFEST} tells; if nobody is"
                    " writing it, build the memory again"
                )
