"""Walks one epoch of a bucket in its own process and commits each item with the iterator's state.

python epoch_process.py ADDRESS CACHE LEDGER: the ledger is what a checkpoint is in training.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[4]))

from src.shared.data.phrases.dataset import MotionPhraseDataset
from src.shared.io.files import write_json
from tests.shared.data.phrases.gcs_proxy import BUCKET, options
from tests.shared.data.phrases.phrase_samples import plain_encode


def main(address: str, cache: Path, ledger: Path) -> None:
    data = MotionPhraseDataset(
        gcs_bucket=BUCKET,
        gcs_prefix="phrases",
        target_frames=60,
        encode=plain_encode,
        cache_dir=cache,
        storage_options=options(address),
        threads=8,
    )
    epoch = data.epoch(3)
    seen: list[str] = []
    if ledger.exists():
        saved = json.loads(ledger.read_text())
        seen = saved["seen"]
        epoch.load_state_dict(saved["state"])
    for item in epoch:
        seen.append(item.record.id)
        write_json(ledger, {"seen": seen, "state": epoch.state_dict()})
    write_json(ledger, {"seen": seen, "state": epoch.state_dict(), "report": data.report()})


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
