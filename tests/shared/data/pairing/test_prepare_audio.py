"""`prepare_audio` end to end on made walks and synthetic songs: layout, splits, resuming."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.pairing.clip_library import open_library, speed_threshold
from src.shared.data.pairing.music import FolderMusic, SyntheticMusic, open_music
from src.shared.data.pairing.phrase_motion import Piece, Warp, join, resample
from src.shared.data.pairing.prepare_audio import (
    WINDOW_FRAMES,
    PairOptions,
    prepare_audio,
    training_trajectories,
)
from src.shared.data.phrases.layout import decode_features, decode_trajectory, parse_manifest
from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import RawClip
from src.shared.errors import UsageError, UserError
from src.shared.io.files import sha256_file
from src.shared.motion.motion import Motion
from tests.files import files_of

OPTIONS = PairOptions(min_seconds=4.0, max_seconds=7.0)
MUSIC = SyntheticMusic(4, seed=3, seconds=12.0)


@dataclass(frozen=True)
class Walks:
    """Straight walks of every tempo, and people who stand."""

    number: int = 120
    name: str = "walks"

    def items(self) -> list[str]:
        return [f"walk-{n:03d}" for n in range(self.number)] + ["stand-0", "stand-1"]

    def fingerprint(self, item: str) -> str:
        return item

    def read(self, item: str) -> RawClip:
        kind, _, number = item.partition("-")
        t = np.arange(150) / 30
        period = 0.33 * 3 ** (int(number) / max(self.number, 1))  # 0.33 to 1 s
        z = 1.2 * t + 0.05 * np.sin(2 * np.pi * t / period) * (kind == "walk")
        position = np.stack((0 * t, 0 * t + 0.95, z * (kind == "walk")), 1).astype(np.float32)
        quaternions = np.zeros((150, 22, 4), dtype=np.float32)
        quaternions[..., 0] = 1
        motion = Motion(quaternions, position, np.ones((150, 2), dtype=np.float32))
        return RawClip(item, item, motion, {"action": kind}, {})


@pytest.fixture(scope="module")
def walks(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    out = tmp_path_factory.mktemp("walks")
    prepare([Walks()], out, mirror=False, workers=1)
    return PreparedData.open(out)


@pytest.fixture(scope="module")
def made(walks: PreparedData, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Any]:
    out = tmp_path_factory.mktemp("pairs")
    return out, prepare_audio(walks, [MUSIC], out, options=OPTIONS)


def test_the_layout_is_what_the_phrase_set_reads(made: tuple[Path, Any]) -> None:
    out, report = made
    phrases = list(parse_manifest([(out / "manifest.json").read_bytes()], "here"))
    assert len(phrases) == report["phrases"] >= 5
    for phrase in phrases:
        trajectory = decode_trajectory((out / phrase.motion.path).read_bytes())
        sound = decode_features((out / phrase.features.path).read_bytes())
        assert sound.stacked.shape == (163, len(trajectory)) and sound.meter in (2, 3, 4)
        assert sound.phase is not None
        wrapped = (trajectory[:, 16] - sound.phase + 0.5) % 1 - 0.5
        assert np.abs(wrapped).max() < 1e-5
        assert 4.0 <= len(trajectory) / 30 <= 7.1
        assert np.allclose(np.linalg.norm(trajectory[:, 17:], axis=1), 1, atol=1e-5)
        with np.load(out / phrase.features.path) as file:
            assert file["mel"].dtype == np.float16
            beats = file["beat_times"]
            at_beats = np.interp(beats, np.arange(len(sound.phase)) / 30, sound.phase)
            assert np.abs(at_beats * sound.meter - np.rint(at_beats * sound.meter)).max() < 0.1
            assert set(file["downbeat_times"]) <= set(beats)


def test_alignment_rises_far_above_chance(made: tuple[Path, Any]) -> None:
    _, report = made
    rows = report["alignment"]["all"]
    assert rows["after"]["motion_to_music"] > 0.8
    assert rows["after"]["motion_to_music"] > rows["chance"]["motion_to_music"] + 0.3
    assert rows["after"]["motion_to_music"] > rows["before"]["motion_to_music"] + 0.3
    rates = report["warp"]["rate_percentiles"]
    assert rates["p5"] >= 0.85 and rates["p95"] <= 1.15
    assert sum(report["warp"]["share"]) == pytest.approx(1, abs=0.01)
    assert report["clips"]["left_out"]["the pelvis hardly moves"] == 2


def test_a_cluster_does_not_change_the_result(
    made: tuple[Path, Any], walks: PreparedData, tmp_path: Path, scheduler: str
) -> None:
    prepare_audio(walks, [MUSIC], tmp_path, options=OPTIONS, scheduler=scheduler)
    assert files_of(tmp_path) == files_of(made[0])


def test_songs_and_clips_of_a_split_are_unseen_elsewhere(made: tuple[Path, Any]) -> None:
    out, report = made
    phrases = json.loads((out / "manifest.json").read_text())["phrases"]
    songs: dict[str, set[str]] = {}
    clips: dict[str, set[str]] = {}
    for phrase in phrases:
        songs.setdefault(phrase["song"], set()).add(phrase["split"])
        for piece in phrase["pair"]["pieces"]:
            clips.setdefault(piece["clip"], set()).add(phrase["split"])
    assert all(len(found) == 1 for found in (*songs.values(), *clips.values()))
    assert {"train", "val"} <= set(report["by_split"])


def test_the_manifest_rebuilds_a_phrase(made: tuple[Path, Any], walks: PreparedData) -> None:
    """Which frames of which clips, in which order, at which rate: what a later body needs."""
    out, _ = made
    clips = {clip.id: clip for clip in open_library(walks).clips}
    for phrase in json.loads((out / "manifest.json").read_text())["phrases"]:
        pair = phrase["pair"]
        pieces = [Piece(**piece) for piece in pair["pieces"]]
        motion = join(pieces, lambda name: (clips[name].root, clips[name].tilt))
        times = Warp(pair["warp"]["start"], tuple(pair["warp"]["rates"])).times(
            np.arange(pair["frames"]) / 30
        )
        position, quaternion = resample(motion.position, motion.quaternion, times)
        trajectory = np.load(out / phrase["motion"]["path"])
        assert np.allclose(trajectory[:, :3], position, atol=1e-5)
        assert np.allclose(trajectory[:, 9:13], quaternion, atol=1e-5)


def test_few_clips_and_songs_are_all_for_training(tmp_path: Path) -> None:
    """None is lost to a split that the others cannot fill."""
    prepare([Walks(7)], tmp_path / "motion", mirror=False, workers=1)
    data = PreparedData.open(tmp_path / "motion")
    assert {clip.split for clip in open_library(data).clips} == {"train"}
    assert {split for split, _ in MUSIC.specs()} == {"train", "val", "test"}
    report = prepare_audio(data, [MUSIC], tmp_path / "out", options=OPTIONS)
    assert set(report["by_split"]) == {"train"}
    assert report["songs"] == 4


def test_songs_are_held_back_from_ten_on(tmp_path: Path) -> None:
    for number in range(9):
        (tmp_path / f"{number}.wav").write_bytes(bytes([number]))
    assert {entry.split for entry in FolderMusic(tmp_path).entries()} == {"train"}
    (tmp_path / "9.wav").write_bytes(b"9")
    assert {entry.split for entry in FolderMusic(tmp_path).entries()} == {"train", "val", "test"}


def test_statistics_are_of_the_training_windows(made: tuple[Path, Any]) -> None:
    out, _ = made
    statistics = json.loads((out / "statistics.json").read_text())
    assert len(statistics["mean"]) == len(statistics["std"]) == 25
    assert min(statistics["std"]) > 0 and statistics["window_frames"] == WINDOW_FRAMES
    assert 0.5 < statistics["mean"][5] < 2.0, "walks go forward, +Z, in every window"
    assert 0.005 < statistics["mean"][16] < 0.05, "bars a frame"
    assert len(list(training_trajectories(out))) == statistics["phrases"]


def tree(out: Path) -> dict[str, str]:
    return {
        path.relative_to(out).as_posix(): sha256_file(path)
        for path in sorted(out.rglob("*"))
        if path.is_file()
    }


def test_a_second_run_changes_and_reads_nothing(
    made: tuple[Path, Any], walks: PreparedData, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, report = made
    before = tree(out)
    monkeypatch.setattr(SyntheticMusic, "read", lambda *_: pytest.fail("a song was read again"))
    assert prepare_audio(walks, [MUSIC], out, options=OPTIONS) == report
    assert tree(out) == before


def test_damage_and_loss_are_mended_to_the_same_bytes(
    made: tuple[Path, Any], walks: PreparedData
) -> None:
    out, _ = made
    before = tree(out)
    trajectories = sorted(out.glob("motion/*/trajectory.npy"))
    trajectories[0].write_bytes(b"broken")
    trajectories[-1].unlink()
    (out / "manifest.json").unlink()
    prepare_audio(walks, [MUSIC], out, options=OPTIONS)
    assert tree(out) == before


def test_two_processes_make_the_same(
    made: tuple[Path, Any], walks: PreparedData, tmp_path: Path
) -> None:
    out, report = made
    seen: list[tuple[int, int]] = []
    again = prepare_audio(
        walks,
        [MUSIC],
        tmp_path,
        options=OPTIONS,
        workers=2,
        progress=lambda done, total: seen.append((done, total)),
    )
    assert again == report and tree(tmp_path) == tree(out)
    assert seen == [(done, 4) for done in range(5)]


def test_fewer_songs_remove_what_is_stale(walks: PreparedData, tmp_path: Path) -> None:
    both = [MUSIC, SyntheticMusic(1, seed=8, seconds=9.0)]
    both.append(both[1])  # the same song twice
    prepare_audio(walks, both, tmp_path, options=OPTIONS)
    report = prepare_audio(walks, both[1:2], tmp_path, options=OPTIONS)
    assert len(list((tmp_path / "motion").iterdir())) == report["phrases"]
    assert len(list((tmp_path / "songs").iterdir())) == 1


def test_short_songs_are_named(walks: PreparedData, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"no phrase could be made of 1 songs.*4 are needed"):
        prepare_audio(walks, [SyntheticMusic(1, seconds=2.0)], tmp_path, options=OPTIONS)


def test_people_who_stand_are_no_material(tmp_path: Path) -> None:
    prepare([Walks(0)], tmp_path / "motion", mirror=False, workers=1)
    data = PreparedData.open(tmp_path / "motion")
    with pytest.raises(UserError, match="2: the pelvis hardly moves"):
        prepare_audio(data, [MUSIC], tmp_path / "out", options=OPTIONS)
    assert open_library(data).clips == ()


def test_the_threshold_parts_two_heaps() -> None:
    rng = np.random.default_rng(0)
    standing, walking = rng.lognormal(-3.5, 0.4, 300), rng.lognormal(0.1, 0.3, 200)
    found = speed_threshold([*standing, *walking])
    assert np.quantile(standing, 0.99) < found < np.quantile(walking, 0.01)
    assert speed_threshold([0.01, 1.0]) == 0.15


def test_synthetic_test_songs_have_tempi_of_their_own() -> None:
    entries = SyntheticMusic(40).entries()
    assert len({entry.id for entry in entries}) == 40
    splits = [entry.split for entry in entries]
    assert splits.count("test") == 4 and splits.count("val") == 3
    music = SyntheticMusic(40, seconds=2.0)
    bands = {"test": {7, 9, 11, 13, 15, 17}, "train": {6, 8, 10, 12, 14, 16}}
    for split, spec in music.specs():
        tempi = [spec.tempo] if isinstance(spec.tempo, float) else [t for _, t in spec.tempo]
        assert {int(tempo) // 10 for tempo in tempi} <= bands["train" if split == "val" else split]


@pytest.mark.parametrize("name", ["synthetic", "synthetic:0", "synthetic:x", "nowhere"])
def test_music_that_is_not_there(name: str) -> None:
    with pytest.raises(UsageError, match="--music"):
        open_music([name])


def test_a_folder_without_sound_is_told(tmp_path: Path) -> None:
    (source,) = open_music([str(tmp_path)])
    with pytest.raises(UserError, match="no sound file"):
        source.entries()
