"""Windows, batches and tables of a shared space on phrases whose answer is known."""

import json
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.evaluation.samples import untrained_tower
from src.shared.evaluation.suites.space import (
    CHANCE,
    SPACE,
    TEMPO,
    UNTRAINED,
    Bench,
    SpaceSettings,
    Windows,
    evaluate_space,
    in_common,
    related,
    tempo_alone,
)
from src.shared.evaluation.tables import Grid, markdown
from src.shared.model.audio.shared_space import rate_rows
from src.shared.model.evaluator import padded
from src.shared.motion.features import FORWARD, ROOT_ROW
from tests.shared.evaluation.space_samples import tiny_bundle, tiny_space, write_space_phrases

CUTS = {"bars": 1, "min_frames": 30, "max_frames": 60}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_space_phrases(tmp_path_factory.mktemp("space"), songs=16)


@pytest.fixture(scope="module")
def windows(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Windows:
    cache = tmp_path_factory.mktemp("cache")
    return Windows.cut(MotionPhraseDataset(folder, bodies=True, cache_dir=cache), **CUTS)


def test_windows_start_at_bars_and_hold_sound_and_body_of_one_time(windows: Windows) -> None:
    assert len(windows.records) == 32
    assert sum(len(numbers) for numbers in windows.of_phrase) == len(windows.items)
    for phrase, numbers in enumerate(windows.of_phrase):
        assert len(numbers) >= 1
        for number in numbers:
            window = windows.items[number]
            assert window.phrase == phrase
            assert 30 <= window.num_frames <= 60 and window.audio.shape[1] == window.num_frames
            beat, nod = window.audio[163], window.body[:, 0, 0] - window.body[:, 5, 0]
            assert np.corrcoef(beat, nod)[0, 1] > 0.9, "both nod on the beat"
    later = windows.items[windows.of_phrase[-1][1]]
    assert later.audio[165, 0] > 0.99, "cosine of the bar phase: a downbeat"


def test_stretching_is_a_faster_song_with_a_faster_motion(folder: Path, tmp_path: Path) -> None:
    dataset = MotionPhraseDataset(folder, bodies=True, cache_dir=tmp_path)
    plain, fast = (
        Windows.cut(dataset, **CUTS),
        Windows.cut(dataset, rates=lambda n: (1.25,), **CUTS),
    )
    both = Windows.cut(dataset, rates=lambda n: (1.0, 1.25), **CUTS)
    assert len(both.records) == 2 * len(plain.records) == 2 * len(fast.records)
    assert np.array_equal(both.items[0].audio, plain.items[0].audio)
    slow, quick = plain.items[0], fast.items[0]
    rates = [rate_rows(torch.from_numpy(w.audio[None, 163:165]))[0, 0] for w in (slow, quick)]
    assert torch.allclose(rates[1] - rates[0].mean(), torch.full((60,), np.log2(1.25)), atol=0.02)
    assert np.allclose(np.linalg.norm(quick.audio[165:], axis=0), 1, atol=1e-5)
    speeds = [window.body[:, ROOT_ROW, FORWARD].mean() for window in (slow, quick)]
    assert speeds[1] == pytest.approx(1.25 * speeds[0], rel=0.01)
    nod = quick.body[:, 0, 0] - quick.body[:, 5, 0]
    assert np.corrcoef(quick.audio[163], nod)[0, 1] > 0.9


def test_batches_are_padded_and_embedded_in_order(windows: Windows) -> None:
    values, mask = padded([torch.ones(3, 2), torch.ones(5, 2)])
    assert values.sum() == 16 and mask.sum(1).tolist() == [3, 5]
    frames = windows.embed_bodies(lambda x, mask: mask.sum(1)[:, None].float())
    assert frames[:, 0].tolist() == [window.num_frames for window in windows.items]
    level = windows.embed_sounds(lambda x, mask: (x * mask[:, None])[:, 0].sum(1)[:, None])
    expected = [window.audio[0].sum() for window in windows.items]
    np.testing.assert_allclose(level[:, 0], expected, rtol=1e-4)


def test_kin_are_phrases_of_one_song_or_clip(windows: Windows) -> None:
    records = [r.model_copy(update={"clips": ("shared",)} if n in (0, 9) else {})
               for n, r in enumerate(windows.records)]  # fmt: skip
    kin = related(records)
    assert np.array_equal(kin, kin.T) and kin.diagonal().all()
    assert kin[0, 1] and kin[0, 9] and not kin[0, 2] and not kin[1, 9]


def test_a_bench_asks_each_phrase_once_a_replication(windows: Windows) -> None:
    bench = Bench.draw(windows, batch=16, replications=3, seed=1)
    assert [len(batch) for batch in bench.batches] == [16] * 6
    for first, second in zip(bench.batches[::2], bench.batches[1::2], strict=True):
        phrases = bench.phrase[np.concatenate((first, second))]
        assert len(set(phrases.tolist())) == 32
    again = Bench.draw(windows, batch=16, replications=3, seed=1)
    assert all(np.array_equal(a, b) for a, b in zip(bench.batches, again.batches, strict=True))
    assert len(Bench.draw(windows, batch=999).batches[0]) == 32


def test_perfect_keys_find_all_and_shuffled_ones_nothing(windows: Windows) -> None:
    bench = Bench.draw(windows, batch=32, replications=10)
    keys = torch.nn.functional.normalize(
        torch.randn(len(windows.items), 64, generator=torch.Generator().manual_seed(0)), dim=1
    )
    assert bench.measure(keys, keys)["r_at_1"].value == 1
    assert bench.measure(keys, keys)["median_rank"].value == 1
    chance = bench.measure(keys, keys, shuffled=True)
    assert chance["r_at_1"].value < 0.1 and 12 < chance["median_rank"].value < 20
    easier = bench.measure(keys, keys, shuffled=True, by_action=True)
    assert easier["median_rank"].value < chance["median_rank"].value, "a third is taken out"


def test_neighbours_of_the_tempo_share_the_tempo(windows: Windows) -> None:
    bench = Bench.draw(windows, replications=4)
    tempo = [windows.records[window.phrase].tempo for window in windows.items]
    angle = 2 * np.pi * np.log2(tempo)  # an octave is a turn
    keys = torch.from_numpy(np.stack((np.cos(angle), np.sin(angle)), 1))
    found = in_common(windows, bench, keys, keys)
    blind = in_common(windows, bench, keys, keys, shuffled=True)
    assert found["tempo"].value < 0.08 < blind["tempo"].value
    assert found["speed"].value < blind["speed"].value
    assert 0 <= found["action"].value <= 1


def test_tempo_alone_is_a_kernel_regression(windows: Windows) -> None:
    motion = torch.nn.functional.normalize(torch.randn(len(windows.items), 8), dim=1)
    found = tempo_alone(windows, motion, windows)
    tempo = np.log([windows.records[i.phrase].tempo for i in windows.items])
    weights = np.exp(-(((tempo[0] - tempo) / 0.05) ** 2) / 2)
    expected = weights @ motion.numpy() / weights.sum() - motion.mean(0).numpy()
    np.testing.assert_allclose(found[0], expected / np.linalg.norm(expected), atol=1e-4)


def test_the_untrained_row_depends_on_the_seed_alone() -> None:
    space = tiny_space()
    space.audio.set_statistics(torch.ones(163), torch.full((163,), 2.0))
    one, again, other = (untrained_tower(space.audio, space.config, seed) for seed in (0, 0, 1))
    weights = [tower.audio_proj.weight for tower in (one, again, other)]
    assert torch.equal(weights[0], weights[1]) and not torch.equal(weights[0], weights[2])
    assert torch.equal(one.mean, space.audio.mean) and torch.equal(one.std, space.audio.std)


def test_the_report_has_every_row_and_repeats(folder: Path) -> None:
    bundle = tiny_bundle()
    texts = bundle.clip.text, bundle.tokenizer
    settings = SpaceSettings(**CUTS, batch=8, replications=2)
    made = evaluate_space(tiny_space(), str(folder), texts=texts, settings=settings)
    silent = evaluate_space(tiny_space(), str(folder), settings=settings)
    without = [t for t in made["tables"] if "text" not in t["name"]]
    assert json.dumps(silent["tables"]) == json.dumps(without)
    grids = {grid.name: grid for grid in map(Grid.from_dict, made["tables"])}
    assert set(grids) == {
        "sound → motion", "motion → sound", "text → sound", "sound → text", "text → motion",
        "nearest",
    }  # fmt: skip
    assert list(grids["sound → motion"].rows) == [SPACE, TEMPO, UNTRAINED, CHANCE]
    assert list(grids["text → motion"].rows) == [SPACE, UNTRAINED, CHANCE]
    assert grids["sound → motion"].value(TEMPO, "r_at_5") >= 0
    assert made["about"]["songs"] == 4 and made["about"]["phrases"] == 8
    text = markdown(made)
    assert "| tempo alone |" in text and "nan" not in text.lower()
