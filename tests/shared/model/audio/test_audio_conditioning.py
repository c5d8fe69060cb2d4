"""AudioConditioner, FiLM and the augmentation of conditions."""

import pytest
import torch

from src.shared.config_audio import AugmentationConfig
from src.shared.model.audio import BEAT, FEATURE_ROWS, GROUPS, with_phase_rows
from src.shared.model.audio.conditioning import AudioConditioner, ConditionAugmentation
from src.shared.model.audio.unet import FiLMLayer
from tests.shared.model.audio.tiny_audio import CONDITION, awake


def test_every_feature_row_reaches_the_output() -> None:
    """REF's class forgets rms, centroid and onset (ruling 2)."""
    torch.manual_seed(0)
    conditioner = AudioConditioner(CONDITION)
    condition = torch.randn(1, 167, 12, requires_grad=True)
    out = conditioner(condition)
    assert out.shape == (1, CONDITION.dim, 12)
    out.square().sum().backward()
    assert condition.grad is not None and (condition.grad[0].abs().sum(dim=-1) > 0).all()


def test_groups_cover_all_rows_once() -> None:
    rows = [row for group in GROUPS.values() for row in range(group.start, group.stop)]
    assert rows == list(range(167))


def test_phases_left_out_are_zero() -> None:
    condition = with_phase_rows(torch.ones(1, FEATURE_ROWS, 3))
    assert condition.shape == (1, 167, 3) and not condition[:, BEAT].any()


def test_film_starts_as_the_identity_and_splits_into_two_halves() -> None:
    film, h, condition = FiLMLayer(6, 4), torch.randn(2, 6, 9), torch.randn(2, 4, 9)
    torch.testing.assert_close(film(h, condition), h)
    awake(film)
    gamma, beta = film.gamma_beta(condition).chunk(2, dim=1)
    torch.testing.assert_close(film(h, condition), (1 + gamma) * h + beta)


def augmentation(**values: float) -> ConditionAugmentation:
    off = {"noise": 0.0, "group_dropout": 0.0, "condition_dropout": 0.0}
    return ConditionAugmentation(AugmentationConfig(**{**off, **values}))


def test_augmentation_is_for_training_only() -> None:
    augment = augmentation(noise=1.0, group_dropout=0.9, condition_dropout=0.9).eval()
    condition = torch.randn(4, 167, 8)
    torch.testing.assert_close(augment(condition), condition)
    assert augment.draw_drop(4) is None
    assert augmentation().train().draw_drop(4) is None


def test_noise_spares_the_phases_and_has_the_size_it_says() -> None:
    condition = torch.zeros(8, 167, 50)
    out = augmentation(noise=0.3).train()(condition, torch.Generator().manual_seed(0))
    assert out[:, :FEATURE_ROWS].std() == pytest.approx(0.3, rel=0.02)
    assert not out[:, FEATURE_ROWS:].any()


def test_dropped_groups_are_zero_for_the_whole_window() -> None:
    augment = augmentation(group_dropout=0.4).train()
    out = augment(torch.ones(500, 167, 3), torch.Generator().manual_seed(0))
    shares = []
    for rows in GROUPS.values():
        group = out[:, rows].flatten(1)
        assert (group.min(dim=1).values == group.max(dim=1).values).all()
        shares.append(float((group == 0).all(dim=1).float().mean()))
    assert shares == pytest.approx([0.4] * 5, abs=0.08)


def test_augmentation_repeats_with_its_generator() -> None:
    augment = augmentation(noise=0.1, group_dropout=0.3, condition_dropout=0.5).train()
    condition = torch.randn(6, 163, 10)
    runs = []
    for _ in range(2):
        generator = torch.Generator().manual_seed(7)
        runs.append((augment(condition, generator), augment.draw_drop(6, generator)))
    torch.testing.assert_close(runs[0], runs[1])
