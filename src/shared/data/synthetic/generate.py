"""From a spec to a motion: durations and the action that each label set calls for."""

from collections.abc import Callable

import numpy as np

from ...motion.motion import Motion
from . import athletics, gestures, locomotion
from .rig import FPS, Body, solve
from .scene import Scene
from .spec import SyntheticSpec

_ACTIONS: dict[str, Callable[[Scene], Body]] = {
    "stand": gestures.stand,
    "walk": locomotion.travel,
    "run": locomotion.travel,
    "side-step": locomotion.travel,
    "crouch-walk": locomotion.travel,
    "turn": locomotion.turn_in_place,
    "spin": locomotion.turn_in_place,
    "wave": gestures.wave,
    "raise": gestures.raise_hands,
    "squat": athletics.squat,
    "jump": athletics.jump,
    "kick": athletics.kick,
    "punch": gestures.punch,
    "bow": gestures.bow,
    "clap": gestures.clap,
}
# Seconds before and after the repetitions, and per repetition at normal tempo.
_COUNTED: dict[str, tuple[float, float]] = {
    "jump": (1.0, 1.55),
    "kick": (1.6, 1.35),
    "punch": (2.0, 0.85),
    "bow": (0.9, 1.6),
    "clap": (2.4, 0.6),
}
_SQUAT_SECONDS = {"slow": 2.3, "normal": 1.56, "fast": 1.1}
_MIN_SECONDS, _MAX_SECONDS = 2.5, 6.0


def _seconds(spec: SyntheticSpec) -> float:
    labels, params = spec.labels, spec.params
    action, length = labels["action"], params["length"]
    if action == "squat":
        seconds = 0.8 + int(labels["count"]) * _SQUAT_SECONDS[labels["speed"]] / params["tempo"]
    elif action in _COUNTED:
        around, each = _COUNTED[action]
        seconds = around + int(labels["count"]) * each / params["tempo"]
    elif action in ("turn", "spin"):
        seconds = {"90": 2.9, "180": 3.8}.get(labels.get("angle", ""), 3.3) + 0.6 * length
    elif action in ("wave", "raise"):
        seconds = (4.4 if labels["speed"] == "slow" else 3.4) + 1.4 * length
    elif "turn" in labels:
        seconds = 3.2 + 2.0 * length
    else:
        seconds = 2.8 + 2.8 * length
    return float(np.clip(seconds, _MIN_SECONDS, _MAX_SECONDS))


def generate_clip(spec: SyntheticSpec, seed: int) -> Motion:
    """The clip a spec describes: [T,22,4] rotations at 30 fps, 2.5 to 6 s, exact contacts.

    The same spec and seed give the same clip; the seed only feeds the slow noise.
    """
    num_frames = round(_seconds(spec) * FPS)
    t = np.arange(num_frames) / FPS
    scene = Scene(t, spec.labels, spec.params, np.random.default_rng(seed))
    return solve(_ACTIONS[spec.labels["action"]](scene))
