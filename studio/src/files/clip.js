// A clip in: BVH, GLB or VRMA, on our skeleton or on one that a profile knows.

import { percentile } from "../body/curves.js";
import { apply, matrixOf, multiply, norm, quaternionOf, slerp, transposed, unit } from "../body/rotations.js";
import { FPS } from "../body/skeleton.js";
import { readGlb } from "./glb.js";
import { retarget } from "./retarget.js";

const MAX_JOINTS = 1000, MAX_NODES = 10000, MAX_VALUE = 1e7, MAX_RATE = 2000, MAX_FRAMES = 1e6, EVEN = 1e-3, IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];
const READ = "This animation is stored in a way the studio does not read.";

/** A motion of a file. @param {object[]} profiles names of joints, see configs/skeletons.yaml */
export function readClip(name, bytes, profiles) {
  return orDamaged(() => {
    if (/\.(glb|vrma|vrm)$/i.test(name)) return retarget(glbClip(bytes), profiles);
    if (/\.bvh$/i.test(name)) return retarget(bvhClip(new TextDecoder().decode(bytes)), profiles);
    throw new Error("Only .bvh, .glb, .vrma and .vrm can be opened.");
  });
}

/** What is read; what a missing or foreign entry leads to is told as one sentence. */
export function orDamaged(read) {
  try {
    return read();
  } catch (error) {
    throw error.constructor === Error ? error : new Error("This file is damaged; export it again.");
  }
}

function bvhClip(text) {
  const tokens = text.split(/\s+/u).filter(Boolean), joints = [], stack = [];
  let at = 0, columns = 0, tip = false;
  for (; at < tokens.length && tokens[at].toUpperCase() !== "MOTION"; at++) {
    const token = tokens[at].toUpperCase(), joint = stack[stack.length - 1];
    if (token === "ROOT" || token === "JOINT") {
      joints.push({ name: tokens[++at], parent: joint ? joints.indexOf(joint) : -1, offset: [0, 0, 0], channels: [], column: 0 });
      stack.push(joints[joints.length - 1]);
    } else if (token === "END") { tip = true; stack.push(null); }
    else if (token === "OFFSET" && joint && !tip) joint.offset = [1, 2, 3].map((i) => Number(tokens[at + i]));
    else if (token === "CHANNELS" && joint) {
      const number = Number(tokens[at + 1]);
      if (!(number >= 0 && number <= 6)) throw new Error("This BVH file is damaged.");
      Object.assign(joint, { channels: tokens.slice(at + 2, at + 2 + number).map((name) => name.toUpperCase()), column: columns });
      columns += number;
    } else if (token === "}") { stack.pop(); tip = false; }
    if (joints.length > MAX_JOINTS) throw new Error(`This BVH file has more than ${MAX_JOINTS} joints.`);
  }
  const frames = Number(tokens[at + 2]), fps = 1 / Number(tokens[at + 5]), first = at + 6;
  if (at >= tokens.length || !(frames > 0 && Number.isInteger(frames)) || !(fps >= 1 && fps <= MAX_RATE)) throw new Error("This is no whole BVH file.");
  if (tokens.length - first !== frames * columns) throw new Error(`This BVH file says ${frames} frames, but holds ${Math.floor((tokens.length - first) / columns)}; it is cut off or damaged.`);
  const numbers = Float64Array.from(tokens.slice(first), Number);
  if (!numbers.every((value) => Math.abs(value) < MAX_VALUE)) throw new Error("This BVH file holds numbers that are no angle and no place.");
  const rotation = (t, index) => {
    const { channels, column } = joints[index];
    let matrix = IDENTITY;
    channels.forEach((name, i) => {
      const axis = { XROTATION: [1, 0, 0], YROTATION: [0, 1, 0], ZROTATION: [0, 0, 1] }[name];
      const half = (numbers[t * columns + column + i] * Math.PI) / 360;
      if (axis) matrix = multiply(matrix, matrixOf([Math.cos(half), ...axis.map((x) => x * Math.sin(half))]));
    });
    return matrix;
  };
  const translation = (t, index) => {
    const { channels, column, offset } = joints[index];
    return ["X", "Y", "Z"].map((axis, i) => {
      const channel = channels.indexOf(`${axis}POSITION`);
      return channel < 0 ? offset[i] : numbers[t * columns + column + channel];
    });
  };
  return { names: joints.map(({ name }) => name), parents: joints.map(({ parent }) => parent), offsets: joints.map(({ offset }) => offset), frames, fps, rotation, translation };
}

/** The nodes of a file as joints whose axes are the world's at rest, parents first: their nodes, names, parents, offsets, and their own axes and sizes at rest. */
export function treeOf({ nodes: raw = [], extensions = {} }) {
  if (raw.length > MAX_NODES) throw new Error(`This file has more than ${MAX_NODES} nodes.`);
  const nodes = raw.map(posed), above = new Array(nodes.length).fill(-1), order = [];
  nodes.forEach(({ children = [] }, node) => children.forEach((child) => {
    if (above[child] >= 0) throw new Error("This file is damaged, one of its nodes has two parents; export it again.");
    above[child] = node;
  }));
  const visit = (node) => { order.push(node); (nodes[node].children ?? []).forEach(visit); };
  above.forEach((parent, node) => { if (parent < 0) visit(node); });
  const place = new Map(order.map((node, index) => [node, index])), bones = bonesOf(extensions), rest = [], sizes = [];
  const local = (index) => { const [x, y, z, w] = nodes[order[index]].rotation ?? [0, 0, 0, 1]; return matrixOf([w, x, y, z]); };
  const parents = order.map((node) => (above[node] < 0 ? -1 : place.get(above[node])));
  parents.forEach((parent, index) => {
    const [size] = nodes[order[index]].scale ?? [1];
    rest.push(parent < 0 ? local(index) : multiply(rest[parent], local(index)));
    sizes.push((parent < 0 ? 1 : sizes[parent]) * size);
  });
  const frame = (index) => (parents[index] < 0 ? IDENTITY : rest[parents[index]]); // the parent's
  const size = (index) => (parents[index] < 0 ? 1 : sizes[parents[index]]);
  const inWorld = (index, vector) => apply(frame(index), vector).map((x) => x * size(index));
  return {
    nodes, order, parents, rest, bones, local, frame, size, inWorld,
    names: order.map((node) => bones.get(node) ?? nodes[node].name ?? ""),
    offsets: order.map((node, index) => inWorld(index, nodes[node].translation ?? [0, 0, 0])),
  };
}

/** What VRM calls nodes (avatars of 0.x and 1.0, animations). */
function bonesOf({ VRMC_vrm, VRMC_vrm_animation, VRM }) {
  const named = (VRMC_vrm ?? VRMC_vrm_animation)?.humanoid?.humanBones;
  const rows = named ? Object.entries(named).map(([bone, { node }]) => ({ bone, node })) : (VRM?.humanoid?.humanBones ?? []);
  return new Map(rows.map(({ bone, node }) => [node, bone]));
}

/** Sampled at the rate of the densest keys. */
function glbClip(bytes) {
  const { document, data } = readGlb(bytes), { animations = [] } = document;
  if (!animations[0]?.channels.length) throw new Error("There is no animation in this file.");
  const { nodes, order, names, parents, offsets, rest, local, frame, inWorld } = treeOf(document);
  const tracks = tracksOf(document, data, animations[0]);
  const { times, fps } = evenTimes([...tracks.values()].map(({ times }) => times));
  return {
    names,
    parents,
    offsets,
    frames: times.length,
    fps,
    up: "Y", // says glTF
    rotation: (t, index) => {
      const track = tracks.get(`${order[index]} rotation`);
      const turn = track ? matrixOf(keyAt(track, times[t])) : local(index);
      return multiply(multiply(frame(index), turn), transposed(rest[index]));
    },
    translation: (t, index) => {
      const track = tracks.get(`${order[index]} translation`);
      return inWorld(index, track ? keyAt(track, times[t]) : (nodes[order[index]].translation ?? [0, 0, 0]));
    },
  };
}

/** A node whose pose is a matrix, as translation, rotation and scale. */
function posed(node) {
  if (!node.matrix) return node;
  const column = (i) => node.matrix.slice(4 * i, 4 * i + 3), scale = [0, 1, 2].map((i) => norm(column(i)));
  const [w, ...turn] = quaternionOf(transposed([0, 1, 2].flatMap((i) => unit(column(i)))));
  return { ...node, translation: column(3), rotation: [...turn, w], scale };
}

/** Evenly spaced times over all keys, and their rate (src/shared/formats/readers/glb.py). */
function evenTimes(keys) {
  const densest = keys.reduce((one, other) => (other.length > one.length ? other : one));
  const start = Math.min(...keys.map((times) => times[0])), end = Math.max(...keys.map((times) => times[times.length - 1])), last = densest.length - 1;
  if (last < 1) return { times: densest, fps: FPS };
  const steps = Array.from(densest.subarray(1), (time, i) => time - densest[i]), step = (end - start) / last;
  const exact = densest.every((time, i) => Math.abs(time - start - i * step) < EVEN * step);
  let fps = 1 / (exact ? step : percentile(steps, 50));
  const rounded = Math.round(fps * 100) / 100;
  if (Math.abs(fps - rounded) < 1e-4) fps = rounded;
  if (!(fps >= 1 && fps <= MAX_RATE)) throw new Error(`This file moves at ${fps.toFixed(2)} frames a second.`);
  return { times: exact ? densest : Array.from({ length: Math.min(Math.round((end - start) * fps) + 1, MAX_FRAMES) }, (_, t) => start + t / fps), fps };
}

function tracksOf(document, data, animation) {
  const floats = (index) => {
    const { bufferView, byteOffset = 0, count, type, componentType } = document.accessors[index];
    const width = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type], view = document.bufferViews[bufferView];
    if (!view || componentType !== 5126 || !width || (view.byteStride ?? width * 4) !== width * 4) throw new Error(READ);
    const start = (view.byteOffset ?? 0) + byteOffset;
    if (!(start + count * width * 4 <= data.length)) throw new Error("This file is cut off.");
    return new Float32Array(data.slice(start, start + count * width * 4).buffer);
  };
  const moved = animation.channels.filter(({ target: { node, path } }) => node !== undefined && path !== "weights");
  return new Map(moved.map(({ sampler, target }) => {
    const { input, output, interpolation = "LINEAR" } = animation.samplers[sampler];
    if (interpolation === "CUBICSPLINE") throw new Error(READ);
    return [`${target.node} ${target.path}`, { times: floats(input), values: floats(output), steps: interpolation === "STEP" }];
  }));
}

/** [x, y, z], or a quaternion [w, x, y, z], at a time. */
function keyAt({ times, values, steps }, time) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time + 1e-6) low = middle;
    else high = middle;
  }
  let share = high === low ? 0 : Math.min(Math.max((time - times[low]) / (times[high] - times[low]), 0), 1);
  if (steps) share = Math.floor(share + 1e-6);
  const width = values.length / times.length, key = (i) => Array.from(values.subarray(i * width, i * width + width));
  const [a, b] = [key(low), key(high)];
  if (width === 3) return a.map((x, i) => x + share * (b[i] - x));
  return share < 1e-6 ? ordered(a) : slerp(quaternionOf(matrixOf(ordered(a))), quaternionOf(matrixOf(ordered(b))), share);
}

const ordered = ([x, y, z, w]) => [w, x, y, z];
