"""Are the seams of a body's windows seen? Accelerations and jerks there, elsewhere, and in mocap.

A dance of which every window is another dancer's (a hard cut) stands beside it: what a seam looks
like that is seen.

Letters: T frames, K joints.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ...metrics.seams import ORDERS, body_quantities, compare, starts
from ...motion.motion import Motion
from ...motion.postprocess.contacts import contact_runs
from ..report.tables import Column, Grid, GridRow
from ..samples import Dance

TOP = 99  # percentile of real motion that nothing at a seam is to pass
SEAM_COLUMNS = (
    Column("seam", "p99 at seams", 0), Column("elsewhere", "p99 elsewhere", 0),
    Column("real", "real p99", 0), Column("beyond_seam", "beyond it at seams %", 2),
    Column("beyond_elsewhere", "beyond it elsewhere %", 2), Column("ratio", "ratio of medians"),
)  # fmt: skip
SEAM_NOTE = (
    "Of each frame the joint that is worst, over all 22. *real p99*: of the frames of the real"
    " dances, or of captioned clips without them; real motion is beyond it in 1%. *ratio of"
    " medians*: at seams over elsewhere, [95% bootstrap over songs] (null: the same marks at random"
    " places). *hard cut*: from each seam on the pose of another dance."
)


def hard_cuts(dances: Sequence[Dance[Motion]]) -> list[Dance[Motion]]:
    """The dances, each with the poses of the next one from every second seam on."""
    cut = []
    for number, dance in enumerate(dances):
        other = dances[(number + 1) % len(dances)].motion.quaternions
        frames = min(len(other), dance.motion.num_frames)
        marks = np.zeros(frames, dtype=int) if dance.seams is None else _windows(dance.seams)
        taken = (marks[:frames] % 2 == 1)[:, None, None]
        own = dance.motion.quaternions[:frames]
        pose = np.where(taken, other[:frames], own)
        pose[:, 0] = own[:, 0]  # the path stays
        motion = replace(dance.motion.frames(0, frames), quaternions=pose)
        seams = None if dance.seams is None else dance.seams[:frames]
        cut.append(Dance(dance.song, motion, dance.beats, path=dance.path, seams=seams))
    return cut


def _windows(seams: np.ndarray) -> np.ndarray:
    """The number [T] of the window that each frame is in, counted in the middle of seams."""
    number = np.zeros(len(seams), dtype=int)
    for start, stop in contact_runs(seams, 0):
        number[(start + stop) // 2 :] += 1
    return number


def seam_grid(
    rows: Mapping[str, Sequence[Dance[Motion]]], real: Sequence[Motion], seed: int
) -> list[Grid]:
    """A row a kind of dance and quantity; nothing where no dance has a seam.

    Args:
        rows: dances by name.
        real: motions whose 99th percentile is the limit.
        seed: of resampling.
    """
    limits = {
        name: float(np.percentile(np.concatenate(values), TOP))
        for name, values in _stacked(real).items()
    }
    found: dict[str, GridRow] = {}
    for who, dances in rows.items():
        marked = [(d.motion, d.seams) for d in dances if d.seams is not None and d.seams.any()]
        sizes = _stacked([motion for motion, _ in marked])
        for name, limit in limits.items() if marked else ():
            pairs = list(zip(sizes[name], (seams for _, seams in marked), strict=True))
            found[f"{name}: {who}"] = GridRow(_cells(pairs, limit, seed), len(marked), 1)
    if not found:
        return []
    number = sum(len(starts(seams)) for _, seams in marked)
    title = f"seams of the body's windows ({number} seams of {len(marked)} dances)"
    return [Grid("body-seams", title, SEAM_COLUMNS, found, SEAM_NOTE, "quantity")]


def _stacked(motions: Sequence[Motion]) -> dict[str, list[np.ndarray]]:
    every = [body_quantities(motion) for motion in motions]
    return {name: [each[name] for each in every] for name in ORDERS}


def _cells(
    pairs: Sequence[tuple[np.ndarray, np.ndarray]], limit: float, seed: int
) -> dict[str, Any]:
    """One row: quantiles, shares beyond the limit, and the ratio with its intervals."""
    seam = np.concatenate([values[mask] for values, mask in pairs])
    other = np.concatenate([values[~mask] for values, mask in pairs])
    ratio = compare(pairs, seed)["ratio_p50"]
    return {
        "seam": float(np.percentile(seam, TOP)),
        "elsewhere": float(np.percentile(other, TOP)),
        "real": limit,
        "beyond_seam": 100 * float((seam > limit).mean()),
        "beyond_elsewhere": 100 * float((other > limit).mean()),
        "ratio": f"{ratio['value']:.2f} [{ratio['low']:.2f}, {ratio['high']:.2f}]"
        f" ({ratio['null_low']:.2f}–{ratio['null_high']:.2f})",
    }
