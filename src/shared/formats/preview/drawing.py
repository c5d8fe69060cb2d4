"""What pictures share: colours, fonts, the floor seen from above, shaded triangles, and plots.

Pillow's are drawn at twice their size and shrunk, which smooths every edge. The camera is
orthographic; triangles are drawn from back to front. Legend: T frames, V vertices, F triangles."""

import logging
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ...errors import UserError
from ...io.files import atomic_write

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

OVERSAMPLE = 2
BACKGROUND = (246, 247, 249)
FLOOR = (236, 238, 242)
GRID = (214, 218, 225)
INK = (52, 58, 68)
MARGIN = 8 * OVERSAMPLE
FONTS = ("DejaVuSans.ttf", "Arial.ttf", "Helvetica.ttc")
EASTERN_FONTS = ("NotoSansCJK-Regular.ttc", "YuGothM.ttc", "msyh.ttc", "PingFang.ttc",
                 "Hiragino Sans GB.ttc", "DroidSansFallbackFull.ttf", "wqy-microhei.ttc",
                 "ipaexg.ttf")  # fmt: skip

log = logging.getLogger(__name__)


def new_sheet(width: int, height: int) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    """An empty picture of this many (doubled) pixels and a pen."""
    sheet = Image.new("RGB", (width, height), BACKGROUND)
    return sheet, ImageDraw.Draw(sheet)


def save_sheet(sheet: Image.Image, path: Path) -> Path:
    """Shrink to the wanted size; write a PNG whole or not at all; raises UserError if it cannot."""
    size = (sheet.width // OVERSAMPLE, sheet.height // OVERSAMPLE)
    small = sheet.resize(size, Image.Resampling.LANCZOS)
    with atomic_write(path) as temporary:
        small.save(temporary, format="PNG", optimize=True)
    return path


def font(size: int, text: str = "") -> Any:
    """A font that can show the text, as far as the machine has one."""
    if any(ord(letter) >= 0x2E80 for letter in text):
        if found := _first_font(EASTERN_FONTS, size):
            return found
        _tell_of_fonts()
    return _first_font(FONTS, size) or ImageFont.load_default(size)


@lru_cache
def _tell_of_fonts() -> None:
    """Once."""
    log.warning(
        "no font here has Chinese, Japanese or Korean letters: pictures show boxes for them;"
        " install one, such as Noto Sans CJK"
    )


@lru_cache
def _first_font(names: tuple[str, ...], size: int) -> Any:
    """The first of these fonts that this machine has, or None."""
    for name in names:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    return None


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

    def draw_grid(self, draw: ImageDraw.ImageDraw) -> None:
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
        self, draw: ImageDraw.ImageDraw, point: np.ndarray, facing: np.ndarray, radius: float
    ) -> None:
        """A dot at a point [2] with a line to where the character looks [2]."""
        x, y = self.pixel(point)
        ahead = facing / max(1e-6, float(np.linalg.norm(facing))) * 12 * OVERSAMPLE
        draw.line([(x, y), (x + ahead[0], y + ahead[1])], INK, 2 * OVERSAMPLE)
        draw.circle((x, y), radius, INK)


LIGHT = np.array([0.30, 0.80, 0.60]) / np.linalg.norm([0.30, 0.80, 0.60])  # world, towards it


@dataclass(frozen=True)
class Camera:
    """An orthographic camera that looks at one point of the floor.

    Attributes:
        azimuth: radians around +Y; 0 looks from +Z at a character that faces it.
        elevation: radians above the horizon.
        scale: pixels a metre.
        target: world point [3] that is drawn at `centre`.
        centre: pixel (x, y) of the target.
    """

    azimuth: float
    elevation: float
    scale: float
    target: np.ndarray
    centre: tuple[float, float]

    def basis(self) -> np.ndarray:
        """Rows: screen right, screen up, towards the viewer [3,3]."""
        sin_a, cos_a = np.sin(self.azimuth), np.cos(self.azimuth)
        sin_e, cos_e = np.sin(self.elevation), np.cos(self.elevation)
        forward = np.array([sin_a * cos_e, sin_e, cos_a * cos_e])
        right = np.array([cos_a, 0.0, -sin_a])
        return np.stack((right, np.cross(forward, right), forward))

    def project(self, points: np.ndarray) -> np.ndarray:
        """World points [...,3] → pixel x, pixel y (down) and nearness in pixels [...,3]."""
        view = (np.asarray(points, dtype=np.float64) - self.target) @ self.basis().T * self.scale
        return np.asarray(view * (1.0, -1.0, 1.0) + (*self.centre, 0.0))


def draw_mesh(
    draw: ImageDraw.ImageDraw,
    camera: Camera,
    vertices: np.ndarray,
    normals: np.ndarray,
    triangles: np.ndarray,
    colours: np.ndarray,
) -> None:
    """Draw a closed mesh over what is there.

    Args:
        vertices: world positions [V,3], metres.
        normals: unit normals [V,3].
        triangles: vertex indices [F,3], counter-clockwise seen from outside.
        colours: RGB of each vertex [V,3], 0 to 1.
    """
    screen = camera.project(vertices)
    corners = screen[triangles]  # [F,3,3]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    towards = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] < 0  # y points down
    order = np.flatnonzero(towards)
    order = order[np.argsort(corners[order, :, 2].mean(-1), kind="stable")]
    shaded = shade(normals, colours, camera)[triangles[order]].mean(1)
    paints = (shaded * 255).round().astype(int).tolist()
    # Rows of float32: Pillow takes them as they are, which is a third faster than lists.
    outlines = np.ascontiguousarray(corners[order][..., :2].reshape(len(order), 6), np.float32)
    for outline, paint in zip(outlines, paints, strict=True):
        draw.polygon(outline, tuple(paint))


def shade(normals: np.ndarray, colours: np.ndarray, camera: Camera) -> np.ndarray:
    """Soft light from above, a darker rim that separates overlapping limbs, a faint shine [V,3]."""
    toward = camera.basis()[2]
    diffuse = 0.5 + 0.5 * (normals @ LIGHT)
    facing = np.clip(normals @ toward, 0.0, 1.0)
    halfway = (LIGHT + toward) / np.linalg.norm(LIGHT + toward)
    shine = np.clip(normals @ halfway, 0.0, 1.0) ** 30
    level = (0.40 + 0.70 * diffuse) * (0.62 + 0.38 * np.minimum(1.0, facing * 2.0))
    return np.asarray(np.clip(colours * level[:, None] + 0.14 * shine[:, None], 0.0, 1.0))


# ---------------------------------------------------------------- plots
# matplotlib is imported when one is drawn; no window is opened.


def legend(axes: "Axes") -> None:
    """In a line above the panel, right of its title."""
    axes.legend(
        loc="lower right", bbox_to_anchor=(1, 1), ncols=4, fontsize="small", frameon=False,
        borderaxespad=0,
    )  # fmt: skip


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure of so many inches. Raises UserError: matplotlib is missing."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise UserError(
            "plots need matplotlib, which is not installed; run `pip install matplotlib`"
        ) from error
    return Figure(figsize=(width, height), layout="constrained")


def save_figure(figure: "Figure", path: Path) -> Path:
    """Write .png, .pdf or .svg, whole or not at all.
    Raises UserError: the file cannot be written."""
    ending = path.suffix.removeprefix(".").lower()
    with atomic_write(path) as temporary:
        figure.savefig(temporary, format=ending or "png", dpi=100)
    return path
