// The sentences over time: drag one to move it, its end to stretch it; keys do the same. Where they
// are wider than their place, they scroll in it, and a finger moves the one that it has selected.

import { LIMITS, spanOf } from "./scene.js";

const STEP = 0.5; // seconds a key press

export class Timeline {
  /** @param {HTMLElement} root @param {object} page what has the scene */
  constructor(root, page) {
    this.root = root;
    this.page = page;
    this.list = document.createElement("ol");
    this.head = document.createElement("div");
    this.head.className = "playhead";
    root.append(this.list, this.head);
    new ResizeObserver(() => this.fit()).observe(root);
  }

  show() {
    const { blocks } = this.page.scene, { selected } = this.page;
    const focused = [...this.list.children].findIndex((item) => item.contains(document.activeElement));
    this.list.replaceChildren(...blocks.map((block, index) => this.item(block, index, selected)));
    if (focused >= 0) this.focus(Math.min(focused, blocks.length - 1));
    this.fit();
    if (selected !== this.selected) this.reveal(this.list.children[selected]);
    this.selected = selected;
  }

  fit() {
    this.root.classList.toggle("long", this.list.scrollWidth > this.root.clientWidth);
  }

  reveal({ offsetLeft, offsetWidth }) {
    this.root.scrollLeft = Math.min(Math.max(this.root.scrollLeft, offsetLeft + offsetWidth - this.root.clientWidth), offsetLeft);
  }

  focus(index) {
    this.list.children[index].querySelector("button").focus();
  }

  /** To another place, and the focus with it. */
  move(from, to) {
    this.page.moveBlock(from, to);
    this.focus(to);
  }

  item({ text, seconds }, index, selected) {
    const item = document.createElement("li"), button = document.createElement("button"), handle = document.createElement("span");
    item.style.flexGrow = seconds;
    item.classList.toggle("selected", index === selected);
    button.type = "button";
    button.textContent = text || "…";
    button.title = "Drag to move; arrow keys select, Alt moves, Shift stretches, Delete removes";
    button.setAttribute("aria-label", `Sentence ${index + 1}: ${text || "empty"}, ${seconds} seconds`);
    button.setAttribute("aria-current", String(index === selected));
    const length = document.createElement("small");
    length.textContent = `${seconds} s`;
    handle.className = "handle";
    item.append(button, length, handle);
    button.addEventListener("click", () => this.page.select(index));
    button.addEventListener("keydown", (event) => this.key(event, index));
    button.addEventListener("pointerdown", (event) => this.drag(event, index, button));
    handle.addEventListener("pointerdown", (event) => this.stretch(event, index));
    return item;
  }

  key(event, index) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const { blocks } = this.page.scene, next = index + step;
    if (step && event.shiftKey) this.page.stretchBlock(index, blocks[index].seconds + step * STEP, `stretch${index}`);
    else if (step && blocks[next] && event.altKey) this.move(index, next);
    else if (step && blocks[next]) { this.page.select(next); this.focus(next); }
    else if (event.key === "Delete") this.page.removeBlock(index);
    else if (!step) return; // at an edge Alt and an arrow would leave the page
    event.preventDefault();
  }

  /** To another place: where the pointer is when it is let go. */
  drag(event, index, button) {
    if (event.button || !event.isPrimary) return;
    const from = event.clientX;
    let moved = false;
    const move = ({ clientX }) => {
      moved ||= Math.abs(clientX - from) > 6;
      if (moved) { button.parentElement.classList.add("dragged"); button.parentElement.style.transform = `translateX(${clientX - from}px)`; }
    };
    const up = ({ clientX }) => {
      stop();
      if (!moved) return;
      const places = [...this.list.children].map((item, i) => { const box = item.getBoundingClientRect(); return i === index ? null : (box.left + box.right) / 2; });
      const to = places.filter((place) => place !== null && place < clientX).length;
      if (to === index) this.show();
      else this.move(index, to);
    };
    const stop = follow(event, move, up, () => this.show());
  }

  stretch(event, index) {
    if (event.button || !event.isPrimary) return;
    event.preventDefault();
    const from = event.clientX, { seconds } = this.page.scene.blocks[index];
    const perPixel = spanOf(this.page.scene.blocks) / this.list.scrollWidth;
    const rest = () => { stop(); this.page.history.rest(); };
    const stop = follow(
      event,
      ({ clientX }) => {
        const wanted = Math.min(Math.max(seconds + (clientX - from) * perPixel, LIMITS.seconds[0]), LIMITS.seconds[1]);
        this.page.stretchBlock(index, wanted, `stretch${index}`);
      },
      rest,
      rest,
    );
  }

  /** Which sentence a second is in, and how far. */
  at(second) {
    const { blocks } = this.page.scene;
    let index = 0;
    for (; index < blocks.length - 1 && second >= blocks[index].seconds; index++) second -= blocks[index].seconds;
    return [index, second];
  }

  /** Where the sentences are seen: short ones are wider than their share. */
  showPlayhead(second) {
    const [index, into] = this.at(second), { offsetLeft, offsetWidth } = this.list.children[index];
    const left = offsetLeft + (into / this.page.scene.blocks[index].seconds) * offsetWidth;
    this.head.style.left = `${(100 * left) / this.list.clientWidth}%`;
  }
}

/** Listen to the pointer that was pressed until it is let go or taken away; the function that stops it. */
function follow({ pointerId }, move, up, cancel) {
  const stopped = new AbortController(), stop = () => stopped.abort();
  const on = (name, heard) => addEventListener(name, (event) => { if (event.pointerId === pointerId) heard(event); }, { signal: stopped.signal });
  on("pointermove", move);
  on("pointerup", up);
  on("pointercancel", () => { stop(); cancel(); });
  return stop;
}
