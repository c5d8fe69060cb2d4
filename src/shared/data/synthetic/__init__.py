"""The project's own motion source: parametric human motion whose labels are true by making."""

from .generate import generate_clip
from .labels import LABEL_VALUES, label_combinations
from .spec import SyntheticSpec, sample_specs, spec_for

__all__ = [
    "LABEL_VALUES",
    "SyntheticSpec",
    "generate_clip",
    "label_combinations",
    "sample_specs",
    "spec_for",
]
