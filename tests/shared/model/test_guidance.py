"""Guidance: the formula, one doubled forward, and what scales 0 and 1 cost."""

from dataclasses import dataclass
from typing import NamedTuple

import pytest
import torch
from torch import Tensor

from src.shared.config_schema import DiffusionConfig
from src.shared.model.diffusion import GaussianDiffusion, guided, join_conditions, with_condition


class Text(NamedTuple):
    pooled: Tensor
    mask: Tensor | None


@dataclass(frozen=True)
class Audio:
    frames: Tensor


class CountingModel:
    """Adds its condition to x; remembers the batch size of every call."""

    def __init__(self) -> None:
        self.batches: list[int] = []

    def __call__(self, x_t: Tensor, t: Tensor, text: Text, tag: Tensor | None = None) -> Tensor:
        self.batches.append(len(x_t))
        assert len(t) == len(x_t) == len(text.pooled)
        return 0.5 * x_t + text.pooled[:, None]


def conditions() -> tuple[dict[str, object], dict[str, object]]:
    real = {"text": Text(torch.full((3, 4), 2.0), None), "tag": torch.arange(3)}
    null = {"text": Text(torch.zeros(3, 4), None), "tag": torch.full((3,), 9)}
    return real, null


@pytest.mark.parametrize(
    ("scale", "added", "batch"), [(0, 0.0, 3), (1, 2.0, 3), (2.5, 5.0, 6), (0.5, 1.0, 6)]
)
def test_guidance_is_one_forward(scale: float, added: float, batch: int) -> None:
    model, x, t = CountingModel(), torch.randn(3, 8, 4), torch.tensor([1, 2, 3])
    output = guided(model, *conditions(), scale)(x, t)
    torch.testing.assert_close(output, 0.5 * x + added)
    assert model.batches == [batch]


def test_guidance_means_the_same_for_all_predictions() -> None:
    x_t, t = torch.randn(2, 10), torch.tensor([30, 60])
    results = []
    for prediction in ("epsilon", "sample", "v"):
        diffusion = GaussianDiffusion(
            DiffusionConfig.model_validate(
                {"timesteps": 100, "prediction_type": prediction, "clip_sigma": None}
            )
        )

        def model(x: Tensor, s: Tensor, x_0: Tensor, d: GaussianDiffusion = diffusion) -> Tensor:
            a, b = d.sqrt_alphas_cumprod[s, None], d.sqrt_one_minus_alphas_cumprod[s, None]
            return d.target(x_0, (x - a * x_0) / b, s)

        output = guided(model, torch.ones(2, 10), -torch.ones(2, 10), 3.0)(x_t, t)
        results.append(diffusion.predict_x0(output, x_t, t))
    for result in results:
        torch.testing.assert_close(result, torch.full((2, 10), 5.0), rtol=1e-4, atol=1e-4)


def test_guided_sampling_moves_towards_the_condition() -> None:
    diffusion = GaussianDiffusion(
        DiffusionConfig.model_validate({"timesteps": 50, "prediction_type": "sample"})
    )
    model = lambda x, t, c: c.expand_as(x)  # noqa: E731
    model_fn = guided(model, torch.ones(2, 1, 1), torch.zeros(2, 1, 1), 2.0)
    sample = diffusion.sample(model_fn, (2, 8, 6), num_steps=5)
    torch.testing.assert_close(sample, torch.full((2, 8, 6), 2.0))


def test_conditions_are_handed_over_by_kind() -> None:
    x, t = torch.zeros(1, 2), torch.tensor([0])
    assert with_condition(lambda x, t: "plain", None)(x, t) == "plain"  # type: ignore[arg-type,return-value]
    assert with_condition(lambda x, t, c: c, "third")(x, t) == "third"
    assert with_condition(lambda x, t, *, tag: tag, {"tag": "named"})(x, t) == "named"


def test_conditions_join_through_containers() -> None:
    one, two = torch.zeros(1, 3), torch.ones(1, 3)
    joined = join_conditions(
        {"a": (one, [one, None]), "b": Audio(one)}, {"a": (two, [two, None]), "b": Audio(two)}
    )
    expected = torch.cat((one, two))
    torch.testing.assert_close(joined["a"][0], expected)
    torch.testing.assert_close(joined["a"][1][0], expected)
    assert joined["a"][1][1] is None
    torch.testing.assert_close(joined["b"].frames, expected)


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        ({"a": None}, {"b": None}, "keys"),
        ((None,), (None, None), "parts"),
        (torch.zeros(1), None, "Tensor"),
        ("text", "text", "str"),
    ],
)
def test_conditions_that_differ_are_named(first: object, second: object, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        join_conditions(first, second)
