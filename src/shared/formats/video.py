"""MP4 and GIF out: the mannequin in motion, drawn on the CPU without a window.

GIF needs nothing but Pillow; its pictures stand for whole hundredths of a second, so it runs at
the fastest such rate below the motion's own and plays in real time. MP4 (H.264, plays anywhere)
needs PyAV. Legend: T frames.
"""

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import UserError
from ..files import atomic_write
from ..motion.motion import Motion
from ..motion.resample import resample_motion
from .body import CONTACT
from .drawing import INK, OVERSAMPLE, font
from .png import AZIMUTH, draw_pose

if TYPE_CHECKING:
    from PIL import Image

SIZE = (480, 480)  # pixels; even numbers, as video wants them
MAX_FPS = 30.0  # pictures a second; more cost time and show nothing
FOLLOW = 1.0  # seconds over which the camera's path is smoothed
COLOURS = 128  # of a GIF
GREENS = 32  # rows of the shades of a foot on the ground, for the palette
MAX_PICTURES = {"gif": 1500, "mp4": 18_000}  # a minute, which Pillow keeps in memory; ten minutes


def write_gif(motion: Motion, path: str | Path) -> Path:
    """Write an animated GIF that repeats for ever.

    Raises:
        UserError: too long, or the file cannot be written.
    """
    from PIL import Image

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


def _palette(first: "Image.Image") -> "Image.Image":
    """One palette for all pictures, so that nothing flickers: the first's, and a foot's green."""
    from PIL import Image

    sheet = Image.new("RGB", (first.width, first.height + GREENS))
    sheet.paste(first, (0, 0))
    for row in range(GREENS):
        green = tuple(round(255 * part * (0.5 + 0.5 * row / GREENS)) for part in CONTACT)
        sheet.paste(green, (0, first.height + row, first.width, first.height + row + 1))
    return sheet.quantize(COLOURS, dither=Image.Dither.NONE)


def write_mp4(motion: Motion, path: str | Path) -> Path:
    """Write an MP4 film at the motion's own rate, at most 30 pictures a second.

    Raises:
        UserError: PyAV is not installed, too long, or the file cannot be written.
    """
    try:
        import av
    except ImportError as error:
        raise UserError(f"cannot write {path}: MP4 needs PyAV; install it with: pip install av, "
                        "or write a .gif") from error  # fmt: skip
    motion = motion if motion.fps <= MAX_FPS else resample_motion(motion, MAX_FPS)
    _check(motion, path, "mp4")
    with atomic_write(Path(path)) as temporary:
        try:
            _film(motion, temporary)
        except av.FFmpegError as error:
            if isinstance(error, OSError):  # the disk's fault, not the film's
                raise
            raise UserError(f"cannot write {path}: {error}; write a .gif instead") from error
    return Path(path)


def _film(motion: Motion, path: Path) -> None:
    """Encode every picture; the index goes in front, so that browsers start at once."""
    import av

    rate = Fraction(motion.fps).limit_denominator(1001)
    with av.open(str(path), "w", format="mp4", options={"movflags": "faststart"}) as out:
        stream = out.add_stream("libx264", rate=rate)
        stream.width, stream.height = SIZE
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": "20", "preset": "veryfast"}
        for picture in frames(motion):
            out.mux(stream.encode(av.VideoFrame.from_image(picture)))
        out.mux(stream.encode())


def gif_rate(fps: float) -> float:
    """The fastest rate not above `fps` whose pictures stand for whole hundredths of a second."""
    return float(100 / np.ceil(100 / fps - 1e-6))


def frames(motion: Motion, size: tuple[int, int] = SIZE) -> Iterator["Image.Image"]:
    """The pictures of a motion, one a frame; the camera follows the pelvis smoothly."""
    from PIL import Image, ImageDraw

    positions, rotations = motion.positions(), motion.global_rotations()
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
