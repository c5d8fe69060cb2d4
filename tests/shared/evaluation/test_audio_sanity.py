"""`evaluate-sanity`: raw decoder output, floors that fail, a verdict that can say no."""

import json
from pathlib import Path

import numpy as np
import pytest
import torch

from src.shared.errors import UserError
from src.shared.evaluation import audio_sanity
from src.shared.evaluation.audio_plots import plot_bands
from src.shared.evaluation.audio_sanity import (
    SanitySettings,
    evaluate_sanity,
    generate_raw,
    untrained,
    verdict,
)
from src.shared.evaluation.audio_songs import open_split
from src.shared.evaluation.report.tables import as_markdown, heading
from src.shared.evaluation.sanity_report import sanity_tables
from src.shared.metrics.bands import Band, Bands
from src.shared.metrics.sanity import SanityChecker, sanity_row
from tests.shared.evaluation.tiny_pairs import nod, tiny_model, write_pairs

SETTINGS = SanitySettings(num_samples=6, num_frames=64, num_steps=2)


def test_everything_on_pairs(tmp_path: Path) -> None:
    data = str(write_pairs(tmp_path / "pairs"))
    model = tiny_model(open_split(data, "train", 64, 0).fingerprint)
    result = evaluate_sanity(model, data=data, settings=SETTINGS)
    report = json.loads(json.dumps(result.report))
    rows = report["rows"]
    assert {name: row["motions"] for name, row in rows.items()} == {
        "generated": 6,  # of four phrases: two give another window
        "untrained": 1,
        "frozen": 4,
        "real": 4,
    }
    assert rows["real"]["passed_seven"] == 4
    assert report["about"]["held_out"].startswith("yes")
    assert report["about"]["training_windows"] == 6
    assert report["verdict"]["frozen_fails"] and report["verdict"]["untrained_fails"]
    again = evaluate_sanity(model, data=data, settings=SETTINGS).report
    assert {**again, "seconds": 0} == {**result.report, "seconds": 0}

    tables = list(sanity_tables(report))
    assert all(len(row) == len(table.header) for table in tables for row in table.rows)
    assert "| frozen fails |" in as_markdown("Sanity", heading(report), tables)
    picture = plot_bands(result.motions, result.bands, tmp_path / "bands.png")
    assert picture.stat().st_size > 5000
    with pytest.raises(UserError, match="no test phrase has 2000 frames"):
        evaluate_sanity(model, data=data, settings=SanitySettings(num_frames=2000))


def test_other_data_is_told(tmp_path: Path) -> None:
    data = str(write_pairs(tmp_path / "pairs"))
    settings = SanitySettings(num_samples=1, num_frames=32, num_steps=1)
    report = evaluate_sanity(tiny_model("something"), data=data, settings=settings).report
    assert report["about"]["held_out"].startswith("unknown")


def test_samples_do_not_depend_on_the_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    model = tiny_model()
    conditions = [torch.rand(167, 40, generator=torch.Generator().manual_seed(i)) for i in range(3)]
    together = generate_raw(model, conditions, SETTINGS)
    monkeypatch.setattr(audio_sanity, "BATCH", 1)
    alone = generate_raw(model, conditions, SETTINGS)
    for first, second in zip(together, alone, strict=True):
        assert first.data.shape == (40, 25)
        assert first.position == pytest.approx(second.position, abs=1e-3, rel=1e-3)
    assert not np.allclose(together[0].data, together[1].data)


def test_columns_are_the_decoders_own() -> None:
    """Nothing is derived anew: a residual decoder's incoherence is seen."""
    model = tiny_model()
    torch.manual_seed(1)
    config = model.config.model_copy(
        update={"decoder": model.config.decoder.model_copy(update={"decoder": "residual"})}
    )
    from src.shared.model.audio.decoder import create_motion_decoder

    model.decoder = create_motion_decoder(config.decoder).eval()
    for parameter in model.decoder.parameters():
        torch.nn.init.normal_(parameter, std=0.5)
    made = generate_raw(model, [torch.rand(167, 40)], SETTINGS)[0]
    derived = np.diff(made.position, axis=0) * 30
    assert np.abs(made.velocity[:-1] - derived).mean() > 1.0


def test_the_untrained_model_keeps_the_statistics_and_nothing_else() -> None:
    model = tiny_model()
    model.set_statistics(torch.linspace(-1, 1, 25), torch.linspace(0.5, 2, 25))
    before = torch.get_rng_state()
    fresh = untrained(model, seed=0)
    assert torch.equal(torch.get_rng_state(), before)
    assert torch.equal(fresh.mean, model.mean) and torch.equal(fresh.std, model.std)
    same = [torch.equal(a, b) for a, b in zip(fresh.parameters(), model.parameters(), strict=True)]
    assert not all(same)


def test_the_verdict_can_say_no() -> None:
    walk = nod(np.arange(102) / 60)
    bands = Bands({name: Band(0.5, 1.0, 1.5) for name in audio_sanity.FREE}, 9)
    checker = SanityChecker(bands=bands)
    good = sanity_row("a", [walk] * 20, checker)
    turning = verdict({"generated": good, "frozen": good, "untrained": good}, bands)
    assert turning["seven_checks"]["holds"] and not turning["frozen_fails"]
    assert turning["inside"]["mean_speed"]["holds"] and not turning["inside"]["turning"]["holds"]
    broken = nod(np.arange(102) / 60)
    broken.quaternion[50:] *= -1
    some = sanity_row("a", [walk] * 18 + [broken] * 2, checker)
    found = verdict({"generated": some, "frozen": some, "untrained": some}, None)
    assert found["seven_checks"]["value"] == 0.9 and not found["seven_checks"]["holds"]
    assert found["inside"] == {}
