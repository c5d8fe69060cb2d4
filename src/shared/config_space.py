"""Configuration of the audio tower: the third one in the space of texts and motions."""

from typing import Self

from pydantic import Field, model_validator

from .config_audio import AugmentationConfig
from .config_schema import Config


class AudioTowerConfig(Config):
    """AudioTower's sizes; `embed-dim` is that of the motion tower it learns from."""

    embed_dim: int = Field(192, ge=8)
    dim: int = Field(160, ge=8)  # channels inside
    num_heads: int = Field(4, ge=1)
    num_layers: int = Field(2, ge=1)
    dropout: float = Field(0.1, ge=0, lt=1)
    augmentation: AugmentationConfig = AugmentationConfig()  # what training does to the sound

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.dim % self.num_heads:
            raise ValueError(f"num-heads {self.num_heads} must divide dim {self.dim}")
        return self
