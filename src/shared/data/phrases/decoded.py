"""A phrase as it is stored -> its arrays, checked and of one length."""

from dataclasses import dataclass

import numpy as np

from .layout import (
    BadContent,
    PhraseRecord,
    common_length,
    decode_body,
    decode_features,
    decode_trajectory,
    phase_rows,
)
from .store import PhraseStore

_PHASE = 16  # column of a trajectory: bars modulo 1


@dataclass(frozen=True, eq=False)
class DecodedPhrase:
    """T frames, C = 163 rows of sound, or 167 with beat and bar phase.

    Attributes:
        trajectory: [T,25] float32.
        phase: unwrapped bars [T] float64.
        audio: [C,T] float32.
        body: features [T,23,6] float16, if asked for.
    """

    trajectory: np.ndarray
    phase: np.ndarray
    audio: np.ndarray
    body: np.ndarray | None


def read_phrase(
    store: PhraseStore, record: PhraseRecord, *, beat_phase: bool, body: bool
) -> DecodedPhrase:
    """Read all of a phrase.

    Args:
        beat_phase: add the four rows of beat and bar phase where they are known.
        body: read the body where there is one.

    Raises:
        BadContent, Unreachable: see `PhraseStore.load`; also where lengths differ.
    """
    trajectory = store.load(record.motion, decode_trajectory)
    sound = store.load(record.features, decode_features)
    frames = common_length(trajectory, sound)
    audio = sound.stacked[:, :frames]
    if beat_phase and sound.phase is not None:
        audio = np.concatenate([audio, phase_rows(sound.phase[:frames], sound.meter)])
    phase = np.unwrap(trajectory[:frames, _PHASE].astype(np.float64), period=1.0)
    shown = _read_body(store, record, frames) if body else None
    return DecodedPhrase(trajectory[:frames], phase, audio, shown)


def _read_body(store: PhraseStore, record: PhraseRecord, frames: int) -> np.ndarray | None:
    if record.body is None:
        return None
    features = store.load(record.body, decode_body)
    if len(features) < frames:
        raise BadContent(f"{record.body.path} has {len(features)} frames, the motion {frames}")
    return features[:frames].astype(np.float16)
