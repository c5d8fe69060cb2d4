"""A song inside a page: its own bytes where browsers play them, otherwise Ogg Vorbis.

A damaged file is encoded anew from what could be read of it: a browser would leave gaps open that
the analysis closed, and sound and motion would run apart.
"""

import base64
import io
from pathlib import Path

from ..errors import UserError
from ..sound_files.reader import SoundReader

# Largest file in bytes that goes in as it is; lossless ones are encoded sooner.
KEEP = {"OGG": 40_000_000, "MP3": 40_000_000, "FLAC": 8_000_000, "WAV": 3_000_000}
TYPES = {"OGG": "audio/ogg", "MP3": "audio/mpeg", "FLAC": "audio/flac", "WAV": "audio/wav"}
WAV_KINDS = ("PCM_U8", "PCM_16", "PCM_24", "FLOAT")  # what browsers read of WAV
VORBIS_RATE = 48_000  # samples a second, at most; ours are 44.1 kHz
SPARE = 1.0  # seconds that a song may go on after the motion before it is cut
BLOCK = 65_536  # samples; the encoder of some libsndfile versions overflows on long ones


def song_uri(path: str | Path, seconds: float) -> str:
    """The first `seconds` of a song as a `data:` URI that browsers play.

    Raises:
        UserError: the file is missing or no sound that can be read.
    """
    path = Path(path)
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
    left = round(longest * song.rate)
    with soundfile.SoundFile(
        stream, "w", song.rate // step, channels, "VORBIS", format="OGG"
    ) as out:
        for block in song.blocks(BLOCK * step):
            block = block[:left]
            left -= len(block)
            if song.channels > 2:
                block = block.mean(1, keepdims=True)
            whole = len(block) // step * step
            out.write(block[:whole].reshape(-1, step, channels).mean(1).clip(-1, 1))
            if not left:
                break
    return stream.getvalue()


def _uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"
