"""Random masks of training: every kind occurs, none leaves the clip, beats are the clip's own."""

import numpy as np
import pytest
import torch

from src.shared.config_schema import ConstraintShares
from src.shared.data.synthetic import generate_clip, sample_specs
from src.shared.motion.root_track import FORWARD, HEIGHT, LEFT_CONTACT, ROOT_ROW, encode_features
from src.shared.motion.skeleton import NUM_JOINTS
from src.train.constraints import clip_beats, draw_given, draw_known

NOTHING = {"free": 0, "root": 0, "start": 0, "end": 0, "frames": 0, "joints": 0, "beats": 0}


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
    assert row[..., FORWARD].any(1).all()
    for channel in (HEIGHT, LEFT_CONTACT):
        share = row[..., channel].any(1).float().mean()
        assert 0.1 < share < 0.9


def test_joints_are_done_again_within_one_span():
    known = masks(joints=1)
    unknown = ~known.flatten(2).all(2)  # B T
    edges = unknown.int().diff(dim=1).abs().sum(1)
    assert (edges <= 2).all() and unknown.any(1).all()
    whole = (~known[:, :, 0]).flatten(1).any(1)  # the pelvis is free where the whole body is
    assert whole.any() and not whole.all()


def test_given_beats_are_those_of_the_clip():
    specs = sample_specs(60, 0)
    walking = next(spec for spec in specs if spec.labels["action"] == "walk")
    features = encode_features(generate_clip(walking, seed=0))
    frames = len(features)
    padded = torch.zeros(1, frames + 7, *features.shape[1:])
    padded[0, :frames] = features
    real = (torch.arange(frames + 7) < frames)[None]
    shares = ConstraintShares(**(NOTHING | {"beats": 1}))
    given = draw_given(padded, real, shares, np.random.default_rng(0))
    beats = clip_beats(features, 30.0)
    assert len(beats) >= 2
    nearest = given.beats[0, (beats * 30).round().long(), 0]
    assert (nearest > 0.9).all()
    assert not given.beats[0, frames:].any() and not given.known.any()
    silent = ConstraintShares(**NOTHING)
    assert not draw_given(padded, real, silent, np.random.default_rng(0)).beats.any()


@pytest.mark.parametrize("frames", [1, 2, 8])
def test_short_clips(frames: int):
    motion = torch.zeros(4, frames, 23, 6)
    motion[:, :, :22, 0] = motion[:, :, :22, 4] = 1
    real = torch.ones(4, frames, dtype=torch.bool)
    shares = ConstraintShares(free=0, beats=1)
    given = draw_given(motion, real, shares, np.random.default_rng(0))
    assert given.known.shape == motion.shape and torch.isfinite(given.beats).all()
