"""The project's own motion source: parametric human motion whose labels are true by making."""

from .clips import (
    LABEL_VALUES,
    SyntheticSpec,
    generate_clip,
    label_combinations,
    sample_specs,
    spec_for,
)

__all__ = [
    "LABEL_VALUES",
    "SyntheticSpec",
    "generate_clip",
    "label_combinations",
    "sample_specs",
    "spec_for",
]
