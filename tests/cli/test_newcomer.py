"""A newcomer's first hour: five clips and three songs, by the commands that the quickstart prints.

A minimum of material and of training, so what comes out is judged by whether it moves: a frozen
pose or a path that stays where it is fails.
"""

import os
import re
import resource
import shlex
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.data.synthetic.clips import generate_clip, spec_for
from src.shared.formats.arrays import read_npz, read_trajectory_npz
from src.shared.formats.writers.bvh import write_bvh

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "quickstart.md"
CLIPS = {
    "a person walks forward": {"action": "walk", "direction": "forward", "speed": "normal"},
    "a person walks backward": {"action": "walk", "direction": "backward", "speed": "normal"},
    "a person walks in a circle to the left": {
        "action": "walk", "direction": "forward", "turn": "left", "speed": "normal",
    },
    "a person runs": {"action": "run", "direction": "forward", "speed": "fast"},
    "a person waves with the right hand": {"action": "wave", "side": "right", "speed": "normal"},
}  # fmt: skip
TEMPI = (95.0, 125.0, 147.0)
MINUTES = 15.0


def printed_commands() -> list[str]:
    """The lines that the section prints, as a reader would copy them."""
    section = PAGE.read_text(encoding="utf-8").partition("### Five clips and three songs")[2]
    block = re.search(r"```\n(.*?)```", section, re.DOTALL)
    assert block, "the section has its commands"
    return re.sub(r"\\\n\s*", " ", block[1]).splitlines()


def run(line: str, folder: Path) -> None:
    """A printed command in a folder of the newcomer's, by this interpreter."""
    program, *arguments = shlex.split(line)
    assert program == "motion-tools"
    done = subprocess.run(
        [sys.executable, "-m", "src.cli.tools", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, f"{line}\n{done.stderr[-3000:]}"


def write_material(folder: Path) -> None:
    """`my-mocap` with its captions, `my-songs`."""
    mocap, songs = folder / "my-mocap", folder / "my-songs"
    mocap.mkdir()
    songs.mkdir()
    rows = ["clip,caption"]
    for number, (caption, labels) in enumerate(CLIPS.items()):
        write_bvh(generate_clip(spec_for(labels, seed=number), seed=number),
                  mocap / f"take_{number}.bvh")  # fmt: skip
        rows.append(f"take_{number},{caption}")
    (mocap / "captions.csv").write_text("\n".join(rows), encoding="utf-8")
    for name, tempo in zip(("song", "song-2", "song-3"), TEMPI, strict=True):
        render_song(SongSpec(seconds=60.0, tempo=tempo)).write_wav(songs / f"{name}.wav")


@pytest.mark.slow
def test_five_clips_and_three_songs_become_models_that_move(tmp_path: Path) -> None:
    write_material(tmp_path)
    started = time.perf_counter()
    for line in printed_commands():
        before = time.perf_counter()
        run(line, tmp_path)
        print(f"{time.perf_counter() - before:6.1f} s  {line}")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cores = (used.ru_utime + used.ru_stime) / 60
    print(f"{(time.perf_counter() - started) / 60:.1f} minutes, {cores:.1f} of one core's")
    assert cores < 2 * MINUTES, "of two cores, whoever else has them"

    (walk,) = (tmp_path / "outputs").glob("*a-person-walks-forward.npz")
    motion = read_npz(walk)
    travelled = motion.root_position[-1] - motion.root_position[0]
    assert np.linalg.norm(travelled[[0, 2]]) > 1.0, "a walk goes somewhere"
    limbs = motion.positions() - motion.root_position[:, None]
    assert np.ptp(limbs, axis=0).max() > 0.2, "and swings its limbs"

    path = read_trajectory_npz(tmp_path / "outputs" / "song.npz").position
    steps = np.linalg.norm(np.diff(path[:, [0, 2]], axis=0), axis=1)
    assert steps.sum() > 1.0, "a dance goes somewhere"
    assert (steps > 0.001).mean() > 0.5, "most of the time"
