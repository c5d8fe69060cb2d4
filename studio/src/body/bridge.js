// The way from one posture to another that lies too far away for a seam: a port of that part of
// stitching.py in src/shared/motion/postprocess, which says why.

import { ROOT, FORWARD, framesOf, HEIGHT, LATERAL, LEFT_CONTACT, WIDTH, YAW_RATE } from "./features.js";
import { axisTurn, clamp, conjugate, dot, expOf, logOf, matrixOf, matrixOf6d, multiply, product, quaternionOf, scale, write6d } from "./rotations.js";
import { FPS, INDEX, JOINTS, kinematics, REST_PELVIS_HEIGHT, SKELETON } from "./skeleton.js";

const LEAP_SECONDS = 0.5, LEAP_HEIGHT = 0.3, LEAP_TILT = 0.64, UPRIGHT = 0.5, LOW = 0.75, SEAT = 0.35, IN_THE_AIR = 0.3;
const EDGE = 1, STEP = 0.6, STOPPING = 0.1, STAYS = 0.2, FLAT = 0.02, SHARP = 60, FLOORED = [0.2, 0.4];
const CLEAR = { ankle: 0.08, foot: 0.02, wrist: 0.03, elbow: 0.04, knee: 0.05, pelvis: 0.09 };
const POSES = {
  standing: { hip: [-6, 4, 0], knee: [19, 0, 0], ankle: [-13, 2, 0], shoulder: [7, -10, -72], elbow: [6, -28, 1] },
  crouched: {
    pelvis: [25, 0, 0], hip: [-118, 17, 10], knee: [138, 0, 0], ankle: [-16, -4, 5], foot: [-29, 0, 0], spine1: [11, 0, 0],
    spine2: [13, 0, 0], spine3: [13, 0, 0], neck: [-20, 0, 0], head: [-20, 0, 0], shoulder: [0, -40, -62], elbow: [6, -20, 3],
  },
  propped: {
    pelvis: [45, 0, 0], hip: [-149, 3, 5], knee: [125, 0, 0], ankle: [14, 5, -5], foot: [-34, 0, 0], spine1: [20, 0, 0], spine2: [24, 0, 0],
    spine3: [24, 0, 0], neck: [-38, 0, 0], head: [-45, 0, 0], collar: [-1, -7, 9], shoulder: [-38, -65, -35], elbow: [10, -25, 2], wrist: [9, -4, 50],
  },
  seated: {
    pelvis: [-12, 0, 0], hip: [-140, 1, 1], spine1: [7, 0, 0], knee: [120, 0, 0], spine2: [8, 0, 0], ankle: [33, 5, 2],
    spine3: [8, 0, 0], neck: [-3, 0, 0], head: [-4, 0, 0], shoulder: [46, 19, -69], elbow: [6, -12, 1], wrist: [5, -3, 60],
  },
};
const WAYS = {
  crouched: [], standing: ["crouched"], seated: ["crouched"], prone: ["propped", "crouched"],
  lying: ["seated", "crouched"], airborne: ["standing", "crouched"],
};
const HIGH = ["standing", "airborne"];

const heightOf = (features, t) => features[t * WIDTH + ROOT + HEIGHT];
const upOf = (features, t) => { const m = matrixOf6d(features, t * WIDTH); return [m[1], m[4], m[7]]; };
const eased = (share) => { const x = clamp(share, 0, 1); return x ** 3 * (10 + x * (6 * x - 15)); };
const clearOf = (joint) => CLEAR[SKELETON.names[joint].replace(/^[lr]_/u, "")] ?? 0.08;
const heightsOf = ({ positions }) => positions.map(([, y], joint) => y - clearOf(joint));

/** Whether a piece that begins after the last of `before` is soon far higher or lower, or tilted otherwise, than a body gets in that time. */
export function leaps(before, piece) {
  const last = framesOf(before) - 1, up = upOf(before, last);
  for (let t = 0; t < Math.min(Math.round(LEAP_SECONDS * FPS), framesOf(piece)); t++)
    if (Math.abs(heightOf(piece, t) - heightOf(before, last)) > LEAP_HEIGHT || dot(upOf(piece, t), up) < LEAP_TILT) return true;
  return false;
}

const quaternionsAt = (features, t) => Array.from({ length: JOINTS }, (_, joint) => quaternionOf(matrixOf6d(features, t * WIDTH + joint * 6)));
const bodyOf = (quaternions, height) => kinematics(quaternions.map((q) => matrixOf(q)), [0, height, 0]);

export function posture(features, t) {
  const [, upright, ahead] = upOf(features, t), height = heightOf(features, t);
  if (upright < UPRIGHT) {
    if (ahead < 0) return "lying";
    return Math.min(...heightsOf(bodyOf(quaternionsAt(features, t), height))) > IN_THE_AIR ? "airborne" : "prone";
  }
  const share = height / REST_PELVIS_HEIGHT;
  return share < SEAT ? "seated" : share < LOW ? "crouched" : "standing";
}

/** Whether a piece begins in another posture than the frames before it end in. */
export const isApart = (before, piece) => posture(before, framesOf(before) - 1) !== posture(piece, 0);

/** From which frame on a piece is for who is low already, as the frames before it end: where posture and height are nearest to that, of what follows when it has gone down. */
export function goneDown(before, piece) {
  const start = posture(before, framesOf(before) - 1), postures = Array.from({ length: framesOf(piece) }, (_, t) => posture(piece, t));
  const down = postures.findLastIndex((name) => HIGH.includes(name)) + 1;
  if (HIGH.includes(start) || !HIGH.includes(postures[0]) || down === postures.length) return 0;
  const far = postures.map((name, t) => { // metres, and ten of them for each posture
    const postured = t < down ? Infinity : name === start ? 0 : 10 + 10 * between(start, name).length;
    return postured + Math.abs(Math.fround(heightOf(piece, t) - heightOf(before, framesOf(before) - 1)));
  });
  return far.indexOf(Math.min(...far));
}

/** Frames from how a body was to how it begins, by way of the postures between. */
export function bridge(before, after, longest = Infinity) {
  const last = framesOf(before) - 1, quaternions = [quaternionsAt(before, last), quaternionsAt(after, 0)];
  const [start, stop] = [posture(before, last), posture(after, 0)], names = [start, ...between(start, stop), stop];
  const keys = [quaternions[0], ...names.slice(1, -1).map(poseOf), quaternions[1]];
  const total = STEP * (keys.length - 2) + EDGE, frames = Math.min(Math.round(total * FPS), longest);
  const times = Array.from({ length: frames + 2 }, (_, t) => (t * total) / (frames + 1)); // both ends, too
  const steps = keys.slice(1).map((other, i) => other.map((q, joint) => logOf(product(conjugate(keys[i][joint]), q))));
  const was = quaternionsAt(before, Math.max(last - 1, 0)), moving = was.map((q, joint) => logOf(product(conjugate(q), keys[0][joint])));
  const shares = steps.map((_, i) => times.map((time) => eased((time - i * STEP) / EDGE)));
  const turned = times.map((time, t) => {
    const on = STOPPING * FPS * (1 - Math.exp(-time / STOPPING)) * (1 - eased(time / EDGE)); // as it moved at last
    return keys[0].map((q, joint) => steps.reduce(
      (sum, step, i) => product(sum, expOf(scale(step[joint], shares[i][t]))), product(q, expOf(scale(moving[joint], on)))));
  });
  const matrices = turned.map((each) => each.map((q) => matrixOf(q)));
  let bodies = matrices.map((local) => kinematics(local, [0, 0, 0]));
  const middle = ({ positions }, name, axis) => (positions[INDEX[`l_${name}`]][axis] + positions[INDEX[`r_${name}`]][axis]) / 2;
  if (names.includes("propped")) { // tilted such that hands and feet are on the floor, both
    const from = names[0] === "prone", near = from ? shares[1].map((share) => 1 - share) : shares.at(-2);
    const tilts = bodies.map((body) => {
      const [up, ahead] = [1, 2].map((axis) => middle(body, "wrist", axis) - middle(body, "foot", axis));
      return Math.atan2(up - CLEAR.wrist + CLEAR.foot, ahead);
    });
    const rest = from ? tilts[0] : tilts.at(-1);
    bodies = matrices.map((local, t) => {
      local[0] = multiply(axisTurn([1, 0, 0], near[t] ** 4 * clamp(tilts[t] - rest, -0.6, 0.6)), local[0]);
      return kinematics(local, [0, 0, 0]);
    });
  }
  const floor = bodies.map((body) => Math.log(heightsOf(body).reduce((sum, y) => sum + Math.exp(-SHARP * y), 0)) / SHARP);
  const ends = [heightOf(before, last) - floor[0], heightOf(after, 0) - floor.at(-1)];
  const above = times.map((time) => ends[0] + eased(time / total) * (ends[1] - ends[0]));
  const carried = times.map((_, t) => clamp((floor[t] + above[t] - FLOORED[0]) / (FLOORED[1] - FLOORED[0]), 0, 1) * clamp(1 - above[t] / IN_THE_AIR, 0, 1));
  const made = new Float32Array(frames * WIDTH), from = last * WIDTH + ROOT;
  const goes = (t, name, axis) => bodies[t + 1].positions[INDEX[name]][axis] - bodies[t].positions[INDEX[name]][axis];
  for (let t = 1; t <= frames; t++) {
    const at = (t - 1) * WIDTH, root = at + ROOT, fading = Math.exp(-times[t] / STOPPING), loose = (1 - carried[t]) * fading;
    matrices[t].forEach((matrix, joint) => write6d(matrix, made, at + joint * 6));
    const flat = ["l_ankle", "r_ankle"].map((name) => Math.exp(-bodies[t + 1].positions[INDEX[name]][1] / FLAT)), all = flat[0] + flat[1];
    const [lateral, forward] = [0, 2].map((axis) => (-carried[t + 1] * (flat[0] * goes(t, "l_ankle", axis) + flat[1] * goes(t, "r_ankle", axis)) * FPS) / all);
    made[root + FORWARD] = forward + loose * before[from + FORWARD];
    made[root + LATERAL] = lateral + loose * before[from + LATERAL];
    made[root + YAW_RATE] = fading * before[from + YAW_RATE];
    made[root + HEIGHT] = floor[t] + above[t];
    ["l_foot", "r_foot"].forEach((name, side) => {
      const stays = Math.hypot(goes(t, name, 0) * FPS + lateral, goes(t, name, 2) * FPS + forward) < STAYS;
      made[root + LEFT_CONTACT + side] = Number(stays && carried[t] > 0);
    });
  }
  return made;
}

/** The postures on the way from one to another. */
function between(start, stop) {
  const there = [start, ...WAYS[start]], back = [stop, ...WAYS[stop]], met = there.find((name) => back.includes(name));
  return [...there.slice(0, there.indexOf(met) + 1), ...back.slice(0, back.indexOf(met)).reverse()].slice(1, -1);
}

function poseOf(name) {
  return SKELETON.names.map((joint) => {
    const [x, y, z] = POSES[name][joint.replace(/^[lr]_/u, "")] ?? [0, 0, 0], sign = joint.startsWith("r_") ? -1 : 1;
    return expOf(scale([x, sign * y, sign * z], Math.PI / 180));
  });
}
