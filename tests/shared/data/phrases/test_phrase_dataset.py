"""MotionPhraseDataset on folders and memory: items, windows, batches, epochs."""

import io
import json
import pickle
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from torch.utils.data import DataLoader

from src.shared.data.phrases.dataset import MotionPhraseDataset, motion_statistics, sound_statistics
from src.shared.data.phrases.layout import (
    BadContent,
    decode_features,
    decode_trajectory,
    features_path,
    phase_rows,
    record_phrase,
    trajectory_path,
    write_body,
    write_manifest,
)
from src.shared.errors import UsageError, UserError
from tests.shared.data.phrases.phrase_samples import (
    flip_bit,
    make_features,
    make_trajectory,
    plain_encode,
    store_phrases,
)

LENGTHS = [40, 200, 120, 150, 90, 121, 300, 64, 160, 131]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    store_phrases(tmp_path / "data", LENGTHS)
    return tmp_path / "data"


def open_dataset(folder: Path | str, cache: Path, **settings: Any) -> MotionPhraseDataset:
    settings = {"encode": plain_encode, "max_bad_fraction": 0.3, "threads": 2} | settings
    return MotionPhraseDataset(folder, cache_dir=cache, **settings)


def test_items_have_the_documented_shapes(folder: Path, tmp_path: Path) -> None:
    data = open_dataset(folder, tmp_path / "cache")
    assert len(data) == len(LENGTHS) == len(list(data))
    assert torch.equal(data[-1][0], data[len(LENGTHS) - 1][0])
    motion, audio = data[0]
    assert motion.shape == (25, 120) and motion.dtype == torch.float32
    assert audio.shape == (167, 120) and audio.dtype == torch.float32
    item = data.item(0, 0)
    assert item is not None
    assert item.mask.sum() == 40
    assert not item.motion[:, 40:].any() and not item.audio[:, 40:].any()
    without = open_dataset(folder, tmp_path / "cache", beat_phase=False)
    torch.testing.assert_close(without[0][1], audio[:163])


def test_windows_are_whole_aligned_and_drawn_by_seed_draw_and_index(
    folder: Path, tmp_path: Path
) -> None:
    data = open_dataset(folder, tmp_path / "cache")
    starts = set()
    for draw in range(12):
        item = data.item(6, draw)
        assert item is not None
        first = round(float(item.motion[16, 0]) * 60)  # unwrapped, counted from its first frame
        starts.add(first)
        truth, sound = make_trajectory(300, 6), make_features(300, 6)
        np.testing.assert_array_equal(item.motion[:16], truth[first : first + 120, :16].T)
        np.testing.assert_array_equal(item.audio[:128], sound["mel"][:, first : first + 120])
        again = open_dataset(folder, tmp_path / "cache").item(6, draw)
        assert again is not None and torch.equal(again.motion, item.motion)
    assert len(starts) > 6


@given(st.integers(2, 7), st.integers(20, 300), st.floats(0.004, 0.1), st.floats(-5, 5))
def test_phase_rows_are_unit_circles_of_beat_and_bar(
    meter: int, frames: int, step: float, start: float
) -> None:
    phase = start + step * np.arange(frames)
    rows = phase_rows(phase, meter).astype(np.float64)
    bar = np.arctan2(rows[3], rows[2]) / (2 * np.pi)
    beat = np.arctan2(rows[1], rows[0]) / (2 * np.pi)
    for turn, truth in ((bar, phase), (beat, phase * meter)):
        error = (turn - truth + 0.5) % 1 - 0.5
        assert np.abs(error).max() < 1e-5


def test_the_house_encoding_is_the_default(folder: Path, tmp_path: Path) -> None:
    motion, _ = open_dataset(folder, tmp_path / "cache", encode=None)[3]
    np.testing.assert_allclose(motion[[0, 2], 0], 0, atol=1e-6)  # starts at the origin
    np.testing.assert_allclose(motion[16], 1 / 60, atol=1e-5)  # bars a frame


def test_tech_spelling_and_selection(folder: Path, tmp_path: Path) -> None:
    data = open_dataset(folder, tmp_path, num_phrases=3, target_frames=64, cache_in_memory=False)
    assert data.phrase_ids == ["p000", "p001", "p002"]
    assert data[1][0].shape == (25, 64)
    val = open_dataset(folder, tmp_path, split="val")
    assert val.phrase_ids == ["p004", "p009"]
    with pytest.raises(UserError, match=r"split test \(splits: train, val\)") as error:
        open_dataset(folder, tmp_path, split="test")
    assert "features.npz" not in str(error.value), "which is there"
    with pytest.raises(UsageError, match="gcs_bucket"):
        MotionPhraseDataset()
    with pytest.raises(UserError, match="audio_features/ID"):
        open_dataset(tmp_path / "nothing", tmp_path)
    with pytest.raises(UsageError, match="carrier-pigeon"):
        open_dataset("carrier-pigeon://x", tmp_path)


def test_without_a_manifest(tmp_path: Path) -> None:
    store_phrases(tmp_path / "data", LENGTHS, manifest=False, meter=0)
    data = open_dataset(tmp_path / "data", tmp_path / "cache")
    assert len(data) == len(LENGTHS) and data[0][1].shape == (163, 120)
    (tmp_path / "data" / trajectory_path("p001")).unlink()  # half a phrase is none
    assert "p001" not in open_dataset(tmp_path / "data", tmp_path / "cache").phrase_ids


def test_a_broken_manifest_says_where(folder: Path, tmp_path: Path) -> None:
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["phrases"][3]["motion"]["size"] = "big"
    (folder / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(UserError, match=r"phrases\.3\.motion\.size"):
        open_dataset(folder, tmp_path)


def test_epochs_visit_everything_once_and_go_on_where_they_stopped(
    folder: Path, tmp_path: Path
) -> None:
    data = open_dataset(folder, tmp_path / "cache")
    whole = [item.record.id for item in data.epoch(1)]
    assert sorted(whole) == data.phrase_ids
    assert whole != [item.record.id for item in data.epoch(2)]
    first = data.epoch(1)
    seen = [next(first).record.id for _ in range(4)]
    state = json.loads(json.dumps(first.state_dict()))
    later = open_dataset(folder, tmp_path / "cache").epoch()
    later.load_state_dict(state)
    assert seen + [item.record.id for item in later] == whole
    with pytest.raises(UserError, match="its seed was 0"):
        open_dataset(folder, tmp_path / "cache", seed=1).epoch().load_state_dict(state)
    with pytest.raises(UserError, match="its data was"):
        open_dataset(folder, tmp_path, num_phrases=2).epoch().load_state_dict(state)


def test_batches_are_a_function_of_the_step_and_cover_epochs(folder: Path, tmp_path: Path) -> None:
    data = open_dataset(folder, tmp_path / "cache")
    parts = [data.batch(step, 1, index=index, count=2) for step in range(1, 6) for index in (0, 1)]
    assert sorted(part.records[0].id for part in parts) == data.phrase_ids
    whole = [record.id for step in range(1, 6) for record in data.batch(step, 2).records]
    assert whole == [part.records[0].id for part in parts]
    again = open_dataset(folder, tmp_path / "other", threads=0).batch(3, 2)
    assert torch.equal(again.motion, data.batch(3, 2).motion)
    assert again.audio.shape == (2, 167, 120) and again.mask.shape == (2, 120)


@pytest.mark.parametrize("manifest", [True, False])
def test_what_is_bad_is_left_out_named_and_remembered(tmp_path: Path, manifest: bool) -> None:
    folder = tmp_path / "data"
    store_phrases(folder, LENGTHS, manifest=manifest)
    path = folder / trajectory_path("p002")
    path.write_bytes(path.read_bytes()[:-400])
    path = folder / features_path("p005")
    path.write_bytes(flip_bit(path.read_bytes()))  # the npz has a CRC
    data = open_dataset(folder, tmp_path / "cache")
    good = sorted({*data.phrase_ids} - {"p002", "p005"})
    assert sorted(item.record.id for item in data.epoch()) == good
    assert set(data.report()["bad"]) == {"p002", "p005"}
    assert "motion/p002/trajectory.npy" in data.report()["bad"]["p002"]
    later = open_dataset(folder, tmp_path / "cache")
    assert set(later.quarantine.reasons) == {"p002", "p005"}
    with pytest.raises(UserError, match=r"2 of 10 phrases .* bad, max-bad-fraction is 0.1: p002: "):
        open_dataset(folder, tmp_path / "cache", max_bad_fraction=0.1)
    with pytest.raises(BadContent, match="p005"):
        data[5]
    loaded = [motion for motion, _ in DataLoader(data, batch_size=3)]
    assert sum(len(motion) for motion in loaded) == 8
    assert all(len(data.batch(step, 1).records) == 1 for step in range(1, 11))


def test_a_mended_phrase_leaves_quarantine(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    store_phrases(folder, LENGTHS)
    path = folder / trajectory_path("p002")
    whole = path.read_bytes()
    path.write_bytes(flip_bit(whole))
    data = open_dataset(folder, tmp_path / "cache")
    list(data.epoch())
    assert "overwritten or damaged" in data.quarantine.reasons["p002"]
    store_phrases(folder, [*LENGTHS[:2], 122, *LENGTHS[3:]])
    later = open_dataset(folder, tmp_path / "cache")
    assert len(list(later.epoch())) == len(LENGTHS)


def test_no_more_than_the_allowed_fraction(folder: Path, tmp_path: Path) -> None:
    for number in range(7):
        (folder / features_path(f"p{number:03d}")).unlink()
    data = open_dataset(folder, tmp_path / "cache")
    with pytest.raises(UserError, match=r"max-bad-fraction is 0.3: p00\d: .*is missing"):
        list(data.epoch())


def test_workers_and_pickles(folder: Path, tmp_path: Path) -> None:
    data = pickle.loads(pickle.dumps(open_dataset(folder, tmp_path / "cache")))
    loader = DataLoader(data, batch_size=5, num_workers=1)
    assert sum(len(motion) for motion, _ in loader) == len(LENGTHS)


def test_statistics_are_those_of_real_frames(folder: Path, tmp_path: Path) -> None:
    data = open_dataset(folder, tmp_path / "cache", target_frames=300)
    everything = np.concatenate([make_trajectory(n, i) for i, n in enumerate(LENGTHS)])
    mean, std = motion_statistics(data)
    columns = [*range(16), *range(17, 25)]
    np.testing.assert_allclose(mean[columns], everything.mean(0)[columns], atol=1e-4)
    np.testing.assert_allclose(std[columns], everything.std(0)[columns], atol=1e-4)
    heard = np.concatenate([data.item(i, 0).audio[:163, :n] for i, n in enumerate(LENGTHS)], 1)
    mean, std = sound_statistics(data)
    np.testing.assert_allclose(mean, heard.mean(1), atol=1e-4)
    np.testing.assert_allclose(std, heard.std(1), atol=1e-4)


def test_bodies_are_read_where_they_are(folder: Path, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    with pytest.raises(UserError, match=r"trajectories without bodies.*run prepare-audio"):
        open_dataset(folder, cache, bodies=True)
    assert open_dataset(folder, cache).item(0, 0).body is None
    bodies = [np.random.default_rng(n).normal(size=(n, 23, 6)) for n in LENGTHS]
    records = store_phrases(tmp_path / "with", LENGTHS)
    for record, body in zip(records, bodies, strict=True):
        write_body(tmp_path / "with", record.id, body)
    records = [record_phrase(tmp_path / "with", record.id) for record in records]
    write_manifest(tmp_path / "with", records)
    data = open_dataset(tmp_path / "with", cache, bodies=True, target_frames=100)
    batch = data.batch(1, len(LENGTHS))
    assert batch.body is not None and batch.body.shape == (len(LENGTHS), 100, 23, 6)
    for index, body in enumerate(bodies):
        item = data.item(index, 0)
        start = round(float(item.motion[16, 0]) * 60)  # plain_encode keeps the phase
        shown = torch.from_numpy(body[start : start + 100]).float()
        assert torch.allclose(item.body[item.mask], shown, atol=2e-3)
    assert data.fingerprint != open_dataset(folder, cache).fingerprint


def test_a_short_body_is_bad(tmp_path: Path) -> None:
    [record] = store_phrases(tmp_path, [60])
    for body, reason in ((np.zeros((59, 23, 6)), "59 frames"), (np.zeros((60, 22, 6)), "T, 23, 6")):
        stored = write_body(tmp_path, record.id, body)
        write_manifest(tmp_path, [record.model_copy(update={"body": stored})])
        with pytest.raises(UserError, match=reason):
            open_dataset(tmp_path, tmp_path / "cache", bodies=True).item(0, 0)


def _saved(values: np.ndarray, tmp_path: Path) -> bytes:
    np.save(tmp_path / "x.npy", values)
    return (tmp_path / "x.npy").read_bytes()


def test_reasons_for_bad_content(tmp_path: Path) -> None:
    good = make_trajectory(30)
    bad = good.copy()
    bad[3, 0] = np.nan
    with pytest.raises(BadContent, match="not finite"):
        decode_trajectory(_saved(bad, tmp_path))
    bad[3, 0] = 1e30
    with pytest.raises(BadContent, match="a value of 1e\\+30"):
        decode_trajectory(_saved(bad, tmp_path))
    bad[3, 0], bad[4, 9:13] = 0, 0.1
    with pytest.raises(BadContent, match="quaternion"):
        decode_trajectory(_saved(bad, tmp_path))
    with pytest.raises(BadContent, match="25"):
        decode_trajectory(_saved(good.T, tmp_path))
    with pytest.raises(BadContent, match="npy"):
        decode_trajectory(_saved(good, tmp_path)[:-7])
    with pytest.raises(BadContent, match="npy"):
        decode_trajectory(b"")
    with pytest.raises(BadContent, match="npz"):
        decode_features(b"PK\x03\x04 not really")
    odd = {"mel": np.zeros((127, 30)), "rms": np.zeros(29), "phase": [0.0]}
    for name, value in odd.items():
        np.savez(tmp_path / "x.npz", **make_features(30) | {name: value})
        with pytest.raises(BadContent, match=name):
            decode_features((tmp_path / "x.npz").read_bytes())


@given(st.integers(0, 40), st.integers(0, 40))
def test_lengths_may_differ_by_a_second(motion: int, sound: int) -> None:
    from src.shared.data.phrases.layout import SoundContent, common_length

    content = SoundContent(np.zeros((163, sound), np.float32), None, 0)
    if min(motion, sound) < 8 or abs(motion - sound) > 30:
        with pytest.raises(BadContent):
            common_length(make_trajectory(motion), content)
    else:
        assert common_length(make_trajectory(motion), content) == min(motion, sound)


@given(st.data())
def test_no_flipped_bit_crashes_the_readers(data: st.DataObject) -> None:
    stream = io.BytesIO()
    motion = data.draw(st.booleans())
    if motion:
        np.save(stream, make_trajectory(9))
    else:
        np.savez_compressed(stream, **make_features(9))
    content = bytearray(stream.getvalue())
    place = data.draw(st.integers(0, len(content) * 8 - 1) | st.integers(0, 1023))
    content[place // 8] ^= 1 << place % 8
    decode: Any = decode_trajectory if motion else decode_features
    with suppress(BadContent):
        found = decode(bytes(content))
        values = found if motion else found.stacked
        assert np.isfinite(values).all() and values.shape == ((9, 25) if motion else (163, 9))


def test_sounds_with_and_without_a_beat_share_batches(tmp_path: Path) -> None:
    store_phrases(tmp_path / "data", [90] * 4, meter=0, manifest=False)
    store_phrases(tmp_path / "data", [90] * 2)
    (tmp_path / "data" / "manifest.json").unlink()
    data = open_dataset(tmp_path / "data", tmp_path)
    assert data[1][1].shape == (167, 120) and data[2][1].shape == (163, 120)
    batch = data.batch(1, 4)
    for item, record in zip(batch.audio, batch.records, strict=True):
        assert bool(item[163:].any()) == (record.id < "p002")
