"""manifest.json of a report: hashes and settings of everything that decides the figures.

Two reports may be compared, and a stopped one continued, if their manifests agree.
"""

import hashlib
import platform
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
import torch

from ..errors import UsageError
from ..files import sha256_file, write_json
from .families import MetricFamily
from .parts import read_json

MANIFEST = "manifest.json"
FORMAT_VERSION = 1
PACKAGES = ("motionsuite", "torch", "numpy", "scipy", "librosa", "transformers", "safetensors")
FREE = ("replications",)  # settings that may differ: more replications go on from fewer


def build(
    branch: str,
    *,
    model: Mapping[str, Any],
    evaluator: Mapping[str, Any],
    data: Mapping[str, Any],
    statistics: Iterable[torch.Tensor],
    settings: Mapping[str, Any],
    sampling: Mapping[str, Any],
    families: Sequence[MetricFamily[Any]],
    device: str,
) -> dict[str, Any]:
    """Everything by name.

    Args:
        branch: text or audio.
        model, evaluator: hashes of their files, see `folder_hashes`.
        data: what was measured on: manifest hash, ids of the splits.
        statistics: mean and deviation tensors in use.
        settings: amounts and seeds.
        sampling: what differs from the model's own settings.
        families: whose columns the tables hold.
    """
    return {
        "format-version": FORMAT_VERSION,
        "branch": branch,
        "model": dict(model),
        "evaluator": dict(evaluator),
        "data": dict(data),
        "statistics": hash_arrays(tensor.detach().cpu().numpy() for tensor in statistics),
        "settings": {key: _listed(value) for key, value in settings.items()},
        "sampling": {key: value for key, value in sampling.items() if value is not None},
        "metrics": {family.name: [column.key for column in family.columns] for family in families},
        "environment": {
            "python": platform.python_version(),
            "machine": platform.machine(),
            "device": device,
            "threads": torch.get_num_threads(),
            "packages": {name: _version(name) for name in PACKAGES},
        },
    }


def _listed(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def folder_hashes(folder: Path) -> dict[str, str]:
    """SHA-256 of a model folder's cards, weights and statistics by file name."""
    files = sorted([*folder.glob("*.json"), *folder.glob("*.safetensors")])
    return {path.name: sha256_file(path) for path in files}


def hash_arrays(arrays: Iterable[np.ndarray]) -> str:
    """SHA-256 of arrays' bytes, in order."""
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def hash_names(names: Iterable[str]) -> str:
    """SHA-256 of a list of names: the clips of a split, the prompts of a sample."""
    return hashlib.sha256("\n".join(names).encode()).hexdigest()


def claim(folder: Path, manifest: dict[str, Any]) -> None:
    """Take a folder for a report, or go on in it.

    Raises:
        UsageError: it holds a report of something else.
    """
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
