"""What a report folder knows of itself, so that a second start takes it up where it stopped.

manifest.json: hashes and settings of all that decides the figures; reports may be compared, and a
stopped one continued, if theirs agree. parts/: what has been finished, a JSON file each, written
whole. How long it took is kept apart in timing.json, so that nothing else depends on the clock.
"""

import hashlib
import platform
import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
import torch

from ..errors import UsageError, UserError
from ..io.files import inside, load_json, sha256_file, write_json

MANIFEST, TIMING = "manifest.json", "timing.json"
FORMAT_VERSION = 1
PACKAGES = ("motionsuite", "torch", "numpy", "scipy", "librosa", "transformers", "safetensors")
FREE = ("replications",)  # settings that may differ: more replications go on from fewer
Part = dict[str, Any]


@dataclass(frozen=True)
class Sources:
    """What decides the figures of a report beside its settings."""

    model: Mapping[str, Any]  # hashes of their files, see `folder_hashes`
    data: Mapping[str, Any]  # what was measured on: manifest hash, ids of the splits
    statistics: Iterable[torch.Tensor]  # mean and deviation tensors in use
    device: str
    evaluator: Mapping[str, Any] = field(default_factory=dict)  # likewise
    # what differs from the model's own settings
    sampling: Mapping[str, Any] = field(default_factory=dict)


def build(
    branch: str, sources: Sources, settings: Mapping[str, Any], metrics: Mapping[str, Sequence[str]]
) -> dict[str, Any]:
    """Everything by name; `metrics`: the columns of each family."""
    digest = hashlib.sha256()
    for each in sources.statistics:
        digest.update(np.ascontiguousarray(each.detach().cpu().numpy()).tobytes())
    return {
        "format-version": FORMAT_VERSION,
        "branch": branch,
        "model": dict(sources.model),
        "evaluator": dict(sources.evaluator),
        "data": dict(sources.data),
        "statistics": digest.hexdigest(),
        "settings": {k: list(v) if isinstance(v, tuple) else v for k, v in settings.items()},
        "sampling": {key: value for key, value in sources.sampling.items() if value is not None},
        "metrics": {name: list(columns) for name, columns in metrics.items()},
        "environment": {
            "python": platform.python_version(),
            "machine": platform.machine(),
            "device": sources.device,
            "threads": torch.get_num_threads(),
            "packages": {name: _version(name) for name in PACKAGES},
        },
    }


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def folder_hashes(folder: Path) -> dict[str, str]:
    """SHA-256 of a model folder's cards, weights and statistics by file name."""
    files = sorted([*folder.glob("*.json"), *folder.glob("*.safetensors")])
    return {path.name: sha256_file(path) for path in files}


def model_hashes(models: Mapping[str, str | Path]) -> dict[str, str]:
    """`folder_hashes` of several model folders, each file as `name/file`."""
    from ..model.checkpoint import resolve_model

    return {
        f"{name}/{file}": digest
        for name, folder in models.items()
        for file, digest in folder_hashes(resolve_model(str(folder))).items()
    }


def song_hashes(folder: Path | None) -> dict[str, str]:
    """SHA-256 of every file below a folder by its name; none without a folder."""
    files = sorted(folder.rglob("*")) if folder is not None else []
    return {path.name: sha256_file(path) for path in files if path.is_file()}


def hash_names(names: Iterable[str]) -> str:
    """SHA-256 of a list of names: the clips of a split, the prompts of a sample."""
    return hashlib.sha256("\n".join(names).encode()).hexdigest()


def claim(folder: Path, manifest: dict[str, Any]) -> None:
    """Take a folder for a report, or go on in it.
    Raises UsageError: it holds a report of something else."""
    path = folder / MANIFEST
    if path.is_file():
        differs = differences(read_json(path), manifest)
        if differs:
            raise UsageError(
                f"--out {folder} holds an evaluation with another {', '.join(differs)}; name"
                " another folder, or delete this one"
            )
    write_json(path, manifest)


def differences(a: Mapping[str, Any], b: Mapping[str, Any]) -> list[str]:
    """Names of what two manifests disagree in, apart from the number of replications."""
    found = []
    for key in sorted({*a, *b}):
        left, right = a.get(key), b.get(key)
        if isinstance(left, Mapping) and isinstance(right, Mapping):
            names = sorted({*left, *right} - set(FREE if key == "settings" else ()))
            found += [f"{key}.{name}" for name in names if left.get(name) != right.get(name)]
        elif left != right:
            found.append(key)
    return found


class Parts:
    """Finished parts by name, kept in the `folder` of the report; None = in memory alone."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self.known: dict[str, Part] = {}
        self.seconds: dict[str, float] = {}
        if folder is not None and (folder / TIMING).is_file():
            self.seconds = dict(read_json(folder / TIMING).get("seconds", {}))

    def once(self, name: str, compute: Callable[[], Part]) -> Part:
        """The part of this name, computed and written unless it is there."""
        if name not in self.known:
            self.known[name] = self._read(name) or self._compute(name, compute)
        return self.known[name]

    def done(self, name: str) -> bool:
        """Whether `once` would compute nothing."""
        path = self._path(name)
        return name in self.known or (path is not None and path.is_file())

    def _path(self, name: str) -> Path | None:
        file = re.sub(r"[^\w.-]+", "-", name) + ".json"
        return None if self.folder is None else self.folder / "parts" / file

    def _read(self, name: str) -> Part | None:
        """A finished part whose files are still there."""
        path = self._path(name)
        if self.folder is None or path is None or not path.is_file():
            return None
        part = read_json(path)
        kept = [*part.get("samples", ()), *part.get("pictures", ())]
        files = [item[key] for item in kept for key in ("file", "sound") if key in item]
        return part if all(inside(self.folder, file).is_file() for file in files) else None

    def _compute(self, name: str, compute: Callable[[], Part]) -> Part:
        started = time.perf_counter()
        part = compute()
        self.seconds[name] = round(time.perf_counter() - started, 3)
        path = self._path(name)
        if path is not None and self.folder is not None:
            write_json(path, part)
            total = round(sum(self.seconds.values()), 1)
            write_json(self.folder / TIMING, {"seconds": self.seconds, "total": total})
        return part


def read_json(path: Path) -> dict[str, Any]:
    """An object of a report folder. Raises UserError: missing, or not whole."""
    try:
        return dict(load_json(path))
    except (OSError, ValueError, TypeError) as error:
        raise UserError(
            f"{path} cannot be read ({error}); delete it and run `evaluate` again with the same"
            " --out: only what is missing is measured"
        ) from error
