"""Folders of any mixture of motion files become clips."""

import os
from pathlib import Path

import numpy as np
import pytest

from src.shared.data.sources import MotionFolder, Reading, Skipped, distinct_names
from src.shared.data.synthetic.clips import generate_clip, sample_specs
from src.shared.errors import UsageError, UserError
from src.shared.formats.registry import write_motion
from src.shared.motion.motion import Motion
from tests.shared.formats.readers.test_acclaim import ASF


@pytest.fixture(scope="module")
def walk() -> Motion:
    return generate_clip(sample_specs(40, seed=3)[17], seed=5)


@pytest.fixture
def mixture(walk: Motion, tmp_path: Path) -> Path:
    """One walk in every format that is read."""
    root = tmp_path / "mixture"
    root.mkdir()
    for name in ("a.bvh", "b.npz", "c.glb", "d.amass.npz"):
        write_motion(walk, root / name)
    np.save(root / "e.npy", walk.positions())
    lines = [f"{name},a person walks" for name in ("a", "b", "c.glb", "d.amass", "e")]
    (root / "captions.csv").write_text("\n".join(["clip,caption", *lines]))
    return root


def test_every_format_gives_the_same_walk(mixture: Path, walk: Motion) -> None:
    folder = MotionFolder.open(mixture, captions=[mixture / "captions.csv"])
    assert folder.items() == ["a.bvh", "b.npz", "c.glb", "d.amass.npz", "e.npy"]
    assert all(folder.caption_rows.values())
    for item in folder.items():
        motion = folder.read(item).motion
        seconds = walk.seconds * (1.5 if item == "e.npy" else 1)  # HumanML3D: 20 a second
        assert motion.fps == 30 and motion.seconds == pytest.approx(seconds, abs=0.05)
        if item != "e.npy":
            np.testing.assert_allclose(motion.positions(), walk.positions(), atol=2e-4)


def test_what_files_do_not_say_can_be_stated(mixture: Path, walk: Motion) -> None:
    reading = Reading(source_fps=30.0)
    folder = MotionFolder.open(mixture, captions=[mixture / "captions.csv"], reading=reading)
    found = folder.read("e.npy").motion.positions()
    np.testing.assert_allclose(found - found[:1, :1], walk.positions() - walk.positions()[:1, :1],
                               atol=0.01)  # fmt: skip


def same(one: np.ndarray, other: np.ndarray) -> None:
    np.testing.assert_allclose(one, other, atol=1e-6)


def pieces(root: Path, *rows: str) -> MotionFolder:
    table = root / "pieces.csv"
    table.write_text("\n".join(["clip,start,end,repeat,action,provenance,hold", *rows]))
    return MotionFolder.open(root, captions=[table])


def test_pieces_of_a_file_are_clips_of_one_take(mixture: Path, walk: Motion) -> None:
    end = walk.seconds
    folder = pieces(mixture, "b,0,1,,walk,", f"b,1,{end},,wave,hand-made", "b,0.5,1,3,hop,,0.5")
    clips = {item: folder.read(item) for item in folder.items() if item.startswith("b.")}
    assert list(clips) == ["b.npz@0-1", f"b.npz@1-{end:g}", "b.npz@0.5-1"]
    first, second, loop = clips.values()
    assert {clip.take for clip in clips.values()} == {"b"}
    assert (first.motion.num_frames, loop.motion.num_frames) == (30, 60)
    assert second.labels == {"action": "wave"} and second.provenance == "hand-made"
    same(second.motion.quaternions, walk.quaternions[30:])
    same(loop.motion.quaternions[15:30], walk.quaternions[15:30])
    same(loop.motion.quaternions[45:], walk.quaternions[[29] * 15])
    steps = np.linalg.norm(np.diff(loop.motion.root_position[:45, [0, 2]], axis=0), axis=-1)
    assert steps.max() < 2 * steps.mean()  # it walks on


def test_a_piece_beyond_the_end_is_told(mixture: Path) -> None:
    folder = pieces(mixture, "b,2,99,,walk,")
    with pytest.raises(UserError, match="2 to 99 s is not within the file's"):
        folder.read("b.npz@2-99")


def test_a_folder_without_captions_has_the_words_of_its_names(walk: Motion, tmp_path: Path) -> None:
    for name in ("Dance_Body-Roll02", "12_34"):
        write_motion(walk, tmp_path / f"{name}.npz")
    folder = MotionFolder.open(tmp_path)
    assert folder.from_names and folder.wordless() == ["12_34.npz", "Dance_Body-Roll02.npz"]
    clip = folder.read("Dance_Body-Roll02.npz")
    assert clip.captions == {"en": ["dance body roll"]} and clip.labels == {"action": "dance"}
    with pytest.raises(Skipped, match="no caption"):
        folder.read("12_34.npz")
    assert not pieces(tmp_path, "12_34,,,,walk,").from_names


def test_one_name_in_several_formats_is_one_clip(mixture: Path, walk: Motion) -> None:
    write_motion(walk, mixture / "b.bvh")
    assert [item for item in MotionFolder.open(mixture).items() if item[0] == "b"] == ["b.bvh"]


def test_another_skeleton_beside_an_amc_is_another_clip(tmp_path: Path) -> None:
    (tmp_path / "x.amc").write_text("1\n")
    folder = MotionFolder.open(tmp_path)
    before = folder.fingerprint("x.amc")
    (tmp_path / "x.asf").write_text(ASF)
    assert folder.fingerprint("x.amc") != before


def test_links_do_not_lead_to_devices(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.bvh")
    with pytest.raises(UserError, match="holds no motion file"):
        MotionFolder.open(tmp_path)


def test_sources_have_names_of_their_own(tmp_path: Path) -> None:
    for name in ("a/mocap", "b/mocap", "c", "synthetic"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "c/walk.bvh").touch()

    def names(*roots: str) -> list[str]:
        return distinct_names([tmp_path / root for root in roots])

    assert names("a/mocap", "c") == ["mocap", "c"]
    assert names("a/mocap", "c", "b/mocap") == ["a/mocap", "c", "b/mocap"]
    assert names("c/walk.bvh") == ["walk"]
    assert names("synthetic") == [f"{tmp_path.name}/synthetic"], "the project's own motions'"
    for twice in (("c", "c"), ("c", "c/walk.bvh"), ("a", "a/mocap")):
        with pytest.raises(UsageError, match="named twice, or lies within"):
            names(*twice)


def test_single_files_of_one_name_take_their_own_rows(tmp_path: Path) -> None:
    files = [tmp_path / place / "walk.bvh" for place in ("a", "b")]
    for file in files:
        file.parent.mkdir()
        file.touch()
    table = tmp_path / "captions.csv"
    table.write_text("a/walk,strolls\nb/walk,limps\n")
    sources = MotionFolder.open_all(files, captions=[table])
    assert [source.name for source in sources] == ["a/walk", "b/walk"]
    assert [source.table["walk.bvh"][0].captions["en"] for source in sources] == [
        ["strolls"],
        ["limps"],
    ]
