// Motion of any length: windows that begin with the last frames before them
// (src/shared/pipelines/stream.py).

import { cut, decodeFeatures, framesOf, joinArrays, WIDTH } from "../body/features.js";
import { endsAtRest } from "../body/measurements.js";
import { INDEX, pose } from "../body/skeleton.js";
import { blendBoundaries } from "../body/whole.js";
import { derivedSeed } from "./noise.js";

export const WINDOW = 150, OVERLAP = 30, SHORTEST = 48, TRIES = 8;
const STILL = 10, MOVED = 0.05, MEETING = 30;

export const freeConstraint = (frames) => ({
  values: new Float32Array(frames * WIDTH),
  known: new Uint8Array(frames * WIDTH),
  shown: new Uint8Array(frames * WIDTH).fill(1),
});

export const windowOf = (given, start, stop) => ({
  values: cut(given.values, start, stop),
  known: cut(given.known, start, stop),
  shown: cut(given.shown, start, stop),
});

function lengthened(given, frames) {
  const spare = frames - framesOf(given.values);
  if (spare <= 0) return given;
  const free = freeConstraint(spare);
  return {
    values: joinArrays([given.values, free.values]),
    known: joinArrays([given.known, free.known], Uint8Array),
    shown: joinArrays([given.shown, free.shown], Uint8Array),
  };
}

/** New frames of each window of a passage: as few as do, nearly alike in length. */
export function windowLengths(frames, known, window, overlap) {
  const number = 1 + Math.max(0, Math.ceil((frames + known - window) / (window - overlap)));
  const total = frames + known + (number - 1) * overlap;
  const at = (index) => Math.floor((total * index) / number);
  return Array.from({ length: number }, (_, i) => at(i + 1) - at(i) - (i ? overlap : known));
}

/** Whether these frames end with a body that stands still, hands hanging. */
function stands(before) {
  const frames = framesOf(before);
  if (frames < STILL) return false;
  const motion = decodeFeatures(cut(before, frames - STILL, frames));
  if (!endsAtRest(motion)) return false;
  const places = Array.from({ length: STILL }, (_, t) => pose(motion, t).positions);
  return ["pelvis", "l_ankle", "r_ankle"].every((name) => [0, 1, 2].every((axis) => {
    const values = places.map((positions) => positions[INDEX[name]][axis]);
    return Math.max(...values) - Math.min(...values) < MOVED;
  }));
}

/** A piece that begins as the frames before it end; what is known of it stays. */
function met(before, piece, known) {
  const kept = joinArrays([new Uint8Array(before.length).fill(1), known.slice(0, piece.length)], Uint8Array);
  const frames = framesOf(before);
  return cut(blendBoundaries(joinArrays([before, piece]), kept, MEETING), frames, frames + framesOf(piece));
}

export const retrySeeds = (seed) => Array.from({ length: TRIES }, (_, number) => derivedSeed(seed, number));

/**
 * Raw features of passages { text, frames, window?, miss?, afresh? } one after another.
 * @param {Sampler} sampler
 * @param {object[]} passages
 * @param {bigint|number} seed
 * @param {{constraint?: object, window?: number, overlap?: number, guidance?: number, told?: function}} options
 *     constraint: of all frames; told: called with the frames that are done
 */
export async function streamFeatures(sampler, passages, seed, options = {}) {
  const { constraint = null, window = WINDOW, overlap = OVERLAP, guidance, told } = options;
  let before = new Float32Array(), made = 0, number = 0, said = null;
  const pieces = [];
  for (const passage of passages) {
    let own = new Float32Array(), lucky = []; // the seed of the repetition before
    let shared = passage.afresh && passage.text !== said && stands(before) ? new Float32Array() : before;
    said = passage.text;
    for (const length of windowLengths(passage.frames, framesOf(shared), Math.min(window, passage.window ?? window), overlap)) {
      const kept = framesOf(shared), start = made - kept;
      const known = constraint ? windowOf(constraint, start, made + length) : freeConstraint(kept + length);
      known.values.set(shared);
      known.known.fill(1, 0, shared.length);
      known.shown.fill(1, 0, shared.length);
      const longer = lengthened(known, SHORTEST);
      const somethingKnown = kept > 0 || constraint;
      let best = null, least = Infinity, chosen = null;
      for (const trial of [...lucky, ...retrySeeds(derivedSeed(seed, number))]) {
        const features = await sampler.sample(passage.text, framesOf(longer.values), trial, somethingKnown ? longer : null, guidance);
        let piece = cut(blendBoundaries(cut(features, 0, kept + length), known.known), kept, kept + length);
        if (!kept && before.length) piece = met(before, piece, known.known);
        const found = passage.miss ? passage.miss(joinArrays([own, piece])) : 0;
        if (found < least) { least = found; best = piece; chosen = trial; }
        if (least <= 0) break;
      }
      const whole = joinArrays([before, best]);
      shared = before = cut(whole, Math.max(0, framesOf(whole) - overlap), framesOf(whole));
      own = joinArrays([own, best]);
      lucky = passage.window ? [chosen] : [];
      made += length;
      number++;
      pieces.push(best);
      told?.(made);
    }
  }
  return joinArrays(pieces);
}
