// An avatar (VRM, or GLB with a skin) that moves as ours does: ports of src/shared/data/retarget/to_rig.py
// and of write_glb_character in src/shared/formats/writers/glb.py.

import { add, apply, continuous, multiply, norm, quaternionOf, scale, sub, transposed } from "../body/rotations.js";
import { INDEX, JOINTS, kinematics, LEG_LENGTH, LEGS, pose, REST_FOOT_HEIGHT, REST_PELVIS_HEIGHT, SKELETON } from "../body/skeleton.js";
import { orDamaged, treeOf } from "./clip.js";
import { packed, readGlb } from "./glb.js";
import { corrections, legLength, lineOf, mappingOf, restFrame } from "./retarget.js";

const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1], STANDING = 0.3, UNEVEN = 0.02, FLOAT = 5126, OURS = "motion-tools";
const MOVED = "Export it as .vrm, which names them; or move it by motion-tools convert CLIP moved.glb --skeleton AVATAR.";
const HIPS = () => LEGS.map(([hip]) => hip);
const middle = (places, [a, b]) => scale(add(places[a], places[b]), 0.5);

/** The avatar in a file, and whether that is all that is in it; null where it brings no body but our mannequin. @param {object[]} profiles names of joints */
export function readAvatar(name, bytes, profiles) {
  return orDamaged(() => {
    if (!/\.(vrm|glb)$/i.test(name)) return null;
    const { skins, animations, asset } = readGlb(bytes).document, alone = !animations?.length;
    if (!/\.vrm$/i.test(name) && (!skins?.length || asset?.generator === OURS)) return null;
    try {
      return { avatar: new Avatar(bytes, profiles), alone };
    } catch (error) {
      if (alone) throw error;
      return null; // a clip all the same
    }
  });
}

class Avatar {
  /** Throws where it has no body that we know. */
  constructor(bytes, profiles) {
    Object.assign(this, readGlb(bytes), { bytes });
    const { document } = this, tree = treeOf(document), chosen = skeletonOf(document, tree);
    if (tree.order.some((node, index) => chosen.has(index) && uneven(tree.nodes[node].scale))) throw new Error("Its joints are scaled unevenly; apply all scales and export it again.");
    tree.names = tree.names.map((name, index) => (chosen.has(index) ? name : "")); // a mesh may be called as a joint is
    const { joints, axes } = mappingOf(tree.names, profiles, MOVED), rest = restFrame(tree, joints);
    if (!rest) throw new Error("It rests in no standing pose; export it in a T-pose or an A-pose.");
    Object.assign(this, { tree, joints, players: new Map(), hips: ["l_hip", "r_hip"].map((name) => joints[name]) });
    for (const [name, turn] of Object.entries(corrections(tree, joints, axes, rest))) this.players.set(joints[name], [INDEX[name], transposed(turn)]);
    this.size = legLength(tree, joints) / LEG_LENGTH;
    if (!(this.size > 1e-6)) throw new Error("Its legs have no length.");
    const below = this.hips.every((hip) => hip === joints.pelvis || lineOf(tree, joints.pelvis, hip).length);
    this.mover = below ? joints.pelvis : this.above([joints.pelvis, ...this.hips]);
    this.lift = this.lifted();
  }

  /** The lowest joint above all of these. */
  above(all) {
    let joint = all[0];
    while (joint > 0 && !all.every((each) => each === joint || lineOf(this.tree, joint, each).length)) joint = this.tree.parents[joint];
    return Math.max(joint, 0);
  }

  /** How much higher the hips must be than ours, scaled, for its feet to stand as they do at rest. */
  lifted() {
    const { tree, joints, size } = this, balls = ["l_foot", "r_foot"].filter((name) => name in joints).map((name) => joints[name]);
    if (!balls.length) return 0;
    const mean = (places, all) => all.reduce((sum, joint) => sum + places[joint][1], 0) / all.length;
    const { positions } = this.turned(Array(JOINTS).fill(IDENTITY)), atRest = [];
    tree.parents.forEach((parent, joint) => atRest.push(parent < 0 ? tree.offsets[joint] : add(atRest[parent], tree.offsets[joint])));
    const ball = mean(atRest, balls), floor = ball >= 0 && ball < STANDING * size * LEG_LENGTH ? ball : REST_FOOT_HEIGHT * size;
    return floor + mean(positions, this.hips) - mean(positions, balls) - (REST_PELVIS_HEIGHT + SKELETON.offsets[HIPS()[0]][1]) * size;
  }

  /** World rotations and places of its joints, the root at rest, for world rotations [22] of ours. */
  turned(ours) {
    const world = [], positions = [];
    this.tree.parents.forEach((parent, joint) => {
      const above = parent < 0 ? IDENTITY : world[parent], player = this.players.get(joint), offset = this.tree.offsets[joint];
      world.push(player ? multiply(ours[player[0]], player[1]) : above);
      positions.push(parent < 0 ? offset : add(positions[parent], apply(above, offset)));
    });
    return { world, positions };
  }

  /** Of a pose of ours (`kinematics`): rotations [w, x, y, z] by node, of those that play ours, the place of the one that travels, and of the hips in the world. */
  posed({ positions: ours, world: turns }) {
    const { tree, mover } = this, { parents, offsets, order, frame, rest } = tree, { world, positions } = this.turned(turns);
    const above = (joint) => (parents[joint] < 0 ? IDENTITY : world[parents[joint]]);
    const hips = add(scale(middle(ours, HIPS()), this.size), [0, this.lift, 0]);
    const step = apply(transposed(above(mover)), sub(hips, middle(positions, this.hips)));
    const rotations = [...this.players.keys()].map((joint) => {
      const local = multiply(transposed(above(joint)), world[joint]);
      return [order[joint], quaternionOf(multiply(multiply(transposed(frame(joint)), local), rest[joint]))];
    });
    const place = apply(transposed(frame(mover)), add(offsets[mover], step)).map((x) => x / tree.size(mover));
    return { rotations, node: order[mover], place, hips };
  }

  /** The avatar's file again, mesh and all, with a motion as its only animation. */
  write(motion) {
    const document = structuredClone(this.document), { data } = this, { frames, fps } = motion;
    for (const name of ["accessors", "bufferViews"]) document[name] ??= [];
    document.buffers ??= [{}];
    for (const joint of [...this.players.keys(), this.mover]) { // what moves may have no matrix
      const node = this.tree.order[joint], { matrix, ...pose } = this.tree.nodes[node];
      if (matrix) document.nodes[node] = pose;
    }
    const poses = Array.from({ length: frames }, (_, t) => this.posed(pose(motion, t))), pieces = [data];
    let length = data.length;
    const put = (values, type, bounds = {}) => {
      const bytes = new Uint8Array(Float32Array.from(values).buffer), gap = -length & 3;
      pieces.push(new Uint8Array(gap), bytes);
      document.bufferViews.push({ buffer: 0, byteOffset: length + gap, byteLength: bytes.length });
      length += gap + bytes.length;
      return document.accessors.push({ bufferView: document.bufferViews.length - 1, componentType: FLOAT, count: frames, type, ...bounds }) - 1;
    };
    const samplers = [], channels = [], input = put(Array.from({ length: frames }, (_, t) => t / fps), "SCALAR", { min: [0], max: [Math.fround((frames - 1) / fps)] });
    const move = (node, path, output) => channels.push({ sampler: samplers.push({ input, output, interpolation: "LINEAR" }) - 1, target: { node, path } });
    move(poses[0].node, "translation", put(poses.flatMap(({ place }) => place), "VEC3"));
    poses[0].rotations.forEach(([node], i) => {
      const turns = continuous(Float64Array.from(poses.flatMap(({ rotations }) => rotations[i][1])), 4);
      move(node, "rotation", put(Array.from(turns, (_, at) => turns[at - (at % 4) + (((at % 4) + 1) % 4)]), "VEC4")); // x y z w
    });
    document.animations = [{ name: motion.text || "motion", samplers, channels }];
    document.buffers[0].byteLength = length;
    const whole = new Uint8Array(length);
    let at = 0;
    for (const piece of pieces) { whole.set(piece, at); at += piece.length; }
    return packed(new TextEncoder().encode(JSON.stringify(document)), whole);
  }
}

/** The joints that a body hangs on, and all above them: those that VRM names, else those of the largest skin. */
function skeletonOf({ skins = [] }, { order, parents, bones }) {
  const own = bones.size ? [...bones.keys()] : skins.reduce((most, { joints }) => (joints.length > most.length ? joints : most), []), found = new Set();
  if (!own.length) throw new Error("There is no skeleton in this file; export the armature as well.");
  for (const node of own) for (let joint = order.indexOf(node); joint >= 0; joint = parents[joint]) found.add(joint);
  return found;
}

const uneven = (sizes = [1, 1, 1]) => sizes.some((size) => !(Math.abs(size / norm(sizes) * Math.sqrt(3) - 1) <= UNEVEN));
