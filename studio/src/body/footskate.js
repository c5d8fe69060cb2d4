// Standing feet stay where they are, by inverse kinematics: a port of
// src/shared/motion/postprocess/footskate.py, which says why.

import {
  add, apply, axisTurn, clamp, continuous, cross, dot, multiply, norm, quaternionOf, scale,
  shortestTurn, slerp, sub, transposed, unit,
} from "./rotations.js";
import { gaussian } from "./curves.js";
import { footShifts } from "./contacts.js";
import { WIDTH } from "./features.js";
import { FEET, JOINTS, LEG_LENGTH, LEGS, pose, SKELETON } from "./skeleton.js";

const MIN_CORRECTION = 1e-4, FIRST = 1.5 / 30, LAST = 0.5 / 30, EASE = 10;
const MAX_STRETCH = 0.995, RISE_AT = 0.97, MAX_RISE = 0.8, RISE_SECONDS = 1 / 30, STRAIGHT = 0.02, BENT = 0.1;

/** Which leg has a known joint: entries [T,R,C] -> [2][T]. */
export function keptLegs(known) {
  const frames = known.length / WIDTH;
  return LEGS.map(([hip, knee, ankle]) =>
    Array.from({ length: frames }, (_, t) =>
      [hip, knee, ankle].some((joint) => {
        for (let c = 0; c < 6; c++) if (known[t * WIDTH + joint * 6 + c]) return true;
        return false;
      })));
}

export const nothingKept = (frames) => [0, 1].map(() => new Array(frames).fill(false));

export function lockFeet(motion, kept = null) {
  const frames = motion.frames;
  const poses = Array.from({ length: frames }, (_, t) => pose(motion, t));
  const balls = FEET.map(({ ball }) => poses.map(({ positions }) => positions[ball]));
  const hips = LEGS.map(([hip]) => poses.map(({ positions }) => positions[hip]));
  const claims = [0, 1].map((side) => Array.from({ length: frames }, (_, t) => motion.contacts[t * 2 + side]));
  const { shifts, planted } = footShifts(balls, hips, claims, motion.fps, kept ?? nothingKept(frames));
  const quaternions = motion.quaternions.slice(), contacts = new Float32Array(frames * 2);
  for (const side of [0, 1]) {
    const moves = shifts[side].map((shift) => norm(shift) > MIN_CORRECTION);
    const rises = shifts[side].map((shift, t) => (moves[t] ? heelRise(side, poses[t], shift) : { angle: 0 }));
    const angles = gaussian(rises.map(({ angle }) => angle), RISE_SECONDS * motion.fps);
    for (let t = 0; t < frames; t++) {
      contacts[t * 2 + side] = kept?.[side][t] ? claims[side][t] : Number(planted[side][t]);
      if (!moves[t]) continue;
      for (const [joint, q] of movedLeg(side, poses[t], shifts[side][t], axisTurn(rises[t].axis, angles[t]))) {
        const at = (t * JOINTS + joint) * 4;
        let along = 0;
        for (let i = 0; i < 4; i++) along += q[i] * motion.quaternions[at + i];
        quaternions.set(along < 0 ? q.map((x) => -x) : q, at);
      }
    }
  }
  return { ...motion, quaternions, contacts };
}

function movedLeg(side, { positions, world }, shift, rise) {
  const [hip, knee, ankle, ball] = LEGS[side];
  const target = add(positions[ball], shift), lever = sub(positions[ankle], positions[ball]);
  const [thigh, shin] = twoBones(
    positions[hip], world[hip], world[knee], SKELETON.offsets[knee], SKELETON.offsets[ankle],
    add(target, apply(rise, lever)));
  const chain = [world[SKELETON.parents[hip]], thigh, shin, multiply(rise, world[ankle]), world[ball]];
  return [hip, knee, ankle, ball].map((joint, i) => [joint, quaternionOf(multiply(transposed(chain[i]), chain[i + 1]))]);
}

/** For a body that a path carries: locked twice, the legs smoothed after each time. */
export function lockCarriedFeet(motion, kept = null) {
  return smoothLegs(lockFeet(smoothLegs(lockFeet(motion, kept), FIRST, kept), kept), LAST, kept);
}

function smoothLegs(motion, seconds, kept) {
  const quaternions = motion.quaternions.slice(), width = JOINTS * 4;
  LEGS.forEach((joints, side) => {
    for (const joint of joints) {
      const own = new Float64Array(motion.frames * 4);
      for (let t = 0; t < motion.frames; t++) own.set(motion.quaternions.subarray(t * width + joint * 4, t * width + joint * 4 + 4), t * 4);
      continuous(own, 4);
      const rows = [0, 1, 2, 3].map((i) => gaussian(Array.from({ length: motion.frames }, (_, t) => own[t * 4 + i]), seconds * motion.fps));
      for (let t = 0; t < motion.frames; t++) {
        if (kept?.[side][t]) continue;
        const size = Math.hypot(...rows.map((row) => row[t]));
        quaternions.set(rows.map((row) => row[t] / size), t * width + joint * 4);
      }
    }
  });
  return { ...motion, quaternions };
}

/** Legs held little by little from where they are kept. */
export function easeFromKept(loose, locked, kept) {
  const quaternions = locked.quaternions.slice();
  LEGS.forEach((joints, side) => {
    const away = awayFrom(kept[side]);
    for (let t = 0; t < locked.frames; t++) {
      const x = Math.min(away[t] / EASE, 1), share = x * x * (3 - 2 * x);
      for (const joint of joints) {
        const at = (t * JOINTS + joint) * 4;
        quaternions.set(slerp(Array.from(loose.quaternions.subarray(at, at + 4)), Array.from(locked.quaternions.subarray(at, at + 4)), share), at);
      }
    }
  });
  return { ...locked, quaternions: continuous(quaternions, JOINTS * 4) };
}

/** Frames to the nearest kept one. */
function awayFrom(kept) {
  const away = kept.map((is) => (is ? 0 : Infinity));
  for (let t = 1; t < away.length; t++) away[t] = Math.min(away[t], away[t - 1] + 1);
  for (let t = away.length - 2; t >= 0; t--) away[t] = Math.min(away[t], away[t + 1] + 1);
  return away;
}

// ---------------------------------------------------------------- one leg

/** Axis and angle of the smallest rotation of a foot about its ball that lets the leg reach. */
function heelRise(side, { positions }, shift) {
  const [hip, , ankle, ball] = LEGS[side].map((joint) => positions[joint]);
  const longest = Math.max(norm(sub(ankle, hip)), RISE_AT * LEG_LENGTH), lever = sub(ankle, ball);
  const up = sub(hip, add(ball, shift)), arm = norm(lever), distance = norm(up);
  const cosine = (arm * arm + distance * distance - longest * longest) / (2 * arm * distance);
  const axis = cross(lever, up), angle = Math.atan2(norm(axis), dot(lever, up));
  return { axis: unit(axis), angle: clamp(angle - Math.acos(clamp(cosine, -1, 1)), 0, MAX_RISE) };
}

export function twoBones(hip, thigh, shin, upper, lower, target, hinge = [-1, 0, 0]) {
  const lengthUpper = norm(upper), lengthLower = norm(lower);
  const before = norm(add(apply(thigh, upper), apply(shin, lower)));
  const longest = Math.max(before, MAX_STRETCH * (lengthUpper + lengthLower));
  const shortest = 1.05 * Math.abs(lengthUpper - lengthLower) + 0.05;
  const wanted = norm(sub(target, hip));
  const reach = Math.max(Math.min(wanted, longest), Math.min(before, shortest));
  for (let round = 0; round < 2; round++) {
    const toKnee = apply(thigh, upper), toAnkle = add(toKnee, apply(shin, lower));
    const axis = kneeAxis(toAnkle, toKnee, apply(thigh, hinge)), length = norm(toAnkle);
    const atHip = corner(lengthUpper, reach, lengthLower) - corner(lengthUpper, length, lengthLower);
    const atKnee = corner(lengthUpper, lengthLower, reach) - corner(lengthUpper, lengthLower, length);
    thigh = multiply(axisTurn(axis, atHip), thigh);
    shin = multiply(axisTurn(axis, atHip + atKnee), shin);
    const swing = shortestTurn(add(apply(thigh, upper), apply(shin, lower)), sub(target, hip));
    thigh = multiply(swing, thigh);
    shin = multiply(swing, shin);
  }
  return [thigh, shin];
}

const corner = (a, b, opposite) => Math.acos(clamp((a * a + b * b - opposite * opposite) / (2 * a * b), -1, 1));

function kneeAxis(toAnkle, toKnee, hinge) {
  const normal = cross(toAnkle, toKnee);
  const sine = norm(normal) / Math.max(norm(toAnkle) * norm(toKnee), 1e-9);
  const own = clamp((sine - STRAIGHT) / (BENT - STRAIGHT), 0, 1), along = unit(toAnkle);
  hinge = sub(hinge, scale(along, dot(hinge, along)));
  return unit(add(scale(unit(normal), own), scale(unit(hinge), 1 - own)));
}
