"""Editing: what is kept stays as it was, in the body and in the world; the rest is made."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.errors import UsageError, UserError
from src.shared.model.diffusion import Sampling
from src.shared.model.generation.constraint import Constraint
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import FORWARD, ROOT_ROW, Place, integrate_root
from src.shared.motion.motion import Motion, resample_motion
from src.shared.motion.postprocess.footskate import ease_from_kept
from src.shared.motion.postprocess.stitching import moved_to, place_of
from src.shared.motion.rotations import turn_about_y
from src.shared.motion.skeleton import JOINT_INDEX, JOINT_NAMES
from src.shared.pipelines.edit import (
    GROUPS,
    bend_back,
    chosen_joints,
    continue_clips,
    edit_clip,
    edited,
    fill,
    fill_free,
    keep_ends,
    kept_error,
    redo,
)
from tests.shared.model.conftest import tiny_generator

WALK = "a person walks"
SETTINGS = Sampling(seed=2)


def kept_positions_error(motion: Motion, clip: Motion, frames: slice, of_clip: slice) -> float:
    """Metres that a joint in kept frames is at most from where it was, place apart."""
    made = _seen_from_start(motion, frames)
    return float(np.abs(made - _seen_from_start(clip, of_clip)).max())


def _seen_from_start(motion: Motion, frames: slice) -> np.ndarray:
    """Joint positions [t,22,3] from where the body is in the first of some frames."""
    place = place_of(motion, range(motion.num_frames)[frames][0])
    positions = torch.as_tensor(motion.positions()[frames], dtype=torch.float64)
    positions = positions - torch.tensor([place.x, 0.0, place.z])
    return turn_about_y(positions, -place.heading).numpy()


@pytest.fixture(scope="module")
def generator() -> TextToMotion:
    return tiny_generator()


@pytest.fixture(scope="module")
def clip() -> Motion:
    """A walk that does not begin at the origin."""
    labels = {"action": "walk", "direction": "forward", "speed": "normal", "turn": "left"}
    return moved_to(generate_clip(spec_for(labels, 1), 1), Place(1.0, 2.0, -0.8))


@pytest.fixture(scope="module")
def other() -> Motion:
    labels = {"action": "wave", "side": "right", "speed": "normal"}
    return generate_clip(spec_for(labels, 1), 1)


def angles(one: Motion, two: Motion) -> np.ndarray:
    """Largest difference of a rotation's entries, up to sign [T,22]."""
    dots = np.abs((one.quaternions * two.quaternions).sum(-1)).clip(max=1)
    return np.arccos(dots) * 2


def test_both_ends_are_kept(generator: TextToMotion, clip: Motion, other: Motion) -> None:
    given = keep_ends(clip, other, 25, 90)
    made = edited(generator, WALK, given, SETTINGS)
    motion = made.motion
    assert motion.num_frames == 90 and made.errors["frames_kept"] == 50
    assert made.errors["rotation"] < 1e-3 and made.errors["root"] < 1e-3
    np.testing.assert_allclose(motion.positions()[:25], clip.positions()[:25], atol=1e-3)
    last = other.num_frames
    error = kept_positions_error(motion, other, slice(65, 90), slice(last - 25, last))
    assert error < 1e-3
    assert kept_positions_error(motion, other, slice(30, 55), slice(last - 25, last)) > 0.01


def test_one_end_is_enough(generator: TextToMotion, clip: Motion) -> None:
    motion = edited(generator, WALK, keep_ends(None, clip, 10, 50), SETTINGS).motion
    error = kept_positions_error(
        motion, clip, slice(40, 50), slice(clip.num_frames - 10, clip.num_frames)
    )
    assert error < 1e-3
    assert place_of(motion, 0) == Place(0.0, 0.0, pytest.approx(0.0, abs=1e-3))


def test_the_end_of_the_same_clip_is_where_it_was(generator: TextToMotion, clip: Motion) -> None:
    frames = clip.num_frames
    given = keep_ends(clip, clip, 20, frames, rejoin=True)
    motion = edited(generator, WALK, given, SETTINGS).motion
    np.testing.assert_allclose(motion.positions()[-20:], clip.positions()[-20:], atol=1e-3)


def test_chosen_joints_are_made_anew_and_nothing_else(
    generator: TextToMotion, clip: Motion
) -> None:
    joints = chosen_joints(["left-arm", "head"])
    made = edited(generator, None, redo(clip, 20, 60, joints), SETTINGS)
    apart = angles(made.motion, clip)
    rows = sorted(JOINT_INDEX[name] for name in joints)
    rest = sorted(set(range(22)) - set(rows))
    assert apart[:, rest].max() < 1e-3 and apart[:20].max() < 1e-3 and apart[60:].max() < 1e-3
    assert apart[20:60, rows].max() > 0.05
    np.testing.assert_allclose(made.motion.root_position, clip.root_position, atol=1e-3)
    assert made.errors["rotation"] < 1e-3 and made.errors["entries_kept"] > 0.8
    assert made.motion.text == ""


def test_a_span_leads_back_to_its_place(generator: TextToMotion, clip: Motion) -> None:
    made = edited(generator, WALK, redo(clip, 30, 70), SETTINGS)
    np.testing.assert_allclose(made.motion.positions()[:30], clip.positions()[:30], atol=1e-3)
    np.testing.assert_allclose(made.motion.positions()[70:], clip.positions()[70:], atol=1e-3)
    assert angles(made.motion, clip)[35:65].max() > 0.05
    open_end = redo(clip, 30, clip.num_frames)
    assert open_end.rejoin is None


def test_only_the_surroundings_are_sampled(
    generator: TextToMotion, clip: Motion, monkeypatch
) -> None:
    long = Constraint(torch.zeros(500, 23, 6), torch.ones(500, 23, 6, dtype=torch.bool))
    long.known[300:320, 5] = False
    lengths = []
    plain = generator.sample_features

    def watched(*args: object, **options: object) -> list[torch.Tensor]:
        lengths.append(len(options["constraints"][0]))
        return plain(*args, **options)

    monkeypatch.setattr(generator, "sample_features", watched)
    features = fill_free(generator, WALK, long, SETTINGS)
    assert lengths == [80] and features.shape == (500, 23, 6)
    torch.testing.assert_close(features[long.known], long.values[long.known])
    whole = Constraint(long.values, torch.ones_like(long.known))
    torch.testing.assert_close(fill_free(generator, WALK, whole, SETTINGS), long.values)
    assert len(lengths) == 1


def test_a_path_is_bent_without_a_jump(generator: TextToMotion, clip: Motion) -> None:
    given = redo(clip, 30, 70)
    free = fill_free(generator, WALK, given.constraint, SETTINGS)
    bent = bend_back(free, given, fps=30.0)
    assert bent.known[30:70, ROOT_ROW, FORWARD].all()
    features, _ = fill(generator, WALK, given, SETTINGS)
    torch.testing.assert_close(features[bent.known], bent.values[bent.known])
    path, _ = integrate_root(features[:, ROOT_ROW].double(), 30.0, given.place)
    np.testing.assert_allclose(path[70:].numpy(), clip.root_position[70:], atol=1e-4)
    change = bent.values[30:70, ROOT_ROW, :2] - free[30:70, ROOT_ROW, :2]
    assert float(change[[0, -1]].abs().max()) < 0.25 * float(change.abs().max()) + 1e-3


def test_feet_are_held_little_by_little(clip: Motion) -> None:
    """Next to kept frames a leg is as it was made; further off, as the lock has it."""
    turned = clip.quaternions.copy()
    turned[:, 4] = [0.96, 0.28, 0.0, 0.0]  # another left knee
    locked = replace(clip, quaternions=turned)
    kept = np.zeros((clip.num_frames, 2), dtype=bool)
    kept[:20, 0] = True
    apart = angles(ease_from_kept(clip, locked, kept), clip)[:, 4]
    whole = angles(locked, clip)[:, 4]
    assert apart[:20].max() < 1e-3 and apart[20] < 0.1 * whole[20]
    assert angles(ease_from_kept(clip, locked, kept), locked)[30:].max() < 1e-3
    assert angles(ease_from_kept(clip, locked, np.zeros_like(kept)), locked).max() < 1e-3


def test_names_of_joints() -> None:
    assert chosen_joints(["l_wrist"]) == {"l_wrist"}
    assert chosen_joints(["body"]) == set(JOINT_NAMES)
    assert chosen_joints(["upper-body", "lower-body"]) == set(JOINT_NAMES)
    assert "l_elbow" in chosen_joints(["arms"]) and "head" in GROUPS["trunk"]
    with pytest.raises(UsageError, match="did you mean 'left-arm'"):
        chosen_joints(["left-arn"])


def test_legs_free_their_contacts(clip: Motion) -> None:
    known = redo(clip, 10, 20, chosen_joints(["left-leg"])).constraint.known
    assert not known[10:20, ROOT_ROW, 4:].any() and known[10:20, ROOT_ROW, :4].all()


def test_errors_see_what_differs(clip: Motion) -> None:
    given = redo(clip, 10, 20, chosen_joints(["head"])).constraint
    assert max(kept_error(clip, given).values()) < 1e-4
    turned = clip.quaternions.copy()
    turned[5, 3] = [0.98, 0.199, 0, 0]
    wrong = Motion(turned, clip.root_position + np.float32([[0, 0.01, 0]]), clip.contacts)
    error = kept_error(wrong, given)
    assert error["rotation"] > 0.05 and error["root"] == pytest.approx(0.01, abs=1e-3)


def test_moving_a_motion(clip: Motion) -> None:
    moved = moved_to(clip, Place(3.0, -1.0, 2.0))
    assert place_of(moved, 0) == Place(
        pytest.approx(3.0, abs=1e-5), pytest.approx(-1.0, abs=1e-5), pytest.approx(2.0, abs=1e-5)
    )
    error = kept_positions_error(moved, clip, slice(10, 40), slice(10, 40))
    assert error < 1e-4


def test_groups_of_joints_are_joints(clip: Motion) -> None:
    by_group = edit_clip(clip, 0.0, None, ["right-arm"]).constraint.known
    by_joint = edit_clip(clip, 0.0, None, chosen_joints(["right-arm"])).constraint.known
    assert torch.equal(by_group, by_joint)
    with pytest.raises(UsageError, match="did you mean 'right-arm'"):
        edit_clip(clip, 0.0, None, ["right-arn"])


@pytest.mark.parametrize("fps", [24.0, 60.0, 120.0])
def test_a_clip_of_another_rate_stays_where_and_when_it_was(
    fps: float, generator: TextToMotion, clip: Motion
) -> None:
    own = resample_motion(clip, fps)
    wanted = resample_motion(own, 30.0).positions()
    made = edited(generator, WALK, edit_clip(own, 1.0, 2.0), SETTINGS).motion
    assert made.fps == 30.0 and made.num_frames == len(wanted)
    for kept in (slice(0, 30), slice(60, None)):
        np.testing.assert_allclose(made.positions()[kept], wanted[kept], atol=1e-4)
    for given in (
        continue_clips(own, keep=own.seconds, seconds=own.seconds + 1.0),
        continue_clips(None, own, keep=own.seconds, seconds=own.seconds + 1.0),
        continue_clips(clip, own, seconds=4.0),
    ):
        made = edited(generator, WALK, given, SETTINGS).motion
        assert made.num_frames == len(given.constraint) and abs(made.seconds - 4) < 2


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (lambda clip: "walk.bvh", "clip is a str; give a Motion"),
        (lambda clip: clip.frames(0, 1), "clip is a single frame"),
        (lambda clip: replace(clip, fps=0.0), "clip: the motion's fps is 0.0; give"),
        (
            lambda clip: replace(clip, root_position=clip.root_position * np.nan),
            "clip: the motion's root_position hold NaN",
        ),
    ],
)
def test_what_cannot_be_edited_is_said(change: Any, line: str, clip: Motion) -> None:
    with pytest.raises(UsageError, match=line):
        edit_clip(change(clip), 0.1, 0.2)


def test_times_that_are_none_are_refused_and_one_joint_may_stand_alone(clip: Motion) -> None:
    for wrong in (
        lambda: edit_clip(clip, float("nan")),
        lambda: edit_clip(clip, 0.0, float("inf")),
        lambda: continue_clips(clip, keep=float("nan")),
        lambda: continue_clips(clip, seconds=1e6),
    ):
        with pytest.raises(UsageError, match="is out of range; choose from"):
            wrong()
    with pytest.raises(UsageError, match=r"keep 0 s holds no frame; keep 0\.033 s"):
        continue_clips(clip, keep=0.0)
    with pytest.raises(UserError, match="a span of it that holds a frame"):
        edit_clip(clip, 0.5, 0.51)
    with pytest.raises(UsageError, match="joints is empty"):
        edit_clip(clip, joints=[])
    one, listed = (edit_clip(clip, 0, 1, names) for names in ("head", ["head"]))
    assert torch.equal(one.constraint.known, listed.constraint.known)


def test_joints_leave_what_they_did_and_come_back_without_a_jerk(
    generator: TextToMotion, clip: Motion
) -> None:
    first, last = 10, clip.num_frames - 10
    given = edit_clip(clip, first / 30, last / 30, ["right-arm"])
    made = edited(generator, "a person waves", given, Sampling(steps=2)).motion
    apart = angles(made, clip)[:, JOINT_INDEX["r_elbow"]]
    most = apart[first:last].max()
    assert most > 0.3  # an untrained network does anything
    assert apart[:first].max() < 1e-3 and apart[last:].max() < 1e-3  # what is kept
    assert apart[first] < 0.3 * most and apart[last - 1] < 0.3 * most
