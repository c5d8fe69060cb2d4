"""`evaluate-performer` end to end on tiny networks."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from src.shared.data.phrases.layout import parse_manifest, write_body, write_manifest
from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import SyntheticSource
from src.shared.errors import UserError
from src.shared.evaluation.pages import save_report
from src.shared.evaluation.samples import HeldOut
from src.shared.evaluation.suites import editing
from src.shared.evaluation.suites.dance import (
    PROMPTS,
    DanceContext,
    DanceSettings,
    evaluate_performer,
)
from src.shared.evaluation.suites.editing import EditContext, EditSettings
from src.shared.evaluation.suites.songs import captured_dances
from src.shared.evaluation.tables import Grid, grids, markdown
from src.shared.formats.arrays import write_npz
from src.shared.model.evaluator import Evaluator
from src.shared.motion.features import encode_features
from src.shared.pipelines.body import PerformerSettings
from src.shared.pipelines.path import DrawnPath
from src.shared.pipelines.song import SongGenerator
from tests.shared.evaluation.dancers import swinging_arms
from tests.shared.evaluation.tiny_pairs import tiny_model, write_pairs
from tests.shared.model.conftest import tiny_generator

SETTINGS = DanceSettings(
    num_songs=2, song_seconds=6.0, replications=1, prompts=PROMPTS[:3], style_songs=1, edits=2,
    worst=1,
)  # fmt: skip


def pairs_with_bodies(root: Path) -> str:
    """Ten phrases whose bodies swing their arms."""
    write_pairs(root)
    records = list(parse_manifest([(root / "manifest.json").read_bytes()], "tiny"))
    body = encode_features(swinging_arms(frames=150)).numpy()
    write_manifest(
        root,
        [each.model_copy(update={"body": write_body(root, each.id, body)}) for each in records],
    )
    return str(root)


def make(root: Path, folder: Path) -> dict[str, Any]:
    generator = tiny_generator(constraints=True)
    context = DanceContext(
        generator,
        SongGenerator(tiny_model(), device="cpu"),
        Evaluator(),
        SETTINGS,
        data=str(root / "pairs"),
        other=tiny_generator(),
        sampling=PerformerSettings(steps=2),
    )
    prepare([SyntheticSource(12, seed=1)], root / "clips")
    data = PreparedData.open(str(root / "clips"))
    held_out = HeldOut(data, {"seen": data.records()}, "tiny")
    edits = EditContext(generator, held_out, EditSettings(num=2, repeats=1))
    report = evaluate_performer(context, edits, folder=folder)
    save_report(report, folder)
    return report


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("performer")
    pairs_with_bodies(root / "pairs")
    make(root, root / "report")
    return root / "report"


@pytest.fixture(scope="module")
def found(folder: Path) -> dict[str, Grid]:
    return {grid.name: grid for grid in grids(json.loads((folder / "report.json").read_text()))}


def test_every_row_meets_every_family(found: dict[str, Grid]) -> None:
    rows = ["real", "generated", "figures", "figures at random", "another song", "frozen pose",
            "pinned", "path alone", "beats not told", "other model", "untrained"]  # fmt: skip
    for name in ("whole-body beats", "on stage", "root against the trajectory", "feet"):
        assert list(found[f"dances/{name}"].rows) == rows
    assert found["dances/whole-body beats"].rows["real"].num == 4


def test_a_body_keeps_to_its_path_and_a_frozen_pose_keeps_nothing(found: dict[str, Grid]) -> None:
    root, beats = found["dances/root against the trajectory"], found["dances/whole-body beats"]
    assert root.value("pinned", "root_max") < 0.1 and root.value("pinned", "turn_max") < 0.1
    assert root.value("frozen pose", "limb_speed") == 0
    assert root.value("path alone", "limb_speed") < 1e-3
    assert beats.value("frozen pose", "f") == beats.value("path alone", "limbs_f") == 0
    assert beats.value("real", "f") >= 0


def test_a_frozen_pose_is_no_dance(found: dict[str, Grid]) -> None:
    stage = found["dances/on stage"]
    assert stage.value("frozen pose", "poses") == 1
    assert stage.value("frozen pose", "dimensions") == stage.value("frozen pose", "radius") == 0
    assert stage.value("generated", "dimensions") > 1


def test_captured_dances_are_real_whatever_their_music(tmp_path: Path) -> None:
    write_npz(swinging_arms(frames=60), tmp_path / "waltz.npz")
    (dance,) = captured_dances(tmp_path, 90)
    assert dance.song == "waltz" and not len(dance.beats)
    assert [each.motion.num_frames for each in captured_dances(tmp_path, 40)] == [40, 20]
    (tmp_path / "waltz.npz").unlink()
    with pytest.raises(UserError, match="no motion files"):
        next(captured_dances(tmp_path, 90))


def test_what_is_kept_stays(found: dict[str, Grid]) -> None:
    edits = found["edits"]
    for row in edits.rows:
        if row.endswith(("generated", "untrained")):
            assert edits.value(row, "rotation") < 1e-3 and edits.value(row, "root") < 1e-3
            assert edits.value(row, "changed") > 0
    assert edits.value("a second: clip handed back", "changed") == pytest.approx(0, abs=1e-6)
    assert edits.value("a second: another clip's poses", "border") > edits.value(
        "a second: clip handed back", "border"
    )


def test_paths_are_kept_to_by_whoever_is_carried(found: dict[str, Grid]) -> None:
    paths = found["paths"]
    assert len(paths.rows) == 3 * 4
    for shape in ("line", "curve", "figure of eight"):
        assert paths.value(f"{shape}: generated", "mean") < 0.5
        assert paths.value(f"{shape}: frozen pose", "mean") > 50
        assert paths.value(f"{shape}: frozen pose", "limb_speed") == 0


def test_floors_of_paths_are_the_models_whoever_else_is_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    short = DrawnPath(np.array([[0.0, 0.0], [0.0, 0.5]]))
    monkeypatch.setattr(editing, "drawn_paths", lambda: {"short": short})
    prepare([SyntheticSource(12, seed=1)], tmp_path)
    data = PreparedData.open(str(tmp_path))
    held_out, generator = HeldOut(data, {"seen": data.records()}, "tiny"), tiny_generator()
    with_others, alone = (
        EditContext(generator, held_out, EditSettings(num=2, repeats=1, untrained=number)).paths()
        for number in (1, 0)
    )
    assert {name: with_others[0].rows[name] for name in alone[0].rows} == alone[0].rows


def test_tables_with_rows_of_their_own(found: dict[str, Grid]) -> None:
    assert {"prompts", "transitions", "body-seams"} <= set(found)
    rows = {f"alignment/{name}/rows" for name in ("whole-body", "limbs alone:", "real whole-body")}
    assert rows <= set(found)
    assert found["prompts"].value("path alone", "gain") == pytest.approx(0, abs=1e-6)
    assert set(found["transitions"].rows) == {"generated", "untrained", "hard cut", "frozen pose"}
    assert found["transitions"].value("frozen pose", "near") == pytest.approx(0, abs=0.1)


def test_a_finished_report_is_not_measured_again(folder: Path) -> None:
    before = (folder / "report.json").read_bytes()
    written = [path.stat().st_mtime_ns for path in sorted((folder / "parts").iterdir())]
    make(folder.parent, folder)
    assert written == [path.stat().st_mtime_ns for path in sorted((folder / "parts").iterdir())]
    assert (folder / "report.json").read_bytes() == before
    assert "whole-body beats" in markdown(json.loads(before))
    assert np.all([(folder / name).is_file() for name in ("report.md", "report.html")])
