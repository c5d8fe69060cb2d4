"""The memory harness: fair arms, answers known by construction, the same figures every time."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from typer.testing import CliRunner

from src.cli.evaluate_suites import numbers
from src.cli.tools import app
from src.shared.config_audio import MemoryConfig
from src.shared.data.phrases.layout import parse_manifest
from src.shared.errors import UsageError, UserError
from src.shared.evaluation.suites.memory import (
    ARMS,
    CHANCE,
    RANDOM,
    WITH,
    WITHOUT,
    Arm,
    Asker,
    MemorySettings,
    Setting,
    curve_distances,
    curves,
    denoising,
    difference,
    evaluate_memory,
    held_back,
    over_songs,
    word,
)
from src.shared.evaluation.tables import Column
from src.shared.model.audio.audio_motion_model import AudioMotionModel
from src.shared.pipelines.song_sampler import SongSampling
from tests.shared.evaluation.tiny_pairs import tiny_model, write_pairs
from tests.shared.memory.tiny_memory import LinearSpace, make_index
from tests.shared.pipelines.tiny_recall import remember, save_memory, save_space

SMALL = MemorySettings(
    num_phrases=4, splits=("test",), draws=1, num_songs=2, song_seconds=4.0, shares=(0.5,),
    top_ks=(1,),
)  # fmt: skip


@pytest.fixture(scope="module")
def pairs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_pairs(tmp_path_factory.mktemp("pairs"), frames=200)


@pytest.fixture(scope="module")
def model() -> AudioMotionModel:
    return remember(tiny_model())


def asker(**config: Any) -> Asker:
    return Asker(make_index(), MemoryConfig(**config), seed=0)


def query(count: int = 3) -> torch.Tensor:
    draws = torch.randn(count, 16, generator=torch.Generator().manual_seed(2))
    return torch.nn.functional.normalize(draws, dim=-1)


# ------------------------------------------------------------ arms


def test_without_is_told_nothing_and_random_is_as_sure_of_something_else() -> None:
    found = {arm.name: asker().answer(arm, query(), None, 20, ["a", "b", "c"]) for arm in ARMS}
    assert list(found) == [WITHOUT, WITH, RANDOM] and found[WITHOUT] is None
    right, stray = found[WITH], found[RANDOM]
    assert right is not None and stray is not None
    assert torch.equal(right.confidence, stray.confidence)
    assert (right.context - stray.context).abs().max() > 0.05
    assert (right.priors - stray.priors).abs().max() > 0.05
    again = asker().answer(Arm(RANDOM, stray=True), query(), None, 20, ["a", "b", "c"])
    other = asker().answer(Arm(RANDOM, stray=True), query(), None, 20, ["a", "b", "c"], draw=1)
    assert again is not None and other is not None
    assert torch.equal(again.context, stray.context)
    assert not torch.equal(other.context, stray.context)


def test_smaller_memories_lack_more_and_never_fewer() -> None:
    one = asker()
    sizes = [len(one.hidden(share)) for share in (1.0, 0.5, 0.2, 0.001)]
    assert sizes == [0, 3, 5, 5]  # of six songs; one is always left
    assert one.hidden(0.5) <= one.hidden(0.2)
    assert one.hidden(0.5) == asker().hidden(0.5)


def test_one_hit_is_that_phrase() -> None:
    """Asked with its own key, and only once, the answer is its motion key."""
    from src.shared.memory.query import projection

    index = make_index()
    found = asker().answer(Arm("top 1", top_k=1), index.audio_keys[4:5], None, 20, [""])
    assert found is not None
    torch.testing.assert_close(found.context[0], projection(16) @ index.motion_keys[4])
    hidden = asker().answer(Arm("top 1", top_k=1), index.audio_keys[4:5], None, 20, ["song-2"])
    assert hidden is not None and not torch.allclose(hidden.context, found.context)


# ------------------------------------------------------------ figures


def test_phrases_of_a_song_count_as_one() -> None:
    found = over_songs({"x": np.array([1.0, 3.0, 10.0])}, ["a", "a", "b"])
    np.testing.assert_array_equal(found["x"], [2.0, 10.0])


def test_differences_and_words_of_a_known_case() -> None:
    rng = np.random.default_rng(0)
    base = rng.standard_normal(40)
    measured = {"worse": {"x": base}, "better": {"x": base - 1 + 0.1 * rng.standard_normal(40)}}
    found = difference(measured, "better", "worse", "x")
    assert found["value"] == pytest.approx(-1, abs=0.1) and found["apart"]
    assert word(found, Column("x", "x", better="low")) == "better"
    assert word(found, Column("x", "x", better="high")) == "worse"
    assert word(difference(measured, "worse", "worse", "x"), Column("x", "x")) == "no difference"


def test_a_silent_memory_changes_no_figure(pairs: Path) -> None:
    """A memory part as it starts: every arm is the same, to the last digit."""
    silent = tiny_model()
    silent.add_memory(remember(tiny_model()).unet.config.memory)
    setting = Setting(silent.eval(), LinearSpace(), asker(), SongSampling(steps=2, window=180))
    items = held_back(str(pairs), ("test",), 180, 4, 0)
    assert len(items) == 4
    for figures in (denoising(setting, items, 1), curves(setting, items)):
        first, *rest = [figures.measure(arm) for arm in ARMS]
        assert first.keys() == {column.key for column in figures.columns}
        for other in rest:
            assert all(np.array_equal(first[key], other[key]) for key in first)


def test_real_motion_has_no_distance_from_itself(pairs: Path, model: AudioMotionModel) -> None:
    setting = Setting(model, LinearSpace(), asker(), SongSampling(window=180))
    figures = curves(setting, held_back(str(pairs), ("test",), 180, 4, 0))
    real = list(np.random.default_rng(0).random((3, 4, 9)))
    assert all((each == 0).all() for each in curve_distances(real, real).values())
    assert figures.chance is not None
    assert all((each > 0).all() for each in figures.chance().values())


# ------------------------------------------------------------ the report


def test_the_same_report_twice_with_every_row(pairs: Path, model: AudioMotionModel) -> None:
    def report() -> dict[str, Any]:
        return evaluate_memory(
            model, make_index(), LinearSpace(), data=str(pairs), config=MemoryConfig(),
            settings=SMALL,
        )  # fmt: skip

    found = report()
    assert json.dumps(found) == json.dumps(report())
    names = [WITHOUT, WITH, RANDOM, "50% of the songs", "top 1"]
    denoising, differences, curves, *_ = found["tables"]
    assert [row["name"] for row in denoising["rows"]] == names
    assert [row["name"] for row in curves["rows"]] == [*names[:3], CHANCE]
    gains = {row["name"]: row["cells"]["all"] for row in differences["rows"]}
    assert list(gains) == [*(f"{name} − without" for name in names[1:]), "with − random"]
    rows = {row["name"]: row["cells"]["all"]["value"] for row in denoising["rows"]}
    assert gains["with − without"]["value"] == pytest.approx(rows[WITH] - rows[WITHOUT])
    assert gains["with − without"]["count"] == 4  # songs
    said = found["verdict"]["error of denoising real motion: all"]
    assert set(said) == {WITHOUT, RANDOM}


def test_the_command(pairs: Path, model: AudioMotionModel, tmp_path: Path) -> None:
    model.save_pretrained(tmp_path / "model")
    save_memory(tmp_path / "memory", save_space(tmp_path / "space"), tmp_path / "space")
    assert list(parse_manifest([(pairs / "manifest.json").read_bytes()], ""))
    command = ["evaluate-memory", "--model", tmp_path / "model", "--memory", tmp_path / "memory"]
    command += ["--data", pairs, "--splits", "test", "--num-phrases", 2, "--num-songs", 2]
    command += ["--song-seconds", 4, "--shares", "", "--top-k", "", "--steps", 2]
    command += ["--device", "cpu", "--out", tmp_path / "report.md"]
    result = CliRunner().invoke(app, list(map(str, command)))
    assert result.exit_code == 0, result.stderr
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert text.strip() == result.stdout.strip() and "| with − random |" in text


def test_what_cannot_be_measured_is_refused(pairs: Path, model: AudioMotionModel) -> None:
    with pytest.raises(UserError, match="too few"):
        evaluate_memory(
            model, make_index(), LinearSpace(), data=str(pairs), config=MemoryConfig(),
            settings=MemorySettings(num_phrases=1, splits=("test",)),
        )  # fmt: skip
    with pytest.raises(UsageError, match="--top-k 1;2"):
        numbers("--top-k", "1;2", int)
    assert numbers("--shares", "0.1, 1", float) == (0.1, 1.0)
