// What a motion does, read off its joints, and which action that is: the parts of
// src/shared/metrics/measurements.py that decide whether a window is sampled again.

import { gradient, percentile, round } from "./curves.js";
import { headingsOf } from "./features.js";
import { INDEX, pose, REST_PELVIS_HEIGHT, SKELETON } from "./skeleton.js";

const AT_REST = 3, HAND_DOWN = 0.15;

/** Whether a body stands upright in its last frames, hands hanging. */
export function endsAtRest(motion) {
  const trunk = ["spine1", "spine2", "spine3", "neck", "head"];
  const standing = 0.92 * (REST_PELVIS_HEIGHT + trunk.reduce((sum, name) => sum + SKELETON.offsets[INDEX[name]][1], 0));
  for (let t = Math.max(0, motion.frames - AT_REST); t < motion.frames; t++) {
    const { positions } = pose(motion, t);
    if (!(positions[INDEX.head][1] > standing)) return false;
    if (["l_wrist", "r_wrist"].some((name) => positions[INDEX[name]][1] - positions[0][1] >= HAND_DOWN)) return false;
  }
  return true;
}

/** Centred moving average of a curve; the ends are repeated. */
function smooth(values, frames) {
  const width = Math.max(Math.floor(Math.min(frames, values.length) / 2) * 2 + 1, 1), half = width >> 1, last = values.length - 1;
  return values.map((_, at) => {
    let sum = 0;
    for (let i = -half; i <= half; i++) sum += values[Math.min(Math.max(at + i, 0), last)];
    return sum / width;
  });
}

function countPeaks(values, high, low) {
  let count = 0, armed = values[0] <= high;
  for (const value of values) {
    if (armed && value > high) { count++; armed = false; }
    else if (value < low) armed = true;
  }
  return count;
}

const column = (points, axis) => points.map((point) => point[axis]);
const smoothPoints = (points, frames) => {
  const axes = [0, 1, 2].map((axis) => smooth(column(points, axis), frames));
  return points.map((_, t) => [axes[0][t], axes[1][t], axes[2][t]]);
};
const sub = (a, b) => a.map((point, t) => [point[0] - b[t][0], point[1] - b[t][1], point[2] - b[t][2]]);
const sizes = (points) => points.map((point) => Math.hypot(...point));
const sum = (values) => values.reduce((a, b) => a + b, 0);
const range = (values) => [Math.min(...values), Math.max(...values)];

export function measure(motion) {
  const { fps, frames } = motion;
  const poses = Array.from({ length: frames }, (_, t) => pose(motion, t));
  const heading = smooth(Array.from(headingsOf(motion)), round(0.5 * fps));
  const cache = {};
  const joint = (name) => (cache[name] ??= smoothPoints(poses.map(({ positions }) => positions[INDEX[name]]), round(0.1 * fps)));
  const seen = (name) =>
    sub(joint(name), joint("pelvis")).map(([x, y, z], t) => {
      const [s, c] = [Math.sin(heading[t]), Math.cos(heading[t])];
      return [x * c - z * s, y, x * s + z * c];
    });
  const up = poses.map(({ world }) => [world[INDEX.spine3][1], world[INDEX.spine3][4], world[INDEX.spine3][7]]);
  const tracks = { fps, frames, heading, joint, seen, up, path: smoothPoints(joint("pelvis"), round(0.3 * fps)) };
  const x = gradient(column(tracks.path, 0)), z = gradient(column(tracks.path, 2));
  tracks.ground = x.map((value, t) => Math.hypot(value, z[t]) * fps);
  return { seconds: frames / fps, ...credibility(motion), ...travel(tracks), ...hands(tracks), ...armsAtWork(tracks), ...feet(tracks), ...heights(tracks) };
}

function credibility(motion) {
  const q = motion.quaternions, width = 88;
  let angles = 0, bodily = 0;
  for (let at = width; at < q.length; at += 4) {
    const before = at - width;
    const cosine = Math.abs(q[at] * q[before] + q[at + 1] * q[before + 1] + q[at + 2] * q[before + 2] + q[at + 3] * q[before + 3]);
    angles += Math.acos(Math.min(cosine, 1));
  }
  for (let t = 0; t < motion.frames; t++) {
    const [w, x, y, z] = q.subarray(t * width, t * width + 4), height = motion.root[t * 3 + 1];
    if ((1 - 2 * (x * x + z * z)) / Math.max(w * w + x * x + y * y + z * z, 1e-9) > 0.3 && height > 0.2 && height < 2) bodily++;
  }
  return { angularSpeed: ((2 * angles) / (q.length / 4 - 22)) * motion.fps, upright: bodily / motion.frames };
}

function travel({ fps, heading, path, seen }) {
  const forward = [], lateral = [], ground = [];
  for (let t = 0; t + 1 < path.length; t++) {
    const [dx, dz] = [path[t + 1][0] - path[t][0], path[t + 1][2] - path[t][2]];
    const [s, c] = [Math.sin(heading[t]), Math.cos(heading[t])];
    forward.push(dx * s + dz * c);
    lateral.push(dx * c - dz * s);
    ground.push(Math.hypot(dx, dz));
  }
  const moving = ground.map((step) => step * fps > 0.12), while_ = (values) => values.filter((_, t) => moving[t]);
  const seconds = Math.max(while_(ground).length / fps, 0.5);
  const net = [0, 1, 2].map((i) => path[path.length - 1][i] - path[0][i]);
  const [s, c] = [Math.sin(heading[0]), Math.cos(heading[0])];
  const total = [sum(lateral), sum(forward)], size = Math.max(Math.hypot(...total), 1e-6);
  const apart = sub(seen("l_ankle"), seen("r_ankle")).map((p) => (p[0] * total[0] + p[2] * total[1]) / size);
  return {
    forward: total[1],
    lateral: total[0],
    forwardNet: net[0] * s + net[2] * c,
    lateralNet: net[0] * c - net[2] * s,
    forwardSpeed: sum(while_(forward)) / seconds,
    lateralSpeed: sum(while_(lateral)) / seconds,
    cruise: moving.some(Boolean) ? percentile(while_(ground), 70) * fps : 0,
    stride: (percentile(apart, 97) - percentile(apart, 3)) / 2,
    yaw: heading[heading.length - 1] - heading[0],
  };
}

const armLength = () => Math.abs(SKELETON.offsets[INDEX.l_elbow][0]) + Math.abs(SKELETON.offsets[INDEX.l_wrist][0]);

function hands({ fps, joint, seen }) {
  const found = { handPeak: [], handTravel: [], handSwings: [] };
  for (const letter of "lr") {
    const above = sub(joint(`${letter}_wrist`), joint(`${letter}_shoulder`)).map((p) => p[1] / armLength());
    const own = sub(seen(`${letter}_wrist`), seen("spine3"));
    found.handPeak.push(percentile(above, 95));
    found.handTravel.push(sum(sizes(sub(own.slice(1), own.slice(0, -1)))));
    found.handSwings.push(swings(own.filter((_, t) => above[t] > -0.1)));
  }
  return found;
}

function swings(points) {
  if (points.length < 4) return 0;
  const centred = sub(points, smoothPoints(points, 31));
  const mean = [0, 1, 2].map((axis) => sum(column(centred, axis)) / centred.length);
  const spread = [0, 1, 2].map((i) => [0, 1, 2].map((j) => sum(centred.map((p) => (p[i] - mean[i]) * (p[j] - mean[j])))));
  const counts = mainAxes(spread).slice(0, 2).map((axis) => {
    const curve = centred.map((p) => p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2]);
    return countPeaks(curve, 0.03, -0.03) + countPeaks(curve.map((v) => -v), 0.03, -0.03);
  });
  return Math.max(...counts);
}

/** Eigenvectors of a symmetric 3x3 matrix, the largest eigenvalue first (Jacobi rotations). */
function mainAxes(matrix) {
  const a = matrix.map((row) => [...row]), v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; sweep++)
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(a[p][q]) < 1e-300) continue;
      const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1)), c = 1 / Math.hypot(t, 1), s = t * c;
      for (const rows of [a, v]) for (const row of rows) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
      for (let k = 0; k < 3; k++) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
    }
  return [0, 1, 2].sort((i, j) => a[j][j] - a[i][i]).map((i) => v.map((row) => row[i]));
}

function armsAtWork({ fps, heading, joint, seen, up, ground }) {
  const punches = [];
  for (const letter of "lr") {
    const arm = sub(joint(`${letter}_wrist`), joint(`${letter}_shoulder`)), length = sizes(arm);
    const reach = length.map((size) => size / armLength());
    const ahead = sub(seen(`${letter}_wrist`), seen(`${letter}_shoulder`));
    const fast = smooth(gradient(reach).map((v) => Number(v * fps > 1.5)), round(0.4 * fps));
    const extended = reach.map((value, t) => {
      const level = Math.abs(arm[t][0] * up[t][0] + arm[t][1] * up[t][1] + arm[t][2] * up[t][2]) < 0.6 * length[t];
      return level && ahead[t][2] > 0.25 && fast[t] > 0.05 ? value : Math.min(value, 0.7);
    });
    punches.push(countPeaks(extended, 0.85, 0.72));
  }
  const gap = sizes(sub(joint("l_wrist"), joint("r_wrist")));
  const [left, right] = [seen("l_wrist"), seen("r_wrist")];
  const closed = gap.map((value, t) => ((left[t][2] + right[t][2]) / 2 > 0.12 && (left[t][1] + right[t][1]) / 2 > 0.05 ? -value : -1));
  const pelvis = joint("pelvis");
  const tilt = up.map((axis, t) => {
    const along = axis[0] * Math.sin(heading[t]) + axis[2] * Math.cos(heading[t]);
    const degrees = (Math.asin(Math.min(Math.max(along, -1), 1)) * 180) / Math.PI;
    return pelvis[t][1] > 0.83 * REST_PELVIS_HEIGHT && ground[t] < 0.5 ? degrees : Math.min(degrees, 25);
  });
  const third = Math.max(round(fps / 3), 1), half = Math.floor(third / 2);
  const held = smooth(gap.map((value) => Number(value < 0.3)), third);
  const middle = left.map((p, t) => p.map((value, axis) => (value + right[t][axis]) / 2));
  const swept = sizes(sub(middle.slice(third), middle.slice(0, -third))).map((value, t) => (held[t + half] > 0.99 ? value : 0));
  const bent = smooth(tilt, 5), atFace = up.map(() => false);
  for (const wrist of [joint("l_wrist"), joint("r_wrist")]) {
    const near = sizes(sub(wrist, joint("head"))), raised = sub(wrist, joint("spine3"));
    up.forEach((axis, t) => { atFace[t] ||= near[t] < 0.45 && axis.reduce((sum, value, k) => sum + value * raised[t][k], 0) > 0; });
  }
  return {
    punches, claps: countPeaks(closed, -0.17, -0.24), slashes: countPeaks(swept, 0.4, 0.2), bows: countPeaks(bent, 35, 18),
    calls: countPeaks(bent.map((value, t) => (atFace[t] ? value : 0)), 40, 18),
  };
}

function feet({ joint, seen }) {
  const lead = sub(joint("l_ankle"), joint("r_ankle")).map((p) => p[1]);
  const kicks = [["l", lead], ["r", lead.map((v) => -v)]].map(([letter, height]) => {
    const ahead = seen(`${letter}_ankle`);
    return countPeaks(height.map((v, t) => (ahead[t][2] > 0.3 ? v : Math.min(v, 0.2))), 0.33, 0.25);
  });
  return { kicks };
}

function heights({ fps, joint, seen, ground }) {
  const pelvis = joint("pelvis").map((p) => p[1]);
  const lower = joint("l_foot").map((p, t) => Math.min(p[1], joint("r_foot")[t][1]));
  const floor = percentile(lower, 10), clear = lower.map((v) => v - floor);
  const ankles = sub(seen("l_ankle"), seen("r_ankle"));
  const flying = clear.map((v, t) =>
    pelvis[t] > REST_PELVIS_HEIGHT + 0.03 && Math.hypot(ankles[t][1], ankles[t][2]) < 0.3 && ground[t] < 2.6 ? v : 0);
  const grounded = clear.map((v, t) => (v < 0.06 ? REST_PELVIS_HEIGHT - pelvis[t] : 0));
  return {
    squats: countPeaks(grounded, 0.27, 0.12),
    jumps: countPeaks(flying, 0.05, 0.02),
    pelvisLow: range(pelvis)[0] / REST_PELVIS_HEIGHT,
    flight: clear.filter((v) => v > 0.03).length / fps,
  };
}

// ---------------------------------------------------------------- which action it is

const MIN_TURN = 0.7, MIN_STRIDE = 0.06;
const credible = (m) => m.upright > 0.9 && m.angularSpeed > 0.02 && m.angularSpeed < 6;
const steps = (m, distance, speed) => distance > 0.3 && speed > 0.17 && m.stride > MIN_STRIDE;
const forward = (m) => steps(m, m.forward, m.forwardSpeed) && Math.abs(m.lateral) < 0.6 * m.forward;
const sideways = (m, sign) =>
  steps(m, sign * m.lateral, (sign * m.lateralSpeed) / 0.7) && sign * m.lateral > 0.25 * Math.abs(m.forward);
const handUp = (m, side) => m.handPeak[side] > -0.2 && m.handTravel[side] > 0.15;
const oneHand = (m, side) => handUp(m, side) && m.handPeak[side] - m.handPeak[1 - side] > 0.35;
const waves = (m) => {
  const highest = m.handPeak[1] > m.handPeak[0] ? 1 : 0;
  return handUp(m, highest) && m.handSwings[highest] >= 4;
};
const runs = (m) => forward(m) && (m.cruise > 2 || (m.flight > 0.05 * m.seconds && m.cruise > 1.3));
const travels = (m, speed) => Math.hypot(m.forwardNet, m.lateralNet) > speed * m.seconds;
const within = (m, metres) => Math.abs(m.forwardNet) < metres && Math.abs(m.lateralNet) < metres;
const walks = (m) =>
  m.cruise < 2 && m.flight < 0.05 * m.seconds && (travels(m, 0.25) || (Math.abs(m.yaw) > MIN_TURN && m.cruise > 0.5)) &&
  m.stride > MIN_STRIDE && m.pelvisLow > 0.82;
const sideSteps = (m) => (sideways(m, 1) || sideways(m, -1)) && Math.abs(m.lateralNet) > Math.abs(m.forwardNet);
const turnsInPlace = (m) => Math.abs(m.yaw) > MIN_TURN && within(m, 0.6) && Math.max(...m.handPeak) < -0.3;
const stands = (m) =>
  Math.abs(m.forward) < 0.4 && Math.abs(m.lateral) < 0.4 && Math.max(...m.handPeak) < -0.3 && Math.abs(m.yaw) < 0.5
  && m.angularSpeed < 1 && m.pelvisLow > 0.9 && m.stride < 0.1 && m.bows === 0;
const anyHand = (m) => handUp(m, 0) || handUp(m, 1);

const ofABody = (checks) => Object.fromEntries(Object.entries(checks).map(([name, check]) => [name, (m) => credible(m) && check(m)]));

export const ACTIONS = ofABody({
  walk: walks, run: runs, wave: waves, "side-step": sideSteps, turn: turnsInPlace, stand: stands,
  "crouch-walk": (m) => m.pelvisLow < 0.85 && travels(m, 0.2),
  spin: (m) => Math.abs(m.yaw) > 4.7 && within(m, 0.8),
  kick: (m) => Math.max(...m.kicks) >= 1,
  punch: (m) => Math.max(...m.punches) >= 1 && !travels(m, 0.25),
  slash: (m) => m.slashes >= 1, call: (m) => m.calls >= 1, raise: anyHand, bye: anyHand,
  squat: (m) => m.squats >= 1, jump: (m) => m.jumps >= 1, clap: (m) => m.claps >= 1, bow: (m) => m.bows >= 1,
});

const SIDES = ofABody({
  "turn-left": (m) => m.yaw > MIN_TURN, "turn-right": (m) => -m.yaw > MIN_TURN,
  "left-hand": (m) => oneHand(m, 0), "right-hand": (m) => oneHand(m, 1),
  "kick-left": (m) => m.kicks[0] > m.kicks[1], "kick-right": (m) => m.kicks[1] > m.kicks[0],
  "punch-left": (m) => m.punches[0] > m.punches[1], "punch-right": (m) => m.punches[1] > m.punches[0],
});

export function sideCheck(action, side, byHand) {
  const name = action === "spin" ? `turn-${side}` : `${action}-${side}`;
  return SIDES[name] ?? (byHand ? (SIDES[`${side}-hand`] ?? null) : null);
}

const ofLimbs = ([left, right], side) => (side === "left" ? left : side === "right" ? right : left + right);

export const REPETITIONS = { // of the actions whose repetitions are seen
  bow: (m) => m.bows, clap: (m) => m.claps, jump: (m) => m.jumps, squat: (m) => m.squats,
  kick: (m, side) => ofLimbs(m.kicks, side), punch: (m, side) => ofLimbs(m.punches, side),
};

export const repetitions = (action, m, side) => REPETITIONS[action]?.(m, side) ?? null;
