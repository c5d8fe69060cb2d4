// Features [T, 23, 6] <-> motions: src/shared/motion/features.py. `Features` are flat
// Float32Arrays; a motion is { frames, quaternions [T,22,4], root [T,3], contacts [T,2], fps, text }.

import {
  apply, clamp, continuous, headingAngle, matrixOf, matrixOf6d, multiply, quaternionOf, unwrap,
  write6d, yawMatrix,
} from "./rotations.js";
import { round } from "./curves.js";
import { FPS, INDEX, JOINTS, SKELETON } from "./skeleton.js";

export const ROWS = 23;
export const WIDTH = ROWS * 6; // numbers a frame
export const ROOT = 22 * 6; // where the root row begins
export const [FORWARD, LATERAL, HEIGHT, YAW_RATE, LEFT_CONTACT] = [0, 1, 2, 3, 4];
const MIRROR_SIGNS = [1, -1, -1, -1, 1, 1]; // of the first two columns of a matrix
const TURNED_OVER = -0.5; // cosine: a pelvis that is tilted by more, 120 degrees, has no heading
export const ORIGIN = { x: 0, z: 0, heading: 0 };

export const framesOf = (features) => features.length / WIDTH;
export const cut = (features, start, stop = Infinity) => features.slice(start * WIDTH, stop * WIDTH);

export const framesOfMotion = (motion, start, stop = motion.frames) => ({
  ...motion,
  frames: stop - start,
  quaternions: motion.quaternions.slice(start * JOINTS * 4, stop * JOINTS * 4),
  root: motion.root.slice(start * 3, stop * 3),
  contacts: motion.contacts.slice(start * 2, stop * 2),
});

/** Frames from start to stop lose the means of these columns of the root row, in place: see without_drift. */
export function removeDrift(features, columns, start = 0, stop = framesOf(features)) {
  for (const column of columns) {
    let sum = 0;
    for (let t = start; t < stop; t++) sum += features[t * WIDTH + ROOT + column];
    for (let t = start; t < stop; t++) features[t * WIDTH + ROOT + column] -= sum / (stop - start);
  }
}

/** Features so many times as fast, or in so many frames: between two frames a share of both, and it goes as far as they do. */
export function hastened(features, times, frames = Math.max(1, round(framesOf(features) / times))) {
  const made = framesOf(features), last = made - 1;
  if (!made || (times === 1 && frames === made)) return features;
  const fast = new Float32Array(frames * WIDTH), columns = [FORWARD, LATERAL, YAW_RATE];
  const gone = columns.map((column) => {
    const sums = new Float64Array(made + 1);
    for (let t = 0; t < made; t++) sums[t + 1] = sums[t] + features[t * WIDTH + ROOT + column];
    return sums;
  });
  const way = (sums, at) => { const t = Math.min(Math.floor(at), last); return sums[t] + (at - t) * (sums[t + 1] - sums[t]); };
  for (let t = 0; t < frames; t++) {
    const at = frames > 1 ? (t * last) / (frames - 1) : 0, before = Math.floor(at), after = Math.min(before + 1, last), share = at - before;
    for (let c = 0; c < WIDTH; c++)
      fast[t * WIDTH + c] = features[before * WIDTH + c] + share * (features[after * WIDTH + c] - features[before * WIDTH + c]);
    columns.forEach((column, i) => { fast[t * WIDTH + ROOT + column] = way(gone[i], (t + 1) * (made / frames)) - way(gone[i], t * (made / frames)); });
  }
  return fast;
}

/** The mirror image of features [T,R,6], or of a mask of their entries. */
export function mirrored(values, mask = false) {
  const found = new values.constructor(values.length), { names } = SKELETON;
  const places = names.map((name) => INDEX[name.replace(/^[lr]_/u, (side) => (side === "l_" ? "r_" : "l_"))]);
  for (let row = 0; row < values.length; row += 6) {
    const joint = (row / 6) % (JOINTS + 1), from = row + 6 * ((places[joint] ?? joint) - joint), root = joint === JOINTS;
    for (let c = 0; c < 6; c++) {
      const of = root && c >= LEFT_CONTACT ? (c === LEFT_CONTACT ? c + 1 : c - 1) : c;
      const sign = root ? ([LATERAL, YAW_RATE].includes(c) ? -1 : 1) : MIRROR_SIGNS[c];
      found[row + c] = (mask ? 1 : sign) * values[from + of];
    }
  }
  return found;
}

export function joinArrays(parts, Kind = Float32Array) {
  const whole = new Kind(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) { whole.set(part, at); at += part.length; }
  return whole;
}

/** Pelvis path [T,3] and heading [T] of the root rows, from a place on. */
export function integrateRoot(features, place = ORIGIN, fps = FPS, rate = (t, c) => features[t * WIDTH + ROOT + c], frames = framesOf(features)) {
  const path = new Float64Array(frames * 3), heading = new Float64Array(frames);
  let { x, z, heading: angle } = place;
  for (let t = 0; t < frames; t++) {
    path.set([x, rate(t, HEIGHT), z], t * 3);
    heading[t] = angle;
    const [sine, cosine] = [Math.sin(angle), Math.cos(angle)];
    const [forward, lateral] = [rate(t, FORWARD), rate(t, LATERAL)];
    x += (forward * sine + lateral * cosine) / fps;
    z += (forward * cosine - lateral * sine) / fps;
    angle += rate(t, YAW_RATE) / fps;
  }
  return { path, heading, end: { x, z, heading: angle } };
}

export function decodeFeatures(features, place = ORIGIN, text = "", fps = FPS) {
  const frames = framesOf(features);
  const { path, heading } = integrateRoot(features, place, fps);
  const quaternions = new Float32Array(frames * JOINTS * 4), contacts = new Float32Array(frames * 2);
  for (let t = 0; t < frames; t++) {
    for (let joint = 0; joint < JOINTS; joint++) {
      let matrix = matrixOf6d(features, t * WIDTH + joint * 6);
      if (joint === 0) matrix = multiply(yawMatrix(heading[t]), matrix);
      quaternions.set(quaternionOf(matrix), (t * JOINTS + joint) * 4);
    }
    for (const side of [0, 1]) contacts[t * 2 + side] = clamp(features[t * WIDTH + ROOT + LEFT_CONTACT + side], 0, 1);
  }
  continuous(quaternions, JOINTS * 4);
  return { frames, quaternions, root: Float32Array.from(path), contacts, fps, text };
}

/** Unwrapped heading [T] of pelvis rotations, matrices; who is upside down has none, and turns evenly from the one before to the one after. */
export function headings(matrices) {
  const angles = Float64Array.from(matrices, headingAngle), upright = [];
  matrices.forEach((pelvis, t) => { if (pelvis[4] > TURNED_OVER) upright.push(t); });
  if (!upright.length || upright.length === angles.length) return unwrap(angles);
  const kept = unwrap(Float64Array.from(upright, (t) => angles[t]));
  for (let t = 0, next = 0; t < angles.length; t++) {
    while (next < upright.length && upright[next] < t) next++;
    const [before, after] = [Math.max(next - 1, 0), Math.min(next, upright.length - 1)], apart = upright[after] - upright[before];
    angles[t] = kept[before] + (kept[after] - kept[before]) * (apart ? clamp((t - upright[before]) / apart, 0, 1) : 0);
  }
  return angles;
}

export const headingsOf = (motion) => headings(Array.from({ length: motion.frames }, (_, t) => matrixOf(motion.quaternions, t * JOINTS * 4)));

export function placeOf(motion, t) {
  return { x: motion.root[t * 3], z: motion.root[t * 3 + 2], heading: headingsOf(motion)[t] };
}

export function encodeFeatures(motion) {
  const { frames, fps } = motion;
  const features = new Float32Array(frames * WIDTH), heading = headingsOf(motion);
  for (let t = 0; t < frames; t++) {
    const level = yawMatrix(-heading[t]);
    for (let joint = 0; joint < JOINTS; joint++) {
      const matrix = matrixOf(motion.quaternions, (t * JOINTS + joint) * 4);
      write6d(joint === 0 ? multiply(level, matrix) : matrix, features, t * WIDTH + joint * 6);
    }
    const root = t * WIDTH + ROOT;
    const u = Math.max(Math.min(t, frames - 2), 0); // the last difference repeats
    const step = frames < 2 ? [0, 0, 0] : [0, 1, 2].map((i) => (motion.root[(u + 1) * 3 + i] - motion.root[u * 3 + i]) * fps);
    const [lateral, , forward] = apply(level, step);
    const turn = frames < 2 ? 0 : (heading[u + 1] - heading[u]) * fps;
    features.set([forward, lateral, motion.root[t * 3 + 1], turn, motion.contacts[t * 2], motion.contacts[t * 2 + 1]], root);
  }
  return features;
}
