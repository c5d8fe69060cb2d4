"""Frame strips: a few poses of each motion, side by side, with its path seen from above.

Needs Pillow, nothing else. Left limbs are orange, right limbs blue, the trunk grey; a foot in
contact is green. The arrow on the floor is the facing direction, the line the pelvis path.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from src.shared.errors import UserError
from src.shared.files import atomic_write
from src.shared.formats.body import CONTACT
from src.shared.formats.mannequin import Mannequin, mannequin, side_colours
from src.shared.formats.raster import Camera, draw_mesh
from src.shared.motion.motion import Motion
from src.shared.motion.skeleton import FOOT_JOINTS

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

BACKGROUND = (246, 247, 249)
FLOOR = (236, 238, 242)
GRID = (214, 218, 225)
INK = (52, 58, 68)
PATH = (200, 60, 90)
OVERSAMPLE = 2
AZIMUTH, ELEVATION = np.deg2rad(28.0), np.deg2rad(17.0)
GRID_METRES = 0.5


def render_strip(
    motions: Sequence[Motion] | Motion,
    path: str | Path,
    frames: int = 8,
    *,
    panel: tuple[int, int] = (190, 270),
    azimuth: float = AZIMUTH,
    titles: Sequence[str] | None = None,
) -> Path:
    """Draw `frames` evenly spaced poses of each motion, one motion a row, and save a PNG.

    Args:
        motions: one motion or several.
        path: the picture to write.
        frames: poses a row.
        panel: width and height of one pose in pixels.
        azimuth: camera angle in radians; 0 looks at the face of a character that faces +Z.
        titles: one line a row instead of each motion's text.

    Raises:
        UserError: no motion, or Pillow is not installed.
    """
    try:
        from PIL import Image, ImageDraw
    except ImportError as error:
        raise UserError("frame strips need Pillow; install it with: pip install pillow") from error
    rows = [motions] if isinstance(motions, Motion) else list(motions)
    if not rows or frames < 1:
        raise UserError("nothing to draw: give at least one motion and one frame")
    size = (panel[0] * OVERSAMPLE, panel[1] * OVERSAMPLE)
    header = 26 * OVERSAMPLE
    sheet = Image.new(
        "RGB", (size[0] * frames + size[1], (size[1] + header) * len(rows)), BACKGROUND
    )
    draw = ImageDraw.Draw(sheet)
    for row, motion in enumerate(rows):
        top = row * (size[1] + header)
        title = titles[row] if titles else motion.text or f"motion {row + 1}"
        draw.text((8 * OVERSAMPLE, top + 5 * OVERSAMPLE), title, INK, _font(14 * OVERSAMPLE, title))
        picks = np.linspace(0, motion.num_frames - 1, frames).round().astype(int)
        positions, rotations = motion.positions(), motion.global_rotations()
        for column, frame in enumerate(picks):
            pose = _draw_pose(motion, positions, rotations, int(frame), size, azimuth)
            sheet.paste(pose, (column * size[0], top + header))
        sheet.paste(
            _draw_map(positions, rotations, picks, size[1]), (frames * size[0], top + header)
        )
    sheet = sheet.resize(
        (sheet.width // OVERSAMPLE, sheet.height // OVERSAMPLE), Image.Resampling.LANCZOS
    )
    with atomic_write(Path(path)) as temporary:
        sheet.save(temporary, format="PNG", optimize=True)
    return Path(path)


def vertex_colours(body: Mannequin, contacts: np.ndarray) -> np.ndarray:
    """RGB of each vertex [V,3]: by side, and green where a foot is on the ground."""
    colours = side_colours(body.side)
    for contact, joints in zip(contacts, FOOT_JOINTS, strict=True):
        share = (body.weights * np.isin(body.joints, joints)).sum(-1, keepdims=True)
        colours += float(contact > 0.5) * share * (np.array(CONTACT) - colours)
    return np.asarray(colours)


def _draw_pose(
    motion: Motion,
    positions: np.ndarray,
    rotations: np.ndarray,
    frame: int,
    size: tuple[int, int],
    azimuth: float,
) -> "Image.Image":
    """One pose, seen by a camera that follows the pelvis."""
    from PIL import Image, ImageDraw, ImageFilter

    target = motion.root_position[frame] * (1.0, 0.0, 1.0)
    top = max(1.85, float(positions[:, :, 1].max()) + 0.35)
    camera = Camera(
        azimuth, ELEVATION, size[1] / (top + 0.55), target, (size[0] / 2, size[1] * 0.84)
    )
    image = Image.new("RGB", size, FLOOR)
    draw = ImageDraw.Draw(image)
    _draw_grid(draw, camera, target)
    path = camera.project(motion.root_position * (1.0, 0.0, 1.0))[:, :2]
    if len(path) > 1:
        draw.line([tuple(p) for p in path], PATH, 2 * OVERSAMPLE, joint="curve")
    _draw_arrow(draw, camera, target, rotations[frame, 0, :, 2])

    body = mannequin()
    vertices, normals = body.pose(positions[frame], rotations[frame])
    ground = camera.project(vertices * (1.0, 0.0, 1.0))[:, :2]
    shadow = Image.new("L", size, 0)
    pen = ImageDraw.Draw(shadow)
    for triangle in ground[body.triangles[::2]].reshape(-1, 6).tolist():
        pen.polygon(triangle, 95)
    image.paste((70, 76, 90), (0, 0), shadow.filter(ImageFilter.GaussianBlur(3 * OVERSAMPLE)))
    colours = vertex_colours(body, motion.contacts[frame])
    draw_mesh(draw, camera, vertices, normals, body.triangles, colours)
    label = f"{frame / motion.fps:.2f} s"
    draw.text(
        (size[0] / 2, size[1] - 4 * OVERSAMPLE), label, INK, _font(11 * OVERSAMPLE), anchor="mb"
    )
    return image


def _draw_grid(draw: "ImageDraw.ImageDraw", camera: Camera, target: np.ndarray) -> None:
    """Floor lines every half metre, fixed to the world, and the wall behind them."""
    reach = 4.0
    lines = np.arange(np.floor(-reach / GRID_METRES), np.ceil(reach / GRID_METRES) + 1)
    x = (np.round(target[0] / GRID_METRES) + lines) * GRID_METRES
    z = (np.round(target[2] / GRID_METRES) + lines) * GRID_METRES
    for value in x:
        ends = camera.project(np.array([[value, 0, z[0]], [value, 0, z[-1]]]))[:, :2]
        draw.line([tuple(p) for p in ends], GRID, OVERSAMPLE)
    for value in z:
        ends = camera.project(np.array([[x[0], 0, value], [x[-1], 0, value]]))[:, :2]
        draw.line([tuple(p) for p in ends], GRID, OVERSAMPLE)


def _draw_arrow(
    draw: "ImageDraw.ImageDraw", camera: Camera, origin: np.ndarray, facing: np.ndarray
) -> None:
    """A flat arrow on the floor in front of the character."""
    flat = facing * (1.0, 0.0, 1.0)
    length = float(np.linalg.norm(flat))
    if length < 1e-3:
        return
    ahead = flat / length
    side = np.array([ahead[2], 0.0, -ahead[0]])
    tip, neck = origin + 0.50 * ahead, origin + 0.38 * ahead
    tail = origin + 0.22 * ahead
    shape = [tail + 0.015 * side, neck + 0.015 * side, neck + 0.06 * side, tip,
             neck - 0.06 * side, neck - 0.015 * side, tail - 0.015 * side]  # fmt: skip
    draw.polygon([tuple(p) for p in camera.project(np.array(shape))[:, :2]], INK)


def _draw_map(
    positions: np.ndarray, rotations: np.ndarray, picks: np.ndarray, size: int
) -> "Image.Image":
    """The pelvis path from above (+X right, +Z down, as seen from the front) with facings."""
    from PIL import Image, ImageDraw

    image = Image.new("RGB", (size, size), BACKGROUND)
    draw = ImageDraw.Draw(image)
    ground = positions[:, 0][:, [0, 2]]
    middle = (ground.min(0) + ground.max(0)) / 2
    span = max(1.0, float((ground.max(0) - ground.min(0)).max()) * 1.15 + 0.4)
    margin = 8 * OVERSAMPLE
    scale = (size - 2 * margin) / span

    def pixel(point: np.ndarray) -> tuple[float, float]:
        x, y = (point - middle) * scale + size / 2
        return float(x), float(y)

    step = 0.5 if span < 6 else 2.0 if span < 20 else 10.0
    for axis in (0, 1):
        for line in np.arange(np.ceil((middle[axis] - span / 2) / step) * step,
                              middle[axis] + span / 2, step):  # fmt: skip
            at = (line - middle[axis]) * scale + size / 2
            low, high = margin, size - margin
            ends = [(at, low), (at, high)] if axis == 0 else [(low, at), (high, at)]
            draw.line(ends, GRID, OVERSAMPLE)
    if len(ground) > 1:
        draw.line([pixel(p) for p in ground], PATH, 2 * OVERSAMPLE, joint="curve")
    for number, frame in enumerate(picks):
        x, y = pixel(ground[frame])
        ahead = rotations[frame, 0, [0, 2], 2]
        ahead = ahead / max(1e-6, float(np.linalg.norm(ahead))) * 12 * OVERSAMPLE
        draw.line([(x, y), (x + ahead[0], y + ahead[1])], INK, 2 * OVERSAMPLE)
        radius = 4 * OVERSAMPLE if number == 0 else 2.5 * OVERSAMPLE
        draw.ellipse([x - radius, y - radius, x + radius, y + radius], INK)
    note = f"from above, grid {step:g} m"
    draw.text((margin, size - 4 * OVERSAMPLE), note, INK, _font(11 * OVERSAMPLE), anchor="lb")
    return image


def _font(size: int, text: str = "") -> Any:
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
