"""stream_features: windows of any number, each carrying the one before on."""

from collections.abc import Iterator
from dataclasses import replace
from functools import reduce
from itertools import pairwise

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from src.shared.errors import UsageError, UserError
from src.shared.metrics.measurements import Measurements, measure
from src.shared.model.diffusion import Sampling
from src.shared.model.generation.constraint import Constraint
from src.shared.model.generation.denoiser import MotionDenoiser
from src.shared.model.generation.motion_generator import TextToMotion
from src.shared.model.noise import TRIES, retry_seeds
from src.shared.motion.features import FORWARD, HEIGHT, ROOT_ROW, decode_features, hastened
from src.shared.motion.postprocess.stitching import joined
from src.shared.motion.postprocess.streaming import StreamingPostProcessor
from src.shared.pipelines import stream as motion_stream
from src.shared.pipelines.stream import (
    MotionStream,
    Passage,
    nearest_to_wanted,
    spanned_features,
    stream_features,
    window_lengths,
)
from tests.shared.model.conftest import tiny_generator

WALK, WAVE = Passage("a person walks", 70), Passage("a person waves", 33)


@pytest.fixture(scope="module")
def generator() -> TextToMotion:
    return tiny_generator()


def made(generator: TextToMotion, *passages: Passage, **settings: object) -> torch.Tensor:
    sampling = Sampling(seed=settings.pop("seed", 3))
    settings = {"window": 40, "overlap": 10} | settings
    return torch.cat(list(stream_features(generator, passages, sampling, **settings)))


@given(st.integers(1, 3000), st.integers(8, 180), st.data())
def test_windows_are_few_and_alike(frames: int, window: int, data: st.DataObject) -> None:
    overlap = data.draw(st.integers(1, window // 2))
    known = data.draw(st.integers(0, overlap))
    lengths = window_lengths(frames, known, window, overlap)
    assert sum(lengths) == frames and min(lengths) >= 1
    shared = [known] + [overlap] * (len(lengths) - 1)
    whole = [new + own for new, own in zip(lengths, shared, strict=True)]
    assert max(whole) <= window and max(whole) - min(whole) <= 1
    assert len(lengths) == 1 or frames + known > window
    fewer = window + (len(lengths) - 2) * (window - overlap)
    assert len(lengths) == 1 or frames + known > fewer


def test_length_and_seeds(generator: TextToMotion) -> None:
    first = made(generator, WALK, WAVE)
    assert first.shape == (103, 23, 6)
    torch.testing.assert_close(first, made(generator, WALK, WAVE), rtol=0, atol=0)
    assert not torch.allclose(first, made(generator, WALK, WAVE, seed=4))


def test_the_past_does_not_depend_on_the_future(generator: TextToMotion) -> None:
    whole = made(generator, WALK, WAVE)
    torch.testing.assert_close(made(generator, WALK), whole[:70], rtol=0, atol=0)


def test_one_window_is_what_the_generator_samples(generator: TextToMotion) -> None:
    (plain,) = generator.sample_features(["a person walks"], seconds=2.0, seed=3)
    torch.testing.assert_close(made(generator, Passage("a person walks", 60), window=60), plain)


def test_passages_are_taken_one_by_one(generator: TextToMotion) -> None:
    taken = []

    def endless() -> Iterator[Passage]:
        while True:
            taken.append(len(taken))
            yield Passage("a person walks", 12)

    pieces = stream_features(generator, endless(), window=40, overlap=10)
    assert [len(next(pieces)) for _ in range(3)] == [12, 12, 12]
    assert len(taken) == 3


def test_frames_made_ahead_are_gone_on_with_while_the_text_stays(generator: TextToMotion) -> None:
    """Three pieces of one window; then what is left of the next one is dropped for another text."""
    walk, wave = Passage("a person walks", 8), Passage("a person waves", 8)
    whole = made(generator, Passage("a person walks", 24))
    pieces = made(generator, *[walk] * 4, wave, ahead=16)
    torch.testing.assert_close(pieces[:24], whole, rtol=0, atol=0)
    assert pieces.shape == (40, 23, 6)
    torch.testing.assert_close(made(generator, *[walk] * 4, ahead=16), pieces[:32], rtol=0, atol=0)
    alone = made(generator, walk, wave, ahead=16)
    assert not torch.allclose(alone[8:], whole[8:16])


def test_what_is_given_comes_out(generator: TextToMotion) -> None:
    """Across windows, a path along the whole motion and a pose at its end."""
    asked = []
    values = torch.zeros(103, 23, 6)
    values[:, ROOT_ROW, FORWARD] = torch.linspace(0, 1, 103)
    values[-5:] = torch.randn(5, 23, 6, generator=torch.Generator().manual_seed(0))
    known = torch.zeros(values.shape, dtype=torch.bool)
    known[:, ROOT_ROW, FORWARD] = True
    known[-5:] = True

    def given(start: int, stop: int) -> Constraint:
        asked.append((start, stop))
        return Constraint(values[start:stop], known[start:stop])

    features = made(generator, WALK, WAVE, constraint=given)
    torch.testing.assert_close(features[known], values[known])
    assert asked[0][0] == 0 and asked[-1][1] == 103
    assert all(later[0] == earlier[1] - 10 for earlier, later in pairwise(asked))


def test_each_window_knows_the_one_before(generator: TextToMotion, monkeypatch) -> None:
    seen = []
    plain = generator.sample_features

    def watched(prompts: list[str], **settings: object) -> list[torch.Tensor]:
        seen.append((prompts[0], settings["constraints"][0]))
        return plain(prompts, **settings)

    monkeypatch.setattr(generator, "sample_features", watched)
    whole = made(generator, WALK, WAVE)
    assert [text for text, _ in seen] == ["a person walks"] * 2 + ["a person waves"] * 2
    start = 0
    for number, (_, constraint) in enumerate(seen):
        shared = 10 if number else 0
        assert constraint.known[:shared].all() and not constraint.known[shared:].any()
        torch.testing.assert_close(constraint.values[:shared], whole[start - shared : start])
        start += motion_lengths()[number]


def motion_lengths() -> list[int]:
    return window_lengths(70, 0, 40, 10) + window_lengths(33, 10, 40, 10)


def test_short_windows_are_made_longer_and_cut(generator: TextToMotion) -> None:
    assert made(generator, Passage("a person walks", 1)).shape[0] == 1
    assert motion_stream.SHORTEST > 1


def test_what_cannot_be(generator: TextToMotion) -> None:
    with pytest.raises(UsageError, match="overlap 30"):
        made(generator, WALK, overlap=30)
    with pytest.raises(UsageError, match="0 frames"):
        Passage("a person walks", 0)
    with pytest.raises(UsageError, match="5 frames was given where 40 were asked"):
        made(generator, WALK, constraint=lambda start, stop: Constraint.free(5), window=45)
    with pytest.raises(UserError, match="empty"):
        made(generator, Passage(" ", 20))


def test_a_stream_is_its_features_post_processed_in_pieces(generator: TextToMotion) -> None:
    features = made(generator, WALK, WAVE)
    sampling = Sampling(seed=3)
    stream = MotionStream(generator, [WALK, WAVE], window=40, overlap=10, sampling=sampling)
    assert stream.latency.first is None
    pieces = list(stream)
    assert {piece.text for piece in pieces} == {WALK.text, WAVE.text}
    processor = StreamingPostProcessor(generator.post_processor)
    settled = [processor.add(features), processor.finish()]
    whole = reduce(joined, [piece for piece in settled if piece is not None])
    motion = reduce(joined, pieces)
    np.testing.assert_allclose(motion.positions(), whole.positions(), atol=1e-5)
    latency = stream.latency
    assert latency.first is not None and latency.load is not None
    assert 0 < latency.lookahead < latency.reaction < 2


def test_prompts_change_while_it_runs(generator: TextToMotion) -> None:
    stream = MotionStream(generator, "a person walks", seconds=0.5, foot_lock=True)
    texts = []
    for number, piece in enumerate(stream):
        texts.append(piece.text)
        if number == 2:
            stream.say("somebody jumps twice")
        if number == 4:
            stream.stop()
    assert texts[:3] == ["a person walks"] * 3
    # From the window on that was made next, whatever had settled when it was said.
    shown = [stream.text_at(frame) for frame in range(120)]
    first = shown.count("a person walks")
    assert first % 15 == 0 and 45 <= first <= 75
    assert set(shown[first:]) == {"somebody jumps twice"}


def test_a_generator_of_prompts(generator: TextToMotion) -> None:
    texts = (text for text in ("a person walks", "a person waves"))
    stream = MotionStream(generator, texts, seconds=0.6)
    assert sum(piece.num_frames for piece in stream) == 36
    assert list(MotionStream(generator, [])) == []


def test_what_a_standing_body_begins_is_as_it_is_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """After a clap, which nobody recorded, a wave is a recorded one still, and no frame jumps;
    after a bow a kick comes, which did not where the window knew of the bow."""
    starter = TextToMotion.from_pretrained("starter", device="cpu", runtime="onnx")

    def made(*texts: str) -> list[torch.Tensor]:
        return list(stream_features(starter, [Passage(text, 120) for text in texts]))

    def measured(features: torch.Tensor) -> Measurements:
        return measure(decode_features(features, fps=30.0))

    clap, wave = made("a person claps", "a person waves with the left hand")
    assert max(measured(wave).hand_peak) > 0.8
    steps = torch.cat((clap, wave)).diff(dim=0).abs().amax((1, 2))
    assert steps[119] < steps[120:].max()
    bow_and_kick = "a person bows", "a person kicks"
    assert sum(measured(made(*bow_and_kick)[1]).kicks) == 1
    with monkeypatch.context() as patched:
        patched.setattr(motion_stream, "stands", lambda before, fps: False)
        assert sum(measured(made(*bow_and_kick)[1]).kicks) == 0
    [walk] = stream_features(starter, [Passage("a person walks forward", 60)])
    assert motion_stream.stands(clap, 30.0) and not motion_stream.stands(walk, 30.0)


def test_who_is_down_gets_up_before_he_goes_on() -> None:
    """Lying bodies stood in a third of a second; now there is a way, which the frames of a passage
    hold where its times are told."""
    starter = TextToMotion.from_pretrained("starter", device="cpu", runtime="onnx")
    lies = Passage("a person lies down on the floor", 120)
    throws = Passage("a person throws a ball", 90)

    def fastest(features: torch.Tensor) -> float:
        height = features[:, ROOT_ROW, HEIGHT].numpy()
        return float(np.abs(height[15:] - height[:-15]).max()) * 2  # metres a second

    assert fastest(torch.cat(list(stream_features(starter, [lies, throws])))) > 1.4
    features, spans = spanned_features(starter, [lies, throws])
    assert spans == [(0, 120), (186, 276)] and len(features) == 276
    assert fastest(features) < 1.2
    features, spans = spanned_features(starter, [lies, replace(throws, timed=90)])
    assert spans == [(0, 120), (120, 210)] and len(features) == 210
    assert fastest(features) < 1.4
    stream = MotionStream(starter, [lies, throws])
    assert sum(piece.num_frames for piece in stream) == 276
    walks = [Passage("a person walks forward", 90), Passage("a person waves", 90)]
    assert spanned_features(starter, walks)[1] == [(0, 90), (90, 180)]  # nothing leaps


def test_without_a_root_track_nothing_is_bridged(generator: TextToMotion) -> None:
    network = generator.network.model_copy(update={"root_track": False})
    rootless = TextToMotion(
        MotionDenoiser(network, 2), generator.text, generator.tokenizer,
        mean=generator.mean[:22], std=generator.std[:22], card=generator.card, device="cpu",
    )  # fmt: skip
    walks = [Passage("a person walks", 40), Passage("a person jumps", 40)]
    features, spans = spanned_features(rootless, walks)
    assert features.shape == (80, 22, 6) and spans == [(0, 40), (40, 80)]
    assert hastened(features, 1.6).shape == (50, 22, 6)


def test_nothing_to_say_is_refused_and_the_stream_goes_on(generator: TextToMotion) -> None:
    stream = MotionStream(generator, "a person walks forward", seconds=1.0)
    pieces = iter(stream)
    next(pieces)
    with pytest.raises(UsageError, match="holds no word"):
        stream.say("  ")
    assert next(pieces).num_frames > 0


def test_a_window_is_sampled_again_until_it_is_what_is_wanted():
    own = torch.zeros(2, 1, 1)
    tries = [torch.full((3, 1, 1), value) for value in (4.0, 2.0, 1.0, 0.0)]
    asked = []

    def miss(features: torch.Tensor) -> float:
        asked.append(len(features))
        return float(features[-1].item())

    assert nearest_to_wanted(iter(tries), own, None) == (tries[0], 0)
    assert nearest_to_wanted(iter(tries), own, miss) == (tries[3], 3) and asked == [5] * 4
    assert nearest_to_wanted(iter(tries[:3]), own, miss) == (tries[2], 2)
    seeds = list(retry_seeds(7))
    assert seeds[0] == 7 and len(set(seeds)) == TRIES
