// A clip in: BVH or GLB on our own skeleton, as the studio and `motion-tools` write them.

import { continuous, matrixOf, multiply, norm, quaternionOf, slerp, sub } from "../body/rotations.js";
import { FEET, FPS, JOINTS, pose, REST_FOOT_HEIGHT, SKELETON } from "../body/skeleton.js";
import { readGlb } from "./glb.js";

const MAX_FRAMES = 18000, OTHER = "This skeleton is not the studio's. Bring it onto ours first: motion-tools convert CLIP clip.bvh --canonical";

export function readClip(name, bytes) {
  if (/\.glb$/i.test(name)) return fromGlb(bytes);
  if (/\.bvh$/i.test(name)) return fromBvh(new TextDecoder().decode(bytes));
  throw new Error("Only .bvh and .glb can be opened.");
}

/** Rotations and path keyed frame by frame -> a motion at our rate. */
function motionOf(frames, fps, rotationAt, rootAt) {
  if (frames < 2 || frames > MAX_FRAMES) throw new Error(`The clip has ${frames} frames; 2 to ${MAX_FRAMES} can be used.`);
  if (Math.abs(fps / FPS - 1) < 1e-3) fps = FPS; // files say 0.033333 s for 30 a second
  const number = Math.floor(((frames - 1) / fps) * FPS + 1e-6) + 1;
  const quaternions = new Float32Array(number * JOINTS * 4), root = new Float32Array(number * 3);
  for (let t = 0; t < number; t++) {
    const at = (t / FPS) * fps, first = Math.min(Math.floor(at + 1e-9), frames - 2), share = Math.min(at - first, 1);
    for (let joint = 0; joint < JOINTS; joint++) {
      const a = rotationAt(first, joint);
      quaternions.set(share < 1e-6 ? a : slerp(a, rotationAt(first + 1, joint), share), (t * JOINTS + joint) * 4);
    }
    const [a, b] = [rootAt(first), rootAt(first + 1)];
    root.set(a.map((x, i) => x + share * (b[i] - x)), t * 3);
  }
  if (![...quaternions, ...root].every(Number.isFinite)) throw new Error("The clip holds numbers that are none.");
  const motion = { frames: number, quaternions: continuous(quaternions, JOINTS * 4), root, contacts: new Float32Array(number * 2), fps: FPS, text: "" };
  return { ...motion, contacts: contactsOf(motion) };
}

/** Feet that are low and slow (src/shared/motion/postprocess/contacts.py, detect_contacts). */
function contactsOf(motion) {
  const { frames, fps } = motion, poses = Array.from({ length: frames }, (_, t) => pose(motion, t).positions);
  const contacts = new Float32Array(frames * 2);
  FEET.forEach(({ ball }, side) => {
    const touches = poses.map((positions, t) => {
      const u = Math.min(t, frames - 2), speed = norm(sub(poses[u + 1][ball], poses[u][ball])) * fps;
      return Number(positions[ball][1] < REST_FOOT_HEIGHT + 0.06 && speed < 0.35);
    });
    touches.forEach((touch, t) => {
      const votes = (touches[t - 1] ?? touch) + touch + (touches[t + 1] ?? touch);
      contacts[t * 2 + side] = Number(votes >= 2);
    });
  });
  return contacts;
}

/** Whether joints with these names and rest offsets (any unit) are ours. */
function checkSkeleton(joints) {
  const byName = new Map(joints.map((joint) => [joint.name, joint]));
  const ours = SKELETON.names.map((name) => byName.get(name));
  if (ours.some((joint) => !joint)) throw new Error(OTHER);
  const length = (parts) => parts.slice(1).reduce((sum, offset) => sum + norm(offset), 0);
  const unit = length(ours.map(({ offset }) => offset)) / length(SKELETON.offsets);
  const fits = ours.every(({ offset, parent }, joint) =>
    joint === 0 || (parent === SKELETON.names[SKELETON.parents[joint]] && norm(sub(offset.map((x) => x / unit), SKELETON.offsets[joint])) < 0.01));
  if (!fits) throw new Error(OTHER);
  return { ours, unit };
}

function fromBvh(text) {
  const tokens = text.split(/\s+/u).filter(Boolean), joints = [], stack = [];
  let at = 0, columns = 0, skip = 0;
  for (; at < tokens.length && tokens[at] !== "MOTION"; at++) {
    const token = tokens[at].toUpperCase();
    if (token === "ROOT" || token === "JOINT") {
      const joint = { name: tokens[++at], parent: stack[stack.length - 1]?.name ?? null, offset: [0, 0, 0], channels: [], column: 0 };
      joints.push(joint);
      stack.push(joint);
    } else if (token === "END") { skip = 1; stack.push({ name: "" }); }
    else if (token === "OFFSET" && !skip) stack[stack.length - 1].offset = [1, 2, 3].map((i) => Number(tokens[at + i]));
    else if (token === "CHANNELS") {
      const joint = stack[stack.length - 1], number = Number(tokens[at + 1]);
      if (!(number >= 0 && number <= 6)) throw new Error("This BVH file is damaged.");
      Object.assign(joint, { channels: tokens.slice(at + 2, at + 2 + number).map((name) => name.toUpperCase()), column: columns });
      columns += number;
    } else if (token === "}") { stack.pop(); skip = 0; }
  }
  const frames = Number(tokens[at + 2]), fps = 1 / Number(tokens[at + 5]);
  if (tokens[at] !== "MOTION" || !(frames > 0) || !(fps > 0 && fps <= 1000)) throw new Error("This is no whole BVH file.");
  if (tokens.length - (at + 6) < frames * columns) throw new Error("This BVH file ends too soon.");
  const numbers = Float64Array.from(tokens.slice(at + 6, at + 6 + frames * columns), Number);
  const { ours, unit } = checkSkeleton(joints);
  const rotationAt = (t, index) => {
    const { channels, column } = ours[index];
    let matrix = [1, 0, 0, 0, 1, 0, 0, 0, 1];
    channels.forEach((name, i) => {
      const axis = { XROTATION: [1, 0, 0], YROTATION: [0, 1, 0], ZROTATION: [0, 0, 1] }[name];
      const half = (numbers[t * columns + column + i] * Math.PI) / 360;
      if (axis) matrix = multiply(matrix, matrixOf([Math.cos(half), ...axis.map((x) => x * Math.sin(half))]));
    });
    return quaternionOf(matrix);
  };
  const rootAt = (t) => ["X", "Y", "Z"].map((axis) => {
    const i = ours[0].channels.indexOf(`${axis}POSITION`);
    return i < 0 ? 0 : numbers[t * columns + ours[0].column + i] / unit;
  });
  return motionOf(frames, fps, rotationAt, rootAt);
}

function fromGlb(bytes) {
  const { document, data } = readGlb(bytes), { nodes = [], animations = [] } = document;
  const parentOf = new Map(nodes.flatMap((node, index) => (node.children ?? []).map((child) => [child, index])));
  const joints = nodes.map((node, index) => ({ name: node.name, parent: nodes[parentOf.get(index)]?.name ?? null, offset: node.translation ?? [0, 0, 0], index, node }));
  const { ours, unit } = checkSkeleton(joints), [animation] = animations;
  if (!animation) throw new Error("There is no animation in this file.");
  const floats = (index) => {
    const { bufferView, byteOffset = 0, count, type, componentType } = document.accessors[index];
    const width = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type], view = document.bufferViews[bufferView];
    if (componentType !== 5126 || !width || (view.byteStride ?? width * 4) !== width * 4) throw new Error("This animation is stored in a way the studio does not read.");
    const start = (view.byteOffset ?? 0) + byteOffset;
    return new Float32Array(data.slice(start, start + count * width * 4).buffer);
  };
  const tracks = new Map(animation.channels.map(({ sampler, target }) => {
    const { input, output, interpolation = "LINEAR" } = animation.samplers[sampler];
    if (interpolation === "CUBICSPLINE") throw new Error("This animation is stored in a way the studio does not read.");
    return [`${target.node} ${target.path}`, { times: floats(input), values: floats(output) }];
  }));
  const last = Math.max(...[...tracks.values()].map(({ times }) => times[times.length - 1]));
  const frames = Math.round(last * FPS) + 1;
  const keysAt = ({ times }, time) => {
    let i = 0;
    while (i + 1 < times.length && times[i + 1] <= time + 1e-6) i++;
    const next = Math.min(i + 1, times.length - 1);
    return [i, next, next === i ? 0 : Math.min(Math.max((time - times[i]) / (times[next] - times[i]), 0), 1)];
  };
  const rotationAt = (t, joint) => {
    const track = tracks.get(`${ours[joint].index} rotation`);
    const [x, y, z, w] = ours[joint].node.rotation ?? [0, 0, 0, 1];
    if (!track) return [w, x, y, z];
    const [i, next, share] = keysAt(track, t / FPS);
    const key = (k) => { const [x, y, z, w] = track.values.subarray(k * 4, k * 4 + 4); return [w, x, y, z]; };
    return share < 1e-6 ? key(i) : slerp(key(i), key(next), share);
  };
  const rootAt = (t) => {
    const track = tracks.get(`${ours[0].index} translation`);
    if (!track) return ours[0].offset.map((x) => x / unit);
    const [i, next, share] = keysAt(track, t / FPS);
    return [0, 1, 2].map((k) => (track.values[i * 3 + k] + share * (track.values[next * 3 + k] - track.values[i * 3 + k])) / unit);
  };
  return motionOf(frames, FPS, rotationAt, rootAt);
}
