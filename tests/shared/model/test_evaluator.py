"""The judge: masks, saving, losses, text hashing, joint features."""

from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.errors import UserError
from src.shared.metrics.retrieval import caption_buckets
from src.shared.model.evaluator import (
    NUM_FEATURES,
    Evaluator,
    EvaluatorConfig,
    bag,
    joint_features,
)
from src.shared.motion.features import encode_features
from src.shared.motion.motion import Motion


def random_motion(num_frames: int, seed: int = 0) -> Motion:
    """Small random joint rotations around the rest pose, drifting forward."""
    rng = np.random.default_rng(seed)
    quaternions = np.zeros((num_frames, 22, 4), dtype=np.float32)
    quaternions[..., 0] = 1
    quaternions[..., 1:] = 0.1 * rng.normal(size=(num_frames, 22, 3))
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    root = np.cumsum(0.01 * rng.normal(size=(num_frames, 3)), axis=0)
    root[:, 1] += 0.95
    return Motion(quaternions, root.astype(np.float32), np.ones((num_frames, 2), np.float32))


@pytest.fixture(scope="module")
def evaluator() -> Evaluator:
    torch.manual_seed(0)
    return Evaluator(EvaluatorConfig(hidden_size=16, num_buckets=256)).eval()


def test_joint_features_are_the_kinematics_of_the_motion() -> None:
    motion = random_motion(12)
    (joints,) = joint_features([encode_features(motion)])
    assert joints.shape == (12, NUM_FEATURES)
    positions = torch.from_numpy(motion.positions())
    heights = joints[:, 0:1] + joints[:, 1:64].reshape(12, 21, 3)[..., 1]
    assert torch.allclose(heights, positions[:, 1:, 1], atol=1e-4)
    distance = joints[:, 1:64].reshape(12, 21, 3).norm(dim=-1)
    expected = (positions[:, 1:] - positions[:, :1]).norm(dim=-1)
    assert torch.allclose(distance, expected, atol=1e-4)
    with pytest.raises(ValueError, match="root track"):
        joint_features([torch.zeros(4, 22, 6)])


def test_joint_features_do_not_change_when_the_world_turns() -> None:
    motion = random_motion(10)
    yaw = torch.tensor([np.cos(0.6), 0.0, np.sin(0.6), 0.0], dtype=torch.float32)
    from src.shared.motion.rotations import quaternion_multiply, quaternion_to_matrix

    turned = motion.quaternions.copy()
    turned[:, 0] = quaternion_multiply(yaw, torch.from_numpy(motion.quaternions[:, 0])).numpy()
    root = motion.root_position @ quaternion_to_matrix(yaw).numpy().T
    other = Motion(turned, root.astype(np.float32), motion.contacts)
    ours, theirs = joint_features([encode_features(motion), encode_features(other)])
    assert torch.allclose(ours, theirs, atol=2e-3)


def test_padding_changes_nothing(evaluator: Evaluator) -> None:
    motions = [random_motion(length, length) for length in (17, 40, 33)]
    together = evaluator.embed_motion(motions)
    alone = torch.cat([evaluator.embed_motion([motion]) for motion in motions])
    assert together.shape == (3, 32)
    assert torch.allclose(together, alone, atol=1e-5)
    assert torch.allclose(together.norm(dim=-1), torch.ones(3), atol=1e-5)


def test_save_and_load_keep_embeddings_to_half_precision(
    evaluator: Evaluator, tmp_path: Path
) -> None:
    evaluator.save_pretrained(tmp_path / "judge", notes={"steps": 3})
    loaded = Evaluator.from_pretrained(tmp_path / "judge")
    prompts = ["a person walks", "una persona camina", "人が歩く", ""]
    assert torch.allclose(loaded.embed_text(prompts), evaluator.embed_text(prompts), atol=5e-3)
    assert len(loaded.content_hash) == 12


def test_loading_says_what_is_wrong(evaluator: Evaluator, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no evaluator"):
        Evaluator.from_pretrained(tmp_path / "absent")
    evaluator.save_pretrained(tmp_path)
    config = (tmp_path / "config.json").read_text(encoding="utf-8")
    (tmp_path / "config.json").write_text(config.replace('"hidden_size": 16', '"hidden_size": 8'))
    with pytest.raises(UserError, match="do not fit"):
        Evaluator.from_pretrained(tmp_path)
    (tmp_path / "config.json").write_text(config.replace('"hidden_size"', '"hidden"'))
    with pytest.raises(UserError, match="another version of this program made it") as error:
        Evaluator.from_pretrained(tmp_path)
    assert "pydantic" not in str(error.value)
    (tmp_path / "config.json").write_text(config.replace('"kind": "evaluator"', '"kind": "clip"'))
    with pytest.raises(UserError, match="'clip', not an evaluator"):
        Evaluator.from_pretrained(tmp_path)


def test_the_shipped_size_stays_small(tmp_path: Path) -> None:
    Evaluator().save_pretrained(tmp_path)
    assert (tmp_path / "model.safetensors").stat().st_size < 3_000_000


def test_hashed_captions_share_stems_and_tell_languages_apart() -> None:
    assert set(caption_buckets("walking slowly")) & set(caption_buckets("walks slow"))
    assert caption_buckets("Walk LEFT!") == caption_buckets("walk left")
    assert caption_buckets("左に歩く") != caption_buckets("右に歩く")
    assert caption_buckets("left then right") != caption_buckets("right then left")
    assert caption_buckets("...") == [0]
    indices, offsets = bag(["a walk", ""], 64)
    assert len(indices) == offsets[1] + 1 and int(indices.max()) < 64
