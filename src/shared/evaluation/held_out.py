"""Which clips to judge on: held back from training, seen and unseen label combinations apart."""

from dataclasses import dataclass
from pathlib import Path

from ..data.prepared import SYNTHETIC, ClipRecord, PreparedData

FRESH_SEED = 90210  # of synthetic clips made only to test: never one that trains
FRESH_CLIPS = 800


@dataclass(frozen=True)
class HeldOut:
    """Clips of each kind, and where they come from.

    Attributes:
        records: `seen` and `unseen` (label combinations) to their clips.
        source: one line for the report.
    """

    data: PreparedData
    records: dict[str, list[ClipRecord]]
    source: str


def open_held_out(data: str, cache: Path, trained_groups: frozenset[str]) -> HeldOut:
    """The test splits of a prepared folder, or fresh synthetic clips.

    Fresh clips are made with a seed that no training uses, so that all of them are held back;
    a label combination is unseen if it is not among `trained_groups`.

    Args:
        data: prepared folder, or "synthetic".
        cache: where synthetic clips are kept.
        trained_groups: label combinations that the models were trained on.

    Raises:
        UserError: no such folder, or it is damaged.
    """
    if data != SYNTHETIC:
        prepared = PreparedData.open(data)
        records = {
            "seen": prepared.records("test_seen"),
            "unseen": prepared.records("test_unseen"),
        }
        return HeldOut(prepared, records, f"test splits of {data}")
    from ..data.prepare import prepare
    from ..data.sources.folders import SyntheticSource
    from ..sole_writer import sole_writer

    folder = cache / f"synthetic-test-{FRESH_CLIPS}"
    with sole_writer(folder, wait=True):
        prepare([SyntheticSource(FRESH_CLIPS, seed=FRESH_SEED)], folder)
    prepared = PreparedData.open(folder)
    everything = prepared.records()
    seen = [record for record in everything if record.group in trained_groups]
    unseen = [record for record in everything if record.group not in trained_groups]
    return HeldOut(
        prepared, {"seen": seen, "unseen": unseen}, f"fresh synthetic clips, seed {FRESH_SEED}"
    )
