// The page: what is typed and drawn becomes a scene, the scene motions, the motions files.

import { readAvatar } from "../files/avatar.js";
import { writeBvh } from "../files/bvh.js";
import { readClip } from "../files/clip.js";
import { recordFilm } from "../files/film.js";
import { writeGlb } from "../files/glb.js";
import { FPS, useSkeleton } from "../body/skeleton.js";
import { lengthOf } from "../model/path.js";
import { Client } from "./client.js";
import { goLive } from "./live.js";
import { readPart, readParts } from "./parts.js";
import { examples, PATHS } from "./presets.js";
import { fromLink, History, isEmpty, LIMITS, spanOf, START, toLink, within } from "./scene.js";
import { Stage } from "./stage.js";
import { Timeline } from "./timeline.js";

const $ = (id) => document.getElementById(id);
const REMEMBERED = 24; // motions
const TOLD_EACH = 60; // milliseconds, while it plays, between what clock and slider say
const WALK = 1.1; // m/s
const TURN = 0.1; // radians a key press
const CHANGED = "Changed: Enter or Make makes it.";

export function openPage() {
  globalThis.studio = new Page(); // for scripts and tests
  globalThis.studio.open().catch((error) => {
    $("status").textContent = `The studio could not start: ${error.message}`;
    document.body.classList.add("failed");
  });
}

class Page {
  async open() {
    this.settings = JSON.parse($("settings").textContent);
    useSkeleton(this.settings.skeleton);
    this.motions = new Map();
    this.clips = new Map();
    this.clipBefore = null;
    this.selected = 0;
    this.time = 0;
    this.toldAt = -Infinity;
    this.history = new History(fromLink(location.hash) ?? START, () => this.changed());
    const scripts = ["script", "helper", "graphics-helper"].map((id) => $(id).textContent), parts = readParts(document), texts = this.scene.blocks.map(({ text }) => text);
    const opened = Client.open(scripts, this.settings, parts, texts); // its workers begin beside all that follows
    this.openStage();
    this.timeline = new Timeline($("timeline"), this);
    this.bind();
    this.changed();
    this.tell("Loading the model …");
    this.timings = { page: performance.now() };
    this.client = await opened;
    const { glb, vrma, licences } = await parts;
    Object.assign(this, { rest: { glb, vrma }, licences });
    this.timings.loaded = performance.now();
    document.body.classList.add("ready");
    $("make").disabled = $("live").disabled = false;
    await this.warn();
    await this.make();
  }

  get scene() {
    return this.history.now;
  }

  /** What is opened: { motion, name, number }. */
  get clip() {
    return this.clips.get(this.scene.clip) ?? null;
  }

  openStage() {
    try {
      this.stage = new Stage($("stage"), this.settings.body);
    } catch {
      $("no-stage").hidden = false; // the status line tells other things soon
      return;
    }
    $("stage").tabIndex = 0;
    new ResizeObserver(() => this.stage.resize()).observe($("stage").parentElement);
    this.stage.resize();
    let last = performance.now();
    const frame = (now) => {
      const step = (now - last) / 1000;
      last = now;
      if (this.shown && this.playing) this.seek((this.time + Math.min(step, 0.25)) % (this.seconds + 0.5), false);
      this.live?.tick();
      this.stage.draw($("follow").checked && !this.drawing, step, this.making && !this.live);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // ---------------------------------------------------------------- what is typed

  bind() {
    const text = $("text");
    text.addEventListener("input", () => {
      const long = text.value.length > LIMITS.text;
      this.editBlock({ text: text.value }, "text");
      if (long) this.tell(`A sentence has ${LIMITS.text} letters at most; what is beyond is cut off.`, "warning");
    });
    text.addEventListener("blur", () => this.history.rest());
    text.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && !event.shiftKey && !event.isComposing) { event.preventDefault(); this.make(); }
    });
    $("seconds").addEventListener("change", () => this.editBlock({ seconds: within($("seconds").valueAsNumber, LIMITS.seconds, this.scene.blocks[this.selected].seconds) }));
    $("seed").addEventListener("change", () => this.history.change({ seed: within($("seed").valueAsNumber, [0, LIMITS.seed], this.scene.seed) }));
    $("takes").addEventListener("change", () => this.history.change({ takes: $("takes").value, chosen: 0 }));
    $("dice").addEventListener("click", () => { this.history.change({ seed: Math.floor(Math.random() * 100000) }); this.make(); });
    $("make").addEventListener("click", () => this.make());
    $("live").addEventListener("click", () => goLive(this));
    $("stop").addEventListener("click", () => this.stop());
    $("add").addEventListener("click", () => this.addBlock());
    $("cut").addEventListener("click", () => this.cutBlock());
    $("earlier").addEventListener("click", () => this.moveBlock(this.selected, this.selected - 1));
    $("later").addEventListener("click", () => this.moveBlock(this.selected, this.selected + 1));
    $("remove").addEventListener("click", () => this.removeBlock());
    $("undo").addEventListener("click", () => this.history.undo());
    $("redo").addEventListener("click", () => this.history.redo());
    $("play").addEventListener("click", () => this.setPlaying(!this.playing));
    $("scrub").addEventListener("input", () => { this.setPlaying(false); this.seek($("scrub").valueAsNumber); });
    $("view").addEventListener("click", () => this.stage?.resetView());
    $("link").addEventListener("click", () => this.copyLink());
    for (const kind of ["bvh", "glb", "vrma"]) $(`save-${kind}`).addEventListener("click", () => this.save(kind));
    $("save-film").addEventListener("click", () => this.film());
    for (const [name, label] of Object.entries(PATHS)) $("path").add(new Option(label.label, name));
    $("path").querySelector("[value=draw]").disabled = !this.stage;
    $("path").querySelector("[value=clip]").hidden = true;
    $("path").addEventListener("change", () => this.choosePath($("path").value));
    for (const { language, prompt } of examples(this.settings.languages)) $("examples").add(new Option(`${language}: ${prompt}`, prompt));
    $("examples").addEventListener("change", () => {
      if ($("examples").value) { this.editBlock({ text: $("examples").value }); this.make(); }
      $("examples").value = "";
    });
    addEventListener("keydown", (event) => this.key(event));
    addEventListener("hashchange", () => {
      const scene = fromLink(location.hash);
      if (scene) { this.history.change(scene); this.make(); }
      else this.changed(); // the address says again what there is
    });
    this.bindStage();
    this.bindClips();
    $("licences").addEventListener("click", () => {
      $("notices").querySelector("pre").textContent = this.licences ? new TextDecoder().decode(this.licences) : "";
      $("notices").showModal();
    });
    $("graphics").closest("p").hidden = !navigator.gpu;
    $("graphics").addEventListener("change", () => this.chooseGraphics());
    $("about").textContent = `Model ${this.settings.name}: ${this.settings.licence}.`;
  }

  key(event) {
    if (this.live && event.key !== "Escape") return;
    const on = (selector) => event.target.closest?.(selector);
    const undone = (event.ctrlKey || event.metaKey) && !on("textarea, input[type=number]") && event.key.toLowerCase(); // there the browser's own
    if (undone === "y" || (undone === "z" && event.shiftKey)) { event.preventDefault(); this.history.redo(); }
    else if (undone === "z") { event.preventDefault(); this.history.undo(); }
    else if (event.key === " " && !on("input, textarea, select, button, summary, dialog")) { event.preventDefault(); this.setPlaying(!this.playing); }
    else if (event.key === "Escape" && !event.isComposing && !on("dialog")) this.stop();
  }

  editBlock(update, kind = null) {
    const blocks = this.scene.blocks.map((block, i) => (i === this.selected ? { ...block, ...update } : block));
    this.history.change({ blocks }, kind && `${kind}${this.selected}`);
  }

  stretchBlock(index, seconds, kind = null) {
    this.history.change({ blocks: this.scene.blocks.map((block, i) => (i === index ? { ...block, seconds } : block)) }, kind);
  }

  addBlock() {
    if (this.scene.blocks.length >= LIMITS.blocks) return;
    const blocks = [...this.scene.blocks];
    blocks.splice(this.selected + 1, 0, { text: "", seconds: 3 });
    this.selected++;
    this.history.change({ blocks });
    $("text").focus();
  }

  /** The block under the playhead becomes two. */
  cutBlock() {
    const blocks = [...this.scene.blocks], [index, into] = this.timeline.at(this.place), { text, seconds } = blocks[index];
    const first = Math.round(into * 10) / 10, second = Math.round((seconds - first) * 10) / 10;
    if (Math.min(first, second) < LIMITS.seconds[0]) {
      this.tell(`Move the playhead to where a sentence is to be cut; each part takes ${LIMITS.seconds[0]} seconds or more.`, "warning");
      return;
    }
    blocks.splice(index, 1, { text, seconds: first }, { text, seconds: second });
    this.selected = index + 1;
    this.history.change({ blocks });
  }

  moveBlock(from, to) {
    if (to < 0 || to >= this.scene.blocks.length || from === to) return;
    const blocks = [...this.scene.blocks], [block] = blocks.splice(from, 1);
    blocks.splice(to, 0, block);
    this.selected = to;
    this.history.change({ blocks });
  }

  removeBlock(index = this.selected) {
    if (this.scene.blocks.length < 2) return;
    if (index < this.selected) this.selected--;
    this.history.change({ blocks: this.scene.blocks.filter((_, i) => i !== index) });
  }

  select(index) {
    this.selected = index;
    this.history.rest();
    this.changed();
  }

  /** Show the scene in all controls. */
  changed() {
    const { blocks, seed, takes, chosen, path } = this.scene;
    this.selected = Math.min(this.selected, blocks.length - 1);
    const block = blocks[this.selected];
    if ($("text").value !== block.text) $("text").value = block.text;
    $("which").textContent = blocks.length > 1 ? `Sentence ${this.selected + 1} of ${blocks.length}` : "Sentence";
    $("seconds").value = block.seconds;
    $("seed").value = seed;
    $("takes").value = takes;
    $("remove").disabled = blocks.length < 2;
    $("earlier").disabled = this.selected === 0;
    $("later").disabled = this.selected === blocks.length - 1;
    $("undo").disabled = !this.history.past.length;
    $("redo").disabled = !this.history.future.length;
    const way = path ? (Object.keys(PATHS).find((name) => JSON.stringify(PATHS[name].points) === JSON.stringify(path)) ?? "drawn") : "none";
    $("path").querySelector("[value=drawn]").disabled = way !== "drawn";
    $("path").disabled = Boolean(this.clip);
    if (!this.drawing) $("path").value = this.clip ? "clip" : way;
    this.timeline?.show();
    clearTimeout(this.linkTimer); // browsers count how often an address changes
    this.linkTimer = setTimeout(() => history.replaceState(null, "", this.link()), 300);
    if (this.clip !== this.clipBefore) { // opened, closed, or so by undo
      if (this.clip) this.putOnStage([this.clip.motion], 0);
      this.tell(this.clip ? `${this.clip.name}: ${(this.clip.motion.frames / FPS).toFixed(2)} seconds. Choose what is to be done with it, then make.` : "The clip is closed.");
      this.clipBefore = this.clip;
      this.showClip();
    }
    this.showMotions(chosen);
    this.stage?.showPath(this.clip || this.live ? null : path);
    this.warnSoon();
  }

  // ---------------------------------------------------------------- motions

  /** All that takes are made of, as it is now: what is made meanwhile of it is filed under it, whatever is changed. */
  get asked() {
    const { blocks, path, seed, takes } = this.scene;
    return { blocks, path, seed, takes, clip: this.clip ? this.clipChoice() : null };
  }

  /** What a take depends on; a clip's number stands for its motion. */
  keyOf(take, { blocks, path, clip, seed } = this.asked) {
    return JSON.stringify([blocks, path, clip && { ...clip, motion: null }, seed + take]);
  }

  async make() {
    if (!this.client) return;
    if (this.live) { this.live.say(); return; }
    if (this.making) { this.again = true; return; }
    const { asked } = this, { takes, seed, ...scene } = asked;
    const empty = scene.blocks.findIndex(isEmpty);
    if (empty >= 0 && !scene.clip) { this.askForWords(empty); return; }
    const { mode, keep } = scene.clip ?? {}, kept = { continue: [keep, 0], between: [keep, keep] }[mode] ?? [0, 0];
    await this.during(async () => {
      let made = 0;
      this.tell(takes > 1 ? `Making ${takes} takes …` : "Making the motion …");
      for (let take = 0; take < takes; take++) {
        const key = this.keyOf(take, asked), which = takes > 1 ? `take ${take + 1} …` : "", known = this.motions.get(key);
        this.motions.delete(key); // what is asked for again is forgotten last
        if (known) { this.motions.set(key, known); continue; }
        $("progress").textContent = which;
        const start = performance.now();
        const motion = await this.client.call("make", { scene, seed: seed + take }, (frames) => { $("progress").textContent = `${which} ${(frames / FPS).toFixed(1)} s`; });
        this.timings.motion = performance.now() - start;
        this.motions.set(key, { ...motion, kept, took: this.timings.motion });
        if (this.motions.size > REMEMBERED) this.motions.delete(this.motions.keys().next().value);
        made++;
        this.showMotions();
        this.timings.first ??= performance.now();
      }
      const all = Array.from({ length: takes }, (_, take) => this.motions.get(this.keyOf(take, asked)));
      const long = secondsOf(all), why = scene.clip ? "With the clip" : "By its words";
      const other = Math.abs(long - spanOf(scene.blocks)) > 0.1 ? ` ${why} it lasts ${long.toFixed(1)} s.` : "";
      const took = (all.reduce((sum, motion) => sum + motion.took, 0) / 1000).toFixed(1), choose = takes > 1 ? " Click a take to choose it." : "";
      this.tell(`${made ? "Made" : "Nothing has changed since it was made"} in ${took} s.${other}${choose}`);
      await this.warn();
      if (this.keyOf(0) !== this.keyOf(0, asked)) this.tell(CHANGED);
    }, () => this.client.stop());
  }

  /** Passes on the graphics card from now on, if there is one that can, or on the processor again. */
  chooseGraphics() {
    const wanted = $("graphics").checked;
    return this.during(async () => {
      this.tell(wanted ? "Opening the graphics card …" : "Going back to the processor …");
      const found = await this.client.useGraphics(wanted ? await readPart(document, "graphics") : null);
      if (found?.error) $("graphics").checked = false;
      if (!found) this.tell("The processor computes.");
      else if (found.error) this.tell(`The graphics card cannot be used, the processor goes on: ${found.error}`, "warning");
      else this.tell(`A pass takes the graphics card ${found.helper.toFixed(0)} ms, the processor ${found.own.toFixed(0)} ms. Its motions may differ a little from the command line's.`);
    }, () => this.client.stop());
  }

  askForWords(index) {
    this.select(index);
    this.tell("Say in a few words what the body does.", "warning");
    $("text").focus();
  }

  /** One thing at a time that takes long: told at its begin and its end, ended early by `halt`. */
  async during(work, halt = () => {}) {
    this.halt = halt;
    this.stopped = false;
    this.setMaking(true);
    try {
      await work();
    } catch (error) {
      if (this.stopped) this.tell("Stopped; takes that are finished stay.");
      else this.tell(error.message, "error");
    }
    await this.client?.opened; // a stopped one begins anew
    this.setMaking(false);
    if (this.again) { this.again = false; this.make(); }
  }

  setMaking(making) {
    this.making = making;
    document.body.classList.toggle("making", making);
    $("make").setAttribute("aria-busy", String(making && !this.live));
    $("live").disabled = $("graphics").disabled = making;
    this.offerStop();
    this.showButtons();
  }

  offerStop() {
    const offered = this.drawing || (this.making && !this.stopped);
    if (!offered && document.activeElement === $("stop")) $("make").focus({ preventScroll: true }); // the button goes
    $("stop").hidden = !offered;
  }

  stop() {
    if (this.drawing) { this.stopDrawing(); this.tell("Nothing is drawn."); return; }
    if (!this.making || this.stopped) return;
    this.stopped = true;
    this.again = false;
    this.offerStop();
    this.halt();
  }

  /** The motions of the scene that are there; those of before, told stale, where none is. */
  showMotions() {
    if (this.live) return;
    const { takes, chosen } = this.scene;
    const all = Array.from({ length: takes }, (_, take) => this.motions.get(this.keyOf(take)));
    const found = all.slice(0, all.includes(undefined) ? all.indexOf(undefined) : takes);
    const stale = Boolean(this.shown) && !found.length && this.shown[0] !== this.clip?.motion;
    document.body.classList.toggle("stale", stale);
    if (stale && !this.making && !this.drawing) this.tell(CHANGED);
    if (found.length) this.putOnStage(found, Math.min(chosen, found.length - 1));
    this.seek(this.time > this.seconds ? 0 : this.time);
    this.showTakes(found.length);
    this.showButtons();
  }

  putOnStage(motions, choice) {
    const before = this.shown;
    this.shown = motions;
    this.choice = choice;
    this.stage?.show(motions, choice);
    this.stage?.showPath(this.clip ? null : this.scene.path);
    $("stage").setAttribute("aria-label", `${motions.length > 1 ? `${motions.length} bodies; take ${choice + 1} is chosen` : "A body"}: ${motions[choice].text || this.clip?.name}`);
    if (!before) this.setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    if (before?.length !== motions.length) this.stage?.resetView();
    $("scrub").max = this.seconds;
  }

  /** What can be done with a motion, where there is one. */
  showButtons() {
    for (const id of ["save-bvh", "save-glb", "save-vrma", "use-motion"]) $(id).disabled = !this.shown;
    $("play").disabled = !this.shown || !this.stage;
    $("save-film").disabled = $("play").disabled || this.making;
  }

  /** A button a take, which stays what it is, and focused, while takes come and are chosen. */
  showTakes(found) {
    const { takes, chosen } = this.scene, list = $("take-list"), wanted = takes > 1 ? takes : 0;
    while (list.children.length > wanted) list.lastElementChild.remove();
    for (let take = list.children.length; take < wanted; take++) {
      const label = document.createElement("label"), input = document.createElement("input");
      Object.assign(input, { type: "radio", name: "take", value: take });
      input.addEventListener("change", () => this.choose(take));
      label.append(input, `Take ${take + 1}`);
      list.append(label);
    }
    for (const [take, input] of list.querySelectorAll("input").entries()) Object.assign(input, { checked: take === chosen, disabled: take >= found });
  }

  choose(take) {
    if (!this.live && take < (this.shown?.length ?? 0)) this.history.change({ chosen: take }, "chosen");
  }

  setPlaying(playing) {
    this.playing = playing && Boolean(this.shown && this.stage);
    $("play").textContent = this.playing ? "Pause" : "Play";
    if (this.shown && !this.playing) this.seek(this.time); // as the stage shows it
  }

  /** Show a moment; the clock and the slider follow at once, while it plays often enough to be read: in every frame they make frames late (docs/studio.md). */
  seek(time, atOnce = true) {
    this.time = time;
    this.stage?.placeAt(time);
    const stamp = performance.now();
    if (!atOnce && stamp - this.toldAt < TOLD_EACH) return;
    this.toldAt = stamp;
    const { seconds } = this, now = Math.min(time, seconds);
    $("scrub").value = now;
    $("scrub").setAttribute("aria-valuetext", `${now.toFixed(1)} seconds`);
    $("clock").textContent = `${now.toFixed(2)} / ${seconds.toFixed(2)} s`;
    this.timeline?.showPlayhead(this.place);
  }

  /** Of the longest take that is shown. */
  get seconds() {
    return secondsOf(this.shown ?? []);
  }

  /** Which of the timeline's seconds the playhead is at. What is kept of a clip lies outside them, and sentences that take other seconds than theirs fill them. */
  get place() {
    const { kept: [before, after] = [0, 0] } = this.shown?.[this.choice] ?? {};
    const gone = (this.time - before) / Math.max(this.seconds - before - after, 0.1);
    return Math.min(Math.max(gone, 0), 1) * spanOf(this.scene.blocks);
  }

  tell(message, kind = "note") {
    $("status").textContent = message;
    $("status").className = kind;
    $("progress").textContent = "";
  }

  warnSoon() {
    clearTimeout(this.warnTimer);
    this.warnTimer = setTimeout(() => this.warn().catch(() => {}), 400); // where it is stopped, the next change asks again
  }

  /** Says which sentences the model hardly knows, and which motions do not show theirs. */
  async warn() {
    if (!this.client) return;
    const { blocks, path } = this.scene, timed = blocks.length > 1 && !path; // one alone takes the time that it needs
    const asked = blocks.filter(({ text }) => text.trim()).map(({ text, seconds }) => ({ text, seconds: timed ? seconds : undefined }));
    const found = await Promise.all(asked.map((each) => this.client.call("warning", each)));
    const list = $("warnings");
    const takes = Array.from({ length: this.scene.takes }, (_, take) => this.motions.get(this.keyOf(take))?.missed);
    const lines = [...new Set([...found, ...takes].filter(Boolean))];
    if (JSON.stringify(lines) === list.dataset.lines) return;
    list.dataset.lines = JSON.stringify(lines);
    list.replaceChildren(...lines.map((line) => {
      const item = document.createElement("li");
      item.textContent = line;
      return item;
    }));
  }

  // ---------------------------------------------------------------- path

  bindStage() {
    const canvas = $("stage");
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (!event.isPrimary) return; // a palm, or the second finger of a pinch
      pressed = event;
      if (!this.drawing) return;
      canvas.setPointerCapture(event.pointerId);
      const place = this.stage.floorAt(event);
      this.line = place ? [place] : [];
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.drawing || !this.line?.length || event.pointerId !== pressed?.pointerId) return;
      const place = this.stage.floorAt(event), last = this.line[this.line.length - 1];
      if (place && Math.hypot(place[0] - last[0], place[1] - last[1]) > 0.12) { this.line.push(place); this.stage.showPath(this.line); }
    });
    canvas.addEventListener("pointercancel", (event) => {
      if (event.pointerId !== pressed?.pointerId) return;
      pressed = this.line = null;
      this.stage?.showPath(this.clip ? null : this.scene.path);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (event.pointerId !== pressed?.pointerId) return;
      if (this.drawing && this.line?.length) {
        const line = this.line;
        this.stopDrawing();
        if (line.length > 2) this.takePath(line);
        else this.tell("Draw a longer line on the floor.", "warning");
      } else if (Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) < 5) {
        const take = this.stage?.takeAt(event);
        if (take !== null && take !== undefined) this.choose(take);
      }
      pressed = null;
    });
    canvas.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-TURN, 0], ArrowRight: [TURN, 0], ArrowUp: [0, TURN], ArrowDown: [0, -TURN], "+": [0, 0, 0.9], "-": [0, 0, 1 / 0.9] }[event.key];
      if (!way || this.drawing || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      this.stage?.turn(...way);
    });
  }

  choosePath(name) {
    if (name === "draw") {
      this.playsAfter = this.playing;
      this.drawing = true;
      this.setPlaying(false);
      this.stage.controls.enabled = false;
      this.stage.resetView(true);
      document.body.classList.add("drawing");
      this.tell("Draw the way on the floor with one stroke.");
      this.offerStop();
      $("stage").scrollIntoView({ block: "nearest" });
      return;
    }
    this.stopDrawing();
    if (name === "drawn") return;
    this.takePath(PATHS[name].points);
  }

  /** A way on the floor; a sentence alone gets the seconds that it takes at a walk. */
  takePath(path) {
    const { blocks } = this.scene;
    if (path && blocks.length === 1) {
      const seconds = Math.ceil(lengthOf(path) / WALK + 1);
      this.history.change({ path, blocks: [{ ...blocks[0], seconds }] });
    } else this.history.change({ path });
    this.make();
  }

  stopDrawing() {
    if (!this.drawing) return;
    this.drawing = false;
    this.line = null;
    this.stage.controls.enabled = true;
    this.stage.resetView();
    this.stage.showPath(this.scene.path);
    document.body.classList.remove("drawing");
    this.offerStop();
    this.setPlaying(this.playsAfter);
    this.changed();
  }

  // ---------------------------------------------------------------- clips in

  bindClips() {
    $("open").addEventListener("click", () => $("file").click());
    $("file").addEventListener("change", () => { if ($("file").files[0]) this.openClip($("file").files[0]); $("file").value = ""; });
    addEventListener("dragover", (event) => { event.preventDefault(); document.body.classList.add("dropping"); });
    addEventListener("dragleave", (event) => { if (!event.relatedTarget) document.body.classList.remove("dropping"); });
    addEventListener("drop", (event) => {
      event.preventDefault();
      document.body.classList.remove("dropping");
      if (event.dataTransfer.files[0]) this.openClip(event.dataTransfer.files[0]);
    });
    for (const id of ["mode", "from", "until", "keep", "joints"])
      $(id).addEventListener("change", ({ target }) => {
        if (target.type === "number") target.value = within(target.valueAsNumber, [Number(target.min), Number(target.max || Infinity)], target.defaultValue);
        this.showClip();
        this.showMotions();
      });
    $("use-motion").addEventListener("click", () => this.takeClip(this.shown[this.choice], "this motion"));
    $("close-clip").addEventListener("click", () => this.history.change({ clip: null }));
    $("body").addEventListener("change", () => this.chooseBody($("body").value).catch((error) => this.tell(error.message, "error")));
    for (const name of Object.keys(this.settings.skeleton.groups)) $("joints").add(new Option(name.replace("-", " "), name));
    this.showClip();
  }

  async openClip(file) {
    try {
      if (file.size > 64 << 20) throw new Error("The file is larger than 64 MB.");
      const bytes = new Uint8Array(await file.arrayBuffer().catch(() => { throw new Error("It cannot be read; of a folder, drop one of its clips."); }));
      const found = readAvatar(file.name, bytes, this.settings.profiles);
      if (this.live) return; // it began while the file was read
      if (found) this.offerBody(found.avatar, file.name);
      if (found?.alone) {
        await this.chooseBody("avatar");
        if (this.worn === found.avatar) this.tell(`${file.name} moves now. GLB files and films show it; BVH and VRMA hold the motion alone.`);
        return;
      }
      this.takeClip(readClip(file.name, bytes, this.settings.profiles), file.name);
      this.seek(0);
      this.stage?.resetView(); // it may stand elsewhere
    } catch (error) {
      this.tell(`${file.name}: ${error.message}`, "error");
    }
  }

  /** Of the avatars that were opened the last one can be chosen. */
  offerBody(avatar, name) {
    this.avatar = avatar;
    $("body").replaceChildren(new Option("mannequin", ""), new Option(name, "avatar"));
    $("body").closest("label").hidden = false;
    this.chooseBody("");
  }

  /** What moves on the stage, in films and in GLB files: the mannequin, or that avatar. */
  async chooseBody(which) {
    const body = which ? this.avatar : null;
    this.worn = body;
    $("body").value = which;
    try {
      await this.stage?.wear(body);
    } catch (error) {
      if (this.worn === body) this.chooseBody("");
      throw new Error(`It cannot be drawn: ${error instanceof TypeError ? "the file is damaged." : error.message}`);
    }
  }

  takeClip(motion, name) {
    this.stopDrawing();
    const number = this.clips.size + 1;
    this.clips.set(number, { motion, name, number });
    const seconds = motion.frames / FPS;
    $("until").value = Math.min(seconds, 2).toFixed(1);
    $("from").value = Math.min(1, seconds / 3).toFixed(1);
    this.history.change({ clip: number });
  }

  clipChoice() {
    const { motion, number } = this.clip, joints = $("joints").value === "all" ? [] : [$("joints").value];
    const [from, until, keep] = ["from", "until", "keep"].map((id) => $(id).valueAsNumber);
    return { mode: $("mode").value, from, until, keep, joints, motion, number };
  }

  showClip() {
    document.body.classList.toggle("with-clip", Boolean(this.clip));
    $("clip-name").textContent = this.clip ? `${this.clip.name}, ${(this.clip.motion.frames / FPS).toFixed(1)} s` : "";
    const redo = $("mode").value === "redo";
    for (const id of ["from", "until", "joints"]) $(id).closest("label").hidden = !redo;
    $("keep").closest("label").hidden = redo;
  }

  // ---------------------------------------------------------------- files out

  fileName(kind) {
    const words = this.shown[this.choice].text.normalize("NFKC").replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-+|-+$/g, "").slice(0, 48);
    return `${words || "motion"}.${kind}`;
  }

  /** The chosen motion as a file. */
  bytes(kind) {
    const motion = this.shown[this.choice];
    if (kind === "bvh") return new TextEncoder().encode(writeBvh(motion));
    return kind === "glb" && this.worn ? this.worn.write(motion) : writeGlb(motion, this.rest[kind]);
  }

  save(kind) {
    try {
      download(new Blob([this.bytes(kind)], { type: kind === "bvh" ? "text/plain" : "model/gltf-binary" }), this.fileName(kind));
      this.tell(`Saved ${this.fileName(kind)}.`);
    } catch (error) {
      this.tell(`It cannot be saved: ${error.message}`, "error");
    }
  }

  async film() {
    const before = this.playing;
    this.setPlaying(false);
    await this.during(async () => {
      this.tell("Filming in real time …");
      const { blob, kind } = await recordFilm($("stage"), this.seconds, (time) => { this.seek(time); return !this.stopped; });
      if (this.stopped) { this.tell("Stopped; no film is saved."); return; }
      download(blob, this.fileName(kind));
      this.tell(`Saved ${this.fileName(kind)}.`);
    });
    this.setPlaying(before);
  }

  /** The address that carries the scene. */
  link() {
    return `${location.href.split("#")[0]}#${toLink(this.scene)}`;
  }

  async copyLink() {
    const note = this.clip ? " The clip is not in it." : "";
    try {
      await navigator.clipboard.writeText(this.link());
      this.tell(`The link that carries this scene is copied.${note}`);
    } catch {
      this.tell(`The link in the address bar carries this scene.${note}`);
    }
  }
}

const secondsOf = (motions) => Math.max(0, ...motions.map(({ frames, fps }) => (frames - 1) / fps));

function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
