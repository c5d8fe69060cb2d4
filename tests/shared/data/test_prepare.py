"""From a folder of BVH to datasets: splits, captions, resuming, and what is skipped and why."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.config_schema import PROVENANCES
from src.shared.data import prepare as prepare_module
from src.shared.data.captions.language import mirror_labels
from src.shared.data.prepare import fill_gaps, open_data, prepare
from src.shared.data.prepared import PreparedData, assign_splits, group_of, orbit
from src.shared.data.sources import MotionFolder, SyntheticSource, load_label_rules
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.data.text_motion import TextMotionDataset
from src.shared.errors import UsageError, UserError
from src.shared.formats.writers.bvh import write_bvh
from src.shared.io.storage import place
from src.shared.motion.features import ROOT_ROW, YAW_RATE, encode_features, mirror_features
from tests.deadly_source import DeadlySource
from tests.files import files_of
from tests.full_disk import full_disk


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    folder = tmp_path_factory.mktemp("prepared")
    prepare([SyntheticSource(300)], folder, workers=1)
    return PreparedData.open(folder)


def bvh_folder(folder: Path, num: int = 6) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["clip,caption"]
    for number, spec in enumerate(sample_specs(num, seed=1)):
        write_bvh(generate_clip(spec, seed=number), folder / f"take{number}.bvh")
        lines.append(f"take{number},a person raises the left hand number {number}")
    (folder / "captions.csv").write_text("\n".join(lines), encoding="utf-8")
    return folder


def test_features_survive_the_shards(data: PreparedData) -> None:
    source = SyntheticSource(300)
    for record in data.records()[::97]:
        clip = source.read(record.id.partition("/")[2].removesuffix("~mirrored"))
        expected = encode_features(clip.motion)
        expected = mirror_features(expected) if record.mirrored else expected
        torch.testing.assert_close(data.features(record), expected)


def test_a_record_says_where_its_motion_comes_from(data: PreparedData, tmp_path: Path) -> None:
    assert {record.provenance for record in data.records()} == {"procedural"}
    root = bvh_folder(tmp_path / "in")
    report = prepare([MotionFolder.open(root, captions=[root / "captions.csv"])], tmp_path / "out")
    assert report["by_provenance"] == {"captured": 6}
    batch = TextMotionDataset(data, "train").batch(0, 4)
    assert batch.provenance.tolist() == [PROVENANCES.index("procedural")] * 4


def test_mirror_images_swap_left_and_right_in_every_language(data: PreparedData) -> None:
    pairs = [
        (a, b)
        for a, b in zip(data.records()[::2], data.records()[1::2], strict=True)
        if a.labels.get("side") == "left"
    ]
    assert pairs
    for plain, mirrored in pairs[:5]:
        assert mirrored.mirrored and mirrored.labels == mirror_labels(plain.labels)
        assert mirrored.labels["side"] == "right" and mirrored.split == plain.split
        texts = data.captions(mirrored)
        assert {"en", "es", "fr", "de", "ja", "zh"} <= set(texts)
        assert any("right" in text for text in texts["en"])
        # "coffee in the left hand, so she waves with the right" names both
        assert not any("left" in text and "right" not in text for text in texts["en"])
        assert any("右" in text for text in texts["ja"]) and any("右" in t for t in texts["zh"])


def test_splits_part_takes_and_whole_combinations(data: PreparedData) -> None:
    takes = {
        split: {r.take for r in data.records(split)} for split in ("train", "val", "test_seen")
    }
    assert not takes["train"] & takes["test_seen"] and not takes["train"] & takes["val"]
    held_back = {record.group for record in data.records("test_unseen")}
    assert held_back
    for split in ("train", "val", "test_seen"):
        assert not held_back & {record.group for record in data.records(split)}
    assert {r.group for r in data.records("test_seen")} <= {r.group for r in data.records("train")}
    for record in data.records("test_unseen"):
        assert group_of(mirror_labels(record.labels)) in held_back


def test_a_split_does_not_depend_on_other_clips() -> None:
    clips = [(f"take{i}", "action=walk", {"action": "walk"}) for i in range(40)]
    more = clips + [(f"other{i}", "action=run", {"action": "run"}) for i in range(9)]
    few, many = assign_splits(clips, 0), assign_splits(more, 0)
    assert all(many[take] == split for take, split in few.items())
    assert sum(split == "test_seen" for split in few.values()) == 4
    assert set(assign_splits(clips[:4], 0).values()) == {"train"}


def test_captions_without_labels_share_an_orbit_with_their_mirror_image() -> None:
    assert orbit({}, "Waves the left hand") == orbit({}, "waves the  right hand")


def test_prepare_twice_does_nothing_twice(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = bvh_folder(tmp_path / "in")
    source = MotionFolder.open(root, captions=[root / "captions.csv"])
    prepare([source], tmp_path / "out", workers=1)
    before = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir() if p.is_file()}
    made = []
    monkeypatch.setattr(prepare_module, "_make_shard", made.append)
    prepare([source], tmp_path / "out", workers=1)
    after = {p.name: p.read_bytes() for p in (tmp_path / "out").iterdir() if p.is_file()}
    assert not made and before == after


def test_a_full_disk_is_one_line(tmp_path: Path) -> None:
    with full_disk(), pytest.raises(UserError, match=r"cannot write .*\.safetensors: File too"):
        prepare([SyntheticSource(1)], tmp_path, workers=1)
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_what_is_held_back_anew_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root = bvh_folder(tmp_path / "in", 2)
    source = MotionFolder.open(root, captions=[root / "captions.csv"])
    assert prepare([source], tmp_path / "out", workers=1)["held_back_now"] == []
    usual = prepare_module.assign_splits
    monkeypatch.setattr(
        prepare_module,
        "assign_splits",
        lambda *given: usual(*given) | {"in/take1": "test_seen"},
    )
    report = prepare([source], tmp_path / "out", workers=1)
    assert report["held_back_now"] == ["in/take1.bvh", "in/take1.bvh~mirrored"]
    assert prepare([source], tmp_path / "out", workers=1)["held_back_now"] == []
    (tmp_path / "out" / "clips.jsonl").write_text("{damaged", encoding="utf-8")
    assert prepare([source], tmp_path / "out", workers=1)["held_back_now"] == []


def test_an_interrupted_run_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prepare_module, "CLIPS_PER_SHARD", 2)
    root = bvh_folder(tmp_path / "in")
    source = MotionFolder.open(root, captions=[root / "captions.csv"])
    prepare([source], tmp_path / "whole", workers=1)
    real, calls = prepare_module._make_shard, []

    def stops_at_the_third(job: prepare_module._Job) -> None:
        if len(calls) == 2:
            raise KeyboardInterrupt
        calls.append(job)
        real(job)

    monkeypatch.setattr(prepare_module, "_make_shard", stops_at_the_third)
    with pytest.raises(KeyboardInterrupt):
        prepare([source], tmp_path / "out", workers=1)
    assert not (tmp_path / "out" / "manifest.json").exists()
    monkeypatch.setattr(prepare_module, "_make_shard", lambda job: (calls.append(job), real(job)))
    prepare([source], tmp_path / "out", workers=1)
    assert len(calls) == 3
    for name in ("clips.jsonl", "captions.json", "statistics.safetensors", "manifest.json"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_workers_do_not_change_the_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prepare_module, "CLIPS_PER_SHARD", 4)
    prepare([SyntheticSource(10)], tmp_path / "one", workers=1)
    prepare([SyntheticSource(10)], tmp_path / "two", workers=2)
    one, two = (json.loads((tmp_path / n / "manifest.json").read_text()) for n in ("one", "two"))
    assert one == two and len(one["files"]) == 6


def test_a_cluster_and_a_killed_worker_do_not_change_the_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scheduler: str
) -> None:
    monkeypatch.setattr(prepare_module, "CLIPS_PER_SHARD", 3)
    died = tmp_path / "died"
    source = DeadlySource(24, deadly="synthetic-00010", died=died)
    prepare([source], tmp_path / "cluster", scheduler=scheduler)
    assert died.exists()
    prepare([source], tmp_path / "one", workers=1)
    cluster, one = (files_of(tmp_path / name) for name in ("cluster", "one"))
    assert cluster == one and len(one) == 5 + 2 * 8


def test_a_bucket_holds_what_a_folder_does(
    tmp_path: Path, bucket: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Read from a bucket and written to one, by two processes; then by one into a folder."""
    monkeypatch.setattr(prepare_module, "CLIPS_PER_SHARD", 8)
    root = bvh_folder(tmp_path / "in")
    (root / "broken.bvh").write_text("HIERARCHY\nROOT x\n{")
    for path in root.iterdir():
        (place(bucket) / "in" / path.name).write_bytes(path.read_bytes())
    table = [root / "captions.csv"]
    sources = [MotionFolder.open(place(f"{bucket}/in"), captions=table), SyntheticSource(6)]
    out = place(f"{bucket}/out")
    assert prepare(sources, out, workers=2)["clips"] == 12
    prepare(sources, tmp_path / "out", workers=1)
    stored = {path.url.removeprefix(f"{out}/"): path.read_bytes() for path in out.iterdir()}
    assert stored == files_of(tmp_path / "out")
    assert f"{bucket}/in/broken.bvh" in json.loads(stored["report.json"])["skipped"][0]["reason"]
    data = PreparedData.open(out)
    assert len(data.records()) == 2 * 12
    assert torch.equal(
        data.features(data.records()[7]),
        PreparedData.open(tmp_path / "out").features(data.records()[7]),
    )


def test_a_bucket_is_prepared_once(
    tmp_path: Path, bucket: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prepare_module, "CLIPS_PER_SHARD", 8)
    source, out = SyntheticSource(6), place(f"{bucket}/out")
    prepare([SyntheticSource(10)], out, workers=1)
    assert (out / "shards" / "00001.json").exists()
    prepare([source], out, workers=1)
    assert not (out / "shards" / "00001.json").exists(), "of the larger run"
    monkeypatch.setattr(prepare_module, "_make_shard", lambda job: pytest.fail("made again"))
    prepare([source], out, workers=1)


def test_what_is_skipped_is_named_with_its_reason(tmp_path: Path) -> None:
    root = bvh_folder(tmp_path / "in", 3)
    (root / "broken.bvh").write_text("HIERARCHY\nROOT x\n{")
    (root / "mute.bvh").write_text("HIERARCHY\nROOT x\n{")
    (root / "silent.bvh").write_bytes((root / "take0.bvh").read_bytes())
    with (root / "captions.csv").open("a") as stream:
        stream.write("\nbroken,breaks\nghost,haunts\n")
    report = prepare([MotionFolder.open(root, captions=[root / "captions.csv"])], tmp_path / "out")
    reasons = {entry["clip"]: entry["reason"] for entry in report["skipped"]}
    assert report["clips"] == 3 and set(reasons) == {
        f"in/{name}.bvh" for name in ("broken", "mute", "silent")
    }
    assert report["unmatched_captions"] == ["ghost"]
    assert "unreadable" in reasons["in/mute.bvh"]
    assert "unreadable" in reasons["in/broken.bvh"]
    assert "no caption and no label" in reasons["in/silent.bvh"]
    written = json.loads((tmp_path / "out" / "report.json").read_text())
    assert written | {"held_back_now": []} == report


def test_the_same_file_name_in_two_folders_is_two_takes(tmp_path: Path) -> None:
    root = tmp_path / "in"
    for folder in ("walk", "run"):
        bvh_folder(root / folder, 2)
    (root / "run" / "take1.bvh").unlink()
    table = root / "captions.csv"
    table.write_text("walk/take0,walks\nrun/take0.bvh,runs\ntake1,waves\n")
    source = MotionFolder.open(root, captions=[table])
    clips = {item: source.read(item) for item in source.items()}
    assert {item: (clip.take, clip.captions["en"]) for item, clip in clips.items()} == {
        "walk/take0.bvh": ("walk/take0", ["walks"]),
        "run/take0.bvh": ("run/take0", ["runs"]),
        "walk/take1.bvh": ("take1", ["waves"]),
    }


def test_two_sources_of_one_name_are_told_apart(tmp_path: Path) -> None:
    folders = [bvh_folder(tmp_path / place / "mocap", 1) for place in ("a", "b")]
    table = tmp_path / "captions.csv"
    table.write_text("a/mocap/take0,walks\nb/mocap/take0,runs\n")
    prepare(MotionFolder.open_all(folders, captions=[table]), tmp_path / "out", mirror=False)
    records = PreparedData.open(tmp_path / "out").records()
    assert {r.take: (r.id, r.captions["en"]) for r in records} == {
        "a/mocap/take0": ("a/mocap/take0.bvh", ["walks"]),
        "b/mocap/take0": ("b/mocap/take0.bvh", ["runs"]),
    }
    apart = [MotionFolder.open(folder, captions=[table]) for folder in folders]
    with pytest.raises(UsageError, match=r"two sources are called mocap.*open_all"):
        prepare(apart, tmp_path / "mixed")


def test_data_of_an_older_version_says_so(data: PreparedData, tmp_path: Path) -> None:
    old = Path(shutil.copytree(data.folder, tmp_path / "old"))
    content = json.loads((old / "manifest.json").read_text())
    (old / "manifest.json").write_text(json.dumps({**content, "version": 1}))
    with pytest.raises(UserError, match=r"an older version .*format 1.*`prepare` again"):
        PreparedData.open(old)


def test_an_unknown_language_stops_before_any_clip(tmp_path: Path) -> None:
    root = bvh_folder(tmp_path / "in", 1)
    table = root / "captions.csv"
    table.write_text("clip,caption,language\ntake0,kävelee,fi\n", encoding="utf-8")
    other = root / "more.json"
    other.write_text('{"take0": {"en": "walks", "sv": "går"}}', encoding="utf-8")
    source = MotionFolder.open(root, captions=[table])
    with pytest.raises(UserError, match=r"captions\.csv, line 2: .*'fi'.*`mirror=False`"):
        prepare([source], tmp_path / "out")
    with pytest.raises(UserError, match=r"captions [^ ]*more\.json, 'take0': .*'sv'"):
        prepare(root, tmp_path / "out", captions=[root / "more.json"])
    assert not (tmp_path / "out").exists()


def test_captions_are_given_from_python(tmp_path: Path) -> None:
    root = bvh_folder(tmp_path / "in", 2)
    more = root / "more.csv"
    more.write_text("clip,caption\ntake0,she walks\n", encoding="utf-8")
    for number, given in enumerate((str(more), [more, root / "captions.csv"])):
        out = tmp_path / f"out{number}"
        report = prepare(str(root), out, captions=given, mirror=False)
        records = {record.take: record for record in PreparedData.open(out).records()}
        assert records["in/take0"].captions["en"][0] == "she walks"
        assert report["clips"] == len(records) == 1 + number
    together = prepare([root, SyntheticSource(2)], tmp_path / "out", captions=more)
    assert together["by_source"] == {"in": 1, "synthetic": 2}
    with pytest.raises(UsageError, match=r"more\.csv without a folder or file"):
        prepare([SyntheticSource(2)], tmp_path / "none", captions=more)
    with pytest.raises(UserError, match=r"missing\.csv"):
        prepare(root, tmp_path / "none", captions=root / "missing.csv")
    assert not (tmp_path / "none").exists()


def test_nothing_usable_is_an_error(tmp_path: Path) -> None:
    root = tmp_path / "in"
    root.mkdir()
    with pytest.raises(UserError, match=r"no motion file.*\.bvh, \.amc"):
        MotionFolder.open(root)
    (root / "a.bvh").write_text("no")
    with pytest.raises(UserError, match="none of the 1 clips"):
        prepare([MotionFolder.open(root)], tmp_path / "out", workers=1)
    with pytest.raises(UserError, match="does not exist"):
        MotionFolder.open(tmp_path / "nowhere")


def test_a_damaged_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="not prepared data"):
        PreparedData.open(tmp_path)
    data = open_data("synthetic", tmp_path, synthetic_clips=8)
    shard = next((data.folder / "shards").glob("*.safetensors"))
    raw = bytearray(shard.read_bytes())
    raw[-1] ^= 1
    shard.write_bytes(raw)
    with pytest.raises(UserError, match="is damaged"):
        PreparedData.open(data.folder)
    shard.unlink()
    with pytest.raises(UserError, match="is missing"):
        PreparedData.open(data.folder)


def test_labels_come_from_file_names_and_captions() -> None:
    rules = load_label_rules()
    assert rules.of_file("dataset-2_walk-turn-left_tired_001")[0] == {
        "action": "walk", "direction": "forward", "turn": "left", "style": "tired",
    }  # fmt: skip
    swapped, _ = rules.of_file("dataset-2_walk-turn-left_masculine_006")
    assert swapped["turn"] == "right"
    assert rules.of_file("dataset-2_walk-turn-right_normal_032")[1]
    assert rules.of_file("dataset-1_run_normal_001")[0] == {"action": "run", "direction": "forward"}
    assert rules.of_caption("Slow walk")["speed"] == "slow"
    assert rules.of_file("my_own_file") == ({}, None)


def dataset(data: PreparedData, **options: object) -> TextMotionDataset:
    return TextMotionDataset(data, "train", max_frames=90, **options)  # type: ignore[arg-type]


def test_batches_depend_on_seed_step_and_rank_alone(data: PreparedData) -> None:
    one, two = dataset(data).batch(7, 8), dataset(data).batch(7, 8)
    assert torch.equal(one.motion, two.motion) and one.captions == two.captions
    assert dataset(data).batch(8, 8).captions != one.captions
    other = dataset(data).batch(7, 8, rank=1)
    assert other.captions != one.captions
    assert dataset(data, seed=1).batch(7, 8).captions != one.captions


def test_a_batch_is_masked_normalised_and_labelled(data: PreparedData) -> None:
    batch = dataset(data, min_frames=60).batch(3, 16)
    assert batch.motion.shape[:2] == batch.mask.shape and batch.motion.shape[1] <= 90
    assert not batch.motion[~batch.mask].any()
    for row, record in enumerate(batch.records):
        length = int(batch.mask[row].sum())
        raw = batch.motion[row, :length] * data.std + data.mean
        values = data.features(record)
        starts = [
            s for s in range(len(values) - length + 1)
            if torch.allclose(values[s : s + length], raw, atol=1e-4)
        ]  # fmt: skip
        assert starts or torch.allclose(values[-1], raw[-1], atol=1e-4)  # joined, or a part
        assert batch.captions[row] in data.captions(record)[batch.languages[row]]
        assert data.tags[batch.tag[row]] == record.labels["action"]
    same = [a.group == b.group for a in batch.records for b in batch.records]
    assert same == (batch.group[:, None] == batch.group[None]).flatten().tolist()


def test_whole_clips_are_not_cut(data: PreparedData) -> None:
    longest = max(record.num_frames for record in data.records("train"))
    for step in range(4):
        batch = TextMotionDataset(data, "train", max_frames=longest, whole=True).batch(step, 16)
        assert batch.mask.sum(1).tolist() == [record.num_frames for record in batch.records]


def test_counted_actions_are_never_cut(data: PreparedData) -> None:
    train = dataset(data, min_frames=40)
    seen = 0
    for step in range(12):
        batch = train.batch(step, 16)
        for row, record in enumerate(batch.records):
            if "count" in record.labels or "angle" in record.labels:
                assert batch.mask[row].sum() == record.num_frames
                seen += 1
    assert seen


def test_a_turn_stays_in_its_window(data: PreparedData) -> None:
    train = dataset(data)
    rng = np.random.default_rng(0)
    turns = [r for r in data.records() if "turn" in r.labels and r.num_frames > 110]
    assert turns
    for record in turns[:8]:
        whole = data.features(record)[:, ROOT_ROW, YAW_RATE].sum()
        part = train.window(record, 90, rng)[:, ROOT_ROW, YAW_RATE].sum()
        assert part.sign() == whole.sign() and part.abs() > 0.3 * whole.abs()


def test_balance_evens_the_actions(data: PreparedData) -> None:
    def spread(balance: float) -> float:
        train = dataset(data, balance=balance)
        actions = torch.cat([train.batch(step, 64).tag for step in range(20)])
        return float(torch.bincount(actions, minlength=len(data.tags)).float().std())

    assert spread(1.0) < spread(0.0)


def test_captured_clips_are_not_drowned_by_procedural_ones(
    data: PreparedData, monkeypatch: pytest.MonkeyPatch
) -> None:
    records = data.records("train")
    few = {record.id for record in records if record.tag == "walk"} & {r.id for r in records[::9]}
    marked = [replace(r, provenance="captured") if r.id in few else r for r in records]
    monkeypatch.setattr(data, "records", lambda split=None: marked)

    def share(wanted: float) -> float:
        train = dataset(data, captured_share=wanted, min_frames=80)
        drawn = [record for step in range(40) for record in train.batch(step, 64).records]
        walks = [record.provenance == "captured" for record in drawn if record.tag == "walk"]
        others = len(drawn) - len(walks)
        assert others / len(drawn) == pytest.approx(by_hand, abs=0.03)  # actions are as before
        return sum(walks) / len(walks)

    plain = dataset(data, min_frames=80)
    drawn = [record for step in range(40) for record in plain.batch(step, 64).records]
    by_hand = sum(record.tag != "walk" for record in drawn) / len(drawn)
    assert 0 < share(0.0) < 0.3
    assert share(0.7) == pytest.approx(0.7, abs=0.05)


def test_an_empty_split_says_so(data: PreparedData) -> None:
    with pytest.raises(ValueError, match="no clip of at least 5000 frames"):
        TextMotionDataset(data, "val", min_frames=5000, max_frames=6000)


def test_procedural_clips_fill_only_gaps():
    def clip(provenance: str, **labels: str) -> dict[str, object]:
        return {"provenance": provenance, "labels": labels}

    walks = [clip("captured", action="walk", direction="left", style="old")] * 2
    kick = clip("procedural", action="kick", side="left")
    fast = clip("procedural", action="walk", direction="right", speed="fast")
    turning = clip("procedural", action="walk", direction="right", turn="left")
    clips = [*walks, clip("captured", action="kick"), kick, fast, turning]
    assert fill_gaps(clips, mirror=True) == clips  # two captured walks are too few
    many = [*walks, *clips]
    assert fill_gaps(many, mirror=False) == many  # to the left, and not to the right
    assert fill_gaps(many, mirror=True) == [clip for clip in many if clip is not fast]


def test_a_gesture_is_never_cut_off(tmp_path: Path):
    data = open_data("synthetic", tmp_path, synthetic_clips=60)
    windows = TextMotionDataset(data, "train", min_frames=40, max_frames=110)
    waves = [r for r in windows.records if r.tag == "wave"]
    assert waves
    rng = np.random.default_rng(0)
    for record in waves:
        whole = data.features(record)
        window = windows.window(record, 90, rng)
        assert torch.equal(window[0], whole[0])
        assert torch.equal(window[-1], whole[-1])
    for step in range(20):
        batch = windows.batch(step, 8)
        waves = [r for r in batch.records if r.tag == "wave"]
        assert all(batch.mask.shape[1] >= round(0.4 * r.num_frames) for r in waves)


def test_paths_are_folders_of_motion(tmp_path: Path) -> None:
    root = bvh_folder(tmp_path / "in")
    report = prepare(str(root), str(tmp_path / "one"), workers=1)
    prepare([MotionFolder.open(root)], tmp_path / "two", workers=1)
    assert report["by_provenance"] == {"captured": 6}
    one, two = (files_of(tmp_path / name) for name in ("one", "two"))
    assert one == two
