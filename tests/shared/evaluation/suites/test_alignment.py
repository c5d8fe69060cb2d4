"""The rows that a motion is held against: who dances on the beat stands out, nobody else does."""

import numpy as np

from src.shared.evaluation.samples import Dance
from src.shared.evaluation.suites.alignment import HELD_AGAINST, Danced, alignment_rows
from src.shared.motion.trajectory import MotionTrajectory


def danced(song: str, motion: np.ndarray, music: np.ndarray) -> Danced:
    """Sixteen seconds of a song."""
    still = MotionTrajectory(np.zeros((480, 25), np.float32))
    return Dance(song, still, music), motion


def dances(kind: str, number: int = 30) -> list[Danced]:
    rng = np.random.default_rng(0)
    made = []
    for index in range(number):
        period = rng.uniform(0.35, 0.8)
        music = rng.random() * period + np.arange(60) * period
        motion = {
            "on": music + rng.normal(0, 0.01, 60),
            "off": music + period / 2,
            "anywhere": np.sort(rng.uniform(0, 60 * period, 60)),
            "never": np.zeros(0),
        }[kind]
        made.append(danced(f"song-{index}", motion, music[music < 18]))
    return made


def test_on_the_beat_stands_out_against_everything() -> None:
    report = alignment_rows(dances("on"), seed=0)
    own = report["rows"]["own song"]
    assert own["motion_to_music"].value > 0.95 and own["f"].value > 0.95
    for name in HELD_AGAINST:
        for cell in report["above"][name].values():
            assert cell["low"] > 0.5 and cell["apart"]
    assert report == alignment_rows(dances("on"), seed=0)


def test_anywhere_is_chance() -> None:
    above = alignment_rows(dances("anywhere"), seed=0)["above"]
    for name in HELD_AGAINST:
        assert not above[name]["f"]["apart"]
    assert above["chance"]["f"]["low"] < 0 < above["chance"]["f"]["high"]


def test_off_the_beat_loses_against_half_a_beat_later() -> None:
    above = alignment_rows(dances("off"), seed=0)["above"]["half a beat later"]
    assert above["motion_to_music"]["high"] < -0.9


def test_standing_still_scores_nothing_but_counts() -> None:
    report = alignment_rows(dances("never"), seed=0)
    assert report["without_beats"] == report["songs"] == 30
    assert report["motion_beats"] == 0.0
    assert report["rows"]["own song"]["f"].value == 0.0
    assert report["rows"]["own song"]["f"].count == 30
    assert report["rows"]["own song"]["distance"].count == 0


def test_phrases_of_one_song_are_no_other_song() -> None:
    one = [danced("same", beats, dance.beats) for dance, beats in dances("on", 4)]
    assert alignment_rows(one, seed=0)["rows"]["another song"]["f"].count == 0


def test_without_songs_nothing_is_said() -> None:
    report = alignment_rows([], seed=0)
    assert report["songs"] == 0 and report["rows"]["own song"]["f"].count == 0
    assert not report["above"]["chance"]["f"]["apart"]


def test_beats_are_counted_a_second() -> None:
    music = np.arange(0, 20, 0.5)
    report = alignment_rows([danced("a", music[::2], music)], seed=0)
    assert (report["motion_beats"], report["music_beats"]) == (1.0, 2.0)
