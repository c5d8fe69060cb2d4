"""Would another confidence tell what a memory can know from what it cannot?

python -m benchmarks.memory_confidence --memory MEMORY --asked MEMORY_OF_TEST [--seed 0]

Both are made by `memory build`, one with `--split test`. Its phrases ask with their sound, and so
do sounds of which the memory knows nothing: noise, bursts of noise, silence, a tone, and synthetic
songs slower and faster than any of it. Printed for each definition: its 5th, 50th and 95th
percentile, and the chance that a phrase of a test song gets more than a foreign sound (0.5 = it
tells nothing). `right`: its correlation with the share of hits within 6% of the tempo.

Letters: N phrases of the memory, M that ask, D width of the space, k hits.
"""

import argparse
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from src.shared.audio.song import analyse_sound
from src.shared.audio.sound import sound_from_samples
from src.shared.audio.synthetic import SongSpec, render_song
from src.shared.config_audio import MemoryConfig
from src.shared.memory.build import cut_at_bars
from src.shared.memory.index import MemoryIndex
from src.shared.memory.query import BEATLESS, retrieve
from src.shared.model.audio.shared_space import SharedSpace
from src.shared.motion.trajectory import FPS
from src.shared.pipelines.song import song_condition
from src.shared.pipelines.song_memory import open_memory

RATE, SECONDS = 44100, 10
SLOW, FAST = (45, 55, 60, 65), (185, 200, 220)  # BPM; the memory's songs have 70 to 180
NEAR = 0.06  # of a tempo
AXES = 64  # principal ones that the distance is taken in
Measure = Callable[[Tensor], Tensor]


def foreign_sounds(seed: int) -> Iterator[tuple[str, np.ndarray]]:
    """Name and samples of sounds that no dancer danced to."""
    rng, length = np.random.default_rng(seed), RATE * SECONDS
    frequency = np.fft.rfftfreq(length)
    frequency[0] = frequency[1]
    for tilt in (0.0, 0.5, 1.0):  # white, pink, brown
        spectrum = np.fft.rfft(rng.standard_normal(length)) / frequency**tilt
        noise = np.fft.irfft(spectrum, length)
        yield "noise", 0.5 * noise / np.abs(noise).max()
        at = np.sort(rng.integers(0, length, 6 * SECONDS))
        bursts = noise * np.interp(np.arange(length), at, rng.random(len(at)))
        yield "bursts of noise", 0.5 * bursts / np.abs(bursts).max()
    yield "silence", np.zeros(length)
    yield "tone", 0.3 * np.sin(2 * np.pi * 440 * np.arange(length) / RATE)
    for tempo in (*SLOW, *FAST):
        spec = SongSpec(seconds=float(SECONDS), seed=tempo, tempo=float(tempo))
        yield "another tempo", render_song(spec).samples


@torch.no_grad()
def embedded(space: SharedSpace, samples: np.ndarray) -> Tensor:
    """Keys [M,D] of a sound, cut as `memory query` cuts it."""
    condition, phase = song_condition(analyse_sound(sound_from_samples(samples, RATE)), None)
    bars = np.arange(condition.shape[1]) / (BEATLESS * FPS) if phase is None else phase
    cuts = cut_at_bars(bars, step=1)
    return torch.cat([space.embed_audio(condition[None, :, a:b]) for a, b in cuts])


# ---------------------------------------------------------------- definitions


def margin(index: MemoryIndex, query: Tensor) -> Tensor:
    """What `retrieve` says [M]."""
    return retrieve(index, query, num_frames=1).confidence


def best(similarity: Tensor) -> Tensor:
    """Weighted similarity [M] of the hits of [M,N]."""
    config = MemoryConfig()
    found = similarity.topk(config.top_k).values
    return (torch.softmax(found / config.temperature, 1) * found).sum(1)


def quantiles(index: MemoryIndex) -> Measure:
    """Where the best similarity stands among those of the memory's own phrases, which ask without
    their own song."""
    keys = index.audio_keys
    same = index.song[:, None] == index.song[None]
    own = best((keys @ keys.T).masked_fill(same, -2)).sort().values
    return lambda query: torch.searchsorted(own, best(query @ keys.T)) / len(own)


def nearness(index: MemoryIndex) -> Measure:
    """Less the Mahalanobis distance to the memory's keys, in `AXES` principal axes."""
    mean = index.audio_keys.mean(0)
    _, spread, axes = torch.linalg.svd(index.audio_keys - mean, full_matrices=False)
    whiten = axes[:AXES].T / (spread[:AXES] / len(index) ** 0.5)
    return lambda query: -((query - mean) @ whiten).norm(dim=1)


# ---------------------------------------------------------------- figures


def above(one: Tensor, other: Tensor) -> float:
    """Chance that a value of one is above one of the other; ties count half."""
    first, second = one[:, None], other[None]
    return float((first > second).float().mean() + 0.5 * (first == second).float().mean())


def rightness(index: MemoryIndex, asked: MemoryIndex) -> Tensor:
    """Share [M] of hits within `NEAR` of the tempo of the song that asks."""
    hits = index.search(asked.audio_keys, top_k=MemoryConfig().top_k).index
    return ((index.tempo[hits] / asked.tempo[:, None] - 1).abs() < NEAR).float().mean(1)


def main() -> None:
    """Ask, and print a line a definition and sound."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--memory", type=Path, required=True)
    parser.add_argument("--asked", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    torch.set_num_threads(1)
    index, space = open_memory(given.memory)
    asked = MemoryIndex.open(given.asked)
    groups: dict[str, list[Tensor]] = {}
    for name, samples in foreign_sounds(given.seed):
        groups.setdefault(name, []).append(embedded(space, samples))
    right = rightness(index, asked)
    definitions: dict[str, Measure] = {
        "margin (shipped)": partial(margin, index),
        "quantile": quantiles(index),
        "nearness": nearness(index),
    }
    print(f"{len(asked)} phrases of {len(asked.songs)} songs ask {len(index)}; seed {given.seed}")
    for name, measure in definitions.items():
        own = measure(asked.audio_keys)
        correlation = np.corrcoef(own, right)[0, 1]
        print(f"{name:<17} {'test songs':<16} {spread(own)}  right {correlation:.2f}")
        for sound, keys in groups.items():
            values = measure(torch.cat(keys))
            print(
                f"{name:<17} {sound:<16} {spread(values)}  test above {above(own, values):.2f}"
                f"  (M {len(values)})"
            )


def spread(values: Tensor) -> str:
    """5th, 50th and 95th percentile."""
    return " ".join(f"{float(values.quantile(q)):6.2f}" for q in (0.05, 0.5, 0.95))


if __name__ == "__main__":
    main()
