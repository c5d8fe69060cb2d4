"""Settings of the motion memory: how phrases are cut and found, and how long that may take."""

from typing import Literal

from pydantic import Field

from .config_schema import Config


class MemoryConfig(Config):
    """What `MPMService` and `memory build` are told (memory.yaml)."""

    folder: str = ""  # that `memory build` wrote
    bars: int = Field(2, ge=1)  # length of a phrase
    min_frames: int = Field(24, ge=8)  # shorter rests at the ends of a song are left out
    top_k: int = Field(8, ge=1)
    temperature: float = Field(0.07, gt=0)  # of the softmax over similarities of the hits
    key: Literal["audio", "motion"] = "audio"  # which side of a phrase is compared with the query
    phase_weight: float = Field(0.1, ge=0)  # similarity that a phrase half a bar off loses
    deadline: float = Field(2.0, gt=0)  # seconds after which a query is answered by "nothing"
    workers: int = Field(4, ge=1)  # threads that search
    library_above: int = Field(50_000, ge=0)  # phrases; beyond, search by library if installed
