"""Which captured style stands for no style: plain words may ask for its motion.

A denoiser that learned plain captions mostly from procedural clips gives procedural motion for
them, and captured motion for one word of style. Among the styles that captured clips show of a
combination, the one nearest to its unstyled captured clips (or, without such, to the middle of all
styles) is nearest to no style at all.
"""

from collections import defaultdict
from collections.abc import Sequence

import torch
from torch import Tensor

from src.shared.data.caption_language import Labels, told
from src.shared.data.prepared import PreparedData

Combination = tuple[tuple[str, str], ...]


def nearest_styles(data: PreparedData, groups: Sequence[str]) -> dict[int, int]:
    """For each unstyled combination of `groups` that captured clips show in styles: both indices.

    The second is that of the same combination in the style nearest to none, by means and spreads
    over time of the z-scored features.
    """
    index = {group: row for row, group in enumerate(groups)}
    shown: dict[int, list[Tensor]] = defaultdict(list)  # captured clips
    labels: dict[int, Labels] = {}
    for record in data.records("train"):
        if record.group not in index:
            continue
        labels[index[record.group]] = record.labels
        if record.provenance == "captured":
            values = ((data.features(record) - data.mean) / data.std).flatten(1)  # [T,138]
            shown[index[record.group]].append(torch.cat((values.mean(0), values.std(0))))
    means = {row: torch.stack(clips).mean(0) for row, clips in shown.items()}
    styled: dict[Combination, list[int]] = defaultdict(list)
    plain: dict[Combination, Tensor] = {}
    for row, mean in means.items():
        key = _combination(labels[row])
        if "style" in labels[row]:
            styled[key].append(row)
        else:
            plain[key] = mean
    found = {}
    for row, of_row in labels.items():
        if "style" in of_row or not (rows := styled.get(key := _combination(of_row))):
            continue
        target = plain.get(key, torch.stack([means[each] for each in rows]).mean(0))
        found[row] = min(rows, key=lambda each: float((means[each] - target).norm()))
    return found


def _combination(labels: Labels) -> Combination:
    return tuple(sorted((k, v) for k, v in told(labels).items() if k != "style"))
