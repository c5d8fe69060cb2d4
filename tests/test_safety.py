"""No file that is read runs code, leaves its folder or fills the memory: rules and attempts."""

import ast
import io
import json
import pickle
import struct
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.config_loader import parse_yaml
from src.shared.data.phrases.layout import StoredObject
from src.shared.data.prepared import VERSION, PreparedData
from src.shared.data.retarget.read_motion import read_motion
from src.shared.errors import UsageError, UserError
from src.shared.evaluation.pages import _pictures
from src.shared.io.arrays import BadArray, load_array, load_arrays
from src.shared.io.files import inside, load_json
from src.shared.model.checkpoint import ModelCard, read_card, read_tensors, write_checkpoint

SOURCE = Path(__file__).parents[1] / "src"
# Run code, or load what runs code; processes are started by two modules: one runs this program, the
# other the user's Blender, with a script of ours and a file's name after it (test_blender.py).
BANNED_MODULES = {
    "pickle", "cPickle", "_pickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "tarfile",
    "subprocess", "pty", "code", "codeop", "runpy", "xml", "ctypes",
}  # fmt: skip
STARTS = [("shared/formats/blender.py", "subprocess"), ("train/processes.py", "subprocess")]
BANNED_CALLS = {
    "eval", "exec", "compile", "__import__", "torch.load", "torch.save", "torch.jit.load",
    "np.load",
    "np.fromfile", "np.memmap", "numpy.load", "os.system", "os.popen", "os.execv", "os.startfile",
    "yaml.unsafe_load", "yaml.full_load", "yaml.load_all", "shutil.unpack_archive",
}  # fmt: skip
BANNED_METHODS = {"extract", "extractall"}
# Only here, where the limits are.
ONLY_IN: dict[str, tuple[str, ...]] = {
    "yaml.load": ("shared/config_loader.py",),
    "zipfile.ZipFile": ("shared/io/arrays.py",),
    "json.load": (),
    # a GLB's chunk is bounded before; what a training wrote for itself is its own
    "json.loads": ("shared/io/files.py", "shared/formats/readers/glb.py", "train/"),
    "faiss.read_index": ("shared/memory/index.py",),  # after its checksum
}


def calls() -> Iterator[tuple[str, ast.Call, str]]:
    """(file below src, call, dotted name) of every call."""
    for path in sorted(SOURCE.rglob("*.py")):
        where = path.relative_to(SOURCE).as_posix()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call):
                yield where, node, ast.unparse(node.func)


def imported() -> Iterator[tuple[str, str]]:
    """(file below src, top-level module) of every import."""
    for path in sorted(SOURCE.rglob("*.py")):
        where = path.relative_to(SOURCE).as_posix()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from ((where, alias.name.partition(".")[0]) for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and not node.level:
                yield where, (node.module or "").partition(".")[0]


# ---------------------------------------------------------------- what the source may do


def test_nothing_that_runs_code_is_imported() -> None:
    assert [pair for pair in imported() if pair[1] in BANNED_MODULES] == STARTS


def test_nothing_that_runs_code_is_called() -> None:
    found = []
    for where, node, name in calls():
        allowed = ONLY_IN.get(name)
        if name in BANNED_CALLS or name.rpartition(".")[2] in BANNED_METHODS:
            found.append(f"{where}:{node.lineno} {name}")
        if allowed is not None and not where.startswith(allowed or ("-",)):
            found.append(f"{where}:{node.lineno} {name}: only in {allowed}")
        for word in node.keywords:
            value = ast.unparse(word.value)
            if word.arg in ("shell", "trust_remote_code", "allow_pickle") and value != "False":
                found.append(f"{where}:{node.lineno} {word.arg}={value}")
    assert not found


def test_yaml_is_read_by_the_safe_loader_alone() -> None:
    import yaml

    from src.shared import config_loader

    loads = [node for _, node, name in calls() if name == "yaml.load"]
    assert [ast.unparse(word.value) for node in loads for word in node.keywords] == ["_Loader"]
    assert issubclass(config_loader._Loader, (yaml.SafeLoader, yaml.CSafeLoader))


def test_only_our_own_modules_are_imported_by_name() -> None:
    for where, node, name in calls():
        if name.rpartition(".")[2] == "import_module":
            assert ast.unparse(node.args[0]).startswith(("f'src.", "'src.", "f'.")), where


def test_foreign_models_bring_neither_code_nor_pickles() -> None:
    found = 0
    for where, node, name in calls():
        if name.startswith("Auto") and name.endswith(".from_pretrained"):
            words = {word.arg: ast.unparse(word.value) for word in node.keywords}
            assert words.get("trust_remote_code") == "False", where
            assert name != "AutoModel.from_pretrained" or words["use_safetensors"] == "True", where
            found += 1
    assert found >= 2


# ---------------------------------------------------------------- attempts


class Bomb:
    """Leaves a mark when it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self) -> tuple[Callable[..., object], tuple[object, ...]]:
        return Path.touch, (self.mark,)


def test_pickles_are_refused_wherever_they_hide(tmp_path: Path) -> None:
    mark = tmp_path / "ran"
    payload = np.array([Bomb(mark), 1], object)
    np.savez(tmp_path / "motion.npz", poses=payload, trans=np.zeros((2, 3)))
    np.savez(tmp_path / "ours.npz", format_version=payload, quaternions=payload, fps=payload)
    np.save(tmp_path / "joints.npy", payload)
    (tmp_path / "plain.npy").write_bytes(pickle.dumps(Bomb(mark)))
    (tmp_path / "plain.npz").write_bytes(pickle.dumps(Bomb(mark)))
    for name in ("motion.npz", "ours.npz", "joints.npy", "plain.npy", "plain.npz"):
        with pytest.raises(UserError, match=name.replace(".", r"\.")):
            read_motion(tmp_path / name)
    card = write_checkpoint(tmp_path / "model", ModelCard(kind="x"), {"a": torch.zeros(2)})
    weights = tmp_path / "model/model.safetensors"
    torch.save({"a": Bomb(mark)}, weights)
    content = json.loads((tmp_path / "model/config.json").read_text())
    from src.shared.io.files import sha256_file

    content["weights"] |= {"sha256": sha256_file(weights), "bytes": weights.stat().st_size}
    (tmp_path / "model/config.json").write_text(json.dumps(content))
    assert card.weights is not None
    with pytest.raises(UserError, match="safetensors"):
        read_tensors(tmp_path / "model", read_card(tmp_path / "model"))
    assert not mark.exists()


@pytest.mark.parametrize(
    "text",
    [
        "!!python/object/apply:pathlib.Path.touch [ran]",
        "a: !!python/name:os.system",
        "a: &a [*a]",
        "[" * 300_000,
        "a: " + "9" * 5000,
        "a0: &a0 [x, x]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]\n" for i in range(1, 40)),
    ],
    ids=["object", "name", "itself", "deep", "long", "doubling"],
)
def test_yaml_cannot_call_grow_or_overflow(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UsageError, match=r"file\.yaml"):
        parse_yaml(text, "file.yaml")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("text", ["[" * 300_000, '{"a":' * 300_000, "9" * 5000, "\xff", "{"])
def test_json_is_a_value_or_a_value_error(text: str, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(ValueError):
        load_json(path)
    path.write_text("[1, 2, 3]")
    assert load_json(path) == [1, 2, 3]
    with pytest.raises(ValueError, match="larger"):
        load_json(path, max_bytes=4)


def test_an_array_may_not_claim_more_than_it_holds() -> None:
    header = repr({"descr": "<f8", "fortran_order": False, "shape": (10**12,)}).ljust(117) + "\n"
    lie = b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header.encode()
    with pytest.raises(BadArray, match="numbers"):
        load_array(lie)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("x.npy", lie + bytes(1 << 24))  # packs to a thousandth
        archive.writestr("../../escaped.npy", lie)
    with pytest.raises(BadArray):
        load_arrays(stream.getvalue(), ["x"])
    assert load_arrays(stream.getvalue(), ["y"]) == {}, "what is not asked for is not unpacked"


def test_names_in_a_folder_stay_in_it(tmp_path: Path) -> None:
    folder, secret = tmp_path / "report", tmp_path / "secret.png"
    folder.mkdir()
    secret.write_bytes(b"secret")
    for name in ("../secret.png", str(secret), "a/../../secret.png"):
        with pytest.raises(UserError, match="leads out"):
            inside(folder, name)
        with pytest.raises(UserError, match="leads out"):
            _pictures([{"file": name, "title": "t"}], folder)
        with pytest.raises(ValueError, match="leads out"):
            StoredObject(path=name, size=1)
    (folder / "link.png").symlink_to(secret)
    with pytest.raises(UserError, match="leads out"):
        inside(folder, "link.png")
    manifest = {"version": VERSION, "tags": [], "files": {"../secret.png": "0"}}
    (folder / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(UserError, match="leads out"):
        PreparedData.open(folder)
