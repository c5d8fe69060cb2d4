// The floor, the bodies on it, the path, the camera.

import {
  AmbientLight, Bone, BufferAttribute, BufferGeometry, Color, DirectionalLight, Fog,
  HemisphereLight, Line, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial,
  PerspectiveCamera, Plane, PlaneGeometry, Quaternion, Raycaster, RingGeometry, Scene, ShadowMaterial, Skeleton, SkinnedMesh, Spherical, TextureLoader, Vector2,
  Vector3, WebGLRenderer, PCFShadowMap, SRGBColorSpace,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { clone } from "three/addons/utils/SkeletonUtils.js";

import { matrixOf } from "../body/rotations.js";
import { INDEX, kinematics } from "../body/skeleton.js";

const SPACING = 1.7; // metres between takes
const JOINTS = 22;
const CELL = 0.065; // metres

export class Stage {
  /** @param {HTMLCanvasElement} canvas @param {object} body of the settings: skeleton, mesh, colours */
  constructor(canvas, body) {
    this.canvas = canvas;
    this.body = body;
    this.lean = drawnByProcessor() ? 1 : 0; // see keepPace
    const context = canvas.getContext("webgl2", { antialias: !this.lean, alpha: false });
    if (!context) throw new Error("no WebGL");
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.scene = new Scene();
    this.scene.background = new Color();
    this.scene.fog = new Fog(0, 9, 34);
    this.camera = new PerspectiveCamera(38, 1, 0.05, 200);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.12, maxPolarAngle: 1.53, minDistance: 1, maxDistance: 30 });
    this.controls.addEventListener("change", () => { this.stale = true; });
    this.bodies = [];
    this.shared = meshOf(body);
    this.addRoom();
    this.paint();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
    canvas.addEventListener("webglcontextrestored", () => { this.stale = true; });
    this.resetView();
    this.time = 0;
  }

  addRoom() {
    this.scene.add(new HemisphereLight(0xffffff, 0xc4cbd6, 1.9), new AmbientLight(0xffffff, 0.35));
    this.sun = new DirectionalLight(0xffffff, 1.7);
    this.sun.castShadow = !this.lean;
    this.sun.shadow.mapSize.set(1024, 1024);
    Object.assign(this.sun.shadow.camera, { left: -6, right: 6, top: 6, bottom: -6, near: 0.5, far: 20 });
    this.sun.shadow.radius = 4;
    this.scene.add(this.sun, this.sun.target);
    this.floor = new Mesh(new PlaneGeometry(200, 200), new ShadowMaterial({ color: 0x1c2430, opacity: 0.22 }));
    this.floor.rotation.x = -Math.PI / 2;
    this.floor.receiveShadow = true;
    this.floor.visible = this.sun.castShadow;
    this.grid = gridOf(30);
    this.scene.add(this.floor, this.grid);
    this.line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: 0xd0453c }));
    this.line.frustumCulled = false;
    this.scene.add(this.line);
    this.ring = new Mesh(new RingGeometry(0.34, 0.4, 48), new MeshBasicMaterial({ color: 0x2f6fd0, transparent: true, opacity: 0.8 }));
    this.ring.rotation.x = -Math.PI / 2;
    this.ring.position.y = 0.006;
    this.ring.visible = false;
    this.scene.add(this.ring);
  }

  /** The room as bright as the page. */
  paint() {
    const style = getComputedStyle(this.canvas), colour = (name) => style.getPropertyValue(name).trim();
    this.scene.fog.color.copy(this.scene.background.set(colour("--room")));
    this.grid.material.color.set(colour("--grid"));
    this.stale = true;
  }

  /** Show motions side by side, one of them chosen. */
  show(motions, chosen) {
    while (this.bodies.length > motions.length) this.remove(this.bodies.pop());
    while (this.bodies.length < motions.length) this.bodies.push(this.newBody());
    this.motions = motions;
    this.chosen = chosen;
    this.offsets = motions.map((_, i) => (i - (motions.length - 1) / 2) * SPACING);
    this.placeAt(this.time);
  }

  /** Of the body that is shown, by the mannequin's. */
  get size() {
    return this.worn?.avatar.size ?? 1;
  }

  remove({ mesh }) {
    this.scene.remove(mesh);
    mesh.traverse(({ skeleton }) => skeleton?.dispose());
  }

  /** Show an avatar in place of the mannequin, or that again for null, unless another is wished for before it can be drawn. Throws where it cannot. */
  async wear(avatar) {
    const wish = this.wish = Symbol(), worn = avatar && await drawn(avatar);
    if (this.wish !== wish) { if (worn) dispose(worn.scene); return; }
    for (const body of this.bodies.splice(0)) this.remove(body);
    if (this.worn) dispose(this.worn.scene);
    const { size } = this;
    this.worn = worn;
    if (this.motions) this.show(this.motions, this.chosen);
    if (this.size !== size) this.resetView();
  }

  newBody() {
    return this.worn ? this.newAvatar() : this.newMannequin();
  }

  newAvatar() {
    const { avatar, scene, nodes } = this.worn, mesh = clone(scene), twins = new Map(), copies = [];
    mesh.traverse((each) => copies.push(each));
    let next = 0;
    scene.traverse((each) => twins.set(each, copies[next++]));
    this.scene.add(mesh);
    const own = (node) => twins.get(nodes[node]);
    return {
      mesh,
      chest: own(avatar.tree.order[avatar.joints.spine3 ?? avatar.joints.pelvis]),
      place: (turns, root) => {
        const { rotations, node, place, hips } = avatar.posed(kinematics(turns.map(({ x, y, z, w }) => matrixOf([w, x, y, z])), root));
        for (const [each, [w, x, y, z]] of rotations) own(each).quaternion.set(x, y, z, w);
        own(node).position.set(...place);
        return hips;
      },
    };
  }

  newMannequin() {
    const { parents, offsets } = this.shared, geometry = this.lean ? (this.coarse ??= coarser(this.shared.geometry)) : this.shared.geometry;
    const bones = parents.map((_, joint) => {
      const bone = new Bone();
      bone.position.fromArray(offsets[joint]);
      return bone;
    });
    parents.forEach((parent, joint) => { if (parent >= 0) bones[parent].add(bones[joint]); });
    const mesh = new SkinnedMesh(geometry, new MeshLambertMaterial({ vertexColors: true }));
    mesh.castShadow = true;
    mesh.frustumCulled = false;
    mesh.add(bones[0]);
    const inverses = this.body.skeleton.rest.map(([x, y, z]) => new Matrix4().makeTranslation(-x, -y, -z));
    mesh.bind(new Skeleton(bones, inverses), new Matrix4());
    this.scene.add(mesh);
    return {
      mesh,
      chest: bones[INDEX.spine3],
      place: (turns, root) => {
        turns.forEach((turn, joint) => bones[joint].quaternion.copy(turn));
        bones[0].position.set(...root);
        return root;
      },
    };
  }

  /** Put every body where it is at a time. */
  placeAt(time) {
    this.time = time;
    const a = new Quaternion(), b = new Quaternion();
    this.bodies.forEach(({ mesh, place }, i) => {
      const { frames, fps, quaternions, root } = this.motions[i];
      const at = Math.min(Math.max(time * fps, 0), frames - 1), first = Math.floor(at), second = Math.min(first + 1, frames - 1);
      const share = at - first, turns = [];
      for (let joint = 0; joint < JOINTS; joint++) {
        const [p, q] = [(first * JOINTS + joint) * 4, (second * JOINTS + joint) * 4];
        a.set(quaternions[p + 1], quaternions[p + 2], quaternions[p + 3], quaternions[p]);
        b.set(quaternions[q + 1], quaternions[q + 2], quaternions[q + 3], quaternions[q]);
        turns.push(new Quaternion().slerpQuaternions(a, b, share));
      }
      const [x, y, z] = [0, 1, 2].map((k) => root[first * 3 + k] + share * (root[second * 3 + k] - root[first * 3 + k]));
      const [ownX, , ownZ] = place(turns, [x, y, z]);
      mesh.position.x = this.offsets[i];
      if (i === this.chosen) {
        this.ring.position.set(ownX + this.offsets[i], 0.006, ownZ);
        this.focus = new Vector3(ownX, 0, ownZ); // without what sets takes apart
      }
    });
    this.ring.visible = this.bodies.length > 1;
    this.stale = true;
  }

  showPath(points) {
    const places = (points ?? []).map(([x, z]) => new Vector3(x + (this.offsets?.[this.chosen] ?? 0), 0.01, z));
    this.line.geometry.dispose();
    this.line.geometry = new BufferGeometry().setFromPoints(places);
    this.line.visible = places.length > 1;
    this.stale = true;
  }

  /** Where on the floor a pointer is, [x, z] without the chosen take's offset; null beyond it. */
  floorAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    this.camera.updateMatrixWorld();
    const caster = new Raycaster();
    caster.setFromCamera(pointer, this.camera);
    const place = caster.ray.intersectPlane(new Plane(new Vector3(0, 1, 0)), new Vector3());
    return place && place.length() < 60 ? [place.x - (this.offsets?.[this.chosen] ?? 0), place.z] : null;
  }

  /** Which take a click is nearest to; null where none is near. */
  takeAt(event) {
    const box = this.canvas.getBoundingClientRect();
    let best = null, least = 0.07 * box.width;
    this.bodies.forEach(({ chest }, i) => {
      const place = chest.getWorldPosition(new Vector3()).project(this.camera);
      const away = Math.hypot(((place.x + 1) / 2) * box.width + box.left - event.clientX, ((1 - place.y) / 2) * box.height + box.top - event.clientY);
      if (away < least) { least = away; best = i; }
    });
    return best;
  }

  resetView(fromAbove = false) {
    const more = Math.max(0, (this.bodies?.length ?? 1) - 1);
    const target = (this.focus?.clone() ?? new Vector3()).setY(0.85 * this.size);
    this.controls.target.copy(target);
    if (fromAbove) this.camera.position.set(target.x, 11, target.z - 3);
    else {
      const half = more * SPACING / 2 + 0.9, away = half / (Math.tan((this.camera.fov * Math.PI) / 360) * this.camera.aspect);
      this.camera.position.copy(target).add(new Vector3(1.6 / (1 + more), 0.9, 3.7).setLength(Math.max(4.1 * this.size, away)));
    }
    this.controls.update();
    this.stale = true;
  }

  /** The camera about what it looks at: by radians aside and up, and that many times as far; the controls keep its limits. */
  turn(aside, up, farther = 1) {
    const { target } = this.controls, way = new Spherical().setFromVector3(this.camera.position.clone().sub(target));
    way.set(way.radius * farther, way.phi - up, way.theta + aside).makeSafe();
    this.camera.position.setFromSpherical(way).add(target);
  }

  /** Draw what has changed; the camera goes along with the chosen body; `busy`: what is computed meanwhile makes frames late. Without a graphics card a picture costs what a prediction does. */
  draw(follow, step, busy) {
    if (follow && this.focus) {
      const way = this.focus.clone().setY(this.controls.target.y).sub(this.controls.target).multiplyScalar(1 - Math.exp(-4 * step));
      this.controls.target.add(way);
      this.camera.position.add(way);
    }
    this.controls.update();
    if (!this.stale) return;
    this.stale = false;
    const { x, z } = this.controls.target;
    this.sun.target.position.set(x, 0, z);
    this.sun.position.set(x + 2.5, 6, z + 3);
    for (const { position } of [this.floor, this.grid]) position.set(Math.round(x), position.y, Math.round(z));
    this.renderer.render(this.scene, this.camera);
    if (!busy) this.keepPace(step);
  }

  /** Where frames take long, draw less: first a coarser mannequin and no shadows, nor a floor, which is nothing without, then fewer pixels. */
  keepPace(step) {
    this.late = step > 0.045 ? (this.late ?? 0) + 1 : 0;
    if (this.late < 12 || this.lean === 2) return;
    this.late = 0;
    this.lean++;
    this.sun.castShadow = this.floor.visible = false;
    if (this.lean === 1 && !this.worn) this.wear(null);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, this.lean === 2 ? 0.6 : this.lean ? 1 : 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.stale = true;
  }
}

/** What draws an avatar: its scene, and the nodes of its file. Pictures come through image elements, as the page lets nothing be fetched. */
async function drawn(avatar) {
  const loader = new GLTFLoader().register((parser) => {
    parser.textureLoader = new TextureLoader(parser.options.manager);
    return { name: "pictures" };
  });
  const { scene, parser } = await loader.parseAsync(avatar.bytes.slice().buffer, "");
  const nodes = await parser.getDependencies("node"), there = new Set();
  scene.traverse((each) => {
    there.add(each);
    if (each.isMesh) Object.assign(each, { castShadow: true, frustumCulled: false }); // it moves away from where it is bound
  });
  if (![...avatar.players.keys()].every((joint) => there.has(nodes[avatar.tree.order[joint]]))) throw new Error("Its skeleton is not in its scene.");
  return { avatar, scene, nodes };
}

function dispose(scene) {
  scene.traverse(({ geometry, material }) => {
    geometry?.dispose();
    for (const each of [material].flat().filter(Boolean)) {
      Object.values(each).forEach((value) => { if (value?.isTexture) value.dispose(); });
      each.dispose();
    }
  });
}

/** A square of lines, a metre apart, `reach` metres to each side; in pieces, as some renderers drop lines that pass the camera. */
function gridOf(reach, piece = 5) {
  const points = [];
  for (let i = -reach; i <= reach; i++)
    for (let j = -reach; j < reach; j += piece) points.push(i, 0, j, i, 0, j + piece, j, 0, i, j + piece, 0, i);
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  const grid = new LineSegments(geometry, new LineBasicMaterial());
  grid.position.y = 0.002;
  return grid;
}

/** Whether there is no graphics card. */
function drawnByProcessor() {
  const context = document.createElement("canvas").getContext("webgl2"), told = context?.getExtension("WEBGL_debug_renderer_info");
  const name = told ? context.getParameter(told.UNMASKED_RENDERER_WEBGL) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext(); // browsers have few
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** The same body of fewer triangles: vertices of one part within a few centimetres become one. */
function coarser(geometry) {
  const { position, normal, color, skinIndex, skinWeight } = geometry.attributes, cells = new Map(), cellOf = [];
  for (let v = 0; v < position.count; v++) {
    const key = [position.getX(v), position.getY(v), position.getZ(v)].map((x) => Math.round(x / CELL)).join() + `,${skinIndex.getX(v)}`;
    if (!cells.has(key)) cells.set(key, []);
    cells.get(key).push(v);
    cellOf.push(key);
  }
  const number = new Map([...cells.keys()].map((key, at) => [key, at])), coarse = new BufferGeometry();
  for (const [name, own] of Object.entries({ position, normal, color, skinIndex, skinWeight })) {
    const width = own.itemSize, blend = !name.startsWith("skin"), values = new own.array.constructor(cells.size * width);
    for (const [key, all] of cells)
      for (let i = 0; i < width; i++) values[number.get(key) * width + i] = blend ? all.reduce((sum, v) => sum + own.array[v * width + i], 0) / all.length : own.array[all[0] * width + i];
    coarse.setAttribute(name, new BufferAttribute(values, width));
  }
  const corners = [];
  for (let i = 0; i < geometry.index.count; i += 3) {
    const face = [0, 1, 2].map((k) => number.get(cellOf[geometry.index.getX(i + k)]));
    if (new Set(face).size === 3) corners.push(...face);
  }
  coarse.setIndex(corners);
  return coarse;
}

/** The mannequin's geometry, coloured by the side of its limbs. */
function meshOf({ skeleton, mesh, colours }) {
  const array = (text, Kind) => {
    const binary = atob(text);
    return new Kind(Uint8Array.from(binary, (sign) => sign.charCodeAt(0)).buffer);
  };
  const positions = Float32Array.from(array(mesh.positions, Int16Array), (v) => v * 1e-4);
  const normals = Float32Array.from(array(mesh.normals, Int8Array), (v) => v / 127);
  const joints = array(mesh.joints, Uint8Array), weights = array(mesh.weights, Uint8Array);
  const tint = new Float32Array(positions.length), mixed = new Color();
  const [left, right, centre] = ["left", "right", "centre"].map((side) => new Color().setRGB(...colours[side], SRGBColorSpace));
  for (let v = 0; v < positions.length / 3; v++) {
    let side = 0;
    for (let i = 0; i < 4; i++) side += (weights[v * 4 + i] / 255) * skeleton.sides[joints[v * 4 + i]];
    mixed.copy(centre).lerp(side > 0 ? left : right, Math.abs(side)).toArray(tint, v * 3);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("color", new BufferAttribute(tint, 3));
  geometry.setAttribute("skinIndex", new BufferAttribute(Uint16Array.from(joints), 4));
  geometry.setAttribute("skinWeight", new BufferAttribute(Float32Array.from(weights, (w) => w / 255), 4));
  geometry.setIndex(new BufferAttribute(array(mesh.triangles, Uint16Array), 1));
  return { geometry, parents: skeleton.parents, offsets: skeleton.offsets };
}
