"""Lengths of mp3 files without a length tag, which decoders guess, and then stop there.

libsndfile takes the length from the Xing tag in the first frame. Without one it guesses from the
first frame's bit rate: wrong where the rate varies. Here the frames are counted and a tag is made.
Frame headers: ISO/IEC 11172-3 and 13818-3, layer III, and the unofficial MPEG 2.5.
"""

import io
import mmap
import struct
from dataclasses import dataclass
from pathlib import Path

KILOBITS = (
    (0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 0),  # MPEG 1
    (0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160, 0),  # MPEG 2 and 2.5
)
RATES = {3: (44_100, 48_000, 32_000), 2: (22_050, 24_000, 16_000), 0: (11_025, 12_000, 8_000)}
LAYER_3, MONO = 1, 3
TAGS = (b"Xing", b"Info", b"VBRI")
VBRI_OFFSET = 36


@dataclass(frozen=True)
class FrameHeader:
    """What the four bytes before a frame say: its size and where its tag would stand, in bytes."""

    size: int
    tag_offset: int


def with_length(path: Path) -> io.BytesIO | None:
    """The file with a length tag before it, or None where it is no mp3 or has one."""
    if not path.stat().st_size:
        return None
    with (
        path.open("rb") as stream,
        mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data,
    ):
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
    if version not in RATES or layer != LAYER_3 or rate == 3 or bits in (0, 15):
        return None
    first = version == 3
    mono = word[3] >> 6 == MONO
    kilobits = KILOBITS[0 if first else 1][bits]
    size = (144 if first else 72) * kilobits * 1000 // RATES[version][rate] + (word[2] >> 1 & 1)
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
