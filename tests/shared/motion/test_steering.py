"""A body that wanders is pulled to the middle and to the front; one that dances there is not."""

import numpy as np
import torch

from src.shared.motion.features import FORWARD, HEIGHT, LATERAL, YAW_RATE, integrate_root
from src.shared.motion.steering import PULL, ROOM, TURN, circling, staged, steered


def root(frames: int = 900, **rates: float) -> torch.Tensor:
    """Rows [T,6] of a pelvis that keeps one velocity."""
    rows = torch.zeros(frames, 6)
    rows[:, HEIGHT] = 0.9
    for name, rate in rates.items():
        rows[:, {"forward": FORWARD, "left": LATERAL, "turn": YAW_RATE}[name]] = rate
    return rows


def furthest(rows: torch.Tensor) -> float:
    path, _ = integrate_root(rows, 30.0)
    return float(path[:, [0, 2]].norm(dim=-1).max())


def test_who_wanders_off_stays_near() -> None:
    for way in ({"forward": 0.08}, {"left": 0.08}, {"left": -0.08}):
        assert furthest(root(**way)) > 2.3 and furthest(steered(root(**way), 30.0)) < 1.0


def test_who_walks_off_all_the_same_is_pulled_harder() -> None:
    off = root(left=0.25)
    assert furthest(steered(off, 30.0)) > 2 * ROOM and furthest(staged(off, 30.0)) < 2 * ROOM
    near = root(left=0.05)
    assert torch.equal(staged(near, 30.0), steered(near, 30.0))


def test_a_way_backward_is_mostly_left_out_and_quick_steps_stay() -> None:
    backward = steered(root(forward=-0.3), 30.0)
    assert float(backward[:30, FORWARD].min()) > -0.15
    quick = root()
    quick[:, FORWARD] = torch.from_numpy(np.sin(np.arange(900) / 30 * 4 * np.pi)).float()
    change = (steered(quick, 30.0) - quick)[60:-60, FORWARD]
    assert float(change.abs().max()) < PULL + 0.02


def test_it_comes_back_to_the_front_but_spins_where_it_spins() -> None:
    aside = root()
    aside[:30, YAW_RATE] = np.pi / 2
    assert abs(float(integrate_root(steered(aside, 30.0), 30.0)[1][-1])) < 0.2
    spinning = steered(root(turn=2 * np.pi), 30.0)
    heading = integrate_root(spinning, 30.0)[1]
    assert abs(float(heading[-1]) - 2 * np.pi * 899 / 30) < np.pi
    assert float((spinning[:, YAW_RATE] - 2 * np.pi).abs().max()) <= TURN + 1e-6


def test_heights_and_contacts_stay() -> None:
    rows = root(forward=0.2)
    rows[::2, 4:] = 1.0
    torch.testing.assert_close(steered(rows, 30.0)[:, [2, 4, 5]], rows[:, [2, 4, 5]])


def test_who_walks_off_walks_round_and_a_sway_stays() -> None:
    walk = circling(root(forward=1.0), 30.0)
    assert furthest(walk) < 1.6 and furthest(root(forward=1.0)) > 29
    assert float(walk[:, FORWARD].min()) == 1.0
    sway = root()
    sway[:, LATERAL] = torch.from_numpy(np.sin(np.arange(900) / 30 * 2 * np.pi)).float()
    assert float((circling(sway, 30.0) - sway)[60:-60].abs().max()) < 0.02
