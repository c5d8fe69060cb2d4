// From sampled features to a motion, and motions put together: ports of whole.py and
// stitching.py in src/shared/motion/postprocess, which say why.

import {
  add, conjugate, continuous, expOf, logOf, matrixOf, matrixOf6d, multiply, product, quaternionOf,
  norm, scale, slerp, sub, transposed, unit, turnAboutY, write6d, yawMatrix, yawQuaternion,
} from "./rotations.js";
import {
  decodeFeatures, framesOf, headings, joinArrays, LEFT_CONTACT, ORIGIN, placeOf, ROOT, WIDTH,
} from "./features.js";
import { easeFromKept, keptLegs, lockCarriedFeet, lockFeet, twoBones } from "./footskate.js";
import { gaussian, gradient, maximum, round } from "./curves.js";
import { ARMS, FPS, INDEX, JOINTS, pose, SKELETON } from "./skeleton.js";

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
  const level = features.slice(), pelvis = Array.from({ length: framesOf(features) }, (_, t) => matrixOf6d(features, t * WIDTH));
  headings(pelvis).forEach((angle, t) => write6d(multiply(yawMatrix(-angle), pelvis[t]), level, t * WIDTH));
  return level;
}

/** No joint turns faster than `limit` radians a second. */
export function clampVelocity(quaternions, limit, fps) {
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

const REST_FADE = 0.5, HURRY = 5.5, NEAR_END = 0.7, WIDER = 0.2, SLOWED = 0.09;
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
  const rested = { ...motion, quaternions: continuous(quaternions, JOINTS * 4) };
  return cuts ? rested : unhurried(rested, Array.from({ length: motion.frames }, (_, t) => pose(motion, t).positions), held);
}

/** Arms that come up at the begin and down at the end, by these positions, no faster than arms do. */
function unhurried(motion, poses, held) {
  const { frames, fps } = motion, quaternions = motion.quaternions.slice(), width = JOINTS * 4;
  const near = Math.min(round(NEAR_END * fps), Math.floor(frames / 6));
  for (const arm of ARMS) {
    const paths = [0, 1, 2].map((i) => gradient(poses.map((positions) => positions[arm.at(-1)][i] - positions[0][i])));
    const hurries = poses.map((_, t) => Number((t < near || (t >= frames - near && !held)) && norm(paths.map((path) => path[t])) * fps > HURRY));
    const wide = maximum(hurries, 2 * round(WIDER * fps) + 1);
    if (!wide.some(Boolean)) continue;
    const share = gaussian(wide, SLOWED * fps);
    for (const joint of arm) {
      const of = (t) => Array.from(motion.quaternions.subarray(t * width + joint * 4, t * width + joint * 4 + 4)), own = poses.map((_, t) => of(t));
      const rows = [0, 1, 2, 3].map((i) => gaussian(own.map((q) => q[i]), SLOWED * fps));
      for (let t = 0; t < frames; t++) {
        const mean = rows.map((row) => row[t]), size = Math.hypot(...mean);
        quaternions.set(slerp(own[t], mean.map((x) => x / size), share[t]), t * width + joint * 4);
      }
    }
  }
  return { ...motion, quaternions };
}

// ---------------------------------------------------------------- hands that meet

const TOUCH = 0.09, NEAR = 0.35, SWING = 0.15;

/** Hands that touch where they clap in frames [start, stop) and do not quite. */
export function handsMeet(motion, start = 0, stop = motion.frames) {
  const poses = Array.from({ length: stop - start }, (_, t) => pose(motion, start + t));
  const between = poses.map(({ positions }) => sub(positions[ARMS[1].at(-1)], positions[ARMS[0].at(-1)]));
  const closer = lacking(between.map(norm)), quaternions = motion.quaternions.slice();
  if (!closer.some(Boolean)) return motion;
  for (const [t, { positions, world }] of poses.entries()) {
    if (!closer[t]) continue;
    for (const [i, [collar, shoulder, elbow, wrist]] of ARMS.entries()) {
      const target = add(positions[wrist], scale(unit(between[t]), ((i ? -1 : 1) * closer[t]) / 2));
      const [upper, lower] = twoBones(positions[shoulder], world[shoulder], world[elbow], SKELETON.offsets[elbow], SKELETON.offsets[wrist], target, [0, i ? -1 : 1, 0]);
      const chain = [world[collar], upper, lower, world[wrist]];
      for (const [k, joint] of [shoulder, elbow, wrist].entries())
        quaternions.set(quaternionOf(multiply(transposed(chain[k]), chain[k + 1])), ((start + t) * JOINTS + joint) * 4);
    }
  }
  return { ...motion, quaternions: continuous(quaternions, JOINTS * 4) };
}

/** Metres by which the gap of the wrists is to be less in each frame. */
function lacking(gap) {
  const claps = [], closer = gap.map(() => 0);
  let low = 0, high = 0, falls = false;
  for (const [t, value] of gap.entries()) {
    if (value < gap[low]) low = t;
    if (value > gap[high]) high = t;
    if (falls && value - gap[low] >= SWING) {
      if (gap[low] < NEAR) claps.push(low);
      [falls, high] = [false, t];
    } else if (!falls && gap[high] - value >= SWING) [falls, low] = [true, t];
  }
  const ends = [0, ...claps, gap.length - 1];
  const widest = ends.slice(1).map((end, i) => {
    let most = ends[i];
    for (let t = most + 1; t <= end; t++) if (gap[t] > gap[most]) most = t;
    return most;
  });
  for (const [i, least] of claps.entries())
    for (const wide of [widest[i], widest[i + 1]])
      for (let t = Math.min(least, wide); t <= Math.max(least, wide); t++) {
        const share = (gap[wide] - gap[t]) / (gap[wide] - gap[least]);
        closer[t] = Math.min(Math.max(share, 0), 1) * Math.max(gap[least] - TOUCH, 0);
      }
  return closer;
}

// ---------------------------------------------------------------- a bowed head

const BOWED = (45 * Math.PI) / 180, BOW_FADE = 0.5;

/** A head that is lower in frames [start, stop), and goes there and back where others come before and after. */
export function headBowed(motion, start = 0, stop = motion.frames) {
  const quaternions = motion.quaternions.slice(), fade = Math.round(BOW_FADE * motion.fps);
  for (let t = start; t < stop; t++) {
    const share = Math.min(start > 0 ? (t - start + 1) / fade : 1, stop < motion.frames ? (stop - t) / fade : 1, 1);
    const half = (share * share * (3 - 2 * share) * BOWED) / 4, [c, s] = [Math.cos(half), Math.sin(half)];
    for (const joint of ["neck", "head"]) {
      const at = (t * JOINTS + INDEX[joint]) * 4, [w, x, y, z] = quaternions.subarray(at, at + 4);
      quaternions.set([w * c - x * s, w * s + x * c, y * c + z * s, z * c - y * s], at); // about its own x
    }
  }
  return { ...motion, quaternions };
}

// ---------------------------------------------------------------- seams

export const FADE = 10;

/** Motions one after the other, all where they are; quaternion signs go on. */
export function joined(...motions) {
  const [quaternions, root, contacts] = ["quaternions", "root", "contacts"].map((name) => joinArrays(motions.map((motion) => motion[name])));
  return { ...motions[0], frames: root.length / 3, quaternions: continuous(quaternions, JOINTS * 4), root, contacts };
}

/** Features with unknown entries moved to meet the known ones, whole rotations by turning them; contacts stay as they are. */
export function blendBoundaries(features, known, fade = FADE) {
  const frames = framesOf(features), smooth = Float64Array.from(features), columns = ROOT + LEFT_CONTACT;
  for (const back of [false, true]) {
    const row = (t) => (back ? frames - 1 - t : t) * WIDTH;
    const is = (t, column) => known[row(t) + column];
    for (let first = 1; first < frames; first++) {
      const lengths = new Uint32Array(columns), goals = new Float64Array(columns);
      for (let column = 0; column < columns; column++) {
        if (!is(first - 1, column) || is(first, column)) continue;
        const at = (t) => row(t) + column, steps = [];
        let length = 1;
        while (first + length < frames && !is(first + length, column)) length++;
        if (length > 1) steps.push(smooth[at(first + 1)] - smooth[at(first)]);
        if (first > 1) steps.push(is(first - 2, column) ? smooth[at(first - 1)] - smooth[at(first - 2)] : (steps[0] ?? 0));
        goals[column] = smooth[at(first - 1)] + (steps.length ? steps.reduce((a, b) => a + b, 0) / steps.length : 0);
        lengths[column] = length;
      }
      const faded = (length, told) => {
        const reach = first + length === frames ? fade : Math.min(fade, Math.max(1, length >> 1));
        for (let i = 0; i < Math.min(length, reach); i++) told(row(first + i), 1 - (i / reach) ** 3 * ((i / reach) * ((6 * i) / reach - 15) + 10));
      };
      for (let start = 0; start < columns; start += 6) {
        const own = lengths.subarray(start, start + 6);
        if (start < ROOT && own[0] && own.every((length) => length === own[0])) {
          const lack = multiply(matrixOf6d(goals, start), transposed(matrixOf6d(smooth, row(first) + start))), turn = logOf(quaternionOf(lack));
          faded(own[0], (at, weight) => write6d(multiply(matrixOf(expOf(scale(turn, weight))), matrixOf6d(smooth, at + start)), smooth, at + start));
        } else for (const [i, length] of own.entries()) {
          if (!length) continue;
          const miss = goals[start + i] - smooth[row(first) + start + i];
          faded(length, (at, weight) => { smooth[at + start + i] += miss * weight; });
        }
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
