// The page: one cell a motion, one clock for all, one camera that all cells share.

const PAGE = [0.957, 0.961, 0.973];
const SUN = unit([0.35, 1.0, 0.45]);
const TINTS = data.tints; // right, trunk, left, contact
const HOME = { azimuth: 0.5, elevation: 0.2, distance: 4.1 };

// Time in seconds. Whatever has these members can drive the page, an <audio> element's wrapper too.
class Clock {
  constructor(length) {
    this.length = length;
    this.time = 0;
    this.rate = 1;
    this.playing = false;
    this.before = 0;
  }
  play() { this.playing = true; }
  pause() { this.playing = false; }
  seek(time) { this.time = clamp(time, 0, this.length); }
  tick(stamp) {
    const passed = Math.min((stamp - this.before) / 1000, 0.1);
    this.before = stamp;
    if (!this.playing || !this.length) return;
    this.time += passed * this.rate;
    if (this.time > this.length) this.time %= this.length;
  }
}

const byId = (id) => document.getElementById(id);
const canvas = byId("view"), grid = byId("grid"), scrub = byId("scrub"), follow = byId("follow");
const motions = data.motions.map((raw) => new Motion(raw));
const clock = new Clock(Math.max(...motions.map((motion) => motion.seconds)));
const view = { ...HOME };
let renderer, dirty = true;

try {
  renderer = new GlRenderer(canvas);
} catch (error) {
  const fresh = canvas.cloneNode();
  canvas.replaceWith(fresh); // a canvas that was asked for WebGL gives no 2D pen
  renderer = new FlatRenderer(fresh);
}

const cells = motions.map((motion) => {
  const figure = document.createElement("figure"), stage = document.createElement("div");
  const caption = document.createElement("figcaption");
  stage.className = "stage";
  caption.textContent = motion.text || "motion";
  figure.append(stage, caption);
  grid.append(figure);
  return { motion, stage, bounds: motion.bounds() };
});

function layout() {
  const most = Math.max(1, Math.floor(innerWidth / 270));
  const wanted = cells.length <= 3 ? cells.length : cells.length <= 8 ? Math.ceil(cells.length / 2) : 4;
  const columns = Math.min(most, wanted), rows = Math.ceil(cells.length / columns);
  const bar = byId("bar").offsetHeight;
  document.body.style.paddingBottom = `${bar}px`;
  grid.style.setProperty("--columns", columns);
  const height = Math.floor((innerHeight - bar - 10) / Math.min(rows, 2)) - 10;
  grid.style.setProperty("--height", `${Math.max(height, 260)}px`);
  document.body.classList.toggle("whole", document.documentElement.scrollHeight <= innerHeight + 1);
  dirty = true;
}

function render() {
  const ratio = Math.min(devicePixelRatio || 1, 2), width = innerWidth, height = innerHeight;
  const target = renderer.canvas;
  if (target.width !== Math.round(width * ratio) || target.height !== Math.round(height * ratio)) {
    target.width = Math.round(width * ratio);
    target.height = Math.round(height * ratio);
  }
  renderer.begin(width, height, ratio);
  for (const { motion, stage, bounds } of cells) {
    const box = stage.getBoundingClientRect();
    if (box.bottom < 0 || box.top > height || !box.width || !box.height) continue;
    const pose = motion.pose(clock.time);
    const [x, z] = follow.checked ? pose.calm : bounds.middle;
    const distance = view.distance + (follow.checked ? 0 : 2.2 * bounds.reach);
    const lens = { ...view, distance };
    renderer.draw(box, new Camera([x, 0.88, z], lens, box.width / box.height), motion, pose);
  }
}

function frame(stamp) {
  clock.tick(stamp);
  if (clock.playing || dirty) {
    dirty = false;
    render();
    scrub.value = clock.length ? clock.time / clock.length : 0;
    byId("time").textContent = `${clock.time.toFixed(2)} / ${clock.length.toFixed(2)} s`;
  }
  requestAnimationFrame(frame);
}

function toggle(on = !clock.playing) {
  if (on) clock.play(); else clock.pause();
  byId("play").textContent = on ? "Pause" : "Play";
  dirty = true;
}

function step(frames) {
  toggle(false);
  clock.seek(clock.time + frames / motions[0].fps);
}

function orbit(dx, dy) {
  view.azimuth -= dx * 0.008;
  view.elevation = clamp(view.elevation + dy * 0.006, 0.02, 1.5);
  dirty = true;
}

function zoom(factor) {
  view.distance = clamp(view.distance * factor, 1.2, 25);
  dirty = true;
}

const fingers = new Map();
grid.addEventListener("pointerdown", (event) => {
  if (!event.target.classList.contains("stage")) return;
  event.target.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, [event.clientX, event.clientY]);
});
grid.addEventListener("pointermove", (event) => {
  const before = fingers.get(event.pointerId);
  if (!before) return;
  const now = [event.clientX, event.clientY];
  if (fingers.size === 1) orbit(now[0] - before[0], now[1] - before[1]);
  else {
    const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const gap = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
    zoom(gap(before) / gap(now));
  }
  fingers.set(event.pointerId, now);
});
for (const name of ["pointerup", "pointercancel"]) {
  grid.addEventListener(name, (event) => fingers.delete(event.pointerId));
}
grid.addEventListener("wheel", (event) => {
  // On a page that scrolls, a plain wheel scrolls; with ctrl (or a pinch) it zooms.
  if (!event.ctrlKey && !document.body.classList.contains("whole")) return;
  event.preventDefault();
  zoom(Math.exp(clamp(event.deltaY, -60, 60) * 0.004));
}, { passive: false });

const KEYS = {
  " ": () => toggle(),
  ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
  ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
  Home: () => { clock.seek(0); dirty = true; },
  End: () => { toggle(false); clock.seek(clock.length); },
  f: () => { follow.checked = !follow.checked; dirty = true; },
  r: () => byId("reset").click(),
};
addEventListener("keydown", (event) => {
  const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.target.tagName === "SELECT" || (event.key === " " && event.target.tagName === "BUTTON")) return;
  event.preventDefault();
  action(event);
});

byId("play").addEventListener("click", () => toggle());
byId("speed").addEventListener("change", (event) => { clock.rate = Number(event.target.value); });
byId("reset").addEventListener("click", () => { Object.assign(view, HOME); dirty = true; });
follow.addEventListener("change", () => { dirty = true; });
scrub.addEventListener("input", () => { toggle(false); clock.seek(Number(scrub.value) * clock.length); });
addEventListener("resize", layout);
addEventListener("scroll", () => { dirty = true; }, { passive: true });

layout();
toggle(!matchMedia("(prefers-reduced-motion: reduce)").matches);
requestAnimationFrame((stamp) => { clock.before = stamp; frame(stamp); });
