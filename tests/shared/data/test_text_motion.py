"""Gestures stay whole when they are made shorter, and only where their motion allows it."""

import pytest
import torch
from torch import Tensor

from src.shared.data.text_motion import comes_back, shorten
from src.shared.motion.features import FORWARD, ROOT_ROW


def wave(frames: int, cycles: int, *, travel: float = 0.0) -> Tensor:
    """A hand that goes up, swings so many times and comes down: [T,23,6]."""
    values = torch.zeros(frames, ROOT_ROW + 1, 6)
    t = torch.linspace(0, 1, frames)
    raised = (t * 8).clamp(max=1) * ((1 - t) * 8).clamp(max=1)
    values[:, 5, 0] = raised * 2
    values[:, 6, 1] = raised * torch.sin(2 * torch.pi * cycles * t)
    values[:, ROOT_ROW, FORWARD] = travel
    return values


def test_what_comes_back_is_told_from_what_goes_away():
    assert comes_back(wave(200, 5))
    assert not comes_back(wave(200, 5, travel=1.2))
    assert not comes_back(wave(200, 5)[:100])  # the hand is still up


@pytest.mark.parametrize("frames", [100, 120, 150, 190])
def test_a_shorter_wave_has_both_ends_and_no_jump(frames: int):
    long = wave(200, 5)
    short = shorten(long, frames)
    assert short is not None
    assert frames * 4 // 5 <= len(short) <= frames
    assert torch.equal(short[:8], long[:8])
    assert torch.equal(short[-8:], long[-8:])
    jumps = (short[1:] - short[:-1]).norm(dim=(1, 2))
    before = (long[1:] - long[:-1]).norm(dim=(1, 2))
    assert jumps.max() < 1.5 * before.max()


def test_nothing_is_joined_that_is_not_alike():
    torch.manual_seed(0)
    assert shorten(torch.randn(200, 23, 6), 120) is None
    assert shorten(wave(200, 5), 60) is None  # too little would be left
