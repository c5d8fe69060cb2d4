"""Generation losses against plain NumPy-like recomputation, masks, and their gradients."""

import pytest
import torch

from src.shared.config_schema import DiffusionConfig, LossWeights
from src.shared.errors import UsageError
from src.shared.model.diffusion import GaussianDiffusion
from src.shared.model.generation.losses import GenerationLoss
from src.shared.motion.features import ROOT_ROW, decode_features, encode_features
from src.shared.motion.rotations import (
    matrix_to_rotation_6d,
    quaternion_exp,
    quaternion_to_matrix,
)
from src.shared.motion.skeleton import FOOT_JOINTS

TERMS = (
    "reconstruction",
    "velocity",
    "root",
    "movement",
    "geodesic",
    "position",
    "foot_contact",
    "foot_slide",
)
B, T = 2, 10


def motion(seed: int = 0) -> torch.Tensor:
    """Raw features [B, T, 23, 6] of smooth random motion, feet on the ground now and then."""
    generator = torch.Generator().manual_seed(seed)
    start = torch.randn(B, 1, 22, 3, generator=generator) * 0.3
    drift = torch.randn(B, 1, 22, 3, generator=generator) * 0.02
    vectors = start + drift * torch.arange(T)[:, None, None]
    rotations = matrix_to_rotation_6d(quaternion_to_matrix(quaternion_exp(vectors)))
    root = torch.rand(B, T, 1, 6, generator=generator)
    root[..., 4:] = root[..., 4:].round()
    return torch.cat([rotations, root], dim=2)


def losses(weights: dict[str, float], prediction: str = "sample", **options) -> GenerationLoss:
    diffusion = GaussianDiffusion(DiffusionConfig(prediction_type=prediction, clip_sigma=None))
    weights = {"reconstruction": 0.0, **weights}
    mean, std = options.pop("statistics", (torch.full((23, 6), 0.1), torch.full((23, 6), 0.7)))
    return GenerationLoss(LossWeights(**weights), diffusion, mean, std, **options)


def run(loss: GenerationLoss, predicted: torch.Tensor, true: torch.Tensor, mask=None):
    """The terms for raw predicted and true features, handed over as the network's output."""
    clean, guess = (true - loss.mean) / loss.std, (predicted - loss.mean) / loss.std
    noise = torch.randn_like(clean)
    timesteps = torch.tensor([3, 400])
    noisy = loss.diffusion.q_sample(clean, timesteps, noise)
    if loss.diffusion.config.prediction_type == "sample":
        output = guess
    else:
        eps = (noisy - loss.diffusion.sqrt_alphas_cumprod[timesteps].view(-1, 1, 1, 1) * guess) / (
            loss.diffusion.sqrt_one_minus_alphas_cumprod[timesteps].view(-1, 1, 1, 1)
        )
        output = eps
    return loss(output, clean, noisy, noise, timesteps, mask)


@pytest.mark.parametrize("term", TERMS[:7])
@pytest.mark.parametrize("prediction", ["sample", "epsilon"])
def test_a_perfect_prediction_costs_nothing(term: str, prediction: str):
    terms = run(losses({term: 1.0}, prediction), motion(), motion())
    assert terms["loss"].item() < 3e-3
    assert set(terms) == {"loss", term}


def test_only_what_has_a_weight_is_computed_and_the_sum_is_weighted():
    terms = run(losses({"velocity": 2.0, "position": 3.0}), motion(1), motion())
    assert set(terms) == {"loss", "velocity", "position"}
    assert terms["loss"] == pytest.approx((2 * terms["velocity"] + 3 * terms["position"]).item())
    assert run(losses({}), motion(1), motion())["loss"].item() == 0


@pytest.mark.parametrize("term", TERMS)
def test_padded_frames_do_not_matter(term: str):
    mask = torch.arange(T) < torch.tensor([[10], [6]])
    loss, true, predicted = losses({term: 1.0}), motion(), motion(1)
    torch.manual_seed(0)
    first = run(loss, predicted, true, mask)["loss"]
    padded = ~mask[..., None, None]
    torch.manual_seed(0)
    second = run(loss, predicted.masked_fill(padded, 5.0), true, mask)["loss"]
    assert first.item() == pytest.approx(second.item(), rel=1e-5)
    assert first.item() > 0


def test_velocity_is_the_error_of_differences():
    loss = losses({"velocity": 1.0})
    true, predicted = motion(), motion(1)
    steps = (predicted.diff(dim=1) - true.diff(dim=1)) / loss.std
    expected = steps.square().mean().item()
    assert run(loss, predicted, true)["velocity"].item() == pytest.approx(expected, rel=1e-4)
    shifted = run(loss, true + 0.3, true)["velocity"].item()
    assert shifted == pytest.approx(0, abs=1e-8)


def test_root_is_the_error_of_the_root_row_alone():
    loss, true = losses({"root": 1.0}), motion()
    predicted = motion(1)
    expected = ((predicted - true) / loss.std)[:, :, ROOT_ROW].square().mean().item()
    assert run(loss, predicted, true)["root"].item() == pytest.approx(expected, rel=1e-4)


def test_movement_weighs_small_clips_as_large_ones():
    loss, true = losses({"movement": 1.0}), motion()
    still = true.mean(1, keepdim=True)
    small = still + 0.7 * (true - still)
    frozen = [run(loss, still.expand_as(each), each)["movement"].item() for each in (true, small)]
    assert frozen == pytest.approx([1, 1], rel=1e-4)
    half = run(loss, still + 0.5 * (true - still), true)["movement"].item()
    assert half == pytest.approx(0.25, rel=1e-4)
    assert run(loss, true + 0.3, true)["movement"].item() == pytest.approx(0, abs=1e-6)


def test_geodesic_is_the_angle_in_radians():
    angle = 0.4
    axis = torch.tensor([0.0, 0.6, 0.8])
    turn = quaternion_to_matrix(quaternion_exp(angle * axis))
    true = motion()
    from src.shared.motion.rotations import rotation_6d_to_matrix

    turned = matrix_to_rotation_6d(rotation_6d_to_matrix(true[:, :, :22]) @ turn)
    predicted = torch.cat([turned, true[:, :, 22:]], dim=2)
    found = run(losses({"geodesic": 1.0}), predicted, true)["geodesic"].item()
    assert found == pytest.approx(angle, abs=1e-4)


def test_position_is_metric_and_sees_the_pelvis_height():
    true = motion()
    raised = true.clone()
    raised[:, :, ROOT_ROW, 2] += 0.3
    found = run(losses({"position": 1.0}), raised, true)["position"].item()
    assert found == pytest.approx(0.3**2 / 3, rel=1e-4)
    moved = true.clone()
    moved[:, :, ROOT_ROW, :2] += 1.0  # velocities are no pose
    assert run(losses({"position": 1.0}), moved, true)["position"].item() < 1e-8


def test_foot_slide_is_the_world_speed_of_standing_feet():
    predicted, true = motion(1), motion()
    fps = 30.0
    total, count = 0.0, 0
    for row in range(B):
        positions = decode_features(predicted[row]).positions()
        for side, (_, ball) in enumerate(FOOT_JOINTS):
            stands = true[row, :, ROOT_ROW, 4 + side] > 0.5
            speed = torch.tensor(positions[:, ball]).diff(dim=0) * fps
            both = stands[1:] & stands[:-1]
            total += speed.square().sum(dim=-1)[both].sum().item()
            count += int(both.sum())
    found = run(losses({"foot_slide": 1.0}), predicted, true)["foot_slide"].item()
    assert found == pytest.approx(total / count, rel=1e-3)


def test_foot_contact_is_on_the_raw_scale():
    true = motion()
    flipped = true.clone()
    flipped[:, :, ROOT_ROW, 4:] = 1 - flipped[:, :, ROOT_ROW, 4:]
    found = run(losses({"foot_contact": 1.0}), flipped, true)["foot_contact"].item()
    assert found == pytest.approx(1.0, rel=1e-5)


def test_gradients_are_finite_at_zero_output():
    loss = losses(dict.fromkeys(TERMS, 1.0), statistics=(torch.zeros(23, 6), torch.ones(23, 6)))
    clean = motion()
    output = torch.zeros_like(clean).requires_grad_()
    noise, timesteps = torch.randn_like(clean), torch.tensor([0, 999])
    noisy = loss.diffusion.q_sample(clean, timesteps, noise)
    with torch.autocast("cpu", torch.bfloat16):
        terms = loss(output, clean, noisy, noise, timesteps)
    terms["loss"].backward()
    assert terms["loss"].dtype == torch.float32
    assert torch.isfinite(output.grad).all()


def test_feet_need_the_root_track():
    statistics = (torch.zeros(22, 6), torch.ones(22, 6))
    with pytest.raises(UsageError, match=r"losses.foot-slide needs root-track"):
        losses({"foot_slide": 1.0}, statistics=statistics)
    loss = losses({"position": 1.0, "geodesic": 1.0}, statistics=statistics)
    assert run(loss, motion(1)[:, :, :22], motion()[:, :, :22])["position"].item() > 0


def test_the_test_motions_survive_encoding():
    decoded = decode_features(motion()[0])
    assert encode_features(decoded).shape == (T, 23, 6)
