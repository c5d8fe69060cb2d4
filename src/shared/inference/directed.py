"""Motions with directions: edited, along a path, by a timeline, in a loop; and how well they keep.

Letters: T frames, R rows (bones, root track), C channels.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import torch

from ..errors import UserError
from ..model.generation.motion_generator import MotionGenerator
from ..motion.motion import Motion
from ..motion.root_track import FORWARD, LATERAL, ROOT_ROW
from ..motion.rotations import quaternion_multiply
from ..motion.trajectory_math import turn_about_y, yaw_quaternion
from .drawn_path import DrawnPath
from .editing import Given, Place, kept_error, place_of
from .filling import fill, finish
from .motion_stream import Passage, StreamSettings, stream_features
from .path_following import NATURAL, path_error, time_path
from .settling import frames_of, settled
from .timeline import Timeline, add_parts, make_loop, make_timeline

NO_TEXT = "a person moves"  # where nothing is said: its weight is nothing, too
STANDING = 0.25  # m/s; a prompt that moves less has no way of going


@dataclass(frozen=True, eq=False)
class Directed:
    """A motion, and how well it keeps to its directions.

    Attributes:
        motion: post-processed.
        errors: see the function that made it.
    """

    motion: Motion
    errors: dict[str, Any] = field(default_factory=dict)


def edited(
    generator: MotionGenerator,
    text: str | None,
    given: Given,
    settings: StreamSettings,
    *,
    tag: str | None = None,
    foot_lock: bool | None = None,
) -> Directed:
    """A motion of which much is given.

    Args:
        generator: trained.
        text: what the rest shows; None = nothing is said.
        given: see `editing`.
        settings: of sampling.
        tag: action label beside the text.
        foot_lock: None = the model's own.

    Returns:
        errors: rotation and root, see `kept_error`; frames and entries, the share that was kept.
    """
    if text is None:
        settings = replace(settings, guidance_scale=0.0)
    features, constraint = fill(generator, text or NO_TEXT, given, settings, tag=tag)
    motion = finish(
        generator,
        features,
        constraint.known,
        text=text or "",
        place=given.place,
        foot_lock=foot_lock,
    )
    known = given.constraint.known
    shares = {
        "frames_kept": int(known.flatten(1).all(1).sum()),
        "entries_kept": float(known.float().mean()),
    }
    return Directed(motion, kept_error(motion, given.constraint) | shares)


def along_path(
    generator: MotionGenerator,
    timeline: Timeline,
    drawn: DrawnPath,
    settings: StreamSettings,
    *,
    seconds: float | None = None,
    foot_lock: bool | None = None,
) -> Directed:
    """A motion along a path.

    Args:
        generator: trained.
        timeline: one text, and it takes as long as the path; or several, and the path takes as
            long as they.
        drawn: the path.
        settings: of sampling.
        seconds: how long it takes; None = as long as the prompt's own speed says.
        foot_lock: None = the model's own.

    Raises:
        UserError: the path is too long for the seconds.

    Returns:
        errors: path_mean, path_max: metres from where the pelvis is to be in each frame; line_mean,
            line_max: from the nearest point of the line as drawn; seconds, length, speed: of the
            path.
    """
    fps = generator.card.fps
    speed, facing = natural_gait(generator, timeline.passages[0], settings)
    alone = len(timeline.passages) == 1 and not timeline.parts
    if not alone:
        seconds = (timeline.num_frames - 1) / fps
    path = time_path(drawn, fps=fps, speed=speed, seconds=seconds, facing=facing)
    if not alone and len(path) != timeline.num_frames:
        raise UserError(
            f"the path takes {len(path) / fps:g} s and the texts {timeline.num_frames / fps:g} s;"
            " give both the same length"
        )
    if alone:
        timeline = Timeline((replace(timeline.passages[0], frames=len(path)),))
    given = path.constraint()
    features = make_timeline(
        generator,
        timeline,
        settings,
        constraint=lambda start, stop: given.window(start, stop, fps=fps),
    )
    x, z = path.points[0].tolist()
    motion = finish(
        generator,
        features,
        given.known,
        text=timeline.text,
        place=Place(x, z, float(path.headings[0])),
        foot_lock=foot_lock,
        carried=True,
    )
    error = path_error(motion, path, drawn)
    walked = {"seconds": len(path) / fps, "length": drawn.length, "speed": speed}
    return Directed(motion, {f"path_{name}": value for name, value in vars(error).items()} | walked)


def natural_gait(
    generator: MotionGenerator, passage: Passage, settings: StreamSettings
) -> tuple[float, float]:
    """How fast a body goes that nobody directs, m/s, and radians from its way to its heading.

    A prompt may say backward or sideways; the angle is a multiple of a quarter turn.
    """
    (features,) = stream_features(generator, [replace(passage, frames=90)], **vars(settings))
    ground = features[:, ROOT_ROW, [FORWARD, LATERAL]].numpy()  # 90 2
    speed = float(np.percentile(np.hypot(*ground.T), 75))  # it may have to start first
    forward, lateral = ground.mean(0)
    if np.hypot(forward, lateral) < STANDING:
        return NATURAL, 0.0
    return speed, -float(np.round(np.arctan2(lateral, forward) / (np.pi / 2)) * (np.pi / 2))


def by_timeline(
    generator: MotionGenerator,
    timeline: Timeline,
    settings: StreamSettings,
    *,
    foot_lock: bool | None = None,
) -> Directed:
    """One motion with several texts; what `MotionStream` gives for them, in one piece.

    Returns:
        errors: none, as nothing is given.
    """
    features = make_timeline(generator, timeline, settings)
    motion = settled(generator, features, foot_lock=foot_lock)
    return Directed(replace(motion, text=timeline.text))


def in_a_loop(
    generator: MotionGenerator,
    timeline: Timeline,
    settings: StreamSettings,
    *,
    foot_lock: bool | None = None,
) -> Directed:
    """One motion whose end leads into its beginning, again and again.

    Where it travels, each round goes on from where the last one led.

    Returns:
        errors: see `join_error`; travel, turn: metres and degrees of one round.
    """
    features = make_loop(generator, timeline.passages, settings)
    features = add_parts(generator, features, timeline.parts, settings)
    frames = len(features)
    rounds = finish(
        generator, torch.cat([features] * 3), None, text=timeline.text, foot_lock=foot_lock
    )
    before, after = place_of(rounds, frames), place_of(rounds, 2 * frames)
    errors = join_error(rounds, frames) | {
        "travel": float(np.hypot(after.x - before.x, after.z - before.z)),
        "turn": float(np.degrees(after.heading - before.heading)),
    }
    once = frames_of(rounds, frames, 2 * frames)
    return Directed(moved_to(once, Place()), errors)


def join_error(rounds: Motion, frames: int) -> dict[str, float]:
    """What is seen where a second round meets the first.

    Args:
        rounds: two or more, one after the other.
        frames: of one round.

    Returns:
        join_acceleration: m/s², the largest of any joint within two frames of the join;
        p99_acceleration: 99th percentile of each frame's largest, elsewhere.
    """
    positions = rounds.positions()[: 2 * frames].astype(np.float64)
    sizes = np.linalg.norm(np.diff(positions, 2, axis=0), axis=-1).max(1) * rounds.fps**2
    near = np.zeros(len(sizes), dtype=bool)
    near[frames - 4 : frames + 2] = True
    return {
        "join_acceleration": float(sizes[near].max()),
        "p99_acceleration": float(np.percentile(sizes[~near], 99)),
    }


def moved_to(motion: Motion, place: Place) -> Motion:
    """The same motion with its first frame somewhere else on the ground."""
    here = place_of(motion, 0)
    turn = place.heading - here.heading
    path = torch.as_tensor(motion.root_position, dtype=torch.float64)
    path = turn_about_y(path - torch.tensor([here.x, 0.0, here.z]), turn)
    path = path + torch.tensor([place.x, 0.0, place.z])
    quaternions = motion.quaternions.copy()
    pelvis = torch.as_tensor(quaternions[:, 0], dtype=torch.float64)
    yaw = yaw_quaternion(torch.tensor(turn, dtype=torch.float64))
    quaternions[:, 0] = quaternion_multiply(yaw.expand_as(pelvis), pelvis).numpy()
    return replace(motion, quaternions=quaternions, root_position=path.float().numpy())
