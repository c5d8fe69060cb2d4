// Motion of any length: windows that begin with the last frames before them
// (src/shared/pipelines/stream.py).

import { bridge, goneDown, isApart, leaps } from "../body/bridge.js";
import { cut, decodeFeatures, framesOf, joinArrays, mirrored, ROOT, WIDTH } from "../body/features.js";
import { Course, StreamingPostProcessor } from "../body/streaming.js";
import { endsAtRest } from "../body/measurements.js";
import { INDEX, pose } from "../body/skeleton.js";
import { blendBoundaries } from "../body/whole.js";
import { derivedSeed } from "./noise.js";

export const WINDOW = 150, OVERLAP = 30, SHORTEST = 48, TRIES = 8;
const LIVE = 15, AHEAD = 30; // frames after which another text may begin, and those made beyond: WINDOW and AHEAD of live.py
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

/** So many frames more on both sides, of which nothing is known; none where the number is below zero. */
function padded(given, before, after) {
  const ends = [before, after].map((frames) => freeConstraint(Math.max(frames, 0)));
  const joined = (name, Kind) => joinArrays([ends[0][name], given[name], ends[1][name]], Kind);
  return { values: joined("values"), known: joined("known", Uint8Array), shown: joined("shown", Uint8Array) };
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

/** Raw features of passages one after another, at once; see `featurePieces`. */
export async function streamFeatures(...all) {
  const pieces = [];
  for await (const piece of featurePieces(...all)) pieces.push(piece);
  return joinArrays(pieces);
}

/** The same with the ways between them, and from where to where each passage goes. */
export async function spannedFeatures(sampler, passages, seed, options) {
  const pieces = [], begun = [], ways = [], sum = () => pieces.reduce((total, piece) => total + framesOf(piece), 0);
  function* asked() {
    for (const passage of passages) {
      begun.push(sum());
      ways.push(0);
      yield passage;
    }
  }
  const passing = (frames) => { ways[ways.length - 1] = frames; };
  for await (const piece of featurePieces(sampler, asked(), seed, { ...options, bridged: true, passing })) pieces.push(piece);
  const stops = [...begun.slice(1), sum()];
  return { features: joinArrays(pieces), spans: passages.map(({ timed }, i) => [begun[i] + (timed === undefined ? ways[i] : 0), stops[i]]) };
}

/**
 * Raw features of passages { text, frames, window?, miss?, afresh?, timed?, low?, mirrored? } in pieces that never change again.
 * @param {Sampler} sampler
 * @param {Iterable<object>} passages taken one by one, each when the motion before it is made; one of one window that is `gone()` meanwhile was none
 * @param {bigint|number} seed
 * @param {{constraint?: object, window?: number, overlap?: number, ahead?: number, bridged?: boolean, guidance?: number, told?: function, passing?: function}} options
 *     constraint: of all frames; ahead: frames made beyond a passage, which one with another text drops, all that a window holds of a text that goes on; bridged: the way to another posture is shown first, beyond a passage's frames if it is not timed; told: called with the frames that are done; passing: with those of a way before it comes
 */
async function* featurePieces(sampler, passages, seed, options = {}) {
  const { constraint = null, window = WINDOW, overlap = OVERLAP, ahead = 0, bridged = false, guidance, told, passing } = options;
  let before = new Float32Array(), spare = before, made = 0, number = 0, said = null;
  const goOn = (piece) => {
    before = cut(joinArrays([before, piece]), -overlap);
    made += framesOf(piece);
    told?.(made);
    return piece;
  };
  const seeds = () => retrySeeds(derivedSeed(seed, number));
  /** Whether there is time for a way, and no repetition that it would cut short. */
  const bridges = ({ timed, window: repeats, frames }) => bridged && (timed === undefined || !(repeats || frames < SHORTEST));
  /** A window that goes on from `shared` frames; null where nobody asks for it any more. */
  const asked = new Map(); // samples of a window: frames, seed, shared ones
  const tried = async (passage, frames, trial, shared, alone = false) => {
    const kept = framesOf(shared), start = Math.max(made - kept, 0); // ways are beyond what a constraint counts
    const known = constraint ? padded(windowOf(constraint, start, made + frames), kept - made + start, 0) : freeConstraint(kept + frames);
    known.values.set(shared);
    known.known.fill(1, 0, shared.length);
    known.shown.fill(1, 0, shared.length);
    const longer = padded(known, 0, SHORTEST - framesOf(known.values));
    const given = kept > 0 || constraint ? longer : null;
    const key = `${frames} ${trial} ${kept}`;
    let piece = asked.get(key);
    if (!piece) {
      const seen = passage.mirrored && given ? mirrorOf(given) : given;
      const features = await sampler.sample(passage.text, framesOf(longer.values), trial, seen, { guidance, gone: passage.gone });
      if (!features) return null;
      piece = cut(blendBoundaries(cut(passage.mirrored ? mirrored(features) : features, 0, kept + frames), known.known), kept);
      asked.set(key, piece);
    }
    if (alone || kept || !before.length || (bridges(passage) && isApart(before, piece))) return piece;
    return met(before, piece, known.known);
  };
  /** Whether what comes first begins a leap away, or what goes on from before leaps as that does not; not where a pose is known of it; null as above. */
  const leapt = async (passage, frames) => {
    if (constraint?.known.slice(made * WIDTH, (made + frames) * WIDTH).some((known, i) => known && i % WIDTH < ROOT)) return false;
    const [trial] = seeds(), piece = await tried(passage, frames, trial, new Float32Array(), true);
    if (!piece || (isApart(before, piece) && (passage.low || leaps(before, cut(piece, 0, 1))))) return piece && true;
    const joined = await tried(passage, frames, trial, before);
    return joined && leaps(before, joined) && (isApart(before, piece) || !leaps(cut(piece, 0, 1), piece));
  };
  next: for (const passage of passages) {
    const shows = `${passage.mirrored ? "mirrored " : ""}${passage.text}`;
    if (shows === said && framesOf(spare) >= passage.frames) {
      const piece = cut(spare, 0, passage.frames);
      spare = cut(spare, passage.frames);
      yield goOn(piece);
      continue;
    }
    asked.clear();
    const earlier = said, fresh = shows !== said, widest = Math.min(window, passage.window ?? window);
    let own = new Float32Array(), lucky = []; // the seed of the repetition before
    let apart = passage.afresh && fresh && stands(before);
    let beyond = constraint || passage.miss ? 0 : ahead;
    if (bridges(passage) && fresh && before.length && !apart) {
      const [length] = windowLengths(passage.frames, framesOf(before), widest, overlap);
      apart = await leapt(passage, length + beyond);
      if (apart === null) continue;
    }
    let shared = apart ? new Float32Array() : before;
    if (beyond && !fresh) beyond = Math.max(beyond, window - framesOf(shared) - passage.frames);
    said = shows;
    for (let length of windowLengths(passage.frames, framesOf(shared), widest, overlap)) {
      let best = null, least = Infinity, chosen = null;
      for (const trial of [...lucky, ...seeds()]) {
        const piece = await tried(passage, length + beyond, trial, shared);
        if (!piece) { said = earlier; continue next; }
        const found = passage.miss ? passage.miss(joinArrays([own, piece])) : 0;
        if (found < least) { least = found; best = piece; chosen = trial; }
        if (least <= 0) break;
      }
      if (bridges(passage) && !shared.length && before.length && isApart(before, best)) {
        if (passage.timed === undefined) { // who lies down on his knees does not stand up for it
          best = cut(best, goneDown(before, best));
          made += Math.max(length - framesOf(best), 0);
          length = Math.min(length, framesOf(best));
        }
        let way = bridge(before, best);
        if (passage.timed) { // a part of what the passage has
          const first = Math.min(framesOf(way), Math.floor(length / 2));
          best = cut(best, first);
          length -= first;
          made += first;
          way = bridge(before, best, first);
        }
        before = joinArrays([before, way]);
        passing?.(framesOf(way));
        yield way;
      }
      spare = cut(best, length);
      best = goOn(cut(best, 0, length));
      shared = before;
      own = joinArrays([own, best]);
      lucky = passage.window ? [chosen] : [];
      number++;
      asked.clear();
      yield best;
    }
  }
}

const mirrorOf = ({ values, known, shown }) => ({ values: mirrored(values), known: mirrored(known, true), shown: mirrored(shown, true) });

/** Motion without end in settled pieces, while the text changes. */
export class MotionStream {
  texts = []; // first frames of passages, and what they show
  made = 0;
  shown = 0;
  course = new Course();

  /** @param {Sampler} sampler @param {object} post settings @param {function} plan of a text: what is done, in order, the last of it on and on @param {number} seed */
  constructor(sampler, post, plan, seed) {
    this.plan = plan;
    this.processor = new StreamingPostProcessor(post);
    this.pieces = featurePieces(sampler, this.passages(), seed, { ahead: AHEAD, bridged: true });
  }

  *passages() {
    for (;;) {
      const { now } = this, { text, parts } = now;
      if (this.textAt(this.made) !== text) this.texts.push([this.made, text]);
      for (const part of parts) {
        this.straight = part.straight;
        let left = part === parts.at(-1) ? Infinity : part.frames;
        for (; left > 0 && this.now === now; left -= LIVE) yield { ...part, frames: LIVE, gone: () => this.now !== now };
      }
    }
  }

  /** What is to be done as soon as it is known. */
  say(text) {
    if (text !== this.said?.text) {
      const said = { text, done: this.plan(text).then((parts) => { if (this.said === said) this.now = { text, parts }; }) };
      this.said = said;
    }
    return this.said.done;
  }

  /** The next piece that settles, with the text that each of its frames shows. */
  async next(text) {
    await this.say(text);
    for (;;) {
      const { value } = await this.pieces.next();
      this.made += framesOf(value);
      const piece = this.processor.add(this.course.add(value, this.straight));
      if (!piece) continue;
      const texts = Array.from({ length: piece.frames }, () => this.textAt(this.shown++));
      while (this.texts[1]?.[0] <= this.shown) this.texts.shift();
      return { ...piece, texts };
    }
  }

  textAt(frame) {
    return this.texts.findLast(([start]) => start <= frame)?.[1];
  }
}
