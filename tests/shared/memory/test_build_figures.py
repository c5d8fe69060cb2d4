"""Takes by a table or by a folder."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from src.shared.errors import UserError
from src.shared.formats.arrays import write_npz
from src.shared.io.storage import Address
from src.shared.memory.build import build_figures, every_file, read_takes, repeated
from src.shared.memory.figures import FigureMemory, is_figure_memory
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.motion.staging import without_flips
from tests.files import files_of
from tests.shared.evaluation.dancers import swinging_arms
from tests.shared.memory.tiny_figures import stepping


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_npz(stepping(0.5, 300), tmp_path / "long.npz")
    write_npz(swinging_arms(0.5, 60), tmp_path / "loop.npz")
    return tmp_path


def test_a_table_names_takes_and_loops_are_repeated(folder: Path) -> None:
    table = folder / "takes.csv"
    table.write_text("file,kind,source,licence,repeat\nlong.npz,waltz,us,MIT,\nloop.npz,,,,4\n")
    rows = read_takes(table, folder)
    assert [(row.kind, row.repeat) for row in rows] == [("waltz", 1), ("dance", 4)]
    memory, left_out = build_figures(rows)
    assert [(take.name, take.licence) for take in memory.takes] == [("long", "MIT"), ("loop", "")]
    assert not left_out and memory.takes[1].motion.num_frames == 240


def test_a_line_stands_for_the_steps_made_by_code(folder: Path) -> None:
    table = folder / "takes.csv"
    table.write_text("file\nlong.npz\nsteps\n")
    memory, _ = build_figures(read_takes(table, folder))
    assert memory.takes[0].name == "long"
    assert {"waltz", "step touch", "grapevine"} <= {take.kind for take in memory.takes[1:]}


def test_without_a_table_every_file_is_a_take(folder: Path) -> None:
    memory, left_out = build_figures(every_file(folder))
    assert [take.name for take in memory.takes] == ["long"]
    assert list(left_out) == [str(folder / "loop.npz")]
    with pytest.raises(UserError, match="no motion files"):
        (folder / "empty").mkdir()
        every_file(folder / "empty")
    (folder / "long.npz").write_bytes(b"no motion")
    with pytest.raises(UserError, match=r"none of \d files can be danced"):
        build_figures(sorted(every_file(folder), key=lambda row: row.file.name, reverse=True))


def test_addresses_will_do(folder: Path, tmp_path: Path) -> None:
    own = f"memory://{tmp_path.name}"  # the store is that of all tests of this process
    dances, out = Address(f"{own}/dances"), Address(f"{own}/figures")
    for name, data in files_of(folder).items():
        (dances / name).write_bytes(data)
    (folder / "takes.csv").write_text("file,source\nlong.npz,us\n")
    memory, _ = build_figures(read_takes(folder / "takes.csv", dances))
    memory.save(out)
    memory.save(tmp_path / "figures")
    stored = {name: (out / name).read_bytes() for name in out.find()}
    assert stored == files_of(tmp_path / "figures")
    assert is_figure_memory(out) and not is_figure_memory(dances)
    assert FigureMemory.open(str(out)).takes[0].source == "us"
    memory, left_out = build_figures(every_file(dances))
    assert [take.name for take in memory.takes] == ["long"]
    assert list(left_out) == [f"{own}/dances/loop.npz"]


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("name\nlong.npz\n", "columns"),
        ("file,colour\nlong.npz,red\n", "colour"),
        ("file\nlost.npz\n", "line 2"),
        ("file,repeat\nlong.npz,often\n", "'often'"),
        ("file\n", "names no file"),
    ],
)
def test_bad_tables_are_refused(folder: Path, text: str, named: str) -> None:
    (folder / "takes.csv").write_text(text)
    with pytest.raises(UserError, match=named):
        read_takes(folder / "takes.csv", folder)


def test_a_loop_goes_round() -> None:
    twice = repeated(swinging_arms(frames=60), 2)
    np.testing.assert_array_equal(twice.quaternions[:60], twice.quaternions[60:])


def turned(take: Motion, joint: str, degrees: float, frames: slice) -> Motion:
    """A motion whose joint is turned about its own X."""
    own = take.quaternions.copy()
    half = np.radians(degrees) / 2
    own[frames, JOINT_INDEX[joint]] = [np.cos(half), np.sin(half), 0.0, 0.0]
    return replace(take, quaternions=own)


def test_heads_and_hands_do_not_turn_over() -> None:
    take = stepping(0.5, 120)
    np.testing.assert_allclose(without_flips(take).quaternions, take.quaternions, atol=1e-6)
    hanging = without_flips(turned(take, "head", 178.0, slice(None)))
    np.testing.assert_allclose(hanging.quaternions[:, JOINT_INDEX["head"], 0], 1.0)
    flipping = without_flips(turned(take, "r_wrist", 170.0, slice(20, 23)))
    before, after = (each.quaternions[:, JOINT_INDEX["r_wrist"]] for each in (take, flipping))
    np.testing.assert_allclose(np.abs(before), np.abs(after), atol=0.05)  # as if nothing had been
    others = [name for name in JOINT_INDEX if name != "r_wrist"]
    rows = [JOINT_INDEX[name] for name in others]
    np.testing.assert_allclose(flipping.quaternions[:, rows], take.quaternions[:, rows], atol=1e-6)
