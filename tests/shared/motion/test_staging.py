"""The same movement, carried otherwise; a body that wanders is pulled to the middle and the front,
one that dances there is not."""

import numpy as np
import pytest
import torch

from src.shared.motion.features import (
    FORWARD,
    HEIGHT,
    LATERAL,
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    decode_features,
    encode_features,
    integrate_root,
    world_joints,
)
from src.shared.motion.rotations import (
    axis_angle_to_matrix,
    matrix_to_rotation_6d,
    rotation_6d_to_matrix,
)
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.staging import (
    ASKEW,
    FAR,
    GIVES,
    PLAIN,
    PULL,
    ROOM,
    TURN,
    TURNED,
    Manner,
    _fronted,
    carried,
    circling,
    staged,
    steered,
    stepped,
    stopping,
)
from tests.shared.memory.tiny_figures import tiny_figures

HEAD, PELVIS, WRIST = (JOINT_INDEX[name] for name in ("head", "pelvis", "l_wrist"))


def places(manner: Manner) -> np.ndarray:
    features = encode_features(tiny_figures().takes[0].motion)
    return decode_features(carried(features, manner, 30.0)).positions()


def test_who_is_plain_moves_as_ever() -> None:
    features = encode_features(tiny_figures().takes[0].motion)
    assert carried(features, PLAIN, 30.0) is features
    assert Manner(stoop=10, arms=0.5) & Manner(knees=5, arms=0.5) == Manner(10, 0, 5, 0.5)
    assert Manner(stoop=30) & Manner(stoop=22, bow=4) & Manner(stoop=-6) == Manner(24, 4)


def test_trunk_and_knees_bend_and_feet_stay_on_the_floor() -> None:
    plain, old = places(PLAIN), places(Manner(stoop=24, knees=14))
    assert (old[:, HEAD, 2] - old[:, PELVIS, 2]).mean() > 0.15  # in front of the pelvis
    sinks = plain[:, PELVIS, 1] - old[:, PELVIS, 1]
    assert 0.01 < sinks.mean() < 0.06
    assert np.abs(plain[..., 1].min(1) - old[..., 1].min(1)).max() < 0.01


@pytest.mark.parametrize("share", [0.5, 1.3])
def test_arms_keep_a_share_of_their_movement(share: float) -> None:
    plain, own = places(PLAIN)[:, WRIST], places(Manner(arms=share))[:, WRIST]
    moved = [np.ptp(each - each.mean(0), axis=0).max() for each in (own, plain)]
    assert moved[0] / moved[1] == pytest.approx(share, abs=0.3)


def test_a_robot_has_a_stiff_trunk_and_bent_elbows() -> None:
    features = encode_features(tiny_figures().takes[0].motion)
    robot = carried(features, Manner(trunk=0.25, elbows=85), 30.0)

    def degrees(rows: torch.Tensor, joint: str) -> np.ndarray:
        turns = rotation_6d_to_matrix(rows[:, JOINT_INDEX[joint]])
        cosine = (turns.diagonal(dim1=-2, dim2=-1).sum(-1) - 1) / 2
        return np.degrees(np.arccos(cosine.clamp(-1, 1).numpy()))

    assert degrees(robot, "l_elbow") == pytest.approx(85, abs=0.1)
    assert degrees(robot, "r_elbow") == pytest.approx(85, abs=0.1)
    bent = torch.tensor([0.4])
    features[:, JOINT_INDEX["spine2"]] = matrix_to_rotation_6d(axis_angle_to_matrix(0, bent))
    own = degrees(carried(features, Manner(trunk=0.25), 30.0), "spine2")
    assert own == pytest.approx(np.degrees(0.1), abs=0.1)


def test_who_stops_holds_still_around_each_count() -> None:
    turning = torch.zeros(120, 23, 6)
    turning[..., 0] = turning[..., 4] = 1.0
    angle = torch.arange(120.0) * 0.05  # of one shoulder, steadily
    turning[:, 16, 0], turning[:, 16, 1] = angle.cos(), angle.sin()
    turning[:, 16, 3], turning[:, 16, 4] = -angle.sin(), angle.cos()
    turning[:, ROOT_ROW, YAW_RATE] = 1.0
    stopped = stopping(turning, np.arange(1.0, 3.1, 0.5), 0.4)
    shown = np.unwrap(torch.atan2(stopped[:, 16, 1], stopped[:, 16, 0]).numpy())
    for count in (45, 60, 75):
        assert np.ptp(shown[count - 2 : count + 3]) < 1e-3
        assert shown[count] == pytest.approx(float(angle[count]), abs=1e-3)
        assert float(stopped[count, ROOT_ROW, YAW_RATE]) == 0.0
    assert shown[:30] == pytest.approx(angle[:30].numpy(), abs=1e-4)  # before the first
    assert float(stopped[30:90, ROOT_ROW, YAW_RATE].sum()) == pytest.approx(60.0, rel=0.03)


def test_an_arm_that_goes_all_round_does_not_jump() -> None:
    features = encode_features(tiny_figures().takes[0].motion)[:120]
    angle = torch.linspace(0, 2 * np.pi, 120)
    shoulder = JOINT_INDEX["l_shoulder"]
    zero = torch.zeros_like(angle)
    features[:, shoulder] = torch.stack((zero + 1, zero, zero, zero, angle.cos(), angle.sin()), -1)
    steps = np.linalg.norm(
        np.diff(decode_features(carried(features, Manner(arms=0.7), 30.0)).positions(), axis=0),
        axis=-1,
    )[:, WRIST]
    assert steps.max() < 0.2 and np.pi > FAR


# ---------------------------------------------------------------- on the stage


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
    assert furthest(steered(off, 30.0)) > 2 * ROOM and furthest(staged(off, 30.0, 30.0)) < 2 * ROOM
    near = root(left=0.05)
    assert torch.equal(staged(near, 30.0, 30.0), steered(near, 30.0))


def aside(degrees: float, frames: int = 300) -> torch.Tensor:
    """Root rows of a body that turns so far at a third of its dance."""
    rows = torch.zeros(frames, 6)
    rows[frames // 3 : frames // 3 + 10, YAW_RATE] = float(np.radians(degrees)) * 3
    return rows


def heading(rows: torch.Tensor, frame: int = -1) -> float:
    """Degrees from the front."""
    return abs((np.degrees(integrate_root(rows, 30.0)[1][frame].item()) + 180) % 360 - 180)


@pytest.mark.parametrize("off", [-100.0, -20.0, 0.0, 50.0, 85.0, 170.0, 350.0])
def test_a_dance_turns_to_the_front_before_its_end(off: float) -> None:
    rows = aside(off)
    came = _fronted(rows, 30.0, 9.0)
    was, least, most = abs((off + 180) % 360 - 180), np.degrees(ASKEW), np.degrees(TURNED)
    assert heading(came, 270) == pytest.approx(min(was, max(least, was - most)), abs=0.01)
    assert (came[:, YAW_RATE] - rows[:, YAW_RATE]).abs().max() < 0.65
    others = [row for row in range(6) if row != YAW_RATE]
    assert torch.equal(came[:, others], rows[:, others])
    assert _fronted(rows[:1], 30.0, 9.0) is not None and _fronted(rows, 30.0, 0.0) is rows


def test_a_short_dance_turns_no_faster() -> None:
    rows = aside(170.0, 30)
    assert (_fronted(rows, 30.0, 1.0) - rows).abs().max() < 0.65


def test_who_waits_goes_nowhere_and_ends_to_the_front_all_the_same() -> None:
    rows, danced = aside(80.0, 600), torch.ones(600, dtype=torch.bool)
    rows[:, LATERAL] = 0.1
    danced[470:530] = False
    came = staged(rows, 30.0, 20.0, danced)
    assert not came[470:530][:, [FORWARD, LATERAL, YAW_RATE]].any()
    assert heading(came) < np.degrees(ASKEW) + 1
    late = aside(80.0, 150)  # hardly time to be steered
    assert heading(staged(late, 30.0, 5.0)) < heading(steered(late, 30.0)) - 10


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


FEET = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]


def straddling(
    seams: tuple[int, ...] = (45,),
    *,
    frames: int = 90,
    left: int = 8,
    right: int = 15,
    **way: float,
) -> torch.Tensor:
    """Features of a body whose feet slide, and are put elsewhere at each seam: frames in which each
    stands around it, and root rows."""
    features = encode_features(tiny_figures().takes[0].motion)[:1].repeat(frames, 1, 1)
    features[:, ROOT_ROW] = root(frames, **way)
    hip, time = JOINT_INDEX["l_hip"], torch.arange(frames)
    turned = torch.zeros(frames).double()
    for number, seam in enumerate(seams):
        turned += 0.35 * torch.clamp((time - seam) / 20 + 0.5, 0, 1).double()
        own = (left, right) if number % 2 == 0 else (right, left)
        for side, stands in enumerate(own):
            span = slice(max(seam - stands // 2, 0), seam - stands // 2 + stands)
            features[span, ROOT_ROW, LEFT_CONTACT + side] = 1.0
    swung = axis_angle_to_matrix(0, -turned) @ rotation_6d_to_matrix(features[:, hip].double())
    features[:, hip] = matrix_to_rotation_6d(swung).float()
    return features


def slides(features: torch.Tensor, foot: int, span: slice) -> float:
    """The fastest that a foot goes over the floor, m/s."""
    steps = world_joints(features, 30.0)[span, FEET[foot]][:, [0, 2]].diff(dim=0)
    return float(steps.norm(dim=-1).max()) * 30


def test_the_foot_that_stands_longer_stays_and_the_other_steps() -> None:
    features = straddling(forward=0.3, left=8, turn=1.0)
    features[:, ROOT_ROW, LATERAL] = 0.2
    before, core = features.clone(), slice(40, 51)
    came = stepped(features, [45], 30.0)
    assert torch.equal(features, before)
    assert bool((came[35:56, ROOT_ROW, LEFT_CONTACT + 1] == 1.0).all())
    assert bool((came[35:56, ROOT_ROW, LEFT_CONTACT] == 0.0).all())
    assert slides(features, 1, core) > 0.3 and slides(came, 1, core) < 0.01
    outside = [*range(33), *range(58, 90)]
    assert torch.equal(came[outside], features[outside])
    kept = [HEIGHT, YAW_RATE]
    assert torch.equal(came[:, ROOT_ROW, kept], features[:, ROOT_ROW, kept])
    assert torch.equal(came[:, :ROOT_ROW], features[:, :ROOT_ROW])


def test_who_hardly_stands_takes_no_step_and_who_leaps_is_left_alone() -> None:
    touches = straddling(left=3, right=5, forward=0.3)
    contacts = stepped(touches, [45], 30.0)[:, ROOT_ROW, LEFT_CONTACT:]
    assert torch.equal(contacts, touches[:, ROOT_ROW, LEFT_CONTACT:])
    leaps = straddling(left=0, right=0, forward=1.0)
    assert torch.equal(stepped(leaps, [45], 30.0), leaps)
    assert stepped(leaps, [], 30.0) is leaps


def test_one_foot_after_the_other_where_seams_are_near() -> None:
    came = stepped(straddling((39, 51), forward=0.3), [39, 51], 30.0)
    contacts = came[:, ROOT_ROW, LEFT_CONTACT:]
    assert contacts[33:44].mean(0).tolist() == [0.0, 1.0]
    assert contacts[47:58].mean(0).tolist() == [1.0, 0.0]
    assert slides(came, 1, slice(36, 42)) < 0.01 and slides(came, 0, slice(49, 54)) < 0.01


def test_the_root_gives_way_by_so_much_and_no_more() -> None:
    fast = straddling(forward=4.0)
    change = (stepped(fast, [45], 30.0) - fast)[:, ROOT_ROW, [FORWARD, LATERAL]].norm(dim=-1)
    assert float(change.max()) == pytest.approx(GIVES, abs=1e-4)


@pytest.mark.parametrize(("seam", "frames"), [(0, 90), (3, 90), (88, 90), (89, 90), (0, 1), (1, 2)])
def test_a_seam_at_the_edge_of_a_dance(seam: int, frames: int) -> None:
    came = stepped(straddling(frames=frames), [seam], 30.0)
    assert came.shape == (frames, 23, 6) and bool(torch.isfinite(came).all())
