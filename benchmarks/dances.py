"""Is it a dance? Stage, poses, hovering, sliding, beats and seams, a row a sentence.

python -m benchmarks.dances SONG [SONG ...] [--seconds 30] [--seeds 4] [--sentence TEXT ...]

The rows of docs/experiments.md, section 57: `MotionGenerator.dance` of the shipped models, a mean
over songs and seeds. *F* is of the body's beats and the song's; *by chance* of another song's.
*seam*: 99th percentile of the largest acceleration of a joint within .27 s of where one figure
follows another. *turned over*: joints, the pelvis apart, that turn by more than 50 degrees in a
frame, a dance.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from src.shared.audio.song import Song, analyse
from src.shared.metrics.rhythm import body_beats, rhythm_f
from src.shared.metrics.seams import ACCELERATION, body_quantities
from src.shared.metrics.stage import stage
from src.shared.model.diffusion import Sampling
from src.shared.pipelines.body import Performance
from src.shared.pipelines.motion_generator import MotionGenerator

SENTENCES = (
    "a person dances", "a happy person dances", "a calm person dances", "a person dances salsa",
    "a person breakdances", "a person dances an Indian dance", "a person dances ballet",
    "a person dances like Michael Jackson", "a person dances a waltz", "an old man dances",
    "a sad person dances",
)  # fmt: skip
NEAR_SEAM = 8  # frames
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
    heard, strange = (
        rhythm_f(own, beats[beats < motion.seconds], motion.seconds)
        for beats in (song.beats.beat_times, other.beats.beat_times)
    )
    return stage(motion) | {
        "F": heard,
        "by chance": strange,
        "seam": float(np.percentile(strongest[near], 99)) if near.any() else np.nan,
        "turned over": float((np.abs((q[1:] * q[:-1]).sum(-1)) < TURNED).sum()),
    }


def main(arguments: Sequence[str] | None = None) -> None:
    """A line a sentence, as its dances are done."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("songs", type=Path, nargs="+")
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--sentence", action="append")
    given = parser.parse_args(arguments)
    generator, songs = MotionGenerator(), [analyse(path) for path in given.songs]
    for sentence in given.sentence or SENTENCES:
        rows = []
        for number, song in enumerate(songs):
            for seed in range(given.seeds):
                asked = generator.dance(
                    song, sentence, seconds=given.seconds, sampling=Sampling(seed=seed)
                )
                rows.append(figures(asked.ranked[0], song, songs[number - 1]))
        means = {key: np.nanmean([row[key] for row in rows]) for key in rows[0]}
        print(f"{sentence} ({len(rows)})", *(f"{key} {value:.2f}" for key, value in means.items()),
              sep="  ", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
