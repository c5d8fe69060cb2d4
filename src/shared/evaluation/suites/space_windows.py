"""Windows of paired phrases, a few bars each: sound, the body that moves to it, and their kin.

Letters: B windows, C = 167 rows of sound, T frames, D embed dim.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from ...data.phrases.dataset import MotionPhraseDataset
from ...data.phrases.layout import PhraseRecord
from ...memory.build import cut_at_bars
from ...model.audio.conditioning import BEAT, with_phase_rows
from ...motion.features import FORWARD, LATERAL, ROOT_ROW, YAW_RATE

Embed = Callable[[Tensor, Tensor], Tensor]

BATCH = 64


@dataclass(frozen=True, eq=False)
class Window:
    """A few bars of a phrase.

    Attributes:
        phrase: its number in `Windows.records`.
        audio: condition [167,T] float32.
        body: raw features [T,23,6] float16.
    """

    phrase: int
    audio: np.ndarray
    body: np.ndarray

    @property
    def num_frames(self) -> int:
        """T."""
        return len(self.body)


@dataclass(frozen=True, eq=False)
class Windows:
    """All windows of a split, by phrase.

    Attributes:
        items: windows.
        records: the phrases they are cut from.
        of_phrase: numbers of each phrase's windows.
    """

    items: list[Window]
    records: list[PhraseRecord]
    of_phrase: list[list[int]]

    @classmethod
    def cut(
        cls,
        dataset: MotionPhraseDataset,
        *,
        bars: int,
        step: int | None = None,
        min_frames: int,
        max_frames: int,
        rates: Callable[[int], Sequence[float]] = lambda number: (1.0,),
    ) -> "Windows":
        """Cut every good phrase at its bars.

        Args:
            dataset: with bodies.
            bars: length of a window.
            step: bars from one window to the next; None = `bars`.
            min_frames, max_frames: of a window; longer ones lose their end.
            rates: how fast the phrase of that number is shown; each rate is a phrase of its own.
        """
        items: list[Window] = []
        records: list[PhraseRecord] = []
        of_phrase: list[list[int]] = []
        for number, record in enumerate(dataset.phrases):
            phrase = dataset.whole(number)
            if phrase is None:
                continue
            assert phrase.body is not None, "open the data set with bodies=True"
            audio = with_phase_rows(torch.from_numpy(phrase.audio)[None])[0].numpy()
            for rate in rates(number):
                shown = stretched(audio, phrase.phase, phrase.body, rate)
                cuts = cut_at_bars(shown[1], bars=bars, step=step, min_frames=min_frames)
                parts = [slice(start, min(stop, start + max_frames)) for start, stop in cuts]
                first = len(items)
                items += [Window(len(records), shown[0][:, p], shown[2][p]) for p in parts]
                if parts:
                    records.append(record)
                    of_phrase.append(list(range(first, len(items))))
        return cls(items, records, of_phrase)

    def sounds(self, index: Sequence[int]) -> tuple[Tensor, Tensor]:
        """Conditions [B,167,T] of windows, padded with zeros, and their mask [B,T]."""
        return padded([torch.from_numpy(self.items[i].audio.T) for i in index], time_first=False)

    def bodies(self, index: Sequence[int]) -> tuple[Tensor, Tensor]:
        """Raw features [B,T,23,6] of windows, padded with zeros, and their mask [B,T]."""
        return padded([torch.from_numpy(self.items[i].body).float() for i in index])

    def embed_sounds(self, embed: Embed, device: torch.device | str = "cpu") -> Tensor:
        """Every window's sound through `embed(condition, mask)`: [N,D] float32 on the CPU."""
        return self._embedded(embed, self.sounds, device)

    def embed_bodies(self, embed: Embed, device: torch.device | str = "cpu") -> Tensor:
        """Every window's body through `embed(features, mask)`: [N,D] float32 on the CPU."""
        return self._embedded(embed, self.bodies, device)

    @torch.no_grad()
    def _embedded(
        self,
        embed: Embed,
        read: Callable[[Sequence[int]], tuple[Tensor, Tensor]],
        device: torch.device | str,
    ) -> Tensor:
        order = sorted(range(len(self.items)), key=lambda n: self.items[n].num_frames)
        parts = []
        for start in range(0, len(order), BATCH):  # of like length, so that little is padding
            values, mask = read(order[start : start + BATCH])
            parts.append(embed(values.to(device), mask.to(device)).float().cpu())
        found = torch.cat(parts)
        return found[torch.tensor(order).argsort()]


def stretched(
    audio: np.ndarray, phase: np.ndarray, body: np.ndarray, rate: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sound and motion `rate` times as fast, by linear interpolation.

    Args:
        audio: condition [167,T].
        phase: unwrapped bars [T].
        body: raw features [T,23,6].
        rate: 1 = as they are.

    Returns:
        The same three of T' frames; velocities and turning are `rate` times as large.
    """
    if rate == 1:
        return audio, phase, body
    at = np.arange(0, len(phase) - 1, rate)
    before, part = at.astype(int), (at % 1).astype(np.float32)
    audio = audio[:, before] * (1 - part) + audio[:, before + 1] * part
    for rows in (slice(BEAT.start, BEAT.start + 2), slice(BEAT.start + 2, BEAT.stop)):
        audio[rows] /= np.maximum(np.linalg.norm(audio[rows], axis=0), 1e-6)  # back on the circle
    weight = part[:, None, None]
    moved = body[before].astype(np.float32) * (1 - weight) + body[before + 1] * weight
    moved[:, ROOT_ROW, [FORWARD, LATERAL, YAW_RATE]] *= rate
    phase = phase[before] * (1 - part) + phase[before + 1] * part
    return audio, phase, moved.astype(np.float16)


def padded(parts: Sequence[Tensor], *, time_first: bool = True) -> tuple[Tensor, Tensor]:
    """[T,...] each -> [B,T,...] with zeros at the ends and mask [B,T]; or [B,C,T] of [T,C]."""
    lengths = torch.tensor([len(part) for part in parts])
    values = torch.nn.utils.rnn.pad_sequence(list(parts), batch_first=True)
    mask = torch.arange(values.shape[1]) < lengths[:, None]
    return values if time_first else values.transpose(1, 2), mask


def related(records: Sequence[PhraseRecord]) -> np.ndarray:
    """Which phrases [N,N] bool are of one song or share a clip; each is related to itself."""
    songs = np.array([record.song or record.id for record in records])
    same = songs[:, None] == songs[None]
    owners: dict[str, list[int]] = {}
    for number, record in enumerate(records):
        for clip in record.clips:
            owners.setdefault(clip, []).append(number)
    for rows in owners.values():
        same[np.ix_(rows, rows)] = True
    return np.asarray(same)
