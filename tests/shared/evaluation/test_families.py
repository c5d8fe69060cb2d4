"""Every family keeps the contract: keys of its own, something to say, a floor beside it."""

import pytest

from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.evaluation.families import (
    AUDIO_FAMILIES,
    DANCE_FAMILIES,
    TEXT_FAMILIES,
    nearest_pose,
)
from src.shared.evaluation.tables import WORDS, Column
from src.shared.memory.figures import FigureMemory
from src.shared.motion.features import decode_features, encode_features, mirror_features


@pytest.mark.parametrize("families", [TEXT_FAMILIES, AUDIO_FAMILIES, DANCE_FAMILIES])
def test_columns_are_unique_and_defined(families: tuple) -> None:  # type: ignore[type-arg]
    keys = [column.key for family in families for column in family.columns]
    assert len(keys) == len(set(keys))
    names = [family.name for family in families]
    assert len(names) == len(set(names))
    for family in families:
        assert len(family.definition) > 60 and isinstance(family.distance, bool)
        assert all(column.better in ("high", "low", "real") for column in family.columns)


@pytest.mark.parametrize("kind", WORDS)
def test_what_tables_say_is_whole(kind: str) -> None:
    more = {"tmr": {"protocols"}, "selection": {"prompts", "songs", "roles"}}
    known = {"title", "head", "columns", "note"} | more.get(kind, set())
    assert WORDS[kind].keys() <= known
    columns = [Column(*each) for each in WORDS[kind].get("columns", ())]
    assert len({column.key for column in columns}) == len(columns)
    for column in columns:
        assert column.better in ("high", "low", "real") and column.decimals >= 0
        assert isinstance(column.share, bool) and column.heading


def test_a_copy_of_the_memory_is_seen() -> None:
    take = FigureMemory.open().takes[3].motion.frames(0, 120)
    mirrored = decode_features(mirror_features(encode_features(take)))
    other = generate_clip(
        spec_for({"action": "jump", "count": "1", "direction": "up", "speed": "normal"}, 0), 0
    )
    assert nearest_pose(take) < 0.002 and nearest_pose(mirrored) < 0.002
    assert nearest_pose(other) > 0.03
