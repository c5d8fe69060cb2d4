"""`generate --format`: every format it offers gets the ending that `convert` reads it by."""

from pathlib import Path

from src.cli.generate_files import FORMATS, motion_files, write_motions
from src.shared.formats.registry import EXPORTERS, format_of
from tests.shared.formats.test_registry import standing


def test_offered_formats_are_written_under_their_ending(tmp_path: Path) -> None:
    formats = [name for name in EXPORTERS if name not in ("mp4", "gif", "png", "html", "fbx")]
    places = motion_files(["stands"], 1, formats, tmp_path)
    (row,) = write_motions([standing()], places)
    assert list(row["files"]) == formats
    for name, path in row["files"].items():
        assert Path(path).exists()
        assert format_of(path) == name
    assert row["files"]["amass"].endswith("01-stands.amass.npz")


def test_the_default_is_part_of_the_offer() -> None:
    assert set(FORMATS) < set(EXPORTERS)
