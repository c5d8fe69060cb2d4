"""`import motionsuite`: laid out as in the wheel and in a checkout, beside somebody's own `src`."""

import os
import pickle
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import motionsuite
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.errors import UsageError

ROOT = Path(__file__).parents[1]
STILL = motionsuite.Motion(
    quaternions=np.tile(np.float32([1, 0, 0, 0]), (4, 22, 1)),
    root_position=np.zeros((4, 3), np.float32),
    contacts=np.zeros((4, 2), np.float32),
    fps=30.0,
)
FOREIGN = "MINE = 1\n"
READ = "import src, motionsuite as ms; print(src.MINE, ms.Motion.__module__, len(ms.models()) > 2)"


def run(place: Path, packages: Path, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=place, env=os.environ | {"PYTHONPATH": str(packages)}, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder as the wheel unpacks, by pyproject's own table of packages."""
    place = tmp_path_factory.mktemp("site-packages")
    tables = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["poetry"]
    for package in tables["packages"]:
        if "wheel" in package.get("format", ["wheel"]):
            target = place / package.get("to", "") / package["include"]
            ignored = shutil.ignore_patterns("__pycache__", "*.safetensors")
            shutil.copytree(ROOT / package["include"], target, ignore=ignored)
    return place


@pytest.fixture
def foreign(tmp_path: Path) -> Path:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "__init__.py").write_text(FOREIGN, encoding="utf-8")
    return tmp_path


def test_the_wheel_stands_beside_a_foreign_src(wheel: Path, foreign: Path) -> None:
    assert run(foreign, wheel, "-c", READ) == "1 motionsuite.src.shared.motion.motion True"
    assert run(foreign, wheel, "-m", "motionsuite", "--version").startswith("motion-tools ")
    assert "Usage: " in run(foreign, wheel, "-m", "motionsuite.src.train.train_clip", "--help")


def test_a_checkout_stands_beside_a_foreign_src(foreign: Path) -> None:
    assert run(foreign, ROOT, "-c", READ) == "1 motionsuite.src.shared.motion.motion True"


def test_a_checkout_has_one_copy_of_the_code() -> None:
    names = "import motionsuite as ms, src.shared.motion.motion as m; print(ms.Motion is m.Motion)"
    assert run(ROOT, ROOT, "-c", names) == "True"


ANYWHERE = """
from motionsuite.src.shared.pipelines.path import read_path
from motionsuite.src.shared.motion.motion import Motion
import motionsuite as ms, motionsuite.src.shared.motion.motion as m, pickle
assert ms.Motion is Motion is m.Motion and m.__spec__.name == m.__name__ == Motion.__module__
assert pickle.loads(b"cmotionsuite.src.shared.motion.motion\\nMotion\\n.") is Motion
try:
    import motionsuite.src.shared.nothing
except ModuleNotFoundError as error:
    print(error)
"""


@pytest.mark.parametrize("kind", ["wheel", "checkout", "checkout beside a foreign src"])
def test_whatever_has_no_public_name_is_imported_alike_anywhere(
    kind: str, wheel: Path, foreign: Path, tmp_path: Path
) -> None:
    place = foreign if "foreign" in kind else ROOT if kind == "checkout" else tmp_path
    said = run(place, wheel if kind == "wheel" else ROOT, "-c", ANYWHERE)
    assert said.startswith("No module named") and said.endswith("src.shared.nothing'")


def test_every_public_name_is_there_and_none_costs_an_import_before() -> None:
    for name in motionsuite.__all__:
        assert getattr(motionsuite, name) is not None
    assert set(motionsuite.__all__) <= set(dir(motionsuite))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        motionsuite.nothing  # noqa: B018
    loaded = "import sys, motionsuite; print({'torch', 'numpy', 'typer'} & sys.modules.keys())"
    assert run(ROOT, ROOT, "-c", loaded) == "set()"


@pytest.mark.parametrize(
    ("prompts", "options", "line"),
    [
        (None, {}, "prompts is None"),
        (["a", 3], {}, "prompts is"),
        ("a person walks", {"seconds": 1e9}, "seconds 1000000000 is out of range"),
        (["a", "b"], {"seconds": [1.0, 2.0, 3.0]}, "3 lengths for 2 prompts"),
        ("a person walks", {"sampling": {"seed": 1}}, "sampling is"),
        ("…", {}, "prompt '…' holds no word"),
        ("a\ud800", {}, "holds no word"),
        ("a person walks", {"seconds": np.array(2.0)}, "seconds array"),
        ("a person walks", {"num_samples": 2.5}, "num_samples 2.5 is out of range"),
        ("a person walks", {"foot_lock": "no"}, "foot_lock is 'no'; give True or False"),
        ("a person walks", {"tags": [5]}, "tag 5"),
        (["a", "b"], {"tags": ["wave"]}, "1 tags for 2 prompts"),
        ("a person walks", {"progress": 5}, "progress is 5"),
    ],
)
def test_mistakes_are_named_before_the_work(
    prompts: Any, options: dict[str, Any], line: str
) -> None:
    with pytest.raises(UsageError, match=line):
        motionsuite.load("starter").generate(prompts, **options)


@pytest.mark.parametrize(
    ("motion", "line"),
    [
        (np.zeros((4, 22, 3)), "motion is ndarray; give one Motion"),
        ([STILL, STILL], "motion is 2 motions; give one Motion.*each a file of its own"),
        (None, "motion is NoneType"),
    ],
)
def test_what_is_not_one_motion_is_not_saved(motion: Any, line: str, tmp_path: Path) -> None:
    with pytest.raises(motionsuite.UsageError, match=line):
        motionsuite.save(motion, tmp_path / "a.bvh")
    assert not list(tmp_path.iterdir())


SONG, WALK = "song.wav", "a person walks"
WAY = [[0.0, 0.0], [0.0, 1.0]]


@pytest.mark.parametrize(
    ("call", "line"),
    [
        (lambda g: g.dance(SONG, seconds=-3), "seconds -3 is out of range; choose from 1 to"),
        (lambda g: g.trajectory(SONG, seconds=float("nan")), "seconds nan is out of range"),
        (lambda g: g.dance(SONG, WALK, style="proud"), "style 'proud' .* give follow_path=True"),
        (lambda g: g.dance(SONG, WALK, follow_path=True, path=WAY), "does not go with follow_path"),
        (lambda g: g.dance(SONG, WALK, meter=5), "meter 5 .* whole number from 3 to 4"),
        (lambda g: g.dance(SONG, WALK, num_samples=0), "num_samples 0"),
        (lambda g: g.dance(SONG, 5), "prompt 5"),
        (lambda g: g.trajectory(SONG, style=np.full(8, np.nan)), "no unit vector of 8"),
        (lambda g: g.trajectory(SONG, sampling=None), "sampling is None"),
        (lambda g: g.timeline(WALK, loop=True, path=WAY), "does not go with loop"),
        (lambda g: g.timeline(WALK, seconds="x"), "seconds 'x'"),
        (lambda g: g.timeline(WALK, path=WAY, seconds=-3), "seconds -3"),
        (lambda g: g.timeline([]), " is empty; give a text"),
        (
            lambda g: g.timeline(WALK, path=[[0, 0, 0], [0, 1, 2]], seconds=2),
            "seconds 2: the path has times",
        ),
        (lambda g: g.timeline(WALK, path=5), "path: holds no list of points"),
        (lambda g: g.timeline(WALK, path=[[0, 0], [0, "a"]]), "path: point 2: z is 'a'"),
        (lambda g: g.edit(STILL, WALK), "given is a Motion; make it with edit_clip"),
        (lambda g: g.edit(motionsuite.edit_clip(STILL, 0, 0.1), ""), "prompt ''"),
        (lambda g: g.stream(5), "text 5"),
        (lambda g: g.candidates("…", 1), "holds no word"),
        (lambda g: motionsuite.load(runtime="Torch"), "runtime 'Torch' is unknown; choose from"),
        (lambda g: motionsuite.read_motion(SONG, fps=0), "fps 0 is out of range"),
    ],
)
def test_the_library_refuses_what_the_command_does(
    call: Callable[[motionsuite.MotionGenerator], Any], line: str
) -> None:
    with pytest.raises(motionsuite.UserError, match=line):
        call(motionsuite.load("starter", device="cpu"))


def test_seeds_of_numpy_and_paths_of_points_are_taken() -> None:
    generator = motionsuite.load("starter", device="cpu")
    wanted = generator.generate(WALK, seconds=1.0, sampling=motionsuite.Sampling(seed=3))[0]
    for kind in (np.uint8, np.int32, np.uint64):
        sampling = motionsuite.Sampling(seed=kind(3))
        [(made)] = generator.candidates(WALK, 1, seconds=1.0, sampling=sampling)
        assert np.array_equal(made.motion.quaternions, wanted.quaternions) and not made.warning
    for way in (np.array(WAY), [(0, 0), (0, 1)], [{"x": 0, "z": 0}, {"x": 0, "z": 1}]):
        made = generator.timeline(WALK, path=way, seconds=2.0)
        assert made.errors["path_max"] < 0.01 and made.errors["length"] == 1.0
    assert generator.timeline([WALK, WALK], seconds=1.0).motion.num_frames == 60


def test_a_guess_is_said_with_the_motion_every_time() -> None:
    generator = motionsuite.load("starter", device="cpu")
    for _ in range(2):
        [found] = generator.candidates("he wibbles", 1, seconds=1.0)
        assert found.warning and "far from anything" in found.warning


def test_a_song_is_read_and_told_from_another_by_what_it_is(tmp_path: Path) -> None:
    file = tmp_path / "click.wav"
    render_song(SongSpec(seconds=2.0)).write_wav(file)
    one, two = motionsuite.Song.read(file), motionsuite.Song.read(file)
    assert one != two and one in {one} and one.sha256 == two.sha256
    generator = motionsuite.load("starter", device="cpu")
    with pytest.raises(UsageError, match="meter 3: this Song has"):
        generator.dance(one, WALK, meter=3)


def test_samples_are_not_taken_for_a_song() -> None:
    with pytest.raises(motionsuite.UserError, match="audio is a ndarray; give a sound file"):
        motionsuite.load("starter").dance(np.zeros(22050))  # type: ignore[arg-type]


def test_what_a_user_can_mend_has_a_public_name() -> None:
    assert motionsuite.UsageError is UsageError
    assert issubclass(motionsuite.UsageError, motionsuite.UserError)
    assert len(motionsuite.__all__) == 17, "a name more is a promise more: weigh it"


@pytest.mark.parametrize(
    "wrong",
    [
        {"seed": 1.5},
        {"seed": 2**64},
        {"seed": True},
        {"steps": 0},
        {"guidance_scale": float("nan")},
    ],
)
def test_a_sampling_that_cannot_be_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(UsageError, match="is out of range; choose"):
        motionsuite.Sampling(**wrong)


def test_a_generator_is_copied_as_it_was_opened() -> None:
    opened = motionsuite.load("starter", device="cpu")
    copied = pickle.loads(pickle.dumps(opened))
    assert "text" in vars(opened) and "text" not in vars(copied)
    made, same = (each.generate("a person waves", seconds=1.0)[0] for each in (opened, copied))
    assert np.array_equal(made.quaternions, same.quaternions)
    with pytest.raises(UsageError, match="the model is a NoneType"):
        motionsuite.load(None)
