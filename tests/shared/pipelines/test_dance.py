"""DancePrompter: sections at downbeats, prompts that suit sound, loudness and path."""

from itertools import pairwise

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.config_audio import AudioTowerConfig
from src.shared.config_schema import NetworkConfig
from src.shared.errors import UsageError
from src.shared.memory.figures import FPS
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.model.checkpoint import ModelCard
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.motion.features import ROOT_ROW, encode_features, integrate_root
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.staging import staged
from src.shared.motion.trajectory import MotionTrajectory
from src.shared.pipelines.body import Performer, PerformerSettings
from src.shared.pipelines.choreography import Choreographer, Wish
from src.shared.pipelines.dance import (
    PROMPTS,
    DancePrompt,
    DancePrompter,
    SongPerformer,
    candidate_seed,
    sections,
)
from src.shared.pipelines.figure_dance import FigureDancer
from tests.shared.memory.tiny_figures import tiny_figures
from tests.shared.model.conftest import tiny_generator, tiny_network
from tests.shared.pipelines.test_figure_dance import condition


@given(
    frames=st.integers(8, 4000),
    tempo=st.floats(40, 220),
    meter=st.sampled_from([2, 3, 4]),
    offset=st.floats(-3, 3),
)
def test_sections_cover_everything_and_begin_at_downbeats(
    frames: int, tempo: float, meter: int, offset: float
) -> None:
    phase = offset + np.arange(frames) / 30 * tempo / 60 / meter
    for known in (phase, None):
        parts = sections(frames, known)
        assert parts[0][0] == 0 and parts[-1][1] == frames
        assert all(a[1] == b[0] for a, b in pairwise(parts))
        assert len(parts) == 1 or min(stop - start for start, stop in parts) >= 90
    for start, _ in sections(frames, phase)[1:]:
        assert phase[start] % 1 < 1 / 30 * tempo / 60 / meter + 1e-9  # the frame after a downbeat


def path(speed: float, frames: int = 360, height: float = 0.93) -> MotionTrajectory:
    """Straight ahead."""
    position = np.zeros((frames + 2, 3))
    position[:, 1], position[:, 2] = height, np.arange(frames + 2) / 30 * speed
    turn = np.tile([1.0, 0.0, 0.0, 0.0], (frames + 2, 1))
    return MotionTrajectory.from_pose(position, turn, np.arange(frames + 2) / 60, spare=2)


SLOW, FAST = (
    DancePrompt("a person walks forward", 0.0, 0.0, 0.93, 0.0),
    DancePrompt("somebody jumps twice", 1.5, 0.0, 0.93, 1.0),
)


def prompter(space: SharedSpace | None = None) -> DancePrompter:
    return DancePrompter(torch.eye(32)[:2], space, (SLOW, FAST))


def test_a_fast_path_gets_what_moves_fast() -> None:
    condition = torch.zeros(167, 360)
    for speed, expected in ((0.0, SLOW), (1.5, FAST)):
        (found,) = prompter().passages(condition, None, path(speed))
        assert (found.text, found.frames) == (expected.text, 360)


def test_loud_music_gets_what_is_energetic() -> None:
    loudness = torch.zeros(167, 360)
    loudness[160, 180:] = 1.0
    texts = [
        passage.text
        for seed in range(20)
        for passage in prompter().passages(loudness, None, path(0.75), seed=seed)
        if passage.frames == 180
    ]
    assert {SLOW.text, FAST.text} == set(texts)
    half = torch.zeros(167, 180)
    half[160] = torch.linspace(0, 1, 180)
    assert prompter().passages(loudness, None, path(0.75))[-1].text == FAST.text


def space() -> SharedSpace:
    config = AudioTowerConfig(embed_dim=32, dim=16, num_heads=2, num_layers=1)
    torch.manual_seed(0)
    return SharedSpace(tiny_network(), config, ModelCard(kind="shared-space")).eval()


def test_the_nearest_prompt_in_the_space_is_likelier() -> None:
    sound, towers = torch.randn(167, 180, generator=torch.Generator().manual_seed(0)), space()
    near = towers.embed_audio(sound[None, :, :150]).detach()[0]
    both = torch.stack((near, -near))
    same = tuple(DancePrompt(text, 0.0, 0.0, 0.93, 0.5) for text in ("one", "two"))
    found = [
        DancePrompter(both, towers, same).passages(sound, None, path(0.0, 180), seed=n)[0].text
        for n in range(40)
    ]
    assert found.count("one") > found.count("two")


def test_the_same_seed_says_the_same(caplog: pytest.LogCaptureFixture) -> None:
    generator = tiny_generator()
    alone = DancePrompter.beside(generator)
    assert alone.space is None and "text tower" in caplog.text  # the shipped space is another's
    condition, way = torch.rand(167, 360), path(0.4)
    assert alone.passages(condition, None, way, seed=3) == alone.passages(
        condition, None, way, seed=3
    )
    assert len({p.text for p in PROMPTS}) == len(PROMPTS)
    assert isinstance(generator.network, NetworkConfig)


@pytest.fixture(scope="module")
def starter() -> TextToMotion:
    return TextToMotion.from_pretrained("starter", device="cpu")


def test_clauses_that_no_figure_shows_are_done_in_order(starter: TextToMotion) -> None:
    dancers = SongPerformer(Performer(starter))
    found = dancers._clauses("a person dances, then bows", 600, None)
    assert [(each.text, each.frames) for each in found] == [("a person dances", 480), ("bows", 120)]
    alike = dancers._clauses("a person waves, then bows", 600, None)
    assert [each.frames for each in alike] == [300, 300]
    assert len(dancers._clauses("a person dances", 600, None)) == 1


def test_what_no_figure_shows_is_danced_where_figures_step(starter: TextToMotion) -> None:
    choreographer = Choreographer(tiny_figures())
    performer = Performer(starter, PerformerSettings(steps=1, foot_lock=False))
    led, alone = (
        SongPerformer(performer, choreographer=each).dance(condition(), "a knight dances").ranked[0]
        for each in (choreographer, None)
    )
    assert led.figures and all(each.steps for each in led.figures) and not alone.figures
    every = torch.ones(360, dtype=torch.bool)
    dancer = FigureDancer(choreographer, starter)
    found = dancer.plan(condition(), Wish(), candidate_seed(0, 3, 0), every, every.logical_not())
    nowhere = every.logical_not()
    assert dancer.plan(condition(), Wish(), 0, nowhere, every) is None
    assert found is not None and found[1] == led.figures
    plan = found[0]
    assert plan.known[:, ROOT_ROW].float().mean() > 0.8 and plan.known[0, ROOT_ROW].all()
    knee, wrist = JOINT_INDEX["l_knee"], JOINT_INDEX["l_wrist"]
    assert plan.known[60, knee].all() and not plan.known[:, wrist].any()
    assert plan.shown is not None and not plan.shown[:, :ROOT_ROW].any()
    knees = encode_features(led.motion)[60:300, knee] - plan.values[60:300, knee]
    assert knees.abs().mean() < 0.05
    end = int(torch.nonzero(plan.known[:, ROOT_ROW, 0])[-1]) / FPS
    rows = staged(plan.values[:, ROOT_ROW], FPS, end)
    way = integrate_root(rows, FPS)[0].numpy()[:, [0, 2]]

    def off(found: MotionTrajectory) -> float:
        """Up to the second before the figures end, where what comes after is felt."""
        return float(np.linalg.norm(found.position[:300, [0, 2]] - way[:300], axis=1).max())

    for dance, follows in ((led, True), (alone, False)):
        assert (off(dance.trajectory) < 0.05) is follows
    for other in (
        "a person waves with the right hand", "an indian woman meditates",
        "a person does push-ups at the dance class", "a person does not dance",
    ):  # fmt: skip
        dancers = SongPerformer(performer, choreographer=choreographer)
        assert off(dancers.dance(condition(), other).ranked[0].trajectory) > 0.05, other


def test_what_the_figures_do_not_show_is_said(
    starter: TextToMotion, caplog: pytest.LogCaptureFixture
) -> None:
    choreographer = Choreographer(tiny_figures())
    dancers = SongPerformer(Performer(starter), choreographer=choreographer)
    assert dancers._wish("a person breakdances", None) is None
    assert "the memory holds no figure of breakdance" in caplog.text
    wish = dancers._wish("a knight dances salsa", None)
    assert (
        wish is not None and wish.kinds == {"salsa"} and "they do not show 'knight'" in caplog.text
    )
    assert dancers._wish("a person dances hip hop", None) is None
    assert "no figure shows 'hip hop'" in caplog.text and "polka, salsa" in caplog.text
    assert len(dancers._told) == 3  # and in the JSON


def test_a_tag_names_a_kind_of_figures_beside_those_of_the_prompt(starter: TextToMotion) -> None:
    performer = Performer(starter, PerformerSettings(steps=2))
    dancers = SongPerformer(performer, choreographer=Choreographer(tiny_figures()))
    for prompt, tag, kinds in (
        ("a person dances", "Salsa", {"salsa"}), ("a person dances", None, set()),
        ("a person dances", "dance", set()), ("a person dances polka", "salsa", {"polka", "salsa"}),
    ):  # fmt: skip
        wish = dancers._wish(prompt, tag)
        assert wish is not None and wish.kinds == kinds
    with pytest.raises(UsageError, match="'zzz' is not one this model"):
        dancers.dance(condition(), "a person dances", tag="zzz")
    for tag, told in (("zombie", "do not hear the tag 'zombie'"), ("dance", None), ("salsa", None)):
        warning = dancers.dance(condition(), "a person dances", tag=tag).warning
        assert warning is None if told is None else told in (warning or "")
