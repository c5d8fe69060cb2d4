"""A song inside a page: its own bytes where browsers play them, otherwise Ogg Vorbis."""

import base64
import io
from pathlib import Path

from src.shared.errors import UserError

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
    import soundfile

    path = Path(path)
    try:
        info = soundfile.info(path)
        fits = info.duration <= seconds + SPARE and path.stat().st_size <= KEEP.get(info.format, 0)
        if fits and (info.format != "WAV" or info.subtype in WAV_KINDS):
            return _uri(TYPES[info.format], path.read_bytes())
        return _uri("audio/ogg", _vorbis(path, seconds))
    except (OSError, soundfile.SoundFileError) as error:
        raise UserError(f"{path}: the song cannot be put into the page: {error}") from error


def _vorbis(path: Path, seconds: float) -> bytes:
    """The beginning of a song as Ogg Vorbis, block by block; more than two channels become one."""
    import soundfile

    stream = io.BytesIO()
    with soundfile.SoundFile(path) as song:
        step = -(-song.samplerate // VORBIS_RATE)  # 96 or 192 kHz: every second or fourth sample
        channels = min(song.channels, 2) if song.channels <= 2 else 1
        left = round((seconds + SPARE) * song.samplerate)
        with soundfile.SoundFile(
            stream, "w", song.samplerate // step, channels, "VORBIS", format="OGG"
        ) as out:
            while left > 0:
                block = song.read(min(BLOCK * step, left), dtype="float32", always_2d=True)
                if not len(block):
                    break
                left -= len(block)
                if song.channels > 2:
                    block = block.mean(1, keepdims=True)
                whole = len(block) // step * step
                out.write(block[:whole].reshape(-1, step, channels).mean(1).clip(-1, 1))
    return stream.getvalue()


def _uri(kind: str, data: bytes) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"
