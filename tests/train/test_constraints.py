"""Random masks of training: every kind occurs, none leaves the clip."""

import numpy as np
import pytest
import torch

from src.shared.config_schema import ConstraintShares
from src.shared.motion.features import FORWARD, HEIGHT, LEFT_CONTACT, ROOT_ROW, YAW_RATE
from src.shared.motion.skeleton import NUM_JOINTS
from src.train.constraints import draw_known

NOTHING = dict.fromkeys(ConstraintShares.model_fields, 0)


def masks(clips: int = 64, frames: int = 60, **shares: float) -> torch.Tensor:
    real = torch.ones(clips, frames, dtype=torch.bool)
    chosen = ConstraintShares(**(NOTHING | shares))
    return draw_known(real, ROOT_ROW + 1, chosen, np.random.default_rng(0))


def test_free_clips_know_nothing():
    assert not masks(free=1, root=1, start=1, joints=1).any()
    assert not masks().any()
    share = masks(200, free=0.5, start=1).flatten(1).any(1).float().mean()
    assert 0.35 < share < 0.65


def test_padding_is_never_known():
    real = torch.arange(60) < torch.randint(20, 60, (32, 1))
    shares = ConstraintShares(free=0)
    assert not draw_known(real, 23, shares, np.random.default_rng(0))[~real].any()


def test_starts_and_ends_are_whole_frames():
    whole = masks(start=1, end=1).flatten(2)
    assert torch.equal(whole.any(2), whole.all(2))
    frames = whole.all(2)
    assert frames[:, 0].all() and frames[:, -1].all()
    gaps = (frames[:, 1:].int() - frames[:, :-1].int()).abs().sum(1)
    assert (gaps == 2).any() and (gaps <= 2).all()  # one gap between the two


def test_the_root_row_is_pinned_alone():
    known = masks(root=1)
    assert not known[:, :, 1:NUM_JOINTS].any()
    row = known[:, :, ROOT_ROW]
    path, heading = row[..., FORWARD].any(1), row[..., YAW_RATE].any(1)
    assert (path | heading).all()
    assert path.float().mean() > 0.6 and heading.float().mean() > 0.6
    assert (path & ~heading).any() and (heading & ~path).any()
    assert 0.1 < row[..., HEIGHT].any(1).float().mean() < 0.9
    assert not row[..., LEFT_CONTACT:].any()


def test_joints_are_done_again_within_one_span():
    known = masks(joints=1)
    unknown = ~known.flatten(2).all(2)  # B T
    edges = unknown.int().diff(dim=1).abs().sum(1)
    assert (edges <= 2).all() and unknown.any(1).all()
    whole = (~known[:, :, 0]).flatten(1).any(1)  # the pelvis is free where the whole body is
    assert whole.any() and not whole.all()


def test_contacts_are_given_by_themselves():
    known = masks(contacts=1)
    assert not known[:, :, :NUM_JOINTS].any() and not known[:, :, ROOT_ROW, :LEFT_CONTACT].any()
    assert known[:, :, ROOT_ROW, LEFT_CONTACT:].flatten(1).any(1).all()


@pytest.mark.parametrize("frames", [1, 2, 8])
def test_short_clips(frames: int):
    real = torch.ones(64, frames, dtype=torch.bool)
    known = draw_known(real, 23, ConstraintShares(free=0), np.random.default_rng(0))
    assert known.shape == (64, frames, 23, 6) and known.any()
