"""Every message a user can cause names a value and a remedy; some are caused through the CLI.

`pytest tests/test_messages.py -v` lists them all, each with its place in the source.
"""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from src.cli.tools import app
from src.shared.errors import LONGEST, UserError
from tests.messages import HOLE, Message, messages, passes_on

VERBS = (
    "add|answer|ask|build|check|choose|clear|compare|convert|copy|correct|cut|delete|describe|draw"
    "|evaluate|export|fetch|fill|finish|fit|free|give|install|keep|leave|let|lower|make|map|mend"
    "|move|name|open|pass|pick|prepare|put|raise|remove|rename|replace|run|save|say|select|set"
    "|shorten|split|start|state|take|train|turn|undo|update|upgrade|use|wait|write"
)
# A verb that begins a clause: "…; export it again", "choose from a, b".
REMEDY = re.compile(
    rf"(?:^|[;:,(.] +`?|\b(?:or|and|then|instead|so) +)(?:{VERBS})\b", re.IGNORECASE
)
# What would be right instead is a remedy, too.
WANTED = re.compile(
    r"\b(?:expected|known are|known:|there are|needs?|must|at least|at most|is needed|are needed"
    r"|nearest|did you mean|groups:|the keys are|not within|supported:)"
)
NOTHING = "nothing was given, so there is no value"
OF_PYTHON = "told to whoever calls from Python, whose traceback names the place"
ITS_PARTS = "the values that are put in end with the remedy"
EXCEPTIONS = {
    "OUT is missing": NOTHING,
    "the question is empty": NOTHING,
    "no data: give root": NOTHING,
    "memory: folder is empty": NOTHING,
    "no prompt given": NOTHING,
    "no real motions to measure": NOTHING,
    "nothing to draw": NOTHING,
    "cannot learn what prompts are known": NOTHING,
    "cannot train a tokenizer": NOTHING,
    "prompts is a string": OF_PYTHON,
    "give audio_embedding": OF_PYTHON,
    "the skeleton's legs have no length": "the caller puts the file before it",
    "this text model has no root track": "the only model of that command",
    "precision 'fp16' needs a GPU": "the value is the constant itself",
    "plots need matplotlib": "a package is missing, no value is wrong",
    "--num-samples does not go with {}": "says what takes its place: another --seed",
    "--prompt is given {} times beside {}": "says what takes its place: --then",
    "{}: is an analysed song": "says which command draws it",
    "none of the {} clips could be used": "the report it names has the reason of each",
    "caption file {}: {}": ITS_PARTS,
    "tag {} is not one": ITS_PARTS,
    "{} holds {}, not {}": ITS_PARTS,
    "no model named {}": ITS_PARTS,
    "{}: its bones tell no body": ITS_PARTS,
}
CATALOGUE = [message for message in messages() if not passes_on(message.text)]


def is_excepted(message: Message) -> bool:
    return any(message.text.startswith(start) for start in EXCEPTIONS)


@pytest.mark.parametrize("message", CATALOGUE, ids=lambda message: message.shown)
def test_a_message_has_value_and_remedy(message: Message) -> None:
    if is_excepted(message):
        return
    assert HOLE in message.text or "--" in message.text, "no value and no flag is named"
    assert REMEDY.search(message.text) or WANTED.search(message.text), "no remedy"


def test_exceptions_are_real() -> None:
    assert len(CATALOGUE) > 300
    for start in EXCEPTIONS:
        assert any(message.text.startswith(start) for message in CATALOGUE), start


def test_what_is_quoted_cannot_harm_a_terminal() -> None:
    told = str(UserError("joint '\x1b]0;x\x07\x9b2J\ud800' " + "A" * 10**6 + "; export it again"))
    assert len(told) < LONGEST
    assert told.isprintable()
    assert told.endswith("; export it again")
    told.encode()


# ---------------------------------------------------------------- caused for real


def write_files(folder: Path) -> None:
    """What the commands below are given."""
    (folder / "empty").mkdir()
    (folder / "cut.bvh").write_text("HIERARCHY\nROOT hips\n{\n  OFFSET 0 0 0\n")
    (folder / "alone.amc").write_text(":DEGREES\n1\nroot 0 0 0 0 0 0\n")
    (folder / "other.txt").write_text("hello")
    (folder / "bad.glb").write_bytes(b"glTF\2\0\0\0\xff\xff\xff\xff")
    (folder / "fake.npz").write_bytes(b"PK\3\4 no archive")
    np.savez(folder / "pickle.npz", poses=np.array([{}, 1], object), trans=np.zeros((2, 3)))
    np.savez(folder / "nameless.npz", x=np.zeros(3))
    np.save(folder / "wrong.npy", np.zeros((5, 7)))
    (folder / "noise.wav").write_bytes(b"RIFF" + bytes(100))
    (folder / "deep.yaml").write_text("[" * 100_000)
    (folder / "captions.csv").write_text("clip,caption\nwalk,\n")
    (folder / "model").mkdir()
    (folder / "model/config.json").write_text("[" * 100_000)
    (folder / "prepared").mkdir()
    (folder / "prepared/manifest.json").write_text(json.dumps({"files": {"../x": "0"}}))


OUT = "out.bvh"
CASES: list[tuple[str, int, str]] = [
    ("convert none.bvh out.bvh", 2, r"none\.bvh"),
    ("convert cut.bvh out.bvh", 1, r"cut\.bvh"),
    ("convert cut.bvh out.xyz", 2, r"out\.xyz"),
    ("convert other.txt out.bvh", 1, r"other\.txt"),
    ("convert alone.amc out.bvh", 1, r"alone\.amc"),
    ("convert bad.glb out.bvh", 1, r"bad\.glb"),
    ("convert fake.npz out.bvh", 1, r"fake\.npz"),
    ("convert pickle.npz out.bvh", 1, r"pickle\.npz.*can run code"),
    ("convert nameless.npz out.bvh", 1, r"nameless\.npz"),
    ("convert wrong.npy out.bvh", 1, r"wrong\.npy"),
    ("convert empty out --format bvh", 1, "empty"),
    ("convert cut.bvh out.bvh --mapping deep.yaml", 1, r"cut\.bvh"),
    ("convert cut.bvh out.bvh --fps 0", 2, "--fps 0"),
    ("convert cut.bvh out.bvh --root off", 2, "--root 'off'"),
    ("inspect cut.bvh", 1, r"cut\.bvh"),
    ("inspect none.bvh", 2, r"none\.bvh"),
    ("generate", 2, "--prompt"),
    ("generate --prompt walk --seconds -1", 2, "-1"),
    ("generate --prompt caf\udce9", 2, "caf.*is not UTF-8 text"),
    (f"generate --audio {'a' * 300}.wav", 2, "its name is too long"),
    ("generate --prompt walk --format dae", 2, "dae"),
    ("generate --prompt walk --model no-such", 2, "no-such"),
    ("generate --prompt walk --model model", 1, r"config\.json"),
    ("generate --audio none.wav", 2, r"none\.wav"),
    ("features noise.wav --out f.npz", 1, r"noise\.wav"),
    ("prepare empty --out data", 1, "empty"),
    ("prepare none --out data", 2, "none"),
    ("prepare empty --captions captions.csv --out data", 1, "empty"),
    ("evaluate --model no-such --data prepared --out report", 2, "prepared|no-such"),
    ("memory query walk --memory empty", 1, "empty"),
    ("shape-check --network-profile huge", 2, "huge"),
    ("shape-check network.generation.num-headz=2", 2, "num-heads"),
]


@pytest.fixture(scope="module")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("messages")
    write_files(folder)
    return folder


@pytest.mark.parametrize(("line", "code", "names"), CASES, ids=[case[0] for case in CASES])
def test_a_mistake_ends_in_one_line(
    line: str, code: int, names: str, scratch: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(scratch)
    done: Any = CliRunner().invoke(app, line.split())
    assert done.exit_code == code, done.output
    assert "Traceback" not in done.output
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    errors = [text for text in done.stderr.splitlines() if text.startswith("error: ")]
    assert len(errors) == 1, done.stderr
    assert re.search(names, errors[0])
