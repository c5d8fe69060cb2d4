"""The mannequin drawn on the CPU: frame strips as PNG, films as GIF and MP4.

Left limbs are orange, right limbs blue, the trunk grey; a foot in contact is green. The arrow on
the floor is the facing direction, the line the pelvis path. Strips and GIF need Pillow alone; the
pictures of a GIF stand for whole hundredths of a second, so it runs at the fastest such rate below
the motion's own and plays in real time. MP4 (H.264, plays anywhere) needs PyAV. T frames."""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from ...errors import UserError
from ...io.files import atomic_write
from ...io.sound_files import SoundReader
from ...motion.motion import Danced, Motion, resample_motion
from ...motion.skeleton import FOOT_JOINTS
from ..mannequin import CONTACT, Mannequin, mannequin, side_colours
from .drawing import (
    BACKGROUND,
    FLOOR,
    GRID,
    INK,
    OVERSAMPLE,
    Camera,
    FloorMap,
    draw_mesh,
    font,
    new_sheet,
    save_sheet,
)
from .trajectory import PATH

AZIMUTH, ELEVATION = np.deg2rad(28.0), np.deg2rad(17.0)
GRID_METRES = 0.5


def render_strip(
    motions: Sequence[Motion] | Motion,
    path: str | Path,
    frames: int = 8,
    *,
    panel: tuple[int, int] = (190, 270),
    azimuth: float = AZIMUTH,
) -> Path:
    """Draw `frames` evenly spaced poses of each motion, one motion a row, and save a PNG.

    Args:
        frames: poses a row.
        panel: width and height of one pose in pixels.
        azimuth: camera angle in radians; 0 looks at the face of a character that faces +Z.

    Raises:
        UserError: no motion, or the file cannot be written.
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
        title = motion.text or f"motion {row + 1}"
        draw.text((8 * OVERSAMPLE, top + 5 * OVERSAMPLE), title, INK, font(14 * OVERSAMPLE, title))
        picks = np.linspace(0, motion.num_frames - 1, frames).round().astype(int)
        positions, rotations = motion.kinematics()
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
    width: float = 0.0,
    tail: int | None = None,
) -> Image.Image:
    """One pose, with the floor, the shadow and the path.

    Args:
        positions: `motion.positions()`.
        rotations: `motion.global_rotations()`.
        size: width and height in (doubled) pixels.
        azimuth: camera angle in radians.
        target: the point of the floor [3] that the camera looks at; under the pelvis by default.
        width: metres that must fit into the picture.
        tail: so many frames of the path until now are drawn; None = all of it.
    """
    under = motion.root_position[frame] * (1.0, 0.0, 1.0)
    target = under if target is None else target
    top = max(1.85, float(positions[:, :, 1].max()) + 0.35)
    scale = min(size[1] / (top + 0.55), size[0] / max(width, 1e-6))
    camera = Camera(azimuth, ELEVATION, scale, target, (size[0] / 2, size[1] * 0.84))
    image = Image.new("RGB", size, FLOOR)
    draw = ImageDraw.Draw(image)
    _draw_grid(draw, camera, target)
    way = motion.root_position
    way = way if tail is None else way[max(0, frame - tail) : frame + 1]
    path = camera.project(way * (1.0, 0.0, 1.0))[:, :2]
    if len(path) > 1:
        draw.line([tuple(p) for p in path], PATH, 2 * OVERSAMPLE, joint="curve")
    _draw_arrow(draw, camera, under, rotations[frame, 0, :, 2])

    body = mannequin()
    vertices, normals = body.pose(positions[frame], rotations[frame])
    ground = camera.project(vertices * (1.0, 0.0, 1.0))[:, :2]
    blur = 3 * OVERSAMPLE
    corner = np.floor(ground.min(0)) - 3 * blur
    shadow = Image.new("L", tuple(np.ceil(ground.max(0) - corner).astype(int) + 3 * blur), 0)
    pen = ImageDraw.Draw(shadow)
    for triangle in (ground - corner)[body.triangles[::2]].reshape(-1, 6).astype(np.float32):
        pen.polygon(triangle, 95)
    place = (int(corner[0]), int(corner[1]))
    image.paste((70, 76, 90), place, shadow.filter(ImageFilter.GaussianBlur(blur)))
    colours = vertex_colours(body, motion.contacts[frame])
    draw_mesh(draw, camera, vertices, normals, body.triangles, colours)
    label = f"{frame / motion.fps:.2f} s"
    draw.text(
        (size[0] / 2, size[1] - 4 * OVERSAMPLE), label, INK, font(11 * OVERSAMPLE), anchor="mb"
    )
    return image


def _draw_grid(draw: ImageDraw.ImageDraw, camera: Camera, target: np.ndarray) -> None:
    """Floor lines every half metre, fixed to the world."""
    reach = 4.0
    lines = np.arange(-reach / GRID_METRES, reach / GRID_METRES + 1)
    x = (np.round(target[0] / GRID_METRES) + lines) * GRID_METRES
    z = (np.round(target[2] / GRID_METRES) + lines) * GRID_METRES
    along_z = [((value, 0, z[0]), (value, 0, z[-1])) for value in x]
    along_x = [((x[0], 0, value), (x[-1], 0, value)) for value in z]
    for ends in along_z + along_x:
        draw.line([tuple(p) for p in camera.project(np.array(ends))[:, :2]], GRID, OVERSAMPLE)


def _draw_arrow(
    draw: ImageDraw.ImageDraw, camera: Camera, origin: np.ndarray, facing: np.ndarray
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
) -> Image.Image:
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


SIZE = (480, 480)  # pixels; even numbers, as video wants them
STAGE_SIZE = (720, 720)  # of a dance
STAGE_TAIL = 2.0  # seconds of path
GLOW = 0.25  # seconds that a count lights up
ACCENT = (47, 111, 208)
MAX_FPS = 30.0  # pictures a second; more cost time and show nothing
SOUND_BLOCK = 16_384  # samples
FOLLOW = 1.0  # seconds over which the camera's path is smoothed
GIF_COLOURS = 128  # of a GIF
GREENS = 32  # rows of the shades of a foot on the ground, for the palette
MAX_PICTURES = {"gif": 1500, "mp4": 18_000}  # a minute, which Pillow keeps in memory; ten minutes


def write_gif(motion: Motion, path: str | Path) -> Path:
    """Write an animated GIF that repeats for ever; raises UserError: too long, or not writable."""
    motion = resample_motion(motion, gif_rate(min(motion.fps, MAX_FPS)))
    _check(motion, path, "gif")
    pictures = frames(motion)
    first = next(pictures)
    plain = Image.Dither.NONE
    palette = _palette(first)
    rest = (picture.quantize(palette=palette, dither=plain) for picture in pictures)
    with atomic_write(Path(path)) as temporary:
        first.quantize(palette=palette, dither=plain).save(
            temporary,
            format="GIF",
            save_all=True,
            append_images=rest,
            duration=round(1000 / motion.fps),
            loop=0,
            optimize=False,
        )
    return Path(path)


def _palette(first: Image.Image) -> Image.Image:
    """One palette for all pictures, so that nothing flickers: the first's, and a foot's green."""
    sheet = Image.new("RGB", (first.width, first.height + GREENS))
    sheet.paste(first, (0, 0))
    for row in range(GREENS):
        green = tuple(round(255 * part * (0.5 + 0.5 * row / GREENS)) for part in CONTACT)
        sheet.paste(green, (0, first.height + row, first.width, first.height + row + 1))
    return sheet.quantize(GIF_COLOURS, dither=Image.Dither.NONE)


def find_av(where: str | Path = "the film") -> None:
    """Raises UserError where PyAV is not installed, which films are written with."""
    if find_spec("av") is None:
        raise UserError(f"cannot write {where}: MP4 needs PyAV; install it with: pip install av, "
                        "or write a .gif")  # fmt: skip


def write_mp4(
    motion: Motion,
    path: str | Path,
    song: Path | None = None,
    figures: Sequence[Danced] | None = None,
) -> Path:
    """Write an MP4 film at the motion's own rate, at most 30 pictures a second.

    Args:
        motion: T frames.
        song: the sound file that is heard from its start; None = a silent film.
        figures: what is danced on a stage, which is seen from the front; None = the camera follows.

    Raises:
        UserError: PyAV is not installed, too long, the song cannot be read, or the file cannot be
            written.
    """
    find_av(path)
    import av

    motion = motion if motion.fps <= MAX_FPS else resample_motion(motion, MAX_FPS)
    _check(motion, path, "mp4")
    with atomic_write(Path(path)) as temporary:
        try:
            _film(motion, temporary, song, figures)
        except av.FFmpegError as error:
            if isinstance(error, OSError):  # the disk's fault, not the film's
                raise
            raise UserError(f"cannot write {path}: {error}; write a .gif instead") from error
    return Path(path)


def _film(motion: Motion, path: Path, song: Path | None, figures: Sequence[Danced] | None) -> None:
    """Encode every picture and what is heard; the index goes in front, so that browsers start at
    once."""
    import av

    rate = Fraction(motion.fps).limit_denominator(1001)
    with av.open(str(path), "w", format="mp4", options={"movflags": "faststart"}) as out:
        stream = out.add_stream("libx264", rate=rate)
        stream.width, stream.height = SIZE if figures is None else STAGE_SIZE
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": "20", "preset": "veryfast"}
        heard: Iterator[float] = iter(())
        if song is not None:
            heard = _heard(out, SoundReader(song), motion.seconds)
        pictures = frames(motion) if figures is None else stage_frames(motion, figures)
        until = next(heard, np.inf)  # every stream is known before the first picture is written
        for number, picture in enumerate(pictures):
            out.mux(stream.encode(av.VideoFrame.from_image(picture)))
            while until <= number / motion.fps:
                until = next(heard, np.inf)
        out.mux(stream.encode())
        for _ in heard:
            pass


def _heard(out: Any, song: SoundReader, seconds: float) -> Iterator[float]:
    """Puts a song's beginning into a film, piece by piece; yields the second that is reached."""
    import av

    stream, done = out.add_stream("aac", rate=48_000 if song.rate == 48_000 else 44_100), 0
    stream.layout = "mono" if song.channels == 1 else "stereo"
    for block in song.beginning(seconds, SOUND_BLOCK):
        layout = "mono" if block.shape[1] == 1 else "stereo"
        frame = av.AudioFrame.from_ndarray(np.ascontiguousarray(block.T), "fltp", layout)
        frame.sample_rate, frame.pts = song.rate, done
        out.mux(stream.encode(frame))
        done += len(block)
        yield done / song.rate
    out.mux(stream.encode())


def gif_rate(fps: float) -> float:
    """The fastest rate not above `fps` whose pictures stand for whole hundredths of a second."""
    return float(100 / np.ceil(100 / fps - 1e-6))


def frames(motion: Motion, size: tuple[int, int] = SIZE) -> Iterator[Image.Image]:
    """The pictures of a motion, one a frame; the camera follows the pelvis smoothly."""
    positions, rotations = motion.kinematics()
    targets = _smooth(motion.root_position * (1.0, 0.0, 1.0), motion.fps)
    large = (size[0] * OVERSAMPLE, size[1] * OVERSAMPLE)
    title = font(14 * OVERSAMPLE, motion.text)
    for frame in range(motion.num_frames):
        picture = draw_pose(
            motion, positions, rotations, frame, large, AZIMUTH, target=targets[frame]
        )
        place = (10 * OVERSAMPLE, 8 * OVERSAMPLE)
        ImageDraw.Draw(picture).text(place, motion.text, INK, title)
        yield picture.resize(size, Image.Resampling.BOX)


def rounds(counts: int) -> int:
    """How far dancers count in a figure of so many: to six in twos of threes, else to eight."""
    return 6 if counts % 6 == 0 else 8


def stage_frames(motion: Motion, figures: Sequence[Danced]) -> Iterator[Image.Image]:
    """The pictures of a dance: the whole stage from the front, the figure and its counts."""
    positions, rotations = motion.kinematics()
    low, high = positions.min((0, 1)), positions.max((0, 1))
    middle = (low + high) / 2 * (1.0, 0.0, 1.0)
    width = float(high[0] - low[0]) + 0.4
    large = (STAGE_SIZE[0] * OVERSAMPLE, STAGE_SIZE[1] * OVERSAMPLE)
    title = font(20 * OVERSAMPLE, motion.text)
    small, big = font(16 * OVERSAMPLE), font(48 * OVERSAMPLE)
    tail = round(STAGE_TAIL * motion.fps)
    x, y, radius = large[0] - 56 * OVERSAMPLE, 56 * OVERSAMPLE, 40 * OVERSAMPLE
    for frame in range(motion.num_frames):
        picture = draw_pose(
            motion, positions, rotations, frame, large, 0.0, target=middle, width=width, tail=tail
        )
        pen, now = ImageDraw.Draw(picture), frame / motion.fps
        pen.text((16 * OVERSAMPLE, 12 * OVERSAMPLE), motion.text, INK, title)
        for figure in figures:
            if figure.start <= now < figure.stop:
                count = int(np.searchsorted(figure.times, now, side="right")) - 1
                glow = max(0.0, 1 - (now - figure.times[count]) / GLOW)
                between = np.array(BACKGROUND) * (1 - 0.8 * glow) + np.array(ACCENT) * 0.8 * glow
                colour = tuple(between.astype(int).tolist())
                pen.circle((x, y), radius, colour)
                pen.text(
                    (x, y), str(count % rounds(len(figure.times) - 1) + 1), INK, big, anchor="mm"
                )
                named = figure.kind + " (steps)" * figure.steps + ", mirrored" * figure.mirrored
                pen.text((16 * OVERSAMPLE, 42 * OVERSAMPLE), named, INK, small)
        yield picture.resize(STAGE_SIZE, Image.Resampling.BOX)


def _smooth(path: np.ndarray, fps: float) -> np.ndarray:
    """A path [T,3] averaged over `FOLLOW` seconds, ends repeated."""
    width = 2 * round(FOLLOW * fps / 2) + 1
    padded = np.pad(path, ((width // 2, width // 2), (0, 0)), mode="edge")
    sums = np.cumsum(np.concatenate((np.zeros((1, 3)), padded.astype(np.float64))), 0)
    return np.asarray((sums[width:] - sums[:-width]) / width)


def _check(motion: Motion, path: str | Path, kind: str) -> None:
    if motion.num_frames > MAX_PICTURES[kind]:
        limit = MAX_PICTURES[kind] / motion.fps
        raise UserError(f"cannot write {path}: {motion.seconds:.0f} s are too long for {kind}, "
                        f"{limit:.0f} s are the limit; cut the motion or write html")  # fmt: skip
