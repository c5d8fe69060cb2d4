// The scene of the preview: decoding, poses, camera, floor, and the body in WebGL or plain 2D.
// Metres, +Y up; quaternions w, x, y, z; K joints in the order of the file.

const DATA = JSON.parse(document.getElementById("data").textContent);
const { parents, offsets, rest, sides, feet } = DATA.skeleton;
const K = parents.length;
const LIGHT = unit([0.3, 0.8, 0.6]);
const SLANT = [0.22, 0.28]; // how far a shadow reaches in x and z for each metre of height
const FIELD_OF_VIEW = (30 * Math.PI) / 180;
const NEAR = 0.1, FAR = 200;

function decode(text, Type) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return new Type(bytes.buffer);
}

// ---------------------------------------------------------------- small vectors

function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function unit(a) { const n = Math.hypot(...a); return [a[0] / n, a[1] / n, a[2] / n]; }
function mix(a, b, t) { return a.map((x, i) => x + t * (b[i] - x)); }

function multiply(a, b) {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

function rows([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

// ---------------------------------------------------------------- motions and poses

const MOTIONS = DATA.motions.map((motion) => ({
  ...motion,
  place: parents.map((_, joint) => motion.turning.indexOf(joint)), // -1: never turns
  quaternions: decode(motion.quaternions, Int16Array),
  still: decode(motion.still, Int16Array),
  root: decode(motion.root, Float32Array),
  contacts: decode(motion.contacts, Uint8Array),
  seconds: (motion.frames - 1) / motion.fps,
}));

/** The pose at a time: world joint positions and rotation rows, and contacts. Holds the end. */
function poseAt(motion, time) {
  const at = Math.min(Math.max(time * motion.fps, 0), motion.frames - 1);
  const first = Math.floor(at), second = Math.min(first + 1, motion.frames - 1), t = at - first;
  const point = (frame) => motion.root.subarray(3 * frame, 3 * frame + 3);
  const positions = [mix([...point(first)], point(second), t)];
  const turns = [], matrices = [], stored = motion.turning.length;
  for (let joint = 0; joint < K; joint++) {
    const place = motion.place[joint];
    const local = place < 0 ? between(motion.still, 4 * joint, 4 * joint, 0) : between(
      motion.quaternions, 4 * (first * stored + place), 4 * (second * stored + place), t);
    const above = parents[joint];
    if (above >= 0) {
      const m = matrices[above], o = offsets[joint], p = positions[above];
      positions[joint] = [0, 1, 2].map((i) => p[i] + dot(m[i], o));
    }
    turns[joint] = above < 0 ? local : multiply(turns[above], local);
    matrices[joint] = rows(turns[joint]);
  }
  const contacts = [0, 1].map((side) => (motion.contacts[2 * first + side] > 127 ? 1 : 0));
  return { positions, matrices, contacts };
}

/** Normalised mix of two stored quaternions, the short way round. */
function between(q, a, b, t) {
  let same = 0;
  for (let i = 0; i < 4; i++) same += q[a + i] * q[b + i];
  const sign = same < 0 ? -t : t, out = [0, 0, 0, 0];
  for (let i = 0; i < 4; i++) out[i] = (1 - t) * q[a + i] + sign * q[b + i];
  const n = Math.hypot(...out) || 1;
  return out.map((x) => x / n);
}

/** Skinning matrices as three rows of four for each joint: rest space to world. */
function bonesOf(pose) {
  const bones = new Float32Array(12 * K);
  for (let joint = 0; joint < K; joint++) {
    for (let i = 0; i < 3; i++) {
      const row = pose.matrices[joint][i];
      bones.set(row, 12 * joint + 4 * i);
      bones[12 * joint + 4 * i + 3] = pose.positions[joint][i] - dot(row, rest[joint]);
    }
  }
  return bones;
}

// ---------------------------------------------------------------- camera

/** A perspective view of `target`: the matrix for WebGL and `project` for 2D drawing. */
function makeView(yaw, pitch, distance, target, width, height) {
  const ahead = [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
  const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
  const up = [
    ahead[1] * right[2] - ahead[2] * right[1],
    ahead[2] * right[0] - ahead[0] * right[2],
    ahead[0] * right[1] - ahead[1] * right[0],
  ];
  const eye = target.map((x, i) => x + distance * ahead[i]);
  const focal = 1 / Math.tan(FIELD_OF_VIEW / 2), aspect = width / height;
  const [tx, ty, tz] = [right, up, ahead].map((axis) => -dot(axis, eye));
  const a = (FAR + NEAR) / (NEAR - FAR), b = (2 * FAR * NEAR) / (NEAR - FAR);
  const matrix = new Float32Array(16);
  for (let i = 0; i < 3; i++) {
    matrix.set([(focal / aspect) * right[i], focal * up[i], a * ahead[i], -ahead[i]], 4 * i);
  }
  matrix.set([(focal / aspect) * tx, focal * ty, a * tz + b, -tz], 12);
  const half = (focal * height) / 2;
  const project = (p) => {
    const depth = -(dot(ahead, p) + tz);
    const scale = half / Math.max(depth, NEAR); // pixels a metre
    return [width / 2 + scale * (dot(right, p) + tx), height / 2 - scale * (dot(up, p) + ty),
      depth, scale];
  };
  return { matrix, project, eye, ahead, target, width, height };
}

// ---------------------------------------------------------------- floor, in 2D

/** Add a line between two points, as far as it lies before the camera. */
function addLine(context, view, p, q) {
  let a = view.project(p), b = view.project(q);
  if (a[2] < NEAR && b[2] < NEAR) return;
  if (a[2] < NEAR) a = view.project(mix(q, p, (b[2] - NEAR) / (b[2] - a[2])));
  if (b[2] < NEAR) b = view.project(mix(p, q, (a[2] - NEAR) / (a[2] - b[2])));
  context.moveTo(a[0], a[1]);
  context.lineTo(b[0], b[1]);
}

/** A grid of half metres that fades with distance; whole metres are stronger. */
function drawFloor(context, view, pixel) {
  const sky = context.createLinearGradient(0, 0, 0, view.height);
  sky.addColorStop(0, "#fbfcfd");
  sky.addColorStop(1, "#e9ecf1");
  context.fillStyle = sky;
  context.fillRect(0, 0, view.width, view.height);
  const [cx, cz] = [Math.round(view.target[0]), Math.round(view.target[2])];
  const reach = 8, levels = 6;
  for (const whole of [false, true]) {
    const bins = Array.from({ length: levels }, () => []);
    for (let line = -reach + (whole ? 0 : 0.5); line <= reach; line++) {
      for (let step = -reach; step < reach; step++) {
        const far = Math.hypot(line, step + 0.5) / reach;
        if (far >= 1) continue;
        const bin = bins[Math.floor((1 - far) * levels)];
        bin.push([[cx + line, 0, cz + step], [cx + line, 0, cz + step + 1]]);
        bin.push([[cx + step, 0, cz + line], [cx + step + 1, 0, cz + line]]);
      }
    }
    context.lineWidth = (whole ? 1.2 : 0.7) * pixel;
    bins.forEach((segments, level) => {
      context.strokeStyle = `rgba(120, 130, 148, ${((whole ? 0.55 : 0.35) * (level + 1)) / levels})`;
      context.beginPath();
      for (const [p, q] of segments) addLine(context, view, p, q);
      context.stroke();
    });
  }
}

/** A round stage on the floor, with a mark towards the audience. */
function drawStage(context, view, [x, , z], radius, pixel) {
  const at = (angle, r) => [x + r * Math.sin(angle), 0, z + r * Math.cos(angle)];
  const steps = 72;
  context.beginPath();
  for (let i = 0; i < steps; i++) {
    const [px, py] = view.project(at((2 * Math.PI * i) / steps, radius));
    context.lineTo(px, py);
  }
  context.closePath();
  context.fillStyle = "rgba(255, 255, 255, 0.6)";
  context.fill();
  context.lineWidth = 1.5 * pixel;
  context.strokeStyle = "#b9c0cb";
  context.stroke();
  context.beginPath();
  for (const [angle, r] of [[-0.05, 1.03], [0, 1.12], [0.05, 1.03]]) {
    const [px, py] = view.project(at(angle, r * radius));
    context.lineTo(px, py);
  }
  context.fillStyle = "#8b93a0";
  context.fill();
}

const STAGE_TAIL = 2; // seconds of path that are drawn on a stage
const TAIL = 10; // seconds of path that are drawn strongly and in full
const OUTLINE = 1500; // points of the pale path, however long it is

/** The pelvis path on the floor: pale as a whole, the last seconds strong. */
function drawTrail(context, view, motion, time, pixel) {
  const { frames, fps } = motion;
  const now = Math.min(time * fps, frames - 1);
  context.lineJoin = context.lineCap = "round";
  context.lineWidth = 2.5 * pixel;
  context.strokeStyle = "rgba(200, 60, 90, 0.25)";
  context.beginPath();
  const stride = Math.max(1, Math.floor(frames / OUTLINE));
  if (!motion.figures) addPath(context, view, motion, 0, frames - 1, stride);
  context.stroke();
  const tail = motion.figures ? STAGE_TAIL : TAIL;
  const start = Math.max(0, Math.floor(now - tail * fps));
  if (motion.phase) return drawBeatTrail(context, view, motion, start, now, pixel);
  context.strokeStyle = "#c83c5a";
  context.beginPath();
  addPath(context, view, motion, start, now, 1);
  context.stroke();
}

/** Add the path on the floor from one frame to another, in strides of some frames. */
function addPath(context, view, motion, first, last, stride) {
  for (let frame = first; frame < last; frame += stride) {
    addLine(context, view, floorAt(motion, frame), floorAt(motion, Math.min(frame + stride, last)));
  }
}

/** The point of the floor under the pelvis at a frame, whole or not. */
function floorAt({ root, frames }, frame) {
  const at = Math.min(Math.max(frame, 0), frames - 1), i = Math.floor(at);
  const j = Math.min(i + 1, frames - 1), t = at - i;
  const along = (axis) => root[3 * i + axis] + t * (root[3 * j + axis] - root[3 * i + axis]);
  return [along(0), 0, along(2)];
}
