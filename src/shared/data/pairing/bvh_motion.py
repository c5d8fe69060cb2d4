"""Motion files without captions: pairs with music need none."""

from dataclasses import replace
from pathlib import Path

from ..caption_files import Piece
from ..prepare import prepare
from ..prepared import PreparedData
from ..sources import MotionFolder

CAPTION = {"en": ["a person moves"]}  # what keeps `prepare` from skipping an unlabelled clip


def prepare_unlabelled(source: Path, out: Path) -> PreparedData:
    """Prepare every motion file of a folder, labelled or not, once; then open it.

    Raises:
        UserError: no motion file, or none can be used.
    """
    folder = MotionFolder.open(source)
    folder = replace(folder, table=dict.fromkeys(folder.files(), (Piece(captions=CAPTION),)))
    prepare([folder], out, workers=1)
    return PreparedData.open(out)
