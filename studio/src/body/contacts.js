// Which feet stand, where, and how far each frame's foot is from there: a port of
// src/shared/motion/postprocess/contacts.py, which says why. Points are [x, y, z], metres.

import { add, clamp, norm, scale, sub } from "./rotations.js";
import { gaussian, gradient, maximum, minimum, round } from "./curves.js";
import { REST_FOOT_HEIGHT } from "./skeleton.js";

const THRESHOLD = 0.5, MAX_CLAIM = 0.12, AROUND_SECONDS = 0.4, FLAT = 0.01;
const MAX_SUPPORT = 0.08, MAX_VERTICAL = 0.5, STEEP = 0.7, FALL = -3.0, RUNNING = 2.0, PACE_SECONDS = 0.2;
const MAX_GAP_SECONDS = 2 / 30, MIN_PLANT_SECONDS = 3 / 30, MIN_SWING_SECONDS = 8 / 30;
const SOONER_SECONDS = 12 / 30, BLEND_SECONDS = 9 / 30, STEP_SECONDS = 8 / 30;
const LIFT = 0.1, SLOPE = 0.1, SOFT = 0.01, GIVE = 0.05, ROLL = 0.005, MAX_DRAG = 0.22;
const MAX_SLOPE = 2.5, UNDER = [0, 0.5, 1], MAX_REACH = 0.94, SWING = 150;

/** Shifts [2][T] of the balls [2][T] and whether each foot stands [2][T]. */
export function footShifts(balls, hips, contacts, fps, kept) {
  const shifts = grounding(balls, hips, kept, fps);
  const moved = balls.map((path, side) => path.map((point, t) => add(point, shifts[side][t])));
  const stands = standing(moved, hips, contacts, fps), runs = running(hips, fps);
  const planted = stands.map((row) => row.map((stands, t) => stands && runs[t]));
  const walking = stands.map((row) => row.map((stands, t) => stands && !runs[t]));
  plantSpans(moved, hips, walking, fps, kept).forEach((plants, side) => {
    const more = corrections(moved[side], plants, kept[side], planted[side], fps);
    shifts[side] = shifts[side].map((shift, t) => add(shift, more[t]));
    for (const plant of plants) planted[side].fill(true, plant.start, plant.stop);
  });
  return { shifts, planted };
}

function carrying(balls, hips) {
  return balls.map((path, side) =>
    path.map((ball, t) => {
      const [x, y, z] = sub(hips[side][t], ball);
      return y > STEEP * Math.hypot(x, z);
    }),
  );
}

function grounding(balls, hips, kept, fps) {
  const frames = balls[0].length, carries = carrying(balls, hips);
  let low = Array.from({ length: frames }, (_, t) => Math.min(balls[0][t][1], balls[1][t][1]) - REST_FOOT_HEIGHT);
  low = minimum(low, 2 * round(AROUND_SECONDS * fps) + 1);
  low = low.map((x) => Math.sign(x) * Math.max(Math.abs(x) - FLAT, 0));
  low = low.map((x, t) => (carries[0][t] || carries[1][t] ? x * clamp(2 - Math.abs(x) / MAX_CLAIM, 0, 1) : 0));
  return kept.map((legs) => {
    const near = maximum(legs.map(Number), 2 * round(0.2 * fps) + 1);
    const off = gaussian(low.map((x, t) => x * (1 - near[t])), 0.1 * fps);
    return off.map((x, t) => [0, legs[t] ? 0 : -x, 0]);
  });
}

function standing(balls, hips, contacts, fps) {
  const height = balls.map((path) => path.map((point) => point[1] - REST_FOOT_HEIGHT));
  const carries = carrying(balls, hips);
  const claimed = height.map((row, side) => row.map((h, t) => contacts[side][t] > THRESHOLD && h < MAX_CLAIM && carries[side][t]));
  if (balls[0].length < 2) return claimed;
  const vertical = height.map((row) => gradient(row).map((v) => Math.abs(v) * fps));
  const waist = gaussian(hips[0].map((point, t) => (point[1] + hips[1][t][1]) / 2), 0.05 * fps);
  const flies = gradient(gradient(waist)).map((a) => a * fps * fps < FALL);
  return claimed.map((row, side) =>
    row.map((claim, t) => {
      if (claim) return true;
      const lower = height[0][t] <= height[1][t] ? 0 : 1;
      const low = height[side][t] < MAX_SUPPORT && vertical[side][t] < MAX_VERTICAL && !flies[t] && carries[side][t];
      return !claimed[0][t] && !claimed[1][t] && low && lower === side;
    }),
  );
}

function running(hips, fps) {
  if (hips[0].length < 2) return hips[0].map(() => false);
  const way = [0, 2].map((axis) => gradient(hips[0].map((point, t) => (point[axis] + hips[1][t][axis]) / 2)));
  return gaussian(way[0].map((x, t) => Math.hypot(x, way[1][t]) * fps), PACE_SECONDS * fps).map((pace) => pace >= RUNNING);
}

function contactRuns(contact, maxGap) {
  const runs = [];
  for (let t = 0, start = -1; t <= contact.length; t++) {
    if (contact[t] && start < 0) start = t;
    if (!contact[t] && start >= 0) {
      const last = runs[runs.length - 1];
      if (last && start - last[1] <= maxGap) last[1] = t;
      else runs.push([start, t]);
      start = -1;
    }
  }
  return runs;
}

// ---------------------------------------------------------------- where

function plantSpans(balls, hips, stands, fps, kept) {
  const free = stands[0].map((_, t) => (stands[0][t] || stands[1][t]) && !kept[0][t] && !kept[1][t]);
  const planner = new Planner(balls, hips, free, fps, kept);
  for (const [start, stop, side] of runsOf(balls, stands, fps, kept)) planner.stand(start, stop, side);
  planner.stepOn(balls[0].length, null);
  return planner.found;
}

class Planner {
  constructor(balls, hips, free, fps, kept) {
    Object.assign(this, { balls, hips, free, fps, kept, found: [[], []], until: 0, last: 0 });
    this.shortest = Math.min(round(MIN_PLANT_SECONDS * fps), balls[0].length);
    this.swing = round(MIN_SWING_SECONDS * fps);
    this.sooner = round(SOONER_SECONDS * fps);
  }

  stand(start, stop, side) {
    this.stepOn(start, side);
    if (this.gap(start) && start - this.until <= this.sooner)
      start = Math.max(this.ready(side), Math.min(start, this.until));
    this.plant(start, stop, side);
  }

  stepOn(start, side) {
    while (this.gap(start) && (start - this.until > this.sooner || side === null || side === this.last)) {
      const before = this.until, between = 1 - this.last;
      this.plant(this.ready(between), between === side ? start - this.swing : start, between);
      if (this.until === before) break;
    }
  }

  gap(start) {
    return this.until < start && this.free.slice(this.until, start).every(Boolean);
  }

  ready(side) {
    const plants = this.found[side];
    return Math.max(this.until, plants.length ? plants[plants.length - 1].stop + this.swing : 0);
  }

  plant(start, stop, side) {
    const ball = this.balls[side], hip = this.hips[side];
    const fixed = [];
    for (let t = start; t < stop; t++) if (this.kept[side][t]) fixed.push(t - start);
    let point, first, last;
    if (fixed.length) {
      point = onFloor(ball[start + (fixed[0] === 0 ? fixed[fixed.length - 1] : fixed[0])]);
      [first, last] = reached(point, hip, start, stop);
    } else if (stop - start < this.shortest) return;
    else [point, first, last] = inReach(ball, hip, start, stop, this.shortest);
    if (!fixed.length) first = this.landing(point, first, side);
    if (last - first >= this.shortest) {
      this.found[side].push({ start: first, stop: last, point });
      if (last > this.until) { this.until = last; this.last = side; }
    }
  }

  landing(point, first, side) {
    const before = this.found[side].at(-1);
    if (!before) return first;
    const away = Math.hypot(...point.map((value, axis) => value - before.point[axis]));
    const swing = Math.ceil(Math.sqrt((6 * away) / SWING) * this.fps);
    const leaves = Math.min(first - swing, before.stop);
    if (leaves === before.stop) return first;
    const kept = this.kept[side].slice(Math.max(leaves, 0), before.stop).some(Boolean);
    if (kept || leaves - before.start < this.shortest) return before.stop + swing;
    before.stop = leaves;
    return first;
  }
}

function runsOf(balls, stands, fps, kept) {
  const runs = [];
  for (const side of [0, 1])
    for (const [start, stop] of bridgedRuns(stands[side], balls[side], fps)) {
      const whole = kept[side].slice(start, stop).some(Boolean);
      const pieces = whole ? [[start, stop]] : stepsOf(balls[side].slice(start, stop), start, fps, 0.5 * side);
      for (const [first, last] of pieces) runs.push([first, last, side]);
    }
  return runs.sort((a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2]);
}

/** Runs; a short gap is bridged, unless the ball got far in it: a quick step. */
function bridgedRuns(stands, ball, fps) {
  const runs = [];
  for (const [start, stop] of contactRuns(stands, 0)) {
    const last = runs[runs.length - 1];
    const way = last ? Math.hypot(ball[start][0] - ball[last[1] - 1][0], ball[start][2] - ball[last[1] - 1][2]) : Infinity;
    if (way <= MAX_DRAG && start - last[1] <= round(MAX_GAP_SECONDS * fps)) last[1] = stop;
    else runs.push([start, stop]);
  }
  return runs;
}

function stepsOf(path, start, fps, phase) {
  const all = [[start, start + path.length]];
  const x = path.map((p) => p[0]), z = path.map((p) => p[2]);
  const mean = (row) => row.reduce((a, b) => a + b, 0) / row.length;
  const [mx, mz] = [mean(x), mean(z)];
  if (Math.max(...x.map((v, t) => Math.hypot(v - mx, z[t] - mz))) <= MAX_DRAG) return all;
  const [sx, sz] = [gaussian(x, 0.1 * fps), gaussian(z, 0.1 * fps)];
  const way = [0];
  for (let t = 1; t < sx.length; t++) way.push(way[t - 1] + Math.hypot(sx[t] - sx[t - 1], sz[t] - sz[t - 1]));
  const step = round(STEP_SECONDS * fps), length = way[way.length - 1];
  const number = Math.min(Math.ceil(length / (2 * MAX_DRAG)), Math.floor(path.length / (2 * step)));
  if (number < 2) return all;
  const half = Math.floor(step / 2), edges = [-half];
  for (let i = 1; i <= number; i++) {
    const mark = (i - phase) / number;
    if (mark < 1 - 1e-9) edges.push(searchSorted(way, mark * length));
  }
  edges.push(path.length + half);
  const pieces = [];
  for (let i = 1; i < edges.length; i++) {
    const [a, b] = [edges[i - 1] + half, edges[i] - half];
    if (b > a) pieces.push([start + Math.max(a, 0), start + Math.min(b, path.length)]);
  }
  return pieces;
}

/** First place whose value is not below `value`. */
function searchSorted(values, value) {
  const at = values.findIndex((v) => v >= value);
  return at < 0 ? values.length : at;
}

const onFloor = (point) => [point[0], REST_FOOT_HEIGHT, point[2]];

function meanPoint(points, first, last) {
  let sum = [0, 0, 0];
  for (let t = first; t < last; t++) sum = add(sum, points[t]);
  return scale(sum, 1 / (last - first));
}

function inReach(ball, hip, start, stop, shortest) {
  for (let first = start; first <= stop - shortest; first++)
    for (let last = stop; last >= first + shortest; last--) {
      const foot = meanPoint(ball, first, last), under = meanPoint(hip, first, last);
      for (const share of UNDER) {
        const point = onFloor(add(scale(foot, 1 - share), scale(under, share)));
        let far = 0;
        for (let t = first; t < last; t++) far = Math.max(far, norm(sub(hip[t], point)));
        if (far <= MAX_REACH) return [point, first, last];
      }
    }
  return [onFloor(ball[start]), start, start];
}

function reached(point, hip, start, stop) {
  const away = hip.slice(start, stop).map((place) => norm(sub(place, point)));
  const nearest = away.indexOf(Math.min(...away));
  if (away[nearest] > MAX_REACH) return [start, start];
  let first = nearest, last = nearest + 1;
  while (first > 0 && away[first - 1] <= MAX_REACH) first--;
  while (last < away.length && away[last] <= MAX_REACH) last++;
  return [start + first, start + last];
}

// ---------------------------------------------------------------- how far

/** Between plants a foot is lifted, unless it treads [T] on the floor there, running. */
function corrections(ball, plants, keptLegs, treads, fps) {
  const frames = ball.length;
  let shift = ball.map(() => [0, 0, 0]);
  const known = [...keptLegs], lift = new Array(frames).fill(0);
  for (const plant of plants) {
    const path = ball.slice(plant.start, plant.stop);
    const give = keptLegs.slice(plant.start, plant.stop).some(Boolean) ? null : giveOf(path, fps);
    path.forEach((point, i) => {
      const own = sub(plant.point, point);
      if (give) { own[0] += give[i][0]; own[2] += give[i][2]; }
      own[1] = clamp(point[1], REST_FOOT_HEIGHT, REST_FOOT_HEIGHT + ROLL) - point[1];
      shift[plant.start + i] = own;
      known[plant.start + i] = true;
    });
  }
  keptLegs.forEach((kept, t) => { if (kept) shift[t] = [0, 0, 0]; });
  for (let i = 1; i < plants.length; i++) {
    const [before, after] = [plants[i - 1], plants[i]];
    if (treads.slice(before.stop, after.start).some(Boolean)) continue;
    const number = after.start - before.stop;
    const height = Math.min(LIFT, SLOPE * norm(sub(after.point, before.point)));
    for (let t = 0; t < number; t++) lift[before.stop + t] = height * Math.sin((Math.PI * (t + 1)) / (number + 1)) ** 2;
  }
  shift = bridged(shift, known, round(BLEND_SECONDS * fps), fps);
  for (let t = 0; t < frames; t++) {
    if (known[t] || lift[t] === 0) continue;
    const missing = lift[t] - (ball[t][1] + shift[t][1] - REST_FOOT_HEIGHT);
    const soft = clamp((missing + SOFT) / (2 * SOFT), 0, 1) ** 2 * SOFT;
    shift[t][1] += (missing < SOFT ? soft : missing) * Math.min(lift[t] / SOFT, 1);
  }
  const above = aboveFloor(ball.map((point, t) => point[1] + shift[t][1]), known, fps);
  above.forEach((x, t) => { shift[t][1] += x; });
  return shift;
}

function giveOf(path, fps) {
  const mean = meanPoint(path, 0, path.length);
  const own = path.map((point) => [point[0] - mean[0], 0, point[2] - mean[2]]);
  let speed = 0;
  for (let t = 1; t < own.length; t++) speed += norm(sub(own[t], own[t - 1]));
  speed = (speed * fps) / Math.max(path.length - 1, 1);
  return own.map((point) => scale(point, Math.min(1, GIVE / Math.max(speed, 1e-9))));
}

function bridged(given, known, blend, fps) {
  const shift = given.map((point) => [...point]), limit = MAX_SLOPE / fps, frames = shift.length;
  const zero = [0, 0, 0];
  const end = (at, inner) => {
    const here = at >= 0 && at < frames ? shift[at] : zero;
    let slope = zero;
    if (Math.min(at, inner) >= 0 && Math.max(at, inner) < frames && known[inner])
      slope = scale(sub(shift[at], shift[inner]), at - inner);
    return [here, slope.map((x) => clamp(x, -limit, limit))];
  };
  for (let start = 0; start < frames; start++) {
    if (known[start]) continue;
    let stop = start;
    while (stop < frames && !known[stop]) stop++;
    const [left, leftSlope] = end(start - 1, start - 2), [right, rightSlope] = end(stop, stop + 1);
    const number = stop - start + 1;
    if (start > 0 && stop < frames && number <= 2 * blend) {
      const curve = hermite(left, right, leftSlope, rightSlope, number);
      for (let t = start; t < stop; t++) shift[t] = curve[t - start + 1];
    } else {
      const out = hermite(left, zero, leftSlope, zero, blend), into = hermite(zero, right, zero, rightSlope, blend);
      for (let t = start, along = 1; t < stop; t++, along++) {
        if (start > 0) shift[t] = add(shift[t], out[Math.min(along, blend)]);
        if (stop < frames) shift[t] = add(shift[t], into[Math.max(along - number + blend, 0)]);
      }
    }
    start = stop;
  }
  return shift;
}

function hermite(left, right, leftSlope, rightSlope, number) {
  return Array.from({ length: number + 1 }, (_, i) => {
    const u = i / number, v = u * u, w = v * u;
    return [0, 1, 2].map((k) =>
      (2 * w - 3 * v + 1) * left[k] + (w - 2 * v + u) * number * leftSlope[k]
      + (3 * v - 2 * w) * right[k] + (w - v) * number * rightSlope[k]);
  });
}

function aboveFloor(height, known, fps) {
  const depth = height.map((h, t) => (known[t] ? 0 : Math.max(REST_FOOT_HEIGHT - h, 0)));
  if (!depth.some(Boolean)) return depth;
  const width = 2 * round(0.1 * fps) + 1;
  return gaussian(maximum(depth, width), width / 6).map((x, t) => (known[t] ? 0 : x));
}
