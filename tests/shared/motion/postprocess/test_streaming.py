"""Pieces of any length join to one motion, which is the post-processed one."""

from functools import reduce
from itertools import pairwise

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.config_schema import PostProcessingConfig
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.metrics.physical import foot_jump
from src.shared.motion.features import LATERAL, ROOT_ROW, YAW_RATE, Place, encode_features
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.contacts import GIVE
from src.shared.motion.postprocess.stitching import joined
from src.shared.motion.postprocess.streaming import Course, StreamingPostProcessor
from src.shared.motion.postprocess.whole import MotionPostProcessor
from src.shared.motion.skeleton import FOOT_JOINTS
from tests.shared.model.conftest import tiny_generator

PLACE = Place(1.0, -2.0, 0.7)
LABELS = {"action": "walk", "direction": "forward", "speed": "normal"}
CROUCH = {"action": "crouch-walk", "direction": "forward", "speed": "slow"}
SMOOTH = PostProcessingConfig(smoothing_kernel=5, max_velocity=6.0)
LOCKED = PostProcessingConfig(smoothing_kernel=3, foot_lock=True)


@pytest.fixture(scope="module")
def walk() -> torch.Tensor:
    """A walk that slides sideways and turns."""
    features = encode_features(generate_clip(spec_for(LABELS, 3), 3))[:100].clone()
    features[:, ROOT_ROW, LATERAL] += 0.15
    features[:, ROOT_ROW, YAW_RATE] += 0.6
    return features


def in_pieces(
    features: torch.Tensor, sizes: list[int], config: PostProcessingConfig, known=None
) -> tuple[Motion, list[Motion]]:
    processor = StreamingPostProcessor(MotionPostProcessor(config), place=PLACE)
    pieces, at = [], 0
    for size in [*sizes, len(features)]:
        mask = None if known is None else known[at : at + size]
        pieces.append(processor.add(features[at : at + size], mask))
        at += size
    pieces.append(processor.finish())
    found = [piece for piece in pieces if piece is not None]
    return reduce(joined, found), found


def assert_same(one: Motion, other: Motion, atol: float = 2e-5) -> None:
    np.testing.assert_allclose(one.positions(), other.positions(), atol=atol)
    np.testing.assert_array_equal(one.contacts, other.contacts)


@settings(max_examples=8)
@given(sizes=st.lists(st.integers(1, 40), max_size=12))
def test_without_foot_lock_pieces_are_the_whole(walk: torch.Tensor, sizes: list[int]) -> None:
    whole = MotionPostProcessor(SMOOTH)(walk, place=PLACE)
    motion, _ = in_pieces(walk, sizes, SMOOTH)
    assert_same(motion, whole)


@settings(max_examples=8)
@given(sizes=st.lists(st.integers(1, 40), max_size=12))
def test_with_foot_lock_all_pieces_join_to_one_motion(walk: torch.Tensor, sizes: list[int]) -> None:
    one, _ = in_pieces(walk, [], LOCKED)
    other, pieces = in_pieces(walk, sizes, LOCKED)
    assert_same(other, one)
    for before, after in pairwise(pieces):
        assert ((before.quaternions[-1] * after.quaternions[0]).sum(-1) > 0).all()


def test_feet_are_held_across_blocks_without_a_jump(walk: torch.Tensor) -> None:
    """A slide of 15 cm/s is gone but for what a foot gives; accelerations stay in bounds."""
    loose, _ = in_pieces(walk, [], PostProcessingConfig(smoothing_kernel=3))
    held, _ = in_pieces(walk, [30, 30], LOCKED)
    balls = [ball for _, ball in FOOT_JOINTS]

    def slide(motion: Motion) -> float:
        speed = np.linalg.norm(np.diff(motion.positions()[:, balls][..., [0, 2]], axis=0), axis=-1)
        stands = held.contacts[:-1] * held.contacts[1:] > 0.5
        return float(30 * speed[stands].mean())

    assert slide(held) < min(1.5 * GIVE, 0.5 * slide(loose))
    sizes = [
        np.linalg.norm(np.diff(motion.positions(), 2, axis=0), axis=-1).max() * 900
        for motion in (loose, held)
    ]
    assert sizes[1] < 2.5 * sizes[0]


def test_a_foot_does_not_jump_to_a_hold_that_a_block_finds_late() -> None:
    """58 m/s² where the hold was there at once, 21 of the whole."""
    features = encode_features(generate_clip(spec_for(CROUCH, 18), 18))
    features[:, ROOT_ROW, :3] *= 1.3  # the body goes faster than its legs
    whole = foot_jump(MotionPostProcessor(LOCKED)(features))
    assert foot_jump(in_pieces(features, [10] * 20, LOCKED)[0]) < 2 * whole


def test_known_entries_and_legs_stay(walk: torch.Tensor) -> None:
    known = torch.zeros(walk.shape, dtype=torch.bool)
    known[30:50] = True
    motion, _ = in_pieces(walk, [37], LOCKED, known)
    made = encode_features(motion)[30:49]
    torch.testing.assert_close(made[:, :ROOT_ROW], walk[30:49, :ROOT_ROW], rtol=0, atol=1e-3)


def test_lookahead_is_kept(walk: torch.Tensor) -> None:
    processor = StreamingPostProcessor(MotionPostProcessor(LOCKED))
    given = 0
    for frame in range(len(walk)):
        piece = processor.add(walk[frame : frame + 1])
        given += 0 if piece is None else piece.num_frames
        assert frame + 1 - given <= processor.lookahead


def test_nothing_and_everything(walk: torch.Tensor) -> None:
    assert StreamingPostProcessor(MotionPostProcessor(LOCKED)).finish() is None
    processor = StreamingPostProcessor(tiny_generator().post_processor)
    pieces = [processor.add(walk[:1]), processor.finish()]
    [one] = [piece for piece in pieces if piece is not None]
    assert one.num_frames == 1 and one.root_position[0, 0] == 0


def test_a_course_is_kept_by_who_sways_and_strays_and_by_nobody_who_turns() -> None:
    time = np.arange(1800) / 30
    sways = np.radians(30) * np.cos(2 * np.pi * time)
    features = torch.zeros(len(time), ROOT_ROW + 1, 6)

    def headings(drift: float, *, kept: bool = True) -> np.ndarray:
        features[:, ROOT_ROW, YAW_RATE] = torch.as_tensor(sways + np.radians(drift))
        course, pieces = Course(30.0), features.split(7)
        led = torch.cat([course.add(piece, kept=kept) for piece in pieces])
        return np.degrees(led[:, ROOT_ROW, YAW_RATE].numpy().cumsum() / 30)

    strayed, led = headings(4.0, kept=False), headings(4.0)
    assert abs(strayed[-1] - 240.0) < 1 and np.abs(led).max() < 16
    np.testing.assert_allclose(np.ptp(led[-30:]), 60 / (2 * np.pi), rtol=0.05)  # the sway stays
    assert headings(45.0)[-1] > 45.0 * 60 - 30  # who turns
