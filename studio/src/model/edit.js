// What of given clips is kept, and the rest made anew (src/shared/pipelines/edit.py).

import { turnAboutY } from "../body/rotations.js";
import { round } from "../body/curves.js";
import { blendBoundaries } from "../body/whole.js";
import {
  cut, decodeFeatures, encodeFeatures, FORWARD, framesOf, headingsOf, integrateRoot, joinArrays, LATERAL, LEFT_CONTACT, mirrored, ORIGIN,
  placeOf, ROOT, WIDTH, YAW_RATE,
} from "../body/features.js";
import { FPS, GROUPS, INDEX, JOINTS, pose } from "../body/skeleton.js";
import { freeConstraint, OVERLAP, streamFeatures, windowOf } from "./stream.js";

export const NO_TEXT = "a person moves";
const EASE = 20; // frames, in which joints leave what they did and come back to it

export const chosenJoints = (names) => new Set(names.flatMap((name) => GROUPS[name] ?? (name in INDEX ? [name] : [])));

/** Features are known but for some joints (null: everything) in frames [start, stop). */
export function allBut(features, start, stop, joints) {
  const known = new Uint8Array(features.length).fill(1);
  const shown = new Uint8Array(features.length).fill(joints === null ? 1 : 0);
  const legs = new Set([...GROUPS["left-leg"], ...GROUPS["right-leg"]]);
  for (let t = start; t < stop; t++) {
    const at = t * WIDTH;
    if (joints === null) { known.fill(0, at, at + WIDTH); continue; }
    for (const name of joints) known.fill(0, at + INDEX[name] * 6, at + INDEX[name] * 6 + 6);
    if ([...joints].some((name) => legs.has(name))) known.fill(0, at + ROOT + LEFT_CONTACT, at + WIDTH);
  }
  return { values: features, known, shown };
}

/** A clip of which frames [start, stop) are made anew: { constraint, place, rejoin }. */
export function redo(clip, start, stop, joints) {
  const open = joints !== null || stop >= clip.frames;
  return {
    constraint: allBut(encodeFeatures(clip), start, stop, joints),
    place: placeOf(clip, 0),
    rejoin: open ? null : { stop, place: placeOf(clip, stop) },
  };
}

/** A motion that begins as one clip begins, or ends as one ends. */
export function keepEnds(start, end, kept, frames, rejoin = false) {
  const constraint = freeConstraint(frames);
  const keep = (clip, from, to) => {
    constraint.values.set(cut(encodeFeatures(clip), from, from + kept), to * WIDTH);
    constraint.known.fill(1, to * WIDTH, (to + kept) * WIDTH);
  };
  if (start) keep(start, 0, 0);
  if (end) keep(end, end.frames - kept, frames - kept);
  return {
    constraint,
    place: start ? placeOf(start, 0) : ORIGIN,
    rejoin: end && rejoin ? { stop: frames - kept, place: placeOf(end, end.frames - kept) } : null,
  };
}

const FULLEST = 0.95, HARDLY = 0.08, SWAY_SECONDS = 4;

/** A motion that goes as far from its first pose as it goes, and no way back: from there on all is known. */
export function held(features, frames) {
  const motion = decodeFeatures(features), heading = headingsOf(motion);
  const bodies = Array.from({ length: motion.frames }, (_, t) => {
    const { positions } = pose(motion, t), [s, c] = [Math.sin(heading[t]), Math.cos(heading[t])];
    const [px, , pz] = positions[0];
    return positions.map(([x, y, z]) => [(x - px) * c - (z - pz) * s, y, (x - px) * s + (z - pz) * c]);
  });
  const apart = (one, other) => one.map((point, j) => Math.hypot(...point.map((value, i) => value - other[j][i])));
  const away = bodies.map((body) => apart(body, bodies[0]).reduce((sum, each) => sum + each, 0) / JOINTS);
  const there = away.findIndex((far) => far >= FULLEST * Math.max(...away));
  const moved = bodies.slice(there).findIndex((body) => Math.max(...apart(body, bodies[there])) > HARDLY);
  const stays = (moved < 0 ? bodies.length - there : moved) - 1;
  const turning = Math.PI / Math.max(stays, round((SWAY_SECONDS / 2) * FPS));
  const given = freeConstraint(frames);
  for (let t = 0; t < frames; t++) {
    const from = t < there ? t : round(there + (stays * (1 - Math.cos(turning * (t - there)))) / 2);
    given.values.set(cut(features, Math.min(from, bodies.length - 1), Math.min(from, bodies.length - 1) + 1), t * WIDTH);
    for (const column of [FORWARD, LATERAL, YAW_RATE]) given.values[t * WIDTH + ROOT + column] = 0;
  }
  given.known.fill(1, there * WIDTH);
  return given;
}

/** Raw features with everything that is not known made anew, and what was known in the end. */
export async function fill(sampler, text, given, seed, options) {
  const features = await fillFree(sampler, text, given.constraint, seed, options);
  if (!given.rejoin) return { features, known: given.constraint.known };
  const bent = bendBack(features, given);
  return { features: await fillFree(sampler, text, bent, seed, options), known: bent.known };
}

/** Features in which, from `start` on, some joints do what a passage says: filled in, or where the body sits (`seat`) as it does alone, for there they would hardly move. */
export async function beside(sampler, passage, features, start, joints, seed, seat) {
  const stop = start + passage.frames;
  if (passage.mirrored && !seat) {
    const other = [...joints].map((name) => name.replace(/^[lr]_/u, (side) => (side === "l_" ? "r_" : "l_")));
    return mirrored(await beside(sampler, { ...passage, mirrored: false }, mirrored(features), start, other, seed, seat));
  }
  if (!seat) return fillFree(sampler, passage.text, allBut(features, start, stop, joints), seed);
  const alone = await streamFeatures(sampler, [passage], seed), copied = features.slice(), kept = new Uint8Array(features.length).fill(1);
  for (let t = start; t < stop; t++)
    for (const name of joints) {
      const row = INDEX[name] * 6, from = (t - start) * WIDTH + row, to = t * WIDTH + row;
      copied.set(alone.subarray(from, from + 6), to);
      kept.fill(0, to, to + 6);
    }
  return blendBoundaries(copied, kept);
}

/** Only the frames around what is not known go through the network. */
export async function fillFree(sampler, text, constraint, seed, options = {}) {
  const frames = framesOf(constraint.values), free = [];
  for (let t = 0; t < frames; t++) if (cut(constraint.known, t, t + 1).includes(0)) free.push(t);
  if (!free.length) return constraint.values;
  const start = Math.max(0, free[0] - OVERLAP), stop = Math.min(frames, free[free.length - 1] + 1 + OVERLAP);
  const { miss, ...rest } = options;
  const made = await streamFeatures(sampler, [{ text, frames: stop - start, miss }], seed, {
    ...rest,
    constraint: windowOf(constraint, start, stop),
  });
  const features = joinArrays([cut(constraint.values, 0, start), made, cut(constraint.values, stop, frames)]);
  if (constraint.shown && !constraint.shown.includes(1)) ease(features, constraint, free[0], free.at(-1) + 1);
  return features;
}

/** Joints that were made anew leave the pose that they had, and come back to it, within EASE frames. */
function ease(features, { values, known }, start, stop) {
  const frames = Math.min(EASE, Math.floor((stop - start) / 3)), way = (k) => (k / (frames + 1)) ** 2 * (3 - (2 * k) / (frames + 1));
  for (let t = start; t < stop; t++) {
    let share = 1;
    if (start > 0 && t - start < frames) share = way(t - start + 1);
    if (stop < framesOf(features) && stop - t <= frames) share = way(stop - t);
    for (let at = t * WIDTH; share < 1 && at < t * WIDTH + ROOT; at++) if (!known[at]) features[at] = features[at] * share + values[at] * (1 - share);
  }
}

/** A path through the free frames that leads to the place at their end. */
function bendBack(features, { constraint, place, rejoin: { stop, place: target } }) {
  let start = 0;
  while (constraint.known[start * WIDTH + ROOT + FORWARD]) start++;
  const rates = Float64Array.from(cut(features, 0, stop + 1));
  const ease = Array.from({ length: stop + 1 }, (_, t) => {
    const x = t < start ? 0 : (t - start) / (stop - start);
    return x ** 3 * (x * (6 * x - 15) + 10);
  });
  const heading = integrateRoot(rates, place).heading;
  const away = target.heading - heading[stop] + Math.PI, whole = 2 * Math.PI;
  const turn = ((away % whole) + whole) % whole - Math.PI;
  for (let t = 0; t < stop; t++) rates[t * WIDTH + ROOT + YAW_RATE] += turn * (ease[t + 1] - ease[t]) * FPS;
  const bent = integrateRoot(rates, place);
  const miss = [target.x - bent.path[stop * 3], target.z - bent.path[stop * 3 + 2]];
  const values = constraint.values.slice(), known = constraint.known.slice();
  for (let t = start; t < stop; t++) {
    const step = [0, 2].map((axis, i) =>
      (bent.path[(t + 1) * 3 + axis] - bent.path[t * 3 + axis] + (ease[t + 1] - ease[t]) * miss[i]) * FPS);
    const [lateral, , forward] = turnAboutY([step[0], 0, step[1]], -bent.heading[t]);
    const at = t * WIDTH + ROOT;
    values[at + FORWARD] = forward;
    values[at + LATERAL] = lateral;
    values[at + YAW_RATE] = rates[at + YAW_RATE];
    known[at + FORWARD] = known[at + LATERAL] = known[at + YAW_RATE] = 1;
  }
  return { ...constraint, values, known };
}
