"""A live body: frames in order, sentences seen, an end."""

import threading
import time

import numpy as np
import pytest

from src.shared.errors import UsageError
from src.shared.model.diffusion import Sampling
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.pipelines.live import AHEAD, Frame, LiveBody, parse_address
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.model.conftest import tiny_generator


@pytest.fixture(scope="module")
def generator() -> MotionGenerator:
    made: TextToMotion = tiny_generator(constraints=True)
    return MotionGenerator(made)


def body(generator: MotionGenerator, **options: object) -> LiveBody:
    settings = {"sampling": Sampling(seed=1, steps=2), "window": 0.4, "real_time": False}
    return LiveBody(generator, "a person walks forward", **(settings | options))


def test_frames_are_those_of_the_stream(generator: MotionGenerator) -> None:
    frames: list[Frame] = []
    figures = body(generator).play([frames.append], seconds=2.0)
    assert [frame.number for frame in frames] == list(range(60)) and figures.frames == 60
    stream = generator.stream(
        "a person walks forward", seconds=0.4, ahead=AHEAD, sampling=Sampling(seed=1, steps=2)
    )
    wanted: list[np.ndarray] = []
    for piece in stream:
        wanted.extend(piece.quaternions)
        if len(wanted) >= 60:
            break
    np.testing.assert_array_equal([frame.quaternions for frame in frames], wanted[:60])
    assert figures.speed > 0


def test_a_body_in_place_moves_as_it_does_and_goes_nowhere(generator: MotionGenerator) -> None:
    there: list[Frame] = []
    here: list[Frame] = []
    body(generator).play([there.append], seconds=1.0)
    body(generator, in_place=True).play([here.append], seconds=1.0)
    for frame, same in zip(here, there, strict=True):
        np.testing.assert_array_equal(frame.quaternions, same.quaternions)
        assert frame.root.tolist() == [0.0, same.root[1], 0.0]


def test_a_sentence_is_seen_and_its_delay_told(generator: MotionGenerator) -> None:
    live, texts = body(generator), []

    def sink(frame: Frame) -> None:
        texts.append(frame.text)
        if frame.number == 20:
            live.say("somebody jumps twice")

    figures = live.play([sink], seconds=4.0)
    assert texts[0] == "a person walks forward" and texts[-1] == "somebody jumps twice"
    assert texts == sorted(texts, key=["a person walks forward", "somebody jumps twice"].index)
    assert len(figures.latencies) == 1 and 0 < figures.latencies[0] < 60


def test_a_live_body_does_one_thing_after_the_other_and_goes_straight() -> None:
    def moved(text: str, seconds: float) -> tuple[np.ndarray, np.ndarray]:
        frames: list[Frame] = []
        starter = MotionGenerator("starter", device="cpu")
        live = LiveBody(starter, text, sampling=Sampling(seed=1, steps=2), real_time=False)
        live.play([frames.append], seconds=seconds)
        root = np.stack([frame.root for frame in frames])
        return root, np.stack([frame.quaternions for frame in frames])

    root, _ = moved("a person walks two metres, then waves", 8.0)
    assert 1.2 < np.linalg.norm(root[-1] - root[0]) < 4.0  # who walks on is 9 m away
    assert np.ptp(root[-60:], axis=0).max() < 0.1
    root, _ = moved("a person walks forward", 40.0)  # turned by 90 degrees, when nothing led it
    way = root[-1] - root[0]
    assert np.linalg.norm(way) > 35.0 and abs(np.degrees(np.arctan2(way[0], way[2]))) < 12.0


def test_ways_that_bend_are_not_straightened() -> None:
    starter = MotionGenerator("starter", device="cpu")
    ways = starter.sentences.ways
    asked = ["a person walks forward", "he walks backwards", "a person side-steps to the left",
             "walks in a circle", "a person walks in a zigzag", "takes the next left"]  # fmt: skip
    assert [ways.goes_straight(text) for text in asked] == [True] * 3 + [False] * 3
    short, last = starter._plan("waves for 0.01 seconds, then bows")
    assert short.frames == 1 and last.frames == 90


def test_it_ends_so_many_seconds_later(generator: MotionGenerator) -> None:
    live, seen = body(generator), []

    def sink(frame: Frame) -> None:
        seen.append(frame.number)
        if frame.number == 9:
            live.stop(0.5)

    live.play([sink])
    assert 20 <= len(seen) <= 26


def test_real_time_is_kept(generator: MotionGenerator) -> None:
    import time

    live, times = body(generator, real_time=True), []
    live.play([lambda frame: times.append(time.perf_counter())], seconds=0.5)
    assert times[-1] - times[0] >= 0.45


def test_faults_reach_who_listens(generator: MotionGenerator) -> None:
    with pytest.raises(UsageError, match="sampler"):
        body(generator, sampling=Sampling(sampler="euler")).play([print], seconds=1.0)
    with pytest.raises(UsageError, match="no word"):
        body(generator).say(" … ")


@pytest.mark.parametrize(
    ("text", "wanted"),
    [("39540", ("127.0.0.1", 39540)), ("pc", ("pc", 39539)), ("10.0.0.2:1", ("10.0.0.2", 1))],
)
def test_addresses(text: str, wanted: tuple[str, int]) -> None:
    assert parse_address(text, 39539) == wanted


@pytest.mark.parametrize("text", ["70000", "pc:x", "0", ""])
def test_wrong_addresses(text: str) -> None:
    with pytest.raises(UsageError, match="no address"):
        parse_address(text, 39539)


def test_lines_of_a_pipe_wait_for_their_turn(generator: MotionGenerator) -> None:
    live, seen = body(generator), list[str]()

    def said() -> None:
        live.wait(1.0)
        live.say("somebody jumps")
        live.wait(1.0)
        live.say("somebody waves")

    threading.Thread(target=said, daemon=True).start()

    def sink(frame: Frame) -> None:
        seen.append(frame.text)
        time.sleep(0.01)  # as slowly as whoever looks at it

    live.play([sink], seconds=8.0)
    assert list(dict.fromkeys(seen))[1:] == ["somebody jumps", "somebody waves"]
    assert seen.count("somebody jumps") >= 15
