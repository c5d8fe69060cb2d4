"""Plain combinations take the place of the captured style nearest to none."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import pytest
import torch
from test_train_text import text_config
from tiny_stage import clip_config, generation_config, tiny_network, train_clip, train_generation
from torch.nn.functional import normalize

from src.shared.data.prepared import PreparedData, group_of
from src.shared.model.generation.motion_generator import KIND as GENERATOR
from src.train import train_text
from src.train.places import (
    apart,
    fuller_sides,
    nearest_styles,
    own_places,
    with_manners,
    with_unstyled,
)
from src.train.train_text import TextTask, open_tower


@dataclass
class Record:
    group: str
    labels: dict[str, str]
    provenance: str
    level: float = 0.0
    take: str = ""


class Clips:
    """As much of PreparedData as is read: clips that stand still at a level."""

    mean, std = torch.zeros(23, 6), torch.ones(23, 6)

    def __init__(self, *records: Record) -> None:
        self.all = records

    def records(self, split: str) -> tuple[Record, ...]:
        return self.all if split == "train" else ()

    def features(self, record: Record) -> torch.Tensor:
        return torch.full((8, 23, 6), record.level)


def test_the_style_nearest_to_none_stands_for_none() -> None:
    walk = {"action": "walk", "direction": "forward"}
    clips = Clips(
        Record("plain", walk, "captured", 0.0),
        Record("once", walk | {"speed": "normal"}, "procedural", 9.0),
        Record("fast", walk | {"speed": "fast"}, "procedural", 9.0),
        Record("giant", walk | {"style": "giant"}, "captured", 3.0),
        Record("proud", walk | {"style": "proud"}, "captured", 1.0),
        Record("made", walk | {"style": "sad"}, "procedural", 0.0),
        Record("bow", {"action": "bow", "count": "1"}, "procedural", 0.0),
        Record("bow-a", {"action": "bow", "style": "giant"}, "captured", 0.0),
        Record("bow-b", {"action": "bow", "style": "happy"}, "captured", 4.0),
        Record("bow-c", {"action": "bow", "style": "proud"}, "captured", 2.1),
        Record("kick", {"action": "kick"}, "captured", 0.0),
    )
    labels = {record.group: record.labels for record in clips.all}
    found = nearest_styles(cast(PreparedData, clips), labels)
    assert found == {"plain": "proud", "once": "proud", "bow": "bow-c"}


def test_the_right_side_stands_for_none_where_it_is_shown_more_often() -> None:
    kick, wave = {"action": "kick"}, {"action": "wave"}
    sided = {"side": "right", "count": "1"}
    clips = Clips(
        Record("kick", kick, "captured", take="a"),
        Record("kick", kick, "captured", take="a"),  # its mirror image
        *(Record("kick-r", kick | sided, "procedural", take=take) for take in "bc"),
        *(Record("kick-l", kick | {"side": "left"}, "procedural", take=take) for take in "def"),
        *(Record("wave", wave, "captured", take=take) for take in "ghi"),
        *(Record("wave-r", wave | sided, "captured", take=take) for take in "jk"),
        Record("old", kick | {"style": "old"}, "captured", take="l"),
    )
    labels = {record.group: record.labels for record in clips.all}
    assert fuller_sides(cast(PreparedData, clips), labels) == {"kick": "kick-r"}


def test_what_is_only_there_in_styles_is_asked_for_without() -> None:
    labels = {
        "a": {"action": "bow", "count": "1"},
        "b": {"action": "bow", "style": "sad"},
        "c": {"action": "guide", "style": "sad"},
        "d": {"action": "guide", "style": "tired"},
    }
    assert with_unstyled(labels) == labels | {"action=guide": {"action": "guide"}}


def test_an_action_in_a_manner_that_no_clip_shows_is_the_action() -> None:
    shown = [
        {"action": "walk", "style": "sad"},
        {"action": "bow", "style": "proud"},
        {"action": "jump", "count": "2"},
    ]
    labels = {group_of(each): each for each in [*shown, {"action": "jump", "style": "odd"}]}
    found, plain_of = with_manners(labels, shown)
    assert plain_of == {
        "action=jump|style=odd": "action=jump",
        "action=jump|count=2|style=proud": "action=jump|count=2",
        "action=jump|count=2|style=sad": "action=jump|count=2",
    }
    assert found == labels | {
        "action=jump": {"action": "jump"},
        "action=jump|count=2|style=proud": {"action": "jump", "count": "2", "style": "proud"},
        "action=jump|count=2|style=sad": {"action": "jump", "count": "2", "style": "sad"},
    }


def test_no_two_actions_have_one_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor does one get a place that another's captions go to more."""

    class Tower:
        def place_keys(self) -> torch.Tensor:
            return torch.eye(6)

    monkeypatch.setattr(
        "src.train.places.pooled",
        lambda tower, tokenizer, texts: torch.eye(6)[list(map(int, texts))],
    )
    asked = {
        "squat": ([0] * 10, {"action": "squat"}),
        "crouch": ([0] * 6 + [1] * 3 + [2], {"action": "crouch"}),  # what it has learned so far
        "crouch|left": ([0] * 10, {"action": "crouch", "side": "left"}),
        "jog": ([2] * 9 + [3], {"action": "jog"}),
        "run": ([2] * 10, {"action": "run"}),
        "run|left": ([3] * 10, {"action": "run", "side": "left"}),
        "kick": ([4] * 10, {"action": "kick"}),
        "kick|left": ([5] * 10, {"action": "kick", "side": "left"}),
        "hop|left": ([5] * 7 + [4] * 3, {"action": "hop", "side": "left"}),
        "hop": ([5] * 8 + [4] * 2, {"action": "hop"}),
    }
    texts = [[str(place) for place in places] for places, _ in asked.values()]
    found = own_places(
        cast(Any, Tower()), cast(Any, None), texts, [each for _, each in asked.values()]
    )
    places = dict(zip(asked, found.tolist(), strict=True))
    assert places["squat"] == 0 and places["crouch"] == places["crouch|left"] == 1
    assert (places["run"], places["run|left"]) == (2, 3)
    assert places["jog"] == 2  # all that is its own is a run to the left: they share
    assert (places["kick"], places["kick|left"], places["hop"]) == (4, 5, 5)


def test_a_new_action_has_a_direction_of_its_own() -> None:
    labels = [{"action": a} for a in ("walk", "karate", "salsa", "karate")]
    places = normalize(torch.ones(4, 192), dim=-1)
    moved = apart(places, labels, ["walk"])
    assert torch.equal(moved[0], places[0])
    assert torch.equal(moved[1], moved[3])
    cosines = moved @ moved.T
    assert float(cosines[0, 1]) < 0.9 and float(cosines[1, 2]) < 0.8
    assert torch.allclose(moved.norm(dim=-1), torch.ones(4))


def test_a_generators_own_tower_is_hardened_towards_them(
    prepared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    clip, made = tmp_path / "clip", tmp_path / "made"
    train_clip(clip_config(prepared, clip, "steps=2"))
    train_generation(generation_config(prepared, clip, made, "steps=2"))
    assert open_tower(str(made)).card.kind == GENERATOR
    settings: Any = text_config(prepared, made, tmp_path / "hard", "unstyled-as-captured=true")
    first_is_second = lambda data, labels: dict([sorted(labels)[:2]])  # noqa: E731
    monkeypatch.setattr(train_text, "nearest_styles", first_is_second)
    task = TextTask(settings, tiny_network())
    assert task.config.generator == str(made)
    assert torch.equal(task.places[0], task.places[1])
    assert not torch.equal(task.places[0], task.places[2])
