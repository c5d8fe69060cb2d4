// Animated GLB out: the file that Python writes of the rest pose, its keys replaced by a motion's;
// and a motion out of such a file (src/shared/formats/writers/glb.py).

import { continuous } from "../body/rotations.js";
import { JOINTS, SKELETON } from "../body/skeleton.js";

const JSON_CHUNK = 0x4e4f534a, BIN_CHUNK = 0x4e4942;

export function readGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Error("This is no GLB file.");
  const found = { document: null, data: new Uint8Array() };
  for (let at = 12; at + 8 <= bytes.length; ) {
    const length = view.getUint32(at, true), kind = view.getUint32(at + 4, true), chunk = bytes.subarray(at + 8, at + 8 + length);
    if (kind === JSON_CHUNK) found.document = JSON.parse(new TextDecoder().decode(chunk));
    if (kind === BIN_CHUNK) found.data = chunk;
    at += 8 + length;
  }
  if (!found.document) throw new Error("This is no whole GLB file.");
  return found;
}

export function writeGlb(motion, template) {
  const { document, data } = readGlb(template), { frames, fps } = motion;
  const [animation] = document.animations, values = new Map();
  const put = (accessor, array) => values.set(accessor, array);
  for (const { sampler, target } of animation.channels) {
    const { input, output } = animation.samplers[sampler];
    put(input, Float32Array.from({ length: frames }, (_, t) => t / fps));
    if (target.path === "translation") { put(output, motion.root.slice()); continue; }
    const own = new Float32Array(frames * 4);
    for (let t = 0; t < frames; t++) own.set(motion.quaternions.subarray((t * JOINTS + target.node) * 4, (t * JOINTS + target.node) * 4 + 4), t * 4);
    continuous(own, 4);
    for (let at = 0; at < own.length; at += 4) own.copyWithin(at, at, at + 4), own.set([own[at + 1], own[at + 2], own[at + 3], own[at]], at);
    put(output, own);
  }
  const pieces = [];
  let length = 0;
  document.bufferViews.forEach((each, index) => {
    const accessor = document.accessors.findIndex(({ bufferView }) => bufferView === index), array = values.get(accessor);
    const piece = array ? new Uint8Array(array.buffer) : data.subarray(each.byteOffset, each.byteOffset + each.byteLength);
    length += -length & 3;
    Object.assign(each, { byteOffset: length, byteLength: piece.length });
    pieces.push([length, piece]);
    length += piece.length;
    if (array) Object.assign(document.accessors[accessor], { count: frames });
    if (array && document.accessors[accessor].max) Object.assign(document.accessors[accessor], { min: [0], max: [array[frames - 1]] });
  });
  const name = motion.text || "motion";
  Object.assign(document.scenes[0], { name, extras: { text: motion.text } });
  animation.name = name;
  const whole = new Uint8Array(length);
  for (const [at, piece] of pieces) whole.set(piece, at);
  document.buffers[0].byteLength = length;
  return packed(new TextEncoder().encode(JSON.stringify(document)), whole);
}

export function packed(text, data) {
  const sizes = [text.length + (-text.length & 3), data.length + (-data.length & 3)];
  const bytes = new Uint8Array(28 + sizes[0] + sizes[1]).fill(32, 20, 20 + sizes[0]), view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, sizes[0], JSON_CHUNK].forEach((value, i) => view.setUint32(i * 4, value, true));
  bytes.set(text, 20);
  view.setUint32(20 + sizes[0], sizes[1], true);
  view.setUint32(24 + sizes[0], BIN_CHUNK, true);
  bytes.set(data, 28 + sizes[0]);
  return bytes;
}
