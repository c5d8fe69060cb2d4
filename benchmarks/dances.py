"""Is it a dance? Stage, poses, hovering, sliding, beats and seams, a row a sentence.

python -m benchmarks.dances SONG [SONG ...] [--seconds 30] [--seeds 4] [--sentence TEXT ...]

A SONG is a file, or `synthetic` (20 made songs), `threes` (4 by another hand, three beats in a bar)
or `slow` (4 of 52 to 68 beats a minute).

The rows of docs/experiments.md, section 57: `MotionGenerator.dance` of the shipped models, a mean
over songs and seeds. *F* is of the body's beats and the song's; *by chance* of another song's.
*seam*: 99th percentile of the largest acceleration of a joint within .27 s of where one figure
follows another; *both feet*: share of those frames in which both move faster than .1 m/s, and of
all others. *turned over*: joints, the pelvis apart, that turn by more than 50 degrees in a
frame, a dance. *frozen pose*: the first pose of each dance, all along.
"""

import argparse
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain, count, islice
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import soundfile

from src.shared.audio.song import Song, analyse
from src.shared.audio.synthetic import SongSpec, render_song, sample_song_specs
from src.shared.metrics.rhythm import body_beats, rhythm_f
from src.shared.metrics.seams import ACCELERATION, body_quantities
from src.shared.metrics.stage import stage
from src.shared.model.diffusion import Sampling
from src.shared.motion.skeleton import JOINT_INDEX
from src.shared.pipelines.body import Performance
from src.shared.pipelines.motion_generator import MotionGenerator
from tests.shared.audio.other_songs import pattern

SENTENCES = (
    "a person dances", "a happy person dances", "a calm person dances", "a person dances salsa",
    "a person breakdances", "a person dances an Indian dance", "a person dances ballet",
    "a person dances like Michael Jackson", "a person dances a waltz", "an old man dances",
    "a sad person dances", "a proud person dances", "a tired person dances",
)  # fmt: skip
MADE, SLOW, SAMPLE_RATE = ("synthetic", "threes", "slow"), (52.0, 58.0, 63.0, 68.0), 44_100
NEAR_SEAM, MOVES = 8, 0.1  # frames, m/s
FEET = [JOINT_INDEX["l_foot"], JOINT_INDEX["r_foot"]]
TURNED = np.cos(np.radians(50) / 2)


def figures(dance: Performance, song: Song, other: Song) -> dict[str, float]:
    """Of one dance to a song; `other` has the beats of chance."""
    motion, own = dance.motion, body_beats(dance.motion)
    strongest = body_quantities(motion)[ACCELERATION]
    near = np.zeros(motion.num_frames, dtype=bool)
    for figure in dance.figures[1:]:
        at = int(figure.times[0] * motion.fps)
        near[max(at - NEAR_SEAM, 0) : at + NEAR_SEAM + 1] = True
    q = motion.quaternions[:, 1:]
    steps = np.diff(motion.positions()[:, FEET], axis=0, prepend=np.nan)
    both = np.linalg.norm(steps, axis=-1).min(1) * motion.fps > MOVES
    heard, strange = (
        rhythm_f(own, beats[beats < motion.seconds], motion.seconds)
        for beats in (song.beats.beat_times, other.beats.beat_times)
    )
    return stage(motion) | {
        "F": heard,
        "by chance": strange,
        "seam": float(np.percentile(strongest[near], 99)) if near.any() else np.nan,
        "both feet": float(both[near].mean()) if near.any() else np.nan,
        "elsewhere": float(both[~near].mean()),
        "turned over": float((np.abs((q[1:] * q[:-1]).sum(-1)) < TURNED).sum()),
    }


def standing(dance: Performance) -> Performance:
    """The first pose of a dance, all along."""
    motion = dance.motion
    frozen = replace(
        motion,
        quaternions=np.repeat(motion.quaternions[:1], motion.num_frames, 0),
        root_position=np.repeat(motion.root_position[:1], motion.num_frames, 0),
    )
    return replace(dance, motion=frozen)


def told(name: str, rows: Sequence[dict[str, float]]) -> None:
    """A line of the means."""
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    means = {key: column[np.isfinite(column)].mean() for key, column in columns.items()
             if np.isfinite(column).any()}  # fmt: skip
    furthest = f"(radius at most {np.nanmax(columns['radius']):.2f})"
    print(f"{name} ({len(rows)})", *(f"{key} {value:.2f}" for key, value in means.items()),
          furthest, sep="  ", flush=True)  # fmt: skip


def made(kind: str, folder: Path) -> list[Path]:
    """Files of the songs that are made, in their order."""
    if kind == "threes":
        several = (pattern(seed, seconds=30.0) for seed in count(2000))
        three = [song.samples for song in islice((s for s in several if s.meter == 3), 4)]
        files = [folder / f"{kind}{number:02}.wav" for number in range(len(three))]
        for file, samples in zip(files, three, strict=True):
            soundfile.write(file, samples, SAMPLE_RATE)
        return files
    specs = [SongSpec(seconds=30.0, tempo=t, seed=500 + i) for i, t in enumerate(SLOW)]
    if kind == "synthetic":
        specs = sample_song_specs(20, 77, "held-out")
    files = [folder / f"{kind}{number:02}.wav" for number in range(len(specs))]
    for file, spec in zip(files, specs, strict=True):
        render_song(spec).write_wav(file)
    return files


def main(arguments: Sequence[str] | None = None) -> None:
    """A line a sentence, as its dances are done."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("songs", nargs="+")
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--sentence", action="append")
    given = parser.parse_args(arguments)
    with TemporaryDirectory() as folder:
        files = [made(name, Path(folder)) if name in MADE else [Path(name)] for name in given.songs]
        songs = [analyse(path) for path in chain.from_iterable(files)]
    generator = MotionGenerator()
    still: list[dict[str, float]] = []
    for sentence in given.sentence or SENTENCES:
        rows = []
        for number, song in enumerate(songs):
            for seed in range(given.seeds):
                asked = generator.dance(
                    song, sentence, seconds=given.seconds, sampling=Sampling(seed=seed)
                )
                rows.append(figures(asked.ranked[0], song, songs[number - 1]))
                still.append(figures(standing(asked.ranked[0]), song, songs[number - 1]))
        told(sentence, rows)
    told("frozen pose", still)


if __name__ == "__main__":
    main()
