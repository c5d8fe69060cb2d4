// A body that goes on moving while sentences are said: the page's src/shared/pipelines/live.py.

import { framesOfMotion } from "../body/features.js";
import { FPS } from "../body/skeleton.js";
import { joined } from "../body/whole.js";
import { isEmpty } from "./scene.js";

const $ = (id) => document.getElementById(id);
const WAITING = [5, 30]; // frames that are there before they are due, at least and at most
const PIECES = 9; // of a window, and one: as long a wait may come again
const KEPT = 120 * FPS; // frames that are remembered

/** The page is live with the sentence that is selected, until it is stopped. */
export async function goLive(page) {
  const { text } = page.scene.blocks[page.selected];
  if (isEmpty({ text })) { page.askForWords(page.selected); return; }
  page.stopDrawing();
  const live = page.live = new Live(page, text);
  await page.during(() => live.run(), () => live.end());
}

class Live {
  kept = []; // pieces, each with the number of its first frame
  made = 0; // frames
  at = 0; // which frame is shown, and how much of the way to the next one
  waiting = WAITING[0];
  spent = []; // seconds of the last pieces
  busy = 0; // seconds of computing
  delays = []; // seconds from each sentence to the first frame that shows it
  said = null; // what is not yet seen

  constructor(page, text) {
    Object.assign(this, { page, text, more: () => {} });
  }

  async run() {
    const { page } = this, { seed } = page.scene, ended = new AbortController();
    this.rest(true);
    page.setPlaying(false);
    page.tell("It begins …");
    for (const name of ["dragover", "drop"]) // a clip would take the stage
      addEventListener(name, (event) => { event.preventDefault(); event.stopImmediatePropagation(); }, { capture: true, signal: ended.signal });
    const timer = setInterval(() => this.tick(), 1000 / FPS); // a stage that is drawn ticks as well
    try {
      for (let begin = true; !this.ended; begin = false) {
        const { text } = this, asked = performance.now();
        const piece = await page.client.call("live", { text, seed, begin });
        this.add(piece, (performance.now() - asked) / 1000);
        await new Promise((resolve) => { this.more = resolve; });
      }
    } finally {
      clearInterval(timer);
      ended.abort();
      page.live = null;
      this.rest(false);
      if (this.at >= 1) {
        page.takeClip(this.shown, "what was live");
        page.seek(page.seconds); // it stays where it stopped
        page.stage?.resetView();
      } else {
        page.showMotions();
        page.tell("Stopped.");
      }
    }
  }

  /** What belongs to a scene rests while the page is live. */
  rest(live) {
    document.body.classList.toggle("live", live);
    document.body.classList.remove("stale");
    for (const part of document.querySelectorAll(".rests")) part.disabled = live;
    $("make").textContent = live ? "Say" : "Make";
    if (live) this.page.stage?.showPath(null);
    if (live && !matchMedia("(pointer: coarse)").matches) { $("text").focus(); $("text").select(); } // what is typed next is what is said next
  }

  end() {
    this.ended = true;
    this.more();
  }

  /** The selected sentence is what it does next. */
  say() {
    const { page } = this, { text } = page.scene.blocks[page.selected];
    if (this.ended) return;
    if (isEmpty({ text })) { page.askForWords(page.selected); return; }
    if (text === this.text) page.tell(`It goes on: ${text}`);
    else {
      Object.assign(this, { text, said: { text, when: performance.now(), from: this.made } });
      page.client.call("say", { text }).catch(() => null);
      page.tell(`Said: ${text}`);
    }
    if (document.activeElement === $("text")) $("text").select();
  }

  /** A piece that took so many seconds. The longer that is, the sooner the next one is asked for. */
  add(piece, seconds) {
    const { stage } = this.page, first = !this.made;
    this.kept.push({ ...piece, start: this.made });
    this.made += piece.frames;
    this.busy += seconds;
    if (!first) {
      this.spent = [...this.spent, seconds].slice(-PIECES);
      this.waiting = Math.min(Math.max(WAITING[0], Math.max(...this.spent) * FPS), WAITING[1]);
    }
    while (this.kept[1]?.start <= this.made - KEPT) this.kept.shift();
    const near = this.kept.slice(this.kept.findLastIndex(({ start }) => start <= this.at));
    stage?.show([joined(...near)], 0);
    this.begin = near[0].start;
    if (first) this.now = performance.now();
    this.tick();
    if (!first) return;
    stage?.resetView();
    this.page.tell("Live. Type what it does next, then say it.");
  }

  /** As far as time has gone, but no farther than there are frames. */
  tick() {
    if (this.made) {
      const now = performance.now();
      this.at = Math.min(this.at + ((now - this.now) * FPS) / 1000, this.made - 1);
      this.now = now;
      this.page.stage?.placeAt((this.at - this.begin) / FPS);
      $("clock").textContent = `${(this.at / FPS).toFixed(1)} s`;
      this.look(Math.floor(this.at));
    }
    if (this.ended || this.made - this.at <= this.waiting) this.more();
  }

  /** Whether a frame is the first that shows what was said. */
  look(frame) {
    const { text, when, from = Infinity } = this.said ?? {}, { start, texts } = this.kept.findLast(({ start }) => start <= frame);
    if (frame < from || texts[frame - start] !== text) return;
    const delay = (performance.now() - when) / 1000;
    this.said = null;
    this.delays.push(delay);
    $("stage").setAttribute("aria-label", `A body: ${text}`);
    this.page.tell(`Seen ${delay.toFixed(1)} s after it was said: ${text}`);
  }

  /** What was shown, as far as it is remembered. */
  get shown() {
    const frames = Math.floor(this.at) + 1 - this.kept[0].start;
    const texts = this.kept.flatMap(({ texts }) => texts).slice(0, frames).filter((text, i, all) => text !== all[i - 1]);
    return { ...framesOfMotion(joined(...this.kept), 0, frames), text: texts.join(", then ") };
  }
}
