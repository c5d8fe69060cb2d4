"""Frame strips: a few poses of each motion, side by side, with its path seen from above.

Needs Pillow, nothing else. Left limbs are orange, right limbs blue, the trunk grey; a foot in
contact is green. The arrow on the floor is the facing direction, the line the pelvis path.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import UserError
from ..motion.motion import Motion
from ..motion.skeleton import FOOT_JOINTS
from .body import CONTACT
from .drawing import (
    FLOOR,
    GRID,
    INK,
    OVERSAMPLE,
    PATH,
    FloorMap,
    font,
    new_sheet,
    save_sheet,
)
from .mannequin import Mannequin, mannequin, side_colours
from .raster import Camera, draw_mesh

if TYPE_CHECKING:
    from PIL import Image, ImageDraw

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
    rows = [motions] if isinstance(motions, Motion) else list(motions)
    if not rows or frames < 1:
        raise UserError("nothing to draw: give at least one motion and one frame")
    size = (panel[0] * OVERSAMPLE, panel[1] * OVERSAMPLE)
    header = 26 * OVERSAMPLE
    width, height = size[0] * frames + size[1], (size[1] + header) * len(rows)
    sheet, draw = new_sheet(width, height)
    for row, motion in enumerate(rows):
        top = row * (size[1] + header)
        title = titles[row] if titles else motion.text or f"motion {row + 1}"
        draw.text((8 * OVERSAMPLE, top + 5 * OVERSAMPLE), title, INK, font(14 * OVERSAMPLE, title))
        picks = np.linspace(0, motion.num_frames - 1, frames).round().astype(int)
        positions, rotations = motion.positions(), motion.global_rotations()
        for column, frame in enumerate(picks):
            pose = draw_pose(motion, positions, rotations, int(frame), size, azimuth)
            sheet.paste(pose, (column * size[0], top + header))
        sheet.paste(
            _draw_map(positions, rotations, picks, size[1]), (frames * size[0], top + header)
        )
    return save_sheet(sheet, Path(path))


def vertex_colours(body: Mannequin, contacts: np.ndarray) -> np.ndarray:
    """RGB of each vertex [V,3]: by side, and green where a foot is on the ground."""
    colours = side_colours(body.side)
    for contact, joints in zip(contacts, FOOT_JOINTS, strict=True):
        share = (body.weights * np.isin(body.joints, joints)).sum(-1, keepdims=True)
        colours += float(contact > 0.5) * share * (np.array(CONTACT) - colours)
    return np.asarray(colours)


def draw_pose(
    motion: Motion,
    positions: np.ndarray,
    rotations: np.ndarray,
    frame: int,
    size: tuple[int, int],
    azimuth: float = AZIMUTH,
    *,
    target: np.ndarray | None = None,
) -> "Image.Image":
    """One pose, with the floor, the shadow and the path.

    Args:
        motion: whose pose.
        positions: `motion.positions()`.
        rotations: `motion.global_rotations()`.
        frame: which one.
        size: width and height in (doubled) pixels.
        azimuth: camera angle in radians.
        target: the point of the floor [3] that the camera looks at; under the pelvis by default.
    """
    from PIL import Image, ImageDraw, ImageFilter

    under = motion.root_position[frame] * (1.0, 0.0, 1.0)
    target = under if target is None else target
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
    _draw_arrow(draw, camera, under, rotations[frame, 0, :, 2])

    body = mannequin()
    vertices, normals = body.pose(positions[frame], rotations[frame])
    ground = camera.project(vertices * (1.0, 0.0, 1.0))[:, :2]
    shadow = Image.new("L", size, 0)
    pen = ImageDraw.Draw(shadow)
    for triangle in ground[body.triangles[::2]].reshape(-1, 6).astype(np.float32):
        pen.polygon(triangle, 95)
    image.paste((70, 76, 90), (0, 0), shadow.filter(ImageFilter.GaussianBlur(3 * OVERSAMPLE)))
    colours = vertex_colours(body, motion.contacts[frame])
    draw_mesh(draw, camera, vertices, normals, body.triangles, colours)
    label = f"{frame / motion.fps:.2f} s"
    draw.text(
        (size[0] / 2, size[1] - 4 * OVERSAMPLE), label, INK, font(11 * OVERSAMPLE), anchor="mb"
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
    ground = positions[:, 0][:, [0, 2]]
    image, draw = new_sheet(size, size)
    floor = FloorMap(ground, size)
    floor.draw_grid(draw)
    if len(ground) > 1:
        draw.line([floor.pixel(p) for p in ground], PATH, 2 * OVERSAMPLE, joint="curve")
    for number, frame in enumerate(picks):
        radius = 4 * OVERSAMPLE if number == 0 else 2.5 * OVERSAMPLE
        floor.draw_facing(draw, ground[frame], rotations[frame, 0, [0, 2], 2], radius)
    return image
