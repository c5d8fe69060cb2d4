// The 22 joints every motion lives on; src/shared/motion/skeleton.py is handed over with the model.

import { add, apply, matrixOf, multiply } from "./rotations.js";

export const JOINTS = 22;
export const FPS = 30;
export const SKELETON = { names: [], parents: [], offsets: [] };
export const INDEX = {};
export let REST_FOOT_HEIGHT, REST_PELVIS_HEIGHT, LEG_LENGTH, FEET, LEGS, ARMS, GROUPS;

/** Take the skeleton from the page's data; once, before all else. */
export function useSkeleton({ names, parents, offsets, tips, limbs, groups }) {
  Object.assign(SKELETON, { names, parents, offsets, tips });
  names.forEach((name, index) => { INDEX[name] = index; });
  [LEGS, ARMS] = ["leg", "arm"].map((limb) => ["left", "right"].map((side) => limbs[`${side}-${limb}`].map((name) => INDEX[name])));
  FEET = LEGS.map(([, , ankle, ball]) => ({ ankle, ball }));
  GROUPS = groups;
  REST_FOOT_HEIGHT = 0.02;
  REST_PELVIS_HEIGHT = REST_FOOT_HEIGHT - LEGS[0].reduce((sum, joint) => sum + offsets[joint][1], 0);
  LEG_LENGTH = -offsets[LEGS[0][1]][1] - offsets[LEGS[0][2]][1];
}

/** World positions and rotations of one frame: local matrices [22], root position. */
export function kinematics(local, root) {
  const { parents, offsets } = SKELETON;
  const world = [local[0]], positions = [root];
  for (let joint = 1; joint < JOINTS; joint++) {
    const parent = parents[joint];
    world.push(multiply(world[parent], local[joint]));
    positions.push(add(positions[parent], apply(world[parent], offsets[joint])));
  }
  return { positions, world };
}

/** The same of frame `t` of a motion. */
export function pose(motion, t) {
  const local = [];
  for (let joint = 0; joint < JOINTS; joint++) local.push(matrixOf(motion.quaternions, (t * JOINTS + joint) * 4));
  return kinematics(local, Array.from(motion.root.subarray(t * 3, t * 3 + 3)));
}
