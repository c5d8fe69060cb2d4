"""A small software renderer: shaded triangles from back to front, with Pillow.

The camera is orthographic. Legend: V vertices, F triangles.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from PIL import ImageDraw

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
    draw: "ImageDraw.ImageDraw",
    camera: Camera,
    vertices: np.ndarray,
    normals: np.ndarray,
    triangles: np.ndarray,
    colours: np.ndarray,
) -> None:
    """Draw a closed mesh over what is there.

    Args:
        draw: Pillow's pen on the picture.
        camera: how to look.
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
