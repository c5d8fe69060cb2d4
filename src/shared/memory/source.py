"""The phrases of a prepared audio folder, with their bodies, cut at bars.

Letters: C = 163 or 167 rows of sound, T frames.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from ..data.phrases.dataset import read_phrase
from ..data.phrases.layout import MANIFEST, BadContent, PhraseRecord
from ..data.phrases.store import Backoff, PhraseStore, Remote, Unreachable
from ..errors import UserError
from ..io.files import parse_json
from ..motion.features import LEFT_CONTACT, ROOT_ROW
from ..motion.trajectory import FPS
from ..motion.window import encode_window, place_window
from .index import MemoryConfig
from .phrases import cut_at_bars
from .priors import prior_curves

ONSETS = 162  # row of a condition
MAX_BAD_FRACTION = 0.05  # ruling 17
AGAIN = "run prepare-audio again into the same folder: it adds what is missing"

Progress = Callable[[int, int], None]  # (phrases done, phrases in all)


@dataclass(frozen=True, eq=False)
class Piece:
    """A phrase of the memory before it has keys.

    Attributes:
        id, song, caption, clip, tempo, trajectory, priors: as in `Phrase`.
        audio: condition [C,T].
        body: raw features [T,23,6].
    """

    id: str
    song: str
    caption: str
    clip: str
    tempo: float
    trajectory: np.ndarray
    priors: np.ndarray
    audio: np.ndarray
    body: np.ndarray


class Source:
    """The phrases of one split of a prepared audio folder.

    Attributes:
        records: with bodies.
        bad: phrases that could not be used, with the reason.

    Raises:
        UserError: nothing there, no phrases of the split, or phrases without bodies.
    """

    def __init__(self, root: str, split: str) -> None:
        self.root = root
        remote = Remote(root, backoff=Backoff())
        self.store = PhraseStore(remote, None)
        everything = remote.phrases()
        self.records = [record for record in everything if record.split == split]
        self.bad: dict[str, str] = {}
        if not self.records:
            splits = ", ".join(sorted({record.split for record in everything})) or "none"
            raise UserError(f"{root} has no phrases of split {split!r}; there are: {splits}")
        bare = [record.id for record in self.records if record.body is None]
        if bare:
            raise UserError(
                f"{root}: {len(bare)} of {len(self.records)} phrases have no body.npz (e.g."
                f" {bare[0]}), which a memory of motion needs; {AGAIN}"
            )
        self._pairs = _pairs(remote)
        self._captions = {
            _longest(self._pairs[record.id]): record.caption
            for record in everything
            if record.id in self._pairs and record.caption
        }

    def pieces(
        self, config: MemoryConfig, progress: Progress, *, first: int = 0, last: int | None = None
    ) -> Iterator[Piece]:
        """The phrases from `first` to before `last`, cut at bars.

        Raises:
            UserError: too many are bad.
        """
        for done, record in enumerate(self.records[first:last], first + 1):
            try:
                yield from self._cut(record, config)
            except (BadContent, Unreachable) as error:
                self._leave_out(record, str(error))
            progress(done, len(self.records))

    def _leave_out(self, record: PhraseRecord, reason: str) -> None:
        self.bad[record.id] = reason
        if len(self.bad) > MAX_BAD_FRACTION * len(self.records):
            named = "; ".join(f"{name}: {why}" for name, why in islice(self.bad.items(), 3))
            raise UserError(
                f"{self.root}: more than {MAX_BAD_FRACTION:.0%} of {len(self.records)} phrases"
                f" cannot be used ({named}); {AGAIN}; prepare the data again"
            )

    def _cut(self, record: PhraseRecord, config: MemoryConfig) -> Iterator[Piece]:
        phrase = read_phrase(self.store, record, beat_phase=True, body=True)
        trajectory, phase, audio = phrase.trajectory, phrase.phase, phrase.audio
        assert phrase.body is not None  # `bare` phrases were refused
        body = phrase.body.astype(np.float32)
        contacts = body[:, ROOT_ROW, LEFT_CONTACT:]
        priors = prior_curves(trajectory, onsets=audio[ONSETS], contacts=contacts)
        for start, stop in cut_at_bars(phase, bars=config.bars, min_frames=config.min_frames):
            part = slice(start, stop)
            window = encode_window(trajectory[part], phase[part])
            clip = self._clip(record.id, start, stop)
            yield Piece(
                id=f"{record.id}/{start:04d}",
                song=record.song or record.id,
                caption=self._captions.get(clip, "") if clip else record.caption,
                clip=clip,
                tempo=record.tempo,
                trajectory=place_window(window, phase=phase[start]),
                priors=priors[:, part],
                audio=audio[:, part],
                body=body[part],
            )

    def _clip(self, phrase: str, start: int, stop: int) -> str:
        """The clip that most frames of a phrase show; "" if the data does not tell."""
        from ..data.pairing.phrase_motion import read_pair

        if phrase not in self._pairs:
            return ""
        pieces, warp = read_pair(self._pairs[phrase])
        shown = np.rint(warp.times(np.arange(start, stop) / FPS) * FPS)
        places = np.searchsorted([piece.at for piece in pieces], shown, side="right") - 1
        return Counter(pieces[n].clip for n in places.clip(0).tolist()).most_common(1)[0][0]


def _pairs(remote: Remote) -> dict[str, dict[str, Any]]:
    """What the manifest says of the clips behind each phrase, if it does."""
    try:
        phrases = parse_json(remote.read(MANIFEST))["phrases"]
    except FileNotFoundError:
        return {}
    return {phrase["id"]: phrase["pair"] for phrase in phrases if "pair" in phrase}


def _longest(pair: dict[str, Any]) -> str:
    """The clip that a phrase's caption tells of."""
    return str(max(pair["pieces"], key=lambda piece: piece["last"] - piece["first"])["clip"])
