// BVH out and in: our own skeleton in centimetres, Euler angles ZXY in degrees
// (src/shared/formats/writers/bvh.py).

import { matrixOf } from "../body/rotations.js";
import { JOINTS, SKELETON } from "../body/skeleton.js";

const DEGREES = 180 / Math.PI;

export function writeBvh(motion) {
  const { parents, names, offsets } = SKELETON, order = depthFirst();
  const number = (value) => (Math.round(value * 1e5) / 1e5 + 0).toFixed(5).replace(/^-0\.00000$/, "0.00000");
  const lines = ["HIERARCHY"];
  const write = (joint, depth) => {
    const pad = "\t".repeat(depth), offset = joint ? offsets[joint].map((x) => x * 100) : [0, 0, 0];
    lines.push(`${pad}${joint ? "JOINT" : "ROOT"} ${names[joint]}`, `${pad}{`, `${pad}\tOFFSET ${offset.map(number).join(" ")}`);
    lines.push(`${pad}\tCHANNELS ${joint ? "3" : "6 Xposition Yposition Zposition"} Zrotation Xrotation Yrotation`);
    const children = order.filter((other) => parents[other] === joint);
    for (const child of children) write(child, depth + 1);
    for (const [owner, tip] of SKELETON.tips) {
      if (owner !== joint) continue;
      lines.push(`${pad}\tEnd Site`, `${pad}\t{`, `${pad}\t\tOFFSET ${tip.map((x) => number(x * 100)).join(" ")}`, `${pad}\t}`);
    }
    lines.push(`${pad}}`);
  };
  write(0, 0);
  lines.push("MOTION", `Frames: ${motion.frames}`, `Frame Time: ${(1 / motion.fps).toFixed(8)}`);
  let before = Array.from({ length: JOINTS }, () => [0, 0, 0]);
  for (let t = 0; t < motion.frames; t++) {
    const angles = before.map((last, joint) => eulerZxy(matrixOf(motion.quaternions, (t * JOINTS + joint) * 4), last, t === 0));
    before = angles;
    const row = [0, 1, 2].map((i) => motion.root[t * 3 + i] * 100);
    for (const joint of order) row.push(...angles[joint].map((x) => x * DEGREES));
    lines.push(row.map((x) => x.toFixed(5)).join(" "));
  }
  return `${lines.join("\n")}\n`;
}

function depthFirst() {
  const order = [], stack = [0];
  while (stack.length) {
    const joint = stack.pop();
    order.push(joint);
    for (let child = JOINTS - 1; child > 0; child--) if (SKELETON.parents[child] === joint) stack.push(child);
  }
  return order;
}

/** Intrinsic Z, X, Y angles of a matrix, of the two triples the one nearer to the frame before. */
function eulerZxy(m, before, first) {
  const cosX = Math.hypot(m[1], m[4]), free = cosX < 1e-8;
  const z = free ? before[0] : Math.atan2(-m[1], m[4]), x = Math.atan2(m[7], cosX);
  const complete = (z, x) =>
    [z, x, Math.atan2(Math.cos(z) * m[2] + Math.sin(z) * m[5], Math.cos(z) * m[0] + Math.sin(z) * m[3])].map(
      (angle, i) => angle - 2 * Math.PI * Math.round((angle - before[i]) / (2 * Math.PI)));
  const one = complete(z, x), two = complete(z + Math.PI, Math.PI - x);
  const away = (triple) => triple.reduce((sum, angle, i) => sum + Math.abs(angle - before[i]), 0);
  return !first && !free && away(two) < away(one) ? two : one;
}
