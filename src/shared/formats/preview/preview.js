// The preview's page: one card a motion, one clock and one camera for all of them.

const STAGE = MOTIONS.every((motion) => motion.figures); // seen from the front, as a whole
const HIGH = DATA.palette && !STAGE; // a path is seen from higher
const START = { yaw: STAGE ? 0 : 0.5, pitch: HIGH ? 0.42 : 0.2, zoom: 1 };
const DISTANCE = 4.9, MIDDLE = 0.95; // metres to the body, height that the camera looks at
const ARM = 0.7; // metres from the pelvis's way that a stage shows, at least
const FRAME = 1 / Math.max(...MOTIONS.map((motion) => motion.fps));
Object.assign(state, START, { follow: !STAGE });
find("follow").checked = state.follow;
const board = document.querySelector("main");
const scrub = find("scrub");
const SLOW = 300; // milliseconds for one picture of all cards
let slowPictures = 0;
let paintBody = makeMeshPainter() || paintLimbs;

// ---------------------------------------------------------------- cards

const cards = MOTIONS.map((motion, index) => {
  const make = (tag, parent) => parent.appendChild(document.createElement(tag));
  const figure = make("figure", board), canvas = make("canvas", figure);
  const strip = motion.phase ? make("canvas", figure).getContext("2d") : null;
  const buttons = motion.figures?.length ? makeFigures(make("ol", figure), motion) : [];
  const caption = make("figcaption", figure), text = make("span", caption);
  text.textContent = motion.text || `motion ${index + 1}`;
  text.dir = "auto";
  make("small", caption).textContent = `${(motion.frames / motion.fps).toFixed(1)} s`;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", text.textContent);
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  motion.root.forEach((value, i) => {
    if (i % 3 === 1) return; // the height
    low[(i % 3) / 2] = Math.min(low[(i % 3) / 2], value);
    high[(i % 3) / 2] = Math.max(high[(i % 3) / 2], value);
  });
  const middle = [(low[0] + high[0]) / 2, MIDDLE, (low[1] + high[1]) / 2];
  const span = Math.hypot(high[0] - low[0], high[1] - low[1]);
  const side = (high[0] - low[0]) / 2 + ARM;
  steer(canvas);
  if (strip) makeStrip(strip.canvas, motion);
  return { motion, middle, span, side, strip, buttons, figure: -1, context: canvas.getContext("2d") };
});
document.title = `${cards[0].context.canvas.getAttribute("aria-label")} – motion preview`;

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

/** Width and height in real pixels, which the canvas gets; null where it cannot be seen. */
function fit(canvas, pixel) {
  const box = canvas.getBoundingClientRect();
  if (box.bottom < 0 || box.top > innerHeight || box.width < 2 || box.height < 2) return null;
  const width = Math.round(box.width * pixel), height = Math.round(box.height * pixel);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return [width, height];
}

function draw(card) {
  const { motion, context, strip, middle, span, side } = card;
  const pixel = Math.min(devicePixelRatio || 1, 2), size = fit(context.canvas, pixel);
  const stripSize = strip && fit(strip.canvas, pixel);
  if (card.buttons.length) markFigure(card, state.time);
  if (stripSize) drawStrip(strip, motion, Math.min(state.time, motion.seconds), ...stripSize, pixel);
  if (!size) return;
  const [width, height] = size;
  const pose = poseAt(motion, state.time);
  const [x, , z] = pose.positions[0];
  const target = state.follow ? [x, MIDDLE, z] : middle;
  const narrow = Math.max(1, (0.7 * height) / width);
  const wide = (side * height) / width / Math.tan(FIELD_OF_VIEW / 2) + span / 2;
  const away = motion.figures ? Math.max(DISTANCE + span / 2, wide) : DISTANCE * narrow + 1.2 * span;
  const distance = (state.follow ? DISTANCE * narrow : away) / state.zoom;
  const view = makeView(state.yaw, state.pitch, distance, target, width, height);
  drawFloor(context, view, pixel);
  if (motion.figures) drawStage(context, view, middle, Math.max(1, span / 2 + 0.3), pixel);
  drawTrail(context, view, motion, state.time, pixel);
  paintBody(context, view, pose);
  if (!motion.phase) return;
  if (motion.meter) drawDial(context, view, motion, Math.min(state.time, motion.seconds), pixel);
  if (!motion.figures) drawStyle(context, view, motion, Math.min(state.time, motion.seconds), pixel);
}

// ---------------------------------------------------------------- time

let before = null;
function tick(now) {
  if (state.playing && before !== null) advance(Math.min(now - before, 250) / 1000);
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
  seek(state.time + seconds);
}

const KEYS = {
  ArrowLeft: (event) => step(event.shiftKey ? -10 * FRAME : -FRAME),
  ArrowRight: (event) => step(event.shiftKey ? 10 * FRAME : FRAME),
  Home: () => step(-DURATION),
  End: () => step(DURATION),
  " ": () => setPlaying(!state.playing),
  "[": () => seek(state.time - 5),
  "]": () => seek(state.time + 5),
  l: () => find("loop").click(),
  m: () => find("sound").click(),
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
find("speed").addEventListener("change", (event) => setSpeed(Number(event.target.value)));
find("reset").addEventListener("click", () => { Object.assign(state, START, { dirty: true }); });
find("follow").addEventListener("change", (event) => {
  Object.assign(state, { follow: event.target.checked, dirty: true });
});
find("loop").addEventListener("change", (event) => { state.loop = event.target.checked; });
find("sound").addEventListener("change", (event) => { if (song) song.muted = !event.target.checked; });
find("sound").parentElement.hidden = !song;
scrub.max = DURATION;
scrub.addEventListener("input", () => {
  seek(Number(scrub.value));
});
board.addEventListener("scroll", () => { state.dirty = true; });
// In the next frame: arranging within the observer's turn can change what it observes.
new ResizeObserver(() => requestAnimationFrame(arrange)).observe(board);

// `#t=1.5` opens the page paused at 1.5 seconds. Browsers let no song start by itself.
const wanted = /[#&]t=([\d.]+)/.exec(location.hash);
if (wanted) seek(Number(wanted[1]) || 0);
setPlaying(!wanted && !song && !matchMedia("(prefers-reduced-motion: reduce)").matches);
arrange();
requestAnimationFrame(tick);
