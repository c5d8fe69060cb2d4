"""Editing: what of given clips is kept, as a constraint, and the rest made anew.

The first and last seconds of clips with something new between them; chosen joints, or a span of
time, of one clip. A span that has an end leads back to where the body stands there: its path is
bent as far as it misses, and the body is made once more to go that way.

Letters: T frames, R rows (bones, root track), C channels.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Any

import numpy as np

from ..config_loader import did_you_mean
from ..errors import UsageError, UserError, in_range
from ..model.diffusion import Sampling
from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import TextToMotion
from ..motion.features import (
    FORWARD,
    LATERAL,
    LEFT_CONTACT,
    ORIGIN,
    ROOT_ROW,
    YAW_RATE,
    Place,
    decode_features,
    encode_features,
    heading_frame,
    integrate_root,
    mirror_features,
    motion_heading,
)
from ..motion.motion import Motion, resample_motion
from ..motion.postprocess.stitching import blend_boundaries, place_of
from ..motion.rotations import turn_about_y
from ..motion.skeleton import JOINT_INDEX, JOINT_NAMES, LIMBS, MIRROR, NUM_JOINTS
from ..motion.trajectory import FPS
from ..tensors import Tensor, torch
from .stream import OVERLAP, Miss, Passage, stream_features

KEEP = 1.0  # seconds of a clip that are kept
GROUND = [FORWARD, LATERAL, YAW_RATE]  # channels of the root row that say where the body goes
FULLEST = 0.95  # of the way to the pose that is furthest from the first one: there
LONGEST = 7200.0  # seconds of a motion that clips are part of
HARDLY = 0.08  # metres that a joint moves at most where a body holds still
SWAY_SECONDS = 4.0  # forth and back
HELD_SECONDS = 4.0  # at most, to see how far an action goes that is to be held
EASE = 20  # frames, in which joints leave what they did and come back to it
LEGS = LIMBS["left-leg"] + LIMBS["right-leg"]
GROUPS: dict[str, tuple[str, ...]] = LIMBS | {
    "arms": LIMBS["left-arm"] + LIMBS["right-arm"],
    "legs": LEGS,
    "head": ("neck", "head"),
    "upper-body": LIMBS["left-arm"] + LIMBS["right-arm"] + LIMBS["trunk"],
    "lower-body": ("pelvis", *LEGS),
    "body": tuple(JOINT_INDEX),
}


@dataclass(frozen=True, eq=False)
class Given:
    """What is known of a motion that is to be made.

    Attributes:
        constraint: T frames.
        place: of the first frame.
        rejoin: frame from which all is known again, and the place there; None = wherever the
            motion leads.
    """

    constraint: Constraint
    place: Place = ORIGIN
    rejoin: tuple[int, Place] | None = None


# ---------------------------------------------------------------- what is kept


def chosen_joints(names: Collection[str]) -> set[str]:
    """Joints by their names and those of groups; one name may stand alone.

    Raises:
        UsageError: a name is unknown; names the nearest one.
    """
    known = [*GROUPS, *JOINT_INDEX]
    names = names if isinstance(names, Collection) and not isinstance(names, str) else [names]
    for name in names:
        if name not in known:
            raise UsageError(
                f"joint {name!r} is unknown; {did_you_mean(str(name), known)}groups:"
                f" {', '.join(GROUPS)}; joints: {', '.join(JOINT_INDEX)}"
            )
    return set(chain.from_iterable(GROUPS.get(name, (name,)) for name in names))


def at_our_rate(clip: Motion, name: str) -> Motion:
    """A clip at 30 frames a second, the rate of the features; `name` is what a message calls it.

    Raises:
        UsageError: no Motion, or one that has a fault or fewer than two frames.
    """
    what: Any = clip
    if not isinstance(what, Motion):
        kind = type(what).__name__
        raise UsageError(f"{name} is a {kind}; give a Motion, as `read_motion` makes it")
    if fault := clip.fault():
        raise UsageError(f"{name}: {fault}")
    clip = resample_motion(clip, FPS)
    if clip.num_frames < 2:
        raise UsageError(f"{name} is a single frame at {FPS:g} a second; give two or more")
    return clip


def keep_ends(
    start: Motion | None, end: Motion | None, kept: int, frames: int, *, rejoin: bool = False
) -> Given:
    """A motion that begins as one clip begins, and ends as another one ends.

    It stands where `start` stands.

    Args:
        start: its first frames are kept; None = a free beginning.
        end: its last frames are kept; None = an open end.
        kept: frames of each.
        frames: of the whole, more than what is kept.
        rejoin: it ends where `end` stands; else wherever it leads.
    """
    given = Constraint.free(frames)
    for clip, of_clip, of_motion in (
        (start, slice(0, kept), slice(0, kept)),
        (end, slice(-kept, None), slice(frames - kept, frames)),
    ):
        if clip is not None:
            given.values[of_motion] = encode_features(clip)[of_clip]
            given.known[of_motion] = True
    place = Place() if start is None else place_of(start, 0)
    if end is None or not rejoin:
        return Given(given, place)
    return Given(given, place, (frames - kept, place_of(end, end.num_frames - kept)))


def redo(clip: Motion, start: int, stop: int, joints: set[str] | None = None) -> Given:
    """A clip of which frames [start, stop) are made anew.

    Args:
        clip: T frames.
        start, stop: frames.
        joints: only these, and the clip's path stays; None = the whole body and its path.
    """
    known = all_but(encode_features(clip), start, stop, joints)
    open_end = joints is not None or stop >= clip.num_frames
    rejoin = None if open_end else (stop, place_of(clip, stop))
    return Given(known, place_of(clip, 0), rejoin)


def edit_clip(
    clip: Motion,
    begin: float = 0.0,
    until: float | None = None,
    joints: Collection[str] | None = None,
) -> Given:
    """A clip of which the seconds from `begin` to `until` are made anew; see `redo`.

    Args:
        clip: of any rate; it is made anew at 30 frames a second.
        begin, until: seconds; None = its end.
        joints: only these, or groups of them as "right-arm"; None = the whole body and its path.

    Raises:
        UsageError: a joint is unknown, there is none, or as `at_our_rate`.
        UserError: the span is not in the clip.
    """
    ours = at_our_rate(clip, "clip")
    in_range("begin", begin, -LONGEST, LONGEST)
    until = clip.seconds if until is None else until
    in_range("until", until, -LONGEST, LONGEST)
    start, stop = round(begin * FPS), min(round(until * FPS), ours.num_frames)
    if begin < 0 or round(until * clip.fps) > clip.num_frames or start >= stop:
        raise UserError(
            f"from {begin:g} to {until:g} s: the clip lasts {clip.seconds:.2f} s; choose a span of"
            f" it that holds a frame, {1 / FPS:.3f} s"
        )
    chosen = None if joints is None else chosen_joints(joints)
    if chosen == set():
        raise UsageError(f"joints is empty; name joints, or groups of them: {', '.join(GROUPS)}")
    return redo(ours, start, stop, chosen)


def continue_clips(
    start: Motion | None,
    end: Motion | None = None,
    *,
    keep: float = KEEP,
    seconds: float | None = None,
    rejoin: bool = False,
) -> Given:
    """A motion that begins with the first seconds of a clip, or ends with the last ones; or both.

    Args:
        start, end: one of them at least, of any rate; what is made has 30 frames a second. To go
            on from where a clip ends, keep all of it: `keep=clip.seconds`, and more `seconds`.
        keep: seconds of each that stay.
        seconds: of the whole; None = what is kept at both ends and 2 s between, or with `rejoin`
            as long as the clip.
        rejoin: it ends where `end` stands; both are usually one clip, whose middle is made anew.

    Raises:
        UserError: a clip is shorter than what is to be kept.
        UsageError: no clip, nothing would be left to make, or as `at_our_rate`.
    """
    in_range("keep", keep, 0.0, LONGEST)
    first = None if start is None else at_our_rate(start, "start")
    last = None if end is None else at_our_rate(end, "end")
    clips = [clip for clip in (first, last) if clip is not None]
    if not clips:
        raise UsageError(f"start is {start}, end is {end}; give a clip as one of them, or as both")
    for name, clip in (("start", start), ("end", end)):
        if clip is not None and clip.seconds < keep:
            raise UserError(
                f"{name}: the clip lasts {clip.seconds:.2f} s, less than the {keep:g} s to be kept;"
                " keep less"
            )
    if seconds is None:
        seconds = clips[0].seconds if rejoin else 2 * keep + 2.0
    in_range("seconds", seconds, 0.0, LONGEST)
    frames, kept = round(seconds * FPS), round(keep * FPS)
    kept = min(kept, *(clip.num_frames for clip in clips))  # seconds of another rate
    if kept < 1:
        raise UsageError(f"keep {keep:g} s holds no frame; keep {1 / FPS:.3f} s or more")
    if frames - len(clips) * kept < 1:
        raise UsageError(
            f"a length of {seconds:g} s leaves nothing to make: {len(clips)} × {keep:g} s are kept;"
            " give more seconds or keep less"
        )
    return keep_ends(first, last, kept, frames, rejoin=rejoin)


def all_but(features: Tensor, start: int, stop: int, joints: set[str] | None) -> Constraint:
    """Features [T,R,6] are known but for some joints, or everything, in frames [start, stop).

    The other joints are not shown to the network: it would make these as the body has them already,
    and not as the text says.
    """
    known = torch.ones(features.shape, dtype=torch.bool)
    shown = None if joints is None else torch.zeros_like(known)
    if joints is None:
        known[start:stop] = False
    else:
        known[start:stop, [JOINT_INDEX[name] for name in sorted(joints)]] = False
        if joints & set(LEGS) and features.shape[1] > ROOT_ROW:
            known[start:stop, ROOT_ROW, LEFT_CONTACT:] = False
    return Constraint(features, known, shown=shown)


def beside(
    generator: TextToMotion,
    passage: Passage,
    features: Tensor,
    start: int,
    joints: set[str],
    sampling: Sampling,
    seat: str,
) -> Tensor:
    """Features [T,R,6] in which, from `start` on, some joints do what a passage says: filled in, or
    where the body sits (`seat`) as it does alone, for there they would hardly move."""
    stop = start + passage.frames
    if passage.mirrored and not seat:
        turned = replace(passage, mirrored=False), mirror_features(features), start
        other = {JOINT_NAMES[MIRROR[JOINT_INDEX[joint]]] for joint in joints}
        return mirror_features(beside(generator, *turned, other, sampling, seat))
    if not seat:
        rest = all_but(features, start, stop, joints)
        return fill_free(generator, passage.text, rest, sampling)
    alone = torch.cat(list(stream_features(generator, [passage], sampling)))
    features, kept = features.clone(), torch.ones_like(features, dtype=torch.bool)
    for row in (JOINT_INDEX[joint] for joint in joints):
        features[start:stop, row] = alone[:, row]
        kept[start:stop, row] = False
    return blend_boundaries(features, kept)


def held(
    generator: TextToMotion,
    passage: Passage,
    miss: Callable[[int], Miss | None],
    sampling: Sampling,
) -> Constraint:
    """What is done goes as far from its first pose as it goes, and no way back.

    From there on all is known: the stretch in which it hardly moves, forth and back at the pace at
    which a body sways that holds still, its place left out.

    Args:
        miss: how far so many frames are from what is wanted.
    """
    frames, fps = passage.frames, generator.card.fps
    first = min(frames, round(HELD_SECONDS * fps))
    alone = replace(passage, frames=first, miss=miss(first))
    features = torch.cat(list(stream_features(generator, [alone], sampling)))
    motion = decode_features(features, fps=fps)
    heading = np.unwrap(motion_heading(motion).astype(np.float64))
    joints = motion.positions().astype(np.float64)
    body = heading_frame(joints, heading)
    body[:, 0, 1] = joints[:, 0, 1]  # how high the pelvis is
    body[:, 1:, 1] += joints[:, :1, 1]

    away = np.linalg.norm(body - body[0], axis=-1).mean(-1)
    there = int(np.argmax(away >= FULLEST * away.max()))
    moved = np.linalg.norm(body[there:] - body[there], axis=-1).max(-1) > HARDLY
    stays = int(np.argmax(moved) if moved.any() else len(moved)) - 1
    time = np.arange(frames)
    turning = np.pi / max(stays, round(SWAY_SECONDS / 2 * fps))
    way = there + stays * (1 - np.cos(turning * (time - there))) / 2
    given = Constraint.free(frames)
    frame = np.where(time < there, time, np.round(way)).clip(max=len(away) - 1)
    given.values[:] = features[frame.astype(int)]
    given.values[:, ROOT_ROW, GROUND] = 0.0
    given.known[there:] = True
    return given


# ---------------------------------------------------------------- how well it is kept


def kept_error(motion: Motion, given: Constraint) -> dict[str, float]:
    """Largest differences between what was known and what a motion has become.

    Returns:
        rotation: of entries of the 6D rotations of known joints; root: of the root row's known
        velocities (m/s, rad/s) and height (m), the last frame's velocities left out, as they are
        none. 0 where nothing was known.
    """
    apart = (encode_features(motion) - given.values).abs()
    known = given.known.clone()
    known[-1, ROOT_ROW, GROUND] = False
    known[:, ROOT_ROW, LEFT_CONTACT:] = False
    apart[~known] = 0.0
    return {
        "rotation": float(apart[:, :ROOT_ROW].max()),
        "root": float(apart[:, ROOT_ROW].max()),
    }


NO_TEXT = "a person moves"  # where nothing is said: its weight is nothing, too


@dataclass(frozen=True, eq=False)
class ControlledMotion:
    """A motion, and how well it keeps to its directions.

    Attributes:
        motion: post-processed.
        errors: see the function that made it.
        warning: a line if it does not show what was asked for, as far as kinematics tell.
    """

    motion: Motion
    errors: dict[str, Any] = field(default_factory=dict)
    warning: str | None = None


def fill(
    generator: TextToMotion,
    text: str,
    given: Given,
    sampling: Sampling,
    *,
    tag: str | None = None,
    miss: Miss | None = None,
) -> tuple[Tensor, Constraint]:
    """Raw features [T,R,6] with everything that is not known made anew, and what was known;
    windows are sampled again until nothing is missed.

    Raises:
        UserError: as `stream_features`.
    """
    constraint = given.constraint
    features = fill_free(generator, text, constraint, sampling, tag=tag, miss=miss)
    if given.rejoin is not None:
        bent = bend_back(features, given, fps=generator.card.fps)
        features = fill_free(generator, text, bent, sampling, tag=tag, miss=miss)
        constraint = replace(constraint, values=bent.values, known=bent.known)
    return features, constraint


def fill_free(
    generator: TextToMotion,
    text: str,
    constraint: Constraint,
    sampling: Sampling,
    *,
    tag: str | None = None,
    miss: Miss | None = None,
) -> Tensor:
    """Raw features [T,R,6]; only the frames around what is not known go through the network."""
    rows = generator.network.motion_rows
    free = torch.nonzero(~constraint.known[:, :rows].flatten(1).all(1))[:, 0]
    if not len(free):
        return constraint.values[:, :rows]
    start = max(0, int(free[0]) - OVERLAP)
    stop = min(len(constraint), int(free[-1]) + 1 + OVERLAP)
    near = constraint.window(start, stop, fps=generator.card.fps)
    pieces = stream_features(
        generator,
        [Passage(text, stop - start, tag, miss=miss)],
        constraint=lambda first, last: near.window(first, last, fps=generator.card.fps),
        sampling=sampling,
    )
    features = constraint.values[:, :rows].clone()
    features[start:stop] = torch.cat(list(pieces))
    if constraint.shown is not None and not constraint.shown.any():
        _ease(features, constraint, int(free[0]), int(free[-1]) + 1)
    return features


def _ease(features: Tensor, constraint: Constraint, start: int, stop: int) -> None:
    """In place: joints that were made anew in frames [start, stop) leave the pose that they had,
    which is in `constraint.values`, and come back to it, within EASE frames; a network that does
    not see what they did begins where it likes."""
    frames = min(EASE, (stop - start) // 3)
    way = np.arange(1, frames + 1) / (frames + 1)
    share = np.ones((stop - start, 1, 1), np.float32)
    if start > 0:
        share[:frames, 0, 0] = way * way * (3 - 2 * way)
    if frames and stop < len(features):
        share[-frames:, 0, 0] = (way * way * (3 - 2 * way))[::-1]
    made, had = (each[start:stop, :NUM_JOINTS] for each in (features, constraint.values))
    new = features.new_tensor(share)
    known = constraint.known[start:stop, :NUM_JOINTS]
    features[start:stop, :NUM_JOINTS] = torch.where(known, made, made * new + had * (1 - new))


def bend_back(features: Tensor, given: Given, *, fps: float) -> Constraint:
    """What was given, and a path through the free frames that leads to the place at their end.

    Heading and place are led over with a smooth step, so the path leaves and arrives with the
    velocities that it had.
    """
    assert given.rejoin is not None, "only a motion with an end can miss it"
    stop, target = given.rejoin
    free = ~given.constraint.known[:stop, ROOT_ROW, FORWARD]
    start = int(torch.nonzero(free)[0, 0])
    root = features[: stop + 1, ROOT_ROW].double()
    x = torch.linspace(0, 1, stop - start + 1, dtype=torch.float64)
    ease = torch.zeros(stop + 1, dtype=torch.float64)
    ease[start:] = x**3 * (x * (6 * x - 15) + 10)

    _, heading = integrate_root(root, fps, given.place)
    turn = (target.heading - heading[-1] + np.pi) % (2 * np.pi) - np.pi
    root[:-1, YAW_RATE] += turn * ease.diff() * fps
    path, heading = integrate_root(root, fps, given.place)
    miss = torch.tensor([target.x, 0.0, target.z], dtype=torch.float64) - path[-1]
    miss[1] = 0.0
    velocity = turn_about_y((path + ease[:, None] * miss).diff(dim=0) * fps, -heading[:-1])

    values, known = given.constraint.values.clone(), given.constraint.known.clone()
    values[start:stop, ROOT_ROW, FORWARD] = velocity[start:, 2].float()
    values[start:stop, ROOT_ROW, LATERAL] = velocity[start:, 0].float()
    values[start:stop, ROOT_ROW, YAW_RATE] = root[start:stop, YAW_RATE].float()
    known[start:stop, ROOT_ROW, GROUND] = True
    return replace(given.constraint, values=values, known=known)


def edited(
    generator: TextToMotion,
    text: str | None,
    given: Given,
    sampling: Sampling,
    *,
    tag: str | None = None,
    foot_lock: bool | None = None,
    miss: Miss | None = None,
) -> ControlledMotion:
    """A motion of which much is given.

    Args:
        generator: trained.
        text: what the rest shows; None = nothing is said.
        given: what is known of it; see `Given`.
        sampling: how.
        tag: action label beside the text.
        foot_lock: None = the model's own.
        miss: of the frames that are made anew; None = one sample will do.

    Returns:
        errors: rotation and root, see `kept_error`; frames and entries, the share that was kept.
    """
    if text is None:
        sampling = replace(sampling, guidance_scale=0.0)
    features, constraint = fill(generator, text or NO_TEXT, given, sampling, tag=tag, miss=miss)
    motion = generator.post_processor(
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
    return ControlledMotion(motion, kept_error(motion, given.constraint) | shares)
