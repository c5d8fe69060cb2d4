// What a sentence says of order and measure (src/shared/pipelines/sentence.py, whose patterns come
// with the model): clauses { text, count, degrees, metres, seconds, steps, meanwhile, side, held, unheard }.

const EDGES = " \t,;.!?:()/+&|。、，！？：；（）「」…—–·-";
export const STANDS = "stands still", HALT = 2.5, RISEN = 1.5;
const ARROW = " → ", SITS = "sits", SQUATS = "squats down", BEFORE = 0.8, ABOUT = 180, FEW = 2;
const HELD = "\u23f8", MARK = /\u23f8(?:([\d.]+)\u23f8)?/u, ARRIVES = 1.5;
const GOT_UP = { action: "stand", certainty: 3, arms: false, known: true };
const PLAINLY = { // what whole patterns ask for, and words of a tower that knows them
  ups: [GOT_UP, STANDS],
  bends: [{ action: "turn", certainty: 3, arms: false, known: true }, "turns left"],
  posed: [{ action: "raise", certainty: 3, arms: true, known: true }, "raises both arms"],
  falls: [{ action: "die", certainty: 3, arms: false, known: true }, "dies"],
};
const LIES = ["die", "get-up", "lie-down", "sleep", "pick-up"], CROUCHES = ["squat", "crouch-walk", "crouch"]; // what falls, and who crouches, are taken for
export const UNDEAD = "zombie"; // the action that is somebody
export const GOING = ["walk", "run", "crouch-walk"], LOW = ["sit", "kneel", "meditate"], SEATED = [...LOW, "sit-floor", "lie-down", "sleep"];
const HOLDABLE = ["raise", "bow", "squat"];
const PAUSES = [["after_seconds", 1], ["later_seconds", 1], ["after_minutes", 60], ["later_minutes", 60]];
const PACES = { walk: [0.4, 1.3], run: [0.8, 1.4] }, ONCE = 5, LAID = 3, SURE = 0, SURE_AT_MARK = -14, SURE_IF_SAID = -2, MOST_PIECES = 8, HEADING = 3, NAMED = 2; // words before the colon of a list, and of what it names
export const surely = ({ action, certainty }) => (certainty > SURE ? action : null);
const unmarked = (text) => text.replace(new RegExp(MARK.source, "gu"), "");
const CJK = /[\u3040-\u30ff\u3400-\u9fff]/u;
const NUMBERED = /(?<![^\s,;:.])(?:(?:step|schritt|paso|étape|etape|take|toma|prise)\s*)?(\p{Nd}\p{Nd}?)\s*[.):](?!\p{Nd})\s*/giu;
const BLANKS = /\s+|(?<=[\u3040-\u30ff\u3400-\u9fff]{2})(?=[\u3040-\u30ff\u3400-\u9fff]{2})/gu;
const ENGLISH = /^(?:an?|the|my|your|his|her|our|their|this|that)\s/iu, SHORT = 3; // articles of a name, and letters of a pronoun behind one of another language ("die er …")
const AGAIN = /(?<![\p{L}\p{N}_])([\p{L}_]{4,})(?:[,;]?\s+\1)+(?=\s*(?:[,;.!?]|$))/giu; // "punch, punch"
const HOP = ["hop", "on one leg", "hops on one leg"]; // an action, and words for it
const closed = (text) => text.replace(/(?<=[\u3040-\u30ff\u3400-\u9fff])\s+(?=[\u3040-\u30ff\u3400-\u9fff])|\s+(?=[,;.])/gu, ""); // no blanks between signs
export const plainClause = (text) => ({ text, count: 1, degrees: null, metres: null, seconds: null, steps: null, meanwhile: "", side: "both", seat: "", held: false, once: false, tempo: 1, mirrored: false, unheard: "" });

/** Seconds in which a clause is shown, of those that are asked for: who is slow takes longer, who is fast is done sooner; what lasts is as long as it is asked for. */
export const lasting = ({ tempo }, seconds) => (seconds <= ONCE ? seconds / tempo : seconds);

export const isPlain = (clause) =>
  clause.count === 1 && clause.degrees === null && clause.metres === null && clause.seconds === null && clause.steps === null
  && !clause.meanwhile && clause.side === "both" && !clause.held && !clause.seat && clause.tempo === 1 && !clause.mirrored;

function strip(text, characters = EDGES) {
  let start = 0, stop = text.length;
  while (start < stop && characters.includes(text[start])) start++;
  while (stop > start && characters.includes(text[stop - 1])) stop--;
  return text.slice(start, stop);
}

export const plain = (text) => text.trim().split(/\s+/u).join(" ").normalize("NFKC");
const stripEnd = (text) => text.slice(0, [...text].findLastIndex((c) => !EDGES.includes(c)) + 1);
const stripStart = (text) => [...text].slice([...text].findIndex((c) => !EDGES.includes(c))).join("");
const bare = (word) => word.toLowerCase().replaceAll("ß", "ss").replaceAll("’", "'").replaceAll("ı", "i").normalize("NFD").replace(/\p{M}/gu, "");
export const WORD = /[\p{L}\p{N}_]+/gu;
/** The words of a text without case, where loose without accents, each between blanks. */
export function betweenBlanks(text, loose) {
  const fold = loose ? bare : (word) => word.toLowerCase().replaceAll("ß", "ss");
  return ` ${(plain(text).match(WORD) ?? []).map(fold).join(" ")} `;
}
const spans = (text, pattern) => [...text.matchAll(pattern)].map((match) => [match.index, match.index + match[0].length]);

/** Whether a text may begin with an English verb that has somebody before it. */
const isVerb = (text) => /^\S{3,}s(?=\s|$)/u.test(text);

/** Whether both are understood, as two actions. */
const differ = (first, second, sure = SURE) =>
  Math.min(first.certainty, second.certainty) > sure && first.action !== second.action;

/** Whether it says how far to go or to turn. */
export const isFar = ({ metres, steps, degrees }) => metres !== null || steps !== null || degrees !== null;

const opposite = (one, other) => one !== other && one !== "both" && other !== "both";

/** Of two partings, is the first one at least as good? */
function asGood(one, other) {
  const [a, b] = [one, other].map(({ parts, passed, certainty }) => [parts.length, -passed.length, certainty]);
  const at = a.findIndex((value, i) => value !== b[i]);
  return at < 0 || a[at] > b[at];
}

const best = (ways) => ways.reduce((found, way) => (asGood(found, way) ? found : way));

export class SentenceReader {
  /** @param {object} measures patterns and words @param {function} read what a text alone asks for:
   *  { action, certainty, arms, known } @param {function} strange whether a text asks for what nobody taught */
  constructor({ patterns, ...words }, read, strange = () => false) {
    const learned = (name) => read(PLAINLY[name][1]).action === PLAINLY[name][0].action;
    const known = (text) => {
      const { rest: calm } = this.withoutTempo(text);
      const name = Object.keys(PLAINLY).find((each) => this.says(each, calm));
      const found = name ? PLAINLY[name][0] : read(this.bared(text));
      if (surely(found)) return found;
      const paced = calm && calm !== text ? known(calm) : found; // how fast is no part of what is done
      return surely(paced) ? paced : found;
    };
    Object.assign(this, words, { learned, plainRead: read, read: known, strange });
    this.first = {}; this.each = {}; this.head = {}; this.entire = {}; this.there = {};
    for (const [name, pattern] of Object.entries(patterns)) {
      this.first[name] = new RegExp(pattern, "iu");
      this.each[name] = new RegExp(pattern, "giu");
      this.head[name] = new RegExp(`^(?:${pattern})`, "iu");
      if (name in PLAINLY || name === "conjunction") this.entire[name] = new RegExp(`^(?:${pattern})$`, "iu");
    }
  }

  clauses(sentence) {
    const text = this.staying(plain(this.tidied(sentence))), found = [];
    for (const whole of this.ordered(text)) {
      let last = found.at(-1), { parts: pieces, unheard } = this.joined(whole);
      const inRow = (whole.match(/[てで]、/gu) ?? []).length > 1;
      while (pieces.length) {
        const [first, ...others] = pieces;
        const pair = others.length ? this.atOnce(first, others[0], inRow) : null;
        const clause = pair ?? this.handed(first) ?? this.measured(first);
        found.push(last ? this.asBefore(last, clause) : clause);
        last = null;
        pieces = pair ? others.slice(1) : others;
      }
      const tail = found.pop();
      found.push({ ...tail, unheard: unheard || tail.unheard });
    }
    let real = found.filter((clause) => clause.text).map((clause) => this.inTempo(clause));
    if (!real.length) real = [plainClause(sentence)];
    const { text: first } = real[0], stands = this.learned("ups");
    if (this.first.downs.test(first) && LOW.includes(this.read(first).action)) real.unshift({ ...plainClause(STANDS), seconds: BEFORE });
    else if (stands && LOW.includes(this.read(SITS).action)) {
      if (this.first.ups.test(first)) real.unshift({ ...plainClause(SITS), seconds: BEFORE });
      else if (first === STANDS && real.length === 2 && this.first.ups.test(real[1].text)) real[0] = { ...real[0], text: SITS }; // "gets up after three seconds"
    }
    const said = real.at(-1), alone = real.length === 1;
    real = real.map((each) => this.inPlainWords(each, alone));
    const final = real.at(-1);
    if (final.text === SQUATS && said.text !== SQUATS && isPlain(final) && !said.once) real[real.length - 1] = { ...final, held: true }; // who crouches stays there
    for (const [at, clause] of real.entries()) {
      const before = real[at - 1] ?? plainClause(""), last = at === real.length - 1;
      if (at && clause.text === STANDS && clause.seconds === null && !last) {
        real[at] = { ...clause, seconds: RISEN };
        continue;
      }
      real[at] = this.seated(before, this.walkingBack(before, clause));
      if (at && real[at].seat && real[at] !== clause && isPlain(before) && !before.unheard) real[at - 1] = { ...before, seconds: LOW.includes(this.read(before.text).action) ? RISEN : LAID }; // there is more to come
    }
    return real;
  }

  /** Whether a text is one of a pattern of PLAINLY, whose words the model understands; falls may be something of its own. */
  says(name, text) {
    if (!this.entire[name].test(text) || !this.learned(name)) return false;
    if (name !== "falls") return true;
    const own = surely(this.plainRead(text));
    return !this.first.things.test(text) && (!own || LIES.includes(own)); // "the rain falls"
  }

  /** Who has turned round and goes back goes ahead. */
  walkingBack(before, clause) {
    const said = this.first.returns.exec(clause.text);
    if (!said || clause.degrees !== null) return clause;
    const turns = isPlain(before) && before.text && surely(this.read(before.text)) === "turn" && this.sideOf(before.text) === "both";
    if (Math.abs(before.degrees ?? 0) !== ABOUT && !turns) return clause;
    const text = this.without(clause.text, said, this.returned[bare(plain(said[0]))]);
    return text && GOING.includes(surely(this.read(text))) ? { ...clause, text: closed(text) } : clause;
  }

  /** What the arms do of who sits, kneels or lies: he goes on to, whether he does so already, does both at once, or a word says that he does ("kneeling, he waves"). */
  seated(before, clause) {
    const low = (text) => SEATED.includes(this.read(text).action);
    if (clause.meanwhile && low(clause.text))
      return { ...this.measured(clause.meanwhile), seat: clause.text, side: clause.side, mirrored: clause.mirrored, unheard: clause.unheard };
    if (clause.meanwhile || clause.held || isFar(clause)) return clause;
    const seat = before.seat || before.text;
    if (this.read(clause.text).arms && low(seat)) return { ...clause, seat, side: this.sideOf(clause.text) };
    const said = this.first.posture.exec(clause.text), rest = said ? this.without(clause.text, said) : "";
    if (!said || !this.read(rest).arms) return clause;
    return { ...clause, text: rest, seat: this.postures[bare(plain(strip(said[0])))], side: this.sideOf(rest) };
  }

  /** A clause in words of the tower; a bend that is all there is may be a walk. */
  inPlainWords(clause, alone) {
    let { meanwhile } = clause, text = this.bared(clause.text);
    if (this.says("ups", text)) text = STANDS;
    if (this.says("falls", text)) text = PLAINLY.falls[1];
    if (this.first.crouched.test(text) && this.plainRead(SQUATS).action === "squat" && [null, ...CROUCHES].includes(surely(this.plainRead(text)))) text = SQUATS;
    if (!alone && this.first.bends.test(text) && this.learned("bends") && surely(this.plainRead(text)) !== "turn")
      text = text.replace(this.first.bends, `turns ${this.sideOf(text)}`);
    if (this.entire.posed.test(meanwhile) && this.learned("posed") && surely(this.plainRead(meanwhile)) !== "raise")
      meanwhile = `raises ${clause.side} arm${clause.side === "both" ? "s" : ""}`;
    const spot = clause.metres === null && clause.degrees === null ? this.placeKept(text) : null;
    if (spot) {
      const rest = this.bared(this.without(text, spot));
      if (GOING.includes(surely(this.plainRead(rest)))) return { ...clause, text: rest, meanwhile, metres: 0 };
    }
    return { ...clause, text, meanwhile };
  }

  /** A text without the word that says how fast, and how many times as fast that is; as it is where two say otherwise ("quick, quick, slow"). */
  withoutTempo(text) {
    const found = new Set([...text.matchAll(this.each.tempo)].map(([said]) => this.tempos[bare(plain(said))]));
    if (found.size !== 1) return { rest: text, tempo: 1 };
    for (let said; (said = this.first.tempo.exec(text));) text = this.without(text, said);
    return { rest: closed(text), tempo: [...found][0] };
  }

  /** A clause that names a hand which alone does it, or one of two things at once; a hand by itself is no other thing. */
  handed(text) {
    const parted = this.parted(text), own = this.withoutHand(text);
    if (!parted || (own && !strip(parted.meanwhile.replace(this.each.handed, "")))) return own ?? parted;
    const arms = this.withoutHand(parted.meanwhile);
    return arms ? { ...parted, meanwhile: arms.text, mirrored: arms.mirrored } : parted;
  }

  /** A clause without the words that say with which hand or foot it is done, where it was learned of one of them alone ("salutes with the left hand", which is nearer to waves). */
  withoutHand(text) {
    const said = this.first.handed.exec(text);
    if (!said || this.first.denies.test(text.slice(0, said.index))) return null;
    const whole = this.read(text), side = this.sideOf(said[0]), [hop, foot, hops] = HOP;
    let clause = this.measured(closed(this.without(text, said)));
    if (whole.action === hop && (surely(whole) || this.first.footed.test(said[0]))) { // without a foot it is a jump
      const other = this.measured(closed(this.without(text, said, foot)));
      clause = surely(this.read(other.text)) === hop ? other : { ...clause, text: hops };
    }
    const own = this.read(clause.text), sure = surely(own) || (own.known && own.action === whole.action);
    return side === "both" || !sure || !own.handed || this.first.footed.test(said[0]) !== (own.action === hop) ? null : { ...clause, mirrored: side !== own.handed };
  }

  /** A clause that has its tempo, where what is done is read without that word, and no other thing is than with it. */
  inTempo(clause) {
    const { rest, tempo } = this.withoutTempo(clause.text);
    if (clause.steps !== null || rest === clause.text) return clause;
    const own = isPlain(clause) ? { ...this.measured(rest), unheard: clause.unheard } : { ...clause, text: rest };
    const what = this.read(own.text), said = surely(this.read(clause.text));
    if ((!surely(what) && !(what.action && what.known)) || (said && said !== what.action)) return clause;
    const [least, most] = PACES[what.action] ?? [0, Infinity];
    return { ...own, tempo: Math.min(Math.max(tempo, least), most) };
  }

  /** A text without its subject, where only then it is sure, or known, what it asks for; or where the subject alone asks for something else ("a zombie dies"). */
  bared(text) {
    const rest = this.withoutSubject(text);
    if (rest === text) return text;
    const [own, asked] = [rest, text].map((each) => this.plainRead(each)), someone = this.isSomebody(text);
    if (!surely(own) || !surely(asked)) {
      const turns = GOING.includes(own.action) && ["turn", "spin"].includes(asked.action); // near to each other
      return surely(own) && (someone || (asked.known === false && !turns)) ? rest : text;
    }
    if (own.action === asked.action) return someone && own.known && !asked.known ? rest : text;
    const moved = [...GOING, "stand"].includes(own.action) && asked.action === UNDEAD; // a way to move
    return this.isToldOf(text) && !someone && !moved ? rest : text;
  }

  /** A text without who does it: a word for a person, or a name behind an article, in English with a word between them, where it is sure what the rest asks for. */
  withoutSubject(text) {
    const rest = text.replace(this.first.subject, "");
    if (rest !== text) return rest;
    const found = spans(text, BLANKS).slice(1, 3).findIndex(([stop, start], number) => {
      const who = text.slice(0, stop), told = number ? this.isToldOf(text) : ENGLISH.test(who) || [...who.split(/\s+/u).at(-1)].length > SHORT;
      return told && this.first.named.test(who) && !this.first.things.test(who) && surely(this.plainRead(text.slice(start)));
    });
    return found < 0 ? text : text.slice(spans(text, BLANKS)[found + 1][1]);
  }

  /** Whether a text begins with a word for a person, which tells nothing of how he moves. */
  isSomebody(text) {
    return this.first.subject.test(text);
  }

  /** A sentence as one sample hears it: without what it denies, if one plain clause is left. */
  whole(sentence, found) {
    const text = this.tidied(sentence), [{ text: first }] = found;
    return found.length === 1 && isPlain(found[0]) && first !== this.trimmed(plain(text)) ? first : text;
  }

  /** A text with marks behind what is held, and clauses for where a body comes to a stand. */
  staying(text) {
    for (let place = 0; ;) {
      const found = ["held", "halts"].map((name) => this.match(name, text, place)).filter(Boolean);
      if (!found.length) return text;
      const match = found.reduce((a, b) => (b.index < a.index ? b : a)), end = match.index + match[0].length;
      const long = this.lasting(text, end), stop = long ? long[0] : end;
      let left = text.slice(0, match.index), said = "";
      const own = left.slice(left.lastIndexOf(ARROW.trim()) + 1), last = spans(own, this.each.joint).at(-1);
      let action = [last ? own.slice(last[1]) : own, own].map((each) => surely(this.reading(this.trimmed(each)))).find(Boolean) ?? null;
      const denied = /[不没别勿]/u.test(left.slice(-4));
      if (denied) action = null;
      const [stays, comes] = ["held", "halts"].map((name) => this.match(name, text, match.index, true));
      if (stays && !denied && ["crouch-walk", "crouch", "dodge", null].includes(action)) { // "crouches and stays down", not "sneaks, low"
        const whole = action && surely(this.reading(this.trimmed(own + match[0])));
        if (whole === "squat" || this.first.crouches.test(own)) [left, action] = [left.slice(0, left.length - own.length) + SQUATS, "squat"];
      }
      if (stays && HOLDABLE.includes(action)) said = long ? `${HELD}${long[1]}${HELD}` : HELD;
      else if (stays && LOW.includes(action)) said = long ? ` for ${ARRIVES + long[1]} seconds` : " ";
      else if (comes && action && ![...HOLDABLE, ...LOW].includes(action)) said = `${ARROW}${STANDS} for ${long ? long[1] : HALT} seconds`;
      place = end;
      if (!said) continue;
      const more = strip(text.slice(stop));
      text = `${left}${said}${more ? ARROW : ""}${more}`;
      place = left.length + said.length;
    }
  }

  /** A pattern's first match from a place on, or the one that begins there. */
  match(name, text, place, there = false) {
    const pattern = there ? (this.there[name] ??= new RegExp(this.each[name].source, "iuy")) : this.each[name];
    pattern.lastIndex = place;
    const found = pattern.exec(text);
    pattern.lastIndex = 0;
    return found;
  }

  /** Where seconds or minutes that stand at a place end, and how long they are. */
  lasting(text, place) {
    place += text.length - place - text.slice(place).trimStart().length;
    for (const name of ["seconds", "minutes"]) {
      const found = this.match(name, text, place, true);
      if (found) return [place + found[0].length, this.measured(found[0]).seconds ?? 0];
    }
    return null;
  }

  /** A clause that names nothing but a side does what the one before it does, to that side. */
  asBefore(before, clause) {
    if (clause.degrees !== null || !this.first.sideways.test(clause.text)) return clause;
    const [said, other] = [clause, before].map(({ text }) => this.first.left.exec(text) ?? this.first.right.exec(text));
    if (!said || !other || this.first.no_side.test(before.text)) return clause;
    const { text } = before;
    return { ...clause, text: text.slice(0, other.index) + said[0] + text.slice(other.index + other[0].length) };
  }

  /** Without greeting and thanks, with plain words for idioms and pauses and arrows for the numbers of a list; it itself where it has none. */
  tidied(sentence) {
    const text = this.withoutManners(sentence);
    return text === plain(sentence) ? sentence : text;
  }

  withoutManners(sentence) {
    let text = plain(sentence.replace(/([\u2460-\u2468])/gu, " $1) "));
    text = text.replace(this.first.greeting, "");
    text = (text.replace(this.first.closing, "") || text).replace(this.each.short, (cut) => cut.slice(0, -1));
    text = text.replace(this.first.halt_alone, STANDS);
    text = text.replace(this.each.idiom, (said) => this.plainly[bare(said)]);
    text = text.replace(this.each.goal, (...found) => {
      const way = plain(found.at(-1).way).toLowerCase();
      return this.plainly[way] ?? this.plainly[bare(way)];
    });
    text = stripStart(text.replace(this.each.instead, (said, ...found) =>
      found.find(Number.isInteger) && /[,;，、]$/u.test(said.trimEnd()) ? ", " : "")) || text;
    const armed = text;
    text = text.replace(this.each.undone, (said, ...found) => {
      const at = found.find(Number.isInteger), before = armed.slice(0, at), more = strip(armed.slice(at + said.length));
      if (!this.first.arms.test(before)) return said;
      return this.first.held.test(`${before},`) ? `${ARROW}${STANDS} for ${ARRIVES} seconds${more ? ARROW : ""}` : "";
    });
    text = text.replace(this.each.late, "$<pause> $<verb> $<rest>");
    for (const [name, factor] of PAUSES)
      text = text.replace(this.each[name], (...found) => {
        const { number, half } = found.at(-1), seconds = (this.value(number) + (half ? 0.5 : 0)) * factor;
        return seconds ? `${ARROW}${STANDS} for ${seconds} seconds${ARROW}` : found[0];
      });
    if (text.startsWith(ARROW.trimStart())) text = text.slice(ARROW.trimStart().length);
    if (text.endsWith(ARROW)) { // "he waves after two seconds"
      const parts = text.slice(0, -ARROW.length).split(ARROW), rest = parts.pop();
      text = [...parts.slice(0, -1), rest, ...parts.slice(-1)].join(ARROW);
    }
    const numbers = [...text.matchAll(NUMBERED)], [first] = numbers;
    if (numbers.length < 2 || !numbers.every((each, i) => Number(each[1]) === i + 1)) return text;
    const lead = text.slice(0, first.index).trim();
    if (/[:：]$/u.test(lead) || lead.split(/\s+/u).filter(Boolean).length < 3) text = text.slice(first.index + first[0].length);
    return text.replace(NUMBERED, ARROW);
  }

  /** What a list behind a few words and a colon asks for, where all of it is sure. */
  listed(text) {
    const [, head, rest] = text.match(/^([^:：]*)[:：](.*)$/su) ?? [], size = (words) => words.split(/\s+/u).filter(Boolean).length;
    const items = rest === undefined ? [] : rest.split(this.each.joint).map((item) => this.trimmed(item));
    const short = items.length > 1 && size(head) <= HEADING && items.every((item) => size(item) <= NAMED);
    return short && items.map((item) => this.read(this.measured(item).text)).every((found) => surely(found) && found.known) ? items : [];
  }

  ordered(text) {
    const listed = this.listed(text);
    if (listed.length) return listed;
    const after = this.head.after.exec(text), before = after ? null : this.head.before.exec(text);
    const word = after ?? before;
    let found = word && this.subordinate(text.slice(word[0].length));
    if (found && !this.isTime(text, 0, found[0])) found = null;
    if (before) found?.reverse();
    for (const [name, swapped] of [["beforehand", true], ["then", false], ["earlier", false], ["later", true], ["before", false], ["after", true]])
      for (const [start, stop] of found ? [] : spans(text, this.each[name])) {
        let left = text.slice(0, start), right = text.slice(stop);
        if (name === "then" && this.beginsAfter(text, start, stop)) continue;
        const bound = name === "before" || name === "after";
        const ended = bound && this.first.ended.exec(left);
        if (ended && (this.first.comma.test(right.trimStart().slice(1)) || (!ended.groups.stop && this.subordinate(right)))) { // "Sits. Once he has waved, he bows."
          found = [left, text.slice(start)];
          break;
        }
        if (bound && !this.isTime(text, start, right, true)) continue;
        const inner = bound && text.slice(start, stop).trimStart()[0] === "," && this.first.named.test(left.trim());
        const two = inner && this.first.comma.test(right) && this.subordinate(right);
        if (two) { // "The actor, after waving, bows."
          const own = `${left} ${two[1].trimStart()}`;
          found = swapped ? [two[0], own] : [own, two[0]];
          break;
        }
        if (name === "then" && /^\s*\p{L}/u.test(text.slice(start, stop))) [left, right] = this.around(left, right, text.slice(start, stop));
        if (!strip(left) || !strip(right)) continue;
        found = swapped ? [right, left] : [left, right];
        break;
      }
    if (found) return found.flatMap((part) => this.ordered(part));
    return [this.trimmed(this.head.then.test(text) ? text.replace(this.each.then, " ") : text)];
  }

  /** Whether a word of order is the first one of a longer phrase that says the opposite. */
  beginsAfter(text, start, stop) {
    const said = text.slice(start, stop), word = stripStart(said);
    const after = this.head.after.exec(text.slice(stop - word.length));
    const rest = after === null ? "" : text.slice(stop - word.length + after[0].length);
    if (after === null || this.head.seconds.test(rest) || this.head.minutes.test(rest)) return false;
    return after[0].trimEnd().length > stripEnd(word).length;
  }

  /** Whether "before" or "after" says when; a noun behind it may be a place or a thing. */
  isTime(text, start, right, sure = false) {
    if (!this.head.noun.test(text.slice(start))) return true;
    const { action, certainty, known = true } = this.hearing(this.trimmed(right.split(this.first.stop)[0]));
    return action === null || (certainty > SURE && (known || !sure));
  }

  subordinate(text) {
    const commas = spans(text, this.each.comma);
    if (!commas.length) { // "after walking in he waves | and then bows"
      const ends = ["then", "joint"].map((name) => this.first[name].exec(text)?.index).filter((at) => at !== undefined);
      const ands = spans(text, this.each.joint), end = Math.min(...ends); // not beside one
      const cuts = spans(text, BLANKS).filter(([at, to]) => !this.first.whoever.test(text.slice(0, at)) && !ands.some(([start, stop]) => to >= start && at <= stop));
      return (ends.length && this.best(text, cuts.filter(([, stop]) => stop < end))) || this.best(text, cuts);
    }
    const halves = this.best(text, commas) ?? [text.slice(0, commas[0][0]), text.slice(commas[0][1])];
    return halves.every((half) => strip(half)) ? halves : null;
  }

  around(left, right, then) {
    const last = spans(left, this.each.joint).at(-1), own = last ? left.slice(last[1]) : "";
    if (!strip(own)) return [left, right];
    if (strip(right) && !this.head.verb_then.test(then)) { // "und läuft dann langsam rückwärts" is one
      const two = differ(this.heard(this.trimmed(own)), this.heard(this.trimmed(right)));
      if (two || own.trim().split(/\s+/u).length > 3 || CJK.test(own)) return [left, right];
    }
    return [left.slice(0, last[0]), `${own.trimEnd()} ${right.trimStart()}`];
  }

  /** A text in which what is said again and again is said once, and how often. */
  counting(text) {
    if (this.saysNumber(text)) return text; // that is it
    return this.trimmed(text.replace(AGAIN, (said, piece) => {
      const number = said.toLowerCase().split(piece.toLowerCase()).length - 1, does = surely(this.heard(piece));
      return does && !GOING.includes(does) ? `${piece} ${number} times` : said;
    }));
  }

  joined(text) {
    text = this.counting(text);
    const denial = this.head.denial.exec(text) ?? this.first.refusal.exec(text);
    const who = denial && this.trimmed(text.slice(0, denial.index)); // "she" of "she doesn't walk, she jumps"
    if (denial && !(who && this.heard(who).certainty > SURE)) {
      const rest = this.trimmed(text.slice(denial.index + denial[0].length));
      const instead = this.hearing(rest), denied = surely(this.heard(this.trimmed(denial[0])));
      if (instead.certainty > SURE || (rest && denied && denied !== instead.action)) text = rest; // not in "don't move, please"
    }
    const borders = [[0, 0], ...spans(text, this.each.joint), [text.length, text.length]];
    const pieces = borders.slice(1)
      .map(([stop], i) => [borders[i][1], stop])
      .filter(([start, stop]) => strip(text.slice(start, stop)));
    const each = pieces.map((piece) => this.trimmed(text.slice(...piece)));
    const asides = pieces.map((piece, place) => this.isAside(text.slice(...piece), !place));
    const more = (piece) => this.first.meanwhile.test(piece) || MARK.test(piece);
    const odd = each.map((piece, i) => pieces.length > 1 && !asides[i] && !more(piece) && !surely(this.hearing(piece)) && this.strange(piece));
    // The best ways up to a piece, one for what their last part is.
    const ways = [new Map([["", { parts: [], passed: [], certainty: 0, action: null, side: "both", far: false }]])];
    for (let stop = 1; stop <= pieces.length; stop++) {
      const here = new Map([...ways[stop - 1]].map(([last, way]) => [last, { ...way, passed: [...way.passed, stop - 1] }]));
      for (let start = Math.max(0, stop - MOST_PIECES); start < stop; start++) {
        if (asides[start] && (start || asides.slice(0, stop).every(Boolean))) continue; // stays with what stands before it, or else behind it
        if (odd.slice(start, stop).some(Boolean)) continue;
        const part = this.trimmed(text.slice(pieces[start][0], pieces[stop - 1][1]));
        const clause = this.measured(part), far = isFar(clause);
        const { action, certainty } = this.hearing(part), side = this.sideOf(part);
        const led = (far && GOING.includes(action)) || (clause.seconds !== null && action === "stand"); // its measure says that it is to be done
        const last = `${action} ${side} ${far}`;
        const before = [...ways[start].values()].filter((way) => way.action !== action || (certainty > SURE && (opposite(way.side, side) || (far && way.far))));
        if (!before.length || certainty <= (led ? SURE_AT_MARK : SURE)) continue;
        const { parts, passed, certainty: sum } = best(before);
        const way = { parts: [...parts, part], passed, certainty: sum + certainty, action, side, far };
        if (!here.has(last) || asGood(way, here.get(last))) here.set(last, way);
      }
      ways.push(here);
    }
    const { parts, passed } = best([...ways.at(-1).values()]);
    const partly = odd.some(Boolean) && parts.some((part) => this.hearing(part).known ?? true);
    if (parts.length > 1 || partly) return { parts, unheard: unmarked(passed.map((i) => each[i]).join(", ")) };
    const lost = this.lost(text, pieces, each, (i) => asides[i] || more(each[i])), heard = pieces.filter((_, i) => !lost.includes(each[i]));
    return { parts: [lost.length ? this.trimmed(text.slice(heard[0][0], heard.at(-1)[1])) : text], unheard: unmarked(lost.join(", ")) };
  }

  /** Pieces beside an "and" that are not kept and of which nothing is heard, where another is known: "gets hit and doubles over". */
  lost(text, pieces, each, kept) {
    const read = each.map((piece) => this.hearing(piece));
    if (pieces.length < 2 || !read.some((found) => surely(found) && found.known)) return [];
    const joined = pieces.slice(1).map(([start], i) => this.entire.conjunction.test(text.slice(pieces[i][1], start)) && text[start] !== "'");
    return each.filter((piece, i) => {
      const own = this.measured(piece).text, size = CJK.test(own[0]) ? [...own].length / 2 : own.split(/\s+/u).length;
      const told = i > 0 && joined[i - 1] // with nobody or nothing else that does it
        ? (size > 2 || (size > 1 && isVerb(own))) && !this.first.another.test(piece)
        : joined[i] && this.isToldOf(piece); // elsewhere it may be a scene
      return told && !kept(i) && !surely(read[i]) && !read[i].known && !this.first.tempo.test(piece);
    });
  }

  /** Whether a text says in English of somebody behind an article what he does. */
  isToldOf(text) {
    return ENGLISH.test(text) && spans(text, BLANKS).slice(1, 3).some(([at, to]) => this.first.named.test(text.slice(0, at)) && isVerb(text.slice(to)));
  }

  /** Whether a piece names nothing but limbs, sides and posture, or, behind another one, says what is not done. */
  isAside(piece, first) {
    const rest = strip(piece.replace(this.each.aside, " "));
    return !rest || (!first && (this.head.lacking.test(rest) || this.head.similes.test(rest)));
  }

  /** The halves of a text that tell most surely of two actions, null where none do. */
  best(text, cuts) {
    let found = null, most = SURE; // both known, if any are
    for (const [stop, start] of cuts) {
      const halves = [text.slice(0, stop), text.slice(start)].map((half) => this.trimmed(half));
      const [first, second] = halves.map((half) => this.reading(half));
      if (second === GOT_UP && differ(first, second)) return halves; // "se | pone de pie" is surer, and wrong
      const rank = Math.min(first.certainty, second.certainty) + (first.known && second.known ? 1e6 : 0);
      if (differ(first, second) && rank > most) [found, most] = [halves, rank];
    }
    return found;
  }

  atOnce(first, second, inRow) {
    const said = [first, second].some((each) => this.first.meanwhile.test(each) || this.first.throughout.test(each));
    const pair = this.pair(first, second, said ? SURE_IF_SAID : SURE);
    if (!pair) return null;
    const sign = this.head.sign.test(second);
    const manner = this.first.manner.test(first) && pair.clause.meanwhile === first && !inRow;
    return said || pair.oneArmEach || (!pair.armsAlone && (sign || manner)) ? pair.clause : null;
  }

  parted(text) {
    const [marks, joints, signs] = ["meanwhile", "joint", "sign"].map((name) => spans(text, this.each[name]));
    const said = marks.length > 0 || this.first.throughout.test(text);
    const each = this.namesBoth(text), atSigns = signs.map(([start]) => [start, start]);
    const last = [...atSigns, ...(said || each ? spans(text, BLANKS) : [])];
    for (const [cuts, sure, enough] of [
      [marks, SURE_AT_MARK, SURE_AT_MARK],
      [joints, each ? SURE_AT_MARK : SURE_IF_SAID, SURE_IF_SAID],
      [last, SURE, SURE],
    ]) {
      let found = null;
      for (const [stop, start] of cuts) {
        const pair = this.pair(text.slice(0, stop), text.slice(start), sure);
        const atSign = stop === start && atSigns.some(([at]) => at === stop);
        if (!pair || !(pair.oneArmEach || (said && pair.certainty > enough) || (atSign && !pair.armsAlone))) continue;
        if (!found || pair.certainty > found.certainty) found = pair;
      }
      if (found) return found.clause;
    }
    for (const [start, stop] of spans(text, this.each.posed)) {
      const pair = this.pair(`${text.slice(0, start).trimEnd()} ${text.slice(stop).trimStart()}`, text.slice(start, stop), SURE);
      if (pair && (pair.oneArmEach || !pair.armsAlone)) return pair.clause;
    }
    return null;
  }

  /** Whether a text names the left and the right, or one of them and the other one. */
  namesBoth(text) {
    const said = text.replace(this.each.no_side, " ");
    return [this.first.left, this.first.right, this.first.other].filter((each) => each.test(said)).length > 1;
  }

  /** Sides of two halves, of which one may say "the other". */
  sides(halves) {
    const found = halves.map((half) => this.sideOf(half));
    halves.forEach((half, i) => {
      if (found[i] === "both" && found[1 - i] !== "both" && this.first.other.test(half)) found[i] = found[1 - i] === "right" ? "left" : "right";
    });
    return found;
  }

  /** A half that names its side, where it said "the other". */
  naming(half, side) {
    if (side === "both" || this.sideOf(half) === side) return half;
    return half.replace(this.each.other, (said) => this.others[bare(said)][Number(side === "right")]);
  }

  /** Two halves as one clause; null where they are not two actions, or the arms do neither. */
  pair(left, right, sure) {
    const halves = [left, right].map((half) =>
      this.trimmed(half.replace(this.each.throughout, " ").replace(this.each.meanwhile, " ")).replace(this.first.dangling, "")); // "walks with"
    if (halves.some((half) => this.first.limb.test(half))) return null;
    const [first, second] = halves.map((half) => this.reading(half));
    if (!(first.arms || second.arms) || !differ(first, second, sure)) return null;
    const [body, other] = first.arms && !second.arms ? [1, 0] : [0, 1];
    const sides = this.sides(halves), armsAlone = first.arms && second.arms;
    const named = halves.map((half, i) => this.naming(half, sides[i]));
    return {
      clause: { ...this.measured(named[body]), meanwhile: unmarked(named[other]), side: sides[other] },
      certainty: Math.min(first.certainty, second.certainty),
      armsAlone,
      oneArmEach: armsAlone && opposite(...sides),
    };
  }

  /** What a part asks for, without its measures. */
  reading(part) {
    return this.read(this.measured(part).text);
  }

  /** What a text asks for beside the hand that it names. */
  heard(text) {
    return this.read(this.withoutHand(text)?.text ?? text);
  }

  hearing(part) {
    return this.heard(this.measured(part).text);
  }

  sideOf(text) {
    const said = text.replace(this.each.no_side, " ");
    const [left, right] = [this.first.left.test(said), this.first.right.test(said)];
    return left === right ? "both" : left ? "left" : "right";
  }

  /** The degrees of a way in a figure of eight, or from side to side; none where a text names neither. */
  winding(text) {
    return this.first.eights.test(text) ? [360, -360] : this.first.winds.test(text) ? [45, -90, 90, -90, 45] : [];
  }

  /** A text without the words that name such a way. */
  unwound(text) {
    return text.replace(this.each.winds, " ").replace(this.each.eights, " ").trim();
  }

  goesRound(text) {
    return this.first.round.test(text) && !this.first.corner.test(text);
  }

  /** The words by which somebody who goes is to stay where he is; "his helmet in place" is no such thing. */
  placeKept(text) {
    const found = this.first.in_place.exec(text);
    if (!found || this.first.off.test(text)) return null;
    const before = strip(text.slice(0, found.index)), after = strip(text.slice(found.index + found[0].length));
    if (/^[\u3040-\u30ff\u3400-\u9fff]/u.test(found[0])) return after ? found : null;
    const isFirst = !before && after.split(/\s+/u).length <= FEW, last = !after || this.head.sign.test(after);
    const another = this.first.sign.test(before) || this.first.joint.test(before); // thing that is in place
    return isFirst || (last && !another) ? found : null;
  }

  /** Whether a text asks for something again and again. */
  saysOften(text) {
    return this.first.many.test(text);
  }

  /** Whether a text says how often, were it once. */
  saysNumber(text) {
    return this.first.often.test(text) || this.first.times.test(text);
  }

  /** Whether a text says that the head is down meanwhile. */
  bowsHead(text) {
    const said = this.first.bowed.exec(text), before = said ? text.slice(0, said.index) : "";
    return Boolean(said) && !this.first.denies.test(before) && !this.first.lacking.test(before);
  }

  turnsHead(text) {
    return this.first.head_turns.test(text);
  }

  /** A clause with its measures and its mark taken out. */
  measured(text) {
    const mark = MARK.exec(text);
    if (!mark) return this.withMeasures(text);
    const clause = this.withMeasures(unmarked(text));
    if (isFar(clause) || clause.count > 1) return clause; // led, and over when it is done
    const seconds = mark[1] === undefined ? clause.seconds : (clause.seconds ?? ARRIVES) + Number(mark[1]);
    return { ...clause, seconds, held: true };
  }

  withMeasures(text) {
    let clause = plainClause(text);
    const side = this.sideOf(text.replace(this.each.angle, " "));
    for (const [name, [field, factor, least]] of Object.entries(this.units)) {
      const match = [...clause.text.matchAll(this.each[name])].find(({ groups }) => this.value(groups.number) >= least);
      if (!match) continue;
      const { half, manner, noun } = match.groups;
      if (name === "steps" && this.first.uncounted.test(manner ?? "")) continue; // "raises two arms steps back"
      const value = (this.value(match.groups.number) + (half ? 0.5 : 0)) * factor + (clause[field] ?? 0); // a minute and ten seconds
      if (!(value > 0 && value <= this.most[field])) continue;
      const before = clause.text.slice(0, match.index);
      if (this.first.larger.test(before)) return clause; // "a hundred and fifty metres" are not fifty
      const stays = name === "steps" && (!before.trim() || this.first.takes.test(before)) ? this.stepping(manner ?? "", this.steps[bare(noun)]) : "";
      const rest = this.without(clause.text, match, stays);
      if (rest || name !== "steps") clause = { ...clause, text: rest, [field]: value };
    }
    const angle = clause.degrees === null && side !== "both" && this.first.angle.exec(clause.text);
    if (angle) clause = { ...clause, degrees: this.angles[bare(angle[0])] };
    const roundIt = this.first.corner.test(text) || this.first.round.test(text);
    const about = this.first.about.test(clause.text) && !roundIt && this.counted(clause).count === 1;
    if (clause.degrees === null && about) clause = { ...clause, degrees: ABOUT };
    if (clause.degrees !== null) return { ...clause, degrees: (side === "right" ? -1 : 1) * clause.degrees };
    return clause.metres === null && clause.seconds === null && clause.steps === null ? this.counted(clause) : clause;
  }

  stepping(manner, said) {
    const at = said.lastIndexOf(" ");
    return `${said.slice(0, Math.max(at, 0))} ${manner}${said.slice(at + 1)}`.trim();
  }

  counted(clause) {
    let match = this.first.often.exec(clause.text), number;
    if (match) number = this.adverbs[bare(match[0])];
    else {
      match = this.first.times.exec(clause.text) ?? this.first.bare.exec(clause.text);
      if (!match) return clause;
      number = Math.trunc(this.value(match.groups.number ?? match.groups.after));
    }
    const rest = this.without(clause.text, match);
    if (number < 1) return clause;
    if (number === 1) return { ...clause, once: rest !== "" && !this.first.piece.test(match[0]) };
    if (!rest) return clause;
    return number > this.maxCount ? { ...clause, text: rest, unheard: match[0] } : { ...clause, text: rest, count: number };
  }

  value(text) {
    const number = this.numbers[bare(text)];
    if (number !== undefined || !/^[一二三四五六七八九两零十百]+$/u.test(text)) return number ?? Number(text.replace(",", "."));
    let total = 0, last = 0;
    for (const sign of text.replaceAll("零", ""))
      if ("十百".includes(sign)) [total, last] = [total + (last || 1) * (sign === "十" ? 10 : 100), 0];
      else last = sign === "两" ? 2 : "一二三四五六七八九".indexOf(sign) + 1;
    return total + last;
  }

  without(text, match, stays = "") {
    return this.trimmed([text.slice(0, match.index).trimEnd(), ...(stays ? [stays] : []), text.slice(match.index + match[0].length).trimStart()].join(" "));
  }

  trimmed(text) {
    return strip(strip(text).replace(this.each.loose, ""));
  }
}
