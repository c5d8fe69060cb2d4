"""Train, validation and test: by take, and by whole label combination, never by window."""

import hashlib
import re
from collections import defaultdict
from collections.abc import Sequence

from .captions.language import mirror_labels
from .captions.schema import Labels

VAL_FRACTION = 0.04
TEST_FRACTION = 0.10
UNSEEN_FRACTION = 0.08
MIN_SUPPORT = 0.5  # share of a label's combinations that stays in training
MIN_TAKES = 5  # a combination with fewer takes keeps them all for training


def group_of(labels: Labels, caption: str = "") -> str:
    """Name of the whole label combination: the unit of splits and of positive pairs.

    A clip without labels is named by its caption.
    """
    if not labels:
        return f"caption={' '.join(caption.lower().split())}"
    return "|".join(f"{key}={labels[key]}" for key in sorted(labels))


def _order(seed: int, text: str) -> str:
    """A stable pseudo-random key: does not change when other clips come or go."""
    return hashlib.sha256(f"{seed}:{text}".encode()).hexdigest()


def orbit(labels: Labels, caption: str) -> str:
    """The combination and its mirror image under one name: both are held back or neither."""
    if not labels:
        return re.sub(r"\b(left|right)\b", "left/right", group_of({}, caption))
    return min(group_of(labels), group_of(mirror_labels(labels)))


def unseen_orbits(clips: Sequence[tuple[str, Labels]], seed: int) -> set[str]:
    """Combinations to hold back whole, chosen so that each of their labels is seen elsewhere.

    Only combinations of three labels or more qualify, and none that another one extends: the
    plain "walk forward, turning left" must be learned, "…, tired" can be composed.

    Args:
        clips: (orbit, labels) of every clip.
    """
    labels_of = dict(clips)
    support: dict[tuple[str, str, str], set[str]] = defaultdict(set)
    for name, labels in labels_of.items():
        for key, value in labels.items():
            if key != "action":
                support[labels.get("action", ""), key, value].add(name)
    eligible = [
        name
        for name, labels in labels_of.items()
        if len(labels) >= 3
        and not any(labels.items() < other.items() for other in labels_of.values())
        and all(
            len(support[labels.get("action", ""), key, value]) >= 2
            for key, value in labels.items()
            if key != "action"
        )
    ]
    chosen: set[str] = set()
    for name in sorted(eligible, key=lambda name: _order(seed, name)):
        if len(chosen) >= round(UNSEEN_FRACTION * len(labels_of)):
            break
        labels = labels_of[name]
        keys = [(labels.get("action", ""), k, v) for k, v in labels.items() if k != "action"]
        left = [(len(support[key] - chosen - {name}), len(support[key])) for key in keys]
        if all(stays >= max(1, MIN_SUPPORT * of) for stays, of in left):
            chosen.add(name)
    return chosen


def assign_splits(clips: Sequence[tuple[str, str, Labels]], seed: int) -> dict[str, str]:
    """Split of each take.

    Args:
        clips: (take, orbit, labels) of every clip.
        seed: another seed holds back other takes.
    """
    held_back = unseen_orbits([(name, labels) for _, name, labels in clips], seed)
    takes: dict[str, list[str]] = defaultdict(list)
    split: dict[str, str] = {}
    for take, name, _ in clips:
        if name in held_back:
            split[take] = "test_unseen"
        elif take not in split:
            split[take] = "train"
            takes[name].append(take)
    for members in takes.values():
        if len(members) < MIN_TAKES:
            continue
        ordered = sorted(members, key=lambda take: _order(seed, take))
        num_test = max(1, round(TEST_FRACTION * len(ordered)))
        num_val = max(1 if len(ordered) >= 2 * MIN_TAKES else 0, round(VAL_FRACTION * len(ordered)))
        for take in ordered[:num_test]:
            split[take] = "test_seen"
        for take in ordered[num_test : num_test + num_val]:
            split[take] = "val"
    return split


def assign_alike(names: Sequence[str], seed: int) -> dict[str, str]:
    """Train, val or test of songs or takes of one kind.

    Fewer than are needed for all three are all for training: what is held back of so few would be
    missed there and tell little.
    """
    if len(names) < 2 * MIN_TAKES:
        return dict.fromkeys(names, "train")
    drawn = assign_splits([(name, "of one kind", {}) for name in names], seed)
    return {name: split.partition("_")[0] for name, split in drawn.items()}
