// From features to a motion while it is still being made: a port of
// src/shared/motion/postprocess/streaming.py, which says why. Nothing is known of what streams here,
// and the signs of quaternions go on where pieces are joined.

import { cut, decodeFeatures, framesOf, framesOfMotion, integrateRoot, joinArrays, ORIGIN, ROOT, WIDTH as FRAME, YAW_RATE } from "./features.js";
import { easeFromKept, lockFeet, nothingKept } from "./footskate.js";
import { conjugate, continuous, norm, product, slerp, sub } from "./rotations.js";
import { FEET, FPS, JOINTS, pose } from "./skeleton.js";
import { clampVelocity, FADE, joined, smoothFeatures } from "./whole.js";

const BLOCK = 15, AHEAD = 12, BEHIND = 24, JUMP = 0.04, WIDTH = JOINTS * 4;
const LEADING = 0.5, LED = (8 * Math.PI) / 180; // 1/s, and radians a second at most, back onto a course
const TURNS = (20 * Math.PI) / 180, SEEN = 2; // radians a second that are a turn, over so many seconds

/** Leads a heading back that strays from its course, slower than a body sways with its steps; who turns takes a course anew. */
export class Course {
  turning = 0; // radians a second
  strayed = 0; // radians

  add(features, kept) {
    const led = features.slice();
    for (let at = ROOT + YAW_RATE; at < led.length; at += FRAME) {
      this.turning += (led[at] - this.turning) / (SEEN * FPS);
      if (!kept || Math.abs(this.turning) >= TURNS) { this.strayed = 0; continue; }
      const rate = led[at] - Math.min(Math.max(LEADING * this.strayed, -LED), LED);
      led[at] = rate;
      this.strayed += rate / FPS;
    }
    return led;
  }
}

/** Smooths; the last frames wait for their neighbours. */
class Smoother {
  raw = new Float32Array(); // what waits, and `reach` frames before it
  behind = 0; // of them, frames that were given back

  constructor(weights) {
    Object.assign(this, { weights, reach: weights.length >> 1 });
  }

  add(features) {
    this.raw = joinArrays([this.raw, features]);
    const start = this.behind, stop = Math.max(start, framesOf(this.raw) - this.reach), keep = Math.max(0, stop - this.reach);
    const smooth = cut(smoothFeatures(this.raw, this.weights), start, stop);
    this.raw = cut(this.raw, keep);
    this.behind = stop - keep;
    return smooth;
  }
}

/** Features to motion, each piece placed where the one before led to. */
class Decoder {
  place = ORIGIN;
  before = new Float32Array(); // quaternions of the last frame

  constructor(maxVelocity) {
    this.maxVelocity = maxVelocity;
  }

  add(features) {
    const motion = decodeFeatures(features, this.place);
    this.place = integrateRoot(features, this.place).end;
    const quaternions = clampVelocity(joinArrays([this.before, motion.quaternions]), this.maxVelocity, FPS).slice(this.before.length);
    this.before = quaternions.slice(-WIDTH);
    return { ...motion, quaternions };
  }
}

/** Holds standing feet, block by block. */
class FootLock {
  waiting = null;
  settled = null; // the last `BEHIND` frames
  unlocked = null; // quaternions of the last one, as they came

  /** The blocks that settle with these next frames; null where none does. */
  add(motion) {
    const settled = [];
    this.waiting = this.waiting ? joined(this.waiting, motion) : motion;
    for (; this.waiting.frames >= BLOCK + AHEAD; this.waiting = framesOfMotion(this.waiting, BLOCK)) settled.push(this.block());
    return settled.length ? joined(...settled) : null;
  }

  block() {
    const raw = framesOfMotion(this.waiting, 0, BLOCK + AHEAD), behind = this.settled?.frames ?? 0;
    const wanted = behind ? joined(this.settled, { ...raw, quaternions: faded(raw.quaternions, this.settled.quaternions.slice(-WIDTH), this.unlocked) }) : raw;
    const kept = nothingKept(wanted.frames).map((leg) => leg.fill(true, 0, behind));
    let locked = lockFeet(wanted, kept);
    if (behind) {
      const jumps = jumped(wanted, locked, behind);
      locked = easeFromKept(wanted, locked, kept.map((leg, side) => leg.map((is) => is && jumps[side])));
    }
    this.unlocked = raw.quaternions.slice((BLOCK - 1) * WIDTH, BLOCK * WIDTH);
    this.settled = framesOfMotion(locked, Math.max(0, behind + BLOCK - BEHIND), behind + BLOCK);
    return framesOfMotion(locked, behind, behind + BLOCK);
  }
}

/** Which leg the lock has carried away at once in this frame, the first that it may. */
function jumped(loose, locked, frame) {
  const [here, there] = [loose, locked].map((motion) => pose(motion, frame).positions);
  return FEET.map(({ ball }) => norm(sub(here[ball], there[ball])) > JUMP);
}

/** Quaternions that first differ from `raw` as `corrected` does from `before`. */
function faded(raw, corrected, before) {
  const turned = raw.slice(), of = (all, at) => Array.from(all.subarray(at, at + 4));
  for (let joint = 0; joint < WIDTH; joint += 4) {
    const miss = product(conjugate(of(before, joint)), of(corrected, joint));
    for (let t = 0; t < FADE; t++) {
      const x = (t + 1) / (FADE + 1), at = t * WIDTH + joint;
      turned.set(product(of(raw, at), slerp([1, 0, 0, 0], miss, 1 - x * x * (3 - 2 * x))), at);
    }
  }
  return continuous(turned, WIDTH);
}

/** What `postProcess` does, for features that come piece by piece and without an end. */
export class StreamingPostProcessor {
  /** @param {object} settings of the model's post-processing */
  constructor(settings) {
    this.smoother = new Smoother(settings.smoothing);
    this.decoder = new Decoder(settings.maxVelocity);
    this.lock = settings.footLock ? new FootLock() : null;
  }

  /** The frames that settle with these next ones, one or more; null where none does. */
  add(features) {
    const smooth = this.smoother.add(features);
    if (!smooth.length) return null;
    const motion = this.decoder.add(smooth);
    return this.lock ? this.lock.add(motion) : motion;
  }
}
