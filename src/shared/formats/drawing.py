"""What Pillow pictures share: colours, fonts, the floor seen from above, and how they are saved.

Pictures are drawn at twice their size and shrunk, which smooths every edge.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UserError
from ..files import atomic_write

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

OVERSAMPLE = 2
BACKGROUND = (246, 247, 249)
FLOOR = (236, 238, 242)
GRID = (214, 218, 225)
INK = (52, 58, 68)
PATH = (200, 60, 90)
MARGIN = 8 * OVERSAMPLE


def new_sheet(width: int, height: int) -> tuple["Image.Image", "ImageDraw.ImageDraw"]:
    """An empty picture of this many (doubled) pixels and a pen.

    Raises:
        UserError: Pillow is not installed.
    """
    try:
        from PIL import Image, ImageDraw
    except ImportError as error:
        raise UserError("pictures need Pillow; install it with: pip install pillow") from error
    sheet = Image.new("RGB", (width, height), BACKGROUND)
    return sheet, ImageDraw.Draw(sheet)


def save_sheet(sheet: "Image.Image", path: Path) -> Path:
    """Shrink to the wanted size and write a PNG whole or not at all.

    Raises:
        UserError: the file cannot be written.
    """
    from PIL import Image

    size = (sheet.width // OVERSAMPLE, sheet.height // OVERSAMPLE)
    small = sheet.resize(size, Image.Resampling.LANCZOS)
    with atomic_write(path) as temporary:
        small.save(temporary, format="PNG", optimize=True)
    return path


def font(size: int, text: str = "") -> Any:
    """A font that can show the text, as far as the machine has one."""
    from PIL import ImageFont

    names = ["DejaVuSans.ttf", "Arial.ttf", "Helvetica.ttc"]
    if any(ord(letter) >= 0x2E80 for letter in text):  # Chinese, Japanese, Korean
        names = ["NotoSansCJK-Regular.ttc", "YuGothM.ttc", "msyh.ttc", "PingFang.ttc",
                 "Hiragino Sans GB.ttc", *names]  # fmt: skip
    for name in names:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return ImageFont.load_default(size)


class FloorMap:
    """A square of the floor seen from above: +X right, +Z down, as a viewer in front sees it.

    Args:
        ground: the points [T,2] (x, z) in metres that must fit in.
        size: side of the square in pixels.
    """

    def __init__(self, ground: np.ndarray, size: int) -> None:
        self.size = size
        self.middle = (ground.min(0) + ground.max(0)) / 2
        self.span = max(1.0, float((ground.max(0) - ground.min(0)).max()) * 1.15 + 0.4)
        self.scale = (size - 2 * MARGIN) / self.span

    def pixel(self, point: np.ndarray) -> tuple[float, float]:
        """Where a point [2] in metres lies in the square."""
        x, y = (point - self.middle) * self.scale + self.size / 2
        return float(x), float(y)

    def draw_grid(self, draw: "ImageDraw.ImageDraw") -> None:
        """Lines at round metres, and a note of their distance."""
        far = 10.0 ** np.floor(np.log10(self.span / 2))
        step = 0.5 if self.span < 6 else 2.0 if self.span < 20 else far
        low, high = MARGIN, self.size - MARGIN
        for axis in (0, 1):
            start = self.middle[axis] - self.span / 2
            for line in np.arange(np.ceil(start / step) * step, start + self.span, step):
                at = (line - self.middle[axis]) * self.scale + self.size / 2
                ends = [(at, low), (at, high)] if axis == 0 else [(low, at), (high, at)]
                draw.line(ends, GRID, OVERSAMPLE)
        note = f"from above, grid {step:g} m"
        place = (MARGIN, self.size - 4 * OVERSAMPLE)
        draw.text(place, note, INK, font(11 * OVERSAMPLE), anchor="lb")

    def draw_facing(
        self, draw: "ImageDraw.ImageDraw", point: np.ndarray, facing: np.ndarray, radius: float
    ) -> None:
        """A dot at a point [2] with a line to where the character looks [2]."""
        x, y = self.pixel(point)
        ahead = facing / max(1e-6, float(np.linalg.norm(facing))) * 12 * OVERSAMPLE
        draw.line([(x, y), (x + ahead[0], y + ahead[1])], INK, 2 * OVERSAMPLE)
        draw.ellipse([x - radius, y - radius, x + radius, y + radius], INK)
