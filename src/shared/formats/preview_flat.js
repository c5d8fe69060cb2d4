// Canvas 2D, for browsers without WebGL: the same body as round-ended cones, far to near.

class FlatRenderer {
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
  }

  begin(width, height, ratio) {
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.pen.fillStyle = css(PAGE);
    this.pen.fillRect(0, 0, width, height);
  }

  draw(box, camera, motion, pose) {
    const pen = this.pen;
    pen.save();
    pen.beginPath();
    pen.rect(box.left, box.top, box.width, box.height);
    pen.clip();
    pen.translate(box.left, box.top);
    pen.lineCap = "round";
    const project = (p) => camera.project(p, box.width, box.height);
    this.drawFloor(camera, project);
    this.drawPath(motion, pose, project);
    const cones = data.cones.map((cone) => this.place(cone, pose, project));
    for (const { a, b } of cones) {
      const flat = [a, b].map((p) => project([0, 1, 2].map((i) => (i === 1 ? 0 : p.at[i] - SUN[i] / SUN[1] * Math.max(p.at[1], 0)))));
      this.line(flat[0], flat[1], (a.radius + b.radius) * flat[0][3], "rgba(60,68,84,0.10)");
    }
    cones.sort((p, q) => q.depth - p.depth);
    for (const cone of cones) this.drawCone(cone);
    pen.restore();
  }

  place(cone, pose, project) {
    const ball = (local, radius) => {
      const moved = turn(pose.rotations[cone.joint], ...local);
      const at = pose.places[cone.joint].map((v, i) => v + moved[i]);
      return { at, radius, screen: project(at) };
    };
    const a = ball(cone.start, cone.radii[0]), b = ball(cone.end, cone.radii[1]);
    const touch = { 7: 0, 10: 0, 8: 1, 11: 1 }[cone.joint];
    const grounded = touch !== undefined && pose.contacts[touch] > 0.5;
    const tint = TINTS[grounded ? 3 : cone.side + 1];
    return { a, b, tint, width: cone.width, depth: (a.screen[2] + b.screen[2]) / 2 };
  }

  drawCone({ a, b, tint, width }) {
    const [x0, y0, , s0] = a.screen, [x1, y1, , s1] = b.screen, pen = this.pen;
    const wide = 1 + (width - 1) * 0.5, r0 = a.radius * s0 * wide, r1 = b.radius * s1 * wide;
    const shape = (k, dx, dy) => {
      const angle = Math.atan2(y1 - y0, x1 - x0), gap = Math.hypot(x1 - x0, y1 - y0);
      const lean = Math.acos(clamp((r0 - r1) / Math.max(gap, 1e-6), -1, 1));
      pen.beginPath();
      pen.arc(x0 + dx, y0 + dy, r0 * k, angle + lean, angle - lean);
      pen.arc(x1 + dx, y1 + dy, r1 * k, angle - lean, angle + lean);
      pen.fill();
    };
    for (const [size, light] of [[1, 0.66], [0.90, 0.84], [0.70, 0.98], [0.40, 1.08]]) {
      pen.fillStyle = css(tint.map((v) => Math.min(1, v * light)));
      const lift = (1 - size) * Math.min(r0, r1) * 0.6;
      shape(size, lift * 0.5, -lift);
    }
  }

  line(a, b, width, style) {
    this.pen.strokeStyle = style;
    this.pen.lineWidth = width;
    this.pen.beginPath();
    this.pen.moveTo(a[0], a[1]);
    this.pen.lineTo(b[0], b[1]);
    this.pen.stroke();
  }

  drawFloor(camera, project) {
    const reach = 3, [cx, cz] = [camera.target[0], camera.target[2]].map((v) => Math.round(v * 2) / 2);
    for (let i = -reach; i <= reach; i += 0.5) {
      const style = Number.isInteger(i + cx) ? "#cdd3dd" : "#e1e5eb";
      this.line(project([cx + i, 0, cz - reach]), project([cx + i, 0, cz + reach]), 1, style);
      this.line(project([cx - reach, 0, cz + i]), project([cx + reach, 0, cz + i]), 1, style);
    }
  }

  drawPath(motion, pose, project) {
    const r = motion.root, now = pose.share * (motion.frames - 1);
    for (let t = 0; t + 1 < motion.frames; t++) {
      const [a, b] = [t, t + 1].map((k) => project([r[3 * k], 0, r[3 * k + 2]]));
      if (Math.min(a[2], b[2]) > 0.1) this.line(a, b, 2.5, t <= now ? "rgba(201,64,94,0.85)" : "rgba(201,64,94,0.25)");
    }
    const tip = arrow(pose).map(([x, z]) => project([x, 0, z]));
    this.pen.fillStyle = "#333b47";
    this.pen.beginPath();
    for (const [x, y] of tip) this.pen.lineTo(x, y);
    this.pen.fill();
  }
}

const css = (rgb) => `rgb(${rgb.map((v) => Math.round(v * 255)).join(",")})`;
