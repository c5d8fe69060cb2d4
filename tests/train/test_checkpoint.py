"""Checkpoints on a full disk."""

from pathlib import Path

import pytest
from torch import nn

from src.shared.errors import UserError
from src.train.checkpoint import latest_checkpoint, save_checkpoint
from tests.full_disk import full_disk


def test_a_full_disk_is_one_line_and_keeps_the_checkpoint_before(tmp_path: Path) -> None:
    model = nn.Linear(30, 30)
    parts = {name: model.state_dict() for name in ("model", "ema", "optimizer")}
    save_checkpoint(tmp_path, parts, state={"step": 1}, keep=2)
    with full_disk(), pytest.raises(UserError) as caught:
        save_checkpoint(tmp_path, parts, state={"step": 2}, keep=2)
    assert str(caught.value) == (
        f"cannot write checkpoint {tmp_path / 'step-00000002'}: File too large"
        "; free space and run again with --resume"
    )
    assert [path.name for path in tmp_path.iterdir()] == ["step-00000001"]
    newest = latest_checkpoint(tmp_path)
    assert newest is not None and newest.step == 1
