"""The studio's page: nothing from elsewhere, and motions that are the command line's."""

import base64
import gzip
import json
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.data.retarget.read_motion import read_motion
from src.shared.errors import UserError
from src.shared.formats.readers.glb import GlbFile
from src.shared.formats.writers.bvh import write_bvh
from src.shared.formats.writers.glb import write_vrma
from src.shared.model.checkpoint import resolve_model
from src.shared.model.diffusion import Sampling
from src.shared.pipelines.motion_generator import MotionGenerator
from src.shared.pipelines.path import DrawnPath
from src.shared.pipelines.stream import Passage
from src.shared.pipelines.timeline import Timeline
from src.shared.studio.page import seven_bit, write_studio
from tests.shared.formats.chromium_pipe import Browser
from tests.shared.formats.firefox_marionette import Firefox, firefox
from tests.shared.formats.glb_reader import Glb
from tests.shared.formats.pages import HOSTILE, Page
from tests.shared.studio.driving import (
    BROWSER,
    BVH,
    PAYLOADS,
    assert_same,
    exported,
    filled,
    made,
    opened,
    text_of,
    typed,
    with_blocks,
)

PROMPTS = {
    "en": "a person walks forward",
    "es": "Hola, una persona salta tras el autobús, gracias",
    "fr": "①une personne court, tête basse ②elle saute",
    "de": "Hallo, eine Person nimmt Anlauf, davor winkt sie, danke!",
    "ja": "人が右手を振る",
    "zh": "一个人向左转弯走",
}


MOST = 40e6  # bytes


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
def test_what_a_number_alone_makes_known_is_told_as_by_the_command(
    browser: Browser, generator: MotionGenerator
) -> None:
    prompt = "punches three times like a kangaroo"
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 1 }}], seed: 0 }}")
    [line] = generator.sentences.scope_warnings([prompt])
    assert line is not None
    told = re.sub("'(.*?)'", r"“\1”", line.removeprefix("prompt "))
    assert f"{told}." in text_of(browser, "warnings")


@BROWSER
@pytest.mark.parametrize(
    "prompt",
    ["a jogger runs in place", "she walks forward, then jumps", "he runs, then runs in place",
     "他走，然后不停地跳跃", "claps three times", "he walks, then claps twice", "two steps back",
     "he bows, then takes three steps forward", "lies down on the floor", "does push-ups",
     "a person sleeps, then walks forward", "a man bows slowly", "does 3 quick squats",
     "a person sits down and waves", "walks slowly, then kneels down",
     "il saute au ralenti, puis il tape vite dans ses mains", "nods three times",
     "does seven jumping jacks", "crawls, then lies down", "sits down, then sleeps",
     "salutes with the left hand", "hops on the left leg three times",
     "walks, then drinks with her left hand", "trinkt mit der linken Hand und winkt dann",
     "crawls, then dies", "sits and drinks with the left hand", "hops forward on the left foot",
     "walks while saluting with the left hand", "crawls, then lies down while waving",
     "the priest marches", "nods once", "turns around and walks back", "a zombie dies", "crouch",
     "walks forward, then kicks", "runs, then kicks", "punches, then kicks",
     "sits down, then stands up", "walks while clapping", "walk like a zombie", "gets up",
     "walks, head down", "walks for 8 seconds", "verbeuge dich und klatsche", "a person cheers",
     "walks, then walks with his head down, then waves"],
)  # fmt: skip
def test_what_is_led_or_done_once_is_so_as_on_the_command_line(
    prompt: str, browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 4 }}], seed: 3 }}")
    [wanted] = generator.generate([prompt], seconds=4.0, sampling=Sampling(seed=3))
    assert_same(exported(browser, tmp_path), read_motion(write_bvh(wanted, tmp_path / "a.bvh")))
    assert text_of(browser, "warnings") == ""


@BROWSER
def test_counts_that_their_seconds_do_not_hold_are_told(browser: Browser) -> None:
    with_blocks(browser, ("a person walks", 2), ("bows three times", 2))
    browser.evaluate("studio.warn()")
    told = "“bows”: 3 times in 2.0 seconds is not seen; give it 3 or more."
    assert text_of(browser, "warnings") == told
    with_blocks(browser, ("bows three times", 2))
    browser.evaluate("studio.warn()")
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


@settings(max_examples=50)
@given(part=st.binary(max_size=40))
def test_parts_are_characters_that_html_leaves_alone(part: bytes) -> None:
    coded = seven_bit(part)
    assert not set(coded) & set("\0\n\r<")
    bits = "".join(f"{ord(each) & 127:07b}" for each in coded)
    whole = bytes(int(bits[at : at + 8], 2) for at in range(0, len(bits) - 7, 8))
    assert gzip.decompress(whole) == part


@BROWSER
def test_who_has_no_graphics_card_is_told_and_goes_on(browser: Browser) -> None:
    browser.evaluate("document.getElementById('graphics').click()")
    browser.wait("!studio.making", 60)
    assert "cannot be used, the processor goes on" in text_of(browser, "status")
    assert browser.evaluate("document.getElementById('graphics').checked") is False
    assert browser.problems.pop() == "No available adapters."  # Chromium's own line
    made(browser, "{ blocks: [{ text: 'a person waves', seconds: 2 }] }")


@pytest.mark.slow  # half a minute: the card is made of software
@BROWSER
def test_a_graphics_card_makes_the_same(
    page: Path, generator: MotionGenerator, tmp_path: Path
) -> None:
    flags = ("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader")
    ready = "studio?.timings?.first !== undefined && !studio.making"
    with Browser(page.as_uri(), tmp_path / "profile", ready=ready, flags=flags) as browser:
        browser.evaluate("document.getElementById('graphics').click()")
        browser.wait("!studio.making", 120)
        assert text_of(browser, "status").startswith("A pass takes the graphics card")
        for text in ("a person kicks", "an old man walks"):  # two adapters
            made(browser, f"{{ blocks: [{{ text: '{text}', seconds: 2 }}] }}")
            [own] = generator.generate([text], seconds=2.0)
            there = exported(browser, tmp_path)
            np.testing.assert_allclose(there.positions(), own.positions(), atol=1e-3)
        assert "error" not in browser.evaluate("studio.client.call('compare')")  # still helps
        assert browser.problems == []


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
@pytest.mark.parametrize(
    "prompt", ["a person walks in a figure eight", "boxing combo: jab, jab, hook", "8の字に歩く"]
)
def test_ways_and_lists_are_those_of_the_command_line(
    prompt: str, browser: Browser, generator: MotionGenerator, tmp_path: Path
) -> None:
    made(browser, f"{{ blocks: [{{ text: '{prompt}', seconds: 2 }}], seed: 4 }}")
    [wanted] = generator.generate([prompt], seconds=2.0, sampling=Sampling(seed=4))
    assert_same(exported(browser, tmp_path), read_motion(write_bvh(wanted, tmp_path / "a.bvh")))
    warned = browser.evaluate("document.querySelectorAll('#warnings li').length > 0")
    assert warned == (generator.sentences.scope_warnings([prompt]) != [None])


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
    .map((element) => element.closest('.tools label, details label') ?? element)
    .map((element) => element.getBoundingClientRect())
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
