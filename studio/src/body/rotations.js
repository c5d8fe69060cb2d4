// Rotations as 6D, matrices (nine numbers, row by row) and quaternions (w x y z): the formulas of
// src/shared/motion/rotations.py, one rotation at a time.

const EPSILON = 1e-6;

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const unit = (a, epsilon = 1e-12) => scale(a, 1 / Math.max(norm(a), epsilon));
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

export const multiply = (a, b) => {
  const c = new Array(9);
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) c[i + j] = a[i] * b[j] + a[i + 1] * b[3 + j] + a[i + 2] * b[6 + j];
  return c;
};
export const transposed = (m) => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
export const apply = (m, v) => [
  m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
  m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
  m[6] * v[0] + m[7] * v[1] + m[8] * v[2],
];

/** Gram-Schmidt of the six numbers at `at`; degenerate ones become a rotation all the same. */
export function matrixOf6d(d6, at = 0) {
  let a1 = [d6[at], d6[at + 1], d6[at + 2]];
  const a2 = [d6[at + 3], d6[at + 4], d6[at + 5]];
  if (!(norm(a1) > EPSILON)) a1 = [1, 0, 0];
  const b1 = unit(a1, EPSILON);
  let b2 = sub(a2, scale(b1, dot(b1, a2)));
  if (norm(b2) <= EPSILON * (1 + norm(a2))) {
    const sizes = b1.map(Math.abs);
    const spare = [0, 0, 0];
    spare[sizes.indexOf(Math.min(...sizes))] = 1;
    b2 = sub(spare, scale(b1, dot(b1, spare)));
  }
  b2 = unit(b2, EPSILON);
  const b3 = cross(b1, b2);
  return [b1[0], b2[0], b3[0], b1[1], b2[1], b3[1], b1[2], b2[2], b3[2]];
}

/** The first two columns of a matrix, written into `d6` at `at`. */
export function write6d(m, d6, at) {
  d6.set([m[0], m[3], m[6], m[1], m[4], m[7]], at);
}

/** Unit quaternion with w >= 0 (Shepperd 1978: the largest divisor of four). */
export function quaternionOf(m) {
  const squares = [1 + m[0] + m[4] + m[8], 1 + m[0] - m[4] - m[8], 1 - m[0] + m[4] - m[8], 1 - m[0] - m[4] + m[8]];
  const [yz, zx, xy] = [m[7] - m[5], m[2] - m[6], m[3] - m[1]];
  const [sxy, szx, syz] = [m[3] + m[1], m[2] + m[6], m[7] + m[5]];
  const rows = [
    [squares[0], yz, zx, xy],
    [yz, squares[1], sxy, szx],
    [zx, sxy, squares[2], syz],
    [xy, szx, syz, squares[3]],
  ];
  const q = rows[squares.indexOf(Math.max(...squares))];
  const size = Math.hypot(...q) * (q[0] < 0 ? -1 : 1);
  return q.map((x) => x / size);
}

export function matrixOf(q, at = 0) {
  const size = Math.max(Math.hypot(q[at], q[at + 1], q[at + 2], q[at + 3]), 1e-12);
  const [w, x, y, z] = [q[at] / size, q[at + 1] / size, q[at + 2] / size, q[at + 3] / size];
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

/** First `b`, then `a`. */
export const product = (a, b) => [
  a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
  a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
  a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
  a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
];
export const conjugate = (q) => [q[0], -q[1], -q[2], -q[3]];

export function logOf(q) {
  const sign = q[0] < 0 ? -1 : 1;
  const sine = Math.hypot(q[1], q[2], q[3]);
  const factor = sine > EPSILON ? (2 * Math.atan2(sine, sign * q[0])) / sine : 2;
  return [sign * q[1] * factor, sign * q[2] * factor, sign * q[3] * factor];
}

export function expOf(v) {
  const angle = norm(v);
  const factor = angle > EPSILON ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), v[0] * factor, v[1] * factor, v[2] * factor];
}

/** On the short way from q0 to q1; `t` within [0, 1]. */
export const slerp = (q0, q1, t) => product(q0, expOf(scale(logOf(product(conjugate(q0), q1)), t)));

/** Signs [T,K,4], in place, such that neighbours lie in one hemisphere; w >= 0 at first. */
export function continuous(q, width) {
  for (let joint = 0; joint < width; joint += 4)
    for (let at = joint; at < q.length; at += width) {
      const before = at - width;
      const along = before < 0
        ? q[at]
        : q[at] * q[before] + q[at + 1] * q[before + 1] + q[at + 2] * q[before + 2] + q[at + 3] * q[before + 3];
      if (along < 0) for (let i = 0; i < 4; i++) q[at + i] = -q[at + i];
    }
  return q;
}

export function yawMatrix(angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c, 0, s, 0, 1, 0, -s, 0, c];
}
export const yawQuaternion = (angle) => [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0];

export function turnAboutY([x, y, z], angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x + s * z, y, c * z - s * x];
}

export const axisTurn = (axis, angle) => matrixOf(expOf(scale(axis, angle)));

/** The smallest rotation that takes one direction to another. */
export function shortestTurn(source, target) {
  const [a, b] = [unit(source), unit(target)];
  const axis = cross(a, b);
  return axisTurn(unit(axis), Math.atan2(norm(axis), dot(a, b)));
}

/** Twist about +Y of a matrix, radians. */
export function headingAngle(m) {
  const q = quaternionOf(m);
  return 2 * Math.atan2(q[2], q[0]);
}

/** Angles without jumps of 2 pi, in place. */
export function unwrap(angles) {
  let turns = 0;
  for (let t = 1, last = angles[0]; t < angles.length; t++) {
    const step = angles[t] - last;
    last = angles[t];
    // as numpy: a step of exactly pi keeps its sign
    let short = ((((step + Math.PI) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) - Math.PI;
    if (short === -Math.PI && step > 0) short = Math.PI;
    if (Math.abs(step) >= Math.PI) turns += short - step;
    angles[t] += turns;
  }
  return angles;
}
