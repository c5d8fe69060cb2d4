"""The studio's page while it is live: the body that `stream` moves."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.model.diffusion import Sampling
from src.shared.motion.motion import Motion
from src.shared.pipelines import live
from src.shared.pipelines.motion_generator import MotionGenerator
from src.shared.pipelines.stream import met
from tests.shared.formats.chromium_pipe import Browser
from tests.shared.studio.driving import (
    BROWSER,
    assert_same,
    exported,
    filled,
    made,
    text_of,
    typed,
    with_blocks,
)

WALKS, WAVES = "a person walks forward", "una persona saluda con la mano"
SLEEPS = "a person sleeps"
BOTH, OTHER = "walks one metre, then claps", "a person salutes with the left hand"  # mirrored


LIVE = (
    [WALKS] * 3
    + [WAVES] * 3
    + ["a person stands"] * 4
    + [WAVES] * 3
    + [SLEEPS] * 3
    + [WALKS] * 3
    + [BOTH] * 5
    + [OTHER] * 4
)


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
def test_what_is_said_while_a_piece_is_made_is_in_that_piece(browser: Browser) -> None:
    browser.wait("!studio.making")
    ask, say = "studio.client.call('live', {})", "studio.client.call('say', {})"
    first, then = ({"text": text, "seed": 3, "begin": True} for text in (WALKS, WAVES))
    late = [ask.format(json.dumps(first)), say.format(json.dumps({"text": WAVES}))]
    told = "[[...piece.root], piece.texts]"
    found = browser.evaluate(f"Promise.all([{', '.join(late)}]).then(([piece]) => {told})")
    wanted = browser.evaluate(f"{ask.format(json.dumps(then))}.then((piece) => {told})")
    assert found == wanted and set(wanted[1]) == {WAVES}


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
