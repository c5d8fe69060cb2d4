// Motions: decoding, poses by forward kinematics, and the little vector algebra both renderers use.

const data = JSON.parse(document.getElementById("data").textContent);
const JOINTS = data.parents.length;

function decode(text, Type) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return new Type(bytes.buffer);
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => { const n = Math.hypot(...a) || 1; return a.map((v) => v / n); };

// Rows of the rotation matrix of a quaternion w, x, y, z.
function matrixOf(q, at) {
  const w = q[at], x = q[at + 1], y = q[at + 2], z = q[at + 3];
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

const turn = (m, x, y, z) => [
  m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z,
];

class Motion {
  constructor(raw) {
    this.text = raw.text;
    this.fps = raw.fps;
    this.turns = decode(raw.quaternions, Int16Array); // [T, 22, 4], 32767 is one
    this.root = decode(raw.root, Float32Array); // [T, 3] metres
    this.contacts = decode(raw.contacts, Uint8Array); // [T, 2], 255 is one
    this.frames = this.root.length / 3;
    this.seconds = Math.max(this.frames - 1, 0) / this.fps;
    this.calm = this.smooth(Math.round(0.4 * this.fps));
  }

  // The path a following camera takes: a moving average of the pelvis over the floor.
  smooth(reach) {
    const path = new Float32Array(this.frames * 2);
    for (let t = 0; t < this.frames; t++) {
      const first = Math.max(0, t - reach), last = Math.min(this.frames - 1, t + reach);
      for (let k = first; k <= last; k++) {
        path[2 * t] += this.root[3 * k] / (last - first + 1);
        path[2 * t + 1] += this.root[3 * k + 2] / (last - first + 1);
      }
    }
    return path;
  }

  // World position and rotation matrix of every joint at a time in seconds.
  pose(time) {
    const at = clamp(time * this.fps, 0, this.frames - 1);
    const first = Math.floor(at), next = Math.min(first + 1, this.frames - 1), share = at - first;
    const mix = (array, width, i) =>
      array[first * width + i] * (1 - share) + array[next * width + i] * share;
    const local = new Float32Array(4);
    const places = [], rotations = [];
    for (let j = 0; j < JOINTS; j++) {
      const a = (first * JOINTS + j) * 4, b = (next * JOINTS + j) * 4;
      let same = 0;
      for (let i = 0; i < 4; i++) same += this.turns[a + i] * this.turns[b + i];
      const sign = same < 0 ? -1 : 1; // the short way round
      for (let i = 0; i < 4; i++) local[i] = this.turns[a + i] * (1 - share) + sign * this.turns[b + i] * share;
      const norm = Math.hypot(...local) || 1;
      for (let i = 0; i < 4; i++) local[i] /= norm;
      const m = matrixOf(local, 0), parent = data.parents[j];
      if (parent < 0) {
        rotations.push(m);
        places.push([0, 1, 2].map((i) => mix(this.root, 3, i)));
        continue;
      }
      const up = rotations[parent], rest = data.rest;
      const bone = [0, 1, 2].map((i) => rest[j][i] - rest[parent][i]);
      const moved = turn(up, ...bone);
      places.push(places[parent].map((v, i) => v + moved[i]));
      rotations.push([0, 1, 2].flatMap((r) => [0, 1, 2].map(
        (c) => up[3 * r] * m[c] + up[3 * r + 1] * m[3 + c] + up[3 * r + 2] * m[6 + c])));
    }
    const contacts = [0, 1].map((i) => mix(this.contacts, 2, i) / 255);
    const calm = [0, 1].map((i) => mix(this.calm, 2, i));
    return { places, rotations, contacts, calm, share: this.frames > 1 ? at / (this.frames - 1) : 1 };
  }

  // Middle of the path and half its extent, for a camera that stands still.
  bounds() {
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (let t = 0; t < this.frames; t++) for (const [i, k] of [[0, 0], [1, 2]]) {
      low[i] = Math.min(low[i], this.root[3 * t + k]);
      high[i] = Math.max(high[i], this.root[3 * t + k]);
    }
    return { middle: low.map((v, i) => (v + high[i]) / 2), reach: Math.hypot(high[0] - low[0], high[1] - low[1]) / 2 };
  }
}

// An arrow on the floor that shows where the pelvis faces: five corners [x, z].
function arrow(pose) {
  const m = pose.rotations[0], flat = Math.hypot(m[2], m[8]);
  if (flat < 1e-3) return [];
  const ax = m[2] / flat, az = m[8] / flat, [x, , z] = pose.places[0];
  const corner = (ahead, side) => [x + ahead * ax + side * az, z + ahead * az - side * ax];
  return [corner(0.52, 0), corner(0.36, 0.09), corner(0.41, 0), corner(0.36, -0.09)];
}

// A perspective camera that orbits around a point; `project` gives pixels inside a cell.
class Camera {
  constructor(target, view, aspect) {
    const far = view.distance / Math.min(1, aspect * 1.15);
    const ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
    this.target = target;
    this.forward = [Math.sin(view.azimuth) * ce, se, Math.cos(view.azimuth) * ce]; // to the eye
    this.right = unit(cross([0, 1, 0], this.forward));
    this.up = cross(this.forward, this.right);
    this.eye = target.map((v, i) => v + far * this.forward[i]);
    this.aspect = aspect;
    this.focal = 1 / Math.tan(Math.PI * 32 / 360);
  }

  matrix() { // column-major view-projection
    const near = 0.05, far = 200, f = this.focal, { right: r, up: u, forward: b, eye: e } = this;
    const z = (far + near) / (near - far), w = 2 * far * near / (near - far);
    const row = (v) => [...v, -dot(v, e)];
    const rows = [row(r).map((v) => v * f / this.aspect), row(u).map((v) => v * f),
      row(b).map((v, i) => v * z + (i === 3 ? w : 0)), row(b).map((v) => -v)];
    return new Float32Array([0, 1, 2, 3].flatMap((c) => rows.map((line) => line[c])));
  }

  project(point, width, height) { // x, y, depth, pixels a metre
    const d = point.map((v, i) => v - this.eye[i]);
    const depth = Math.max(-dot(d, this.forward), 0.05), scale = this.focal * height / 2 / depth;
    return [width / 2 + dot(d, this.right) * scale, height / 2 - dot(d, this.up) * scale, depth, scale];
  }
}
