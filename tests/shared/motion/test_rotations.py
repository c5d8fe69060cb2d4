"""Rotations against scipy and under property tests."""

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from src.shared.motion import rotations as rot


def random_matrices(seed: int, n: int = 64) -> tuple[Rotation, torch.Tensor]:
    oracle = Rotation.random(n, rng=np.random.default_rng(seed))
    return oracle, torch.tensor(oracle.as_matrix(), dtype=torch.float32)


def wxyz(oracle: Rotation) -> np.ndarray:
    q = oracle.as_quat()[:, [3, 0, 1, 2]]
    return q * np.where(q[:, :1] < 0, -1, 1)


@given(st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_quaternions_agree_with_scipy(seed: int) -> None:
    oracle, matrices = random_matrices(seed)
    q = rot.matrix_to_quaternion(matrices)
    np.testing.assert_allclose(q.numpy(), wxyz(oracle), atol=2e-6)
    np.testing.assert_allclose(rot.quaternion_to_matrix(q).numpy(), matrices, atol=2e-6)


@given(st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_six_d_round_trip_and_column_convention(seed: int) -> None:
    _, matrices = random_matrices(seed)
    d6 = rot.matrix_to_rotation_6d(matrices)
    assert torch.equal(d6[:, :3], matrices[:, :, 0])
    assert torch.equal(d6[:, 3:], matrices[:, :, 1])
    torch.testing.assert_close(rot.rotation_6d_to_matrix(d6 * 3.0), matrices, atol=1e-5, rtol=0)


@pytest.mark.parametrize(
    "d6",
    [
        [0.0] * 6,
        [1.0, 0, 0, 0, 0, 0],
        [1.0, 0, 0, 2, 0, 0],
        [0.0, 0, 0, 0, 1, 0],
        [1e-9] * 6,
        [0.0, 1, 0, 0, 1 + 1e-8, 0],
    ],
)
def test_degenerate_six_d_is_a_rotation_with_finite_gradient(d6: list[float]) -> None:
    x = torch.tensor(d6, requires_grad=True)
    matrix = rot.rotation_6d_to_matrix(x)
    torch.testing.assert_close(matrix @ matrix.T, torch.eye(3), atol=1e-5, rtol=0)
    assert torch.det(matrix).item() == pytest.approx(1, abs=1e-5)
    (rot.matrix_to_quaternion(matrix).sum() + matrix.sum()).backward()
    assert x.grad is not None and torch.isfinite(x.grad).all()


@given(st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_log_exp_and_product_agree_with_scipy(seed: int) -> None:
    a, _ = random_matrices(seed)
    b, _ = random_matrices(seed + 1)
    qa, qb = (torch.tensor(wxyz(r), dtype=torch.float32) for r in (a, b))
    np.testing.assert_allclose(rot.quaternion_log(qa).numpy(), a.as_rotvec(), atol=1e-5)
    torch.testing.assert_close(rot.quaternion_exp(rot.quaternion_log(qa)), qa, atol=1e-5, rtol=0)
    product = rot.quaternion_to_matrix(rot.quaternion_multiply(qa, qb))
    np.testing.assert_allclose(product.numpy(), (a * b).as_matrix(), atol=1e-5)


def test_slerp_meets_both_ends_and_halves_the_angle() -> None:
    oracle, _ = random_matrices(3, 2)
    q = torch.tensor(wxyz(oracle), dtype=torch.float32)
    half = rot.quaternion_slerp(q[:1], q[1:], torch.tensor([[0.5]]))
    for end in q:
        dot = (half * end).sum().abs()
        whole = (q[0] * q[1]).sum().abs()
        assert torch.acos(dot).item() == pytest.approx(torch.acos(whole).item() / 2, abs=1e-5)


def test_continuity_removes_sign_flips() -> None:
    q = torch.randn(1, 4).repeat(20, 1) + 0.01 * torch.randn(20, 4)
    q = q * torch.where(torch.rand(20, 1) < 0.5, -1.0, 1.0)
    smooth = rot.quaternion_continuous(q)
    assert (smooth[1:] * smooth[:-1]).sum(-1).min() > 0
    assert smooth[0, 0] >= 0


def test_heading_is_the_yaw_of_a_tilted_body() -> None:
    yaw = torch.linspace(-3, 3, 13)
    tilt = rot.axis_angle_to_matrix(0, torch.tensor(0.4)) @ rot.axis_angle_to_matrix(
        2, torch.tensor(0.3)
    )
    twist_free = rot.yaw_to_matrix(-rot.heading_angle(tilt)) @ tilt
    torch.testing.assert_close(
        rot.heading_angle(rot.yaw_to_matrix(yaw) @ twist_free), yaw, atol=1e-5, rtol=0
    )
