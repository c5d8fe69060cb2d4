// From sampled features to a motion, and motions put together: ports of whole.py and
// stitching.py in src/shared/motion/postprocess, which say why.

import {
  conjugate, continuous, expOf, logOf, matrixOf6d, multiply, product, headingAngle,
  slerp, turnAboutY, unwrap, write6d, yawMatrix, yawQuaternion,
} from "./rotations.js";
import {
  decodeFeatures, framesOf, LEFT_CONTACT, ORIGIN, placeOf, ROOT, WIDTH,
} from "./features.js";
import { easeFromKept, keptLegs, lockCarriedFeet, lockFeet } from "./footskate.js";
import { FPS, INDEX, JOINTS, pose } from "./skeleton.js";

/** Average over time of [T,R,C]; the ends repeat, contacts stay. */
export function smoothFeatures(features, weights) {
  if (weights.length === 1) return features;
  const frames = framesOf(features), half = weights.length >> 1;
  const smooth = features.slice();
  for (let t = 0; t < frames; t++)
    for (let c = 0; c < ROOT + LEFT_CONTACT; c++) {
      let sum = 0;
      for (let i = -half; i <= half; i++) sum += weights[i + half] * features[Math.min(Math.max(t + i, 0), frames - 1) * WIDTH + c];
      smooth[t * WIDTH + c] = sum;
    }
  return smooth;
}

const where = (known, yes, no) => no.map((value, i) => (known[i] ? yes[i] : value));

/** Features whose pelvis row has no heading left. */
function withoutHeading(features) {
  const frames = framesOf(features), level = features.slice(), angles = new Float64Array(frames), pelvis = [];
  for (let t = 0; t < frames; t++) { pelvis.push(matrixOf6d(features, t * WIDTH)); angles[t] = headingAngle(pelvis[t]); }
  unwrap(angles);
  for (let t = 0; t < frames; t++) write6d(multiply(yawMatrix(-angles[t]), pelvis[t]), level, t * WIDTH);
  return level;
}

/** No joint turns faster than `limit` radians a second. */
function clampVelocity(quaternions, limit, fps) {
  if (limit === null) return quaternions;
  const width = JOINTS * 4, step = limit / fps, path = quaternions.slice();
  for (let at = width; at < path.length; at += 4) {
    const before = Array.from(path.subarray(at - width, at - width + 4));
    const turn = logOf(product(conjugate(before), Array.from(quaternions.subarray(at, at + 4))));
    const angle = Math.hypot(...turn);
    if (angle > step) path.set(product(before, expOf(turn.map((x) => (x * step) / angle))), at);
  }
  return continuous(path, width);
}

/** All of it for a whole motion; `settings` are those of the model's post-processing. */
export function postProcess(features, settings, { known = null, text = "", place = ORIGIN, carried = false } = {}) {
  let smooth = smoothFeatures(features, settings.smoothing);
  if (known) smooth = where(known, features, withoutHeading(where(known, features, smooth)));
  let motion = decodeFeatures(smooth, place, text);
  motion = { ...motion, quaternions: clampVelocity(motion.quaternions, settings.maxVelocity, FPS) };
  if (!settings.footLock) return motion;
  const lock = carried ? lockCarriedFeet : lockFeet;
  const kept = known && keptLegs(known);
  if (!kept || !kept.some((leg) => leg.some(Boolean))) return lock(motion);
  return easeFromKept(motion, lock(motion, kept), kept);
}

// ---------------------------------------------------------------- arms at rest

const REST_FADE = 0.5;
const HANGING = { collar: [0, 0, 0], shoulder: [0, 0, -1.37], elbow: [0, -0.38, 0], wrist: [0, 0, 0] };

/** Arms that hang in the first and last frame, where they did not. */
export function restToRest(motion, cuts = null, held = false) {
  const last = motion.frames - 1, whole = [[[0, 1]], [[last, -1]]].slice(0, held ? 1 : 2);
  const ends = cuts?.map((c) => [[c - 1, -1], [c, 1]]) ?? whole;
  const frames = Math.round(REST_FADE * motion.fps);
  if (motion.frames < 4 * frames) return motion;
  const quaternions = motion.quaternions.slice();
  for (const end of ends) {
    const seen = end.map(([row]) => pose(motion, row).positions);
    for (const [letter, side] of [["l", 1], ["r", -1]]) {
      if (seen.every((positions) => positions[INDEX[`${letter}_wrist`]][1] < positions[0][1])) continue;
      for (const [row, way] of end)
        for (const [joint, turn] of Object.entries(HANGING)) {
          const hung = expOf([turn[0], turn[1] * side, turn[2] * side]);
          for (let i = 0; i < frames; i++) {
            const left = 1 - i / frames, weight = left ** 3 * (10 - 15 * left + 6 * left * left);
            const at = ((row + way * i) * JOINTS + INDEX[`${letter}_${joint}`]) * 4;
            quaternions.set(slerp(Array.from(quaternions.subarray(at, at + 4)), hung, weight), at);
          }
        }
    }
  }
  return { ...motion, quaternions: continuous(quaternions, JOINTS * 4) };
}

// ---------------------------------------------------------------- seams

const FADE = 10;

/** Features with unknown entries moved to meet the known ones; contacts stay as they are. */
export function blendBoundaries(features, known, fade = FADE) {
  const frames = framesOf(features), smooth = Float64Array.from(features);
  const fixed = (t, c) => c >= ROOT + LEFT_CONTACT || known[t * WIDTH + c];
  for (let column = 0; column < ROOT + LEFT_CONTACT; column++)
    for (const back of [false, true]) {
      const at = (t) => (back ? frames - 1 - t : t) * WIDTH + column;
      const is = (t) => fixed(back ? frames - 1 - t : t, column);
      for (let last = 0; last + 1 < frames; last++) {
        if (!is(last) || is(last + 1)) continue;
        let length = 1;
        while (last + 1 + length < frames && !is(last + 1 + length)) length++;
        const first = last + 1, steps = [];
        if (length > 1) steps.push(smooth[at(first + 1)] - smooth[at(first)]);
        if (last > 0) steps.push(is(last - 1) ? smooth[at(last)] - smooth[at(last - 1)] : (steps[0] ?? 0));
        const mean = steps.length ? steps.reduce((a, b) => a + b, 0) / steps.length : 0;
        const miss = smooth[at(last)] + mean - smooth[at(first)];
        const reach = first + length === frames ? fade : Math.min(fade, Math.max(1, length >> 1));
        for (let i = 0; i < length; i++) {
          const x = Math.min(i / reach, 1);
          smooth[at(first + i)] += miss * (1 - x ** 3 * (x * (6 * x - 15) + 10));
        }
      }
    }
  return Float32Array.from(smooth);
}

/** The same motion with its first frame somewhere else on the ground. */
export function movedTo(motion, place) {
  const here = placeOf(motion, 0), turn = place.heading - here.heading;
  const root = motion.root.slice(), quaternions = motion.quaternions.slice();
  for (let t = 0; t < motion.frames; t++) {
    const [x, y, z] = turnAboutY([root[t * 3] - here.x, root[t * 3 + 1], root[t * 3 + 2] - here.z], turn);
    root.set([x + place.x, y, z + place.z], t * 3);
    const at = t * JOINTS * 4;
    quaternions.set(product(yawQuaternion(turn), Array.from(quaternions.subarray(at, at + 4))), at);
  }
  return { ...motion, root, quaternions };
}
