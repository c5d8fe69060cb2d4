"""The loss of ruling 20 against its formula and against plain InfoNCE."""

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from torch.nn.functional import cross_entropy, normalize

from src.shared.model.clip.core import clip_loss, cosine_alignment, multi_positive_info_nce


def embeddings(seed: int, size: int) -> tuple[torch.Tensor, torch.Tensor]:
    generator = torch.Generator().manual_seed(seed)
    text, motion = torch.randn(2, size, 6, generator=generator)
    return normalize(text, dim=-1), normalize(motion, dim=-1)


@given(seed=st.integers(0, 100), size=st.integers(2, 9))
def test_all_groups_different_is_the_symmetric_cross_entropy(seed: int, size: int):
    text, motion = embeddings(seed, size)
    scale = torch.tensor(7.0)
    logits = scale * text @ motion.T
    target = torch.arange(size)
    expected = (cross_entropy(logits, target) + cross_entropy(logits.T, target)) / 2
    found = multi_positive_info_nce(text, motion, target, scale)
    assert torch.allclose(found, expected, atol=1e-5)


@given(seed=st.integers(0, 100))
def test_formula_with_several_positives(seed: int):
    text, motion = embeddings(seed, 6)
    groups = torch.tensor([0, 0, 1, 2, 2, 2])
    similarity = 5 * text @ motion.T
    total = 0.0
    for matrix in (similarity, similarity.T):
        for i in range(6):
            negatives = matrix[i][groups != groups[i]].exp().sum()
            positives = matrix[i][groups == groups[i]]
            total += -(positives.exp() / (positives.exp() + negatives)).log().mean() / 12
    found = multi_positive_info_nce(text, motion, groups, torch.tensor(5.0))
    assert torch.allclose(found, total, atol=1e-5)


def test_one_group_has_no_negatives_and_finite_gradients():
    text, motion = embeddings(0, 4)
    text.requires_grad_()
    loss = multi_positive_info_nce(
        text, motion, torch.zeros(4, dtype=torch.long), torch.tensor(9.0)
    )
    loss.backward()
    assert loss.item() == 0
    assert torch.equal(text.grad, torch.zeros_like(text))


def test_positives_are_never_pushed_apart():
    """Bringing two clips of one group together never raises the loss through the other's text."""
    text, motion = embeddings(1, 4)
    groups = torch.tensor([0, 0, 1, 2])
    motion.requires_grad_()
    multi_positive_info_nce(text, motion, groups, torch.tensor(5.0)).backward()
    assert motion.grad is not None
    towards = (motion.grad[0] @ text[1]).item()
    alone = multi_positive_info_nce(text, motion, torch.arange(4), torch.tensor(5.0))
    pushed = torch.autograd.grad(alone, motion)[0][0] @ text[1]
    assert towards < pushed.item()


@given(seed=st.integers(0, 100))
def test_what_is_left_out_is_neither_right_nor_wrong(seed: int):
    text, motion = embeddings(seed, 5)
    groups, scale = torch.arange(5), torch.tensor(5.0)
    left_out = torch.zeros(5, 5, dtype=torch.bool)
    left_out[0, 1:] = left_out[1:, 0] = True  # the first is kin to all others
    found = multi_positive_info_nce(text, motion, groups, scale, left_out)
    rest = multi_positive_info_nce(text[1:], motion[1:], groups[1:], scale)
    assert torch.allclose(found, rest * 4 / 5, atol=1e-5)  # the first adds nothing


def test_cosine_and_total():
    text, motion = embeddings(2, 5)
    assert cosine_alignment(text, text).item() == pytest.approx(0, abs=1e-6)
    assert cosine_alignment(text, -text).item() == pytest.approx(2, abs=1e-6)
    parts = clip_loss(text, motion, torch.arange(5), torch.tensor(3.0), cosine_weight=0.5)
    assert parts["loss"] == parts["contrastive"] + 0.5 * parts["cosine"]
