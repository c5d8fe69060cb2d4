"""Set-up without installing anything: which packages, from where, and when nothing is to do."""

import importlib
import importlib.util
import json
import re
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from packaging.requirements import Requirement

from src.shared.config_loader import load_network, load_train, split_network_overrides
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.motion.features import (
    FORWARD,
    LATERAL,
    ROOT_ROW,
    decode_features,
    encode_features,
)
from src.shared.motion.skeleton import JOINT_INDEX

ROOT = Path(__file__).parent.parent


def load(name: str) -> ModuleType:
    """A script as a module; `tasks` imports `setup` by that name."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "scripts" / f"{name}.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def setup(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """The set-up script with an empty environment folder of its own and no real commands."""
    module = load("setup")
    folder = tmp_path / ".venv"
    monkeypatch.setattr(module, "VENV", folder)
    monkeypatch.setattr(module, "STAMP", folder / "setup.json")
    monkeypatch.setattr(module, "LOG", folder / "setup.log")
    monkeypatch.delenv("TORCH_INDEX", raising=False)

    def run(command: list[str], *, check: bool = True) -> bool:
        if "venv" in command:
            module.venv_tool("python").parent.mkdir(parents=True)
            module.venv_tool("python").touch()
        return True

    monkeypatch.setattr(module, "run", run)
    return module


@pytest.fixture
def installed(setup: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What pip would be asked for, line by line."""
    asked: list[str] = []

    def pip(*arguments: str, check: bool = True) -> bool:
        for index, argument in enumerate(arguments):
            if argument == "-r":
                asked.extend(Path(arguments[index + 1]).read_text().splitlines())
        asked.append(" ".join(arguments))
        return True

    monkeypatch.setattr(setup, "pip", pip)
    return asked


def names(lines: list[str]) -> set[str]:
    return {line.partition("==")[0] for line in lines if "==" in line}


def test_locked_packages_are_requirements_with_markers(setup: ModuleType) -> None:
    main, both = setup.locked_packages({"main"}), setup.locked_packages({"main", "dev"})
    assert all(Requirement(line).specifier for line in both)
    assert {"torch", "transformers", "typer"} <= names(main)
    assert "pytest" in names(both) - names(main)
    windows = next(line for line in both if line.startswith("colorama=="))
    assert Requirement(windows).marker is not None, "a marker of each group, joined by `or`"


def test_cpu_torch_leaves_the_cuda_packages_out(
    setup: ModuleType, installed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(setup, "install_cpu_torch", lambda _: True)
    assert setup.install({"main"}) == "cpu"
    assert not any(name.startswith(("nvidia-", "cuda-", "triton")) for name in names(installed))
    assert "torch" not in names(installed)


def test_without_a_cpu_wheel_the_whole_lock_is_installed(
    setup: ModuleType, installed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Leaving the CUDA packages out would break the import of the CUDA build."""
    monkeypatch.setattr(setup, "install_cpu_torch", lambda _: False)
    assert setup.install({"main"}) == "locked"
    assert {"torch", "nvidia-cublas", "triton"} <= names(installed)


def test_torch_index_is_used_when_named(
    setup: ModuleType, installed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TORCH_INDEX", "somewhere")
    answer = SimpleNamespace(stdout="2.13.0+cpu\n")
    monkeypatch.setattr(setup.subprocess, "run", lambda *_, **__: answer)
    assert setup.install_cpu_torch("torch==2.13.0")
    assert installed == ["torch==2.13.0 --index-url somewhere"]


def test_second_run_does_nothing_until_the_lock_changes(
    setup: ModuleType, installed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(setup, "install_cpu_torch", lambda _: True)
    setup.main([])
    assert installed
    installed.clear()
    setup.main([])
    assert not installed
    setup.main(["--dev"])
    assert "pytest" in names(installed)
    installed.clear()
    setup.main([])  # what is there already serves
    assert not installed
    setup.STAMP.write_text("{}")
    setup.main([])
    assert installed


def test_supported_versions_are_the_projects(setup: ModuleType) -> None:
    assert [setup.supported(version) for version in ((3, 10), (3, 11), (3, 13), (3, 14))] == [
        False, True, True, False,
    ]  # fmt: skip
    assert 'requires-python = ">=3.11,<3.14"' in (ROOT / "pyproject.toml").read_text()


def test_every_make_target_is_a_task_and_the_other_way_round() -> None:
    load("setup")
    tasks = load("tasks").TASKS
    makefile = (ROOT / "Makefile").read_text()
    declared = set(re.search(r"\.PHONY: (.*)", makefile)[1].split())  # type: ignore[index]
    assert declared == set(tasks) | {"help", "setup"}


def test_demo_has_three_prompts_and_not_all_in_english() -> None:
    load("setup")
    prompts = load("tasks").PROMPTS
    assert len(prompts) >= 3
    assert any(not prompt.isascii() for prompt in prompts)


def test_demo_makes_a_song_and_moves_to_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(load("setup"), "main", lambda _: None)
    tasks = load("tasks")
    called: list[tuple[str, ...]] = []
    monkeypatch.setattr(tasks, "python", lambda *words: called.append(words) or 0)
    assert tasks.demo(["--device", "cpu"]) == 0
    prompts, song, audio, studio = called
    assert "--prompt" in prompts and prompts[-2:] == ("--device", "cpu")
    assert audio[audio.index("--audio") + 1] == "outputs/demo/song.wav"
    assert "--body" in audio
    assert studio[-4:] == ("studio", "--out", "outputs/demo/studio.html", "--no-open")
    done = subprocess.run([sys.executable, "-c", song[1].replace(tasks.DEMO, str(tmp_path / "x"))],
                          cwd=ROOT, check=True)  # fmt: skip
    assert done.returncode == 0
    assert (tmp_path / "x" / "song.wav").stat().st_size == pytest.approx(16 * 88_200, abs=100)


@pytest.mark.parametrize("card", [False, True])
def test_gpu_check_says_when_there_is_none(
    card: bool,
    setup: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """Before anything is installed where there is no card; else as PyTorch sees it."""
    tasks = load("tasks")
    ran: list[object] = []
    monkeypatch.setattr(tasks.setup, "has_nvidia_card", lambda: card)
    monkeypatch.setattr(tasks.setup, "main", ran.append)
    monkeypatch.setattr(tasks, "python", lambda *words, **_: ran.append(words) or 1)
    assert tasks.gpu_check([]) == 1
    assert len(ran) == (2 if card else 0)
    assert "no CUDA device here; nothing was checked" in capfd.readouterr().err


def test_a_release_is_numbered_and_dated(tmp_path: Path) -> None:
    release = load("release")
    for name in ("pyproject.toml", "CITATION.cff"):
        (tmp_path / name).write_text((ROOT / name).read_text())
    (tmp_path / "CHANGELOG.md").write_text("## [Unreleased]\n\n### Added\n\n- More.\n")
    release.number(tmp_path, "1.2.0")
    assert 'version = "1.2.0"' in (tmp_path / "pyproject.toml").read_text()
    assert "\nversion: 1.2.0\n" in (tmp_path / "CITATION.cff").read_text()
    log = (tmp_path / "CHANGELOG.md").read_text()
    assert re.match(r"## \[Unreleased\]\n\n## \[1\.2\.0\] - \d{4}-\d\d-\d\d\n\n### Added", log)
    for version, told in (("1.2.0", "nothing under"), ("next", "no 1.2.3")):
        with pytest.raises(SystemExit, match=told):
            release.number(tmp_path, version)


def test_every_stage_of_the_recipe_knows_its_settings(tmp_path: Path) -> None:
    """And each goes on from a folder that one before it writes. Adapters learn what there is."""
    recipe = load("train_starter")
    given = SimpleNamespace(sources=["cmu"], tables=[], work=tmp_path, free=True, steps=4000,
                            share=0.001, threads=1)  # fmt: skip
    shown = [("bow", {}), ("bow", {}), ("wave", {}), ("raise", {}), ("raise", {})]
    shown += [("walk", {"style": "sad"})] * 2 + [("walk", {"style": "happy"})] + [("walk", {})] * 20
    made = [("nod", {}), ("bow", {})]
    folders = {"data": shown, "blows": [("slash", {})] * 2, "gestures": made}
    for folder, clips in folders.items():
        lines = [
            json.dumps({"tag": tag, "labels": labels, "group": f"{tag}{labels}",
                        "split": "train", "provenance": "captured"})
            for tag, labels in clips
        ]  # fmt: skip
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "clips.jsonl").write_text("\n".join(lines), encoding="utf-8")
    take = tmp_path / "takes" / "dataset-1_slash_normal_001.bvh"
    take.parent.mkdir()
    take.touch()
    given.sources.append(str(take.parent))
    written, learned, prepared = set(), [], dict[Path, list[str]]()
    for _, module, *words in recipe.stages(given):
        if module == "scripts.gesture_clips":
            clips_at = words[0]
            continue
        flags = dict(pairwise(words))
        if module == "src.cli.tools":
            assert words[0] == "prepare" or Path(flags["--model"]) in written
            if words[0] == "prepare":
                prepared[Path(flags["--out"])] = words
            continue
        assert Path(flags["--data"]) in prepared
        name = f"Train{module.rpartition('_')[2].title()}Config"
        stage = getattr(importlib.import_module(module), name)
        own, network = split_network_overrides([word for word in words if "=" in word])
        settings = load_train(None, stage, own)
        if hasattr(settings, "profile"):
            load_network(settings.profile, None, network)
        least, most = (300, 1200) if module.endswith("train_text") else (1, 12)
        assert least <= settings.steps <= most
        before = (getattr(settings, name, None) for name in ("clip", "text"))
        assert {Path(folder) for folder in before if folder} <= written
        if module.endswith("train_action"):
            assert Path(settings.init) in written
            learned.append((settings.actions, settings.styles))
        written.add(Path(flags["--output"]))
    assert learned == [
        (("bow",), ()), (("slash",), ()), (("walk",), ("sad",)), (("walk",), ("plain",)), ((), ()),
        (("bow",), ()),
    ]  # fmt: skip
    assert clips_at in prepared[tmp_path / "gestures"]
    assert str(take) in prepared[tmp_path / "blows"]
    assert len(written) == 11 and {tmp_path / "starter", tmp_path / "evaluator"} <= written


def test_cmus_own_index_becomes_captions() -> None:
    text = [
        "Subject #1 (climb, swing)",
        "01_01\tplayground - jumps,  turn",
        "",
        "Subject #133 (infant)",
    ]
    text += ["133_14.bvh  Walk Left"]
    found = list(load("cmu_captions").rows(text))
    assert found[1:] == [
        "01_01\tplayground - jumps, turn\tclimb, swing",
        "133_14\tWalk Left\tinfant",
    ]
    assert list(load("cmu_captions").rows(text, ["133"])) == [found[0], found[2]]


# ---------------------------------------------------------------- clips of gestures


@pytest.fixture(scope="module")
def gestures() -> ModuleType:
    """The script that makes clips by rule."""
    return load("gesture_clips")


def test_clips_of_gestures_come_with_a_table(gestures: ModuleType, tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "scripts" / "gesture_clips.py"), str(tmp_path)]
    subprocess.run([*command, "--each", "2", "--actions", "nod,point"], check=True)
    lines = (tmp_path / "clips.tsv").read_text(encoding="utf-8").splitlines()
    rows = [line.split("\t") for line in lines]
    assert rows[0] == ["file", "action", "side", "direction", "provenance"]
    assert [row[1] for row in rows[1:]] == ["nod"] * 2 + ["point"] * 6
    assert {row[2] for row in rows[3:]} == {"", "left", "right"}
    for row in rows[1:]:
        assert (tmp_path / f"{row[0]}.bvh").read_text().count("Frames: ") == 1


def test_all_gestures_stand_on_the_ground_and_move(gestures: ModuleType) -> None:
    for action, (_, short, long, kinds) in gestures.ACTIONS.items():
        for labels in kinds:
            first, last = (gestures.make(action, labels, n, 24, 0) for n in (0, 23))
            assert (first.num_frames, last.num_frames) == (round(30 * short), round(30 * long))
            joints = first.positions()
            lowest = float(joints[..., 1].min())
            highest = {"fly": 0.9, "swim": 0.5, "sleep": 0.1}.get(action, 0.06)  # a back is thick
            assert -0.03 < lowest < highest, (action, lowest)
            way = np.linalg.norm(np.diff(joints, axis=0), axis=-1).sum(0).max()
            # metres of the joint that goes furthest
            assert way > (0.03 if action in ("sleep", "kneel") else 0.08), (action, way)


def test_a_nod_is_as_large_as_a_nod(gestures: ModuleType) -> None:
    """The neck goes down by 10 to 40 degrees, twice at least in two seconds."""
    motion = gestures.make("nod", {}, 0, 24, 0)
    joints = motion.positions()
    way = joints[:, JOINT_INDEX["head"]] - joints[:, JOINT_INDEX["neck"]]
    down = np.degrees(np.arctan2(way[:, 2], way[:, 1]))
    down -= down[0]
    assert 10 < down.max() < 40  # the head itself as far again
    assert ((down[1:-1] > down[:-2]) & (down[1:-1] >= down[2:]) & (down[1:-1] > 8)).sum() >= 2


def test_a_walk_to_the_side_becomes_one_ahead_on_the_same_feet() -> None:
    labels = {"action": "walk", "direction": "forward", "speed": "normal"}
    walk = generate_clip(spec_for(labels, 3), 3)
    aside = encode_features(walk)
    ahead, angle = aside[:, ROOT_ROW, FORWARD].clone(), np.radians(25.0)
    aside[:, ROOT_ROW, LATERAL], aside[:, ROOT_ROW, FORWARD] = (
        ahead * np.sin(angle), ahead * np.cos(angle)
    )  # fmt: skip
    before = decode_features(aside)
    motion = load("walk_clips").faced(before, float(angle))
    root = encode_features(motion)[:-1, ROOT_ROW]
    assert abs(float(root[:, LATERAL].mean())) < 0.02 * float(root[:, FORWARD].mean())
    balls = [JOINT_INDEX[name] for name in ("l_foot", "r_foot")]
    off = (motion.positions() - before.positions())[:, balls]
    assert np.ptp(off, axis=0).max() < 2e-3 and np.abs(off).max() < 0.06
