"""A small software renderer: round-ended cones with exact occlusion and soft shading, in numpy.

The camera is orthographic. Legend: H, W size of the picture in pixels.
"""

from dataclasses import dataclass

import numpy as np

Colour = tuple[float, float, float]
LIGHT = np.array([0.35, 0.80, 0.55]) / np.linalg.norm([0.35, 0.80, 0.55])  # world, towards it


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


def draw_cones(
    image: np.ndarray,
    camera: Camera,
    starts: np.ndarray,
    ends: np.ndarray,
    radii: np.ndarray,
    colours: np.ndarray,
) -> None:
    """Draw shaded cones with round ends into `image` [H,W,3] (floats 0…1), in place.

    Args:
        image: the background, drawn over.
        camera: how to look.
        starts: world centres of the first balls [M,3], metres.
        ends: world centres of the second balls [M,3].
        radii: radii of both balls [M,2], metres.
        colours: one RGB a cone [M,3].
    """
    height, width = image.shape[:2]
    depth = np.full((height, width), -np.inf)
    light = camera.basis() @ LIGHT * (1.0, -1.0, 1.0)
    points = zip(camera.project(starts), camera.project(ends), radii, colours, strict=True)
    for start, end, (r0, r1), colour in points:
        r0, r1 = r0 * camera.scale, r1 * camera.scale
        low = np.floor(np.minimum(start - r0, end - r1)[:2]).astype(int)
        high = np.ceil(np.maximum(start + r0, end + r1)[:2]).astype(int) + 1
        x0, y0 = np.clip(low, 0, (width, height))
        x1, y1 = np.clip(high, 0, (width, height))
        if x0 >= x1 or y0 >= y1:
            continue
        pixels_y, pixels_x = np.mgrid[y0:y1, x0:x1].astype(np.float64) + 0.5
        hit, nearness, normal = _intersect(pixels_x, pixels_y, start, end, r0, r1)
        window = depth[y0:y1, x0:x1]
        hit &= nearness > window
        window[hit] = nearness[hit]
        image[y0:y1, x0:x1][hit] = _shade(normal[hit], np.asarray(colour), light)


def _intersect(
    x: np.ndarray, y: np.ndarray, start: np.ndarray, end: np.ndarray, r0: float, r1: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where rays along the view axis meet the cone: hit [h,w], nearness [h,w], normal [h,w,3].

    The cone is the envelope of balls with centre c(s) and radius r(s), both linear in
    s ∈ [0, 1]. A ball's front is c_z(s) + √q(s) with q = r² - |pixel - c_xy|² = As² + Bs + C;
    the nearest of all fronts is where its derivative vanishes, a quadratic in s.
    """
    axis = end - start
    dx, dy = x - start[0], y - start[1]
    a = (r1 - r0) ** 2 - axis[0] ** 2 - axis[1] ** 2
    b = 2 * (r0 * (r1 - r0) + dx * axis[0] + dy * axis[1])
    c = r0**2 - dx**2 - dy**2
    if a < -1e-6:
        root = b * b - a * (b * b - 4 * axis[2] ** 2 * c) / (a - axis[2] ** 2)
        s = np.clip((-b - np.sign(axis[2]) * np.sqrt(np.maximum(root, 0.0))) / (2 * a), 0.0, 1.0)
    else:  # seen along the axis: one ball hides the other
        front = [start[2] + r0, end[2] + r1]
        s = np.full_like(x, float(np.argmax(front)))
    q = (a * s + b) * s + c
    hit = q > 0.0
    rise = np.sqrt(np.maximum(q, 0.0))
    radius = r0 + s * (r1 - r0)
    normal = np.stack((dx - s * axis[0], dy - s * axis[1], rise), -1) / radius[..., None]
    return hit, start[2] + s * axis[2] + rise, normal


def _shade(normal: np.ndarray, colour: np.ndarray, light: np.ndarray) -> np.ndarray:
    """Soft light from above, a darker rim that separates overlapping limbs, a faint shine."""
    diffuse = 0.5 + 0.5 * (normal @ light)
    rim = np.clip(normal[:, 2], 0.0, 1.0)
    halfway = light + np.array([0.0, 0.0, 1.0])
    shine = np.clip(normal @ (halfway / np.linalg.norm(halfway)), 0.0, 1.0) ** 40
    level = (0.42 + 0.68 * diffuse) * (0.55 + 0.45 * np.minimum(1.0, rim * 2.2))
    return np.asarray(np.clip(colour * level[:, None] + 0.16 * shine[:, None], 0.0, 1.0))
