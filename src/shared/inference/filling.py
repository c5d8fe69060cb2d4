"""What is not known of a motion is made; what is known stays as it was.

A span that has an end leads back to where the body stands there: its path is bent as far as it
misses, and the body is made once more to go that way.

Letters: T frames, R rows (bones, root track), C channels.
"""

from dataclasses import asdict, replace

import numpy as np
import torch
from scipy.ndimage import distance_transform_edt
from torch import Tensor

from ..model.generation.constraint import Constraint
from ..model.generation.motion_generator import MotionGenerator
from ..motion.carried_feet import hold_carried_feet
from ..motion.foot_lock import kept_legs, lock_feet
from ..motion.motion import Motion
from ..motion.postprocess import MotionPostProcessor, smooth_features
from ..motion.root_track import FORWARD, LATERAL, ROOT_ROW, YAW_RATE, integrate_root
from ..motion.rotations import quaternion_continuous, quaternion_slerp
from ..motion.skeleton import JOINT_INDEX, LIMBS
from ..motion.trajectory_math import turn_about_y
from .editing import GROUND, Given, Place
from .motion_stream import OVERLAP, Passage, StreamSettings, stream_features
from .trajectory_constraint import untwisted

EASE = 10  # frames until a leg is held as if nothing of it had been kept


def fill(
    generator: MotionGenerator,
    text: str,
    given: Given,
    settings: StreamSettings,
    *,
    tag: str | None = None,
) -> tuple[Tensor, Constraint]:
    """Raw features [T,R,6] with everything that is not known made anew, and what was known.

    Raises:
        UserError: as `stream_features`.
    """
    constraint = given.constraint
    features = fill_free(generator, text, constraint, settings, tag=tag)
    if given.rejoin is not None:
        bent = bend_back(features, given, fps=generator.card.fps)
        features = fill_free(generator, text, bent, settings, tag=tag)
        constraint = replace(constraint, values=bent.values, known=bent.known)
    return features, constraint


def fill_free(
    generator: MotionGenerator,
    text: str,
    constraint: Constraint,
    settings: StreamSettings,
    *,
    tag: str | None = None,
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
        [Passage(text, stop - start, tag)],
        constraint=lambda first, last: near.window(first, last, fps=generator.card.fps),
        **asdict(settings),
    )
    features = constraint.values[:, :rows].clone()
    features[start:stop] = torch.cat(list(pieces))
    return features


def bend_back(features: Tensor, given: Given, *, fps: float) -> Constraint:
    """What was given, and a path through the free frames that leads to the place at their end.

    Heading and place are led over with a smooth step, so the path leaves and arrives with the
    velocities that it had.
    """
    assert given.rejoin is not None, "only a motion with an end can miss it"
    stop, target = given.rejoin
    free = ~given.constraint.known[:stop, ROOT_ROW, FORWARD]
    start = int(torch.nonzero(free)[0])
    root = features[: stop + 1, ROOT_ROW].double()
    place = ((given.place.x, given.place.z), given.place.heading)
    x = torch.linspace(0, 1, stop - start + 1, dtype=torch.float64)
    ease = torch.zeros(stop + 1, dtype=torch.float64)
    ease[start:] = x**3 * (x * (6 * x - 15) + 10)

    _, heading = integrate_root(root, fps, *place)
    turn = (target.heading - heading[-1] + np.pi) % (2 * np.pi) - np.pi
    root[:-1, YAW_RATE] += turn * ease.diff() * fps
    path, heading = integrate_root(root, fps, *place)
    miss = torch.tensor([target.x, 0.0, target.z], dtype=torch.float64) - path[-1]
    miss[1] = 0.0
    velocity = turn_about_y((path + ease[:, None] * miss).diff(dim=0) * fps, -heading[:-1])

    values, known = given.constraint.values.clone(), given.constraint.known.clone()
    values[start:stop, ROOT_ROW, FORWARD] = velocity[start:, 2].float()
    values[start:stop, ROOT_ROW, LATERAL] = velocity[start:, 0].float()
    values[start:stop, ROOT_ROW, YAW_RATE] = root[start:stop, YAW_RATE].float()
    known[start:stop, ROOT_ROW, GROUND] = True
    return replace(given.constraint, values=values, known=known)


def finish(
    generator: MotionGenerator,
    features: Tensor,
    known: Tensor | None,
    *,
    text: str,
    place: Place | None = None,
    foot_lock: bool | None = None,
    carried: bool = False,
) -> Motion:
    """Post-processed as the generator's own motions are, in its place; known entries stay.

    Args:
        generator: whose settings count.
        features: raw [T,R,6].
        known: bool [T,R,6].
        text: its caption.
        place: of the first frame; None = the origin, facing +Z.
        foot_lock: hold standing feet; None = the model's own setting.
        carried: a path that is not the body's own is known.
    """
    config = generator.network.generation.post_processing
    smooth = smooth_features(features, config.smoothing_kernel)
    if known is not None:
        # Neither what was made of the pelvis nor an average has a heading of its own to add.
        smooth = untwisted(torch.where(known[:, : features.shape[1]], features, smooth))
        smooth = torch.where(known[:, : features.shape[1]], features, smooth)
    place = place or Place()
    locks = config.foot_lock if foot_lock is None else foot_lock
    loose = MotionPostProcessor(
        config.model_copy(update={"smoothing_kernel": 1, "foot_lock": False})
    )(
        smooth,
        known=known,
        fps=generator.card.fps,
        text=text,
        start_position=(place.x, place.z),
        start_heading=place.heading,
    )
    if not locks:
        return loose
    kept = None if known is None else kept_legs(known)
    locked = (hold_carried_feet if carried else lock_feet)(loose, kept=kept)
    return locked if kept is None else eased(loose, locked, kept)


def eased(loose: Motion, locked: Motion, kept: np.ndarray) -> Motion:
    """Legs held little by little from where they are kept [T,2] bool: no foot jumps to its hold."""
    quaternions = torch.as_tensor(locked.quaternions).clone()
    before = torch.as_tensor(loose.quaternions)
    for side, limb in enumerate(("left-leg", "right-leg")):
        away = distance_transform_edt(~kept[:, side]) if kept[:, side].any() else np.inf
        x = torch.as_tensor(np.minimum(away / EASE, 1.0), dtype=torch.float32)
        share = (x**2 * (3 - 2 * x)).expand(len(before))[:, None, None]
        joints = [JOINT_INDEX[name] for name in LIMBS[limb]]
        quaternions[:, joints] = quaternion_slerp(before[:, joints], quaternions[:, joints], share)
    return replace(locked, quaternions=quaternion_continuous(quaternions, dim=0).numpy())
