"""Timelines: what a file may say, passages and parts in one motion, and loops."""

import math
from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UsageError, UserError
from src.shared.model.diffusion import Sampling
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import FORWARD, ROOT_ROW, YAW_RATE, integrate_root
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.pipelines.edit import chosen_joints
from src.shared.pipelines.path import DrawnPath, along_path, natural_gait
from src.shared.pipelines.stream import Passage
from src.shared.pipelines.text import SentenceGenerator
from src.shared.pipelines.timeline import (
    Part,
    Timeline,
    add_parts,
    closed,
    in_a_loop,
    make_loop,
    make_timeline,
    read_timeline,
)
from tests.shared.model.conftest import tiny_generator

SETTINGS = Sampling(seed=5)
TWO = Timeline((Passage("a person walks", 70), Passage("somebody jumps twice", 40)))


@pytest.fixture(scope="module")
def generator() -> TextToMotion:
    return tiny_generator()


def written(folder: Path, text: str) -> Path:
    file = folder / "timeline.yaml"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_file(tmp_path: Path) -> None:
    """Entries in any order; a gap belongs to what follows it."""
    file = written(
        tmp_path,
        """
        - {text: a person claps, start: 5, end: 7.5, tag: clap}
        - {text: "  a person\\n walks ", start: 0, end: 4}
        - {text: a person waves, start: 1, end: 3, parts: [right-arm, head]}
        """,
    )
    timeline = read_timeline(file, fps=30.0)
    assert timeline.passages == (
        Passage("a person walks", 120),
        Passage("a person claps", 105, "clap"),
    )
    joints = frozenset(chosen_joints(["right-arm", "head"]))
    assert timeline.parts == (Part("a person waves", 30, 90, joints),)
    assert timeline.text == "a person walks, then a person claps"
    assert timeline.num_frames == 225


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no list"),
        ("{text: a}", "no list"),
        ("[3]", "entry 1 is 3"),
        ("[{txt: a, start: 0, end: 1}]", "did you mean 'text'"),
        ("[{start: 0, end: 1}]", "entry 1 has no text"),
        ("[{text: ' ', start: 0, end: 1}]", "has no text"),
        ("[{text: a, end: 1}]", "start is None"),
        ("[{text: a, start: -1, end: 1}]", "start is -1"),
        ("[{text: a, start: 0, end: .nan}]", "end is nan"),
        ("[{text: a, start: 0, end: true}]", "end is True"),
        ("[{text: a, start: 0, end: x}]", "end is 'x'"),
        ("[{text: a, start: 2, end: 1}]", "lasts from 2 to 1"),
        ("[{text: a, start: 0, end: 2}, {text: b, start: 1, end: 3}]", "'b' starts at 1 s, before"),
        ("[{text: a, start: 0, end: 2, parts: [left-arn]}]", "did you mean 'left-arm'"),
        ("[{text: a, start: 0, end: 2, parts: 3}]", "parts is 3"),
        ("[{text: a, start: 0, end: 2, parts: [head]}]", "every entry has parts"),
        ("[{text: a, start: 0, end: 2}, {text: b, start: 1, end: 3, parts: head}]", "after the"),
        (
            "[{text: a, start: 0, end: 4}, {text: b, start: 0, end: 3, parts: left-arm},"
            " {text: c, start: 2, end: 4, parts: [head, l_wrist]}]",
            "with its l_wrist",
        ),
        ("[{text: a, start: 0, end: 1, tag: 3}]", "tag is 3"),
        ("- {text: a, start: 0", "not valid YAML"),
    ],
)
def test_nonsense_is_named(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(UserError, match=message) as error:
        read_timeline(written(tmp_path, text), fps=30.0)
    assert "timeline.yaml" in str(error.value) and "\n" not in str(error.value)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not exist; give a"):
        read_timeline(tmp_path / "none.yaml", fps=30.0)


@given(st.lists(st.tuples(st.floats(0, 2), st.floats(0.2, 9)), min_size=1, max_size=6))
def test_lengths_add_up(tmp_path_factory, steps: list[tuple[float, float]]) -> None:
    rows, now = [], 0.0
    for gap, length in steps:
        rows.append(f"- {{text: a, start: {now + gap}, end: {now + gap + length}}}")
        now += gap + length
    file = tmp_path_factory.getbasetemp() / "timeline.yaml"
    file.write_text("\n".join(rows))
    assert read_timeline(file, fps=30.0).num_frames == round(now * 30)


def test_parts_leave_the_rest_alone(generator: TextToMotion) -> None:
    body = make_timeline(generator, TWO, SETTINGS)
    part = Part("a person walks", 20, 60, frozenset(chosen_joints(["right-arm"])))
    made = add_parts(generator, body, [part], SETTINGS)
    changed = (made - body).abs().sum((0, 2)) > 1e-6
    assert {int(row) for row in torch.nonzero(changed)} == {
        JOINT_INDEX[name] for name in part.joints
    }
    torch.testing.assert_close(made[:20], body[:20])
    torch.testing.assert_close(made[60:], body[60:])
    whole = SentenceGenerator(generator).timeline(Timeline(TWO.passages, (part,)), SETTINGS)
    assert whole.num_frames == 110 and whole.text == TWO.text


@pytest.mark.parametrize("frames", [30, 60, 150])
def test_a_loop_goes_on(generator: TextToMotion, frames: int) -> None:
    """The step from the last frame to the first is like its neighbours, in features."""
    features = make_loop(generator, [Passage("a person walks", frames)], SETTINGS)
    assert len(features) == frames
    joints = features[:, :ROOT_ROW]
    step = (joints[0] - joints[-1]).abs().mean()
    steps = (joints[1:] - joints[:-1]).abs().mean((1, 2))
    assert float(step) < 2 * float(steps.max())


@pytest.mark.parametrize(
    ("turn", "forward", "closes"),
    [
        (6.0, 0.01, True),
        (-340.0, 1.0, True),
        (90.0, 1.0, False),
        (-10.0, 1.2, False),
        (3.0, 0.2, False),  # who goes as slowly as that does go
    ],
)
def test_a_round_in_place_or_a_full_circle_closes(turn: float, forward: float, closes: bool):
    features = torch.zeros(120, 23, 6)
    features[:, ROOT_ROW, YAW_RATE] = math.radians(turn) / 4 + torch.sin(torch.arange(120.0))
    features[:, ROOT_ROW, FORWARD] = forward
    once = closed(features, 30.0)
    path, heading = integrate_root(torch.cat((once, once[:1]))[:, ROOT_ROW], 30.0)
    full = 360 * round(turn / 360) if abs(math.remainder(turn, 360)) < 45 else turn
    assert math.degrees(float(heading[-1])) == pytest.approx(full, abs=1.0)
    assert (float((path[-1] - path[0]).norm()) < 1e-3) is closes


def test_a_loop_of_several_texts(generator: TextToMotion) -> None:
    made = in_a_loop(generator, TWO, SETTINGS)
    assert made.motion.num_frames == 111  # with the closing key
    assert made.errors["join_acceleration"] < 2 * made.errors["p99_acceleration"] + 5
    np.testing.assert_allclose(made.motion.root_position[0, [0, 2]], 0, atol=1e-5)
    way = np.linalg.norm(made.motion.root_position[-1, [0, 2]])
    assert way == pytest.approx(made.errors["travel"], abs=1e-4)
    with pytest.raises(UserError, match=r"0\.5 s is too short"):
        in_a_loop(generator, Timeline((Passage("a person walks", 15),)), SETTINGS)


def test_along_a_path(generator: TextToMotion) -> None:
    drawn = DrawnPath(np.array([[1, 0], [1, 2], [2, 2.5]]))
    one = Timeline((Passage("a person walks", 1),))
    made = along_path(generator, one, drawn, SETTINGS)
    assert made.errors["path_mean"] < 1e-3 and made.errors["path_line_mean"] < 0.05
    np.testing.assert_allclose(made.motion.root_position[0, [0, 2]], [1, 0], atol=1e-4)
    several = along_path(generator, TWO, drawn, SETTINGS)
    assert several.motion.num_frames == 110 and several.errors["path_max"] < 1e-3
    timed = DrawnPath(drawn.points, times=np.array([0.0, 1.0, 2.0]))
    with pytest.raises(UserError, match="the path takes"):
        along_path(generator, TWO, timed, SETTINGS)
    speed, facing, *_ = natural_gait(generator, TWO.passages[0], SETTINGS)
    assert speed > 0 and abs(facing) <= np.pi
