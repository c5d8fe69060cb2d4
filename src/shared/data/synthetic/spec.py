"""What one synthetic clip shows: its labels and the continuous parameters that vary it."""

from dataclasses import dataclass

import numpy as np

from .labels import label_combinations, speed_metres

# Drawn uniformly for every clip; 1 is neutral for factors, 0 for the others.
_PARAMETER_RANGES: dict[str, tuple[float, float]] = {
    "tempo": (0.92, 1.08),  # factor on durations' inverse
    "amplitude": (0.85, 1.15),  # factor on how far limbs and trunk move
    "width": (0.85, 1.2),  # factor on the distance between the feet
    "hunch": (-4.0, 9.0),  # degrees the upper back is bent forward
    "gaze": (-4.0, 6.0),  # degrees the head looks down
    "arm_carry": (-3.0, 7.0),  # degrees the arms hang further out
    "elbow_carry": (-6.0, 12.0),  # degrees the elbows are bent further
    "toe_out": (3.0, 12.0),  # degrees the feet point outward
    "swing": (0.7, 1.3),  # factor on arm swing
    "bounce": (0.8, 1.25),  # factor on the pelvis' up and down
    "variant": (0.0, 1.0),  # lets an action choose among its forms
    "entry": (0.0, 1.0),  # how a clip begins and ends: in the middle, from standing, ...
    "length": (0.0, 1.0),  # where the duration lies in its allowed range
}
_SPEED_SPREAD = 0.08  # relative; half the gap between neighbouring speeds stays free


@dataclass(frozen=True)
class SyntheticSpec:
    """A clip to be made.

    Attributes:
        labels: keys and values out of `LABEL_VALUES`, only the keys that apply.
        params: continuous parameters; names and ranges above, "speed" in m/s where it applies.
    """

    labels: dict[str, str]
    params: dict[str, float]


def spec_for(labels: dict[str, str], seed: int) -> SyntheticSpec:
    """A spec with the given labels and parameters drawn from the seed."""
    rng = np.random.default_rng((seed, 71))
    params = {name: float(rng.uniform(*bounds)) for name, bounds in _PARAMETER_RANGES.items()}
    spread = 1.0 + _SPEED_SPREAD * float(rng.uniform(-1, 1))
    if labels["action"] in ("walk", "run", "side-step", "crouch-walk"):
        params["speed"] = speed_metres(labels) * spread
    return SyntheticSpec(dict(labels), params)


def sample_specs(n: int, seed: int) -> list[SyntheticSpec]:
    """`n` specs; every label combination occurs ⌊n/C⌋ or ⌈n/C⌉ times, in shuffled order."""
    rng = np.random.default_rng(seed)
    combinations = label_combinations()
    rounds = -(-n // len(combinations))
    order = np.concatenate([rng.permutation(len(combinations)) for _ in range(rounds)])[:n]
    seeds = rng.integers(0, 2**31, size=n)
    return [spec_for(combinations[i], int(s)) for i, s in zip(order, seeds, strict=True)]
