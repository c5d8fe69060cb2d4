// Any BVH skeleton whose joints a profile knows onto ours (src/shared/data/retarget): each joint
// keeps its world direction and its twist.
//
// A clip is { names, parents, offsets, frames, fps, rotation(t, joint), translation(t, joint) }.

import {
  add, apply, continuous, cross, dot, matrixOf, multiply, norm, quaternionOf, scale, slerp, sub, transposed, unit,
} from "../body/rotations.js";
import { percentile } from "../body/curves.js";
import { FEET, FPS, INDEX, JOINTS, LEG_LENGTH, pose, REST_FOOT_HEIGHT, SKELETON } from "../body/skeleton.js";

const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1], STANDING = 0.7, PELVIS = [0.45, 0.8], SAMPLES = 200, MAX_FRAMES = 18000;
const FIRST = "Bring it onto our skeleton first: motion-tools convert CLIP a.npz, then a.npz a.bvh.";
const NEAR_RATE = 0.01, SAME_RATE = 1e-3, ROUNDED = 2e-5, SAME_BONES = 1e-4, CALIBRATION_JUMP = 0.15, SHORT_LEGS = 1.2;
const AIM = {
  spine1: "spine2", neck: "head", l_collar: "l_shoulder", r_collar: "r_shoulder", l_shoulder: "l_elbow",
  r_shoulder: "r_elbow", l_elbow: "l_wrist", r_elbow: "r_wrist", l_hip: "l_knee", r_hip: "r_knee",
  l_knee: "l_ankle", r_knee: "r_ankle", l_ankle: "l_foot", r_ankle: "r_foot",
};
const CARRIED = { l_wrist: "l_elbow", r_wrist: "r_elbow" };
const TOUCH = {
  l_foot: 0.02, r_foot: 0.02, l_knee: 0.04, r_knee: 0.04, pelvis: 0.08, spine3: 0.1, head: 0.08,
  l_elbow: 0.03, r_elbow: 0.03, l_wrist: 0.02, r_wrist: 0.02,
};
const OPTIONAL = ["spine1", "spine2", "spine3", "neck", "l_collar", "r_collar", "l_foot", "r_foot"];

/** A motion on our skeleton at our rate. Throws where no profile fits. */
export function retarget(clip, profiles) {
  const { joints, axes } = mappingOf(clip.names, profiles);
  const stride = Math.max(1, Math.round(clip.fps / FPS));
  if (stride > 1 && Math.abs(clip.fps / stride - FPS) < NEAR_RATE * FPS) clip = everyNth(clip, stride);
  if ((clip.frames / clip.fps) * FPS > MAX_FRAMES) throw new Error("The clip is longer than ten minutes; split it.");
  if (clip.frames < 2) throw new Error("The clip has one frame only.");
  const rest = restFrame(clip, joints);
  if (!rest && !Object.keys(axes).length)
    throw new Error(`Its rest pose is no standing body. ${FIRST}`);
  const ours = isOurs(clip, joints), legs = legLength(clip, joints);
  if (!(legs > 1e-6)) throw new Error("Its legs have no length.");
  const turn = ours ? IDENTITY : upright(clip.up ?? detectUp(clip, joints, rest));
  const size = ours ? norm(SKELETON.offsets[INDEX.l_knee]) / norm(clip.offsets[joints.l_knee]) : LEG_LENGTH / legs;
  let motion = carriedOver(clip, joints, corrections(clip, joints, axes, rest), turn, size);
  if (![...motion.quaternions, ...motion.root].every(Number.isFinite)) throw new Error("It holds numbers that are none.");
  if (!ours && shortLegs(clip, joints, legs)) {
    lowest(motion).forEach((height, t) => { motion.root[t * 3 + 1] -= height; });
  }
  if (!ours) motion = withoutCalibration(motion);
  return onFloor(resampled(motion), !ours);
}

// ---------------------------------------------------------------- which joint is which

const plain = (name) => name.replace(/^.*[:|]/, "").replace(/^mixamorig\d*/i, "").replace(/[^\p{L}\p{N}]/gu, "").toLowerCase();

/** Our joint -> index in the file, and axes by our joint, of the profile that fits best. */
export function mappingOf(names, profiles, remedy = FIRST) {
  const spelled = new Map(), heads = new Map();
  for (const name of names) {
    const head = /^[^ _.\-]+[ _.\-]/.exec(name)?.[0];
    if (head) heads.set(head, (heads.get(head) ?? 0) + 1);
  }
  const [prefix, count] = [...heads].sort((a, b) => b[1] - a[1])[0] ?? ["", 0];
  names.forEach((name, index) => {
    const put = (word) => { if (!spelled.has(word)) spelled.set(word, index); };
    put(plain(name));
    if (count >= 0.8 * names.length && name.startsWith(prefix)) put(plain(name.slice(prefix.length)));
  });
  const found = profiles.map((profile) => {
    const joints = {}, axes = {};
    for (const [ours, theirs] of Object.entries(profile.joints)) {
      const exact = names.indexOf(theirs), index = exact >= 0 ? exact : spelled.get(plain(theirs));
      if (index === undefined) continue;
      joints[ours] = index;
      if (profile.axes[theirs]) axes[ours] = profile.axes[theirs];
    }
    return { joints, axes, whole: Object.keys(joints).length === Object.keys(profile.joints).length, size: Object.keys(profile.joints).length };
  });
  const whole = found.find((each) => each.whole);
  if (whole) return whole;
  const required = ({ joints }) => SKELETON.names.filter((name) => !OPTIONAL.includes(name) && name in joints).length;
  const all = SKELETON.names.length - OPTIONAL.length;
  const [best] = [...found].sort((a, b) => required(b) - required(a) || Object.keys(b.joints).length - Object.keys(a.joints).length || a.size - b.size);
  if (required(best) < all)
    throw new Error(`Its joints have names the studio does not know. ${remedy}`);
  return best;
}

// ---------------------------------------------------------------- at rest

export function lineOf(clip, joint, descendant) {
  const line = [];
  while (descendant !== joint && descendant >= 0) { line.push(descendant); descendant = clip.parents[descendant]; }
  return descendant === joint ? line : [];
}
const boneOf = (clip, joint, descendant) => lineOf(clip, joint, descendant).reduce((sum, at) => add(sum, clip.offsets[at]), [0, 0, 0]);

export function legLength(clip, joints) {
  const parts = ["l", "r"].map((s) => norm(boneOf(clip, joints[`${s}_hip`], joints[`${s}_knee`])) + norm(boneOf(clip, joints[`${s}_knee`], joints[`${s}_ankle`])));
  return (parts[0] + parts[1]) / 2;
}

/** A cartoon's proportions: hardly any legs for its trunk. */
function shortLegs(clip, joints, legs) {
  const trunk = lineOf(clip, joints.pelvis, joints.head).reduce((sum, joint) => sum + norm(clip.offsets[joint]), 0);
  return trunk > SHORT_LEGS * legs;
}

function isOurs(clip, joints) {
  if (Object.keys(joints).length < JOINTS) return false;
  const factor = norm(SKELETON.offsets[INDEX.l_knee]) / Math.max(norm(clip.offsets[joints.l_knee]), 1e-12);
  return SKELETON.names.every((name, k) => k === 0 || (
    clip.parents[joints[name]] === joints[SKELETON.names[SKELETON.parents[k]]]
    && clip.offsets[joints[name]].every((x, i) => Math.abs(x * factor - SKELETON.offsets[k][i]) < SAME_BONES)));
}

/** Rows left, up, forward of a body that stands in the rest pose; null where none does. */
export function restFrame(clip, joints) {
  const rest = [];
  clip.parents.forEach((parent, joint) => rest.push(parent < 0 ? clip.offsets[joint] : add(rest[parent], clip.offsets[joint])));
  const at = (name) => rest[joints[name]];
  const left = add(sub(at("l_hip"), at("r_hip")), sub(at("l_shoulder"), at("r_shoulder")));
  const forUp = [sub(at("head"), at("pelvis"))];
  for (const s of "lr") forUp.push(sub(at(`${s}_hip`), at(`${s}_knee`)), sub(at(`${s}_knee`), at(`${s}_ankle`)));
  if ([left, ...forUp].some((v) => norm(v) < 1e-9)) return null;
  const up = forUp.reduce((sum, v) => add(sum, scale(unit(v), 1 / forUp.length)), [0, 0, 0]), axes = [];
  for (const vector of [unit(left), up]) {
    const sizes = vector.map(Math.abs), best = sizes.indexOf(Math.max(...sizes));
    if (sizes[best] < STANDING) return null;
    axes.push([0, 1, 2].map((i) => (i === best ? Math.sign(vector[best]) : 0)));
  }
  if (forUp.some((v) => dot(v, axes[1]) < 0.5 * norm(v)) || dot(axes[0], axes[1])) return null;
  return [...axes[0], ...axes[1], ...cross(axes[0], axes[1])];
}

/** world(ours) = world(source) x correction, by our joint. */
export function corrections(clip, joints, axes, rest) {
  const turns = {}, found = {};
  for (const ours of SKELETON.names) {
    if (!(ours in joints)) continue;
    const own = rest ?? axes[ours] ?? IDENTITY, child = AIM[ours];
    let turn = IDENTITY;
    if (child in joints) {
      const bone = apply(own, boneOf(clip, joints[ours], joints[child]));
      if (norm(bone) > 1e-6) turn = aligned(bone, SKELETON.offsets[INDEX[child]]);
    } else if (ours in CARRIED) turn = turns[CARRIED[ours]] ?? turn;
    turns[ours] = turn;
    found[ours] = transposed(multiply(turn, own));
  }
  return found;
}

/** Smallest rotation that turns one direction into another. */
function aligned(start, end) {
  const a = unit(start), b = unit(end), v = cross(a, b), c = dot(a, b);
  if (c < -0.999999) {
    const sizes = a.map(Math.abs), across = [0, 0, 0];
    across[sizes.indexOf(Math.min(...sizes))] = 1;
    const axis = unit(cross(a, across));
    return matrixOf([0, ...axis]);
  }
  const k = [0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0], kk = multiply(k, k);
  return IDENTITY.map((x, i) => x + k[i] + kk[i] / (1 + c));
}

// ---------------------------------------------------------------- in motion

const everyNth = (clip, stride) => ({
  ...clip,
  frames: Math.ceil(clip.frames / stride),
  fps: clip.fps / stride,
  rotation: (t, joint) => clip.rotation(t * stride, joint),
  translation: (t, joint) => clip.translation(t * stride, joint),
});

function worldOf(clip, t) {
  const positions = [], rotations = [];
  clip.parents.forEach((parent, joint) => {
    const place = clip.translation(t, joint), turn = clip.rotation(t, joint);
    positions.push(parent < 0 ? place : add(positions[parent], apply(rotations[parent], place)));
    rotations.push(parent < 0 ? turn : multiply(rotations[parent], turn));
  });
  return { positions, rotations };
}

const AXES = { X: [1, 0, 0], Y: [0, 1, 0], Z: [0, 0, 1], "-X": [-1, 0, 0], "-Y": [0, -1, 0], "-Z": [0, 0, -1] };
function nearestAxis(direction) {
  const sizes = direction.map(Math.abs), best = sizes.indexOf(Math.max(...sizes));
  return (direction[best] > 0 ? "" : "-") + "XYZ"[best];
}

/** The axis along which the head is above the ankles, or that of the rest pose. */
function detectUp(clip, joints, rest) {
  const stride = Math.max(1, Math.floor(clip.frames / SAMPLES)), lengths = [], places = [];
  let mean = [0, 0, 0], number = 0;
  for (let t = 0; t < clip.frames; t += stride, number++) {
    const { positions } = worldOf(clip, t);
    const body = sub(positions[joints.head], scale(add(positions[joints.l_ankle], positions[joints.r_ankle]), 0.5));
    lengths.push(norm(body));
    places.push(positions[joints.pelvis]);
    mean = add(mean, scale(body, 1 / Math.max(norm(body), 1e-9)));
  }
  mean = scale(mean, 1 / number);
  let stands = Math.max(...mean.map(Math.abs)) > STANDING ? nearestAxis(mean) : null;
  const rests = rest && nearestAxis(rest.slice(3, 6));
  if (stands && rests && rests !== stands) {
    const height = percentile(places.map((place) => dot(place, AXES[stands])), 50) / percentile(lengths, 50);
    if (!(height > PELVIS[0] && height < PELVIS[1])) stands = null;
  }
  return stands ?? rests ?? "Y";
}

function upright(axis) {
  if (axis === "Y") return IDENTITY;
  if (axis === "-Y") return [1, 0, 0, 0, -1, 0, 0, 0, -1];
  return aligned(AXES[axis], AXES.Y);
}

function carriedOver(clip, joints, turned, turn, size) {
  const { names, parents } = SKELETON, quaternions = new Float32Array(clip.frames * JOINTS * 4), root = new Float32Array(clip.frames * 3);
  const hips = scale(add(SKELETON.offsets[INDEX.l_hip], SKELETON.offsets[INDEX.r_hip]), 0.5);
  const children = names.map((_, joint) => names.map((_, c) => c).filter((c) => parents[c] === joint));
  for (let t = 0; t < clip.frames; t++) {
    const { positions, rotations } = worldOf(clip, t);
    const world = names.map((name) => (name in joints ? multiply(turn, multiply(rotations[joints[name]], turned[name])) : null));
    names.forEach((_, joint) => {
      if (world[joint]) return;
      const [child] = children[joint], above = world[parents[joint]];
      const between = children[joint].length === 1 && world[child];
      world[joint] = between ? matrixOf(slerp(quaternionOf(above), quaternionOf(world[child]), 0.5)) : above;
    });
    const middle = apply(turn, scale(add(positions[joints.l_hip], positions[joints.r_hip]), 0.5));
    root.set(sub(scale(middle, size), apply(world[0], hips)), t * 3);
    names.forEach((_, joint) => {
      const local = joint ? multiply(transposed(world[parents[joint]]), world[joint]) : world[0];
      quaternions.set(quaternionOf(local), (t * JOINTS + joint) * 4);
    });
  }
  continuous(quaternions, JOINTS * 4);
  return { frames: clip.frames, quaternions, root, contacts: new Float32Array(clip.frames * 2), fps: clip.fps, text: "" };
}

/** Without a first frame that jumps: many files begin with one of T-pose. */
function withoutCalibration(motion) {
  if (motion.frames < 3) return motion;
  const [first, second] = [0, 1].map((t) => {
    let sum = 0;
    for (let joint = 0; joint < JOINTS; joint++) {
      const [p, q] = [(t * JOINTS + joint) * 4, ((t + 1) * JOINTS + joint) * 4];
      let along = 0;
      for (let i = 0; i < 4; i++) along += motion.quaternions[p + i] * motion.quaternions[q + i];
      sum += 2 * Math.acos(Math.min(Math.abs(along), 1));
    }
    return sum / JOINTS;
  });
  if (first < CALIBRATION_JUMP || first < 5 * second) return motion;
  return { ...motion, frames: motion.frames - 1, quaternions: motion.quaternions.slice(JOINTS * 4), root: motion.root.slice(3), contacts: motion.contacts.slice(2) };
}

function resampled(motion) {
  if (Math.abs(FPS / motion.fps - 1) < SAME_RATE) return { ...motion, fps: FPS };
  const last = motion.frames - 1, steps = (last / motion.fps) * FPS; // but for how many digits a file gives its frame time
  const frames = Math.floor(steps + Math.min(ROUNDED * steps, 0.5) + 1e-6) + 1;
  const quaternions = new Float32Array(frames * JOINTS * 4), root = new Float32Array(frames * 3);
  for (let t = 0; t < frames; t++) {
    const at = Math.min((t * motion.fps) / FPS, last), first = Math.min(Math.floor(at), last - 1), share = at - first;
    for (let joint = 0; joint < JOINTS; joint++) {
      const [p, q] = [(first * JOINTS + joint) * 4, ((first + 1) * JOINTS + joint) * 4];
      quaternions.set(slerp(Array.from(motion.quaternions.subarray(p, p + 4)), Array.from(motion.quaternions.subarray(q, q + 4)), share), (t * JOINTS + joint) * 4);
    }
    for (let i = 0; i < 3; i++) root[t * 3 + i] = motion.root[first * 3 + i] + share * (motion.root[first * 3 + 3 + i] - motion.root[first * 3 + i]);
  }
  return { ...motion, frames, quaternions: continuous(quaternions, JOINTS * 4), root, contacts: new Float32Array(frames * 2), fps: FPS };
}

/** Height of the lowest part of the body in each frame. */
function lowest(motion) {
  return Array.from({ length: motion.frames }, (_, t) => {
    const { positions } = pose(motion, t);
    return Math.min(...Object.entries(TOUCH).map(([name, height]) => positions[INDEX[name]][1] - height));
  });
}

/** The floor put under the body, if asked to, and the contacts found. */
function onFloor(motion, lift) {
  const joints = Array.from({ length: motion.frames }, (_, t) => pose(motion, t).positions);
  const height = lift ? -percentile(lowest(motion), 2) : 0, root = motion.root.slice(), contacts = new Float32Array(motion.frames * 2);
  for (let t = 0; t < motion.frames; t++) root[t * 3 + 1] += height;
  FEET.forEach(({ ball }, side) => {
    const touches = joints.map((places, t) => {
      const u = Math.max(Math.min(t, motion.frames - 2), 0), speed = norm(sub(joints[u + 1][ball], joints[u][ball])) * motion.fps;
      return Number(places[ball][1] + height < REST_FOOT_HEIGHT + 0.06 && speed < 0.35);
    });
    touches.forEach((touch, t) => { contacts[t * 2 + side] = Number((touches[t - 1] ?? touch) + touch + (touches[t + 1] ?? touch) >= 2); });
  });
  return { ...motion, root, contacts };
}
