#!/usr/bin/env python3
"""Captions of CMU's motions from CMU's own index, for `prepare --captions` and train_starter.py.

    python scripts/cmu_captions.py INDEX > cmu_index.tsv
    python scripts/cmu_captions.py INDEX 01 02 03 04 05 06 07 > some.tsv  # of these subjects

INDEX is the descriptions of mocap.cs.cmu.edu as text: the index that comes with conversions of the
whole database (`Subject #1 (climb, swing)`, then a line a motion: its number and its description),
or any text with such lines.
"""

import re
import sys
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

SUBJECT = re.compile(r"\s*subject\s*#?\s*\d+\s*[(:-]\s*(.*?)\)?\s*$", re.IGNORECASE)
MOTION = re.compile(r"\s*(\d{2,3}_\d{2,3})(?:\.\w+)?\s+(\S.*?)\s*$")


def rows(lines: Iterable[str], subjects: Collection[str] = ()) -> Iterator[str]:
    """The table's lines: clip, description, subject; of some subjects' clips, or of all."""
    yield "clip\tdescription\tsubject"
    subject = ""
    for line in lines:
        if found := SUBJECT.match(line):
            subject = found[1]
        elif (found := MOTION.match(line)) and (
            found[1].partition("_")[0] in subjects or not subjects
        ):
            yield f"{found[1]}\t{' '.join(found[2].split())}\t{subject}"


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    index, *subjects = sys.argv[1:]
    print("\n".join(rows(Path(index).read_text(encoding="utf-8").splitlines(), subjects)))
