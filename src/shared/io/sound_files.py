"""Sound files read block by block, damaged ones as far as they go, and what was wrong with them.

Analysis and previews read songs by this alone: what is seen to move to is what is heard. Of an mp3
without a length tag libsndfile guesses the length from the first frame's bit rate, wrong where the
rate varies, and stops there: here the frames are counted and a tag is made. Frame headers: ISO/IEC
11172-3 and 13818-3, layer III, and the unofficial MPEG 2.5.
"""

import contextlib
import io
import mmap
import os
import struct
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..errors import UsageError, UserError

KILOBITS = (
    (0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 0),  # MPEG 1
    (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160, 0),  # MPEG 2 and 2.5
)
MP3_RATES = {3: (44_100, 48_000, 32_000), 2: (22_050, 24_000, 16_000), 0: (11_025, 12_000, 8_000)}
LAYER_3, MONO = 1, 3
TAGS = (b"Xing", b"Info", b"VBRI")
VBRI_OFFSET = 36


class FrameHeader(NamedTuple):
    """What the four bytes before a frame say: its size and where its tag would stand, in bytes."""

    size: int
    tag_offset: int


def with_length(path: Path) -> io.BytesIO | None:
    """The file with a length tag before it, or None where it is no mp3 or has one."""
    if not path.stat().st_size:
        return None
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if data[:4] in (b"RIFF", b"OggS", b"fLaC", b"FORM", b"RF64"):
            return None
        start = _first_frame(data)
        if start is None:
            return None
        header = parse_header(data[start : start + 4])
        assert header is not None
        first = data[start : start + header.size]
        if any(tag in first[: VBRI_OFFSET + 4] for tag in TAGS):
            return None
        tag = _tag(data[start : start + 4], header, count_frames(data, start))
        return io.BytesIO(tag + data[start:])


def parse_header(word: bytes) -> FrameHeader | None:
    """Read the header of a layer III frame; None if the four bytes are none."""
    if len(word) < 4 or word[0] != 0xFF or word[1] & 0xE0 != 0xE0:
        return None
    version, layer = word[1] >> 3 & 3, word[1] >> 1 & 3
    bits, rate = word[2] >> 4, word[2] >> 2 & 3
    if version not in MP3_RATES or layer != LAYER_3 or rate == 3 or bits in (0, 15):
        return None
    first = version == 3
    mono = word[3] >> 6 == MONO
    kilobits = KILOBITS[0 if first else 1][bits]
    size = (144 if first else 72) * kilobits * 1000 // MP3_RATES[version][rate] + (word[2] >> 1 & 1)
    side = (17 if mono else 32) if first else (9 if mono else 17)
    return FrameHeader(size, 4 + side)


def count_frames(data: bytes | mmap.mmap, start: int) -> int:
    """How many frames follow from `start` on; damage between them is skipped."""
    count, at = 0, start
    while at < len(data):
        if header := parse_header(data[at : at + 4]):
            count, at = count + 1, at + header.size
        else:
            at = data.find(b"\xff", at + 1)
            if at < 0:
                break
    return count


def _first_frame(data: bytes | mmap.mmap) -> int | None:
    """Where the first frame starts that another one follows; near the beginning, or none."""
    at = 0
    if data[:3] == b"ID3":
        size = 0
        for byte in data[6:10]:  # seven bits a byte
            size = size << 7 | byte & 0x7F
        at = 10 + size
    end = at + 8192
    while 0 <= at < min(end, len(data)):
        header = parse_header(data[at : at + 4])
        if header and parse_header(data[at + header.size : at + header.size + 4]):
            return at
        at = data.find(b"\xff", at + 1)
    return None


def _tag(word: bytes, header: FrameHeader, count: int) -> bytes:
    """A silent frame that carries a Xing tag with the number of frames."""
    # No checksum, no padding: the tag then stands where decoders look for it.
    plain = bytes([word[0], word[1] | 1, word[2] & ~2, word[3]])
    parsed = parse_header(plain)
    assert parsed is not None
    frame = plain + bytes(header.tag_offset - 4) + b"Xing" + struct.pack(">II", 1, count)
    return frame.ljust(parsed.size, b"\0")


# ---------------------------------------------------------------- reading

MAX_SECONDS = 7200.0
RATES = (4_000, 768_000)  # Hz
LOUDEST = 1e6  # full scale is 1; beyond this a float file holds garbage
BLOCK = 4096  # samples
UNKNOWN = 2**48  # libsndfile's "very many" samples, of a stream without a length
FORMATS = "wav, flac, ogg or mp3"


def too_long(path: Path, seconds: float) -> UserError:
    """What to say of a sound longer than `MAX_SECONDS`."""
    return UserError(
        f"{path} lasts {seconds / 60:.0f} minutes;"
        f" at most {MAX_SECONDS / 60:.0f} can be read: cut it"
    )


class Mender:
    """Silences samples that are no sound, and counts them."""

    def __init__(self) -> None:
        self.seen = self.mended = 0

    def mend(self, samples: np.ndarray) -> np.ndarray:
        """[s,channels], any of them NaN, infinite or garbage -> the same, finite."""
        good = np.abs(samples) <= LOUDEST  # NaN compares false
        self.seen += samples.size
        if good.all():
            return samples
        self.mended += int(samples.size - good.sum())
        return np.where(good, samples, np.float32(0))

    def notes(self, path: Path) -> Iterator[str]:
        """What was mended; raises UserError where no sample was sound."""
        if self.mended and self.mended == self.seen:
            raise UserError(f"{path} holds no sample that is finite and in range; export it again")
        if self.mended:
            share = self.mended / self.seen
            yield (
                f"{self.mended} samples ({share:.2%}) are not finite or far out of range,"
                " silence instead"
            )


class SoundReader:
    """Decodes one file once, from its start; samples that are no sound become silence.

    Args:
        path: a file that libsndfile reads.

    Attributes:
        rate: samples a second.
        channels: how many.
        format, subtype: libsndfile's names, such as WAV and PCM_16.
        claimed: seconds that the file says it has; 0 where it does not say.

    Raises:
        UserError: missing, no sound file, of a rate that is none, or longer than 2 h by its header.
    """

    def __init__(self, path: Path) -> None:
        import soundfile

        class ForwardOnly(soundfile.SoundFile):  # type: ignore[misc]  # without stubs
            """Without soundfile's seek after each read, which loses samples of an mp3."""

            def seekable(self) -> bool:
                return False

        self.path = path
        self._failure = (soundfile.SoundFileError, RuntimeError)
        self._broke = False
        self._cut = _cut_off(path)
        try:
            with _quiet():
                self._file = ForwardOnly(with_length(path) or path)
        except (*self._failure, TypeError) as error:  # TypeError: headerless formats, by suffix
            raise UserError(
                f"{path} is no sound file that can be read, or its start is damaged;"
                f" convert it to {FORMATS}"
            ) from error
        self.rate: int = self._file.samplerate
        self.channels: int = self._file.channels
        self.format: str = self._file.format
        self.subtype: str = self._file.subtype
        frames = self._file.frames
        self.claimed = frames / self.rate if frames < UNKNOWN else 0.0
        self._got = 0
        if not RATES[0] <= self.rate <= RATES[1]:
            self._file.close()
            raise UserError(f"{path} has {self.rate} samples a second; convert it to 44100")
        if self.claimed > MAX_SECONDS:  # before anything is decoded; `blocks` counts the untold
            self._file.close()
            raise too_long(path, self.claimed)
        self._mender = Mender()

    @property
    def seconds(self) -> float:
        """What was read so far."""
        return self._got / self.rate

    def blocks(self, count: int) -> Iterator[np.ndarray]:
        """Yield [s,channels] float32 until the file ends or breaks; s < `count` only then.

        Raises:
            UserError: longer than 2 h.
        """
        with self._file:
            while len(samples := self._read(count)):
                self._got += len(samples)
                if self.seconds > MAX_SECONDS:
                    raise too_long(self.path, max(self.seconds, self.claimed))
                yield self._mender.mend(samples)

    def beginning(self, seconds: float, count: int) -> Iterator[np.ndarray]:
        """Yield the first seconds as `blocks` does, of one or two channels: more become one; raises
        UserError as `blocks`."""
        left = round(seconds * self.rate)
        for block in self.blocks(count):
            block = block[:left]
            left -= len(block)
            yield block.mean(1, keepdims=True) if self.channels > 2 else block
            if not left:
                break

    def notes(self) -> Iterator[str]:
        """What was wrong with the file, once it is read; UserError if no sample was sound."""
        lost = self.claimed - self.seconds
        # A tenth of a second: decoders may drop a partial last block.
        if self._broke or self._cut or lost > 0.1:
            of = f" of {self.claimed:.1f}" if lost > 0.1 else ""
            yield f"cut off or damaged: {self.seconds:.1f}{of} s could be read"
        yield from self._mender.notes(self.path)

    def _read(self, count: int) -> np.ndarray:
        """The next samples [s,channels], fewer than `count` only at the end or a break."""
        blocks = [np.zeros((0, self.channels), np.float32)]
        try:
            with _quiet():  # small blocks: the one that breaks is lost
                while count > 0 and not self._broke:
                    block = self._file.read(min(count, BLOCK), dtype="float32", always_2d=True)
                    if not len(block):
                        break
                    blocks.append(block)
                    count -= len(block)
        except self._failure:
            self._broke = True
        return np.concatenate(blocks)


def _cut_off(path: Path) -> bool:
    """Does the container say that bytes are missing? libsndfile keeps quiet about wav and ogg.

    Raises:
        UserError: the file is missing, empty or not to be read.
    """
    try:
        with path.open("rb") as stream:
            head, size = stream.read(8), path.stat().st_size
            stream.seek(max(0, size - 2**17))
            tail = stream.read()
    except FileNotFoundError:
        raise UsageError(f"{path} does not exist; name a sound file ({FORMATS})") from None
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror}; name a sound file") from None
    if not size:
        raise UserError(f"{path} is empty; fetch it again")
    if head[:4] == b"RIFF":
        claimed = int.from_bytes(head[4:], "little")
        return 0 < claimed < 2**32 - 9 and size < claimed + 8 - 1
    if head[:4] == b"OggS":  # the last page is marked as such (RFC 3533, section 6)
        page = tail.rfind(b"OggS")
        return page < 0 or not tail[page + 5 : page + 6] or not tail[page + 5] & 4
    return False


_STDERR = threading.Lock()  # two threads that both save and restore would lose it


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Keep the mp3 decoder's own messages off stderr: the notes say what matters, in one line."""
    with _STDERR, contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):  # no stderr at all
            saved = os.dup(2)
            stack.callback(os.close, saved)
            stack.callback(os.dup2, saved, 2)
            nowhere = stack.enter_context(open(os.devnull, "wb"))
            os.dup2(nowhere.fileno(), 2)
        yield
