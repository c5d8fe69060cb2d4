"""Figures on the counts of a song: in time, without jumps, standing where nobody dances."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import torch

from src.shared.memory.figures import FPS
from src.shared.metrics.rhythm import body_beats, rhythm
from src.shared.metrics.seams import body_quantities
from src.shared.model.diffusion import Sampling
from src.shared.motion.features import (
    LEFT_CONTACT,
    ROOT_ROW,
    YAW_RATE,
    decode_features,
    encode_features,
)
from src.shared.motion.postprocess.whole import hanging_arms
from src.shared.motion.staging import Manner, settled, stepped
from src.shared.pipelines.body import Performer, PerformerSettings
from src.shared.pipelines.choreography import Choreographer, Wish
from src.shared.pipelines.dance import SongPerformer
from src.shared.pipelines.figure_dance import (
    BLEND,
    FigureDancer,
    accented,
    blended,
    lay,
    listed,
    on_beats,
)
from src.shared.pipelines.song import SongCondition, song_slots
from tests.shared.memory.tiny_figures import tiny_figures
from tests.shared.model.conftest import tiny_generator
from tests.shared.pipelines.test_choreography import song


@pytest.fixture(scope="module")
def choreographer() -> Choreographer:
    return Choreographer(tiny_figures())


def condition(silent: tuple[int, int] | None = None, tempo: float = 110.0) -> SongCondition:
    beats, phase, rows = song(tempo, 12.0)
    rows[160] = 1.0
    if silent is not None:
        rows[160, slice(*silent)] = 0.0
    return SongCondition(torch.from_numpy(rows).float(), phase, beats, 3)


def test_counts_fall_on_beats_and_seams_are_not_seen(choreographer: Choreographer) -> None:
    beats, phase, rows = song(110.0, 12.0)
    slots = song_slots(beats, phase, rows)
    chosen = choreographer.choose(slots, Wish(), 0)
    assert chosen is not None
    features, danced = lay(choreographer.memory, slots, chosen, 360)
    assert features.shape == (360, 23, 6) and danced.float().mean() > 0.8
    assert set(features[:, ROOT_ROW, LEFT_CONTACT:].flatten().tolist()) <= {0.0, 1.0}
    motion = decode_features(features)
    assert rhythm(body_beats(motion), beats, motion.seconds).f > 0.6
    hard = decode_features(lay(choreographer.memory, slots, chosen, 360, blend=0.01)[0])
    seams = [round(float(slot.counts[0]) * FPS) for slot in slots[1:]]
    worst = [
        max(body_quantities(each)["acceleration, m/s²"][s - 3 : s + 4].max() for s in seams)
        for each in (motion, hard)
    ]
    assert worst[0] <= worst[1] + 1e-6 and BLEND > 0.1


def test_a_body_a_little_late_is_brought_to_the_beats() -> None:
    motion = tiny_figures().takes[0].motion
    beats = body_beats(motion)[2:-2] - 0.1
    features = encode_features(motion)
    before, after = (
        rhythm(body_beats(decode_features(each)), beats, motion.seconds).f
        for each in (features, on_beats(features, beats))
    )
    assert before < 0.4 and after > 0.8
    far = on_beats(features, beats[:1] - 30.0)  # no beat is near
    assert torch.allclose(far, features, atol=1e-5)


def test_far_poses_are_blended_at_an_even_pace() -> None:
    """Of two turns 170 degrees apart, which the way through the middle passes within a frame."""
    angle = np.radians(170) / 2
    first = torch.tensor([1.0, 0, 0, 0]).expand(11, 4)
    second = torch.tensor([np.cos(angle), 0, np.sin(angle), 0]).float().expand(11, 4)
    found = blended(first, second, torch.linspace(0, 1, 11)[:, None])
    turned = 2 * torch.atan2(found[:, 2], found[:, 0])
    np.testing.assert_allclose(np.degrees(turned.numpy()), np.linspace(0, 170, 11), atol=0.1)
    assert torch.equal(blended(torch.zeros(1, 4), first[:1], torch.ones(1, 1)), first[:1])


def test_beats_that_nothing_marks_slow_the_body_down() -> None:
    still = torch.zeros(120, 23, 6)
    still[..., 0] = still[..., 4] = 1.0
    angle = torch.arange(120.0) * 0.05  # of one shoulder, steadily
    still[:, 16, 0], still[:, 16, 1] = angle.cos(), angle.sin()
    still[:, 16, 3], still[:, 16, 4] = -angle.sin(), angle.cos()
    turned = accented(still, np.arange(0.5, 4.0, 0.5))
    shown = np.unwrap(torch.atan2(turned[:, 16, 1], turned[:, 16, 0]).numpy())
    speed = np.gradient(shown) / 0.05
    assert speed[[30, 45, 60, 75, 90]] == pytest.approx(0.8, abs=0.03)
    assert speed[[37, 52, 67, 82]] == pytest.approx(1.2, abs=0.03)
    assert shown[[30, 60, 90]] == pytest.approx(angle[[30, 60, 90]].numpy(), abs=1e-3)
    slow = accented(still, np.arange(0.5, 4.0, 1.0))  # as hard, for as long a beat
    shown = np.unwrap(torch.atan2(slow[:, 16, 1], slow[:, 16, 0]).numpy())
    assert np.gradient(shown)[[45, 75]] / 0.05 == pytest.approx(0.64, abs=0.03)


def test_a_dance_comes_to_rest_in_its_last_pose() -> None:
    spinning = torch.zeros(120, 23, 6)
    spinning[..., 0] = spinning[..., 4] = 1.0
    spinning[:, ROOT_ROW] = 0.0
    spinning[:, ROOT_ROW, YAW_RATE] = 1.0
    angle = torch.arange(120.0) * 0.05  # of one shoulder, steadily
    spinning[:, 16, 0], spinning[:, 16, 1] = angle.cos(), angle.sin()
    spinning[:, 16, 3], spinning[:, 16, 4] = -angle.sin(), angle.cos()
    assert settled(spinning, 3.0, 1.0) is spinning  # in the air all along
    spinning[100:, ROOT_ROW, LEFT_CONTACT:] = 1.0
    assert settled(spinning, 3.0, 1.0) is spinning  # it lands
    spinning[100:, ROOT_ROW, LEFT_CONTACT:] = 0.0
    spinning[:81, ROOT_ROW, LEFT_CONTACT] = 1.0
    rested = settled(spinning, 3.0, 1.0)  # where a foot last stood
    shown = np.unwrap(torch.atan2(rested[:, 16, 1], rested[:, 16, 0]).numpy())
    assert shown[80:] == pytest.approx(float(angle[80]), abs=0.02)
    assert float(rested[81:, ROOT_ROW, YAW_RATE].abs().max()) < 1e-6
    assert bool((rested[80:, ROOT_ROW, LEFT_CONTACT] == 1.0).all())
    spinning[:, ROOT_ROW, LEFT_CONTACT:] = 1.0
    rested = settled(spinning, 3.0, 1.0)
    shown = np.unwrap(torch.atan2(rested[:, 16, 1], rested[:, 16, 0]).numpy())
    assert torch.allclose(rested[:60], spinning[:60], atol=1e-5)
    assert np.abs(np.diff(shown)).max() < 0.05 * 1.4
    assert shown[89] == pytest.approx(float(angle[90]), abs=0.02)
    assert abs(shown[89] - shown[87]) < 0.03 and rested[89, ROOT_ROW, YAW_RATE] < 0.15


def test_arms_hang_where_nobody_dances_for_long(choreographer: Choreographer) -> None:
    features = choreographer.memory.features[:240].clone()
    danced = torch.ones(240, dtype=torch.bool)
    danced[60:180] = False
    dancer = FigureDancer(choreographer, tiny_generator())
    found = dancer._standing(features, danced, Sampling(steps=2))
    assert torch.allclose(found[:60], features[:60], atol=1e-4)
    for joint, row in hanging_arms().items():
        assert torch.allclose(found[90:150, joint], row.expand(60, 6), atol=1e-4)


def test_a_robot_stops_on_counts(choreographer: Choreographer) -> None:
    dancer, wish = FigureDancer(choreographer, tiny_generator()), Wish(frozenset({"polka"}))
    speeds = []
    for manner in (Manner(), Manner(stops=0.6)):
        found = dancer.dance(condition(), replace(wish, manner=manner), sampling=Sampling(steps=2),
                             foot_lock=False)  # fmt: skip
        assert found is not None
        motion, figures = found
        speed = np.linalg.norm(np.diff(motion.positions(), axis=0), axis=-1).mean(1) * 30
        on = [round(time * 30) for figure in figures[:-1] for time in figure.times]
        speeds.append(np.mean([speed[at - 1 : at + 1].mean() for at in on if 1 < at < len(speed)]))
    assert speeds[1] < 0.4 * speeds[0]


def test_it_says_what_it_danced(choreographer: Choreographer) -> None:
    dancer = FigureDancer(choreographer, tiny_generator())
    found = dancer.dance(condition(), Wish(frozenset({"polka"})), sampling=Sampling(steps=2))
    assert found is not None
    motion, figures = found
    assert motion.num_frames == 360 and np.isfinite(motion.quaternions).all()
    assert {figure.kind for figure in figures} == {"polka"}
    speed = np.linalg.norm(np.diff(motion.positions(), axis=0), axis=-1).mean(1) * 30
    assert speed[-3:].max() < 0.15 < speed[30:-60].mean()  # it has come to rest
    assert all(a.stop == pytest.approx(b.start) for a, b in pairwise(figures))
    assert figures[0].told()["name"].startswith("sway@")
    phrase = {each.part.rstrip("'"): each.name for each in figures}
    sides = {each.part: each.mirrored for each in figures}
    assert figures[0].part == "a" and len(set(phrase.values())) == len(phrase)
    assert all(phrase[e.part.rstrip("'")] == e.name for e in figures)
    assert all(sides[each.part] == each.mirrored for each in figures)
    assert listed(choreographer, Wish())[0]["licence"] == "CC0"
    silent = SongCondition(torch.zeros(167, 90), None, np.zeros(0))
    assert dancer.dance(silent, Wish(), sampling=Sampling(steps=2)) is None


def test_where_nobody_dances_somebody_stands(choreographer: Choreographer) -> None:
    dancer = FigureDancer(choreographer, tiny_generator())
    found = dancer.dance(condition((150, 240)), Wish(), sampling=Sampling(steps=2))
    assert found is not None and not any(5.1 < f.start < 7.9 for f in found[1])


def test_figures_where_they_show_it_and_the_generator_where_not(
    choreographer: Choreographer,
) -> None:
    performer = Performer(tiny_generator(), PerformerSettings(steps=2))
    dancers = SongPerformer(performer, choreographer=choreographer)
    done: list[int] = []
    polka = dancers.dance(
        condition(), "a person dances polka", progress=lambda frames, _: done.append(frames)
    )
    assert polka.ranked[0].figures and done[-1] == 360 and done == sorted(done) and len(done) > 1
    assert polka.ranked[0].trajectory.num_frames == 360
    free = dancers.dance(condition(), "somebody jumps twice")
    assert not free.ranked[0].figures
    both = dancers.dance(condition(), "a person dances", num_samples=2, seed=1)
    assert len(both.ranked) == 2 and "beats" in both.table.terms


def test_who_asks_for_a_kind_that_no_tempo_fits_is_told(
    choreographer: Choreographer, caplog: pytest.LogCaptureFixture
) -> None:
    performer = Performer(tiny_generator(), PerformerSettings(steps=2))
    dancers = SongPerformer(performer, choreographer=choreographer)
    slow = dancers.dance(condition(tempo=78.0), "a person dances polka")
    assert not slow.ranked[0].figures
    assert "no figure of polka fits the tempo" in caplog.text


def test_a_foot_stands_through_each_seam_and_at_no_gap(
    choreographer: Choreographer, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[list[int]] = []

    def spied(features: torch.Tensor, seams: list[int], fps: float) -> torch.Tensor:
        seen.append(list(seams))
        return stepped(features, seams, fps)

    monkeypatch.setattr("src.shared.pipelines.figure_dance.stepped", spied)
    dancer = FigureDancer(choreographer, tiny_generator())
    for heard in (condition(), condition((150, 240))):
        found = dancer.dance(heard, Wish(), sampling=Sampling(steps=2))
        assert found is not None
        times = [figure.times for figure in found[1]]
        joined = [b[0] for a, b in pairwise(times) if abs(a[-1] - b[0]) < 1e-6]
        assert seen.pop() == [round(time * 30) for time in joined]
        assert len(joined) == (0 if heard.waits else len(times) - 1) and len(times) > 1


def test_a_frame_on_the_very_edge_of_a_fade(choreographer: Choreographer) -> None:
    slots = choreographer.parted(condition().slots(), Wish())
    chosen = choreographer.choose(slots, Wish(), 0, lambda done, total: None)
    assert chosen is not None and len(slots) > 1
    for nudge in (0.0, 1e-17, 1e-16, 1e-15, 1e-12):  # weights that float32 has no number for
        seam = 4.3 - nudge * 4.3
        shifted = [
            replace(slot, counts=slot.counts - slots[1].counts[0] + seam) for slot in slots[:2]
        ]
        features, _ = lay(choreographer.memory, shifted, chosen[:2], 300)
        assert bool(torch.isfinite(features).all())
