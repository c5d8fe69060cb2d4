"""Requests: validation of what a user asks for, streams of noise, batches."""

import math

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UserError
from src.shared.model.generation.constraint import SampleRequest, batches, make_requests

DEFAULTS = {
    "seconds": 1.0,
    "tags": None,
    "known_tags": ("walk", "jump"),
    "num_samples": 1,
    "seed": 0,
    "fps": 30.0,
}


def make(prompts: list[str], **changes: object) -> list[SampleRequest]:
    return make_requests(prompts, **{**DEFAULTS, **changes})


def test_prompt_major_order_lengths_and_tags():
    requests = make(["a", "b"], num_samples=2, seconds=[1, 2.5], tags=["jump", None])
    assert [r.prompt for r in requests] == ["a", "a", "b", "b"]
    assert [r.frames for r in requests] == [30, 30, 75, 75]
    assert [r.tag for r in requests] == [1, 1, 2, 2]


def test_noise_depends_on_seed_prompt_and_sample_only():
    alone = make(["b"], num_samples=2, seed=4)
    among = make(["a", "b", "c"], num_samples=3, seed=4)
    for sample in range(2):
        assert torch.equal(
            alone[sample].noise().normal((9, 2)), among[3 + sample].noise().normal((9, 2))
        )
    streams = {r.stream for r in [*among, *make(["a", "b"], seed=5)]}
    assert len(streams) == 11


def test_a_prompt_given_twice_gets_two_motions():
    first, second = make(["a", "a"])
    assert not torch.equal(first.noise().normal((4,)), second.noise().normal((4,)))


@given(
    lengths=st.lists(st.integers(8, 12), min_size=1, max_size=20),
    size=st.integers(1, 5),
    equal=st.booleans(),
    apart=st.booleans(),
)
def test_batches_hold_every_request_once(lengths: list[int], size: int, equal: bool, apart: bool):
    requests = [SampleRequest("a", frames, 0, (0, 0, 0)) for frames in lengths]
    kinds = [frames % 3 for frames in lengths] if apart else None
    found = list(batches(requests, size, equal_lengths=equal, kinds=kinds))
    assert sorted(index for batch in found for index in batch) == list(range(len(lengths)))
    for batch in found:
        assert 0 < len(batch) <= size
        if equal:
            assert len({lengths[index] for index in batch}) == 1
        if kinds:
            assert len({kinds[index] for index in batch}) == 1


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"prompts": []}, "no prompt given"),
        ({"prompts": "walk"}, "give a list"),
        ({"num_samples": 0}, "num-samples 0"),
        ({"seed": -1}, "seed -1"),
        ({"seconds": 0.1}, "seconds 0.1 is too short"),
        ({"seconds": math.nan}, "not a number"),
        ({"seconds": [1.0, 2.0]}, "seconds has 2 entries for 1 prompts"),
        ({"tags": ["wlak"]}, "did you mean 'walk'"),
        ({"tags": ["walk"], "known_tags": ()}, "not one this model was trained with"),
        ({"tags": ["walk", "jump"]}, "tags has 2 entries"),
    ],
)
def test_mistakes_are_one_line(changes: dict[str, object], message: str):
    arguments = {"prompts": ["a"], **DEFAULTS, **changes}
    with pytest.raises(UserError, match=message) as caught:
        make_requests(**arguments)
    assert "\n" not in str(caught.value)
