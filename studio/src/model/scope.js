// Is a prompt near anything the model was trained on, and to which action
// (src/shared/model/clip/out_of_domain.py)?

import { unit } from "./tower.js";

const SAME_STEM = 0.65, MIN_STEM = 4, MIN_SEEN = 0.5, NEAREST = 3, RELIABLE = 0.5, BARE = 3, BARELY = 0.1;
const TWINS = [["bye", "wave"]]; // one gesture under two names
const CJK = /[\u3040-\u30ff\u3400-\u9fff]/u, HAN = /[\u3400-\u9fff]/gu;
const RUNS = /[\u3040-\u30ff\u3400-\u9fff]+|(?:(?![\u3040-\u30ff\u3400-\u9fff])[\p{L}\p{N}_])+/gu;

export function wordsOf(text) {
  const words = new Set();
  for (const [run] of text.normalize("NFKC").toLowerCase().replaceAll("ß", "ss").matchAll(RUNS)) {
    if (!CJK.test(run)) { words.add(run); continue; }
    for (let i = 0; i + 1 < run.length; i++) words.add(run.slice(i, i + 2));
    for (const [sign] of run.matchAll(HAN)) words.add(sign);
  }
  return words;
}

const listed = (words) => (typeof words === "string" ? words.split(" ") : words); // folders of before had lists

export class Scope {
  /** @param {object} meta scope.json @param {Weights} table its means @param {TextTower} tower */
  constructor(meta, table, tower) {
    this.meta = meta;
    this.tower = tower;
    this.words = new Set(listed(meta.words));
    this.fillers = new Set(listed(meta.fillers ?? meta.words));
    this.keyWords = new Map(Object.entries(meta["key-words"]));
    const means = table.floats("means"), dim = means.length / meta.actions.length;
    this.means = meta.actions.map((_, row) => means.subarray(row * dim, (row + 1) * dim));
    this.checkedTexts = new Map();
  }

  /** The actions that are the same motion as one, itself among them. */
  twins(action) {
    return TWINS.find((twins) => twins.includes(action)) ?? [action];
  }

  /** { known, nearest, unreliable, certainty } of a text. */
  check(text) {
    let found = this.checkedTexts.get(text);
    if (!found) {
      found = this.judged(text);
      this.checkedTexts.set(text, found);
    }
    return found;
  }

  judged(text) {
    const { place: embedding, closeness } = this.tower.read(text), place = unit(Array.from(embedding));
    const cosines = this.means.map((mean) => mean.reduce((sum, x, i) => sum + x * place[i], 0));
    const { actions, weights, reliability = {} } = this.meta;
    const ranked = cosines.map((_, row) => row).sort((a, b) => cosines[b] - cosines[a]).filter((row) => actions[row]);
    const words = wordsOf(text);
    const evidence = this.evidence(words, cosines, ranked), told = this.meta["warning-weights"];
    let certainty = weights ? dot(evidence, weights) : this.familiar(words) ? 1 : -1;
    if (this.meta["min-cosine"] != null && Math.max(...cosines) >= this.meta["min-cosine"]) certainty = Math.max(certainty, 1);
    const known = (told && closeness != null ? dot([closeness, ...evidence], told) : certainty) > 0;
    const bare = words.size <= BARE && [...words].some((word) => String(this.keyWords.get(word)) === String([ranked[0]]));
    if (known && bare) certainty = Math.max(certainty, BARELY);
    const nearest = ranked.slice(0, NEAREST).map((row) => actions[row]);
    if (known && nearest.length && (reliability[nearest[0]] ?? 1) < RELIABLE)
      return { known: false, nearest, unreliable: nearest[0], certainty };
    return { known, nearest, unreliable: null, certainty };
  }

  evidence(words, cosines, ranked) {
    const { actions } = this.meta, [first, ...others] = ranked, named = new Set();
    const same = this.twins(actions[first]), second = others.find((row) => !same.includes(actions[row])) ?? first;
    let seen = 0, onlyFillers = true;
    for (const word of words) {
      const own = this.keyWords.get(word);
      if (own) own.forEach((action) => named.add(action));
      else for (const [key, actions] of this.keyWords) if (sameStem(word, key)) actions.forEach((action) => named.add(action));
      if (this.words.has(word)) seen++;
      if (!this.fillers.has(word)) onlyFillers = false;
    }
    const agreement = named.size === 0 ? 0 : [...named].some((row) => row === first || same.includes(actions[row])) ? 1 : -1;
    return [cosines[first], cosines[first] - cosines[second], seen / Math.max(words.size, 1), agreement, Number(onlyFillers), 1];
  }

  familiar(words) {
    const all = [...words];
    if (all.some((word) => this.keyWords.has(word))) return true;
    if (all.every((word) => this.words.has(word)) && !all.every((word) => this.fillers.has(word))) return true;
    const alike = all.filter((word) => !this.fillers.has(word) && [...this.keyWords.keys()].some((key) => sameStem(word, key)));
    const near = all.filter((word) => this.words.has(word) || alike.includes(word));
    return alike.length > 0 && near.length >= MIN_SEEN * all.length;
  }

  /** A line for who wrote a text that is far from anything trained; null where it is not. */
  warning(text) {
    const { known, nearest, unreliable } = this.check(text);
    if (known) return null;
    if (unreliable) {
      const share = Math.round(100 * this.meta.reliability[unreliable]);
      return `“${text}” asks for “${unreliable}”, which this model shows in about ${share}% of tries; look at the motion before you use it.`;
    }
    return `“${text}” is far from anything this model was trained on; nearest known actions: ${nearest.join(", ")}.`;
  }
}

function dot(values, weights) {
  return values.reduce((sum, x, i) => sum + x * weights[i], 0);
}

function sameStem(first, second) {
  const [a, b] = [[...first], [...second]];
  const needed = Math.max(MIN_STEM, Math.ceil(SAME_STEM * Math.max(a.length, b.length)));
  return Math.min(a.length, b.length) >= needed && a.slice(0, needed).join("") === b.slice(0, needed).join("");
}
