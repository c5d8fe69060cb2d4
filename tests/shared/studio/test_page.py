"""The studio's page: nothing from elsewhere, and motions that are the command line's."""

import base64
import json
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np
import pytest

from src.shared.data.retarget.read_motion import read_motion
from src.shared.data.retarget.to_rig import read_target
from src.shared.errors import UserError
from src.shared.formats.readers.glb import GlbFile, read_glb, rest_matrix
from src.shared.formats.rig import SCHEMES, motion_clip
from src.shared.formats.writers.bvh import write_bvh, write_bvh_clip
from src.shared.formats.writers.glb import write_glb, write_glb_clip, write_vrm, write_vrma
from src.shared.model.checkpoint import resolve_model
from src.shared.model.diffusion import Sampling
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX, JOINT_NAMES
from src.shared.pipelines import live
from src.shared.pipelines.edit import chosen_joints, continue_clips, edit_clip
from src.shared.pipelines.motion_generator import MotionGenerator
from src.shared.pipelines.path import DrawnPath
from src.shared.pipelines.stream import Passage, met
from src.shared.pipelines.timeline import Timeline
from src.shared.studio.page import write_studio
from tests.shared.data.retarget.test_to_rig import as_matrices, character, same_places
from tests.shared.formats.chromium_pipe import Browser, chromium
from tests.shared.formats.firefox_marionette import Firefox, firefox
from tests.shared.formats.glb_reader import Glb
from tests.shared.formats.pages import HOSTILE, Page

BROWSER = pytest.mark.skipif(not chromium(), reason="no Chromium is installed")
PROMPTS = {
    "en": "a person walks forward",
    "es": "Hola, una persona salta tras el autobús, gracias",
    "fr": "①une personne court, tête basse ②elle saute",
    "de": "Hallo, eine Person nimmt Anlauf, davor winkt sie, danke!",
    "ja": "人が右手を振る",
    "zh": "一个人向左转弯走",
}
MOST = 40e6  # bytes


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_studio(tmp_path_factory.mktemp("studio"))


@pytest.fixture(scope="module")
def browser(page: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """The page with its model loaded; one take at a time."""
    profile = tmp_path_factory.mktemp("profile")
    with Browser(page.as_uri(), profile, ready="typeof studio === 'object'") as opened:
        opened.wait("studio.timings?.first !== undefined", 180)
        opened.evaluate("studio.history.change({ takes: 1 })")
        yield opened


@pytest.fixture(scope="module")
def generator() -> MotionGenerator:
    return MotionGenerator("starter", device="cpu")


def made(browser: Browser, scene: str, clip: str = "") -> None:
    """Make a scene that is written in JavaScript, and wait for it."""
    browser.evaluate(f"studio.history.change({{ takes: 1, path: null, ...{scene} }}); {clip}")
    browser.wait("!studio.making")
    browser.evaluate("studio.make()")
    browser.wait("!studio.making", 180)
    assert browser.evaluate("document.getElementById('status').className") == "note"


def exported(browser: Browser | Firefox, folder: Path, kind: str = "bvh") -> Motion:
    """What the page saves, read by our own reader."""
    text = browser.evaluate(
        f"btoa(Array.from(studio.bytes('{kind}'), (b) => String.fromCharCode(b)).join(''))"
    )
    path = folder / f"page.{kind}"
    path.write_bytes(base64.b64decode(text))
    return read_motion(path)


def assert_same(page: Motion, command: Motion) -> None:
    np.testing.assert_allclose(page.positions(), command.positions(), atol=1e-4)


def test_the_page_needs_nothing_from_elsewhere(page: Path) -> None:
    assert page.name == "index.html" and page.stat().st_size < MOST
    parsed = Page(page)
    sources = {
        name: value
        for _, attributes in parsed.tags
        for name, value in attributes.items()
        if name in ("src", "href")
    }
    assert sources == {"href": "data:,"}
    text = page.read_text("utf-8")
    (policy,) = re.findall(r'content="(default-src.*?)"', text)
    assert "default-src 'none'" in policy and "connect-src" not in policy and "http" not in policy


def test_models_that_it_cannot_run_are_refused(tmp_path: Path) -> None:
    card = (resolve_model("starter-free") / "config.json").read_text()
    other = tmp_path / "other"
    other.mkdir()
    (other / "config.json").write_text(
        card.replace('"text-model": "pairs"', '"text-model": "small"')
    )
    for name, line in ((str(other), "text-model pairs"), ("starter-audio", "starter-audio")):
        with pytest.raises(UserError, match=line):
            write_studio(tmp_path / "a.html", name)
    assert list(tmp_path.iterdir()) == [other]


@BROWSER
@pytest.mark.parametrize(
    "prompt",
    ["elle marche et bâille", "他打喷嚏然后走", "she walks and yawns", "dreht den Kopf nach links",
     "lies down and juggles"],
)  # fmt: skip
def test_what_nobody_taught_is_told_as_by_the_command(
    prompt: str, browser: Browser, generator: MotionGenerator
) -> None:
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 1 }}], seed: 0 }}")
    [line] = generator.sentences.scope_warnings([prompt])
    assert line is not None
    said, asked = line.removeprefix("prompt ").split(" asks ")
    quoted = re.sub("'(.*?)'", r"“\1”", asked)
    assert f"“{said[1:-1]}” asks {quoted}." in text_of(browser, "warnings")


@BROWSER
@pytest.mark.parametrize(
    "prompt",
    ["a jogger runs in place", "she walks forward, then jumps", "he runs, then runs in place",
     "他走，然后不停地跳", "claps three times", "he walks, then claps twice", "two steps back",
     "he bows, then takes three steps forward"],
)  # fmt: skip
def test_what_is_led_or_done_once_is_so_as_on_the_command_line(
    prompt: str, browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 4 }}], seed: 3 }}")
    [wanted] = generator.generate([prompt], seconds=4.0, sampling=Sampling(seed=3))
    assert_same(exported(browser, tmp_path), read_motion(write_bvh(wanted, tmp_path / "a.bvh")))
    assert text_of(browser, "warnings") == ""


@BROWSER
def test_the_two_learned_steps_are_those_of_the_command_line(
    generator: MotionGenerator, tmp_path: Path
) -> None:
    page = write_studio(tmp_path, steps=2)
    with Browser(page.as_uri(), tmp_path / "profile", ready="typeof studio === 'object'") as opened:
        opened.wait("studio.timings?.first !== undefined", 180)
        for prompt in ("a man bows", "claps twice, then walks forward and stops"):
            made(opened, f"{{ blocks: [{{ text: '{prompt}', seconds: 3 }}], seed: 4 }}")
            sampling = Sampling(seed=4, steps=2)
            [wanted] = generator.generate([prompt], seconds=3.0, sampling=sampling)
            there = read_motion(write_bvh(wanted, tmp_path / "a.bvh"))
            assert_same(exported(opened, tmp_path), there)


WALKS, WAVES = "a person walks forward", "una persona saluda con la mano"
LIVE = [WALKS] * 3 + [WAVES] * 3 + ["a person stands"] * 4 + [WAVES] * 3 + [WALKS] * 3  # one a pull


@BROWSER
def test_a_live_body_moves_as_on_the_command_line(
    browser: Browser, generator: MotionGenerator, monkeypatch: pytest.MonkeyPatch
) -> None:
    stood: list[Any] = []

    def seen(*parts: Any) -> Any:
        stood.append(parts)
        return met(*parts)

    monkeypatch.setattr("src.shared.pipelines.stream.met", seen)
    browser.wait("!studio.making")
    stream = generator.stream(
        LIVE[0], seconds=live.WINDOW, ahead=live.AHEAD, sampling=Sampling(seed=3)
    )
    pieces, shown = iter(stream), 0
    for text in LIVE:
        stream.say(text)
        wanted = next(pieces)
        asked = json.dumps({"text": text, "seed": 3, "begin": not shown})
        numbers = "[piece.quaternions, piece.root, piece.contacts].map((all) => [...all])"
        quaternions, root, contacts, texts = browser.evaluate(
            f"studio.client.call('live', {asked}).then((piece) => [...{numbers}, piece.texts])"
        )
        piece = Motion(
            np.reshape(quaternions, (-1, 22, 4)).astype(np.float32),
            np.reshape(root, (-1, 3)).astype(np.float32),
            np.reshape(contacts, (-1, 2)).astype(np.float32),
            30.0,
        )
        assert_same(piece, wanted)
        np.testing.assert_array_equal(piece.contacts, wanted.contacts)
        assert texts == [stream.text_at(shown + frame) for frame in range(wanted.num_frames)]
        shown += wanted.num_frames
    assert stood  # and, of others, what was made for the sentence before was dropped


@BROWSER
def test_a_body_is_live_until_it_is_stopped_and_a_clip_then(
    browser: Browser, tmp_path: Path
) -> None:
    click = "document.getElementById('{}').click()".format
    named = "document.getElementById('make').textContent"
    browser.wait("!studio.making")
    with_blocks(browser, ("", 2))
    browser.evaluate(click("live"))
    assert "in a few words" in text_of(browser, "status") and not browser.evaluate("!!studio.live")
    with_blocks(browser, ("a person walks forward", 2))
    workers = browser.evaluate("studio.client.workers.length")
    browser.evaluate(click("live"))
    assert browser.evaluate(named) == "Say"
    browser.wait("studio.live.at > 20")
    free = "[...document.querySelectorAll('button, select, input')].filter((each) =>"
    free += " each.checkVisibility() && !each.disabled).map(({ id }) => id)"
    assert browser.evaluate(free) == ["make", "examples", "stop"]
    assert browser.evaluate("document.activeElement.id") == "text"

    filled(browser, "text", " ", "input")
    typed(browser, "Enter", "document.getElementById('text')")
    assert "in a few words" in text_of(browser, "status")
    filled(browser, "text", "a person juggles", "input")
    typed(browser, "Enter", "document.getElementById('text')")
    assert text_of(browser, "status") == "Said: a person juggles"
    browser.wait("studio.live.delays.length === 1")
    assert re.match(r"Seen \d\.\d s after it was said", text_of(browser, "status"))
    shown = "(({ kept, at }) => kept.flatMap(({ texts }) => texts)[Math.floor(at)])(studio.live)"
    assert browser.evaluate(shown) == "a person juggles"
    assert re.fullmatch(r"\d+\.\d s", text_of(browser, "clock"))
    browser.wait("document.querySelectorAll('#warnings li').length")
    typed(browser, "z", "document.body", ctrlKey=True)  # the scene rests
    assert browser.evaluate("studio.scene.blocks[0].text") == "a person juggles"

    typed(browser, "Escape")
    browser.wait("!studio.making")
    assert browser.evaluate(named) == "Make"
    assert text_of(browser, "status").startswith("what was live: ")
    motion = exported(browser, tmp_path)
    assert motion.num_frames == browser.evaluate("studio.clip.motion.frames") > 30
    joints = motion.positions()
    assert np.isfinite(joints).all() and np.abs(np.diff(joints, axis=0)).max() < 0.2
    assert browser.evaluate("studio.client.workers.length") == workers

    browser.evaluate(click("live"))
    browser.wait("studio.live?.made > 0")
    more = "studio.live.at = studio.live.made - 1; studio.live.add(studio.live.kept[0], 0)"
    browser.evaluate(f"for (let number = 0; number < 300; number++) {{ {more}; }}")
    browser.evaluate("studio.client.call = () => Promise.reject(new Error('no more'))")
    browser.wait("!studio.making")
    assert text_of(browser, "status") == "no more"
    assert 3580 < browser.evaluate("studio.clip.motion.frames") <= 3600  # the last two minutes
    browser.evaluate("delete studio.client.call")
    browser.evaluate(click("close-clip"))
    made(browser, "{ blocks: [{ text: 'a person waves', seconds: 1 }], seed: 80 }")


@pytest.mark.slow
@pytest.mark.skipif(not firefox(), reason="no Firefox is installed")
def test_firefox_makes_the_same(page: Path, generator: MotionGenerator, tmp_path: Path) -> None:
    blocks = [{"text": "a person waves", "seconds": 0.5}]
    scene = base64.urlsafe_b64encode(json.dumps({"v": 1, "blocks": blocks}).encode()).decode()
    url = f"{page.as_uri()}#{scene.rstrip('=')}"
    with Firefox(url, tmp_path / "profile", "typeof studio === 'object'") as shown:
        shown.wait("studio.timings?.first !== undefined", 180)
        [wanted] = generator.generate(["a person waves"], seconds=0.5)
        for kind in ("bvh", "glb", "vrma"):
            assert_same(exported(shown, tmp_path, kind), wanted)


@pytest.mark.parametrize("steps", [0, 1001])
def test_steps_that_no_model_takes_are_refused(steps: int, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=f"steps {steps} is not within 1 ... 1000"):
        write_studio(tmp_path, steps=steps)
    assert not list(tmp_path.iterdir())


@BROWSER
@pytest.mark.parametrize("language", PROMPTS)
def test_a_sentence_gives_what_the_command_line_gives(
    language: str, browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    prompt, seed = PROMPTS[language], list(PROMPTS).index(language)
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 2 }}], seed: {seed} }}")
    [wanted] = generator.generate([prompt], seconds=2.0, sampling=Sampling(seed=seed))
    assert_same(exported(browser, tmp_path), read_motion(write_bvh(wanted, tmp_path / "a.bvh")))
    if language == "en":
        flat = "document.getElementById('no-stage').checkVisibility()"  # it has no WebGL, and stays
        assert browser.evaluate(flat)
        for kind in ("glb", "vrma"):
            assert_same(exported(browser, tmp_path, kind), wanted)
            plain = Glb(tmp_path / f"page.{kind}")  # a reader that is none of ours
            for frame in (0, 31, 59):
                places, _ = plain.world(frame)
                np.testing.assert_allclose(places[:22], wanted.positions()[frame], atol=1e-4)
        page = GlbFile.read(tmp_path / "page.vrma").document
        command = GlbFile.read(write_vrma(wanted, tmp_path / "command.vrma")).document
        assert page["extensions"] == command["extensions"] and page["nodes"] == command["nodes"]
        opened(browser, "a.vrma", (tmp_path / "page.vrma").read_bytes())
        root = np.reshape(browser.evaluate("[...studio.clip.motion.root]"), (-1, 3))
        np.testing.assert_allclose(root, wanted.root_position, atol=1e-4)
        browser.evaluate("document.getElementById('close-clip').click()")
    warned = browser.evaluate("document.querySelectorAll('#warnings li').length > 0")
    assert warned == (generator.sentences.scope_warnings([prompt]) != [None])
    assert browser.problems == []
    assert all(url.startswith(("file:", "blob:", "data:")) for url in browser.requests)


@BROWSER
def test_timelines_and_paths_are_those_of_the_command_line(
    browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    texts = ("a person walks forward", "turns 90 degrees to the left, then waves twice")
    blocks = ", ".join(f"{{ text: '{text}', seconds: {n} }}" for n, text in enumerate(texts, 2))
    timeline = Timeline(tuple(Passage(text, 30 * n) for n, text in enumerate(texts, 2)))
    made(browser, f"{{ blocks: [{blocks}], seed: 3 }}")
    wanted = generator.timeline(timeline, sampling=Sampling(seed=3)).motion
    assert_same(exported(browser, tmp_path), wanted)
    alone = f"[{{ text: '{texts[0]}', seconds: 3 }}]"
    made(browser, f"{{ blocks: {alone}, seed: 3, path: [[0, 0], [1, 1], [1, 2]] }}")
    path = DrawnPath(np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 2.0]]))
    walk = Timeline((Passage(texts[0], 90),))
    wanted = generator.timeline(walk, path=path, seconds=3.0, sampling=Sampling(seed=3)).motion
    assert_same(exported(browser, tmp_path), wanted)
    far = [[50, 50], [-50, -50]] * 200
    browser.evaluate(f"studio.history.change({{ path: {far} }})")
    browser.evaluate("studio.make()")
    assert "too long for its time" in text_of(browser, "status")


def opened(browser: Browser, name: str, data: bytes) -> str:
    """Drop a file; what the page says."""
    coded = base64.b64encode(data).decode()
    bytes_ = f"Uint8Array.from(atob('{coded}'), (sign) => sign.charCodeAt(0))"
    browser.evaluate(f"studio.openClip(new File([{bytes_}], {json.dumps(name)}))")
    return str(browser.evaluate("document.getElementById('status').textContent"))


def with_blocks(browser: Browser, *blocks: tuple[str, float]) -> None:
    """Put sentences into the timeline."""
    rows = [{"text": text, "seconds": seconds} for text, seconds in blocks]
    browser.evaluate(f"studio.history.change({{ blocks: {json.dumps(rows)}, path: null }})")


PAYLOADS = (
    "<img src=x onerror=globalThis.hacked=1>",
    '"><svg/onload=globalThis.hacked=1>',
    "javascript:globalThis.hacked=1//../../etc",
)
BVH = """HIERARCHY
ROOT {}
{{
OFFSET 0 0 0
CHANNELS 3 Xrotation Yrotation Zrotation
}}
MOTION
Frames: 1
Frame Time: 0.03
0 0 0
"""


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
    assert "3.00 seconds" in opened(
        browser, "walk.glb", write_glb(walk, tmp_path / "a.glb").read_bytes()
    )
    root = np.reshape(browser.evaluate("[...studio.clip.motion.root]"), (-1, 3))
    np.testing.assert_allclose(root, walk.root_position, atol=1e-5)
    browser.evaluate("document.getElementById('close-clip').click()")


def read_in_page(browser: Browser, path: Path) -> Motion:
    """A clip as the page reads it."""
    said = opened(browser, path.name, path.read_bytes())
    assert "seconds" in said, said
    root = np.reshape(browser.evaluate("[...studio.clip.motion.root]"), (-1, 3))
    turns = np.reshape(browser.evaluate("[...studio.clip.motion.quaternions]"), (-1, 22, 4))
    return Motion(turns, root.astype(np.float32), np.zeros((len(root), 2), np.float32), 30.0)


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
def test_hostile_words_do_nothing(browser: Browser, tmp_path: Path) -> None:
    with_blocks(browser, ("", 1))
    browser.evaluate("studio.warn()")  # lines of an earlier sentence go
    before = browser.evaluate("document.querySelectorAll('*').length")
    for text in (*HOSTILE, *PAYLOADS):
        with_blocks(browser, (text, 1))
        browser.evaluate("studio.warn()")
        bvh = BVH.format(text.replace(" ", ""))
        said = opened(browser, f"{text}.bvh", bvh.encode("utf-8", "replace"))
        assert "does not know" in said or "BVH" in said
    made(browser, f"{{ blocks: [{{ text: {json.dumps(PAYLOADS[0])}, seconds: 1 }}], seed: 0 }}")
    said = browser.evaluate("document.getElementById('stage').getAttribute('aria-label')")
    assert PAYLOADS[0] in said
    name = browser.evaluate("studio.fileName('bvh')")
    assert re.fullmatch(r"[\w-]+\.bvh", name)
    with_blocks(browser, ("", 1))
    browser.evaluate("studio.warn()")
    assert browser.evaluate("document.querySelectorAll('*').length") == before
    assert browser.evaluate("globalThis.hacked") is None
    strange = b'{"blocks":[{"text":5,"seconds":"x"}],"path":[[1]],"seed":-3}'
    for link in ("#{}", "#bm90IGpzb24", "#" + base64.b64encode(strange).decode()):
        browser.evaluate(f"location.hash = {link!r}")
    browser.wait("!studio.making", 60)
    assert browser.evaluate("studio.scene.seed") == 0
    assert browser.problems == []


@BROWSER
def test_the_browser_refuses_whatever_the_page_would_send(browser: Browser) -> None:
    heard: list[str] = []

    class Listener(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            heard.append(self.path)
            self.send_error(404)

        do_POST = do_GET

    with ThreadingHTTPServer(("127.0.0.1", 0), Listener) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        place = f"127.0.0.1:{server.server_port}"
        browser.evaluate(f"""(async () => {{
            const tried = [fetch("http://{place}/fetch", {{ mode: "no-cors" }})];
            navigator.sendBeacon("http://{place}/beacon", "x");
            new Image().src = "http://{place}/image";
            try {{ new WebSocket("ws://{place}/socket"); }} catch {{}}
            const address = '"http://{place}/worker", {{ mode: "no-cors" }}';
            const text = `fetch(${{address}}).finally(() => postMessage(0))`;
            const worker = new Worker(URL.createObjectURL(new Blob([text])));
            tried.push(new Promise((done) => {{ worker.onmessage = worker.onerror = done; }}));
            await Promise.allSettled(tried);
        }})()""")
        time.sleep(0.5)
        server.shutdown()
    assert heard == []
    refused = " ".join(browser.problems)
    assert "Content Security Policy" in refused and place in refused
    browser.problems.clear()


@BROWSER
def test_the_timeline_is_edited_undone_and_carried_in_a_link(browser: Browser) -> None:
    click = "document.getElementById('{}').click()".format
    made(browser, "{ blocks: [{ text: 'a person waves', seconds: 4 }], seed: 0 }")
    browser.evaluate("studio.seek(1.5)")
    browser.evaluate(click("cut"))
    seconds = "studio.scene.blocks.map((block) => block.seconds)"
    assert browser.evaluate(seconds) == [1.5, 2.5]
    browser.evaluate(click("earlier"))
    assert browser.evaluate(seconds) == [2.5, 1.5]
    browser.evaluate(click("add"))
    browser.evaluate("document.querySelector('#timeline li:nth-child(2) button').focus()")
    key = "{ key: 'ArrowRight', shiftKey: true, bubbles: true }"
    browser.evaluate(f"document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key}))")
    assert browser.evaluate("studio.scene.blocks.length") == 3
    link = browser.evaluate("studio.link()").partition("#")[2]
    for _ in range(3):
        browser.evaluate(click("undo"))
    assert browser.evaluate(seconds) == [1.5, 2.5]
    browser.evaluate(f"location.hash = {link!r}")
    browser.wait("studio.scene.blocks.length === 3")


def text_of(browser: Browser, name: str) -> str:
    return str(browser.evaluate(f"document.getElementById('{name}').textContent"))


def typed(browser: Browser, key: str, on: str = "document.activeElement", **held: bool) -> bool:
    """One key, perhaps with others held; whether the browser is left to do its own with it."""
    options = json.dumps({"key": key, "bubbles": True, "cancelable": True, **held})
    return bool(browser.evaluate(f"{on}.dispatchEvent(new KeyboardEvent('keydown', {options}))"))


def filled(browser: Browser, name: str, value: str, event: str = "change") -> str:
    """Fill a field in; what it shows then."""
    field = f"document.getElementById('{name}')"
    browser.evaluate(f"{field}.value = {json.dumps(value)}")
    browser.evaluate(f"{field}.dispatchEvent(new Event('{event}'))")
    return str(browser.evaluate(f"{field}.value"))


@BROWSER
def test_takes_are_filed_under_the_scene_that_was_asked_for(browser: Browser) -> None:
    waves = "{ blocks: [{ text: 'a person waves', seconds: 1 }], seed: 40 }"
    made(browser, waves)
    shown = "studio.shown[0].text"
    for change in (
        "history.change({ blocks: [{ text: 'a person jumps', seconds: 1 }] })",
        "history.change({ seed: 43 })",
        "history.change({ path: [[0, 0], [0, 2]] })",
    ):
        browser.evaluate("studio.history.change({ seed: studio.scene.seed + 1 })")
        browser.evaluate(f"void studio.make(); studio.{change}")
        browser.wait("!studio.making", 60)
        assert text_of(browser, "status").startswith("Changed")
        assert browser.evaluate("document.body.classList.contains('stale')")
        browser.evaluate("studio.history.undo()")
        assert not browser.evaluate("document.body.classList.contains('stale')")
        assert browser.evaluate(shown) == "a person waves"
    browser.evaluate("document.getElementById('use-motion').click()")
    close = "document.getElementById('close-clip').click()"
    browser.evaluate(f"studio.history.change({{ seed: 50 }}); void studio.make(); {close}")
    browser.wait("!studio.making", 60)
    assert browser.evaluate("document.body.classList.contains('stale')")


@BROWSER
def test_keys_act_on_what_has_the_focus_and_leave_it_there(browser: Browser) -> None:
    with_blocks(browser, ("a", 1), ("b", 1), ("c", 1))
    browser.evaluate("studio.select(0)")
    focus = "document.querySelectorAll('#timeline button')[{}].focus()".format
    focused = "[...document.querySelectorAll('#timeline button')].indexOf(document.activeElement)"
    texts = "studio.scene.blocks.map(({ text }) => text).join('')"
    browser.evaluate(focus(1))
    assert not typed(browser, "ArrowRight", shiftKey=True)
    assert browser.evaluate("studio.scene.blocks[1].seconds") == 1.5
    assert browser.evaluate(focused) == 1 and browser.evaluate("studio.selected") == 0
    assert not typed(browser, "ArrowRight", altKey=True)
    assert browser.evaluate(texts) == "acb" and browser.evaluate(focused) == 2
    assert not typed(browser, "ArrowRight", altKey=True)  # at the end; the page is not left
    assert not typed(browser, "ArrowLeft")
    assert browser.evaluate("studio.selected") == browser.evaluate(focused) == 1
    browser.evaluate(focus(0))
    typed(browser, "Delete")
    assert browser.evaluate(texts) == "cb" and browser.evaluate(focused) == 0
    assert browser.evaluate("studio.selected") == 0

    for name, tag in (("text", "textarea"), ("seed", "number")):
        assert typed(browser, "z", f"document.getElementById('{name}')", ctrlKey=True), tag
    for name in ("path", "scrub", "follow"):
        assert not typed(browser, "z", f"document.getElementById('{name}')", ctrlKey=True), name
    assert browser.evaluate(texts) == "abc"
    assert typed(browser, " ", "document.querySelector('summary')")
    assert not typed(browser, " ", "document.body")

    made(browser, "{ takes: 2, blocks: [{ text: 'a person waves', seconds: 1 }], seed: 60 }")
    browser.evaluate("document.querySelectorAll('#take-list input')[1].focus()")
    browser.evaluate("document.activeElement.click()")
    assert browser.evaluate("studio.scene.chosen") == 1
    assert browser.evaluate("document.activeElement.value") == "1"


@BROWSER
def test_fields_show_what_the_scene_has(browser: Browser, tmp_path: Path) -> None:
    with_blocks(browser, ("a person waves", 2))
    for value, shown in (("99", "30"), ("99", "30"), ("", "30"), ("-1", "0.5"), ("0", "0.5")):
        assert filled(browser, "seconds", value) == shown
    assert [filled(browser, "seed", value) for value in ("7", "", "-2", "-2")] == list("7700")
    assert [filled(browser, "keep", value) for value in ("", "99", "0")] == ["1", "10", "0.2"]
    filled(browser, "keep", "1")
    for letters in (400, 301):
        assert filled(browser, "text", "a" * letters, "input") == "a" * 300
        assert "300 letters" in text_of(browser, "status")
    option = "document.querySelector('#path option[value={}]').disabled".format
    assert browser.evaluate(option("draw"))  # without WebGL
    assert browser.evaluate(option("drawn"))
    browser.evaluate("studio.history.change({ path: [[0, 0], [0, 2]] })")
    assert not browser.evaluate(option("drawn"))
    browser.evaluate("studio.history.undo()")
    folder = "{ name: 'clips', size: 0, arrayBuffer: () => Promise.reject(new Error('x')) }"
    browser.evaluate(f"studio.openClip({folder})")
    assert "folder" in text_of(browser, "status")


@BROWSER
def test_seconds_that_the_words_ask_for_are_told_and_cut(browser: Browser) -> None:
    browser.wait("!studio.making")  # what it shows at first
    said = "new MutationObserver(() => globalThis.said++).observe(document.getElementById('status')"
    browser.evaluate(f"globalThis.said = 0; {said}, {{ childList: true }})")
    made(browser, "{ blocks: [{ text: 'a person walks four metres', seconds: 2 }], seed: 1 }")
    seconds = browser.evaluate("studio.seconds")
    assert browser.evaluate("globalThis.said") <= 3  # changed, its begin, its end
    first = text_of(browser, "status")
    assert seconds > 3 and f"it lasts {seconds:.1f} s" in first
    browser.evaluate("studio.make()")
    assert text_of(browser, "status") == "Nothing has changed since it was m" + first[1:]
    browser.evaluate("studio.seek(studio.seconds / 2)")
    assert browser.evaluate("document.querySelector('.playhead').style.left") == "50%"
    browser.evaluate("document.getElementById('cut').click()")
    assert browser.evaluate("studio.scene.blocks.map(({ seconds }) => seconds)") == [1, 1]
    browser.evaluate("studio.history.undo()")
    assert "aria-pressed" not in browser.evaluate("document.getElementById('play').outerHTML")
    assert browser.evaluate("document.getElementById('clock').ariaLive") == "off"


@BROWSER
def test_what_takes_long_is_stopped_and_what_is_finished_stays(browser: Browser) -> None:
    blocks = "[{ text: 'a person waves', seconds: 2 }]"
    asked = f"{{ blocks: {blocks}, path: null, takes: 4, seed: 70 }}"
    browser.evaluate(f"studio.history.change({asked})")
    browser.evaluate("void studio.make(); document.getElementById('stop').focus()")
    there = "Array.from({ length: 4 }, (_, take) => studio.motions.has(studio.keyOf(take)))"
    browser.wait(f"{there}[0]")
    typed(browser, "Escape")
    assert browser.evaluate("document.activeElement.id") == "make"
    browser.wait("!studio.making")
    assert text_of(browser, "status").startswith("Stopped")
    found = browser.evaluate(there)
    assert found[0] and not found[3]
    browser.evaluate("studio.make()")
    assert browser.evaluate(there) == [True] * 4
    assert browser.evaluate("document.getElementById('stop').hidden")
    last = "const last = studio.motions.get(studio.keyOf(3)); studio.motions.clear();"
    others = "for (let i = 0; i < 23; i++) studio.motions.set(i, null);"
    browser.evaluate(f"{last} studio.motions.set(studio.keyOf(3), last); {others}")
    browser.evaluate("studio.history.change({ seed: 73 })")
    browser.evaluate("studio.make()")  # three more than are remembered
    assert browser.evaluate(there) == [True] * 4
    assert browser.evaluate("document.getElementById('status').className") == "note"
    browser.evaluate("studio.motions.clear()")
    browser.evaluate("studio.history.change({ takes: 1 })")


@BROWSER
def test_nothing_plays_on_its_own_where_less_motion_is_preferred(browser: Browser) -> None:
    made(browser, "{ blocks: [{ text: 'a person waves', seconds: 1 }], seed: 0 }")
    assert text_of(browser, "play") == "Play"  # without WebGL
    browser.evaluate("studio.stage = new Proxy({}, { get: () => () => null }); 0")
    for preferred, button in (("reduce", "Play"), ("no-preference", "Pause")):
        media = [{"name": "prefers-reduced-motion", "value": preferred}]
        browser.call("Emulation.setEmulatedMedia", features=media)
        browser.evaluate("studio.shown = null; studio.setPlaying(false); studio.showMotions()")
        assert text_of(browser, "play") == button
        browser.evaluate("studio.choosePath('draw')")
        assert text_of(browser, "play") == "Play"
        browser.evaluate("studio.stopDrawing()")
        assert text_of(browser, "play") == button
    browser.evaluate("studio.setPlaying(false); studio.stage = undefined")


CONTRAST = r"""(() => {
    const parts = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map((part) => part / 255);
    const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    const light = (colour) => parts(colour).map(linear)
        .reduce((sum, part, i) => sum + part * [0.2126, 0.7152, 0.0722][i], 0.05);
    const style = (selector) => getComputedStyle(document.querySelector(selector));
    const ratio = (a, b) => Math.max(light(a) / light(b), light(b) / light(a));
    return {
        edges: ["#open", "#text", "#seconds", "#path", "#timeline li:not(.selected)"]
            .map((name) => ratio(style(name).borderTopColor, style("aside").backgroundColor)),
        words: [["#timeline .selected small", "#timeline .selected"], ["h2", "aside"],
                ["#status", "main"], ["body", "body"]]
            .map(([word, back]) => ratio(style(word).color,
                back === "main" ? style("body").backgroundColor : style(back).backgroundColor)),
    };
})()"""


@BROWSER
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_edges_and_words_can_be_seen(scheme: str, browser: Browser) -> None:
    with_blocks(browser, ("a", 1), ("b", 1))
    media = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.call("Emulation.setEmulatedMedia", features=media)
    found = browser.evaluate(CONTRAST)
    assert min(found["edges"]) >= 3 and min(found["words"]) >= 4.5, found
    dark = browser.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(20, 23, 28)"
    assert dark == (scheme == "dark")
    browser.call("Emulation.setEmulatedMedia", features=[])


@contextmanager
def phone(browser: Browser, width: int = 360, height: int = 640) -> Iterator[None]:
    """A small screen that is touched."""
    size = {"width": width, "height": height, "deviceScaleFactor": 2, "mobile": True}
    browser.call("Emulation.setDeviceMetricsOverride", **size)
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    yield
    browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
    browser.call("Emulation.clearDeviceMetricsOverride")


def middle(browser: Browser, selector: str) -> tuple[float, float]:
    box = f"document.querySelector({json.dumps(selector)}).getBoundingClientRect()"
    place = browser.evaluate(
        f"(({{ x, y, width, height }}) => [x + width / 2, y + height / 2])({box})"
    )
    return place[0], place[1]


def touched(browser: Browser, *states: list[tuple[float, float]], end: str = "touchEnd") -> None:
    """Where the fingers are, one state after another, and how that ends."""
    for index, state in enumerate(states):
        points = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(state)]
        kind = "touchMove" if index else "touchStart"
        browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
    browser.call("Input.dispatchTouchEvent", type=end, touchPoints=[])


SMALL = """["button", "select", "input:not([type=radio])", "summary", ".handle"]
    .flatMap((selector) => [...document.querySelectorAll(selector)])
    .map((element) => (element.closest('.tools label') ?? element).getBoundingClientRect())
    .filter(({ width, height }) => width && Math.min(width, height) < 40).length"""


@BROWSER
@pytest.mark.parametrize("size", [(360, 640), (390, 844)])
def test_a_phone_shows_a_long_timeline_in_its_width(
    size: tuple[int, int], browser: Browser
) -> None:
    with phone(browser, *size):
        with_blocks(browser, *((str(index), 3) for index in range(24)))
        browser.evaluate("studio.select(0)")
        assert browser.evaluate("document.documentElement.scrollWidth") == size[0]
        assert browser.evaluate(SMALL) == 0
        scrolled = "document.getElementById('timeline').scrollLeft"
        browser.evaluate(f"document.getElementById('timeline').scrollIntoView(); {scrolled} = 0")
        x, y = middle(browser, "li:nth-child(2) .handle")
        touched(browser, *([(x + 5 * step, y)] for step in range(9)))
        assert browser.evaluate("studio.scene.blocks[1].seconds") > 3.5
        x, y = middle(browser, "li button")
        touched(browser, *([(x + 15 * step, y)] for step in range(9)))  # the selected one
        texts = "studio.scene.blocks.slice(0, 3).map(({ text }) => text).join('')"
        assert browser.evaluate(texts) == "102"
        browser.evaluate("studio.select(20)")
        assert 0 < middle(browser, "#timeline .selected")[0] < size[0]
        before, changes = browser.evaluate(scrolled), browser.evaluate("studio.history.past.length")
        x, y = middle(browser, "#timeline li:nth-child(19)")
        touched(browser, *([(x + 15 * step, y)] for step in range(12)))
        browser.wait(f"{scrolled} < {before - 50}")
        assert browser.evaluate("studio.history.past.length") == changes


@BROWSER
def test_a_second_finger_leads_nothing(browser: Browser) -> None:
    with phone(browser):
        with_blocks(browser, ("a", 3), ("b", 3))
        browser.evaluate("document.getElementById('timeline').scrollIntoView()")
        changes = browser.evaluate("studio.history.past.length")
        x, y = middle(browser, "li button")
        handle = middle(browser, ".handle")
        for second in ((x + 60, y), handle):
            moves = [(second[0] + 9 * step, y) for step in range(9)]
            touched(browser, [(x, y)], *([(x, y), move] for move in moves))
            assert browser.evaluate("studio.history.past.length") == changes
        touched(browser, [handle], *([handle, (x - 9 * step, y)] for step in range(9)))
        assert browser.evaluate("studio.scene.blocks[0].seconds") == 3

        floor = "floorAt: ({ clientX, clientY }) => [clientX / 100, clientY / 100], controls: {}"
        rest = "get: (own, name) => own[name] ?? (() => null)"
        browser.evaluate(f"studio.stage = new Proxy({{ {floor} }}, {{ {rest} }}); 0")
        browser.evaluate(
            "document.getElementById('remove').scrollIntoView(); studio.choosePath('draw')"
        )
        assert browser.evaluate("document.getElementById('stage').getBoundingClientRect().y") >= 0
        line = [(60.0, 40.0 + 20 * step) for step in range(5)]
        palm = [(200.0, 50.0 + 20 * step) for step in range(5)]
        touched(browser, *([point] for point in line), end="touchCancel")
        assert browser.evaluate("studio.drawing") and not browser.evaluate("studio.scene.path")
        touched(browser, line[:1], *map(list, zip(line, palm, strict=True)))
        assert {x for x, _ in browser.evaluate("studio.scene.path")} == {0.6}
        browser.wait("!studio.making", 60)
        browser.evaluate("studio.choosePath('draw'); document.getElementById('stop').click()")
        assert not browser.evaluate("studio.drawing")
        browser.evaluate("studio.stage = undefined; studio.history.change({ path: null })")


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
def test_a_resting_stage_is_drawn_where_its_camera_moves_alone(page: Path, tmp_path: Path) -> None:
    ready = "typeof studio === 'object' && Boolean(studio.stage)"
    with Browser(page.as_uri(), tmp_path, (500, 400), ready, webgl=True) as shown:
        shown.evaluate("studio.make = async () => {}")  # nothing moves
        shown.wait("studio.stage.stale === false")
        shown.evaluate(
            "globalThis.drawn = 0; { const { renderer } = studio.stage, draw = renderer.render;"
            " renderer.render = function (...all) { drawn++; return draw.apply(this, all); }; } 0"
        )
        shown.evaluate("new Promise((resolve) => setTimeout(resolve, 500))")
        assert shown.evaluate("drawn") == 0
        shown.evaluate(
            "document.getElementById('stage').dispatchEvent("
            "new WheelEvent('wheel', { deltaY: 120, clientX: 300, clientY: 80, cancelable: true }))"
        )
        shown.wait("drawn > 0", 10)
        shown.evaluate("studio.stage.controls.target.x = 70.6; studio.stage.stale = true")
        shown.wait("studio.stage.grid.position.x === 71", 10)  # who walks far has a floor


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


def walking() -> Motion:
    """On the spot: knees up and down."""
    turns = np.zeros((40, 22, 4), np.float32)
    turns[..., 0] = 1
    swing = 0.4 * np.sin(np.arange(40) / 5)
    turns[:, 1, 0], turns[:, 1, 1] = np.cos(swing / 2), np.sin(swing / 2)
    root = np.tile(np.array([0, 0.95, 0], np.float32), (40, 1))
    return Motion(turns, root, np.zeros((40, 2), np.float32), 30.0)


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
