"""Music in a trajectory's pictures: the beats, and a colour for each place in the bar.

Beats are the song's where they are known, else those of the trajectory's bar phase.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..motion.trajectory import MotionTrajectory


@dataclass(frozen=True, eq=False)
class SongTrack:
    """What files about a trajectory say of its song.

    Attributes:
        path: the sound file, for the page that plays it.
        beat_times: [N] seconds, none where the song has no beat; None = take the beats from the
            trajectory's bar phase.
        downbeat_times: [M] seconds, some of the beats.
        meter: beats in a bar.
    """

    path: Path | None = None
    beat_times: np.ndarray | None = None
    downbeat_times: np.ndarray | None = None
    meter: int = 4

    @property
    def beatless(self) -> bool:
        """Is it known that the song has no beat?"""
        return self.beat_times is not None and not len(self.beat_times)


@dataclass(frozen=True, eq=False)
class BeatMarks:
    """Beats within a trajectory: times [N] in seconds, which are downbeats [N], beats in a bar."""

    times: np.ndarray
    downbeat: np.ndarray
    meter: int


def beat_marks(trajectory: MotionTrajectory, song: SongTrack) -> BeatMarks:
    """The beats that fall into a trajectory; none where there is no music."""
    if song.beat_times is None:
        return _marks_of_phase(trajectory, song.meter)
    end = (trajectory.num_frames - 1) / trajectory.fps
    times = np.asarray(song.beat_times, dtype=np.float64)
    times = times[(times >= 0) & (times <= end)]
    strong = np.asarray([] if song.downbeat_times is None else song.downbeat_times)
    near = np.abs(times[:, None] - strong).min(1) if len(strong) else np.full(len(times), np.inf)
    return BeatMarks(times, near < 0.02, song.meter)


def _marks_of_phase(trajectory: MotionTrajectory, meter: int) -> BeatMarks:
    """Where the unwrapped phase reaches whole beats, linear between frames."""
    beats = np.maximum.accumulate(trajectory.phase_unwrapped * meter)
    whole = np.arange(np.ceil(beats[0] - 1e-6), np.floor(beats[-1] + 1e-6) + 1)
    if beats[-1] - beats[0] < 1e-3:
        whole = whole[:0]
    rising = np.concatenate(([True], np.diff(beats) > 0))  # interpolation needs distinct places
    times = np.interp(whole, beats[rising], np.flatnonzero(rising) / trajectory.fps)
    return BeatMarks(times, whole % meter == 0, meter)


def phase_palette(steps: int = 60) -> np.ndarray:
    """RGB of places in the bar [steps,3] uint8, red at the downbeat, all equally light.

    A circle in OKLCH (Björn Ottosson 2020, "A perceptual color space for image processing"),
    so that no beat looks stronger than another and the end meets the beginning.
    """
    hue = 2 * np.pi * np.arange(steps) / steps + np.deg2rad(20.0)
    lightness, chroma = 0.70, 0.115
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    red = 4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short
    green = -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short
    blue = -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short
    linear = np.clip(np.stack((red, green, blue), -1), 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.rint(255 * encoded).astype(np.uint8)
