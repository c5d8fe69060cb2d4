// WebGL 2: the skinned mannequin, its shadow, the floor and the path.

const FLOOR_SHADER = [`#version 300 es
in vec2 corner; uniform mat4 camera; uniform vec2 centre; out vec2 place;
void main() { place = centre + corner * 30.0; gl_Position = camera * vec4(place.x, 0, place.y, 1); }`,
`#version 300 es
precision highp float; in vec2 place; uniform vec2 centre; uniform vec3 page; out vec4 colour;
float lines(vec2 at, float width) {
  vec2 near = abs(fract(at - 0.5) - 0.5) / (fwidth(at) * width);
  return 1.0 - min(min(near.x, near.y), 1.0);
}
void main() {
  float fade = 1.0 - smoothstep(2.0, 11.0, length(place - centre));
  float line = max(lines(place * 2.0, 1.0) * 0.35, lines(place * 0.5, 1.6) * 0.75);
  vec3 floor_ = mix(page, vec3(0.905, 0.918, 0.940), fade);
  colour = vec4(mix(floor_, vec3(0.70, 0.735, 0.79), line * fade), 1);
}`];

const BODY_SHADER = [`#version 300 es
in vec4 place; in vec4 normal; in vec4 joints; in vec4 weights;
uniform mat4 camera; uniform vec4 bones[66]; uniform float unit; uniform bool shadow;
uniform vec3 sun; uniform vec2 contacts; out vec3 n; out vec3 world; out float side; out float ground;
void main() {
  vec4 a = vec4(0), b = vec4(0), c = vec4(0); float touch = 0.0;
  for (int i = 0; i < 4; i++) {
    int j = int(joints[i] + 0.5); float w = weights[i];
    a += w * bones[3 * j]; b += w * bones[3 * j + 1]; c += w * bones[3 * j + 2];
    if (j == 7 || j == 10) touch += w * contacts.x;
    if (j == 8 || j == 11) touch += w * contacts.y;
  }
  vec4 rest = vec4(place.xyz * unit, 1);
  world = vec3(dot(a, rest), dot(b, rest), dot(c, rest));
  n = vec3(dot(a.xyz, normal.xyz), dot(b.xyz, normal.xyz), dot(c.xyz, normal.xyz));
  side = normal.w; ground = touch;
  if (shadow) world -= sun * (max(world.y, 0.0) / sun.y) + vec3(0, min(world.y, 0.0), 0);
  gl_Position = camera * vec4(world, 1);
}`,
`#version 300 es
precision highp float; in vec3 n; in vec3 world; in float side; in float ground;
uniform bool shadow; uniform vec3 sun; uniform vec3 eye; uniform vec3 tints[4]; out vec4 colour;
void main() {
  if (shadow) { colour = vec4(0.16, 0.19, 0.26, 0.26); return; }
  vec3 m = normalize(n), v = normalize(eye - world);
  vec3 base = mix(tints[1], side > 0.0 ? tints[2] : tints[0], smoothstep(0.1, 0.9, abs(side)));
  base = mix(base, tints[3], smoothstep(0.3, 0.8, ground) * 0.9);
  float light = 0.5 + 0.5 * dot(m, sun), facing = max(dot(m, v), 0.0);
  float shine = pow(max(dot(m, normalize(sun + v)), 0.0), 36.0);
  vec3 lit = base * (0.46 + 0.62 * light * light + 0.10 * m.y) * (0.72 + 0.28 * min(1.0, facing * 2.2));
  colour = vec4(lit + 0.13 * shine + 0.05 * (1.0 - facing), 1);
}`];

const PATH_SHADER = [`#version 300 es
in vec3 place; uniform mat4 camera; out float when;
void main() { when = place.z; gl_Position = camera * vec4(place.x, 0.0, place.y, 1); }`,
`#version 300 es
precision highp float; in float when; uniform float now; uniform vec3 ink; out vec4 colour;
void main() { colour = vec4(ink, when <= now ? 0.85 : 0.22); }`];

class GlRenderer {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, alpha: false });
    if (!gl) throw new Error("no WebGL 2");
    this.gl = gl;
    this.canvas = canvas;
    this.floor = this.program(FLOOR_SHADER, ["corner"]);
    this.body = this.program(BODY_SHADER, ["place", "normal", "joints", "weights"]);
    this.path = this.program(PATH_SHADER, ["place"]);
    this.quad = this.mesh([[new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), 2, gl.FLOAT, false]]);
    this.skin = this.mesh([
      [decode(data.body.vertices, Int16Array), 4, gl.SHORT, false],
      [decode(data.body.normals, Int8Array), 4, gl.BYTE, true],
      [decode(data.body.joints, Uint8Array), 4, gl.UNSIGNED_BYTE, false],
      [decode(data.body.weights, Uint8Array), 4, gl.UNSIGNED_BYTE, true],
    ], decode(data.body.triangles, Uint16Array));
    this.mark = this.mesh([[new Float32Array(12), 3, gl.FLOAT, false]]);
    this.ribbons = new Map();
    this.bones = new Float32Array(JOINTS * 12);
  }

  program([vertex, fragment], attributes) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    attributes.forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const name = gl.getActiveUniform(program, i).name;
      at[name.replace("[0]", "")] = gl.getUniformLocation(program, name);
    }
    return { program, at };
  }

  mesh(attributes, indices) {
    const gl = this.gl, array = gl.createVertexArray(), buffers = [];
    gl.bindVertexArray(array);
    attributes.forEach(([values, width, kind, normalized], i) => {
      buffers.push(gl.createBuffer());
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[i]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, width, kind, normalized, 0, 0);
    });
    if (indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    }
    gl.bindVertexArray(null);
    return { array, buffers, count: indices ? indices.length : attributes[0][0].length / attributes[0][1] };
  }

  // A band 3 cm wide along the pelvis path; the third number is the share of time gone by.
  ribbon(motion) {
    if (!this.ribbons.has(motion)) {
      const points = [];
      for (let t = 0; t < motion.frames; t++) {
        const a = 3 * Math.max(t - 1, 0), b = 3 * Math.min(t + 1, motion.frames - 1), r = motion.root;
        const dx = r[b] - r[a], dz = r[b + 2] - r[a + 2], n = Math.hypot(dx, dz) || 1;
        const when = motion.frames > 1 ? t / (motion.frames - 1) : 0;
        for (const s of [0.015, -0.015]) points.push(r[3 * t] + s * dz / n, r[3 * t + 2] - s * dx / n, when);
      }
      this.ribbons.set(motion, this.mesh([[new Float32Array(points), 3, this.gl.FLOAT, false]]));
    }
    return this.ribbons.get(motion);
  }

  begin(width, height, ratio) {
    const gl = this.gl;
    this.ratio = ratio;
    this.height = height;
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...PAGE, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  draw(box, camera, motion, pose) {
    const gl = this.gl, matrix = camera.matrix();
    const cell = [box.left, this.height - box.bottom, box.width, box.height].map((v) => Math.round(v * this.ratio));
    gl.viewport(...cell);
    gl.scissor(...cell);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    this.use(this.floor, this.quad, matrix);
    gl.uniform2f(this.floor.at.centre, camera.target[0], camera.target[2]);
    gl.uniform3f(this.floor.at.page, ...PAGE);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);

    gl.enable(gl.BLEND);
    this.use(this.path, this.ribbon(motion), matrix);
    gl.uniform1f(this.path.at.now, pose.share);
    gl.uniform3f(this.path.at.ink, 0.79, 0.25, 0.37);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, this.ribbon(motion).count);
    const tip = arrow(pose);
    if (tip.length) {
      this.use(this.path, this.mark, matrix);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.mark.buffers[0]);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(tip.flatMap(([x, z]) => [x, z, 0])), gl.DYNAMIC_DRAW);
      gl.uniform3f(this.path.at.ink, 0.20, 0.23, 0.28);
      gl.drawArrays(gl.TRIANGLE_FAN, 0, 4);
    }
    this.drawBody(camera, matrix, pose);
  }

  use(shader, mesh, matrix) {
    this.gl.useProgram(shader.program);
    this.gl.bindVertexArray(mesh.array);
    this.gl.uniformMatrix4fv(shader.at.camera, false, matrix);
  }

  drawBody(camera, matrix, pose) {
    const gl = this.gl, at = this.body.at;
    for (let j = 0; j < JOINTS; j++) {
      const m = pose.rotations[j], back = turn(m, ...data.rest[j]);
      for (let r = 0; r < 3; r++) {
        this.bones.set([m[3 * r], m[3 * r + 1], m[3 * r + 2], pose.places[j][r] - back[r]], 12 * j + 4 * r);
      }
    }
    this.use(this.body, this.skin, matrix);
    gl.uniform4fv(at.bones, this.bones);
    gl.uniform1f(at.unit, data.body.unit);
    gl.uniform3f(at.sun, ...SUN);
    gl.uniform3f(at.eye, ...camera.eye);
    gl.uniform2f(at.contacts, ...pose.contacts);
    gl.uniform3fv(at.tints, TINTS.flat());
    gl.uniform1i(at.shadow, 1);
    gl.enable(gl.STENCIL_TEST); // each pixel of the shadow darkens once
    gl.stencilFunc(gl.EQUAL, 0, 255);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    gl.drawElements(gl.TRIANGLES, this.skin.count, gl.UNSIGNED_SHORT, 0);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.uniform1i(at.shadow, 0);
    gl.drawElements(gl.TRIANGLES, this.skin.count, gl.UNSIGNED_SHORT, 0);
  }
}
