"""TextJudge: the prompt decides first, feet and jerk among equals; towers load or say why not."""

from pathlib import Path

import numpy as np
import pytest
import torch
from torch import Tensor

from src.shared.config_space import AudioTowerConfig
from src.shared.errors import UserError
from src.shared.files import write_json
from src.shared.inference.text_judge import TextJudge, Tower, load_tower, own_tower
from src.shared.model import zoo
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.model.checkpoint import ModelCard
from src.shared.model.clip.core import MotionClip
from src.shared.model.clip.pretrained import ClipBundle
from src.shared.model.clip.tokenizer import PromptTokenizer
from src.shared.motion.motion import Motion
from src.shared.motion.root_track import encode_features
from src.shared.motion.skeleton import REST_PELVIS_HEIGHT
from tests.shared.model.conftest import CAPTIONS, tiny_network


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
    monkeypatch.setattr(zoo, "PRETRAINED", tmp_path)
    write_json(tmp_path / "evaluator" / "config.json", {"kind": "evaluator", "steps": 1})
    made = bundle()
    made.save_pretrained(tmp_path / "clip")
    assert own_tower(made.clip.text) is None, "a CLIP folder is no shared space"
    SharedSpace.beside(made, AudioTowerConfig()).save_pretrained(tmp_path / "space")
    assert own_tower(made.clip.text) is not None
    assert own_tower(bundle(1).clip.text) is None
