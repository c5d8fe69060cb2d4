"""Does the prompt change the dance? The same path and song danced to different prompts.

The separate evaluator looks at the bodies: how far apart are dances of different prompts, against
dances of one prompt with other noise, and does it find each dance's prompt among those used?

Letters: S songs, P prompts, W windows of a dance, D channels of the judge.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.spatial.distance import cdist, pdist

from ..metrics.rhythm import body_beats, limb_beats, rhythm
from ..motion.features import encode_features
from ..motion.motion import Motion
from ..motion.trajectory import to_motion
from ..pipelines.body import Performer
from .dance_context import DanceContext, held_still
from .judge.evaluator import Evaluator
from .report.tables import Column, Grid, GridRow
from .stats import bootstrap_mean

ASKED = (
    "a person dances", "a proud person dances", "an old man dances", "a tired person dances",
    "a person walks happily", "a person runs", "a person waves with the right hand",
    "a person claps",
)  # fmt: skip
WINDOW = 120  # frames that the judge sees at once: it learned from clips of so many
NOISES = 2  # dances of each prompt
COLUMNS = (
    Column("apart", "other prompt", better="high"), Column("same", "other noise"),
    Column("gain", "difference", better="high"), Column("r_at_1", "R@1", better="high"),
    Column("r_at_3", "R@3", better="high"), Column("f", "beat F", better="high"),
    Column("limbs_f", "limbs F", better="high"),
)  # fmt: skip
NOTE = (
    "The path of each song stays the same; only words and noise change. *other prompt*: mean"
    " distance of the judge's embeddings of dances of two prompts with one noise; *other noise*: of"
    " one prompt with two noises; *difference*: song by song. *R@k*: the dance's prompt is among"
    " the k nearest of the prompts used; chance is k over their number. *words alone*: the same"
    " prompts without a song, which is how far the words go; its beat F is chance. Intervals over"
    " songs."
)
Dancer = Callable[[int, str, int], Motion]  # song, prompt and noise to a dance


@dataclass(frozen=True, eq=False)
class Danced:
    """Embeddings [S,P,NOISES,W,D] of dances and what their beats score [S,P·NOISES]."""

    embeddings: np.ndarray
    f: np.ndarray
    limbs_f: np.ndarray


def prompt_effect(context: DanceContext) -> list[Grid]:
    """The table; nothing without songs to measure on."""
    songs = list(range(context.num_tracks, len(context.pieces)))[: context.settings.style_songs]
    if not songs:
        return []
    text = context.judge.embed_text(ASKED).numpy()
    rows = {}
    for name, dancer in dancers(context).items():
        context.progress(f"prompts: {name}")
        danced = dance_all(context, dancer, songs)
        rows[name] = GridRow(effect(danced, text), danced.f.size, 1)
    title = f"what the prompt changes ({len(songs)} songs, {len(ASKED)} prompts, {NOISES} noises)"
    prompts = "; ".join(ASKED)
    return [Grid("prompts", title, COLUMNS, rows, f"{NOTE} Prompts: {prompts}.")]


def dancers(context: DanceContext) -> dict[str, Dancer]:
    """Who dances, by the name of the row."""

    def by(performer: Performer) -> Dancer:
        return lambda song, prompt, noise: (
            context.perform(performer, song, 0, prompt, seed=noise).motion
        )

    def alone(song: int, prompt: str, noise: int) -> Motion:
        seconds = context.path(song, 0).seconds
        (motion,) = context.generator.generate([prompt], seconds=seconds, seed=noise)
        return motion

    own = cache(by(context.performer(context.generator)))
    found: dict[str, Dancer] = {
        "generated": own,
        "words alone": alone,
        "path alone": lambda song, prompt, noise: to_motion(context.path(song, 0)),
        "frozen pose": lambda song, prompt, noise: held_still(own(song, ASKED[0], noise)),
    }
    if context.settings.untrained:
        found["untrained"] = by(context.performer(context.fresh))
    return found


def dance_all(context: DanceContext, dancer: Dancer, songs: Sequence[int]) -> Danced:
    """Every song to every prompt with every noise."""
    embeddings, scores, limbs = [], [], []
    for song in songs:
        beats = context.pieces[song].beats
        for prompt in ASKED:
            for noise in range(NOISES):
                motion = dancer(song, prompt, noise)
                embeddings.append(embed(context.judge, motion))
                scores.append(rhythm(body_beats(motion), beats, motion.seconds).f)
                limbs.append(rhythm(limb_beats(motion), beats, motion.seconds).f)
    shape = (len(songs), len(ASKED), NOISES)
    stacked = np.stack(embeddings).reshape(*shape, *embeddings[0].shape)
    flat = (len(songs), -1)
    return Danced(stacked, np.reshape(scores, flat), np.reshape(limbs, flat))


def embed(judge: Evaluator, motion: Motion) -> np.ndarray:
    """The judge's embeddings [W,D] of the windows of a motion; the last, shorter one is left out
    unless it is the only one."""
    features = encode_features(motion)
    whole = max(1, len(features) // WINDOW)
    return judge.embed_features(
        [features[k * WINDOW : (k + 1) * WINDOW] for k in range(whole)]
    ).numpy()


def effect(danced: Danced, text: np.ndarray) -> dict[str, dict[str, float | int]]:
    """The cells of a row: means over songs with their intervals.

    Args:
        danced: see there.
        text: the judge's embeddings of the prompts [P,D].
    """
    apart, same, first, third = [], [], [], []
    for song in danced.embeddings.astype(np.float64):  # P NOISES W D
        prompts, noises, windows, _ = song.shape
        apart.append(np.mean([pdist(song[:, n, w]) for n in range(noises) for w in range(windows)]))
        same.append(np.mean([pdist(song[p, :, w]) for p in range(prompts) for w in range(windows)]))
        ranks = [
            rank_of(cdist(song[p].reshape(noises * windows, -1), text), p) for p in range(prompts)
        ]
        places = np.concatenate(ranks)
        first.append((places < 1).mean())
        third.append((places < 3).mean())
    gain = [a - s for a, s in zip(apart, same, strict=True)]
    columns = {
        "apart": apart, "same": same, "gain": gain, "r_at_1": first, "r_at_3": third,
        "f": danced.f.mean(1), "limbs_f": danced.limbs_f.mean(1),
    }  # fmt: skip
    return {key: bootstrap_mean(list(values)).as_dict() for key, values in columns.items()}


def rank_of(distances: np.ndarray, column: int) -> np.ndarray:
    """How many columns [N] of distances [N,P] are nearer than this one; ties count half."""
    own = distances[:, column : column + 1]
    nearer = (distances < own).sum(1)
    return np.asarray(nearer + ((distances == own).sum(1) - 1) / 2)
