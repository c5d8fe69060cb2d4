"""How far a datum walks: files, functions and changes of file from a request to what is written.

    python benchmarks/walk.py                     # a prompt to BVH; a song and a sentence to BVH
    python benchmarks/walk.py -- convert in.bvh out.glb

Every call of a function of src/ is counted; what runs while a module of src/ is imported is not. A
change of file is a call whose file is another one than that of the call before it. The NumPy that
stands in for PyTorch (src/shared/tensors) is counted as well, and told apart: who reads a walk
through PyTorch itself does not enter that either. Each request runs in a process of its own, as
commands do: what the first one chose (NumPy in place of PyTorch) would else bind the second.
"""

import argparse
import contextlib
import inspect
import io
import multiprocessing
import sys
import tempfile
import threading
from collections import Counter
from pathlib import Path
from types import FrameType
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
SOURCE = str(ROOT / "src")
STAND_IN = str(ROOT / "src" / "shared" / "tensors")


class Walk:
    """Counts calls while it is entered."""

    def __init__(self) -> None:
        self.calls: Counter[tuple[str, str]] = Counter()
        self.edges: Counter[tuple[str, str]] = Counter()
        self.changes_but_tensors = 0
        self._last = self._last_but_tensors = ""

    def __enter__(self) -> "Walk":
        threading.setprofile(self._event)
        sys.setprofile(self._event)
        return self

    def __exit__(self, *_: object) -> None:
        sys.setprofile(None)
        threading.setprofile(None)  # type: ignore[arg-type]

    def _event(self, frame: FrameType, event: str, _: Any) -> None:
        code = frame.f_code
        if event != "call" or not code.co_filename.startswith(SOURCE) or _is_import(frame):
            return
        self.calls[code.co_filename, code.co_qualname] += 1
        if code.co_filename != self._last:
            if self._last:
                self.edges[self._last, code.co_filename] += 1
            self._last = code.co_filename
        if not code.co_filename.startswith(STAND_IN) and code.co_filename != self._last_but_tensors:
            self.changes_but_tensors += bool(self._last_but_tensors)
            self._last_but_tensors = code.co_filename

    @property
    def changes(self) -> int:
        """How often a call was of another file than the call before it."""
        return self.edges.total()

    @property
    def files(self) -> list[str]:
        """Those in which a function ran."""
        return sorted({_short(file) for file, _ in self.calls})


def _short(file: str) -> str:
    """The path of a file from the root of the repository."""
    return str(Path(file).relative_to(ROOT))


def _is_import(frame: FrameType | None) -> bool:
    """Whether a frame executes a module or a class, or was called by one that does."""
    while frame is not None:
        code = frame.f_code
        if not code.co_flags & inspect.CO_OPTIMIZED and code.co_filename.startswith(SOURCE):
            return True
        frame = frame.f_back
    return False


def walk(arguments: list[str]) -> Walk:
    """Run one command of motion-tools.

    Raises:
        RuntimeError: it failed; what it did until then is no walk.
    """
    from src.cli.tools import app

    found, said = Walk(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), found:
        code = app(arguments, standalone_mode=False)
    if code:
        raise RuntimeError(f"{' '.join(arguments)} ended with {code}: {said.getvalue()}")
    return found


def main() -> None:
    """Print a line a command."""
    parser = argparse.ArgumentParser(description=str(__doc__).splitlines()[0])
    parser.add_argument("--files", action="store_true", help="name the files")
    parser.add_argument("--edges", type=int, default=0, help="name the N commonest changes of file")
    parser.add_argument("--functions", type=int, default=0, help="name the N most called functions")
    parser.add_argument("command", nargs="*", help="of motion-tools, after --")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        commands = {" ".join(options.command): options.command} if options.command else asked(place)
        for name, arguments in commands.items():
            with multiprocessing.get_context("spawn").Pool(1) as fresh:
                found = fresh.apply(walk, (arguments,))
            print(
                f"{name}: {len(found.files)} files, {len(found.calls)} functions,"
                f" {found.changes} changes of file"
                f" ({found.changes_but_tensors} but for the stand-in of PyTorch)"
            )
            if options.files:
                print(*(f"  {file}" for file in found.files), sep="\n")
            for (start, end), count in found.edges.most_common(options.edges):
                print(f"  {count:5} {_short(start)} -> {_short(end)}")
            for (file, function), count in found.calls.most_common(options.functions):
                print(f"  {count:5} {_short(file)}: {function}")


def asked(place: str) -> dict[str, list[str]]:
    """The two requests of the issue."""
    from src.shared.audio.synthetic import SongSpec, render_song

    song = Path(place) / "song.wav"
    render_song(SongSpec(seconds=6.0, seed=1)).write_wav(song)
    shared = ["--format", "bvh", "--out", f"{place}/made", "--threads", "1", "--device", "cpu"]
    prompt = ["generate", "--prompt", "a person waves", *shared]
    dance = ["generate", "--audio", str(song), "--prompt", "a person dances", *shared]
    return {"a prompt": prompt, "a song and a sentence": dance}


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))
    main()
