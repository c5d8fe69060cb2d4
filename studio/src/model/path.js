// A drawn path, when a pelvis is to be where on it, and a motion along it
// (src/shared/pipelines/path.py).

import { gaussian, gradient, interpolate, linspace, percentile, round } from "../body/curves.js";
import { unwrap } from "../body/rotations.js";
import { FORWARD, framesOf, HEIGHT, LATERAL, ROOT, WIDTH, YAW_RATE } from "../body/features.js";
import { FPS } from "../body/skeleton.js";
import { freeConstraint, streamFeatures } from "./stream.js";

const SPACING = 0.01, ROUNDING = 0.12, NATURAL = 1.2, SLOWEST = 0.25, FASTEST = 4, MAX_SIDEWAYS = 2;
const MAX_ALONG = 1.5, MAX_TURN = 2.5, FASTEST_TURN = 4, START_SPEED = 0.1, REST = 0.4, RUNNING = 2, LONGEST = 3000; // m, which no seconds of a scene reach
const TURN_SMOOTHING = 0.12, STANDING = 0.25, SWAY_SMOOTHING = 0.4;

const steps = (points) => points.slice(1).map((point, i) => [point[0] - points[i][0], point[1] - points[i][1]]);
export const lengthOf = (points) => steps(points).reduce((sum, step) => sum + Math.hypot(...step), 0);

/** Points [T] and headings [T] of a path of [x, z] points. Throws where the seconds are too few. */
export function timePath(drawn, { speed = NATURAL, seconds = null, facing = 0 }) {
  if (lengthOf(drawn) > LONGEST) throw tooLong(lengthOf(drawn) / FASTEST);
  const line = rounded(drawn);
  let moments = momentsOf(line, Math.min(Math.max(speed, SLOWEST), FASTEST));
  const rest = speed > RUNNING ? 0 : seconds === null ? REST : Math.min(REST, seconds / 8);
  const still = Math.trunc(rest * FPS);
  if (seconds !== null) moments = inSeconds(line, moments, seconds - (2 * still) / FPS);
  const last = moments[moments.length - 1];
  const count = last * FPS; // of a short way none is lost: it would be faster than asked
  let frames = linspace(0, last, Math.max(2, (seconds === null && count < FPS ? Math.ceil(count) : round(count)) + 1));
  frames = [...new Array(still).fill(frames[0]), ...frames, ...new Array(still).fill(last)];
  const [xs, zs] = [line.map((p) => p[0]), line.map((p) => p[1])];
  const points = frames.map((at) => [interpolate(at, moments, xs), interpolate(at, moments, zs)]);
  return { points, headings: slowTurns(tangents(points).map((angle) => angle + facing)) };
}

function rounded(drawn) {
  const length = lengthOf(drawn), way = [0];
  for (const step of steps(drawn)) way.push(way[way.length - 1] + Math.hypot(...step));
  const share = way.map((value) => value / length);
  const keep = share.map((value, i) => i === 0 || value > share[i - 1]);
  const known = share.filter((_, i) => keep[i]), points = drawn.filter((_, i) => keep[i]);
  const at = linspace(0, 1, Math.max(3, Math.ceil(length / SPACING) + 1));
  const width = Math.min(Math.ceil((4 * ROUNDING) / SPACING), at.length - 1);
  const axes = [0, 1].map((axis) => {
    const dense = at.map((share) => interpolate(share, known, points.map((p) => p[axis]))), end = dense.length - 1;
    const longer = [];
    for (let i = width; i > 0; i--) longer.push(2 * dense[0] - dense[i]);
    for (const value of dense) longer.push(value);
    for (let i = 1; i <= width; i++) longer.push(2 * dense[end] - dense[end - i]);
    return gaussian(longer, (ROUNDING * end) / length, "reflect").slice(width, width + dense.length);
  });
  return at.map((_, i) => [axes[0][i], axes[1][i]]);
}

function momentsOf(line, speed) {
  const moves = steps(line), sizes = moves.map((step) => Math.max(Math.hypot(...step), 1e-9));
  const angles = unwrap(moves.map(([x, z]) => Math.atan2(x, z)));
  let bend = sizes.length > 1 ? gradient(angles).map((v, i) => Math.abs(v) / sizes[i]) : [0];
  bend = gaussian(bend, 5);
  const limits = bend.map((v) => Math.min(Math.max(Math.min(Math.sqrt(MAX_SIDEWAYS / Math.max(v, 1e-6)), MAX_TURN / Math.max(v, 1e-6)), Math.min(SLOWEST, speed)), speed));
  const end = limits.length - 1;
  if (speed <= RUNNING) for (const i of [0, end]) limits[i] = Math.min(limits[i], START_SPEED);
  const relax = (at, near) => { limits[at] = Math.min(limits[at], Math.sqrt(limits[near] ** 2 + 2 * MAX_ALONG * sizes[at])); };
  for (let at = 1; at <= end; at++) relax(at, at - 1);
  for (let at = end - 1; at >= 0; at--) relax(at, at + 1);
  const moments = [0];
  sizes.forEach((size, i) => moments.push(moments[i] + size / limits[i]));
  return moments;
}

function inSeconds(line, moments, seconds) {
  const stretched = moments.map((at) => (at * seconds) / moments[moments.length - 1]);
  const fastest = steps(line).reduce((most, step, i) => Math.max(most, Math.hypot(...step) / (stretched[i + 1] - stretched[i])), 0);
  if (!(seconds > 0) || fastest > FASTEST) throw tooLong((Math.max(seconds, 0) * fastest) / FASTEST || lengthOf(line) / FASTEST);
  return stretched;
}

const tooLong = (seconds) => new Error(`The path is too long for its time: give it ${seconds.toFixed(1)} seconds or more, or draw a shorter one.`);

function tangents(points) {
  const moves = steps(points);
  const moving = moves.map((step) => Math.hypot(...step) * FPS > 0.05);
  if (!moving.some(Boolean)) moving.fill(true);
  let last = moving.indexOf(true);
  const angles = moves.map((_, i) => {
    if (moving[i]) last = Math.max(last, i);
    return Math.atan2(...moves[last]);
  });
  unwrap(angles);
  return [...angles, angles[angles.length - 1]];
}

function slowTurns(headings) {
  let width = TURN_SMOOTHING * FPS, smooth = gaussian(headings, width);
  const fastest = () => Math.max(...smooth.slice(1).map((v, i) => Math.abs(v - smooth[i]))) * FPS;
  while (fastest() > FASTEST_TURN && width < headings.length) {
    width *= 1.25;
    smooth = gaussian(headings, width);
  }
  return smooth;
}

/** Radians a second, 0 in the mean, by which a heading that nobody directs sways about its way with each step. */
export function naturalSway(features) {
  const rate = Array.from({ length: framesOf(features) }, (_, t) => features[t * WIDTH + ROOT + YAW_RATE]);
  const smooth = gaussian(rate, SWAY_SMOOTHING * FPS), sway = rate.map((v, t) => v - smooth[t]);
  const mean = sway.reduce((sum, v) => sum + v, 0) / sway.length;
  return sway.map((v) => v - mean);
}

/** The same path, its headings swaying: less where it is slow, not at its ends. */
export function swaying({ points, headings }, sway) {
  const [dx, dz] = [gradient(points.map((p) => p[0])), gradient(points.map((p) => p[1]))];
  const pace = dx.map((v, t) => Math.hypot(v, dz[t])), fastest = Math.max(...pace, 1e-9), last = points.length - 1;
  let sum = 0;
  const swayed = sway.map((v, t) => (sum += (v * pace[t]) / fastest) / FPS);
  const drift = (t) => swayed[0] + ((swayed[last] - swayed[0]) * t) / last;
  return { points, headings: headings.map((v, t) => v + swayed[t] - drift(t)) };
}

/** Forward, lateral and turning velocity are known; all else is free. */
export function pathConstraint({ points, headings }) {
  const given = freeConstraint(points.length);
  points.forEach((_, t) => {
    const u = Math.min(t, points.length - 2);
    const [dx, dz] = [(points[u + 1][0] - points[u][0]) * FPS, (points[u + 1][1] - points[u][1]) * FPS];
    const [s, c] = [Math.sin(headings[t]), Math.cos(headings[t])], at = t * WIDTH + ROOT;
    given.values[at + FORWARD] = dx * s + dz * c;
    given.values[at + LATERAL] = dx * c - dz * s;
    given.values[at + YAW_RATE] = (headings[u + 1] - headings[u]) * FPS;
    given.known[at + FORWARD] = given.known[at + LATERAL] = given.known[at + YAW_RATE] = 1;
  });
  return given;
}

/** How fast a body goes that nobody directs, radians from its way to its heading, radians a second. */
export async function naturalGait(sampler, text, seed, options = {}) {
  const features = await streamFeatures(sampler, [{ text, frames: 90 }], seed, options);
  const speeds = [], mean = [0, 0], frames = framesOf(features);
  const heights = Array.from({ length: frames - 30 }, (_, t) => features[(t + 30) * WIDTH + ROOT + HEIGHT]);
  const height = percentile(heights, 50);
  let turning = 0;
  for (let t = 0; t < frames; t++) {
    const way = [features[t * WIDTH + ROOT + FORWARD], features[t * WIDTH + ROOT + LATERAL]];
    speeds.push(Math.hypot(...way));
    way.forEach((v, i) => { mean[i] += v / frames; });
    turning += features[t * WIDTH + ROOT + YAW_RATE] / frames;
  }
  if (Math.hypot(...mean) < STANDING) return { speed: NATURAL, facing: 0, turning, height, stands: true };
  const facing = -round(Math.atan2(mean[1], mean[0]) / (Math.PI / 2)) * (Math.PI / 2);
  return { speed: percentile(speeds, 75), facing, turning, height };
}
