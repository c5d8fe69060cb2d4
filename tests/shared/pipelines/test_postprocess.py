"""Settling: pieces of any length join to one motion, which is the post-processed one.

smooth_borders: no jump where known frames end, and nothing known moves.
"""

from functools import reduce
from itertools import pairwise

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from src.shared.config_schema import PostProcessingConfig
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.motion.features import LATERAL, LEFT_CONTACT, ROOT_ROW, YAW_RATE, encode_features
from src.shared.motion.foot_holds import GIVE
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess import MotionPostProcessor
from src.shared.motion.skeleton import FOOT_JOINTS
from src.shared.pipelines.postprocess import (
    FADE,
    Place,
    Settler,
    joined,
    settled,
    smooth_borders,
    soften_cuts,
)
from tests.shared.model.conftest import tiny_generator

PLACE = Place(1.0, -2.0, 0.7)
LABELS = {"action": "walk", "direction": "forward", "speed": "normal"}
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
    settler = Settler(config, fps=30.0, place=PLACE)
    pieces, at = [], 0
    for size in [*sizes, len(features)]:
        mask = None if known is None else known[at : at + size]
        pieces.append(settler.add(features[at : at + size], mask))
        at += size
    pieces.append(settler.finish())
    found = [piece for piece in pieces if piece is not None]
    return reduce(joined, found), found


def assert_same(one: Motion, other: Motion, atol: float = 2e-5) -> None:
    np.testing.assert_allclose(one.positions(), other.positions(), atol=atol)
    np.testing.assert_array_equal(one.contacts, other.contacts)


@settings(max_examples=8)
@given(sizes=st.lists(st.integers(1, 40), max_size=12))
def test_without_foot_lock_pieces_are_the_whole(walk: torch.Tensor, sizes: list[int]) -> None:
    whole = MotionPostProcessor(SMOOTH)(
        walk, fps=30.0, start_position=(PLACE.x, PLACE.z), start_heading=PLACE.heading
    )
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


def test_known_entries_and_legs_stay(walk: torch.Tensor) -> None:
    known = torch.zeros(walk.shape, dtype=torch.bool)
    known[30:50] = True
    motion, _ = in_pieces(walk, [37], LOCKED, known)
    made = encode_features(motion)[30:49]
    torch.testing.assert_close(made[:, :ROOT_ROW], walk[30:49, :ROOT_ROW], rtol=0, atol=1e-3)


def test_lookahead_is_kept(walk: torch.Tensor) -> None:
    settler = Settler(LOCKED, fps=30.0)
    given = 0
    for frame in range(len(walk)):
        piece = settler.add(walk[frame : frame + 1])
        given += 0 if piece is None else piece.num_frames
        assert frame + 1 - given <= settler.lookahead


def test_nothing_and_everything(walk: torch.Tensor) -> None:
    assert Settler(LOCKED, fps=30.0).finish() is None
    one = settled(tiny_generator(), walk[:1])
    assert one.num_frames == 1 and one.root_position[0, 0] == 0


SHAPE = (23, 6)


def ramp(frames: int, jump: float = 0.0, at: int = 0) -> torch.Tensor:
    """A steady motion of 0.01 a frame that jumps once."""
    values = 0.01 * torch.arange(frames)[:, None, None].expand(-1, *SHAPE).clone()
    values[at:] += jump
    return values


def prefix(frames: int, known: int) -> torch.Tensor:
    mask = torch.zeros(frames, *SHAPE, dtype=torch.bool)
    mask[:known] = True
    return mask


@given(jump=st.floats(-0.5, 0.5), known=st.integers(2, 20), frames=st.integers(31, 60))
def test_a_jump_is_taken_up(jump: float, known: int, frames: int) -> None:
    """The step across the border is that of its neighbours; the fade is spread over `FADE`."""
    features = ramp(frames, jump, at=known)
    smooth = smooth_borders(features, prefix(frames, known))
    motion = torch.ones(SHAPE, dtype=torch.bool)
    motion[ROOT_ROW, LEFT_CONTACT:] = False
    torch.testing.assert_close(smooth[:known], features[:known])
    torch.testing.assert_close(smooth[:, ~motion], features[:, ~motion])
    end = known + FADE
    torch.testing.assert_close(smooth[end:], features[end:])
    moving = smooth[:, motion]
    step = (moving[known] - moving[known - 1]).max()
    assert abs(float(step) - 0.01) < 1e-4
    assert float((moving.diff(dim=0) - 0.01).abs().max()) <= abs(jump) * 2.2 / FADE + 1e-5


def test_both_ends_of_a_gap_meet() -> None:
    features = ramp(60)
    features[20:40] += 0.3
    mask = torch.ones(60, *SHAPE, dtype=torch.bool)
    mask[20:40] = False
    smooth = smooth_borders(features, mask)
    steps = smooth[:, 3, 2].diff()
    assert float(steps[[19, 39]].sub(0.01).abs().max()) < 1e-4
    assert float((smooth - ramp(60))[:20].abs().max()) < 1e-6
    torch.testing.assert_close(smooth[29:31], features[29:31], rtol=0, atol=0.01)


@given(
    st.lists(st.booleans(), min_size=1, max_size=30),
    st.integers(0, 2**32),
)
def test_known_entries_stay_and_all_is_finite(mask: list[bool], seed: int) -> None:
    """Any pattern, single frames and single free frames among them."""
    features = torch.randn(len(mask), *SHAPE, generator=torch.Generator().manual_seed(seed))
    known = torch.tensor(mask)[:, None, None].expand(-1, *SHAPE).clone()
    known[:, 5, 2] = False
    smooth = smooth_borders(features, known)
    assert torch.isfinite(smooth).all()
    torch.testing.assert_close(smooth[known], features[known])
    torch.testing.assert_close(smooth[:, 5, 2], features[:, 5, 2])


def test_nothing_known_changes_nothing() -> None:
    features = torch.randn(20, *SHAPE)
    torch.testing.assert_close(smooth_borders(features, prefix(20, 0)), features)
    torch.testing.assert_close(smooth_borders(features, prefix(20, 20)), features)


def test_cuts_are_softened_and_the_rest_is_left_alone() -> None:
    """A corner at frame 40 becomes a curve; contacts and far frames stay to the bit."""
    line = torch.arange(80.0)
    corner = torch.where(line < 40, line, 80 - line) / 30
    features = corner[:, None, None].repeat(1, ROOT_ROW + 1, 6)
    soft = soften_cuts(features, [40])
    change = (soft[2:] - 2 * soft[1:-1] + soft[:-2]).abs()
    before = (features[2:] - 2 * features[1:-1] + features[:-2]).abs()
    assert change[:, :ROOT_ROW].max() < 0.4 * before.max()
    assert torch.equal(soft[:, ROOT_ROW, LEFT_CONTACT:], features[:, ROOT_ROW, LEFT_CONTACT:])
    assert torch.equal(soft[:24], features[:24]) and torch.equal(soft[56:], features[56:])
    assert soften_cuts(features, []) is features
