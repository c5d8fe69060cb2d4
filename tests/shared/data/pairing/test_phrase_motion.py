"""Phrases out of clips: no jumps, beats that go on, and pieces that say where they come from."""

import numpy as np
import pytest

from src.shared.data.pairing.phrase_motion import SEAM_FRAMES, Piece, assemble, join
from src.shared.metrics.rhythm import motion_beats
from tests.shared.data.pairing.walkers import walker


def test_a_phrase_is_as_long_as_asked_and_does_not_jump() -> None:
    clips = [walker(f"walk-{n}", 0.5 + 0.01 * n, speed=1.1 + 0.02 * n) for n in range(6)]
    phrase = assemble(clips, np.full(6, 1 / 6), 500, np.random.default_rng(0))
    assert phrase.position.shape == (500, 3) and phrase.quaternion.shape == (500, 4)
    assert len(phrase.pieces) >= 3 and len(phrase.seams) == len(phrase.pieces) - 1
    step = np.linalg.norm(np.diff(phrase.position, axis=0), axis=1) * 30
    assert step.min() > 0.6 and step.max() < 1.7
    acceleration = np.linalg.norm(np.diff(phrase.position, 2, axis=0), axis=1) * 900
    assert acceleration.max() < 8
    assert np.allclose(np.linalg.norm(phrase.quaternion, axis=1), 1, atol=1e-4)


def test_motion_beats_go_on_over_seams() -> None:
    clips = [walker(f"walk-{n}", 0.5) for n in range(4)]
    phrase = assemble(clips, np.full(4, 0.25), 600, np.random.default_rng(1))
    intervals = np.diff(motion_beats(phrase.position).times)
    assert intervals == pytest.approx(np.full(len(intervals), 0.5), abs=0.05)


def test_pieces_rebuild_the_phrase() -> None:
    clips = {name: walker(name, 0.55) for name in ("a", "b", "c")}
    rng = np.random.default_rng(2)
    phrase = assemble(list(clips.values()), np.full(3, 1 / 3), 400, rng)
    again = join(phrase.pieces, lambda name: (clips[name].root, clips[name].tilt))
    assert np.array_equal(again.position, phrase.position)
    assert np.array_equal(again.quaternion, phrase.quaternion)
    for piece, following in zip(phrase.pieces[:-1], phrase.pieces[1:], strict=True):
        assert piece.at + piece.last - piece.first + 1 - SEAM_FRAMES == following.at


def test_one_clip_joined_with_itself_goes_on_walking() -> None:
    clip = walker("only", 0.5)
    phrase = assemble([clip], np.ones(1), 700, np.random.default_rng(0))
    assert {piece.clip for piece in phrase.pieces} == {"only"}
    assert phrase.position.shape == (700, 3)


def test_heading_is_carried_on() -> None:
    """The second piece goes on in the direction the first has turned to."""
    turned = walker("turns", 0.5)
    turned.root[:, 3] = 0.5  # rad/s
    straight = walker("straight", 0.5)
    straight.root[:, 3] = 0.0
    tracks = {c.id: (c.root, c.tilt) for c in (turned, straight)}
    first = Piece("turns", 0, 120, 0)
    phrase = join([first, Piece("straight", 0, 120, 121 - SEAM_FRAMES)], lambda n: tracks[n])
    step = phrase.position[-1] - phrase.position[-2]
    angle = np.arctan2(step[0], step[2])
    assert angle == pytest.approx(0.5 * (121 - SEAM_FRAMES / 2) / 30, abs=0.1)
