"""A body that goes on moving while sentences come in: frames at their time, to whoever listens.

Windows are given out in short pieces just before they are due, so that a sentence is soon seen: it
waits for the piece that is being given out, and for the frames that the foot lock looks ahead. The
rest of the window, made for the sentence before, is dropped.

Frames are told as lines of JSON, or by the VMC protocol over OSC (protocol.vmc.info, "Marionette to
Performer"): one bundle a frame with the root, the bones by their Unity names, and the time. Unity
is left-handed with +X to the right of who faces +Z; here +X is the left, so x changes its sign, and
with it the turns about y and z.
"""

import json
import queue
import struct
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import UsageError
from ..formats.rig import SCHEMES
from ..model.diffusion import Sampling
from ..motion.motion import Motion, in_place
from ..motion.skeleton import canonical_skeleton
from .motion_generator import MotionGenerator
from .stream import DEFAULT_SAMPLING

WINDOW = 0.5  # seconds after which another sentence may begin
AHEAD = 1.0  # seconds made beyond them, to be gone on with while none comes
WAITING = 8  # frames that are made before they are due
_OSC_AT_ONCE = (1).to_bytes(8, "big")  # the time tag that means now


@dataclass(frozen=True, eq=False)
class Frame:
    """One moment of a body.

    Attributes:
        number: counted from 0.
        seconds: from the first frame.
        text: what it shows.
        root: world position of the pelvis [3], metres.
        quaternions: local rotations [22,4], w x y z; the pelvis' in the world.
        contacts: left and right foot on the ground [2].
    """

    number: int
    seconds: float
    text: str
    root: np.ndarray
    quaternions: np.ndarray
    contacts: np.ndarray


Sink = Callable[[Frame], None]


@dataclass
class LiveFigures:
    """How it went.

    Attributes:
        frames: given out.
        busy: seconds of computing.
        fps: of the frames.
        latencies: seconds from each sentence to the first frame that shows it.
    """

    frames: int = 0
    busy: float = 0.0
    fps: float = 30.0
    latencies: list[float] = field(default_factory=list)

    @property
    def speed(self) -> float:
        """Seconds of motion made in a second of computing."""
        return self.frames / self.fps / self.busy if self.busy else 0.0


class LiveBody:
    """Frames until it is told to stop.

    Args:
        generator: its text model.
        text: the first sentence.
        sampling: seed, steps, sampler, guidance.
        window: seconds after which another sentence may begin.
        foot_lock: hold standing feet; None = the model's own setting. Without it, frames settle
            0.9 s sooner.
        real_time: frames come when they are due; False: as soon as they are made.
        in_place: the body stays over the middle.
    """

    def __init__(
        self,
        generator: MotionGenerator,
        text: str,
        *,
        sampling: Sampling = DEFAULT_SAMPLING,
        window: float = WINDOW,
        foot_lock: bool | None = None,
        real_time: bool = True,
        in_place: bool = False,
    ) -> None:
        self.fps = generator.text.card.fps
        self.figures = LiveFigures(fps=self.fps)
        self._stream = generator.stream(
            text, seconds=window, ahead=AHEAD, sampling=sampling, foot_lock=foot_lock
        )
        self._real_time, self._in_place = real_time, in_place
        self._said: dict[str, float] = {}  # sentences not yet seen, and when they came
        self._ended = threading.Event()
        self._limit: int | None = None

    def say(self, text: str) -> None:
        """What is shown as soon as possible.

        Raises:
            UsageError: no text.
        """
        self._stream.say(text)
        self._said[text] = time.perf_counter()

    def wait(self, seconds: float) -> None:
        """Until so many seconds of motion have been given out from now on, or it has ended."""
        enough = self.figures.frames + round(seconds * self.fps)
        while self.figures.frames < enough and not self._ended.wait(0.01):
            pass

    def stop(self, seconds: float = 0.0) -> None:
        """No more frames, but for so many seconds of them."""
        self._limit = self.figures.frames + round(seconds * self.fps)

    def play(self, sinks: Sequence[Sink], *, seconds: float | None = None) -> LiveFigures:
        """Give frames to all sinks until `stop`, or for so many seconds of motion."""
        if seconds is not None:
            self._limit = round(seconds * self.fps)
        began: float | None = None
        for frame in self._frames():
            if self._limit is not None and frame.number >= self._limit:
                break
            if began is None:
                began = time.perf_counter()
            if self._real_time:
                due = began + frame.seconds - time.perf_counter()
                time.sleep(max(0.0, due))
            if (since := self._said.pop(frame.text, None)) is not None:
                self.figures.latencies.append(time.perf_counter() - since)
            for sink in sinks:
                sink(frame)
            self.figures.frames += 1
        self._ended.set()
        return self.figures

    def _frames(self) -> Iterator[Frame]:
        """Made in a thread of their own, `WAITING` of them ahead of who takes them."""
        made: queue.Queue[Frame | BaseException | None] = queue.Queue(WAITING)

        def make() -> None:
            last: BaseException | None = None
            try:
                for frame in _counted(self._timed(), self._stream.text_at, self.fps):
                    while not self._ended.is_set():
                        try:
                            made.put(frame, timeout=0.1)
                            break
                        except queue.Full:
                            continue
                    if self._ended.is_set():
                        return
            except BaseException as error:
                last = error
            made.put(last)

        threading.Thread(target=make, daemon=True).start()
        while not self._ended.is_set():
            try:
                frame = made.get(timeout=0.1)
            except queue.Empty:
                continue
            if isinstance(frame, BaseException):
                raise frame
            if frame is None:
                return
            yield frame

    def _timed(self) -> Iterator[Motion]:
        """Pieces, while the time that they take is counted."""
        pieces = iter(self._stream)
        while True:
            started = time.perf_counter()
            piece = next(pieces, None)
            self.figures.busy += time.perf_counter() - started
            if piece is None:
                return
            yield in_place(piece) if self._in_place else piece


def _counted(
    pieces: Iterator[Motion], text_at: Callable[[int], str], fps: float
) -> Iterator[Frame]:
    number = 0
    for piece in pieces:
        rows: Any = zip(piece.root_position, piece.quaternions, piece.contacts, strict=True)
        for root, quaternions, contacts in rows:
            yield Frame(number, number / fps, text_at(number), root, quaternions, contacts)
            number += 1


def parse_address(text: str, port: int) -> tuple[str, int]:
    """Host and port of "HOST", "PORT" or "HOST:PORT".

    Raises:
        UsageError: it is none of them.
    """
    host, _, number = text.rpartition(":")
    if text and not host and not number.isdigit():
        host, number = text, str(port)
    if not number.isdigit() or not 0 < int(number) < 65536:
        raise UsageError(f"{text!r} is no address; give HOST, PORT or HOST:PORT")
    return host or "127.0.0.1", int(number)


def json_line(frame: Frame) -> str:
    """One line, without its end."""
    numbers = {
        "root": frame.root.round(5).tolist(),
        "rotations": frame.quaternions.round(6).tolist(),
        "contacts": frame.contacts.round(3).tolist(),
    }
    head = {"frame": frame.number, "time": round(frame.seconds, 4), "text": frame.text}
    return json.dumps(head | numbers, ensure_ascii=False)


def vmc_bundle(frame: Frame) -> bytes:
    """An OSC bundle: root at the origin, bones in their parents, the pelvis in the world."""
    offsets = canonical_skeleton().offsets.copy()
    offsets[0] = frame.root
    messages = [_message("/VMC/Ext/Root/Pos", "root", *(0.0,) * 6, 1.0)]
    for name, offset, turn in zip(SCHEMES["unity"], offsets, frame.quaternions, strict=True):
        (x, y, z), (w, i, j, k) = offset.tolist(), turn.tolist()
        messages.append(_message("/VMC/Ext/Bone/Pos", name, -x, y, z, i, -j, -k, w))
    messages.append(_message("/VMC/Ext/OK", 1))
    messages.append(_message("/VMC/Ext/T", float(frame.seconds)))
    sized = (struct.pack(">i", len(message)) + message for message in messages)
    return _padded(b"#bundle") + _OSC_AT_ONCE + b"".join(sized)


def _message(address: str, *values: str | int | float) -> bytes:
    kinds = "".join({str: "s", int: "i", float: "f"}[type(value)] for value in values)
    parts = [_padded(address.encode()), _padded(f",{kinds}".encode())]
    for value in values:
        if isinstance(value, str):
            parts.append(_padded(value.encode()))
        else:
            parts.append(struct.pack(">i" if isinstance(value, int) else ">f", value))
    return b"".join(parts)


def _padded(text: bytes) -> bytes:
    """With a zero, and more up to a multiple of four."""
    return text + b"\0" * (4 - len(text) % 4)
