"""Ranking: weights, ties, failed checks, and distance from those already chosen.

TextJudge: the prompt decides first, feet and jerk among equals; towers load or say why not.

AudioJudge: beats and sanity decide, and a broken candidate comes last.
"""

import json
from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pydantic import ValidationError
from torch import Tensor

from src.shared.config_audio import AudioTowerConfig
from src.shared.errors import UserError
from src.shared.io.files import write_json
from src.shared.model import checkpoint
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip
from src.shared.model.clip.pretrained import ClipBundle
from src.shared.model.clip.tokenizer import PromptTokenizer
from src.shared.motion.features import encode_features
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import REST_PELVIS_HEIGHT
from src.shared.motion.trajectory import MotionTrajectory
from src.shared.pipelines.ranking import (
    AudioJudge,
    SelectionConfig,
    TextJudge,
    Tower,
    distances,
    load_tower,
    on_the_beat,
    own_tower,
    rank,
)
from tests.shared.model.conftest import CAPTIONS, tiny_network

UNIT = st.floats(0, 1)
NONE = SelectionConfig(distance=0)


def line(places: list[float]) -> np.ndarray:
    """Motions of one point that stands still at each place."""
    points = np.zeros((len(places), 4, 1, 3))
    points[..., 0] = np.array(places)[:, None, None]
    return points


def test_the_score_is_the_weighted_mean_of_the_terms_there_are() -> None:
    terms = {"similarity": np.array([0.2, 0.8]), "feet": np.array([1.0, 0.0])}
    config = SelectionConfig(similarity=3, feet=1, smoothness=100)
    table = rank(terms, np.zeros(2), distances(line([0, 0]), 1.0), config)
    np.testing.assert_allclose(table.score, [(3 * 0.2 + 1) / 4, 3 * 0.8 / 4])
    assert table.best == 1 and table.weights == {"similarity": 3, "feet": 1, "distance": 0.25}


def test_a_failed_check_outweighs_every_term() -> None:
    terms = {"sanity": np.array([1.0, 0.0, 1.0]), "beats": np.array([1.0, 0.0, 1.0])}
    table = rank(terms, np.array([1, 0, 2]), distances(line([0, 0, 0]), 1.0))
    assert table.order.tolist() == [1, 0, 2]


def test_equal_candidates_keep_their_order_and_nan_is_nothing() -> None:
    terms = {"beats": np.array([np.nan, 0.5, 0.5, 0.0])}
    table = rank(terms, np.zeros(4), distances(line([0, 0, 0, 0]), 1.0))
    assert table.order.tolist() == [1, 2, 0, 3]


def test_later_choices_look_for_what_is_far_from_the_chosen() -> None:
    terms = {"similarity": np.array([0.9, 0.89, 0.8, 0.5])}
    far = distances(line([0.0, 0.01, 3.0, 3.01]), 1.0)
    assert rank(terms, np.zeros(4), far, NONE).order.tolist() == [0, 1, 2, 3]
    table = rank(terms, np.zeros(4), far, SelectionConfig(distance=0.25))
    assert table.order.tolist() == [0, 2, 1, 3]
    assert table.distance[2] == pytest.approx(1 - np.exp(-3.0))
    assert table.distance[1] == pytest.approx(1 - np.exp(-0.01))


def test_rows_are_json_best_first() -> None:
    terms = {"similarity": np.array([0.25, 0.75])}
    rows = rank(terms, np.zeros(2), distances(line([0, 1]), 1.0)).rows()
    assert json.loads(json.dumps(rows))[0] == {
        "rank": 1, "sample": 1, "score": 0.75, "failed": 0, "similarity": 0.75, "distance": None
    }  # fmt: skip
    assert rows[1]["distance"] == pytest.approx(1 - np.exp(-1), abs=1e-6)


@given(arrays(float, st.integers(1, 8), elements=UNIT), st.data())
def test_ranking_is_a_greedy_permutation(values: np.ndarray, data: st.DataObject) -> None:
    places = data.draw(st.lists(st.floats(-5, 5), min_size=len(values), max_size=len(values)))
    weight = data.draw(st.floats(0, 2))
    far = distances(line(places), 1.0)
    table = rank({"beats": values}, np.zeros(len(values)), far, SelectionConfig(distance=weight))
    order = table.order.tolist()
    assert sorted(order) == list(range(len(values)))
    assert values[order[0]] == values.max(), "distance never decides the first"
    for step in range(1, len(order)):  # by definition, each choice is the best of the rest
        gains = [values[i] + weight * min(far(j)[i] for j in order[:step]) for i in order[step:]]
        assert gains[0] == pytest.approx(max(gains))
        assert table.distance[order[step]] == pytest.approx(
            min(far(j)[order[step]] for j in order[:step])
        )


def test_distance_is_symmetric_saturating_and_looks_at_long_motions_sparsely() -> None:
    points = (
        np.random.default_rng(0).normal(size=(3, 1000, 2, 3)) + np.arange(3)[:, None, None, None]
    )
    far = distances(points, 0.5)
    matrix = np.stack([far(i) for i in range(3)])
    np.testing.assert_allclose(matrix, matrix.T)
    np.testing.assert_allclose(np.diag(matrix), 0)
    exact = np.linalg.norm(points[0] - points[1], axis=-1).mean()
    assert matrix[0, 1] == pytest.approx(1 - np.exp(-exact / 0.5), abs=0.01)
    assert distances(line([0, 1e9]), 1.0)(0)[1] == 1.0


def test_weights_are_not_negative() -> None:
    with pytest.raises(ValidationError):
        SelectionConfig(beats=-1)


def walking(
    frames: int = 60, *, slide: float = 0.0, sunk: float = 0.0, shake: float = 0.0
) -> Motion:
    """The rest pose: gliding along at m/s, sunk by metres, shaken by radians at the shoulders."""
    quaternions = np.zeros((frames, 22, 4), dtype=np.float32)
    angle = shake * np.random.default_rng(0).normal(size=frames) / 2
    quaternions[..., 0] = 1
    quaternions[:, 16, 0], quaternions[:, 16, 3] = np.cos(angle), np.sin(angle)
    position = np.zeros((frames, 3), dtype=np.float32)
    position[:, 1] = REST_PELVIS_HEIGHT - sunk
    position[:, 2] = np.arange(frames) * slide / 30
    return Motion(quaternions, position, np.ones((frames, 2), dtype=np.float32))


def near(*cosines: float) -> Tower:
    """A tower whose motions lie at given cosines from the first axis."""
    found = torch.tensor(cosines)

    def tower(features: Tensor) -> Tensor:
        assert features.shape == (len(found), 60, 23, 6)
        return torch.stack([found, (1 - found**2).sqrt()], 1)

    return tower


PROMPT = torch.tensor([1.0, 0.0])


def test_feet_and_jerk_decide_where_there_is_no_tower() -> None:
    bodies = [walking(slide=0.2), walking(sunk=0.05), walking(shake=1.0), walking()]
    table = TextJudge().judge(bodies, PROMPT)
    assert table.best == 3 and set(table.terms) == {"feet", "smoothness"}
    expected = [(np.log(27 / 20) / np.log(3) + 1) / 2, 0.5, 1, 1]
    np.testing.assert_allclose(table.terms["feet"], expected, atol=1e-5)
    assert table.terms["smoothness"][2] == 0 and table.terms["smoothness"][3] == 1
    assert not table.failed.any()


def test_the_prompt_outweighs_the_feet() -> None:
    table = TextJudge(near(0.9, 0.3, -0.5)).judge([walking(slide=0.1), *[walking()] * 2], PROMPT)
    assert table.order.tolist() == [0, 1, 2]
    np.testing.assert_allclose(table.terms["similarity"], [0.9, 0.3, 0.0], atol=1e-6)


def test_a_motion_that_is_no_number_comes_last() -> None:
    lost = walking()
    lost.root_position[30] = np.nan
    table = TextJudge(near(0.99, 0.1)).judge([lost, walking()], PROMPT)
    assert table.order.tolist() == [1, 0] and table.failed.tolist() == [1, 0]


def bundle(seed: int = 0) -> ClipBundle:
    torch.manual_seed(seed)
    return ClipBundle(
        MotionClip(tiny_network()).eval(),
        PromptTokenizer.train(CAPTIONS, 400),
        torch.full((23, 6), 0.1),
        torch.full((23, 6), 0.5),
        ModelCard(kind="motion-clip", name="tiny", trained=True),
    )


def test_towers_come_from_clip_folders_and_shared_spaces(tmp_path: Path) -> None:
    made = bundle()
    made.save_pretrained(tmp_path / "clip")
    SharedSpace.beside(made, AudioTowerConfig()).save_pretrained(tmp_path / "space")
    features = encode_features(walking())[None]
    expected = made.clip.encode_motion((features - 0.1) / 0.5)
    for folder in ("clip", "space"):
        tower = load_tower(tmp_path / folder, made.clip.text)
        torch.testing.assert_close(tower(features), expected)
        with pytest.raises(UserError, match="another text tower"):
            load_tower(tmp_path / folder, bundle(1).clip.text)


def test_a_model_without_a_motion_tower_is_refused() -> None:
    with pytest.raises(UserError, match="no motion tower"):
        load_tower("starter", bundle().clip.text)


def test_the_shipped_space_is_found_by_its_text_tower(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoint, "PRETRAINED", tmp_path)
    write_json(tmp_path / "evaluator" / "config.json", {"kind": "evaluator", "steps": 1})
    made = bundle()
    made.save_pretrained(tmp_path / "clip")
    assert own_tower(made.clip.text) is None, "a CLIP folder is no shared space"
    SharedSpace.beside(made, AudioTowerConfig()).save_pretrained(tmp_path / "space")
    assert own_tower(made.clip.text) is not None
    assert own_tower(bundle(1).clip.text) is None


BEATS = np.arange(0.5, 8, 0.5)


def stopping(times: np.ndarray, frames: int = 240, heading: float = 0.0) -> MotionTrajectory:
    """A walk that slows down at these times."""
    clock = np.arange(frames) / 30
    near = np.exp(-((clock[:, None] - times) ** 2) / (2 * 0.06**2)).sum(axis=1)
    path = np.zeros((frames, 3))
    path[:, 2] = np.cumsum(1.0 - 0.8 * np.minimum(near, 1)) / 30
    path[:, 1] = 0.9
    turn = np.tile([np.cos(heading / 2), 0, np.sin(heading / 2), 0], (frames, 1))
    return MotionTrajectory.from_pose(path, turn, clock / 2)


def broken(trajectory: MotionTrajectory) -> MotionTrajectory:
    """The same with one sign flip of its orientation."""
    data = trajectory.data.copy()
    data[100, 9:13] *= -1
    return MotionTrajectory(data)


def test_on_the_beat_wins_and_a_broken_one_loses() -> None:
    on, off = stopping(BEATS), stopping(BEATS + 0.25)
    assert on_the_beat(on, BEATS) > 0.8 > 0.2 > on_the_beat(off, BEATS)
    assert on_the_beat(stopping(np.zeros(0)), BEATS) == 0
    table = AudioJudge().judge([off, broken(on), on], BEATS)
    assert table.order.tolist() == [2, 0, 1]
    assert table.failed.tolist() == [0, 1, 0]
    assert set(table.terms) == {"sanity", "beats"}


@pytest.mark.parametrize("unknown", [None, np.zeros(0)])
def test_without_beats_the_suite_decides(unknown: np.ndarray | None) -> None:
    noisy = stopping(BEATS)
    rough = noisy.position + np.random.default_rng(0).normal(0, 0.002, noisy.position.shape)
    trembling = MotionTrajectory.from_pose(rough, noisy.quaternion, noisy.phase_unwrapped)
    table = AudioJudge().judge([trembling, noisy], unknown)
    assert set(table.terms) == {"sanity"} and table.best == 1


def test_facing_elsewhere_on_one_path_is_a_distance() -> None:
    same, turned = stopping(BEATS), stopping(BEATS, heading=np.pi)
    judge = AudioJudge(config=SelectionConfig(distance=1.0))
    table = judge.judge([same, same, turned], BEATS)
    assert table.order.tolist() == [0, 2, 1]
    assert table.distance[2] == pytest.approx(1 - np.exp(-0.5)) and table.distance[1] == 0
