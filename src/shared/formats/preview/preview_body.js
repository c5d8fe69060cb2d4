// The body of the preview: a skinned mesh in WebGL, or plain round limbs where there is none.

const VERTEX_SHADER = `
attribute vec3 position; attribute vec3 normal;
attribute vec4 joints; attribute vec4 weights; attribute vec3 tint;
uniform vec4 bones[${3 * K}]; uniform mat4 camera; uniform vec3 slant; uniform vec2 contacts;
uniform vec3 trunk; uniform vec3 left; uniform vec3 right; uniform vec3 ground;
varying vec3 vPosition; varying vec3 vNormal; varying vec3 vColour;
void main() {
  vec4 p = vec4(position * 1e-4, 1.0);
  vec3 world = vec3(0.0), turned = vec3(0.0);
  for (int i = 0; i < 4; i++) {
    int bone = 3 * int(joints[i] + 0.5);
    vec4 x = bones[bone], y = bones[bone + 1], z = bones[bone + 2];
    world += weights[i] * vec3(dot(x, p), dot(y, p), dot(z, p));
    turned += weights[i] * vec3(dot(x.xyz, normal), dot(y.xyz, normal), dot(z.xyz, normal));
  }
  if (slant.z > 0.5) world = vec3(world.x - slant.x * world.y, 0.0, world.z - slant.y * world.y);
  vec3 colour = mix(mix(trunk, left, max(tint.x, 0.0)), right, max(-tint.x, 0.0));
  vColour = mix(colour, ground, clamp(dot(tint.yz, contacts), 0.0, 1.0));
  vPosition = world;
  vNormal = turned;
  gl_Position = camera * vec4(world, 1.0);
}`;

const FRAGMENT_SHADER = `
precision mediump float;
uniform vec3 light; uniform highp vec3 eye; uniform float shadow;
varying highp vec3 vPosition; varying vec3 vNormal; varying vec3 vColour;
void main() {
  if (shadow > 0.0) { gl_FragColor = vec4(vec3(0.25, 0.28, 0.34) * shadow, shadow); return; }
  vec3 n = normalize(vNormal), toward = normalize(eye - vPosition);
  float diffuse = 0.5 + 0.5 * dot(n, light);
  float facing = clamp(dot(n, toward), 0.0, 1.0);
  float shine = pow(clamp(dot(n, normalize(light + toward)), 0.0, 1.0), 30.0);
  float level = (0.42 + 0.70 * diffuse) * (0.62 + 0.38 * min(1.0, facing * 2.0));
  gl_FragColor = vec4(vColour * level + 0.14 * shine, 1.0);
}`;

/** A function that draws a body into a 2D canvas through WebGL; null where WebGL is missing. */
function makeMeshPainter() {
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl", { alpha: true, antialias: true });
  if (!gl) return null;
  let scene = buildScene(gl);
  canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); scene = null; });
  canvas.addEventListener("webglcontextrestored", () => { scene = buildScene(gl); });
  return (context, view, pose) => {
    if (!scene) return paintLimbs(context, view, pose);
    const width = Math.ceil(view.width), height = Math.ceil(view.height);
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    gl.viewport(0, canvas.height - height, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform4fv(scene.at("bones"), bonesOf(pose));
    gl.uniformMatrix4fv(scene.at("camera"), false, view.matrix);
    gl.uniform2fv(scene.at("contacts"), pose.contacts);
    gl.uniform3fv(scene.at("eye"), view.eye);
    for (const shadow of [0.3, 0]) {
      gl.uniform1f(scene.at("shadow"), shadow);
      gl.uniform3f(scene.at("slant"), ...SLANT, shadow > 0 ? 1 : 0);
      gl.drawElements(gl.TRIANGLES, scene.count, gl.UNSIGNED_SHORT, 0);
      gl.clear(gl.DEPTH_BUFFER_BIT);
    }
    context.drawImage(canvas, 0, 0, width, height, 0, 0, width, height);
  };
}

function buildScene(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX_SHADER],
    [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const attribute = (name, values, size, type, normalized) => {
    const place = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
  };
  const joints = decode(DATA.mesh.joints, Uint8Array);
  const weights = decode(DATA.mesh.weights, Uint8Array);
  attribute("position", decode(DATA.mesh.positions, Int16Array), 3, gl.SHORT, false);
  attribute("normal", decode(DATA.mesh.normals, Int8Array), 3, gl.BYTE, true);
  attribute("joints", joints, 4, gl.UNSIGNED_BYTE, false);
  attribute("weights", weights, 4, gl.UNSIGNED_BYTE, true);
  attribute("tint", tints(joints, weights), 3, gl.FLOAT, false);
  const triangles = decode(DATA.mesh.triangles, Uint16Array);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  gl.enable(gl.DEPTH_TEST);
  gl.enable(gl.CULL_FACE);
  const places = {};
  const at = (name) => (places[name] ??= gl.getUniformLocation(program, name));
  const { left, right, centre, contact } = DATA.colours;
  for (const [name, value] of [["left", left], ["right", right], ["trunk", centre],
    ["ground", contact], ["light", LIGHT]]) gl.uniform3fv(at(name), value);
  return { at, count: triangles.length };
}

/** For each vertex: side (-1 right, 1 left), and how much of it is left and right foot. */
function tints(joints, weights) {
  const result = new Float32Array((joints.length / 4) * 3);
  joints.forEach((joint, i) => {
    const place = 3 * Math.floor(i / 4), share = weights[i] / 255;
    result[place] += share * sides[joint];
    feet.forEach((pair, side) => { if (pair.includes(joint)) result[place + 1 + side] += share; });
  });
  return result;
}

/** Without WebGL: every limb a round-ended shape, far ones first. */
function paintLimbs(context, view, pose) {
  const world = (joint, point) =>
    pose.positions[joint].map((x, i) => x + dot(pose.matrices[joint][i], point));
  const limbs = DATA.cones.map(([joint, start, end, r0, r1]) => {
    const p = world(joint, start), q = world(joint, end);
    return { joint, r0, r1, p, q, a: view.project(p), b: view.project(q) };
  });
  context.lineCap = "round";
  context.strokeStyle = "rgba(64, 71, 87, 0.25)";
  context.lineWidth = 0.14 * view.project(view.target)[3];
  context.beginPath();
  for (const { p, q } of limbs) addLine(context, view, shade(p), shade(q));
  context.stroke();
  limbs.sort((x, y) => y.a[2] + y.b[2] - x.a[2] - x.b[2]);
  for (const { joint, a, b, r0, r1 } of limbs) {
    if (a[2] < NEAR || b[2] < NEAR) continue;
    const foot = feet.findIndex((pair) => pair.includes(joint));
    const { left, right, centre, contact } = DATA.colours;
    const side = [right, centre, left][sides[joint] + 1];
    const colour = foot >= 0 && pose.contacts[foot] ? contact : side;
    paintCone(context, a, b, r0 * a[3], r1 * b[3], colour);
  }
}

function shade([x, y, z]) { return [x - SLANT[0] * y, 0, z - SLANT[1] * y]; }

/** Two circles and what lies between their outer tangents. */
function paintCone(context, a, b, r0, r1, colour) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const css = (level) => `rgb(${colour.map((x) => Math.round(255 * Math.min(1, x * level)))})`;
  const paint = context.createLinearGradient(a[0] - r0, a[1] - r0, a[0] + r0, a[1] + r0);
  paint.addColorStop(0, css(1.08));
  paint.addColorStop(1, css(0.82));
  context.fillStyle = paint;
  context.strokeStyle = css(0.62);
  context.lineWidth = 1;
  context.beginPath();
  if (length <= Math.abs(r0 - r1) + 1e-6) {
    const [c, r] = r0 > r1 ? [a, r0] : [b, r1];
    context.arc(c[0], c[1], r, 0, 2 * Math.PI);
  } else {
    const along = Math.atan2(b[1] - a[1], b[0] - a[0]), open = Math.acos((r0 - r1) / length);
    context.arc(a[0], a[1], r0, along + open, along - open);
    context.arc(b[0], b[1], r1, along - open, along + open);
    context.closePath();
  }
  context.fill();
  context.stroke();
}
