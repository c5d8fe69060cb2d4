"""Sound files of any rate and channel count become mono float32 samples at 44.1 kHz, in chunks."""

import contextlib
import hashlib
import os
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from src.shared.audio.mp3 import with_length
from src.shared.errors import UserError
from src.shared.files import sha256_file

SAMPLE_RATE = 44_100
FPS = 30
HOP = SAMPLE_RATE // FPS  # samples of a frame
MIN_SECONDS = 1.0
MAX_SECONDS = 7200.0
RATES = (4_000, 768_000)  # Hz
LOUDEST = 1e6  # full scale is 1; beyond this a float file holds garbage
CHUNK_SECONDS = 10.0
BLOCK = 4096  # samples
UNKNOWN = 2**48  # libsndfile's "very many" samples, of a stream without a length
FORMATS = "wav, flac, ogg or mp3"


@dataclass(frozen=True)
class Sound:
    """Mono sound at 44.1 kHz.

    Attributes:
        samples: [S] float32, finite; full scale is 1.
        path: where it came from.
        sha256: of the file, or of the samples where there is no file.
        notes: one line each: what was wrong and could be mended.
    """

    samples: np.ndarray
    path: Path = Path("samples")
    sha256: str = ""
    notes: tuple[str, ...] = field(default=())
    sample_rate: int = SAMPLE_RATE

    @property
    def seconds(self) -> float:
        """Duration."""
        return len(self.samples) / self.sample_rate

    @property
    def num_frames(self) -> int:
        """T, frames of a motion or of features at 30 fps."""
        return round(self.seconds * FPS)


def load_sound(path: str | Path) -> Sound:
    """Read a whole sound file; a damaged one as far as it goes, which `notes` tells.

    Raises:
        UserError: missing, no sound file, shorter than 1 s, longer than 2 h, nothing but NaN.
    """
    path = Path(path)
    reader = _Reader(path)
    samples = np.concatenate([np.zeros(0, np.float32), *reader.chunks(CHUNK_SECONDS)])
    sound = Sound(samples, path, sha256_file(path), tuple(reader.notes()))
    _check_length(sound)
    return sound


def sound_chunks(path: str | Path, seconds: float = CHUNK_SECONDS) -> Iterator[np.ndarray]:
    """Yield mono 44.1-kHz samples [S] float32, about `seconds` at a time, in bounded memory.

    Joined, the chunks are the samples of `load_sound`.

    Raises:
        UserError: missing, no sound file, longer than 2 h.
    """
    yield from _Reader(Path(path)).chunks(seconds)


def sound_from_samples(
    samples: np.ndarray, sample_rate: int = SAMPLE_RATE, *, name: str = "samples"
) -> Sound:
    """A sound out of samples [S] or [S,channels] in memory, mended and resampled like a file.

    Raises:
        UserError: shorter than 1 s, longer than 2 h, nothing but NaN.
    """
    samples = np.atleast_2d(np.asarray(samples, dtype=np.float32).T).T  # [S,channels]
    mixer = _Mixer(sample_rate)
    mono = np.concatenate([mixer.push(samples), mixer.finish()])
    digest = hashlib.sha256(mono.tobytes()).hexdigest()
    path = Path(name)
    sound = Sound(mono, path, digest, tuple(mixer.notes(path)))
    _check_length(sound)
    return sound


def _check_length(sound: Sound) -> None:
    if sound.num_frames < MIN_SECONDS * FPS:
        why = f" ({sound.notes[0]})" if sound.notes else ""
        raise UserError(
            f"{sound.path} lasts {sound.seconds:.2f} s{why}; at least {MIN_SECONDS:g} s are needed"
        )
    if sound.seconds > MAX_SECONDS:
        raise _too_long(sound.path, sound.seconds)


def _too_long(path: Path, seconds: float) -> UserError:
    return UserError(
        f"{path} lasts {seconds / 60:.0f} minutes;"
        f" at most {MAX_SECONDS / 60:.0f} can be read: cut it"
    )


class _Mixer:
    """Mends, mixes down and resamples a stream of samples, and counts what it mended."""

    def __init__(self, rate: int) -> None:
        self.seen = self.mended = 0
        self._resampler: Any = None
        if rate != SAMPLE_RATE:
            import soxr

            self._resampler = soxr.ResampleStream(rate, SAMPLE_RATE, 1, "float32", quality="HQ")

    def push(self, samples: np.ndarray) -> np.ndarray:
        """[s,channels] at the file's rate -> [S] at 44.1 kHz."""
        good = np.abs(samples) <= LOUDEST  # NaN compares false
        self.seen += samples.size
        if not good.all():
            self.mended += int(samples.size - good.sum())
            samples = np.where(good, samples, np.float32(0))
        mono = samples.mean(axis=1, dtype=np.float32)
        return mono if self._resampler is None else self._resampler.resample_chunk(mono)

    def finish(self) -> np.ndarray:
        """The samples that the resampler still holds."""
        nothing = np.zeros(0, np.float32)
        if self._resampler is None:
            return nothing
        return self._resampler.resample_chunk(nothing, last=True)

    def notes(self, path: Path) -> Iterator[str]:
        """What was mended.

        Raises:
            UserError: no sample was sound.
        """
        if self.mended and self.mended == self.seen:
            raise UserError(f"{path} holds no finite sample; export it again")
        if self.mended:
            share = self.mended / self.seen
            yield f"{self.mended} samples ({share:.2%}) are no numbers, silence instead"


class _Reader:
    """Decodes one file chunk by chunk and notices where it ends too early."""

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
        self._rate = self._file.samplerate
        frames = self._file.frames
        self._claimed = frames if frames < UNKNOWN else 0
        self._got = 0
        if not RATES[0] <= self._rate <= RATES[1]:
            self._file.close()
            raise UserError(f"{path} has {self._rate} samples a second; convert it to 44100")
        self._mixer = _Mixer(self._rate)

    def chunks(self, seconds: float) -> Iterator[np.ndarray]:
        """Yield [S] float32 at 44.1 kHz until the file ends or breaks."""
        count = max(1, round(seconds * self._rate))
        try:
            while len(samples := self._read(count)):
                self._got += len(samples)
                if self._got > MAX_SECONDS * self._rate:
                    raise _too_long(self.path, max(self._got, self._claimed) / self._rate)
                if len(mono := self._mixer.push(samples)):
                    yield mono
            if len(mono := self._mixer.finish()):
                yield mono
        finally:
            self._file.close()

    def notes(self) -> Iterator[str]:
        """What was wrong with the file, once it is read."""
        got, claimed = self._got / self._rate, self._claimed / self._rate
        # A tenth of a second: decoders may drop a partial last block.
        if self._broke or self._cut or claimed - got > 0.1:
            of = f" of {claimed:.1f}" if claimed - got > 0.1 else ""
            yield f"cut off or damaged: {got:.1f}{of} s could be read"
        yield from self._mixer.notes(self.path)

    def _read(self, count: int) -> np.ndarray:
        """The next samples [s,channels], fewer than `count` only at the end or a break."""
        blocks = [np.zeros((0, self._file.channels), np.float32)]
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
