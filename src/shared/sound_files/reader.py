"""Sound files read block by block, damaged ones as far as they go, and what was wrong with them.

Analysis and previews read songs by this alone: what is seen to move to is what is heard.
"""

import contextlib
import os
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..errors import UserError
from .mp3 import with_length

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
        """What was mended.

        Raises:
            UserError: no sample was sound.
        """
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

        class ForwardOnly(soundfile.SoundFile):
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
        if (
            self.claimed > MAX_SECONDS
        ):  # before anything is decoded; `blocks` counts what is not told
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

    def notes(self) -> Iterator[str]:
        """What was wrong with the file, once it is read.

        Raises:
            UserError: no sample was sound.
        """
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
        raise UserError(f"{path} does not exist; name a sound file ({FORMATS})") from None
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
