// What is to be made, as plain data: checked when it comes from a link, kept for undo.

export const LIMITS = { blocks: 24, text: 300, seconds: [0.5, 30], takes: 4, seed: 2 ** 31 - 1, points: 400, room: 50 };
const VERSION = 1;

export const START = {
  blocks: [{ text: "a person waves", seconds: 4 }],
  seed: 0, takes: 2, chosen: 0, path: null, clip: null,
};

export const within = (value, [low, high], otherwise) => {
  const number = Number(value);
  return Number.isFinite(number) ? Math.min(Math.max(number, low), high) : otherwise;
};
const whole = (value, range, otherwise) => Math.round(within(value, range, otherwise));

/** Whether a sentence has no words. */
export const isEmpty = ({ text }) => !/[\p{L}\p{N}]/u.test(text);

/** Seconds that sentences have. */
export const spanOf = (blocks) => blocks.reduce((sum, { seconds }) => sum + seconds, 0);

/** A scene with nothing in it but what a scene has; null where it is none. */
export function checked(raw) {
  if (typeof raw !== "object" || raw === null || !Array.isArray(raw.blocks) || !raw.blocks.length) return null;
  const blocks = raw.blocks.slice(0, LIMITS.blocks).map((block) => ({
    text: String(block?.text ?? "").slice(0, LIMITS.text),
    seconds: Math.round(within(block?.seconds, LIMITS.seconds, 4) * 10) / 10,
  }));
  const takes = whole(raw.takes, [1, LIMITS.takes], 1);
  let path = null;
  if (Array.isArray(raw.path) && raw.path.length > 1) {
    const room = [-LIMITS.room, LIMITS.room];
    path = raw.path.slice(0, LIMITS.points).map((point) => [0, 1].map((i) => Math.round(within(point?.[i], room, 0) * 100) / 100));
    if (path.every((point) => Math.hypot(point[0] - path[0][0], point[1] - path[0][1]) < 0.05)) path = null;
  }
  return { blocks, seed: whole(raw.seed, [0, LIMITS.seed], 0), takes, chosen: whole(raw.chosen, [0, takes - 1], 0), path, clip: raw.clip ?? null };
}

/** The scene, without its clip, as the part of a link behind `#`. */
export function toLink(scene) {
  const bytes = new TextEncoder().encode(JSON.stringify({ v: VERSION, ...scene, clip: undefined }));
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export function fromLink(hash) {
  try {
    const binary = atob(hash.replace(/^#/, "").replaceAll("-", "+").replaceAll("_", "/"));
    return checked({ ...JSON.parse(new TextDecoder().decode(Uint8Array.from(binary, (sign) => sign.charCodeAt(0)))), clip: null });
  } catch {
    return null;
  }
}

/** The scene now, and those before and after it. */
export class History {
  constructor(scene, changed) {
    Object.assign(this, { now: scene, past: [], future: [], changed });
  }

  /** Take over a change; changes of one `kind` that follow each other are undone together. */
  change(update, kind = null) {
    const next = checked({ ...this.now, ...update });
    if (!next) return;
    if (JSON.stringify(next) === JSON.stringify(this.now)) { this.changed(); return; } // a field may show what was not taken
    if (kind === null || kind !== this.kind) this.past.push(this.now);
    this.past = this.past.slice(-200);
    this.future = [];
    this.kind = kind;
    this.now = next;
    this.changed();
  }

  /** What follows is undone on its own. */
  rest() {
    this.kind = null;
  }

  undo() {
    this.move(this.past, this.future);
  }

  redo() {
    this.move(this.future, this.past);
  }

  move(from, to) {
    if (!from.length) return;
    to.push(this.now);
    this.now = from.pop();
    this.kind = null;
    this.changed();
  }
}
