"""Avatars of one's own in the studio: moved as the command line moves them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.retarget.read_motion import read_motion
from src.shared.data.retarget.to_rig import read_target
from src.shared.formats.readers.glb import GlbFile, read_glb, rest_matrix
from src.shared.formats.rig import SCHEMES, motion_clip
from src.shared.formats.writers.bvh import write_bvh
from src.shared.formats.writers.glb import write_vrm
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX
from tests.shared.data.retarget.test_to_rig import as_matrices, character, same_places
from tests.shared.formats.chromium_pipe import Browser
from tests.shared.studio.driving import BROWSER, PAYLOADS, assert_same, exported, made, opened


def avatar(path: Path, kind: str = "") -> Path:
    """A character as somebody would bring it, of a program other than ours, without a motion.

    Args:
        kind: "VRMC_vrm" or "VRM" for an avatar of VRM 1.0 or 0.x, whose nodes have other names;
            the latter faces -Z.
    """
    file = GlbFile.read(character(path))
    document = file.document
    nodes = document["nodes"]
    del document["animations"]
    document["asset"]["generator"] = "another"
    world, mesh = {23: rest_matrix(nodes[23])}, np.eye(4)
    if kind == "VRM":
        about = np.diag([-1.0, 1, -1, 1])
        nodes[23] = {
            "name": "Armature",
            "children": [0],
            "matrix": (about @ world[23]).T.ravel().tolist(),
        }
        world[23], mesh = about @ world[23], about
    for node, parent in enumerate([23, *motion_clip(still()).parents[1:]]):
        world[node] = world[parent] @ rest_matrix(nodes[node])
    joints = document["skins"][0]["joints"]
    inverse = [(np.linalg.inv(world[node]) @ mesh).T.ravel() for node in joints]
    document["skins"][0]["inverseBindMatrices"] = file.accessor(np.float32(inverse))
    if kind:
        names = [name[0].lower() + name[1:] for name in SCHEMES["unity"]]
        for node in range(len(names)):
            nodes[node]["name"] = f"J_{node}"
        bones = {name: {"node": node} for node, name in enumerate(names)}
        listed = [{"bone": name} | bone for name, bone in bones.items()]
        human = {"humanBones": listed if kind == "VRM" else bones}
        document["extensions"] = {kind: {"humanoid": human}}
        document["extensionsUsed"] = [kind]
    return file.write(path)


def still() -> Motion:
    turns = np.zeros((2, 22, 4), np.float32)
    turns[..., 0] = 1
    return Motion(turns, np.zeros((2, 3), np.float32), np.zeros((2, 2), np.float32), 30.0)


def body_of(browser: Browser) -> list[str]:
    """The bodies that can be chosen, and the one that is."""
    body = "document.getElementById('body')"
    return list(browser.evaluate(f"[...[...{body}.options].map((o) => o.text), {body}.value]"))


def walking() -> Motion:
    """On the spot: knees up and down."""
    turns = np.zeros((40, 22, 4), np.float32)
    turns[..., 0] = 1
    swing = 0.4 * np.sin(np.arange(40) / 5)
    turns[:, 1, 0], turns[:, 1, 1] = np.cos(swing / 2), np.sin(swing / 2)
    root = np.tile(np.array([0, 0.95, 0], np.float32), (40, 1))
    return Motion(turns, root, np.zeros((40, 2), np.float32), 30.0)


@BROWSER
def test_joints_whose_pose_is_a_matrix_move_as_well(browser: Browser, tmp_path: Path) -> None:
    made(browser, "{ blocks: [{ text: 'a person walks forward', seconds: 2 }], seed: 0 }")
    motion = exported(browser, tmp_path)
    path = as_matrices(avatar(tmp_path / "hero.glb"))
    wanted = read_glb(read_target(path).write(motion, tmp_path / "command.glb"))
    assert "moves now" in opened(browser, "hero.glb", path.read_bytes())
    exported(browser, tmp_path, "glb")
    same_places(read_glb(tmp_path / "page.glb"), wanted, 1e-4)
    browser.evaluate("studio.chooseBody('')")


@BROWSER
@pytest.mark.parametrize("kind", ["", "VRMC_vrm", "VRM"])
def test_an_avatar_moves_as_the_command_line_moves_it(
    kind: str, browser: Browser, tmp_path: Path
) -> None:
    made(browser, "{ blocks: [{ text: 'a person walks forward', seconds: 2 }], seed: 0 }")
    motion, problems = exported(browser, tmp_path), list(browser.problems)
    path = avatar(tmp_path / (f"{kind}.vrm" if kind else "hero.glb"), kind)
    assert "moves now" in opened(browser, path.name, path.read_bytes())
    assert body_of(browser) == ["mannequin", path.name, "avatar"]
    exported(browser, tmp_path, "glb")
    moved, target = tmp_path / "page.glb", read_target(path)
    wanted = read_glb(target.write(motion, tmp_path / "command.glb"))
    same_places(read_glb(moved), wanted, 1e-4)
    before, after = (GlbFile.read(each).document for each in (path, moved))
    for part in ("nodes", "meshes", "skins", "images", "extensions"):
        assert before.get(part) == after.get(part)
    assert_same(exported(browser, tmp_path), motion)  # a BVH holds the motion alone
    browser.evaluate("studio.chooseBody('')")
    assert_same(exported(browser, tmp_path, "glb"), motion)
    assert browser.problems == problems


@BROWSER
def test_a_character_that_moves_is_a_clip_whose_body_can_be_chosen(
    browser: Browser, tmp_path: Path
) -> None:
    path = avatar(tmp_path / "hero.glb")
    moved = read_target(path).write(
        read_motion(write_bvh(walking(), tmp_path / "walk.bvh")), tmp_path / "walk.glb"
    )
    assert "walk.glb: 1.33 seconds" in opened(browser, "walk.glb", moved.read_bytes())
    assert body_of(browser) == ["mannequin", "walk.glb", ""]
    dancer = write_vrm(walking(), tmp_path / "dancer.vrm").read_bytes()
    assert "dancer.vrm: 1.33 seconds" in opened(browser, "dancer.vrm", dancer)
    assert body_of(browser) == ["mannequin", "dancer.vrm", ""]
    browser.evaluate("document.getElementById('close-clip').click()")


@BROWSER
def test_avatars_that_cannot_move_are_told(browser: Browser, tmp_path: Path) -> None:
    def changed(change: Any) -> bytes:
        file = GlbFile.read(avatar(tmp_path / "hero.glb"))
        change(file.document)
        return file.write(tmp_path / "bad.glb").read_bytes()

    def unknown(document: dict[str, Any]) -> None:
        for number, node in enumerate(document["nodes"]):
            node["name"] = f"bone {number}"

    said = (
        (changed(unknown), "names the studio does not know"),
        (changed(lambda document: document["nodes"][4].update(scale=[1, 2, 1])), "scaled unevenly"),
        (changed(lambda document: document.update(skins=[{}])), "damaged"),
        (b"glTF nothing", "no GLB file"),
    )
    for data, line in said:
        assert line in opened(browser, "bad.glb", data)
    assert "There is no skeleton" in opened(
        browser, "bad.vrm", changed(lambda document: document.pop("skins"))
    )
    data = avatar(tmp_path / "hero.glb").read_bytes()
    opened(browser, PAYLOADS[0] + ".glb", data)
    assert body_of(browser)[1] == PAYLOADS[0] + ".glb"
    assert browser.evaluate("globalThis.hacked === undefined")
    browser.evaluate("studio.chooseBody('')")


@BROWSER
def test_an_avatar_is_drawn_with_its_pictures(page: Path, tmp_path: Path) -> None:
    ready = "typeof studio === 'object' && Boolean(studio.stage)"
    data = avatar(tmp_path / "me.vrm", "VRMC_vrm").read_bytes()
    with Browser(page.as_uri(), tmp_path / "profile", (500, 400), ready, webgl=True) as shown:
        shown.wait("studio.timings?.first !== undefined", 180)
        shown.wait("!studio.making", 60)
        bodies = "studio.stage.bodies.length"
        number = shown.evaluate(bodies)
        assert "moves now" in opened(shown, "me.vrm", data)
        shown.evaluate(
            "globalThis.skin = null; studio.stage.bodies[0].mesh.traverse((each) =>"
            " { if (each.isSkinnedMesh) skin = each; }); 0"
        )
        assert shown.evaluate("[skin.skeleton.bones.length, skin.material.map.image.width]") == [
            22,
            32,
        ]
        assert shown.evaluate(bodies) == number
        shown.evaluate("studio.setPlaying(false); studio.seek(1)")
        hand, foot = (
            shown.evaluate(
                f"{{ globalThis.node = skin.parent.getObjectByName('J_{node}');"
                " node.updateWorldMatrix(true, false); } node.matrixWorld.elements[13]"
            )
            for node in (JOINT_INDEX["r_wrist"], JOINT_INDEX["r_ankle"])
        )
        assert 0 < foot < 0.3 and hand > 1  # it waves
        # a smaller one goes less far, and the camera with it
        shown.evaluate("studio.worn.size *= 0.5; studio.seek(1.5); studio.stage.resetView()")
        aim = "[studio.stage.focus.x, studio.stage.focus.z, studio.stage.controls.target.y]"
        hips = "skin.parent.getObjectByName('J_0')"
        x, z, height = shown.evaluate(aim)
        shown.evaluate(f"{hips}.updateWorldMatrix(true, false)")
        away = shown.evaluate(f"{hips}.matrixWorld.elements[12] - studio.stage.offsets[0]")
        deep = shown.evaluate(f"{hips}.matrixWorld.elements[14]")
        assert abs(away - x) < 0.15 and abs(deep - z) < 0.15
        assert height == pytest.approx(0.85 * shown.evaluate("studio.worn.size"))
        shown.evaluate("studio.chooseBody('')")
        assert shown.evaluate("studio.stage.bodies[0].chest.parent.type") == "Bone"
        coarse = "studio.stage.bodies[0].mesh.geometry.index.count / 3"
        assert shown.evaluate("studio.stage.lean") >= 1  # there is no graphics card
        assert shown.evaluate("studio.stage.sun.castShadow") is False
        assert 1000 < shown.evaluate(coarse) < 4000
        shown.evaluate(  # what is wished for last holds, however long the other takes
            "Promise.all([studio.chooseBody('avatar'), studio.chooseBody('')])"
        )
        assert (
            body_of(shown)[-1] == "" and shown.evaluate("studio.worn ?? studio.stage.worn") is None
        )
        assert shown.problems == []
