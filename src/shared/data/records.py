"""What prepared data knows of each clip, and what a source hands over."""

from dataclasses import asdict, dataclass, field
from typing import Any

from ..config_schema import Provenance
from ..motion.motion import Motion

SPLITS = ("train", "val", "test_seen", "test_unseen")
MIRRORED = "~mirrored"  # ends the id of a mirror image


@dataclass(frozen=True, eq=False)
class RawClip:
    """One clip of a source, already on the canonical skeleton at 30 fps.

    Attributes:
        id: unique name within its source.
        take: recording it belongs to; clips of one take never part between splits.
        captions: captions of this very clip by language, beside those its labels give.
        provenance: where the motion comes from; a condition of the denoiser.
    """

    id: str
    take: str
    motion: Motion
    labels: dict[str, str]
    captions: dict[str, list[str]]
    provenance: Provenance = "captured"


@dataclass(frozen=True)
class ClipRecord:
    """One line of clips.jsonl.

    Attributes:
        group: whole label combination; its captions are in captions.json.
        mirrored: the stored features are to be mirrored (captions and labels already are).
        shard, offset: where its `num_frames` rows start.
    """

    id: str
    source: str
    take: str
    tag: str
    group: str
    labels: dict[str, str]
    mirrored: bool
    split: str
    num_frames: int
    shard: str
    offset: int
    captions: dict[str, list[str]] = field(default_factory=dict)
    provenance: Provenance = "captured"

    def to_json(self) -> dict[str, Any]:
        return asdict(self)
