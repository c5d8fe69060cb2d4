"""Is what a memory finds for songs it does not hold nearer than any phrase of it?

python -m benchmarks.memory_hits --memory MEMORY --asked MEMORY_OF_TEST [--top-k 8] [--json OUT]

Both are made by `memory build`, one with `--split test`. Each phrase of the second asks the first
with its sound; the hits are held against the motion it was really danced with: share of hits
within 6% of its tempo, difference of their mean energy, cosine of their motion keys. Beside each:
the same of all phrases of the memory, which is what chance gives. Intervals resample songs.

Letters: N phrases of the memory, M that ask, k hits, S songs that ask.
"""

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import torch

from src.shared.evaluation.stats import bootstrap_mean, paired_bootstrap
from src.shared.memory.index import MemoryIndex
from src.shared.memory.priors import ENERGY

NEAR = 0.06  # of a tempo
COLUMNS = {
    "tempo": "hits within 6% of the tempo",
    "energy": "difference in energy",
    "motion": "cosine to the real motion",
}


def agreement(memory: MemoryIndex, asked: MemoryIndex) -> dict[str, np.ndarray]:
    """How each phrase of the memory agrees with each that asks, by column [M,N]."""
    tempo = (memory.tempo[None] / asked.tempo[:, None] - 1).abs() < NEAR
    energy = (energies(memory)[None] - energies(asked)[:, None]).abs()
    motion = asked.motion_keys @ memory.motion_keys.T
    named = {"tempo": tempo.float(), "energy": energy, "motion": motion}
    return {name: values.numpy() for name, values in named.items()}


def energies(memory: MemoryIndex) -> torch.Tensor:
    """Mean energy of each phrase [N]."""
    return torch.tensor([float(memory.prior(n)[ENERGY].mean()) for n in range(len(memory))])


def by_song(values: np.ndarray, asked: MemoryIndex) -> np.ndarray:
    """Means over the phrases of each song: [M] → [S]."""
    songs = asked.song.numpy()
    return np.array([values[songs == song].mean() for song in np.unique(songs)])


def compare(memory: MemoryIndex, asked: MemoryIndex, top_k: int) -> list[dict[str, Any]]:
    """A row a column: found, chance, and their difference, each with its interval."""
    excluded = [{asked.song_of(n)} for n in range(len(asked))]
    hits = memory.search(
        asked.audio_keys, top_k=top_k, phase=asked.start_phase, exclude_songs=excluded
    )
    rows = []
    for name, values in agreement(memory, asked).items():
        found = np.take_along_axis(values, hits.index.numpy(), 1).mean(1)
        mine, chance = by_song(found, asked), by_song(values.mean(1), asked)
        rows.append(
            {
                "measure": COLUMNS[name],
                "found": asdict(bootstrap_mean(mine.tolist())),
                "chance": asdict(bootstrap_mean(chance.tolist())),
                "difference": asdict(paired_bootstrap(chance, mine)),
            }
        )
    return rows


def told(estimate: dict[str, float]) -> str:
    """A value and its interval."""
    return f"{estimate['value']:.3f} [{estimate['low']:.3f}, {estimate['high']:.3f}]"


def main() -> None:
    """Ask, and print a line a measure."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--memory", type=Path, required=True)
    parser.add_argument("--asked", type=Path, required=True)
    parser.add_argument("--top-k", type=int, default=8)
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    memory, asked = MemoryIndex.open(given.memory), MemoryIndex.open(given.asked)
    if memory.about["space"] != asked.about["space"]:
        raise SystemExit("the two memories were made with different spaces; build one again")
    rows = compare(memory, asked, given.top_k)
    print(f"{len(asked)} phrases of {len(asked.songs)} songs ask {len(memory)}")
    for row in rows:
        print(
            f"{row['measure']:<28} {told(row['found'])}  chance {told(row['chance'])}"
            f"  difference {told(row['difference'])}"
        )
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
