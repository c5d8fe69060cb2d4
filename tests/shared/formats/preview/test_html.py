"""HTML preview: harmless captions, nothing from elsewhere, data that decode to the motion."""

import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.formats.mannequin import mannequin
from src.shared.formats.preview.html import script_safe_json, write_html
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import PARENTS, canonical_skeleton
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.pages import HOSTILE, Page, array


def a_motion(text: str = "walks", frames: int = 12) -> Motion:
    rng = np.random.default_rng(5)
    quaternions = rng.normal(size=(frames, 22, 4))
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = rng.uniform(-5, 5, (frames, 3)).astype(np.float32)
    contacts = rng.integers(0, 2, (frames, 2)).astype(np.float32)
    return Motion(quaternions.astype(np.float32), root, contacts, 30.0, text)


def test_captions_are_data_whatever_they_hold(tmp_path: Path) -> None:
    plain = Page(write_html(a_motion(), tmp_path / "plain.html"))
    page = Page(write_html([a_motion(text, 1) for text in HOSTILE], tmp_path / "a.html"))
    assert [motion["text"] for motion in page.data["motions"]] == HOSTILE
    assert page.tags == plain.tags
    assert page.scripts[1] == plain.scripts[1]


@settings(max_examples=50, deadline=None)
@given(st.text() | st.sampled_from(HOSTILE))
def test_json_is_safe_in_a_script(text: str) -> None:
    safe = script_safe_json({"text": text})
    assert not re.search("[<>&]", safe)
    assert safe.isascii()
    assert json.loads(safe) == {"text": text}


def test_the_page_needs_nothing_from_elsewhere(tmp_path: Path) -> None:
    path = write_html(a_motion(), tmp_path / "a.html")
    assert not re.search(r"https?:|//cdn|@import|url\(|\bimport\(|fetch\(", path.read_text("utf-8"))
    sources = {
        name: value
        for _, attributes in Page(path).tags
        for name, value in attributes.items()
        if name in ("src", "href")
    }
    assert sources == {"href": "data:,"}
    assert "\"default-src 'none'; script-src" in path.read_text("utf-8")
    assert path.stat().st_size < 400_000


def test_the_data_decode_to_the_motion(tmp_path: Path) -> None:
    motion = a_motion()
    data = Page(write_html(motion, tmp_path / "a.html")).data["motions"][0]
    assert (data["frames"], data["fps"], data["text"]) == (12, 30.0, "walks")
    quaternions = array(data["quaternions"], "<i2").reshape(12, 22, 4) / 32767
    contacts = array(data["contacts"], "u1").reshape(12, 2) / 255
    root = array(data["root"], "<f4").reshape(12, 3).copy()
    back = Motion(
        (quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)).astype(np.float32),
        root, contacts.astype(np.float32), 30.0)  # fmt: skip
    np.testing.assert_allclose(back.positions(), motion.positions(), atol=1e-3)
    np.testing.assert_array_equal(back.contacts, motion.contacts)


def test_joints_that_never_turn_are_stored_once(tmp_path: Path) -> None:
    motion = a_motion()
    motion.quaternions[:, 5:] = motion.quaternions[0, 5:]
    data = Page(write_html(motion, tmp_path / "a.html")).data["motions"][0]
    assert data["turning"] == [0, 1, 2, 3, 4]
    moving = array(data["quaternions"], "<i2").reshape(12, 5, 4) / 32767
    np.testing.assert_allclose(moving, motion.quaternions[:, :5], atol=2e-5)
    still = array(data["still"], "<i2").reshape(22, 4) / 32767
    np.testing.assert_allclose(still, motion.quaternions[0], atol=2e-5)


def test_mesh_and_skeleton_decode(tmp_path: Path) -> None:
    data, body = Page(write_html(a_motion(), tmp_path / "a.html")).data, mannequin()
    mesh = data["mesh"]
    vertices = array(mesh["positions"], "<i2").reshape(-1, 3) * 1e-4
    np.testing.assert_allclose(vertices, body.vertices, atol=6e-5)
    weights = array(mesh["weights"], "u1").reshape(-1, 4)
    assert (weights.sum(-1, dtype=int) == 255).all()
    np.testing.assert_array_equal(array(mesh["joints"], "u1").reshape(-1, 4), body.joints)
    np.testing.assert_array_equal(array(mesh["triangles"], "<u2").reshape(-1, 3), body.triangles)
    assert tuple(data["skeleton"]["parents"]) == PARENTS
    np.testing.assert_allclose(data["skeleton"]["offsets"], canonical_skeleton().offsets, atol=1e-6)


def test_nothing_to_show_and_no_place_to_write(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no motion"):
        write_html([], tmp_path / "a.html")
    (tmp_path / "a.html").mkdir()
    with pytest.raises(UserError, match="cannot write"):
        write_html(a_motion(), tmp_path / "a.html")


NODE_CHECK = """
const fs = require("fs");
const page = fs.readFileSync(process.argv[1], "utf8");
const data = /type="application.json">(.*?)<.script>/s.exec(page)[1];
const script = fs.readFileSync(process.argv[2], "utf8");
const run = new Function("document", "atob", script + `
const pose = poseAt(MOTIONS[0], 5.5 / 30);
const view = makeView(0, 0, 5, [0, 1, 0], 400, 300);
return { positions: pose.positions, centre: view.project([0, 1, 0]),
  left: view.project([1, 1, 0]), above: view.project([0, 2, 0]),
  behind: view.project([0, 1, 9]) };`);
const document = { getElementById: () => ({ textContent: data }) };
console.log(JSON.stringify(run(document, atob)));
"""


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_poses_and_camera_of_the_viewer(tmp_path: Path) -> None:
    """The viewer's own code, between two frames, against kinematics here."""
    motion = a_motion()
    motion.quaternions[:, 3::4] = motion.quaternions[0, 3::4]  # some joints never turn
    page = write_html(motion, tmp_path / "a.html")
    scene = Path(__file__).parents[4] / "src/shared/formats/preview/preview_scene.js"
    command = ["node", "-e", NODE_CHECK, str(page), str(scene)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    first, second = motion.quaternions[5], motion.quaternions[6]
    same = np.sign((first * second).sum(-1, keepdims=True))
    middle = first + same * second
    middle /= np.linalg.norm(middle, axis=-1, keepdims=True)
    halfway = Motion(middle[None], motion.root_position[5:7].mean(0)[None], motion.contacts[:1])
    np.testing.assert_allclose(result["positions"], halfway.positions()[0], atol=2e-3)
    np.testing.assert_allclose(result["centre"][:3], [200, 150, 5])
    assert result["left"][0] > 200  # +X is on the right of a camera that looks at the face
    assert result["above"][1] < 150
    assert result["behind"][2] < 0


@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
def test_it_starts_in_a_browser_and_plays(tmp_path: Path) -> None:
    """Without WebGL, which is quick."""
    page = write_html([a_motion("走る人"), a_motion("still", 1)], tmp_path / "a.html")
    clock = "document.getElementById('clock').textContent"
    with Browser(page.as_uri(), tmp_path / "profile", (360, 400), ready="true") as browser:
        browser.wait(f"parseFloat({clock}) > 0")
        assert browser.evaluate(clock).endswith(" / 0.37 s")
        assert browser.evaluate("document.querySelectorAll('figcaption').length") == 2
        assert browser.evaluate("document.title").startswith("走る人")
        assert not browser.problems


@pytest.mark.slow
@pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
@pytest.mark.parametrize("flag", ["--enable-unsafe-swiftshader", "--disable-3d-apis"])
def test_a_browser_shows_it_moving_without_errors(tmp_path: Path, flag: str) -> None:
    from PIL import Image

    place = np.tile(np.array([0, 0.95, 0], np.float32), (12, 1))
    shown = [replace(a_motion(text), root_position=place) for text in HOSTILE[:3]]
    page = write_html(shown, tmp_path / "a.html")
    pictures = []
    for time in ("0.0", "0.2"):
        shot = tmp_path / f"{time}.png"
        done = subprocess.run(
            [str(chromium()), "--headless", "--no-sandbox", "--disable-background-networking",
             "--use-angle=swiftshader", flag, "--enable-logging=stderr", "--v=0",
             "--window-size=900,500", "--virtual-time-budget=1500",
             f"--user-data-dir={tmp_path / 'profile'}", f"--screenshot={shot}",
             f"{page.as_uri()}#t={time}"],
            capture_output=True, text=True, timeout=300, check=False)  # fmt: skip
        lines = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
        assert not [line for line in lines if "GL Driver Message" not in line], done.stderr
        pictures.append(np.asarray(Image.open(shot).convert("RGB")).astype(int))
    first, second = pictures
    assert (np.abs(first - second).max(-1) > 40).sum() > 500
    for card in np.array_split(first[20:380], 3, axis=1):  # an orange limb in every card
        assert ((card[..., 0] > 180) & (card[..., 2] < 120)).sum() > 50
