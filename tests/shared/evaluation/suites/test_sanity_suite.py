"""`evaluate-sanity`: the shipped sampler's motions, floors that fail, a verdict that can say no."""

import json
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.errors import UserError
from src.shared.evaluation.samples import untrained_audio_model
from src.shared.evaluation.suites.sanity import (
    FREE,
    SanitySettings,
    evaluate_sanity,
    plot_bands,
    sampled,
    verdict,
)
from src.shared.evaluation.suites.songs import conditions_of_songs, open_split
from src.shared.evaluation.tables import grids, markdown, printed
from src.shared.metrics.sanity import Band, Bands, SanityChecker, frozen, sanity_row
from src.shared.pipelines.song import SongGenerator
from src.shared.pipelines.song_sampler import SongSampling
from tests.shared.evaluation.tiny_pairs import nod, tiny_model, write_pairs

SETTINGS = SanitySettings(num_samples=6, num_frames=64, num_steps=2)


def test_everything_on_pairs(tmp_path: Path) -> None:
    data = str(write_pairs(tmp_path / "pairs"))
    model = tiny_model(open_split(data, "train", 64, 0).fingerprint)
    generator = SongGenerator(model)
    result = evaluate_sanity(generator, data=data, settings=SETTINGS)
    report = json.loads(json.dumps(result.report))
    rows = report["rows"]
    assert {name: row["motions"] for name, row in rows.items()} == {
        "generated": 6,  # of four phrases: two give another window
        "written": 6,
        "untrained": 1,
        "frozen": 4,
        "real": 4,
    }
    assert rows["real"]["passed_seven"] == 4
    assert report["about"]["held_out"].startswith("yes")
    assert report["about"]["training_windows"] == 6
    assert report["verdict"]["frozen_fails"] and report["verdict"]["untrained_fails"]
    again = evaluate_sanity(generator, data=data, settings=SETTINGS).report
    assert {**again, "seconds": 0} == {**result.report, "seconds": 0}

    tables = [printed(grid) for grid in grids(report)]
    assert all(len(row) == len(table.header) for table in tables for row in table.rows)
    assert "| frozen fails |" in markdown(report)
    picture = plot_bands(result.motions, result.bands, tmp_path / "bands.png")
    assert picture.stat().st_size > 5000
    with pytest.raises(UserError, match="no test phrase has 2000 frames"):
        evaluate_sanity(generator, data=data, settings=SanitySettings(num_frames=2000))


def test_other_data_is_told(tmp_path: Path) -> None:
    data = str(write_pairs(tmp_path / "pairs"))
    settings = SanitySettings(num_samples=1, num_frames=32, num_steps=1)
    generator = SongGenerator(tiny_model("something"))
    report = evaluate_sanity(generator, data=data, settings=settings).report
    assert report["about"]["held_out"].startswith("unknown")


def test_motions_are_those_of_the_shipped_sampler() -> None:
    """What `generate` samples, to the last digit; each song has noise of its own."""
    generator = SongGenerator(tiny_model())
    songs = conditions_of_songs(3, 250, 0)  # longer than a window
    made = sampled(generator, songs, SETTINGS)
    sampling = SongSampling(seed=SETTINGS.seed, steps=SETTINGS.num_steps)
    for song, motion in zip(songs, made, strict=True):
        assert np.array_equal(generator.sample(song, sampling)[0].data, motion.data)
        assert motion.data.shape == (250, 25)
    assert not np.allclose(made[0].data, made[1].data)


def test_the_untrained_network_moves_keeps_the_statistics_and_nothing_else() -> None:
    model = tiny_model()
    model.set_statistics(torch.linspace(-1, 1, 25), torch.linspace(0.5, 2, 25))
    before = torch.get_rng_state()
    fresh = untrained_audio_model(model, seed=0)
    assert torch.equal(torch.get_rng_state(), before)
    assert torch.equal(fresh.mean, model.mean) and torch.equal(fresh.std, model.std)
    same = [torch.equal(a, b) for a, b in zip(fresh.parameters(), model.parameters(), strict=True)]
    assert not all(same)
    (motion,) = sampled(SongGenerator(fresh), conditions_of_songs(1, 60, 0), SETTINGS)
    assert np.ptp(motion.position, axis=0).max() > 0.01, "no second frozen row"


def test_the_verdict_can_say_no() -> None:
    walk = nod(np.arange(102) / 60)
    bands = Bands({name: Band(0.5, 1.0, 1.5) for name in FREE}, 9)
    checker = SanityChecker(bands=bands)
    good = sanity_row("a", [walk] * 20, checker)
    turning = verdict({"generated": good, "frozen": good, "untrained": good}, bands)
    assert turning["seven_checks"]["holds"] and turning["whole_suite"]["holds"]
    assert not turning["frozen_fails"]
    assert turning["inside"]["mean_speed"]["holds"] and not turning["inside"]["turning"]["holds"]
    broken = nod(np.arange(102) / 60)
    broken.quaternion[50:] *= -1
    some = sanity_row("a", [walk] * 18 + [broken] * 2, checker)
    found = verdict({"generated": some, "frozen": some, "untrained": some}, None)
    assert found["seven_checks"]["value"] == 0.9 and not found["seven_checks"]["holds"]
    assert found["inside"] == {}
    still = sanity_row("a", [frozen(walk)] * 20, SanityChecker())
    calm = verdict({"generated": still, "frozen": still, "untrained": still}, None)
    assert calm["seven_checks"]["holds"], "stillness is coherent"
    assert not calm["whole_suite"]["holds"], "and no motion: the suite counts"
