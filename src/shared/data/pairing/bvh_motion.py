"""BVH files without captions: pairs with music need none."""

from dataclasses import replace
from pathlib import Path

from src.shared.data.prepare import prepare
from src.shared.data.prepared import PreparedData
from src.shared.data.sources import BvhFolder

CAPTION = {"en": ["a person moves"]}  # what keeps `prepare` from skipping an unlabelled clip


def prepare_unlabelled(source: Path, out: Path) -> PreparedData:
    """Prepare every BVH file of a folder, labelled or not, once; then open it.

    Raises:
        UserError: no BVH file, or none can be used.
    """
    folder = BvhFolder.open(source)
    folder = replace(folder, captions=dict.fromkeys(folder.items(), CAPTION))
    prepare([folder], out, workers=1)
    return PreparedData.open(out)
