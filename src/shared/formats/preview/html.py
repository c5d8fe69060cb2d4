"""HTML previews: one page that plays motions or trajectories side by side, offline.

The page is `preview.html` with the viewer's scripts and the data put in: the mannequin's mesh and
each motion as little-endian arrays in base64. T frames of a body that moves all its joints cost
190 T bytes before base64. With a song, the song plays and drives the body, its path and a phase
dial, each trajectory on a proxy body (78 bytes a frame) or on the body that dances it (223). The
song is in the page: its own bytes where browsers play them, otherwise Ogg Vorbis. A damaged file
is encoded anew from what could be read of it: a browser would leave gaps open that the analysis
closed, and sound and motion would run apart."""

import base64
import html
import io
import json
import re
from collections.abc import Sequence
from concurrent.futures import Future
from functools import lru_cache
from importlib.resources import files
from itertools import zip_longest
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np

from ...errors import UserError
from ...io.files import write_text
from ...io.sound_files import SoundReader
from ...motion.motion import Danced, Motion
from ...motion.skeleton import FOOT_JOINTS, canonical_skeleton
from ...motion.style import PAIRS, style_values
from ...motion.trajectory import MotionTrajectory
from ..mannequin import BODY, COLOURS, CONTACT, JOINT_SIDES, mannequin, whole_shares
from .trajectory import PATH, SongTrack, beat_marks, phase_palette, proxy_body

SCRIPTS = (
    "preview_scene.js",
    "preview_body.js",
    "preview_rhythm.js",
    "preview_clock.js",
    "preview.js",
)
HINT = """A <b style="color:#2f9150">foot</b> on the ground turns green; the red line is the
    path."""
MESH_UNIT = 1e-4  # metres; the vertex shader knows it too
QUATERNION_UNIT = 32767.0
_SIDES = {"left": 1, "right": -1, "centre": 0}


def write_html(motions: Sequence[Motion] | Motion, path: str | Path) -> Path:
    """Write one self-contained page; prompts are the captions and cannot act as markup.

    Raises:
        UserError: no motion, or the file cannot be written.
    """
    shown = [motions] if isinstance(motions, Motion) else list(motions)
    if not shown:
        raise UserError(f"cannot write {path}: there is no motion to show; give one")
    return write_page({"motions": [motion_data(motion) for motion in shown]}, path)


def write_page(
    data: dict[str, Any], path: str | Path, *, hint: str = HINT, media: str = ""
) -> Path:
    """Fill the template; returns the path.

    Args:
        data: `motions`, a list of what `motion_data` made, and what else the scripts read.
        hint: markup that explains the picture, under the controls.
        media: markup of the element with the id `song`, which then drives the clock.

    Raises:
        UserError: the file cannot be written.
    """
    resources = files(__package__)
    parts = {
        "@DATA@": script_safe_json(body_data() | data),
        "@SCRIPT@": "\n".join(resources.joinpath(n).read_text("utf-8") for n in SCRIPTS),
        "@HINT@": hint,
        "@SONG@": media,
    }
    page = resources.joinpath("preview.html").read_text("utf-8")
    # In one pass, so that a prompt that holds a mark is not filled in itself.
    write_text(Path(path), re.sub("|".join(parts), lambda mark: parts[mark[0]], page))
    return Path(path)


def script_safe_json(value: Any) -> str:
    """JSON that may stand in a `<script>` element: ASCII, and `<`, `>`, `&` only as escapes."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return re.sub("[<>&]", lambda sign: f"\\u{ord(sign[0]):04x}", text)


@lru_cache(maxsize=1)
def body_data() -> dict[str, Any]:
    """What all motions share: skeleton, mesh, limbs for browsers without WebGL, colours."""
    body, skeleton = mannequin(), canonical_skeleton()
    return {
        "skeleton": {
            "parents": list(skeleton.parents),
            "offsets": skeleton.offsets.astype(float).round(6).tolist(),
            "rest": body.rest.astype(float).round(6).tolist(),
            "sides": [_SIDES[side] for side in JOINT_SIDES],
            "feet": FOOT_JOINTS,
        },
        "mesh": {
            "positions": base64_array(body.vertices / MESH_UNIT, "<i2"),
            "normals": base64_array(body.normals * 127, "i1"),
            "joints": base64_array(body.joints, "u1"),
            "weights": base64_array(whole_shares(body.weights, 255), "u1"),
            "triangles": base64_array(body.triangles, "<u2"),
        },
        "cones": [[part.joint, part.start, part.end, *part.radii] for part in BODY],
        "colours": COLOURS | {"contact": CONTACT},
    }


def motion_data(motion: Motion) -> dict[str, Any]:
    """What the viewer needs of one motion; joints that never turn are stored once."""
    norms = np.linalg.norm(motion.quaternions, axis=-1, keepdims=True)
    quaternions = np.rint(motion.quaternions / norms * QUATERNION_UNIT)
    turning = np.flatnonzero((quaternions != quaternions[:1]).any((0, 2)))
    return {
        "text": motion.text,
        "fps": float(motion.fps),
        "frames": motion.num_frames,
        "turning": turning.tolist(),
        "quaternions": base64_array(quaternions[:, turning], "<i2"),
        "still": base64_array(quaternions[0], "<i2"),
        "root": base64_array(motion.root_position, "<f4"),
        "contacts": base64_array(np.clip(motion.contacts, 0, 1) * 255, "u1"),
    }


def base64_array(values: np.ndarray, kind: str) -> str:
    """Values as a little-endian type, rounded where that is an integer, in base64."""
    rounded = values if kind == "<f4" else np.rint(values)
    return base64.b64encode(np.ascontiguousarray(rounded.astype(kind)).tobytes()).decode()


# Largest file in bytes that goes in as it is; lossless ones are encoded sooner.
KEEP = {"OGG": 40_000_000, "MP3": 40_000_000, "FLAC": 8_000_000, "WAV": 3_000_000}
TYPES = {"OGG": "audio/ogg", "MP3": "audio/mpeg", "FLAC": "audio/flac", "WAV": "audio/wav"}
WAV_KINDS = ("PCM_U8", "PCM_16", "PCM_24", "FLOAT")  # what browsers read of WAV
VORBIS_RATE = 48_000  # samples a second, at most; ours are 44.1 kHz
SPARE = 1.0  # seconds that a song may go on after the motion before it is cut
BLOCK = 65_536  # samples; the encoder of some libsndfile versions overflows on long ones


_begun: dict[tuple[Path, float], Future[str]] = {}  # of songs and seconds, by `begin_song_uri`


def begin_song_uri(path: Path, seconds: float) -> None:
    """Begin with what `song_uri` will be asked for, beside whatever is done until then; who ends
    the program sooner does not wait for it."""
    begun = _begun[path, seconds] = Future()

    def encode() -> None:
        try:
            begun.set_result(_song_uri(path, seconds))
        except BaseException as error:
            begun.set_exception(error)

    Thread(target=encode, daemon=True).start()


def song_uri(path: str | Path, seconds: float) -> str:
    """The first `seconds` of a song as a `data:` URI that browsers play.

    Raises:
        UserError: the file is missing or no sound that can be read.
    """
    begun = _begun.pop((Path(path), seconds), None)
    return _song_uri(Path(path), seconds) if begun is None else begun.result()


def _song_uri(path: Path, seconds: float) -> str:
    try:
        sound = SoundReader(path)
        if path.stat().st_size <= KEEP.get(sound.format, 0) and _plays(sound, seconds + SPARE):
            return _uri(TYPES[sound.format], path.read_bytes())
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror}; name a sound file") from error
    return _uri("audio/ogg", _vorbis(SoundReader(path), seconds + SPARE))


def _plays(sound: SoundReader, longest: float) -> bool:
    """Is it sound to the end, and no longer than so many seconds? Only reading it tells."""
    if (sound.format == "WAV" and sound.subtype not in WAV_KINDS) or sound.claimed > longest:
        return False
    for _ in sound.blocks(BLOCK):
        if sound.seconds > longest:
            return False
    return not list(sound.notes())


def _vorbis(song: SoundReader, longest: float) -> bytes:
    """The beginning of a song as Ogg Vorbis, block by block; more than two channels become one."""
    import soundfile

    stream = io.BytesIO()
    step = -(-song.rate // VORBIS_RATE)  # 96 or 192 kHz: every second or fourth sample
    channels = song.channels if song.channels <= 2 else 1
    with soundfile.SoundFile(
        stream, "w", song.rate // step, channels, "VORBIS", format="OGG"
    ) as out:
        for block in song.beginning(longest, BLOCK * step):
            whole = len(block) // step * step
            out.write(block[:whole].reshape(-1, step, channels).mean(1).clip(-1, 1))
    return stream.getvalue()


def _uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


MUSIC_HINT = """The path has the colours of the bar and a dot at each beat; the dial's hand goes
    round once a bar and its hub lights up at the beats;"""
BEATLESS_HINT = """No beat was found in the song: the motion keeps its own time."""
PATH_HINT = """the bars are the style, the strip is the speed. Only the pelvis is generated: the
    rest of the body stands in."""
BODY_HINT = """the bars are the path's style, the strip is the mean speed of all joints. A foot on
    the ground turns green."""
STAGE_HINT = """The stage is seen from the front. The dial's hand goes round once a bar; the strip
    is the mean speed of all joints. A foot on the ground turns green."""
FIGURES_HINT = "Dial and strip count the figures, which are named below: click one to see it."
TOP_SPEED = 65.0  # m/s; the page stores 16-bit millimetres a second


def write_trajectory_html(
    trajectories: Sequence[MotionTrajectory] | MotionTrajectory,
    path: str | Path,
    song: SongTrack | None = None,
    titles: Sequence[str] = (),
    bodies: Sequence[Motion] = (),
    figures: Sequence[Sequence[Danced] | None] = (),
) -> Path:
    """Write one self-contained page; titles are captions and cannot act as markup.

    Args:
        trajectories: one or several for the same song.
        song: its file is put into the page, cut to the longest trajectory.
        titles: one caption a trajectory; a body's own text where there is none.
        bodies: one a trajectory, frame by frame on it; none = the proxy body.
        figures: of each body what it dances on a stage; None = it follows a path.

    Raises:
        UserError: no trajectory, a song that cannot be read, or the page cannot be written.
    """
    shown = [trajectories] if isinstance(trajectories, MotionTrajectory) else list(trajectories)
    if not shown:
        raise UserError(f"cannot write {path}: there is no trajectory to show; give one")
    song = song or SongTrack()
    media = ""
    if song.path is not None:
        uri = song_uri(song.path, max(trajectory.seconds for trajectory in shown))
        media = f'<audio id="song" preload="auto" src="{html.escape(uri)}"></audio>'
    cards = [
        _card(trajectory, body, song, title, danced)
        for trajectory, body, title, danced in zip_longest(shown, bodies, titles, figures)
    ]
    colours = [PATH] if song.beatless else phase_palette()
    palette = ["#" + bytes(colour).hex() for colour in colours]
    data = {"motions": cards, "palette": palette, "pairs": PAIRS}
    hint = BEATLESS_HINT if song.beatless else MUSIC_HINT
    hint = f"{hint} {BODY_HINT if bodies else PATH_HINT}"
    if figures and all(danced is not None for danced in figures):
        hint = f"{STAGE_HINT} {FIGURES_HINT if any(figures) else ''}"
    return write_page(data, path, hint=hint, media=media)


def _card(
    trajectory: MotionTrajectory,
    body: Motion | None,
    song: SongTrack,
    title: str | None,
    figures: Sequence[Danced] | None,
) -> dict[str, Any]:
    """The motion of a body, or of the proxy body, and what dial, path and strip show."""
    card = motion_data(body or proxy_body(trajectory, title or ""))
    card |= {"text": title} if title else {}
    if figures is not None:
        card["figures"] = [figure.told() | {"times": figure.times} for figure in figures]
    marks = beat_marks(trajectory, song)
    if not len(marks.times) and np.ptp(trajectory.phase) == 0:
        return card  # no music: no dial
    speed = _mean_speed(body) if body else np.linalg.norm(trajectory.velocity, axis=-1)  # [T] m/s
    return card | {
        "meter": 0 if song.beatless else marks.meter,  # 0: no dial
        "beats": base64_array(marks.times, "<f4"),
        "downbeat": base64_array(marks.downbeat, "u1"),
        "phase": base64_array(np.floor(trajectory.phase.astype(np.float64) * 65536), "<u2"),
        "speed": base64_array(np.clip(speed, 0, TOP_SPEED) * 1000, "<u2"),
        "style": base64_array(style_values(trajectory.style) * 255, "u1"),
    }


def _mean_speed(body: Motion) -> np.ndarray:
    """Of all joints [T] in m/s, forward differences; what motion beats are found in."""
    steps = np.diff(body.positions(), axis=0) * body.fps
    mean = np.linalg.norm(steps, axis=-1).mean(1)
    return np.pad(mean, (0, 1), mode="edge") if len(mean) else np.zeros(body.num_frames)
