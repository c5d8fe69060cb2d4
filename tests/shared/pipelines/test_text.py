"""SentenceGenerator: order, numbers, angles and lengths are done; plain sentences are as before.

PromptSampler keeps the best of N for each prompt.
"""

import copy
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch
from scipy.ndimage import gaussian_filter1d

from src.shared.errors import UserError
from src.shared.metrics.measurements import ACTIONS, Check, Measurements, at_rest, measure
from src.shared.metrics.physical import foot_jump
from src.shared.model.diffusion import Sampling
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.model.noise import TRIES
from src.shared.motion.features import ROOT_ROW, YAW_RATE, encode_features, motion_heading
from src.shared.motion.motion import Motion
from src.shared.motion.postprocess.footskate import lock_feet
from src.shared.motion.skeleton import FOOT_JOINTS, JOINT_INDEX
from src.shared.pipelines.edit import chosen_joints, edit_clip, edited
from src.shared.pipelines.path import turned
from src.shared.pipelines.ranking import PromptSampler, TextJudge
from src.shared.pipelines.stream import Passage, spanned_features
from src.shared.pipelines.text import INSISTING, SentenceGenerator
from src.shared.pipelines.timeline import Timeline
from src.shared.pipelines.words import STANDS, bows_head
from tests.shared.model.conftest import tiny_generator


@pytest.fixture(scope="module")
def generator() -> TextToMotion:
    return tiny_generator()


@pytest.fixture(scope="module")
def sentences(generator: TextToMotion) -> SentenceGenerator:
    return SentenceGenerator(generator)


@pytest.fixture(scope="module")
def loaded() -> TextToMotion:
    return TextToMotion.from_pretrained("starter", device="cpu", runtime="onnx")


@pytest.fixture
def starter(loaded: TextToMotion) -> TextToMotion:
    """What ships, with a scope of its own to change."""
    return copy.copy(loaded)


def turn_of(motion: Motion) -> float:
    rate = encode_features(motion)[:-1, ROOT_ROW, YAW_RATE]  # the last frame repeats its neighbour
    return float(np.degrees(rate.sum() / motion.fps))


def test_a_plain_sentence_is_one_sample(generator: TextToMotion, sentences: SentenceGenerator):
    prompts = ["a person walks", "a person waves"]
    made = sentences.generate(prompts, seconds=[1.0, 1.5], seed=3, num_samples=2)
    same = generator.generate(prompts, seconds=[1.0, 1.5], seed=3, num_samples=2)
    for one, other in zip(made, same, strict=True):
        np.testing.assert_array_equal(one.quaternions, other.quaternions)


def test_clauses_follow_each_other(sentences: SentenceGenerator):
    (motion,) = sentences.generate(["a person walks, then jumps three times"], seconds=2.0)
    assert motion.num_frames == 60 + 3 * 75
    assert motion.text == "a person walks, then jumps three times"


def test_an_angle_and_a_length_are_kept(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    left, right, metres = sentences.generate(
        ["turn 90 degrees to the left", "turn 180° right", "walk three metres"], seconds=2.0
    )
    assert turn_of(left) == pytest.approx(90, abs=3)
    assert turn_of(right) == pytest.approx(-180, abs=3)
    way = metres.root_position[-1, [0, 2]] - metres.root_position[0, [0, 2]]
    assert np.linalg.norm(way) == pytest.approx(3, abs=0.1)


@pytest.mark.parametrize(
    ("sentence", "frames"),
    [("she walks ten steps", (150, 190)), ("takes two steps to the left", (35, 60))],
)
def test_steps_take_the_time_of_the_pace(
    starter: TextToMotion, sentence: str, frames: tuple[int, int]
):
    (motion,) = SentenceGenerator(starter).generate([sentence], seconds=2.0)
    assert frames[0] <= motion.num_frames <= frames[1]


@pytest.mark.parametrize(
    "text", ["a jogger runs in place", "il court sur place", "ein Mann geht auf der Stelle",
             "男がその場で走る", "一个人原地跑步", "un hombre corre en el sitio"]
)  # fmt: skip
def test_who_goes_in_place_stays_there(starter: TextToMotion, text: str):
    """Ten metres of running, before, without a word."""
    sentences = SentenceGenerator(starter)
    (clause,) = sentences.clauses(text)
    assert clause.metres == 0 and sentences.scope_warnings([text]) == [None]
    (motion,) = sentences.generate([text], seconds=3.0, steps=2)
    assert np.ptp(motion.root_position[:, [0, 2]], axis=0).max() < 0.05
    ankles = motion.positions()[:, [JOINT_INDEX["l_ankle"], JOINT_INDEX["r_ankle"]], 1]
    assert np.ptp(ankles, axis=0).max() > 0.03


@pytest.mark.parametrize(
    "text",
    ["a person jumps in place", "a person turns left on the spot", "一个人走回原地",
     "他从原地走开", "男が歩いてその場で止まる", "彼はその場で走って逃げる",
     "er rennt auf der Stelle los", "er geht auf der Stelle nach Hause",
     "a person walks back in place of the bench", "a soldier walks with his helmet in place",
     "the dancer walks, hands in place", "she walks and stops on the spot",
     "camina sin avanzar mucho"],
)  # fmt: skip
def test_what_else_is_in_place_keeps_nobody_there(starter: TextToMotion, text: str):
    found = SentenceGenerator(starter).clauses(text)
    assert {clause.metres for clause in found} == {None}


def test_steps_in_place_and_knees_beside(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    (steps,) = sentences.clauses("a person walks in place for ten steps")
    (knees,) = sentences.clauses("runs in place with high knees")
    assert (steps.metres, steps.steps, knees.metres) == (0, 10, 0)


def test_who_runs_on_in_place_comes_to_a_stop_first(starter: TextToMotion):
    """A pelvis at 2.8 m/s that was known to rest in the next frame braked by 48 m/s²."""
    sentences = SentenceGenerator(starter)
    (motion,) = sentences.generate(["a person runs forward, then runs in place"], seed=1)
    velocity = np.diff(motion.root_position[:, [0, 2]].astype(float), axis=0) * motion.fps
    speed = np.linalg.norm(velocity, axis=1)
    assert speed[30:90].mean() > 1.5 and speed[-60:].max() < 0.1
    assert np.linalg.norm(np.diff(velocity, axis=0), axis=1).max() * motion.fps < 30


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("a man walks, then jumps", 3), ("a man walks, then jumps again and again", 4),
     ("ein Mann geht, dann springt er immer wieder", 4), ("他走，然后不停地跳", 4),
     ("a man walks, then squats down and stays there", 4)],
)  # fmt: skip
def test_what_is_asked_for_often_or_held_keeps_its_time(
    starter: TextToMotion, text: str, seconds: float
):
    sentences = SentenceGenerator(starter)
    (motion,) = sentences.generate([text], steps=2)
    assert motion.seconds - 4.0 == pytest.approx(seconds, abs=0.1)


def test_all_that_is_not_known_is_named(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    (line,) = sentences.scope_warnings(["plays the violin, then knits a scarf and juggles"])
    assert line is not None and "'violin'" in line
    assert "'knits' and 'juggles'" in line


def test_what_a_number_alone_makes_known_is_warned_of(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    lines = sentences.scope_warnings(["punches three times", "punches three times like a kangaroo"])
    assert lines[0] is None and lines[1] is not None
    assert lines[1].endswith("say it in other words")
    assert sentences.scope_warnings(["waves three times"]) == [None]  # "bye" is the same gesture
    turned = ["dreht sich um 180 Grad und rennt weg", "er dreht sich um 90 Grad"]
    assert sentences.scope_warnings(turned) == [None, None]  # the angle says that it is a turn


def test_what_is_said_to_be_slow_or_fast_is(starter: TextToMotion):
    """Of what the network makes of a bow, whose pace no word changed, and of crawls on their way;
    where its time is told it holds."""
    sentences = SentenceGenerator(starter)

    def made(text: str) -> Motion:
        return sentences.generate([text], seed=1)[0]

    def pace(text: str) -> float:
        motion = made(text)
        joints = motion.positions()
        speed = np.linalg.norm(np.diff(joints - joints[:, :1], axis=0), axis=-1) * motion.fps
        return float(np.percentile(speed.max(1), 95))

    slow, usual, fast = map(pace, ("a man bows slowly", "a man bows", "a man bows quickly"))
    assert slow < 0.8 * usual < 0.8 * fast / 1.2
    ways = [made(f"a person crawls{more}") for more in (" slowly", "", " quickly")]
    gone = [float(np.hypot(*each.root_position[-1, [0, 2]])) / each.seconds for each in ways]
    assert gone[0] < 0.75 * gone[1] < 0.75 * gone[2] / 1.3
    assert made("does 4 push-ups").seconds == pytest.approx(10.0, abs=0.1)
    assert made("does 4 quick push-ups").seconds == pytest.approx(10.0 / 1.5, abs=0.1)
    assert made("bows slowly for five seconds").seconds == pytest.approx(5.0, abs=0.05)
    passages = Passage("a man bows slowly", 57), Passage("a man jumps in slow motion", 67)
    assert sentences.timeline(Timeline(passages), Sampling()).num_frames == 124


@pytest.mark.parametrize(
    ("text", "height"),
    [("a person sits and waves", 0.65), ("kneels, then waves", 0.55),
     ("sits down on the floor, then waves", 0.2), ("sits on a chair, then waves", 0.65)],
)  # fmt: skip
def test_who_sits_or_kneels_stays_so_while_the_arms_do_something(
    starter: TextToMotion, text: str, height: float
):
    sentences = SentenceGenerator(starter)
    assert sentences.clauses(text)[-1].seat
    [motion] = sentences.generate([text])
    joints = motion.positions()[-90:-15]
    assert joints[:, JOINT_INDEX["pelvis"], 1].max() < height
    hands = joints[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1]
    assert (hands - joints[:, [JOINT_INDEX["pelvis"]], 1]).max() > 0.45  # as high as the shoulders


def test_who_sits_claps_as_often_as_is_said(starter: TextToMotion):
    [motion] = SentenceGenerator(starter).generate(["kneels, then claps three times"])
    assert abs(measure(motion).claps - 3) <= 1
    wrists = motion.positions()[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]]]
    assert np.linalg.norm(wrists[:, 0] - wrists[:, 1], axis=-1).min() < 0.12


def test_what_comes_behind_a_way_may_be_led(starter: TextToMotion):
    """Frames of a way are none that a constraint counts; passages shorter than an overlap."""
    text = "sleeps for 0.2 seconds, then walks for 0.2 seconds, then turns left 90 degrees"
    [motion] = SentenceGenerator(starter).generate([text])
    heading = motion_heading(motion)
    assert np.degrees(heading[-1] - heading[0]) == pytest.approx(90, abs=10)


def test_who_walks_may_have_the_hands_on_the_hips(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    [motion] = sentences.generate(["walks with hands on hips"])
    assert np.hypot(*motion.root_position[-1, [0, 2]]) > 2  # it stood
    joints = motion.positions()[45:75]
    for side in "lr":
        shoulder, wrist = (joints[:, JOINT_INDEX[f"{side}_{n}"]] for n in ("shoulder", "wrist"))
        assert np.linalg.norm(wrist - shoulder, axis=-1).mean() < 0.45  # .49 where it hangs


def test_claps_are_shown_twice_as_fast_as_they_are_made(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    for text, count in (("claps twice", 2), ("claps three times", 3), ("claps four times", 4)):
        for seed in (0, 8):
            (counted,) = sentences.generate([text], seconds=4.0, seed=seed)
            assert counted.seconds < 1.6 * count and measure(counted).claps == count, (text, seed)
    (free,) = sentences.generate(["a person claps"], seconds=4.0, seed=0)
    assert free.seconds == 4.0 and measure(free).claps >= 3
    timeline = Timeline((Passage("a person claps", 60),), timed=True)
    assert sentences.timeline(timeline, Sampling(steps=2)).seconds == 2.0


@pytest.mark.parametrize(
    ("text", "steps"), [("takes three steps forward", 3), ("two steps back", 2)]
)
def test_steps_are_counted_and_end_on_a_foot(text: str, steps: int, starter: TextToMotion):
    (motion,) = SentenceGenerator(starter).generate([text], seed=1)
    stands = motion.contacts > 0.5
    lands = np.flatnonzero((stands[1:] & ~stands[:-1]).any(1)) + 1
    assert (lands >= 0.25 * motion.fps).sum() == steps
    assert motion.num_frames - lands[-1] <= 4


def test_a_measure_is_no_cause_for_a_warning(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    plain = sentences.scope_warnings(["a person walks forward"])
    assert sentences.scope_warnings(["a person walks forward for 60 seconds"]) == plain == [None]


def test_one_bad_window_is_none_of_those_that_follow(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch
):
    sentences = SentenceGenerator(starter)
    monkeypatch.setitem(ACTIONS, "walk", lambda m: m.forward_net < 8.0)
    asked = list[int]()
    sample = starter.sample_features

    def listening(*given: Any, **options: Any) -> Any:
        asked.append(1)
        return sample(*given, **options)

    monkeypatch.setattr(starter, "sample_features", listening)
    sentences.generate(["a person walks forward"], seconds=20.0)
    assert len(asked) < 2 * 6  # six windows; the walk goes beyond eight metres in the third


def test_a_gesture_begins_and_ends_with_hanging_arms(starter: TextToMotion):
    assert starter.scope is not None
    starter.scope = replace(starter.scope, gestures=("wave",))
    prompts = ["a person waves with the right hand", "a person walks forward"]
    wave, walk = SentenceGenerator(starter).generate(prompts, seconds=3.0)
    _, same = starter.generate(prompts, seconds=3.0)
    assert at_rest(wave)
    np.testing.assert_array_equal(walk.quaternions, same.quaternions)


def test_a_gesture_faces_one_way_and_its_repetitions_are_told_apart(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    prompts = [
        "a person waves",
        "walks two metres, then waves three times",
        "a person waves thrice",
    ]
    for prompt, times, motion in zip(prompts, (1, 3, 3), sentences.generate(prompts), strict=True):
        assert turn_of(motion) == pytest.approx(0, abs=5), prompt
        heights = motion.positions()[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1]
        raised = heights.max(1) > 1.2
        assert np.count_nonzero(np.diff(raised.astype(int)) == 1) == times, prompt


def test_what_is_held_stays(starter: TextToMotion):
    made = SentenceGenerator(starter)
    texts = ["raises the left hand and keeps it up", "a person crouches and stays down"]
    hand, squat, *_ = made.generate(texts, seconds=4)
    height = hand.positions()[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1]
    assert height[0, 0] < 1.0 and height[60:, 0].min() > 1.4 and height[:, 1].max() < 1.0
    assert squat.root_position[0, 1] > 0.9 and squat.root_position[60:, 1].max() < 0.75
    speed = np.linalg.norm(np.diff(hand.positions(), axis=0), axis=-1).max() * 30
    assert speed < 5.0  # m/s, the hand's way up
    (turn,) = made.generate(["a person turns 90 degrees and holds, then waves"], seconds=2)
    assert turn.root_position[:, 1].min() > 0.8  # what is led is not held
    (low,) = made.generate(["raises the left hand, holds it up, and lowers it"], seconds=3)
    assert low.positions()[-1, JOINT_INDEX["l_wrist"], 1] < 1.0
    (walk,) = made.generate(["walks forward and stops"], seconds=3)
    steps = np.linalg.norm(np.diff(walk.root_position[:, [0, 2]], axis=0), axis=-1) * 30
    assert steps[:60].mean() > 0.9 and steps[-20:].mean() < 0.2


@pytest.mark.parametrize(
    "text",
    ["an old man slowly sits down", "a man sits down slowly", "老人慢慢地坐下",
     "un anciano se sienta despacio", "sie setzt sich langsam hin", "elle s'assoit lentement"],
)  # fmt: skip
def test_who_sits_down_slowly_sits_down(starter: TextToMotion, text: str):
    first, last = SentenceGenerator(starter).clauses(text)
    assert first.text == STANDS and SentenceGenerator(starter)._nearest(last.text) == "sit"


def test_who_sits_down_stands_before_and_does_not_fall(starter: TextToMotion):
    made = SentenceGenerator(starter)
    for text in ("a person kneels down", "a person stands up"):
        (motion,) = made.generate([text], seconds=3)
        height = motion.root_position[:, 1]
        ends = (height[:10].mean(), height[75:].mean())
        assert min(ends) < 0.7 and max(ends) > 0.9 and bool(ends[0] > ends[1]) is ("down" in text)
        assert np.abs(np.diff(height)).max() * 30 < 1.3  # m/s; 2 where it is not led


def test_what_is_made_anew_is_sampled_until_it_shows(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch
):
    sentences = SentenceGenerator(starter)
    (walk,) = sentences.generate(["a person walks forward"], seconds=2.0, seed=5)
    given, raises = edit_clip(walk, joints=chosen_joints(["right-arm"])), "raises the right arm"
    counted = list[int]()
    sample = starter.sample_features

    def counting(*arguments: Any, **options: Any) -> Any:
        counted.append(1)
        return sample(*arguments, **options)

    monkeypatch.setattr(starter, "sample_features", counting)
    miss = sentences.unseen(raises)
    made = edited(starter, raises, given, Sampling(seed=1), miss=miss)
    assert miss is not None and len(counted) < TRIES
    assert sentences.unless_shown(raises, made.motion) is None
    assert sentences.unless_shown("raises the left arm", made.motion) is not None
    assert sentences.unseen("walks, then bows") is None


def test_a_loop_of_a_stand_neither_creeps_nor_turns(starter: TextToMotion):
    timeline = Timeline((Passage("a person stands", 90),))
    made = SentenceGenerator(starter).loop(timeline, Sampling(seed=1))
    assert made.errors["travel"] < 1e-3 and abs(made.errors["turn"]) < 0.01
    np.testing.assert_allclose(*made.motion.positions()[[0, -1]], atol=0.02)
    assert made.warning is None


def test_who_stays_in_place_does_not_glide(starter: TextToMotion):
    assert starter.scope is not None and {"meditate", "clap"} <= {*starter.scope.still}

    def travelled(*prompts: str) -> list[float]:
        texts, lengths = [*prompts, *prompts], [4.0] * len(prompts) + [9.0] * len(prompts)
        made = SentenceGenerator(starter).generate(texts, seconds=lengths)  # one and two windows
        ends = [motion.root_position[[0, -1]][:, [0, 2]] for motion in made]
        return [float(np.linalg.norm(last - first)) for first, last in ends]

    assert max(travelled("she meditates", "she claps")) < 0.03
    starter.scope = replace(starter.scope, still=())
    assert min(travelled("she claps")) > 0.1


@pytest.mark.parametrize("text", ["sits down on a chair", "椅子に座って", "kneels down"])
def test_who_sat_down_faces_one_way(starter: TextToMotion, text: str):
    for seed in range(3):
        (motion,) = SentenceGenerator(starter).generate([text], seconds=[4.0], seed=seed)
        across = (
            motion.positions()[:, JOINT_INDEX["l_hip"]]
            - motion.positions()[:, JOINT_INDEX["r_hip"]]
        )
        heading = np.unwrap(np.arctan2(across[:, 0], across[:, 2]))
        assert abs(np.degrees(heading[-1] - heading[0])) < 10


@pytest.mark.parametrize("text", ["a guard turns his head to the left", "他向左转头"])
def test_a_head_that_turns_is_no_turn_of_the_body(starter: TextToMotion, text: str):
    made = SentenceGenerator(starter)
    (line,) = made.scope_warnings([text])
    assert line is not None and not made._turns(made.clauses(text)[0])
    assert made.scope_warnings(["a guard turns to the left"]) == [None]


def test_who_is_to_turn_turns(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    prompts = [
        "a person turns around to the left",
        "a person spins",
        "a person spins to the right",
        "a dancer spins twice",
        "a person spins",
    ]
    turn, *spins = sentences.generate(prompts, seconds=[4.0, 4.0, 4.0, 4.0, 7.0])
    assert turn_of(turn) > 60
    turned_by = [turn_of(spin) for spin in spins]
    assert turned_by == pytest.approx([360, -360, 720, 720], abs=8)
    assert [spin.seconds for spin in spins] == [4.0, 4.0, 7.0, 7.0]


def test_a_walk_turns_a_corner_or_goes_round(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    asked = {
        "a pedestrian takes a right at the corner": -90,
        "im Gehen nach links abbiegen": 90,
        "a person walks in a circle to the left": 360,
        "walks forward, then walks around the corner to the right": -90,
    }
    for (prompt, degrees), motion in zip(
        asked.items(), sentences.generate(list(asked)), strict=True
    ):
        assert turn_of(motion) == pytest.approx(degrees, abs=20), prompt
    limbs, straight = sentences.generate(["a man walks with his left arm raised", "walks ahead"])
    assert abs(turn_of(limbs)) < 45 and abs(turn_of(straight)) < 45


def test_an_eight_closes_and_a_zigzag_goes_ahead_from_side_to_side(starter: TextToMotion):
    eight, winds = SentenceGenerator(starter).generate(
        ["a person walks in a figure eight", "eine Frau geht im Zickzack"]
    )
    place = eight.root_position[:, [0, 2]]
    assert eight.seconds > 10 and np.linalg.norm(place[-1] - place[0]) < 0.5
    assert place[:, 0].min() < -0.5 < 0.5 < place[:, 0].max()  # a loop on either side
    side, ahead = winds.root_position[:, [0, 2]].T
    assert ahead[-1] > 3 * np.ptp(side) > 0.6 and abs(side[-1]) < 0.3 * ahead[-1]


@pytest.mark.parametrize(
    ("prompt", "actions"),
    [
        ("Geh drei Schritte zurück und verbeuge dich", ["walk", "bow"]),
        ("verbeuge dich und klatsche", ["bow", "clap"]),
        ("wink und nick", ["wave", "nod"]),
        ("marschiere und salutiere", ["walk", "salute"]),
        ("jumps up and down with joy", ["jump"]),
        ("lies down and falls asleep", ["lie-down", "sleep"]),
        ("claps his hands and cheers", ["clap", "cheer"]),
        ("a person stomps", ["stomp"]),
        ("pulls a lever", ["pull-lever"]),  # pulls, elsewhere, are not learned
        ("投げキスをする", ["blow-kiss"]),
    ],
)
def test_bare_orders_and_idioms_are_sure(
    prompt: str, actions: list[str], loaded: TextToMotion
) -> None:
    sentences = SentenceGenerator(loaded)
    assert [sentences._nearest(each.text) for each in sentences.clauses(prompt)] == actions
    assert sentences.scope_warnings([prompt]) == [None]


@pytest.mark.parametrize("prompt", ["does the moonwalk", "weaves through the crowd"])
def test_ways_that_nobody_taught_are_told(prompt: str, loaded: TextToMotion) -> None:
    assert SentenceGenerator(loaded).scope_warnings([prompt]) != [None]


@pytest.mark.parametrize("prompt", ["pumps a fist", "a person cheers"])
def test_arms_come_up_and_down_as_arms_do(prompt: str, loaded: TextToMotion) -> None:
    [motion] = SentenceGenerator(loaded).generate([prompt])
    wrist = motion.positions()[:, JOINT_INDEX["r_wrist"]] - motion.positions()[:, 0]
    speed = np.linalg.norm(np.diff(wrist, axis=0), axis=1) * motion.fps
    assert 2 < speed[-21:].max() < 6  # were 8 and 9 m/s


@pytest.mark.parametrize("prompt", ["a person walks forward", "a woman walks quickly"])
def test_only_feet_that_stand_are_planted(prompt: str, loaded: TextToMotion) -> None:
    [free] = SentenceGenerator(loaded).generate([prompt], seed=2, foot_lock=False)
    locked = lock_feet(free)
    balls = free.positions()[:, [ball for _, ball in FOOT_JOINTS]][..., [0, 2]]
    speed = np.linalg.norm(np.gradient(balls, axis=0), axis=-1) * free.fps
    assert not (speed[locked.contacts > 0.5] > 1.5).any()  # no foot is stopped as it swings
    assert foot_jump(locked) < 1.4 * foot_jump(free)


@pytest.mark.parametrize("prompt", ["a person walks forward", "a man walks backwards"])
def test_who_goes_on_and_on_goes_straight(prompt: str, loaded: TextToMotion) -> None:
    [motion] = SentenceGenerator(loaded).generate([prompt], seconds=15.0, seed=1)
    assert abs(turn_of(motion)) < 10
    place = motion.root_position[-1] - motion.root_position[0]
    assert abs(place[0]) < 0.15 * abs(place[2]) and abs(place[2]) > 6


def test_a_quarter_turn_is_meant_and_circles_close(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    left, about, circle = sentences.generate(
        ["a person turns left", "a person turns around", "walks in a small circle"], seconds=4.0
    )
    assert turn_of(left) == pytest.approx(90, abs=3)
    assert abs(turn_of(about)) == pytest.approx(180, abs=3)
    (walk,) = sentences.generate(["walk two metres, then turn right"], seconds=3.0)
    for turn in (left, about, walk.frames(walk.num_frames - 75, walk.num_frames)):
        way = turn.root_position[-1] - turn.root_position[0]
        assert np.linalg.norm(way[[0, 2]]) < 0.4  # 1.6 m where the place is free
    way = circle.root_position[-1] - circle.root_position[0]
    assert np.linalg.norm(way[[0, 2]]) < 0.5 and abs(turn_of(circle)) > 350


def test_a_pelvis_that_is_led_turns_with_its_legs(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    for motion in sentences.generate(["a person walks four metres", "walks round the corner left"]):
        yaw = encode_features(motion)[15:-15, ROOT_ROW, YAW_RATE]
        assert 0.2 < float(np.std(np.asarray(yaw) - gaussian_filter1d(yaw, 12))) < 0.8


def test_texts_of_a_timeline_are_read_as_sentences_are(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    texts = ["a person walks two metres", "turns 90 degrees to the left, then squats twice"]
    free = sentences.timeline(Timeline.of(texts), Sampling(seed=1))
    (one,) = sentences.generate([", then ".join(texts)], seed=1)
    assert free.num_frames == one.num_frames and free.text == one.text
    np.testing.assert_array_equal(free.quaternions, one.quaternions)
    timed = Timeline((Passage(texts[0], 90), Passage(texts[1], 241)))
    made = sentences.timeline(timed, Sampling(seed=1))
    assert made.num_frames == 331
    walk, turn, squats = made.frames(0, 90), made.frames(90, 210), made.frames(210, 331)
    assert np.linalg.norm(walk.root_position[-1, [0, 2]]) == pytest.approx(2.0, abs=0.1)
    assert turn_of(turn) == pytest.approx(90, abs=5) and measure(squats).squats == 2
    with pytest.raises(UserError, match=r"asks for 2 things in 0\.3 s; give it 0\.4 s"):
        sentences.timeline(Timeline((Passage(texts[1], 9),)), Sampling())
    with pytest.raises(UserError, match="too long for its time"):
        sentences.timeline(Timeline((Passage("a person walks 9 metres", 30),)), Sampling())


def test_a_greeting_and_thanks_say_nothing(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    polite, plain = "Bonjour, une femme saute, merci", "une femme saute"
    made, bare = (sentences.generate([prompt], seconds=2.0)[0] for prompt in (polite, plain))
    assert np.array_equal(made.quaternions, bare.quaternions)
    assert (made.text, bare.text) == (polite, plain)
    assert sentences.scope_warnings([polite]) == sentences.scope_warnings([plain])


def test_what_is_denied_is_not_heard(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    denied, plain = "She doesn't run, she walks.", "she walks"
    made, bare = (sentences.generate([prompt], seconds=2.0)[0] for prompt in (denied, plain))
    assert np.array_equal(made.quaternions, bare.quaternions) and made.text == denied
    assert sentences.scope_warnings([denied]) == sentences.scope_warnings([plain])


def test_metres_that_nobody_goes_in_their_seconds_take_their_own(
    sentences: SentenceGenerator, caplog: pytest.LogCaptureFixture
):
    fast, other = sentences.generate(["walk ten metres in two seconds", "a person waves"])
    assert fast.seconds > 2.5 and other.num_frames == 120
    assert "too long for its time" in caplog.text


def test_who_stands_further_on_is_led_there_at_once(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch
):
    sentences, made = SentenceGenerator(starter), []
    for free in (1.0, 0.0):
        monkeypatch.setattr("src.shared.pipelines.text.STOP", free)
        made += sentences.generate(["runs, then stands two metres further"], seconds=3.0)
    np.testing.assert_array_equal(*[motion.root_position for motion in made])


@pytest.mark.parametrize(
    ("steps", "least", "most"),
    [
        # eight: counted claps lie where others do, and `generate` samples them again (section 74)
        pytest.param(6, 11, 12, marks=pytest.mark.xfail(strict=True)),
        (1, 0, 0),  # hands need to be brought together
    ],
)
def test_claps_of_an_edit_are_seen_as_they_are_made(
    starter: TextToMotion, steps: int, least: int, most: int
):
    seen = SentenceGenerator(starter).unseen("claps")
    assert seen is not None
    samples = starter.sample_features(["claps three times"] * 12, seconds=3.0, steps=steps)
    assert least <= sum(seen(made) == 0 for made in samples) <= most


def test_hands_that_do_something_else_are_not_brought_together(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch
):
    spans: list[tuple[int, ...]] = []
    monkeypatch.setattr(
        "src.shared.pipelines.text.hands_meet", lambda m, *span: spans.append(span) or m
    )
    sentences = SentenceGenerator(starter)
    sentences.generate(["walks, then claps while raising the left arm"], seconds=3.0)
    assert not [start for start, _ in spans if start]  # what is tried begins at 0
    sentences.generate(["walks, then claps twice"], seconds=3.0)
    assert [start for start, _ in spans if start]


def test_what_kinematics_miss_is_sampled_again(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
):
    assert starter.scope is not None
    starter.scope = replace(starter.scope, checked=("jump",))

    scales: list[float | None] = []
    sample = starter.generate

    def listening(*given: Any, **options: Any) -> list[Motion]:
        scales.append(options["guidance_scale"])
        return sample(*given, **options)

    monkeypatch.setattr(starter, "generate", listening)

    def made(check: Check, steps: int = 6) -> list[np.ndarray]:
        monkeypatch.setitem(ACTIONS, "jump", check)
        scales.clear()
        prompts = ["a person jumps", "a person walks forward"]
        sentences = SentenceGenerator(starter)
        found = sentences.generate(prompts, seconds=2.0, steps=steps)
        refused.append(measure(found[0]))
        lines = [sentences.missed(*pair) for pair in zip(prompts, found, strict=True)]
        assert lines[1] is None and (lines[0] is None) == check(refused[-1])
        assert [r.getMessage() for r in caplog.records] == [line for line in lines if line]
        caplog.clear()
        return [motion.quaternions for motion in found]

    refused: list[Measurements] = []
    first, never = made(lambda m: True), made(lambda m: False)
    insisting = INSISTING * starter.network.generation.guidance_scale
    assert scales == [None, *[insisting] * (TRIES - 1)]
    other = made(lambda m: m != refused[0])
    np.testing.assert_array_equal(never[0], first[0])  # where none will do the first one stays
    assert not np.array_equal(other[0], first[0])
    np.testing.assert_array_equal(other[1], first[1])
    made(lambda m: False, steps=2)
    assert scales == [None] * TRIES  # guidance is part of a learned step


def test_so_many_times_is_so_many_times(starter: TextToMotion):
    assert starter.scope is not None
    starter.scope = replace(starter.scope, checked=("squat",))
    sentences = SentenceGenerator(starter)
    prompts = [f"a man squats {number} times" for number in ("two", "three", "four")]
    made = sentences.generate(prompts, seconds=4.0)
    assert [measure(motion).squats for motion in made] == [2, 3, 4]


def test_an_arm_waves_while_the_body_walks(starter: TextToMotion):
    assert starter.scope is not None
    starter.scope = replace(starter.scope, arms=("wave", "raise"))
    sentences = SentenceGenerator(starter)
    prompts = ["walks forward", "walks forward while waving with the right hand"]
    walk, both = (sentences.generate([each], seconds=3.0)[0] for each in prompts)
    seen = measure(both)
    assert seen.forward == pytest.approx(measure(walk).forward, abs=0.3) and seen.forward > 2
    assert ACTIONS["walk"](seen) and ACTIONS["wave"](seen)
    assert seen.hand_peak[1] > 0.2 > -0.3 > seen.hand_peak[0]


def test_any_length_goes_through_windows(sentences: SentenceGenerator, caplog):
    (motion,) = sentences.generate(["a person walks"], seconds=12.0)
    assert motion.num_frames == 360
    assert "longer than" not in caplog.text


def test_samples_differ_and_a_seed_is_a_motion(sentences: SentenceGenerator):
    first, second = sentences.generate(["walk, then jump"], seconds=1.0, num_samples=2)
    (again,) = sentences.generate(["walk, then jump"], seconds=1.0)
    np.testing.assert_array_equal(first.quaternions, again.quaternions)
    assert not np.allclose(first.quaternions, second.quaternions)


def test_faulty_input_is_refused(sentences: SentenceGenerator):
    for seconds in (float("nan"), float("inf"), -1.0, 0.01):
        with pytest.raises(UserError, match="seconds"):
            sentences.generate(["a person walks"], seconds=seconds)
    with pytest.raises(UserError, match="empty"):
        sentences.generate(["  "])


@pytest.mark.parametrize("degrees", [45.0, -90.0, 360.0])
def test_a_turn_begins_and_ends_at_rest(degrees: float):
    given = turned(degrees, 30.0)
    rate = given.values[:, ROOT_ROW, YAW_RATE]
    assert float(rate.sum()) / 30 == pytest.approx(np.radians(degrees), rel=1e-4)
    assert not rate[:10].any() and not rate[-10:].any()
    assert torch.equal(
        given.known.nonzero()[:, 1:].unique(dim=0), torch.tensor([[ROOT_ROW, YAW_RATE]])
    )


PROMPTS = ["a person walks forward", "somebody jumps"]


def test_candidates_are_the_generators_and_the_best_is_the_judges() -> None:
    generator = tiny_generator()
    results = PromptSampler(generator).sample(
        PROMPTS, 3, seconds=[0.5, 1.0], seed=4, return_all=True
    )
    plain = generator.generate(PROMPTS, seconds=[0.5, 1.0], seed=4, num_samples=3)
    assert len(results) == 2
    for number, result in enumerate(results):
        assert result.all_candidates is not None
        for mine, other in zip(result.all_candidates, plain[3 * number :], strict=False):
            np.testing.assert_array_equal(mine.quaternions, other.quaternions)
        prompt = generator.encode_prompts([PROMPTS[number]]).pooled[0]
        table = TextJudge().judge(result.all_candidates, prompt)
        assert result.motion is result.all_candidates[table.best]
        np.testing.assert_array_equal(result.table.order, table.order)


def test_the_others_are_left_out_unless_asked_for() -> None:
    (result,) = PromptSampler(tiny_generator()).sample(PROMPTS[:1], 2, seconds=0.5)
    assert result.all_candidates is None and len(result.table.order) == 2


def test_what_follows_something_is_done_once(starter: TextToMotion) -> None:
    """In four seconds of their own people jumped twice in four of ten sequences."""
    sentences, once = SentenceGenerator(starter), 0
    for seed in range(3):
        (motion,) = sentences.generate(["a man walks forward, then jumps"], seed=seed)
        jump = motion.frames(round(4.0 * motion.fps), motion.num_frames)
        assert jump.num_frames == round(3.0 * motion.fps)
        once += measure(jump).jumps == 1
    assert once >= 2


@pytest.mark.parametrize("seconds", [3.0, 4.0, 5.0, 9.0])
def test_uncounted_claps_take_the_seconds_that_they_are_given(
    starter: TextToMotion, seconds: float
) -> None:
    made = SentenceGenerator(starter)
    [motion] = made.generate(["a person claps"], seconds=seconds, steps=2)
    assert motion.num_frames == round(seconds * 30)
    assert not made._applauds(made.clauses("a person claps once")[0])


def test_hands_meet_where_a_person_claps(starter: TextToMotion) -> None:
    for seed in range(2):
        [motion] = SentenceGenerator(starter).generate(["a person claps"], seconds=4.0, seed=seed)
        hands = motion.positions()[:, [JOINT_INDEX[f"{side}_wrist"] for side in "lr"]]
        assert np.linalg.norm(hands[:, 0] - hands[:, 1], axis=-1).min() < 0.12


@pytest.mark.parametrize(
    ("prompt", "most"),
    [
        ("nods three times", 3.0),
        ("schüttelt viermal den Kopf", 4.0),
        ("hops on one leg twice", 3.0),
    ],
)
def test_what_is_done_in_cycles_takes_the_time_of_so_many(
    prompt: str, most: float, loaded: TextToMotion
) -> None:
    """Each had 2.5 s or more, in which it was done two or three times."""
    sentences = SentenceGenerator(loaded)
    [motion] = sentences.generate([prompt])
    assert 2.0 <= motion.seconds <= most
    assert sentences.scope_warnings([prompt]) == [None]


@pytest.mark.parametrize(
    ("prompt", "action", "limbs"),
    [("salutes with the left hand", "salute", "wrist"), ("用左手喝水", "drink", "wrist"),
     ("hops on the left leg twice", "hop", "ankle"),
     ("un salut militaire de la main gauche", "salute", "wrist")],
)  # fmt: skip
def test_what_was_learned_of_one_side_is_mirrored_for_the_other(
    prompt: str, action: str, limbs: str, loaded: TextToMotion
) -> None:
    """Who salutes with the left hand waved."""
    sentences = SentenceGenerator(loaded)
    [clause] = sentences.clauses(prompt)
    assert clause.mirrored and sentences._nearest(clause.text) == action
    [left] = sentences.generate([prompt])
    [right] = sentences.generate([re.sub("left|gauche|左", lambda s: OTHER[s[0]], prompt)])
    assert right.num_frames == left.num_frames
    names = [JOINT_INDEX[f"{side}_{limbs}"] for side in "lr"]
    moved = [
        np.abs(np.diff(each.positions()[:, names], axis=0)).sum((0, 2)) for each in (left, right)
    ]
    np.testing.assert_allclose(moved[0], moved[1][::-1], rtol=0.02)
    assert not 0.8 < moved[0][0] / moved[0][1] < 1.25


OTHER = {"left": "right", "gauche": "droite", "左": "右"}


def test_what_goes_on_lower_is_shown_once(loaded: TextToMotion) -> None:
    """Who crawls and then dies crawled the last half second twice."""
    passages = [Passage("crawls", 120), Passage("dies", 120)]
    features, spans = spanned_features(loaded, passages, Sampling(seed=0))
    (start, stop), (begin, end) = spans
    assert start == 0 and stop <= begin < end == len(features)
    assert end - begin < 120  # it begins where it is down
    motion = SentenceGenerator(loaded).generate(["crawls, then dies"])[0]
    assert motion.num_frames == len(features)


def test_who_sits_keeps_his_legs(loaded: TextToMotion) -> None:
    [motion] = SentenceGenerator(loaded).generate(["sits and drinks with the left hand"])
    knees = motion.positions()[20:, [JOINT_INDEX["l_knee"], JOINT_INDEX["r_knee"]], 1]
    assert np.ptp(knees, axis=0).max() < 0.12


@pytest.mark.parametrize(
    "prompt",
    ["walks while saluting with the left hand", "he salutes with the left hand while walking",
     "歩きながら左手で敬礼する", "camina mientras saluda militarmente con la mano izquierda"],
)  # fmt: skip
def test_the_arms_of_who_walks_are_mirrored_alone(prompt: str, loaded: TextToMotion) -> None:
    sentences = SentenceGenerator(loaded)
    [clause] = sentences.clauses(prompt)
    assert clause.meanwhile and clause.mirrored
    assert [sentences._nearest(each) for each in (clause.text, clause.meanwhile)] == [
        "walk",
        "salute",
    ]
    [motion] = sentences.generate([prompt])
    wrists = motion.positions()[:, [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]], 1]
    assert wrists[:, 0].max() > wrists[:, 1].max() + 0.3  # the left one is raised
    assert np.linalg.norm(np.diff(motion.root_position[:, [0, 2]], axis=0), axis=1).sum() > 2.0


def test_arms_last_as_long_as_what_goes_on_lower(loaded: TextToMotion) -> None:
    """They had the frames that are left out where the body is low already."""
    sentences = SentenceGenerator(loaded)
    [low] = sentences.generate(["crawls, then lies down while waving"])
    [stands] = sentences.generate(["crawls, then lies down while waving, then stands up"])
    wrists = [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]]
    assert np.isfinite(low.positions()).all() and stands.num_frames > low.num_frames
    assert stands.positions()[-15:, wrists, 1].max() < 1.0  # nobody waves any more


@pytest.mark.parametrize("text", ["nods once", "nickt einmal", "点一次头"])
def test_what_is_done_in_cycles_is_done_once_where_that_is_said(starter: TextToMotion, text: str):
    sentences = SentenceGenerator(starter)
    (motion,), (longer,) = (sentences.generate([each], steps=2) for each in (text, "nods"))
    assert motion.seconds == pytest.approx(1.5, abs=0.1) and longer.seconds == 4.0
    (waves,) = sentences.generate(["waves once"], steps=2)
    assert waves.seconds == 4.0


@pytest.mark.parametrize("text", ["an npc walks in", "the priest marches", "the pirate walks in"])
def test_nobody_goes_backwards_for_who_he_is(starter: TextToMotion, text: str):
    sentences = SentenceGenerator(starter)
    (motion,) = sentences.generate([text], seconds=3, steps=2)
    assert measure(motion).forward > 1.0
    (back,) = sentences.generate(["the priest walks backwards"], seconds=3, steps=2)
    assert measure(back).forward < -0.5


def test_a_head_that_is_not_down_stays_up():
    assert bows_head("walks, head down") and not bows_head("walks without his head down")


def test_a_blank_at_the_end_is_none_of_the_words(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    assert sentences.scope_warnings(["the tall robot "]) != [None]
    assert sentences.scope_warnings(["a zombie jumps twice"]) == [None]


def test_what_is_known_of_a_person_is_known_of_others(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    assert sentences.scope_warnings(["gets up from the floor"]) == [None]
    assert starter.scope_warnings(["gets up from the floor"]) != [None]
    assert sentences.scope_warnings(["juggles"]) != [None]


@pytest.mark.parametrize("text", ["walks forward, then kicks", "runs, then kicks the ball"])
def test_who_does_not_show_a_gesture_behind_another_stops_before_it(
    starter: TextToMotion, text: str
):
    sentences = SentenceGenerator(starter)
    [motion] = sentences.generate([text], seed=0)
    assert measure(motion.frames(motion.num_frames - 100, motion.num_frames)).kicks == (0, 1)
    assert motion.seconds in (8.5, 9.5)
    [whole] = sentences.generate(["turns left, then kicks"], seed=0)  # needs none
    assert whole.seconds < 8.0


def test_a_gesture_that_no_stop_helped_is_told(
    starter: TextToMotion, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
):
    sentences = SentenceGenerator(starter)
    monkeypatch.setattr(sentences, "_does", lambda text, motion: False)
    sentences.generate(["walks, then kicks"], steps=1)
    assert "'kicks' does not show" in caplog.text and "'walks' does not" not in caplog.text


def test_feet_stay_where_they_are_while_somebody_gets_up(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    [motion] = sentences.generate(["sits down, then stands up"], seed=0)
    at = motion.positions()
    pelvis, feet = at[:, 0], at[:, [JOINT_INDEX["l_ankle"], JOINT_INDEX["r_ankle"]]]
    low = pelvis[:, 1] < 0.7
    assert low.sum() > 60 and not low[-30:].any()
    assert abs(feet[-1, 1] - feet[0, 1]).max() < 0.15  # the right one stays, the left was lifted
    assert np.abs(pelvis[-1] - pelvis[0]).max() < 0.15  # forward over the feet, as it went back


def test_hands_meet_of_who_claps_meanwhile(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    [motion] = sentences.generate(["walks while clapping"], seed=0)
    at = motion.positions()
    gap = np.linalg.norm(at[:, JOINT_INDEX["l_wrist"]] - at[:, JOINT_INDEX["r_wrist"]], axis=1)
    assert gap.min() < 0.12 and measure(motion).claps >= 2


def test_a_zombie_goes_straight_on(starter: TextToMotion):
    sentences = SentenceGenerator(starter)
    motions = sentences.generate(["walk like a zombie"], num_samples=2, seed=0)
    assert max(abs(measure(each).yaw) for each in motions) < 0.2


@pytest.mark.parametrize(
    "text",
    ["walks, head down", "camina con la cabeza gacha", "il marche la tête baissée",
     "er geht mit gesenktem Kopf", "うつむいて歩く", "他低着头走路"],
)  # fmt: skip
def test_a_head_is_down_where_that_is_said(starter: TextToMotion, text: str):
    def pitch(motion: Motion) -> float:
        joints = motion.positions()
        neck = joints[:, JOINT_INDEX["head"]] - joints[:, JOINT_INDEX["neck"]]
        heading = motion_heading(motion)
        ahead = neck[:, 0] * np.sin(heading) + neck[:, 2] * np.cos(heading)
        return float(np.degrees(np.arctan2(ahead, neck[:, 1])).mean())

    sentences = SentenceGenerator(starter)
    [motion] = sentences.generate([text], seed=0)
    assert pitch(motion) > 12.0
    [both] = sentences.generate([f"a person walks, then {text}"], seed=0)
    half = both.num_frames // 2
    assert pitch(both.frames(half + 20, both.num_frames)) > pitch(both.frames(0, half)) + 8.0
