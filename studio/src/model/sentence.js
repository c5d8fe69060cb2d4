// What a sentence says of order and measure (src/shared/pipelines/sentence.py, whose patterns come
// with the model): clauses { text, count, degrees, metres, seconds, meanwhile, side }.

const EDGES = " \t,;.!?。、，；！？";
const plainClause = (text) => ({ text, count: 1, degrees: null, metres: null, seconds: null, meanwhile: "", side: "both" });

export const isPlain = (clause) =>
  clause.count === 1 && clause.degrees === null && clause.metres === null && clause.seconds === null
  && !clause.meanwhile && clause.side === "both";

function strip(text, characters = EDGES) {
  let start = 0, stop = text.length;
  while (start < stop && characters.includes(text[start])) start++;
  while (stop > start && characters.includes(text[stop - 1])) stop--;
  return text.slice(start, stop);
}

export class SentenceReader {
  /** @param {object} measures patterns and words @param {function} known action of a text, or null
   *  @param {function} arms whether a text asks for the arms alone */
  constructor({ patterns, numbers, adverbs, angles, most, maxCount }, known, arms) {
    Object.assign(this, { numbers, adverbs, angles, most, maxCount, known, arms });
    this.first = {}; this.each = {}; this.head = {};
    for (const [name, pattern] of Object.entries(patterns)) {
      this.first[name] = new RegExp(pattern, "iu");
      this.each[name] = new RegExp(pattern, "giu");
      this.head[name] = new RegExp(`^(?:${pattern})`, "iu");
    }
  }

  clauses(sentence) {
    const text = sentence.trim().split(/\s+/u).join(" ").normalize("NFKC"), found = [];
    for (const whole of this.ordered(text)) {
      const both = this.together(whole);
      if (both) found.push(both);
      else found.push(...this.joined(whole).map((part) => this.measured(part)));
    }
    const real = found.filter((clause) => clause.text);
    return real.length ? real : [plainClause(sentence)];
  }

  ordered(text) {
    for (const [name, swapped] of [["head_after", false], ["head_before", true]]) {
      const head = this.head[name].exec(text);
      const comma = head ? text.indexOf(",", head[0].length) : -1;
      if (!head) continue;
      const first = comma < 0 ? text.slice(head[0].length) : text.slice(head[0].length, comma);
      const second = comma < 0 ? "" : text.slice(comma + 1);
      const parts = swapped ? [second, first] : [first, second];
      if (comma >= 0 && strip(parts[1])) return parts.flatMap((part) => this.ordered(part));
    }
    for (const [name, swapped] of [["then", false], ["earlier", false], ["later", true], ["before", false], ["after", true]])
      for (const match of text.matchAll(this.each[name])) {
        let left = text.slice(0, match.index), right = text.slice(match.index + match[0].length);
        if (name === "then") [left, right] = this.around(left, right);
        if (strip(left) && strip(right)) return (swapped ? [right, left] : [left, right]).flatMap((part) => this.ordered(part));
      }
    return [this.trimmed(this.head.then.test(text) ? text.replace(this.each.then, " ") : text)];
  }

  around(left, right) {
    const borders = [...left.matchAll(this.each.joint)], last = borders[borders.length - 1];
    const own = last ? left.slice(last.index + last[0].length) : "";
    if (last && strip(own) && (own.trim().split(/\s+/u).length <= 3 || !strip(right)))
      return [left.slice(0, last.index), `${own.trimEnd()} ${right.trimStart()}`];
    return [left, right];
  }

  joined(text) {
    const pieces = text.split(this.first.joint).map((piece) => this.trimmed(piece)).filter(Boolean);
    if (pieces.length < 2) return [text];
    const actions = pieces.map((piece) => this.known(this.measured(piece).text));
    return actions.includes(null) || new Set(actions).size < actions.length ? [text] : pieces;
  }

  together(text) {
    let parts = text.split(this.first.meanwhile).map((part) => this.trimmed(part)).filter(Boolean);
    const atOnce = this.first.meanwhile.test(text);
    if (parts.length === 1) parts = parts[0].split(this.first.joint).map((part) => this.trimmed(part)).filter(Boolean);
    const sides = parts.map((part) => this.sideOf(part));
    if (parts.length !== 2 || !(atOnce || (sides.includes("left") && sides.includes("right")))) return null;
    const arms = parts.map((part) => this.arms(part));
    if (!parts.every((part) => this.known(part)) || !arms.some(Boolean)) return null;
    const [body, other] = arms[0] && !arms[1] ? [1, 0] : [0, 1];
    if (!atOnce && !arms.every(Boolean)) return null;
    return { ...this.measured(parts[body]), meanwhile: parts[other], side: sides[other] };
  }

  sideOf(text) {
    const [left, right] = [this.first.left.test(text), this.first.right.test(text)];
    return left === right ? "both" : left ? "left" : "right";
  }

  measured(text) {
    let clause = plainClause(text);
    const side = this.sideOf(text.replace(this.each.angle, " "));
    for (const name of ["degrees", "metres", "seconds"]) {
      const match = this.first[name].exec(clause.text);
      if (!match) continue;
      const value = this.value(match.groups.number);
      if ((name === "degrees" && value < 15) || !(value > 0 && value <= this.most[name])) continue;
      clause = { ...clause, text: this.without(clause.text, match), [name]: value };
    }
    const angle = clause.degrees === null && side !== "both" && this.first.angle.exec(clause.text);
    if (angle) clause = { ...clause, degrees: this.angles[angle[0].toLowerCase()] };
    if (clause.degrees !== null) return { ...clause, degrees: (side === "right" ? -1 : 1) * clause.degrees };
    return clause.metres === null && clause.seconds === null ? this.counted(clause) : clause;
  }

  counted(clause) {
    let match = this.first.often.exec(clause.text), number;
    if (match) number = this.adverbs[match[0].toLowerCase()];
    else {
      match = this.first.times.exec(clause.text) ?? this.first.bare.exec(clause.text);
      if (!match) return clause;
      number = Math.trunc(this.value(match.groups.number ?? match.groups.after));
    }
    if (!(number > 1 && number <= this.maxCount)) return clause;
    const rest = this.without(clause.text, match);
    return rest ? { ...clause, text: rest, count: number } : clause;
  }

  value(text) {
    return this.numbers[text.toLowerCase()] ?? Number(text.replace(",", "."));
  }

  without(text, match) {
    return this.trimmed(`${text.slice(0, match.index).trimEnd()} ${text.slice(match.index + match[0].length).trimStart()}`);
  }

  trimmed(text) {
    return strip(strip(text).replace(this.each.loose, ""));
  }
}
