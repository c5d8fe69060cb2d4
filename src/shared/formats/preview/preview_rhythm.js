// What the preview shows of the music: the bar-phase dial, beats on the path, the speed strip.
// Only cards whose motion has a phase show it: the place in the bar in [0, 1), 0 the downbeat.

const PHASE_STEPS = 65536; // stored phase: 16 bits a bar
const AHEAD = 4; // seconds of coming beats that are marked on the floor
const STRIP_SECONDS = 12; // the strip scrolls past this
const GLOW = 0.18; // seconds that a beat lights up

for (const motion of MOTIONS) {
  if (!motion.phase) continue;
  motion.beats = decode(motion.beats, Float32Array);
  motion.downbeat = decode(motion.downbeat, Uint8Array);
  motion.phase = decode(motion.phase, Uint16Array);
  motion.speed = decode(motion.speed, Uint16Array);
  motion.style = decode(motion.style, Uint8Array);
  motion.times = (motion.figures || []).map((figure) => figure.times);
  motion.fastest = Math.max(1, motion.speed.reduce((most, x) => Math.max(most, x), 0) / 1000);
}

/** A colour for each place in the bar. */
function phaseColour(phase) {
  return DATA.palette[Math.floor(phase * DATA.palette.length) % DATA.palette.length];
}

/** Phase at a frame, whole or not; the way over a bar line is the short one. */
function phaseAt(motion, frame) {
  const at = Math.min(Math.max(frame, 0), motion.frames - 1), i = Math.floor(at);
  const a = motion.phase[i], b = motion.phase[Math.min(i + 1, motion.frames - 1)];
  const step = ((b - a + 1.5 * PHASE_STEPS) % PHASE_STEPS) - PHASE_STEPS / 2;
  return ((a + (at - i) * step + PHASE_STEPS) / PHASE_STEPS) % 1;
}

/** Index of the first beat that is not before a time. */
function beatAfter({ beats }, time) {
  let low = 0, high = beats.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (beats[middle] < time) low = middle + 1; else high = middle;
  }
  return low;
}

/** What a dancer says on count i of a figure: to six in twos of threes, else to eight. */
function counted(i, counts) {
  return i % ((counts.length - 1) % 6 === 0 ? 6 : 8) + 1;
}

/** Number of the figure that is danced at a time, -1 where none is, and which of its counts. */
function danced({ times }, time) {
  const at = times.findIndex((counts) => counts[0] <= time && time < counts[counts.length - 1]);
  return [at, at < 0 ? 0 : counted(times[at].findIndex((count) => count > time) - 1, times[at])];
}

/** The walked path in the colours of the bar, with a dot on the floor at each beat. */
function drawBeatTrail(context, view, motion, start, now, pixel) {
  for (let frame = start; frame < now; frame++) {
    context.strokeStyle = phaseColour(phaseAt(motion, frame));
    context.beginPath();
    addPath(context, view, motion, frame, Math.min(frame + 1, now), 1);
    context.stroke();
  }
  const last = now / motion.fps + (motion.figures ? 0 : AHEAD);
  for (let i = beatAfter(motion, start / motion.fps); motion.beats[i] <= last; i++) {
    const frame = motion.beats[i] * motion.fps;
    const [x, y, depth, scale] = view.project(floorAt(motion, frame));
    if (depth < NEAR) continue;
    const radius = Math.min(9 * pixel, scale * (motion.downbeat[i] ? 0.045 : 0.025));
    context.fillStyle = frame <= now ? phaseColour(phaseAt(motion, frame)) : "#c5cad3";
    context.beginPath();
    context.ellipse(x, y, radius, radius * Math.max(0.3, view.ahead[1]), 0, 0, 2 * Math.PI);
    context.fill();
    if (motion.downbeat[i]) { context.strokeStyle = "#343a44"; context.lineWidth = pixel; context.stroke(); }
  }
  context.lineWidth = 2.5 * pixel;
}

/** A dial in the corner: the hand goes round once a bar, the hub lights up at the song's beats. */
function drawDial(context, view, motion, time, pixel) {
  const radius = Math.min(38 * pixel, 0.14 * Math.min(view.width, view.height));
  const x = view.width - radius - 14 * pixel, y = radius + 14 * pixel;
  const phase = phaseAt(motion, time * motion.fps), top = -Math.PI / 2;
  const angle = (share) => top + 2 * Math.PI * share;
  const arc = (r, from, to) => { context.beginPath(); context.arc(x, y, r, angle(from), angle(to)); };
  const ray = (share, from, to) => {
    const [c, s] = [Math.cos(angle(share)), Math.sin(angle(share))];
    context.beginPath();
    context.moveTo(x + from * c, y + from * s);
    context.lineTo(x + to * c, y + to * s);
    context.stroke();
  };
  context.fillStyle = "rgba(255, 255, 255, 0.85)";
  arc(radius + 6 * pixel, 0, 1);
  context.fill();
  context.lineCap = "butt";
  context.lineWidth = 6 * pixel;
  DATA.palette.forEach((colour, i) => { // the ring, strong where the bar has been
    const share = i / DATA.palette.length;
    context.globalAlpha = share < phase ? 1 : 0.3;
    context.strokeStyle = colour;
    arc(radius, share, share + 1 / DATA.palette.length);
    context.stroke();
  });
  context.globalAlpha = 1;
  context.strokeStyle = "#343a44";
  for (let beat = 0; beat < motion.meter; beat++) {
    context.lineWidth = (beat ? 1.5 : 3) * pixel;
    ray(beat / motion.meter, radius - 6 * pixel, radius + 4 * pixel);
  }
  const glow = glowAt(motion, time);
  context.fillStyle = `rgba(47, 111, 208, ${0.12 + 0.75 * glow})`;
  arc(radius * (0.42 + 0.12 * glow), 0, 1);
  context.fill();
  context.lineCap = "round";
  context.lineWidth = 2.5 * pixel;
  ray(phase, radius * 0.5, radius - 1 * pixel);
  context.fillStyle = glow > 0.5 ? "#fff" : "#343a44";
  context.font = `600 ${Math.round(radius * 0.46)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  const [figure, count] = danced(motion, time);
  context.fillText(String(figure < 0 ? Math.floor(phase * motion.meter) + 1 : count), x, y);
}

/** Under the dial: how much of each named pair the style has, 0 to 1, a mark at the middle. */
function drawStyle(context, view, motion, time, pixel) {
  const names = DATA.pairs, bar = 56 * pixel, line = 15 * pixel;
  if (view.width < 300 * pixel || view.height < 260 * pixel) return;
  const right = view.width - 14 * pixel, frame = Math.round(time * motion.fps);
  context.font = `${11 * pixel}px system-ui, sans-serif`;
  context.textAlign = "right";
  context.textBaseline = "middle";
  names.forEach((name, i) => {
    const y = 112 * pixel + i * line, left = right - bar;
    context.fillStyle = "#6b7380";
    context.fillText(name, left - 6 * pixel, y);
    context.fillStyle = "#dfe3e9";
    context.fillRect(left, y - 2 * pixel, bar, 4 * pixel);
    context.fillStyle = "#2f6fd0";
    context.fillRect(left, y - 2 * pixel, (bar * motion.style[4 * frame + i]) / 255, 4 * pixel);
    context.fillStyle = "#343a44";
    context.fillRect(left + bar / 2, y - 4 * pixel, pixel, 8 * pixel);
  });
}

/** How brightly the last beat still shines, 0 to 1; other beats than the first shine less. */
function glowAt(motion, time) {
  const i = beatAfter(motion, time + 1e-4) - 1;
  if (i < 0) return 0;
  return Math.max(0, 1 - (time - motion.beats[i]) / GLOW) * (motion.downbeat[i] ? 1 : 0.6);
}

/** Seconds at the left and right edge of the strip: it scrolls when the motion is long. */
function stripRange(motion, time) {
  if (motion.seconds <= STRIP_SECONDS) return [0, Math.max(motion.seconds, 0.1)];
  const start = Math.min(Math.max(time - STRIP_SECONDS / 2, 0), motion.seconds - STRIP_SECONDS);
  return [start, start + STRIP_SECONDS];
}

/** Pelvis speed over time, filled in the colours of the bar, under the beats. */
function drawStrip(context, motion, time, width, height, pixel) {
  const [start, end] = stripRange(motion, time), top = 14 * pixel;
  const across = (t) => ((t - start) / (end - start)) * width;
  const rise = (frame) => height - (motion.speed[frame] / 1000 / motion.fastest) * (height - top);
  context.clearRect(0, 0, width, height);
  const first = Math.max(0, Math.floor(start * motion.fps));
  const last = Math.min(motion.frames - 1, Math.ceil(end * motion.fps));
  const rim = new Path2D();
  for (let frame = first; frame <= last; frame++) {
    const x = across(frame / motion.fps), next = Math.min(frame + 1, motion.frames - 1);
    rim.lineTo(x, rise(frame));
    context.fillStyle = phaseColour(phaseAt(motion, frame + 0.5));
    context.beginPath();
    context.moveTo(x, height);
    context.lineTo(x, rise(frame));
    context.lineTo(across((frame + 1) / motion.fps) + 0.7, rise(next)); // no gap to the next one
    context.lineTo(across((frame + 1) / motion.fps) + 0.7, height);
    context.fill();
  }
  context.fillStyle = "rgba(255, 255, 255, 0.5)";
  context.fillRect(0, top, width, height - top);
  context.strokeStyle = "#343a44";
  context.lineWidth = 1.2 * pixel;
  context.stroke(rim);
  for (let i = beatAfter(motion, start); motion.beats[i] <= end; i++) {
    const strong = motion.downbeat[i];
    context.fillStyle = strong ? "#343a44" : "#9aa2ae";
    context.fillRect(across(motion.beats[i]), 0, (strong ? 2 : 1) * pixel, (strong ? 12 : 7) * pixel);
  }
  context.font = `${10 * pixel}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const counts of motion.times) {
    if (counts[counts.length - 1] < start || counts[0] > end) continue;
    context.fillStyle = "#2f6fd0";
    context.fillRect(across(counts[0]), 0, pixel, height);
    counts.slice(0, -1).forEach((count, i) => {
      context.fillText(String(counted(i, counts)), across(count) + 6 * pixel, 1.5 * pixel);
    });
  }
  context.fillStyle = "#c83c5a";
  context.fillRect(across(time) - pixel, 0, 2 * pixel, height);
  const now = Math.min(motion.frames - 1, Math.round(time * motion.fps));
  context.fillStyle = "#343a44";
  context.font = `${11 * pixel}px system-ui, sans-serif`;
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillText(`${(motion.speed[now] / 1000).toFixed(2)} m/s`, 6 * pixel, height - 4 * pixel);
}

/** The figures of a dance in a row that scrolls, each a button that goes to its beginning. */
function makeFigures(row, motion) {
  row.className = "figures";
  row.setAttribute("aria-label", "Figures");
  return motion.figures.map(({ kind, mirrored, name, part, start, steps }) => {
    const make = (tag, parent, text) => {
      const made = parent.appendChild(document.createElement(tag));
      made.textContent = text;
      return made;
    };
    const item = row.appendChild(document.createElement("li"));
    const button = make("button", item, "");
    button.type = "button";
    if (mirrored) button.title = "left and right swapped";
    make("b", button, `${kind}${steps ? " (steps)" : ""}${mirrored ? " ⇄" : ""}`);
    const seconds = String(Math.floor(start % 60)).padStart(2, "0");
    const when = `${Math.floor(start / 60)}:${seconds}`;
    make("small", button, `${when} ${part.replace("'", "′")} · ${name}`);
    button.addEventListener("click", () => seek(start));
    return button;
  });
}

/** Mark the button of the figure that is danced now, and keep it in sight. */
function markFigure(card, time) {
  const [now] = danced(card.motion, time);
  if (now === card.figure) return;
  card.buttons[card.figure]?.removeAttribute("aria-current");
  card.figure = now;
  if (now < 0) return;
  const button = card.buttons[now], row = button.closest(".figures");
  button.setAttribute("aria-current", "true");
  row.scrollLeft = button.offsetLeft - (row.clientWidth - button.offsetWidth) / 2;
}

/** A strip under the picture; a click goes to its time. */
function makeStrip(canvas, motion) {
  canvas.className = "strip";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "Speed over time, with beats");
  canvas.addEventListener("click", (event) => {
    const box = canvas.getBoundingClientRect(), [start, end] = stripRange(motion, state.time);
    seek(start + ((event.clientX - box.left) / box.width) * (end - start));
  });
}
