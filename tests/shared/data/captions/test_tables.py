"""Captions of the user's own: every accepted form, and what is said of the others."""

from pathlib import Path

import pytest

from src.shared.data.captions.tables import Piece, Table, match_captions, read_captions
from src.shared.errors import UsageError, UserError


def write(tmp_path: Path, name: str, text: str) -> Path:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


def texts(table: Table) -> dict[str, dict[str, list[str]]]:
    """Captions of clips that are not cut, by language."""
    return {clip: {code: list(given) for code, given in piece.captions.items()}
            for clip, (piece,) in table.items()}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", 'clip,caption\nwalk.bvh,"walks, then stops"\nwave,waves\n'),
        ("a.csv", 'walk,"walks, then stops"\r\nwave,waves'),
        ("a.csv", "clip;caption\r\nwalk.bvh;walks, then stops\r\nwave;waves\r\n"),
        ("a.csv", '"walk.bvh";"walks, then stops"\n"wave";waves\n'),
        ("a.csv", "clip\tcaption\nwalk\twalks, then stops\nwave\twaves\n"),
        ("a.tsv", "caption\tid\nwalks, then stops\twalk.bvh\nwaves\twave.BVH\n"),
        ("a.json", '{"walk": "walks, then stops", "wave.bvh": ["waves"]}'),
        ("a.json", '[{"file": "walk.bvh", "text": "walks, then stops"},'
                   ' {"clip": "wave", "caption": "waves"}]'),
        ("a.json", '{"walk": {"en": "walks, then stops"}, "wave": {"en": ["waves"]}}'),
    ],
)  # fmt: skip
def test_accepted_forms(tmp_path: Path, name: str, text: str) -> None:
    captions = texts(read_captions(write(tmp_path, name, text)))
    assert captions == {"walk": {"en": ["walks, then stops"]}, "wave": {"en": ["waves"]}}


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-8-sig"])
def test_text_as_spreadsheets_encode_it(tmp_path: Path, encoding: str) -> None:
    mark = "\ufeff" if encoding == "utf-16-be" else ""  # the others write one themselves
    (tmp_path / "a.csv").write_bytes(f"{mark}clip\tcaption\nwalk\t歩く\n".encode(encoding))
    assert texts(read_captions(tmp_path / "a.csv")) == {"walk": {"en": ["歩く"]}}


def test_a_comma_first_makes_semicolons_text(tmp_path: Path) -> None:
    path = write(tmp_path, "a.csv", "walk,walks; stops\nwave,waves\n")
    assert texts(read_captions(path))["walk"] == {"en": ["walks; stops"]}


def test_languages_and_several_captions(tmp_path: Path) -> None:
    text = "clip,caption,language\nwalk,walks,en\nwalk,geht,de\nwalk,strolls,\n"
    captions = texts(read_captions(write(tmp_path, "a.csv", text)))
    assert captions == {"walk": {"en": ["walks", "strolls"], "de": ["geht"]}}


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.csv", "", "no captions"),
        ("a.csv", "walk,walks\nrun,\n", "line 2: no clip or no caption"),
        (
            "a.csv",
            "clip,caption\na,walks, twice\n",
            "line 2: 3 cells for 2 columns; write",
        ),
        ("a.tsv", "clip\tcaption\na\twalks\ttwice\n", "line 2: 3 cells for 2 columns; take out"),
        ("a.csv", "clip,action,start\na,walk,soon\n", "line 2: start 'soon' is not a number"),
        ("a.csv", "clip,action,start,end\na,walk,2,2\n", "start 2 is not before end 2"),
        ("a.csv", "clip,action,repeat\na,walk,1.5\n", "repeat 1.5: must be a whole number"),
        ("a.csv", "clip,action,hold\na,walk,-1\n", "hold -1: must be within 0 and 10"),
        ("a.csv", "clip,action,provenance\na,walk,bought\n", "'bought' is not known; choose from"),
        ("a.txt", "walk,walks\n", "unknown ending '.txt'"),
        ("a.json", '{"walk": \n 3', "line 2: not JSON"),
        ("a.json", '{"walk": 3}', "'walk': 3 is not text"),
        ("a.json", "3", "expected an object or a list"),
        ("a.json", "[3]", "entry 0"),
    ],
)
def test_faults_are_named(tmp_path: Path, name: str, text: str, message: str) -> None:
    path = write(tmp_path, name, text)
    with pytest.raises(UserError, match=message) as error:
        read_captions(path)
    assert str(path) in str(error.value)


PIECES = {
    "a.tsv": "file\tstart\tend\taction\tcount\tcaption\tlanguage\tprovenance\n"
    "t\t0\t2.5\tkick\t2\tkicks | kicks twice\t\thand-made\n"
    "t\t0\t2.5\t\t\ttritt\tde\t\n"
    "t\t2.5\t\twave\t\t\t\t\n",
    "a.json": '[{"clip": "t", "start": 0, "end": 2.5, "action": "kick", "count": 2, "text": '
    '"kicks | kicks twice", "provenance": "hand-made"}, {"clip": "t", "end": 2.5, "text": "tritt",'
    ' "language": "de"}, {"clip": "t", "start": 2.5, "action": "wave"}]',
}


@pytest.mark.parametrize("name", PIECES)
def test_a_take_is_cut_into_pieces_with_labels(tmp_path: Path, name: str) -> None:
    kick, wave = read_captions(write(tmp_path, name, PIECES[name]))["t"]
    labels = {"action": "kick", "count": "2"}
    captions = {"en": ["kicks", "kicks twice"], "de": ["tritt"]}
    assert kick == Piece(0.0, 2.5, 1, 0.0, labels, captions, "hand-made")
    assert wave == Piece(2.5, labels={"action": "wave"})


def test_tables_add_up_and_other_columns_are_no_labels(tmp_path: Path) -> None:
    one = write(tmp_path, "a.tsv", "file\tseconds\tdescription\tsubject\nw.amc\t3.0\twalk\tplay\n")
    two = write(tmp_path, "b.csv", "clip,action\nw,walk\n")
    assert read_captions(one, two) == {
        "w": (Piece(labels={"action": "walk"}, captions={"en": ["walk"]}),)
    }


def test_a_missing_or_binary_file(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not exist; give a"):
        read_captions(tmp_path / "none.csv")
    (tmp_path / "b.csv").write_bytes(b"\x80\x00\xff\xfe")
    with pytest.raises(UserError, match="UTF-8"):
        read_captions(tmp_path / "b.csv")


def saying(*rows: str, **words: str) -> Table:
    """A table whose rows have a caption: their own name, or the word given."""
    given = {**dict(zip(rows, rows, strict=True)), **words}
    told = {"en": "captions c.csv, line 2"}
    return {row: (Piece(captions={"en": [word]}, told=told),) for row, word in given.items()}


def match(rows: list[str], *items: str) -> tuple[dict[str, list[str]], list[str]]:
    """Rows by file, and the rows without one; the caption of each row is the row."""
    (matched,), found = match_captions(saying(*rows), [("mocap", items)])
    given = {item: languages["en"] for item, languages in texts(matched).items()}
    return given, [row for row, has_file in found.items() if not has_file]


def test_rows_find_their_files_by_path_then_by_name() -> None:
    files = ("walk/take1.bvh", "run/take1.BVH", "jump/take2.bvh")
    rows = ["walk/take1", "data/mocap/run/take1", "take2", "none", "hop/take1"]
    given, lost = match(rows, *files)
    assert given == {files[0]: [rows[0]], files[1]: [rows[1]], files[2]: [rows[2]]}
    assert lost == ["none", "hop/take1"]
    assert match(["take1"], "take1.bvh", "walk/take1.bvh")[0] == {"take1.bvh": ["take1"]}
    assert match(["else/where/a.b"], "x/a.b.bvh")[0] == {"x/a.b.bvh": ["else/where/a.b"]}
    with pytest.raises(
        UserError,
        match=r"captions c\.csv, line 2: clip 'take1' fits 2 .*walk/take1.bvh, mocap/run/take1",
    ):
        match(["take1"], *files)


def test_the_folder_of_a_row_parts_two_sources() -> None:
    captions = saying(**{f"{folder}/take1": folder for folder in ("walk", "run")})
    (matched,), found = match_captions(captions, [("run", ["take1.bvh"])])
    assert texts(matched) == {"take1.bvh": {"en": ["run"]}}
    assert found == {"walk/take1": False, "run/take1": True}
    both = [("walk", ["take1.bvh"]), ("run", ["take1.bvh"])]
    matched, found = match_captions(captions, both)
    assert [*map(texts, matched)] == [{"take1.bvh": {"en": [folder]}} for folder in ("walk", "run")]
    assert all(found.values())


def test_a_row_that_fits_a_file_of_each_source_is_refused() -> None:
    sources = [("a/mocap", ["take1.bvh"]), ("b/mocap", ["take1.bvh", "take2.bvh"])]
    with pytest.raises(UserError, match=r"'take1' fits 2 .*a/mocap/take1.bvh, b/mocap/take1.bvh"):
        match_captions(saying("take1"), sources)
    rows = saying(**{"b/mocap/take1": "walks", "take2": "runs"})
    matched, _ = match_captions(rows, sources)
    assert [*map(texts, matched)] == [
        {},
        {"take1.bvh": {"en": ["walks"]}, "take2.bvh": {"en": ["runs"]}},
    ]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("clip,action,captoin\na,walk,someone walks\n", "column 'captoin' .* to 'caption'"),
        ("clip,caption,side\na,someone waves,lefft\n", "side 'lefft' is none; write 'left'"),
        ("clip,caption,side\na,someone waves,top\n", "side 'top' .* choose from left"),
        ("clip,action,direction\na,walk,forwrd\n", "line 2: direction .* write 'forward'"),
        ("clip,action,speed\na,walk,fsat\n", "speed 'fsat' is none; write 'fast'"),
        ("clip,action,angle\na,turn,ninety\n", "angle 'ninety': write degrees in digits"),
        ("clip,action,count\na,jump,-5\n", "count '-5': write a number of times"),
        ("clip,action,count\na,jump,2.0\n", "count '2.0'"),
    ],
)
def test_misspelt_columns_and_labels_are_named(tmp_path: Path, text: str, line: str) -> None:
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(UserError, match=line):
        read_captions(tmp_path / "a.csv")


def test_labels_are_written_as_others_write_them(tmp_path: Path) -> None:
    """`Walk` was another action than `walk`, and taught beside it."""
    (tmp_path / "a.csv").write_text(
        "clip,action,side,direction,style,count\na,Walk,Left,around,Odd,03\n"
    )
    [[piece]] = read_captions(tmp_path / "a.csv").values()
    assert piece.labels == {
        "action": "walk", "side": "left", "direction": "around", "style": "Odd", "count": "3"
    }  # fmt: skip
