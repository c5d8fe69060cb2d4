"""Where sentences go that a trained denoiser has no place for: plain words, and new actions.

A denoiser that learned plain captions mostly from procedural clips gives procedural motion for
them, and captured motion for one word of style. Among the styles that captured clips show of a
combination, the one nearest to its unstyled captured clips (or, without such, to the middle of all
styles) is nearest to no style at all. An action that it never learned would share the places of
those whose captions sound alike: it gets a direction of its own.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Sequence

import torch
from torch import Tensor
from torch.nn.functional import normalize

from ..shared.data.captions.language import spoken_labels
from ..shared.data.captions.schema import Labels
from ..shared.data.prepared import PreparedData, group_of
from .task import generator

Combination = tuple[tuple[str, str], ...]


def with_unstyled(labels: dict[str, Labels]) -> dict[str, Labels]:
    """`labels` of each group, and the unstyled combination of each that is only there in styles."""
    known = {_combination(each) for each in labels.values() if "style" not in each}
    found = dict(labels)
    for each in labels.values():
        if "style" in each and _combination(each) not in known:
            plain = {key: value for key, value in each.items() if key != "style"}
            found.setdefault(group_of(plain), plain)
    return found


def with_sentences(labels: dict[str, Labels], combinations: Iterable[Labels]) -> dict[str, Labels]:
    """`labels` of each group, and those `combinations` of known actions and values that no clip
    shows: who has seen walks, and happy runs, has a place for a happy walk."""
    known = {pair for each in labels.values() for pair in each.items()}
    spoken = [spoken_labels(each) for each in labels.values()]
    new = (each for each in combinations if each not in spoken and known >= each.items())
    return labels | {group_of(each): each for each in new}


def nearest_styles(data: PreparedData, labels: dict[str, Labels]) -> dict[str, str]:
    """For each unstyled group of `labels` that captured clips show in styles: such a group.

    It is that of the same combination in the style nearest to none, by means and spreads over time
    of the z-scored features.
    """
    shown: dict[str, list[Tensor]] = defaultdict(list)  # captured clips
    for record in data.records("train"):
        if record.group in labels and record.provenance == "captured":
            values = ((data.features(record) - data.mean) / data.std).flatten(1)  # [T,138]
            shown[record.group].append(torch.cat((values.mean(0), values.std(0))))
    means = {group: torch.stack(clips).mean(0) for group, clips in shown.items()}
    styled: dict[Combination, list[str]] = defaultdict(list)
    plain: dict[Combination, Tensor] = {}
    for group, mean in means.items():
        key = _combination(labels[group])
        if "style" in labels[group]:
            styled[key].append(group)
        else:
            plain[key] = mean
    found = {}
    for group, of_group in labels.items():
        if "style" in of_group or not (groups := styled.get(key := _combination(of_group))):
            continue
        target = plain.get(key, torch.stack([means[each] for each in groups]).mean(0))
        found[group] = min(groups, key=lambda each: float((means[each] - target).norm()))
    return found


def fuller_sides(data: PreparedData, labels: dict[str, Labels]) -> dict[str, str]:
    """For each group of `labels` that names no side and that few takes show: the group of the same
    combination on the right, if more takes show that one.

    One take of kicks with whatever foot was captured, and a denoiser kicks once in eight samples
    for it; with a foot that is named it kicks nearly always.
    """
    takes: dict[str, set[str]] = defaultdict(set)
    for record in data.records("train"):
        takes[record.group].add(record.take)
    rights = {
        _combination(each): group for group, each in labels.items() if each.get("side") == "right"
    }
    found = {}
    for group, each in labels.items():
        right = rights.get(_combination({**each, "side": "right"}))
        if right is None or "style" in each or "side" in each:
            continue
        if 0 < len(takes[group]) < len(takes[right]):
            found[group] = right
    return found


def apart(
    places: Tensor, labels: Sequence[Labels], known: Collection[str], *, kept: float = 1.0
) -> Tensor:
    """Unit places [G,D] where each action outside `known` has moved in a direction of its own.

    Args:
        kept: how much of where its places lay together stays in them, 0 to 1.
    """
    moved = places.clone()
    for action in sorted({each["action"] for each in labels if "action" in each} - set(known)):
        rows = [index for index, each in enumerate(labels) if each.get("action") == action]
        way = torch.randn(places.shape[1], generator=generator("place", action))
        left = places[rows] - (1 - kept) * places[rows].mean(0)
        moved[rows] = normalize(left + normalize(way, dim=0), dim=-1)
    return moved


def _combination(labels: Labels) -> Combination:
    return tuple(sorted((k, v) for k, v in spoken_labels(labels).items() if k != "style"))
