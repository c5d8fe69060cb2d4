"""Choosing real clips and cutting them."""

from dataclasses import replace

import numpy as np
import pytest

from src.shared.data.prepare import open_data
from src.shared.data.prepared import ClipRecord, PreparedData
from src.shared.errors import UserError
from src.shared.evaluation.samples import (
    choose_caption,
    frozen_pose,
    real_clips,
    spread_over_groups,
)
from src.shared.motion.features import decode_features


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> PreparedData:
    return open_data("synthetic", tmp_path_factory.mktemp("data"), synthetic_clips=120)


def test_clips_carry_their_captions_and_stay_within_the_frames(data: PreparedData) -> None:
    clips = real_clips(data, data.records("train"), num=40, max_frames=64)
    assert len(clips) == 40 and max(clips.num_frames) <= 64
    assert all(clips.captions) and len(set(clips.groups)) >= 30
    again = real_clips(data, data.records("train"), num=40, max_frames=64)
    assert again.captions == clips.captions
    assert clips.rows([3, 3]).groups == [clips.groups[3]] * 2
    with pytest.raises(UserError, match="'xx' caption"):
        real_clips(data, data.records("train"), num=4, max_frames=64, language="xx")


def test_groups_come_in_turn_until_they_are_empty() -> None:
    base = ClipRecord("", "", "", "", "", {}, False, "train", 10, "", 0)
    records = [replace(base, id=str(i), group="big" if i < 8 else "small") for i in range(10)]
    chosen = spread_over_groups(records, 4, seed=0)
    assert sorted(record.group for record in chosen) == ["big", "big", "small", "small"]
    assert len({record.id for record in spread_over_groups(records, 99, seed=0)}) == 10


def test_small_helpers() -> None:
    assert choose_caption(["a", "b"], "id", 1) == choose_caption(["a", "b"], "id", 1)


def test_a_frozen_clip_does_not_move(data: PreparedData) -> None:
    record = data.records("train")[0]
    still = frozen_pose(decode_features(data.features(record)))
    positions = still.positions()
    assert np.abs(positions - positions[:1]).max() < 1e-4
    assert (still.root_position == still.root_position[0]).all()
