"""The mannequin's mesh: closed, on the floor, symmetric, and it follows its joints."""

import numpy as np
import pytest

from src.shared.formats.mannequin import mannequin
from src.shared.motion.skeleton import JOINT_INDEX
from tests.shared.formats.mannequin_skin import skin


def test_the_skin_is_that_of_the_cones() -> None:
    for name, values in skin().items():
        np.testing.assert_allclose(getattr(mannequin(), name), values, atol=1e-5, err_msg=name)


def test_surface_is_closed_and_faces_outwards() -> None:
    body = mannequin()
    edges = body.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    forward, backward = {tuple(e) for e in edges.tolist()}, {tuple(e[::-1]) for e in edges.tolist()}
    assert len(forward) == len(edges)  # each directed edge once
    assert forward == backward  # and once the other way, by its neighbour: no holes
    a, b, c = (body.vertices[body.triangles[:, i]].astype(float) for i in range(3))
    faces = np.cross(b - a, c - a)
    volume = np.einsum("fi,fi->", a, faces) / 6
    assert 0.05 < volume < 0.08  # cubic metres: a person of 50 to 80 kg
    assert np.einsum("fi,fi->f", faces, body.normals[body.triangles].mean(1)).min() > 0


def test_proportions() -> None:
    body = mannequin()
    low, high = body.vertices.min(0), body.vertices.max(0)
    assert low[1] == pytest.approx(0.0, abs=0.01)
    assert 1.65 < high[1] < 1.85
    assert high[0] == pytest.approx(-low[0], abs=0.01)
    assert 1.6 < high[0] - low[0] < 1.9
    feet = body.vertices[body.vertices[:, 1] < 0.05]
    assert feet[:, 2].max() > 2 * -feet[:, 2].min()  # toes point to +Z


def test_weights_and_sides() -> None:
    body = mannequin()
    np.testing.assert_allclose(body.weights.sum(-1), 1.0, atol=1e-6)
    assert (body.weights >= 0).all()
    assert (np.diff(body.weights, axis=-1) <= 0).all()
    assert set(body.joints.ravel()) == set(range(22))
    hand = body.vertices[:, 0] > 0.74
    assert body.side[hand] == pytest.approx(1.0)
    assert (body.joints[hand, 0] == JOINT_INDEX["l_wrist"]).all()


def test_rest_pose_is_itself_and_a_turned_root_turns_everything() -> None:
    body = mannequin()
    still = np.tile(np.eye(3), (22, 1, 1))
    np.testing.assert_allclose(body.pose(body.rest, still)[0], body.vertices, atol=1e-5)
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])  # left, 90 degrees
    turned, normals = body.pose(body.rest @ turn.T, np.tile(turn, (22, 1, 1)))
    np.testing.assert_allclose(turned, body.vertices @ turn.T, atol=1e-5)
    np.testing.assert_allclose(normals, body.normals @ turn.T, atol=1e-5)
