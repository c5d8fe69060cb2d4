"""Files into the studio's page and out of it."""

import base64
import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.retarget.read_motion import read_motion
from src.shared.formats.readers.glb import GlbFile
from src.shared.formats.rig import motion_clip
from src.shared.formats.writers.bvh import write_bvh, write_bvh_clip
from src.shared.formats.writers.glb import write_glb, write_glb_clip
from src.shared.model.diffusion import Sampling
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_NAMES
from src.shared.pipelines.edit import chosen_joints, continue_clips, edit_clip
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.formats.chromium_pipe import Browser
from tests.shared.studio.driving import (
    BROWSER,
    BVH,
    assert_same,
    exported,
    made,
    opened,
    text_of,
    with_blocks,
)


def read_in_page(browser: Browser, path: Path) -> Motion:
    """A clip as the page reads it."""
    said = opened(browser, path.name, path.read_bytes())
    assert "seconds" in said, said
    root = np.reshape(browser.evaluate("[...studio.clip.motion.root]"), (-1, 3))
    turns = np.reshape(browser.evaluate("[...studio.clip.motion.quaternions]"), (-1, 22, 4))
    return Motion(turns, root.astype(np.float32), np.zeros((len(root), 2), np.float32), 30.0)


@BROWSER
def test_a_clip_is_done_again_and_continued_as_on_the_command_line(
    browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    [walk] = generator.generate(["a person walks forward"], seconds=3.0)
    path = write_bvh(walk, tmp_path / "walk.bvh")
    clip = read_motion(path)
    assert "3.00 seconds" in opened(browser, "walk.bvh", path.read_bytes())
    scene = "{ blocks: [{ text: 'a person waves', seconds: 2 }], seed: 1 }"

    def form(**values: Any) -> str:
        rows = (f"document.getElementById('{id}').value = '{v}'" for id, v in values.items())
        return "; ".join(rows)

    cases: list[tuple[dict[str, Any], Any]] = [
        ({"mode": "redo", "from": 1, "until": 2, "joints": "all"}, edit_clip(clip, 1.0, 2.0)),
        (
            {"mode": "redo", "from": 1, "until": 2, "joints": "right-arm"},
            edit_clip(clip, 1.0, 2.0, chosen_joints(["right-arm"])),
        ),
        (
            {"mode": "continue", "keep": 1, "joints": "all"},
            continue_clips(clip.frames(60, 90), seconds=3.0),
        ),
        (
            {"mode": "between", "keep": 1, "joints": "all"},
            continue_clips(clip, clip, seconds=4.0, rejoin=True),
        ),
    ]
    for choice, given in cases:
        made(browser, scene, form(**choice))
        wanted = generator.edit(given, "a person waves", sampling=Sampling(seed=1))
        assert_same(exported(browser, tmp_path), wanted.motion)
        assert browser.evaluate("!!studio.shown[0].missed") == bool(wanted.warning)
    made(browser, scene.replace("waves", "jumps").replace("2", "1"), form(**choice))
    given = continue_clips(clip, clip, seconds=3.0, rejoin=True)
    assert generator.edit(given, "a person jumps", sampling=Sampling(seed=1)).warning
    assert "does not show “jump”" in text_of(browser, "warnings")
    [over] = generator.generate(["a person does a cartwheel"], seconds=1.8)
    path = write_bvh(over, tmp_path / "over.bvh")
    opened(browser, "over.bvh", path.read_bytes())
    made(browser, scene, form(mode="continue", keep=1, joints="all"))
    clip = read_motion(path).frames(over.num_frames - 30, over.num_frames)
    assert (clip.positions()[:, 12, 1] < clip.positions()[:, 0, 1]).any()  # upside down at first
    given = continue_clips(clip, seconds=3.0)
    wanted = generator.edit(given, "a person waves", sampling=Sampling(seed=1))
    assert_same(exported(browser, tmp_path), wanted.motion)
    assert "3.00 seconds" in opened(
        browser, "walk.glb", write_glb(walk, tmp_path / "a.glb").read_bytes()
    )
    root = np.reshape(browser.evaluate("[...studio.clip.motion.root]"), (-1, 3))
    np.testing.assert_allclose(root, walk.root_position, atol=1e-5)
    browser.evaluate("document.getElementById('close-clip').click()")


@BROWSER
def test_a_clip_of_another_skeleton_is_brought_onto_ours(browser: Browser, tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    turns = np.zeros((40, 22, 4), np.float32)
    turns[:] = np.cumsum(rng.normal(scale=0.01, size=turns.shape), 0) + (1, 0, 0, 0)
    turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
    root = np.cumsum(rng.normal(scale=0.01, size=(40, 3)), 0) + (0, 0.95, 0)
    motion = Motion(turns, root.astype(np.float32), np.zeros((40, 2), np.float32), 60.0)
    clip = motion_clip(motion, "mixamo")
    longer = 1 + 0.3 * rng.uniform(size=(22, 1))
    rig = replace(clip.rig, offsets=clip.rig.offsets * longer)
    clip = replace(clip, rig=rig, translations=clip.translations * longer)
    for kind, write in (("bvh", write_bvh_clip), ("glb", write_glb_clip)):
        path = write(clip, tmp_path / f"other.{kind}")
        assert_same(read_in_page(browser, path), read_motion(path))
    browser.evaluate("document.getElementById('close-clip').click()")


@BROWSER
def test_clips_of_any_rate_begin_and_lie_as_on_the_command_line(
    browser: Browser, tmp_path: Path
) -> None:
    quarter = np.zeros((365, 22, 4), np.float32)
    quarter[..., 0] = np.cos(np.linspace(0, 0.4, 365))[:, None]
    quarter[..., 1] = np.sin(np.linspace(0, 0.4, 365))[:, None]
    root = np.tile(np.array([0, 0.95, 0], np.float32), (365, 1))
    motion = Motion(quarter, root, np.zeros((365, 2), np.float32), 30.0)
    bvh = tmp_path / "a.bvh"
    text = write_bvh(motion, bvh).read_text()
    bvh.write_text(re.sub("Frame Time: .*", "Frame Time: 0.0833333", text))
    assert_same(read_in_page(browser, bvh), read_motion(bvh))

    glb = write_glb(motion.frames(0, 40), tmp_path / "a.glb")
    whole = GlbFile.read(glb)
    node = {"name": "Armature", "children": [0]}
    turned = node | {"rotation": [0.5**0.5, 0, 0, 0.5**0.5]}
    matrix = [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1]
    for rate, late, above in (
        (30, 1, None),
        (24, 0, None),
        (29.97, -1, turned),
        (120, 5, node | {"matrix": matrix}),
    ):
        file = GlbFile(json.loads(json.dumps(whole.document)), bytes(whole.data))
        accessor = file.document["accessors"][
            file.document["animations"][0]["samplers"][0]["input"]
        ]
        start = file.document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        times = (np.arange(40) / rate + late).astype("<f4").tobytes()
        file.data[start : start + len(times)] = times
        if above:
            file.document["nodes"].append(above)
            file.document["scenes"][0]["nodes"] = [len(file.document["nodes"]) - 1]
        file.write(glb)
        assert_same(read_in_page(browser, glb), read_motion(glb))
    browser.evaluate("document.getElementById('close-clip').click()")


@BROWSER
def test_damaged_clips_are_refused_in_words(browser: Browser, tmp_path: Path) -> None:
    head = BVH.format("pelvis")
    for text, line in (
        (head + "1 2 3\n", "says 1 frames, but holds 2"),
        (head.replace("Frames: 1", "Frames: 1.5"), "no whole BVH"),
        (head.replace("0 0 0\n", "0 0 1e39\n"), "no angle and no place"),
    ):
        assert line in opened(browser, "a.bvh", text.encode())
    turns = np.zeros((2, 22, 4), np.float32)
    turns[..., 0] = 1
    still = Motion(turns, np.zeros((2, 3), np.float32), np.zeros((2, 2), np.float32), 30.0)
    file = GlbFile.read(write_glb(still, tmp_path / "a.glb"))
    nodes = file.document["nodes"]
    for change, line in (
        ({"nodes": [*nodes[:5], nodes[5] | {"children": [5]}, *nodes[6:]]}, "damaged"),
        ({"nodes": [None, *nodes[1:]]}, "damaged"),
        ({"nodes": "abc"}, "damaged"),
        ({"accessors": []}, "damaged"),
    ):
        data = GlbFile(file.document | change, bytes(file.data)).to_bytes()
        assert line in opened(browser, "a.glb", data)
    cut = GlbFile(file.document, bytes(file.data[:100])).to_bytes()
    assert "cut off" in opened(browser, "a.glb", cut)


@BROWSER
def test_an_opened_clip_is_shown_and_has_no_way_on_the_floor(
    browser: Browser, tmp_path: Path
) -> None:
    made(browser, "{ blocks: [{ text: 'a person waves', seconds: 2 }], seed: 0 }")
    turns = np.zeros((40, 22, 4), np.float32)
    turns[..., 0] = 1
    still = np.tile(np.array([0, 0.95, 3], np.float32), (40, 1))
    clip = Motion(turns, still, np.zeros((40, 2), np.float32), 30.0)
    data = write_bvh(clip, tmp_path / "still.bvh").read_bytes()
    browser.evaluate("studio.choosePath('straight')")
    browser.wait("!studio.making", 60)
    assert opened(browser, "still.bvh", data).startswith("still.bvh: 1.33 seconds")
    shown = "[studio.shown[0].frames, document.getElementById('scrub').max, studio.time]"
    assert browser.evaluate(shown) == [40, "1.3", 0]
    stale = "document.body.classList.contains('stale')"
    assert not browser.evaluate(stale)
    path = "document.getElementById('path')"
    assert browser.evaluate(f"[{path}.value, {path}.disabled]") == ["clip", True]
    browser.evaluate("studio.history.undo()")
    assert browser.evaluate(f"[{path}.value, {path}.disabled]") == ["straight", False]
    assert browser.evaluate("studio.shown[0].text") == "a person waves"
    browser.evaluate("studio.history.redo()")
    assert browser.evaluate("studio.shown[0].frames") == 40
    assert "clip" not in browser.evaluate("atob(studio.link().split('#')[1])")
    browser.evaluate("document.getElementById('close-clip').click()")
    assert text_of(browser, "status") == "The clip is closed."
    with_blocks(browser, ("a person waves", 2))
    opened(browser, "still.bvh", data)
    browser.evaluate("document.getElementById('close-clip').click()")
    assert text_of(browser, "status").startswith("Changed") == browser.evaluate(stale)


@BROWSER
def test_other_readers_see_what_the_command_line_makes(
    browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    bvhio, pygltflib = (pytest.importorskip(name) for name in ("bvhio", "pygltflib"))
    made(browser, "{ blocks: [{ text: 'a person kicks', seconds: 2 }], seed: 2 }")
    [wanted] = generator.generate(["a person kicks"], seconds=2.0, sampling=Sampling(seed=2))
    exported(browser, tmp_path)
    root = bvhio.readAsHierarchy(str(tmp_path / "page.bvh"))
    joints = {joint.Name: joint for joint, _, _ in root.layout()}
    for frame in (0, 25, 59):
        root.loadPose(frame, recursive=True)
        found = [list(joints[name].PositionWorld) for name in JOINT_NAMES]
        np.testing.assert_allclose(
            np.array(found) / 100, wanted.positions()[frame], atol=2e-4
        )  # single precision, in centimetres
    exported(browser, tmp_path, "glb")
    document = pygltflib.GLTF2().load(str(tmp_path / "page.glb"))
    [animation] = document.animations
    [path] = [c for c in animation.channels if c.target.path == "translation"]
    values = document.accessors[animation.samplers[path.sampler].output]
    view = document.bufferViews[values.bufferView]
    data = document.binary_blob()[view.byteOffset : view.byteOffset + view.byteLength]
    np.testing.assert_allclose(
        np.frombuffer(data, np.float32).reshape(-1, 3), wanted.root_position, atol=1e-4
    )


@BROWSER
@pytest.mark.slow
def test_a_film_shows_what_is_played(page: Path, tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    ready = "typeof studio === 'object' && Boolean(studio.stage)"
    with Browser(page.as_uri(), tmp_path / "profile", (500, 400), ready, webgl=True) as shown:
        shown.wait("studio.timings?.first !== undefined", 180)
        shown.evaluate("studio.history.change({ takes: 1 })")
        made(shown, "{ blocks: [{ text: 'a person jumps', seconds: 2 }], seed: 0 }")
        shown.evaluate(  # what would be saved
            "URL.createObjectURL = (blob) => { globalThis.saved = blob; return 'blob:none'; };"
            " HTMLAnchorElement.prototype.click = function () { globalThis.named = this.download; }"
        )
        shown.evaluate("studio.film()")
        name = shown.evaluate("named")
        coded = shown.evaluate(
            "new Promise((resolve) => { const reader = new FileReader();"
            " reader.onload = () => resolve(reader.result.split(',')[1]);"
            " reader.readAsDataURL(saved); })"
        )
        assert name in ("a-person-jumps.mp4", "a-person-jumps.webm")
        assert text_of(shown, "status") == f"Saved {name}."
    path = tmp_path / name
    path.write_bytes(base64.b64decode(coded))
    with av.open(str(path)) as film:
        pictures = [each.to_ndarray(format="gray") for each in film.decode(video=0)]
        end = film.streams.video[0]
    assert len(pictures) > 10 and end.width > 100
    change = [
        np.abs(a.astype(float) - b).mean() for a, b in zip(pictures, pictures[5:], strict=False)
    ]
    assert max(change) > 0.1  # it moves
