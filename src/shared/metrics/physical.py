"""What one body's motion does, by kinematics: sliding feet, the floor, jerk, where it goes.

Needs no learned model. Each is the same computation for real and generated motion and means little
without the real row; figures over which a frozen pose has no say are NaN instead of perfect.

Letters: T frames, K joints, N motions.
"""

from collections.abc import Sequence

import numpy as np

from ..motion.features import motion_heading
from ..motion.motion import Motion
from ..motion.postprocess.contacts import contact_runs, detect_contacts
from ..motion.skeleton import FOOT_JOINTS, JOINT_INDEX, REST_FOOT_HEIGHT

BALLS = [ball for _, ball in FOOT_JOINTS]


def ground_speed(positions: np.ndarray, fps: float) -> np.ndarray:
    """Horizontal speed [T - 1, ...] in m/s of positions [T, ..., 3]."""
    return np.asarray(np.linalg.norm(np.diff(positions[..., [0, 2]], axis=0), axis=-1) * fps)


def contact_slide(positions: np.ndarray, fps: float) -> float:
    """Mean horizontal speed in cm/s of the balls of the feet over frames in contact; NaN without.
    `detect_contacts` itself asks for a slow foot: read it together with `support_slide`."""
    contact = detect_contacts(positions, fps)[:-1] > 0.5  # [T - 1, 2]
    speed = ground_speed(positions[:, BALLS], fps)
    return 100 * _mean(speed[contact])


def penetration(positions: np.ndarray) -> float:
    """Mean depth in cm of the lowest ball of a foot below its rest height."""
    lowest = positions[:, BALLS, 1].min(1)
    return float(100 * (REST_FOOT_HEIGHT - lowest).clip(min=0).mean())


def mean_jerk(positions: np.ndarray, fps: float) -> float:
    """Mean norm of the third difference in m/s^3 of positions [T, K, 3]; NaN below 4 frames."""
    if len(positions) < 4:
        return float("nan")
    return float(np.linalg.norm(np.diff(positions, n=3, axis=0), axis=-1).mean() * fps**3)


def worst_acceleration(motion: Motion) -> np.ndarray:
    """m/s² of the worst joint [T - 2]."""
    positions = motion.positions().astype(np.float64)
    return np.asarray(joint_rates(positions, motion.fps, 2).max(1))


def foot_jump(motion: Motion) -> float:
    """Largest acceleration of an ankle or a ball, m/s²: 180 where a foot is 20 cm away in the next
    of 30 frames a second."""
    positions = motion.positions()[:, np.ravel(FOOT_JOINTS)].astype(np.float64)
    return float(joint_rates(positions, motion.fps, 2).max())


def joint_rates(positions: np.ndarray, fps: float, order: int) -> np.ndarray:
    """Size [T - order, K] of the derivative of positions [T, K, 3] of an order, metres, seconds."""
    return np.asarray(np.linalg.norm(np.diff(positions, n=order, axis=0) * fps**order, axis=-1))


HANDS = [JOINT_INDEX["l_wrist"], JOINT_INDEX["r_wrist"]]
SUPPORT_HEIGHT = 0.06  # metres above the rest height: higher than this, no foot carries the body


def support_slide(positions: np.ndarray, fps: float) -> float:
    """Mean horizontal speed in cm/s of the lower foot, over frames where it is near the floor: some
    foot carries the body unless it is in the air, so that gliding cannot escape."""
    return 100 * _mean(support_speed(positions, fps))


def physics(motion: Motion) -> dict[str, float]:
    """Figures of a motion of at least two frames; a slide is NaN when no foot is on the ground."""
    positions = motion.positions().astype(np.float64)
    return {
        "contact_slide": contact_slide(positions, motion.fps),  # cm/s
        "support_slide": support_slide(positions, motion.fps),  # cm/s
        "penetration": penetration(positions),  # cm
        "jerk": mean_jerk(positions, motion.fps),  # m/s³, mean over all joints
        "hand_jerk": mean_jerk(positions[:, HANDS], motion.fps),  # of both wrists
        "speed": float(ground_speed(positions[:, 0], motion.fps).mean()),  # m/s, of the pelvis
    }


# ---------------------------------------------------------------- feet and floor

GRAVITY = 9.81  # m/s²
SKATING = 0.1  # m/s of a foot that carries the body
SUNK = 0.01  # metres below the standing height of the ball of a foot
FLOATING = 0.02  # metres above it; real feet roll and skin is soft
MIN_PATH = 0.5  # metres over the ground, below which a slide a metre is noise
MIN_SPEED = 0.01  # m/s, mean of all joints: slower is a frozen pose
MIN_PUSH = 0.01  # m/s²: a smaller greatest acceleration is rounding
PFC_FPS = 30.0  # of the published figures


def contact(motion: Motion) -> dict[str, float]:
    """Figures of one motion of at least two frames; NaN where there is nothing to judge.
    Raises ValueError: NaN or infinity."""
    positions = motion.positions().astype(np.float64)
    if not np.isfinite(positions).all():
        raise ValueError("positions hold NaN or infinity")
    fps = motion.fps
    height = positions[..., 1].min(1) - REST_FOOT_HEIGHT  # T
    floating, flying = unsupported(positions, fps)
    claimed = motion.contacts[:-1] > 0.5  # T-1 2
    speed = ground_speed(positions[:, BALLS], fps)  # T-1 2
    return {
        # cm/s of a foot while the motion itself says that it stands, and % of frames with a claim
        "claimed_slide": 100 * _mean(speed[claimed]),
        "claimed_frames": 100 * float((motion.contacts > 0.5).any(1).mean()),
        # % of supported frames whose lower foot is faster than 10 cm/s
        "skating_frames": 100 * _mean(support_speed(positions, fps) > SKATING),
        "slide_per_metre": slide_per_metre(positions, fps),  # cm
        "sunk_depth": 100 * float((-height).clip(min=0).mean()),  # cm, of the lowest joint
        "sunk_frames": 100 * float((height < -SUNK).mean()),  # % deeper than 1 cm
        # cm, of the lowest joint where nothing carries the body; % of such frames; % of flights
        "float_height": 100 * float(np.where(floating, height, 0.0).mean()),
        "floating_frames": 100 * float(floating.mean()),
        "flying_frames": 100 * float(flying.mean()),
        "jerk_per_speed": jerk_per_speed(positions, fps),  # 1/s²
        "pfc": pfc(positions, fps),
    }


def _mean(values: np.ndarray) -> float:
    return float(values.mean()) if values.size else float("nan")


def support_speed(positions: np.ndarray, fps: float) -> np.ndarray:
    """Horizontal m/s of the lower ball of a foot in each frame where it is near the floor, however
    fast: at most T-1 values of positions [T, 22, 3]."""
    balls = positions[:, BALLS]  # T 2 3
    frames, lower = np.arange(len(balls) - 1), balls[:-1, :, 1].argmin(1)
    near = balls[frames, lower, 1] < REST_FOOT_HEIGHT + SUPPORT_HEIGHT
    return np.asarray(ground_speed(balls, fps)[frames, lower][near])


def slide_per_metre(positions: np.ndarray, fps: float) -> float:
    """Centimetres that the carrying foot slides for a metre of the pelvis's way: 100 of a body that
    glides, about 5 of mocap, NaN below half a metre (standing still is not good walking)."""
    way = float(ground_speed(positions[:, 0], fps).sum() / fps)
    slid = float(support_speed(positions, fps).sum() / fps)
    return 100 * slid / way if way >= MIN_PATH else float("nan")


def unsupported(positions: np.ndarray, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """Frames [T] in which the body floats, and in which it flies: no joint of positions [T, K, 3]
    is within 2 cm of where the ball of a standing foot is.

    A run of such frames is a flight if the mean of the joints falls at more than half of g, by the
    parabola through the run and one frame on either side, where there is one. Lying and sitting
    bodies whose feet are up float a little, as joints lie inside a body.
    """
    high = positions[..., 1].min(1) > REST_FOOT_HEIGHT + FLOATING
    centre = positions[..., 1].mean(1)
    flying = np.zeros_like(high)
    for start, stop in contact_runs(high, 0):
        around = centre[max(start - 1, 0) : stop + 1]
        if len(around) > 2:
            curve = np.polyfit(np.arange(len(around)) / fps, around, 2)[0]
            flying[start:stop] = 2 * curve < -GRAVITY / 2
    return high & ~flying, flying


# ---------------------------------------------------------------- roughness, and EDGE's score


def jerk_per_speed(positions: np.ndarray, fps: float) -> float:
    """Mean jerk over mean speed of the joints in 1/s², of positions [T, K, 3]; NaN for a frozen
    pose (whose jerk is best) and below 4 frames. Playing faster by f multiplies it by f²."""
    speed = float(np.linalg.norm(np.diff(positions, axis=0), axis=-1).mean() * fps)
    return mean_jerk(positions, fps) / speed if speed >= MIN_SPEED else float("nan")


def pfc(positions: np.ndarray, fps: float) -> float:
    """Physical foot contact score of Tseng et al. 2023 (EDGE, §5), of positions [T, 22, 3].

    10⁴ × mean of (speed of the stiller joint of the left foot × the same of the right × the
    pelvis's acceleration, without its downward part, over its greatest in the clip).

    Known faults, kept because the figure is asked for:
    - a still body has no greatest acceleration: NaN here, and NaN for a steady glide too, the worst
      slide there is;
    - the division by the greatest makes it depend on the clip's length and on one rough frame: a
      single spike improves the score of all the others;
    - the less a body moves the better, and one standing foot excuses the other;
    - the published code takes metres a *frame*, so it grows with the square of the frame time; here
      they are of 1/30 s whatever the frame rate. Its fingers, toes and floor are SMPL's.
    """
    if len(positions) < 3:
        return float("nan")
    push = np.diff(positions[:, 0], n=2, axis=0) * fps**2  # T-2 3
    push[:, 1] = push[:, 1].clip(min=0)
    strength = np.linalg.norm(push, axis=-1)
    if strength.max() < MIN_PUSH:
        return float("nan")
    speed = ground_speed(positions[1:, np.array(FOOT_JOINTS)], fps) / PFC_FPS  # T-2 foot joint
    stiller = speed.min(-1)
    return float(1e4 * (stiller.prod(-1) * strength / strength.max()).mean())


# ---------------------------------------------------------------- travel

MIN_TRAVEL = 0.5  # metres: below this a direction is noise


def travel(motion: Motion) -> np.ndarray:
    """Net travel of a motion of at least two frames, seen from its first frame.

    Returns:
        [3]: speed, m/s, the path of the pelvis over the ground; direction, radians from where it
        faces at first, + = to its left, NaN below 0.5 m; turn, radians of heading gained, + = left.
    """
    heading = motion_heading(motion)
    path = motion.root_position[:, [0, 2]].astype(np.float64)  # x, z
    seconds = (motion.num_frames - 1) / motion.fps
    across, along = path[-1] - path[0]
    direction = float("nan")
    if np.hypot(across, along) >= MIN_TRAVEL:
        direction = float(_wrap(np.arctan2(across, along) - float(heading[0])))
    speed = np.linalg.norm(np.diff(path, axis=0), axis=-1).sum() / seconds
    return np.array([speed, direction, float(heading[-1] - heading[0])])


def _wrap(angle: np.ndarray) -> np.ndarray:
    """Radians into -pi..pi."""
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)


def travel_error(
    motions: Sequence[np.ndarray], references: Sequence[np.ndarray]
) -> dict[str, np.ndarray]:
    """Absolute differences of `travel` to real motions of the same captions, row by row [N].

    Returns:
        speed in m/s; direction in degrees, NaN where the reference has none, 90 for a motion that
        stands where its reference travels; turn in degrees.
    """
    ours, real = (np.reshape(side, (-1, 3)).T for side in (motions, references))
    off = np.abs(np.degrees(_wrap(ours[1] - real[1])))
    off = np.where(np.isnan(ours[1]), 90.0, off)
    return {
        "speed": np.abs(ours[0] - real[0]),
        "direction": np.where(np.isnan(real[1]), np.nan, off),
        "turn": np.abs(np.degrees(ours[2] - real[2])),
    }
