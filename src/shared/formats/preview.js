// The preview's page: one card a motion, one clock and one camera for all of them.

const START = { yaw: 0.5, pitch: 0.2, zoom: 1 };
const DISTANCE = 4.9, MIDDLE = 0.95; // metres to the body, height that the camera looks at
const DURATION = Math.max(...MOTIONS.map((motion) => motion.seconds));
const FRAME = 1 / Math.max(...MOTIONS.map((motion) => motion.fps));
const state = { ...START, time: 0, speed: 1, playing: true, follow: true, dirty: true };
const find = (id) => document.getElementById(id);
const board = document.querySelector("main");
const scrub = find("scrub");
const SLOW = 300; // milliseconds for one picture of all cards
let slowPictures = 0;
let paintBody = makeMeshPainter() || paintLimbs;

// ---------------------------------------------------------------- cards

const cards = MOTIONS.map((motion, index) => {
  const make = (tag, parent) => parent.appendChild(document.createElement(tag));
  const figure = make("figure", board), canvas = make("canvas", figure);
  const caption = make("figcaption", figure), text = make("span", caption);
  text.textContent = motion.text || `motion ${index + 1}`;
  text.dir = "auto";
  make("small", caption).textContent = `${(motion.frames / motion.fps).toFixed(1)} s`;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", text.textContent);
  const x = [], z = [];
  for (let i = 0; i < motion.root.length; i += 3) { x.push(motion.root[i]); z.push(motion.root[i + 2]); }
  const low = [Math.min(...x), Math.min(...z)], high = [Math.max(...x), Math.max(...z)];
  const middle = [(low[0] + high[0]) / 2, MIDDLE, (low[1] + high[1]) / 2];
  const span = Math.hypot(high[0] - low[0], high[1] - low[1]);
  steer(canvas);
  return { motion, canvas, middle, span, context: canvas.getContext("2d") };
});
document.title = `${cards[0].canvas.getAttribute("aria-label")} – motion preview`;

/** As many columns as make the cards largest; where they do not fit, the page scrolls. */
function arrange() {
  const { clientWidth: width, clientHeight: height } = board, count = cards.length;
  let best = 1, most = 0;
  for (let columns = 1; columns <= count; columns++) {
    const tall = height / Math.ceil(count / columns) - 50;
    const size = Math.min(tall, (width / columns) * 1.25);
    if (size > most + 1) [best, most] = [columns, size];
  }
  if (most < 190) best = Math.max(1, Math.min(count, Math.floor(width / 260)));
  board.style.gridTemplateColumns = `repeat(${best}, minmax(0, 1fr))`;
  board.classList.toggle("long", board.scrollHeight > board.clientHeight + 1);
  state.dirty = true;
}

function draw({ motion, canvas, context, middle, span }) {
  const box = canvas.getBoundingClientRect();
  if (box.bottom < 0 || box.top > innerHeight || box.width < 2 || box.height < 2) return;
  const pixel = Math.min(devicePixelRatio || 1, 2);
  const width = Math.round(box.width * pixel), height = Math.round(box.height * pixel);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const pose = poseAt(motion, state.time);
  const [x, , z] = pose.positions[0];
  const target = state.follow ? [x, MIDDLE, z] : middle;
  const narrow = Math.max(1, (0.7 * height) / width);
  const distance = (DISTANCE * narrow + (state.follow ? 0 : 1.2 * span)) / state.zoom;
  const view = makeView(state.yaw, state.pitch, distance, target, width, height);
  drawFloor(context, view, pixel);
  drawTrail(context, view, motion, state.time, pixel);
  paintBody(context, view, pose);
}

// ---------------------------------------------------------------- clock

function setTime(time) {
  state.time = Math.min(Math.max(time, 0), DURATION);
  state.dirty = true;
}

function setPlaying(playing) {
  state.playing = playing;
  find("play").textContent = playing ? "Pause" : "Play";
}

let before = null;
function tick(now) {
  if (state.playing && before !== null && DURATION > 0) {
    const time = state.time + (state.speed * Math.min(now - before, 250)) / 1000;
    setTime(time > DURATION ? 0 : time);
  }
  before = now;
  if (state.dirty) {
    state.dirty = false;
    const start = performance.now();
    cards.forEach(draw);
    slowPictures = performance.now() - start > SLOW ? slowPictures + 1 : 0;
    if (slowPictures > 3) paintBody = paintLimbs; // WebGL without a graphics card
    scrub.value = state.time;
    find("clock").textContent = `${state.time.toFixed(2)} / ${DURATION.toFixed(2)} s`;
  }
  requestAnimationFrame(tick);
}

// ---------------------------------------------------------------- mouse, touch, keys

/** One pointer orbits, two pinch, the wheel zooms; all cards turn together. */
function steer(canvas) {
  const pointers = new Map();
  const gap = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const wide = pointers.size === 2 ? gap() : 0;
    pointers.set(event.pointerId, event);
    if (wide) zoomBy(gap() / wide);
    else orbit(event.clientX - last.clientX, event.clientY - last.clientY);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", (event) => {
    if (board.classList.contains("long") && !event.ctrlKey) return; // the page scrolls
    event.preventDefault();
    zoomBy(Math.exp(-Math.max(-100, Math.min(100, event.deltaY)) / 400));
  }, { passive: false });
}

function orbit(right, down) {
  state.yaw -= right * 0.008;
  state.pitch = Math.min(1.55, Math.max(0.02, state.pitch + down * 0.008));
  state.dirty = true;
}

function zoomBy(factor) {
  state.zoom = Math.min(6, Math.max(0.15, state.zoom * factor));
  state.dirty = true;
}

function step(seconds) {
  setPlaying(false);
  setTime(state.time + seconds);
}

const KEYS = {
  ArrowLeft: (event) => step(event.shiftKey ? -10 * FRAME : -FRAME),
  ArrowRight: (event) => step(event.shiftKey ? 10 * FRAME : FRAME),
  Home: () => step(-DURATION),
  End: () => step(DURATION),
  " ": () => setPlaying(!state.playing),
  "+": () => zoomBy(1.15),
  "-": () => zoomBy(1 / 1.15),
  f: () => find("follow").click(),
  r: () => find("reset").click(),
};
addEventListener("keydown", (event) => {
  const { tagName, type } = event.target;
  const own = tagName === "SELECT" || (event.key === " " && (tagName === "BUTTON" || type === "checkbox"));
  if (own || event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(KEYS, event.key)) return;
  event.preventDefault();
  KEYS[event.key](event);
});

find("play").addEventListener("click", () => setPlaying(!state.playing));
find("speed").addEventListener("change", (event) => { state.speed = Number(event.target.value); });
find("reset").addEventListener("click", () => { Object.assign(state, START, { dirty: true }); });
find("follow").addEventListener("change", (event) => {
  Object.assign(state, { follow: event.target.checked, dirty: true });
});
scrub.max = DURATION;
scrub.addEventListener("input", () => {
  setPlaying(false);
  setTime(Number(scrub.value));
});
board.addEventListener("scroll", () => { state.dirty = true; });
new ResizeObserver(arrange).observe(board);

// `#t=1.5` opens the page paused at 1.5 seconds.
const wanted = /[#&]t=([\d.]+)/.exec(location.hash);
if (wanted) setTime(Number(wanted[1]) || 0);
setPlaying(!wanted && !matchMedia("(prefers-reduced-motion: reduce)").matches);
arrange();
requestAnimationFrame(tick);
