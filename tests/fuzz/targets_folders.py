"""Readers of folders: prepared data, models, memories, objects of training; and of sounds."""

import json
from pathlib import Path

import numpy as np

from src.shared.errors import UserError
from src.shared.io.files import sha256_file
from tests.fuzz.target import FRAMES, Target, check_arrays, some_motion

SOUND_ROWS: dict[str, tuple[int, ...]] = {
    "mel": (128,),
    "chroma": (12,),
    "mfcc": (20,),
    "rms": (),
    "spectral_centroid": (),
    "onset_strength": (),
}


def _write_prepared(folder: Path) -> None:
    from src.shared.data.prepare import prepare
    from src.shared.data.sources import SyntheticSource

    prepare([SyntheticSource(8)], folder)


def _mend_prepared(path: Path) -> None:
    """Let the manifest vouch for the damaged file."""
    manifest = _folder_of(path, "manifest.json") / "manifest.json"
    if path == manifest:
        return
    content = json.loads(manifest.read_bytes())
    name = path.relative_to(manifest.parent).as_posix()
    if name in content["files"]:
        content["files"][name] = sha256_file(path)
        manifest.write_text(json.dumps(content))


def _folder_of(path: Path, marker: str) -> Path:
    return next(folder for folder in path.parents if (folder / marker).exists())


def _read_prepared(path: Path) -> None:
    from src.shared.data.prepared import PreparedData

    data = PreparedData.open(_folder_of(path, "manifest.json"))
    for record in data.records():
        check_arrays([data.features(record)])
        data.captions(record)
    data.all_captions("train")


def _write_model(folder: Path) -> None:
    import torch

    from src.shared.model.checkpoint import ModelCard, write_checkpoint

    torch.manual_seed(0)
    card = ModelCard(kind="motion-generator", name="tiny", trained=True, tags=("walk", "run"))
    tensors = {"a.weight": torch.randn(4, 8), "a.bias": torch.randn(4), "b.weight": torch.ones(1)}
    write_checkpoint(folder, card, tensors)


def _mend_model(path: Path) -> None:
    card = path.parent / "config.json"
    if path == card:
        return
    content = json.loads(card.read_bytes())
    content["weights"] |= {"sha256": sha256_file(path), "bytes": path.stat().st_size}
    card.write_text(json.dumps(content))


def _read_model(path: Path) -> None:
    import torch

    from src.shared.model.checkpoint import load_state, read_card, read_tensors

    tensors = read_tensors(path.parent, read_card(path.parent))
    module = torch.nn.Linear(8, 4)
    load_state(module, tensors, "a", path.parent)
    check_arrays(module.state_dict().values())


def _write_memory(folder: Path) -> None:
    import torch

    from src.shared.memory.index import MemoryIndex

    torch.manual_seed(0)
    keys = torch.nn.functional.normalize(torch.randn(4, 8), dim=-1)
    index = MemoryIndex(
        audio_keys=keys,
        motion_keys=keys.clone(),
        start_phase=torch.zeros(4),
        tempo=torch.full((4,), 100.0),
        song=torch.tensor([0, 0, 1, 1]),
        offsets=torch.arange(5) * 10,
        trajectories=torch.randn(40, 25).half(),
        priors=torch.randn(40, 4).half(),
        songs=("one", "two"),
        ids=tuple("abcd"),
        captions=("walks",) * 4,
        clips=(("c",),) * 4,
        about={"space": "starter-space"},
    )
    index.save(folder)


def _mend_memory(path: Path) -> None:
    manifest = path.parent / "manifest.json"
    if path == manifest:
        return
    content = json.loads(manifest.read_bytes())
    content["files"][path.name] = {"sha256": sha256_file(path), "bytes": path.stat().st_size}
    manifest.write_text(json.dumps(content))


def _read_memory(path: Path) -> None:
    from src.shared.memory.index import MemoryIndex

    MemoryIndex.open(path.parent)


def _write_objects(folder: Path) -> None:
    """The objects of one training phrase."""
    from src.shared.motion.trajectory import from_motion

    np.save(folder / "trajectory.npy", from_motion(some_motion()).data)
    body = np.zeros((FRAMES, 23, 6), np.float16)
    np.savez(folder / "body.npz", features=body)
    rng = np.random.default_rng(0)
    arrays = {n: rng.random((*rows, FRAMES)).astype(np.float32) for n, rows in SOUND_ROWS.items()}
    np.savez(folder / "features.npz", phase=np.arange(FRAMES) / 60, meter=np.int64(4), **arrays)


def _read_object(path: Path) -> None:
    from src.shared.data.phrases.layout import decode_body, decode_features, decode_trajectory

    data = path.read_bytes()
    match path.name:
        case "trajectory.npy":
            check_arrays([decode_trajectory(data)])
        case "body.npz":
            check_arrays([decode_body(data)])
        case _:
            check_arrays([decode_features(data).stacked])


def _write_sounds(folder: Path) -> None:
    import soundfile

    rng = np.random.default_rng(0)
    samples = (0.3 * np.sin(np.arange(8000) / 20) + 0.01 * rng.standard_normal(8000)).astype("f4")
    for name, subtype in (
        ("a.wav", "PCM_16"),
        ("b.wav", "FLOAT"),
        ("c.wav", "MS_ADPCM"),
        ("d.flac", "PCM_16"),
        ("e.ogg", "VORBIS"),
        ("f.mp3", "MPEG_LAYER_III"),
    ):
        soundfile.write(folder / name, samples, 16_000, subtype=subtype)


def _read_sound(path: Path) -> None:
    from src.shared.io.sound_files import SoundReader

    reader = SoundReader(path)
    for block in reader.blocks(1 << 16):
        check_arrays([block])
    list(reader.notes())


def _bad_content() -> tuple[type[Exception], ...]:
    from src.shared.data.phrases.layout import BadContent

    return (UserError, BadContent)


FOLDER_TARGETS = {
    "prepared": Target(_write_prepared, _read_prepared, mend=_mend_prepared),
    "model": Target(_write_model, _read_model, mend=_mend_model),
    "memory": Target(_write_memory, _read_memory, mend=_mend_memory),
    "objects": Target(_write_objects, _read_object, refusals=_bad_content()),
    "sound": Target(_write_sounds, _read_sound),
}
