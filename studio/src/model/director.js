// All that the page can ask for: a sentence, a timeline, a path, clips
// (src/shared/pipelines/text.py, timeline.py, path.py, edit.py).

import { cut, decodeFeatures, FORWARD, framesOf, framesOfMotion, hastened, HEIGHT, joinArrays, LATERAL, removeDrift, ROOT, WIDTH, YAW_RATE } from "../body/features.js";
import { round } from "../body/curves.js";
import { ACTIONS, endsAtRest, measure, REPETITIONS, repetitions, sideCheck } from "../body/measurements.js";
import { FPS } from "../body/skeleton.js";
import { handsMeet, headBowed, postProcess, restToRest } from "../body/whole.js";
import { beside, chosenJoints, fill, held, keepEnds, NO_TEXT, redo } from "./edit.js";
import { naturalGait, naturalSway, pathConstraint, swaying, timePath } from "./path.js";
import { betweenBlanks, GOING, HALT, isFar, isPlain, lasting, plain, plainClause, RISEN, SentenceReader, STANDS, surely, UNDEAD, WORD } from "./sentence.js";
import { wordsOf } from "./scope.js";
import { freeConstraint, MotionStream, OVERLAP, retrySeeds, spannedFeatures, streamFeatures, TRIES, WINDOW } from "./stream.js";

const STEPPING = [...GOING, "side-step"], WALK_RATIO = 0.0062, CORNER = 90, CORNER_SECONDS = 2.3, TAKES = 3, TURN_SECONDS = 2.2, TURNING = (20 * Math.PI) / 180;
const MIN_FRAMES = 8, SHORTEST = 0.2, TURN_SPEED = 75, TURN_REST = 0.5, SPIN_SPEED = 120, WINDING_SPEED = 75, INSISTING = 3, ONCE = [2.5, 3], AT_ONCE = 5, LAP = 4.75, LONG_REST = 1, CLAP = 2, CLAPS = "claps three times", HELD_SECONDS = 4, STOP = 1, LEAST = 1, UNEASY = 0.5, REPEATED_OVERLAP = 10;

const ROUND = ["turn", "spin"], ARTICLE = / (?:a|an|the|un|una|une|el|la|los|las|le|les|ein|eine|einen|den|die|das)$/u;
const TAIL = /^[いえきぎくぐけげこしじすずせそたちってなねびべぶまみむめらりるれろん]{0,2}/u; // of a verb
const CLAP_PACE = 2, TO_LAND = 1.3, SETTLED = 0.1;

const countOf = (words) => words.split(/\s+/u).filter(Boolean).length;

export class Director {
  /** @param {Sampler} sampler @param {Scope} scope @param {object} settings of the model */
  constructor(sampler, scope, settings) {
    Object.assign(this, { sampler, scope, settings, bent: new Map(), forward: new Map() });
    this.reader = new SentenceReader(settings.measures, (text) => this.reading(text), (text) => this.unlearned(text));
  }

  /** What a text alone asks for, even where it seldom comes out. */
  reading(text) {
    if (!text) return { action: null, certainty: -Infinity, arms: false, handed: "" };
    const { nearest: [action], certainty, known } = this.scope.check(text);
    return { action: this.scope.twins(action)[0], certainty, arms: this.scope.meta.arms.includes(action), known, handed: this.scope.meta.handed?.[action] ?? "" };
  }

  /** Lines about sentences that the model hardly knows, or that count more than their seconds hold; null where all is well. */
  warning(prompt, seconds = Infinity) {
    const parts = this.reader.clauses(prompt);
    const texts = parts.flatMap(({ text, meanwhile }) => [text, meanwhile]).filter(Boolean);
    let lines = texts.map((text) => this.doubt(text));
    if (texts.length === 1) { // known without its measures, or as the same with them
      const said = this.reader.whole(prompt, parts), [asked, made] = [said, texts[0]].map((text) => this.nearest(text));
      const same = this.scope.twins(made).includes(asked) || asked === UNDEAD || isPlain(parts[0]) || parts[0].degrees !== null, line = this.doubt(said);
      if (isPlain(parts[0]) || (line === null && same)) lines = [line];
      const surer = this.reading(said).certainty >= this.reading(texts[0]).certainty;
      if (!same && surer && lines[0] === null && parts[0].count > 1) lines = [`“${said}” is “${asked}” by its number alone, and “${made}” without it; say it in other words.`];
    }
    const angled = new Set(parts.filter(({ degrees }) => degrees !== null).map(({ text }) => text)); // the angle says it
    const sure = (text) => angled.has(text) && ROUND.includes(surely(this.reading(text)));
    const told = texts.map((text, i) => this.unlearned(text) ?? (sure(text) ? null : lines[i])).filter(Boolean);
    for (const { unheard } of parts) if (unheard) told.push(this.unlearned(unheard) ?? `Nothing is made of “${unheard}”.`);
    for (const part of parts) {
      const { text, count } = part, own = seconds / parts.length;
      const led = isFar(part) || ROUND.includes(this.nearest(text)); // counts nothing
      if (count > 1 && !led && own * this.pace(part) < count * LEAST) told.push(`“${text}”: ${count} times in ${own.toFixed(1)} seconds is not seen; give it ${count * LEAST} or more.`);
    }
    return [...new Set(told)].join(" ") || null;
  }

  /** A line for a text that is hardly known, as it stands and said of a person. */
  doubt(text) {
    const line = this.scope.warning(text), what = line && surely(this.reading(text));
    if (!what) return line;
    const rest = this.reader.withoutSubject(this.reader.unwound(text)), said = [rest, `a person ${rest}`].map((other) => this.reading(other));
    return said.some((each) => each.known && surely(each) === what) ? null : line;
  }

  /** What a prompt asks for, in order; without who does it, where he alone makes a walk or a run go backwards. */
  async clauses(prompt) {
    const parts = this.reader.clauses(prompt);
    for (const [i, part] of parts.entries()) {
      const rest = GOING.includes(this.nearest(part.text)) && !this.reader.isSomebody(part.text) ? this.reader.withoutSubject(part.text) : part.text;
      if (rest !== part.text && !(await this.goesAhead(part.text)) && (await this.goesAhead(rest))) parts[i] = { ...part, text: rest };
    }
    return parts;
  }

  async goesAhead(text) {
    if (!this.forward.has(text)) {
      const { facing, stands } = await naturalGait(this.sampler, text, 0);
      this.forward.set(text, !stands && Math.abs(facing) < Math.PI / 2);
    }
    return this.forward.get(text);
  }

  /** A line if a text asks for what is none of a model's actions, whatever else it asks for. */
  unlearned(text) {
    const said = [false, true].map((loose) => betweenBlanks(text, loose)), { actions } = this.scope.meta;
    const known = new Set(actions), names = actions.map((name) => betweenBlanks(name, false)); // some are captions
    const taught = (words) => this.settings.ownWords && [...wordsOf(words)].every((word) => this.scope.words.has(word));
    const found = this.settings.unlearned
      .filter(([, words, loose]) => said[Number(loose)].includes(words)
        && !names.some((name) => name.includes(words)) && !taught(words))
      .map(([others, words, loose]) => ({ start: said[Number(loose)].indexOf(words), words, read: said[Number(loose)], learned: others.some((action) => known.has(action)) }))
      .sort((a, b) => a.start - b.start || b.words.length - a.words.length);
    const line = (asked) => `“${text}” asks ${asked}, which this model has not learned.`;
    if (this.reader.turnsHead(text)) return line("the head alone to turn");
    const spans = [...plain(text).matchAll(WORD)].map((word) => [word.index, word.index + word[0].length]), asked = [];
    let end = 0;
    for (const { start, words, read, learned } of found) {
      if (start < end) continue; // a part of what is named, or learned, already
      const whole = words.startsWith(" ");
      end = start + words.length - Number(whole); // words share the blank between them
      if (learned) continue;
      if (whole) asked.push(plain(text).slice(spans[countOf(read.slice(0, start))][0], spans[countOf(read.slice(0, end)) - 1][1]).replace(ARTICLE, ""));
      else asked.push(words + read.slice(end).match(TAIL)[0]);
    }
    return asked.length ? line(`for ${asked.map((each) => `“${each}”`).join(" and ")}`) : null;
  }

  /**
   * A motion of a scene.
   * @param {{blocks: {text: string, seconds: number}[], path: number[][]|null, clip: object|null}} scene
   * @param {bigint|number} seed
   */
  async make(scene, seed, told) {
    const options = { told };
    if (scene.clip) return this.edited(scene, seed, options);
    if (scene.path) return this.alongPath(scene, seed, options);
    if (scene.blocks.length === 1) return this.sentence(scene.blocks[0].text, scene.blocks[0].seconds, seed, options);
    return this.timeline(scene.blocks, seed, options);
  }

  /** Each text is read as a sentence is; the times of the blocks hold, and the clauses of a text share them. */
  async timeline(blocks, seed, options) {
    const parts = [], stretches = [];
    for (const { text, frames } of this.passages(blocks)) {
      const own = await this.clauses(text), stop = (i) => round((frames * i) / own.length), least = own.length * SHORTEST;
      if (own.length > 1 && frames < least * FPS) throw new Error(`“${text}” asks for ${own.length} things in ${(frames / FPS).toFixed(1)} seconds; give it ${least.toFixed(1)} or more.`);
      for (const [i, part] of own.entries()) {
        const timed = stop(i + 1) - stop(i), { passage, given } = await this.stretch(part, frames / FPS, seed, timed);
        stretches.push({ passage: { ...passage, timed }, given });
      }
      parts.push(...own);
    }
    return (await this.performed(parts, stretches, blocks.map(({ text }) => text).join(", then "), seed, options)).motion;
  }

  passages(blocks) {
    let end = 0, before = 0;
    return blocks.map(({ text, seconds }) => {
      end += seconds;
      const frames = round(end * FPS) - before;
      before += frames;
      return { text, frames, afresh: this.beginsStanding(text) };
    });
  }

  beginsStanding(text) {
    return this.scope.meta.gestures.includes(this.nearest(text));
  }

  /** Motion without end, of what is done of each text that is said. */
  stream(seed) {
    return new MotionStream(this.sampler, this.settings.post, (text) => this.plan(text), seed);
  }

  /** What a live body does of a text: its clauses, the last of them on and on. */
  async plan(text) {
    const parts = await this.clauses(text), found = [];
    for (const part of parts) {
      const mirrored = part.mirrored && !part.meanwhile;
      found.push({
        text: parts.length === 1 && !mirrored ? this.reader.whole(text, parts) : part.text,
        frames: round((await this.taking(part)) * FPS),
        afresh: this.beginsStanding(part.text),
        low: this.nearest(part.text) === "sit",
        mirrored,
        straight: this.goesStraight(part.text),
      });
    }
    return found;
  }

  /** Seconds of a clause that nothing leads, with more behind it. */
  async taking(clause) {
    const seconds = clause.seconds || (clause.steps && (await this.stepping(clause, 0)));
    if (seconds) return seconds;
    if (clause.metres) return clause.metres / (await naturalGait(this.sampler, clause.text, 0)).speed;
    return clause.count * lasting(clause, TAKES);
  }

  /** Whether a text asks for a way that nothing in it bends. */
  goesStraight(text) {
    const action = this.nearest(text);
    const sided = this.reader.sideOf(text) !== "both" || this.reader.winding(text).length > 0;
    return STEPPING.includes(action) && !this.reader.goesRound(text) && !(sided && GOING.includes(action));
  }

  // ---------------------------------------------------------------- a sentence

  async sentence(prompt, seconds, seed, options) {
    const parts = await this.clauses(prompt), frames = round(seconds * FPS);
    if (frames < MIN_FRAMES) throw new Error(`${seconds} seconds are too short; ask for ${(MIN_FRAMES / FPS).toFixed(2)} or more.`);
    const longest = this.settings.maxSeconds;
    const long = longest !== null && frames > round(longest * FPS);
    if (parts.length > 1 || !isPlain(parts[0]) || long || this.applauds(parts[0]) || this.cycle(parts[0]) || (await this.turns(parts[0])))
      return this.clausesOf(prompt, parts, seconds, seed, options);
    const said = this.reader.whole(prompt, parts), action = this.nearest(said);
    let best = null, missed = null;
    for (const trial of retrySeeds(seed)) {
      const guidance = (best === null ? 1 : INSISTING) * this.settings.guidance;
      const features = await this.sampler.sample(said, frames, trial, null, { guidance });
      removeDrift(features, this.steady(said));
      const rested = this.rested(postProcess(features, this.settings.post, { text: prompt }), [said]);
      const motion = this.reader.bowsHead(said) ? headBowed(rested) : rested;
      options.told?.(frames);
      const does = this.does(said, motion);
      if (best === null || does) best = motion;
      missed = does || !this.scope.meta.checked.includes(action) ? null : `“${prompt}”, read as “${action}”: none of ${TRIES} samples shows that, by how joints move; try another seed or other words.`;
      if (does) break;
    }
    return { ...best, missed };
  }

  async clausesOf(prompt, parts, seconds, seed, options) {
    const { motion, missed } = await this.made(prompt, parts, seconds, seed, options);
    for (const stop of [RISEN, HALT]) { // who stops before it begins as who is at rest does
      const stands = missed.filter((at) => this.nearest(parts[at - 1].text) !== "stand"), halt = { ...plainClause(STANDS), seconds: stop };
      if (!stands.length) break;
      const slow = parts.flatMap((part, at) => (stands.includes(at) ? [halt, part] : [part])), again = await this.made(prompt, slow, seconds, seed, options);
      if (again.missed.length < missed.length) return { ...again.motion, missed: unshown(prompt, again.missed.map((at) => slow[at].text)) };
    }
    return { ...motion, missed: unshown(prompt, missed.map((at) => parts[at].text)) };
  }

  /** The motion of clauses, and which gestures behind others do not show in it. */
  async made(prompt, parts, seconds, seed, options) {
    const stretches = [];
    for (const part of parts) {
      const once = parts.length > 1 && this.isSingle(part); // of several, each is done once
      stretches.push(await this.stretch(part, once ? Math.min(seconds, ONCE[1]) : seconds, seed));
    }
    const { passage, given } = stretches.at(-1), { text, steps, seconds: named } = parts.at(-1), action = this.nearest(text);
    const feet = !given && named === null && STEPPING.includes(action) ? round(steps ?? 0) * (action === "side-step" ? 2 : 1) : 0;
    if (feet) stretches[stretches.length - 1] = { passage: { ...passage, frames: passage.frames + round(TO_LAND * FPS + 0.15 * passage.frames) } };
    const { motion, spans } = await this.performed(parts, stretches, prompt, seed, options);
    const missed = [...parts.keys()].filter((at) => {
      const { text: said, meanwhile, seat } = parts[at], does = this.nearest(said);
      return at && !stretches[at].given && !meanwhile && !seat && does !== "stand" && this.scope.meta.gestures.includes(does) && !this.does(said, framesOfMotion(motion, ...spans[at]));
    });
    return { motion: feet ? untilLanded(motion, feet, stretches.at(-1).passage.frames, passage.frames) : motion, missed };
  }

  /** What clauses became, one after the other, and which frames are those of each. */
  async performed(parts, stretches, text, seed, options) {
    const passages = stretches.map(({ passage }) => passage);
    const given = freeConstraint(passages.reduce((sum, { frames }) => sum + frames, 0)), starts = [];
    let at = 0;
    let led = false;
    for (const stretch of stretches) {
      const { metres, text: said } = parts[starts.length], stands = at > 0 && !stretch.given && this.nearest(said) === "stand";
      const free = stands ? STOP : at > 0 && metres === 0 ? TURN_REST : 0; // who went comes to a stop first
      starts.push(at);
      if (stretch.given) {
        given.values.set(stretch.given.values, at * WIDTH);
        given.known.set(stretch.given.known, at * WIDTH);
      }
      for (let t = at; t < at + stretch.passage.frames; t++)
        if (stands || t < at + round(free * FPS)) given.known[t * WIDTH + ROOT + FORWARD] = given.known[t * WIDTH + ROOT + LATERAL] = Number(t >= at + round(free * FPS));
      led ||= stands || Boolean(stretch.given);
      at += stretch.passage.frames;
    }
    if (parts[0].held) given.known.fill(1, 0, passages[0].frames * WIDTH); // nothing comes before
    const sits = parts.map(({ seat, text: said }) => this.nearest(seat || said) === "sit");
    const under = passages.map((passage, i) => ({
      ...passage,
      ...(parts[i].seat ? { text: parts[i].seat, afresh: this.beginsStanding(parts[i].seat), window: undefined, miss: undefined, mirrored: false } : {}),
      low: sits[i] || Boolean(sits[i - 1]), // who sits gets up by a way of his own, too
    }));
    let { features, spans } = await spannedFeatures(this.sampler, under, seed, {
      ...options,
      constraint: led ? given : null,
      window: this.window(),
      overlap: parts.some(({ count }) => count > 1) ? REPEATED_OVERLAP : OVERLAP,
    });
    for (const [i, part] of parts.entries())
      if (part.meanwhile || part.seat) {
        const joints = chosenJoints([part.side === "both" ? "arms" : `${part.side}-arm`]);
        const arms = { ...(part.seat ? passages[i] : { text: part.meanwhile, mirrored: part.mirrored }), frames: spans[i][1] - spans[i][0] };
        features = await beside(this.sampler, arms, features, spans[i][0], joints, seed, part.seat);
      }
    const shown = [], joined = () => shown.reduce((sum, piece) => sum + framesOf(piece), 0);
    let end = 0;
    spans = parts.map((part, i) => {
      const [start, stop] = spans[i], does = cut(features, start, stop);
      if (part.degrees === null && part.metres === null) removeDrift(does, this.steady(part.text, parts.length === 1));
      if (!stretches[i].given) this.straighten(part.text, does);
      shown.push(hastened(cut(features, end, start), part.tempo));
      end = stop;
      const first = joined();
      shown.push(hastened(does, this.pace(part), passages[i].timed));
      return [first, joined()];
    });
    const motion = postProcess(joinArrays(shown), this.settings.post, { text });
    let rested = this.rested(motion, [parts[0].text, parts.at(-1).text], parts.at(-1).held);
    for (const [i, { count, text, meanwhile }] of parts.entries()) {
      const [start, stop] = spans[i];
      if (this.nearest(meanwhile || text) === "clap") rested = handsMeet(rested, start, stop);
      else if (count > 1 && this.byArms(text) && !(this.nearest(text) in REPETITIONS))
        rested = restToRest(rested, Array.from({ length: count - 1 }, (_, k) => start + Math.floor(((stop - start) * (k + 1)) / count)));
      if (this.reader.bowsHead(text)) rested = headBowed(rested, start, stop);
    }
    return { motion: { ...rested, text }, spans };
  }

  /** Frames of a window: no more than the model has seen, where two overlaps fit in that. */
  window() {
    return Math.min(WINDOW, Math.max(2 * OVERLAP, round((this.settings.maxSeconds ?? WINDOW / FPS) * FPS)));
  }

  /** What one clause becomes, and what is known of its frames; they are `exactly` so many. */
  async stretch(clause, seconds, seed, exactly = null) {
    if (exactly !== null) clause = { ...clause, seconds: exactly / FPS };
    const { text, count } = clause, afresh = this.beginsStanding(text);
    if (clause.steps !== null && clause.seconds === null) clause = { ...clause, seconds: await this.stepping(clause, seed) };
    const pace = this.pace(clause);
    if (clause.seconds !== null) {
      seconds = clause.seconds;
      clause = { ...clause, seconds: seconds * pace };
    } else if (!GOING.includes(this.nearest(text))) seconds = lasting(clause, seconds);
    const frames = Math.max(1, round(Math.max(1, round(seconds * FPS)) * pace));
    seconds *= pace;
    if (exactly !== null) exactly = frames;
    const low = this.nearest(text) === "sit"; // gone down to by a way of its own
    const mirrored = clause.mirrored && !clause.meanwhile;
    const led = (given) => ({ passage: { text, frames: framesOf(given.values), afresh, low, mirrored }, given });
    if (this.applauds(clause) && !(await this.turns(clause))) {
      const claps = Math.max(1, round(seconds / CLAP));
      if (claps > 1) return this.repeated({ ...clause, count: claps }, CLAPS, seconds, frames);
      if (!clause.held) return { passage: { text: CLAPS, frames, afresh: this.beginsStanding(CLAPS), miss: this.miss(clause, frames) } };
    }
    if (await this.turns(clause)) return led(await this.turn(clause, seconds, seed));
    if (clause.metres === 0) {
      const given = freeConstraint(frames);
      for (let at = ROOT; at < given.values.length; at += WIDTH) given.known[at + FORWARD] = given.known[at + LATERAL] = 1; // on the spot
      return led(given);
    }
    if (clause.metres !== null) {
      const gait = await naturalGait(this.sampler, text, seed);
      const last = clause.seconds === null ? null : Math.max(clause.seconds * FPS - 1, 1) / FPS;
      const timed = (seconds) => timePath([[0, 0], [0, clause.metres]], { ...gait, seconds });
      let path;
      try {
        path = timed(last);
      } catch (error) {
        if (exactly !== null) throw error;
        path = timed(null); // nobody goes so fast: it takes its own time
      }
      return led(pathConstraint(swaying(path, await this.sway(text, path.points.length, seed))));
    }
    if (count > 1 || (exactly === null && this.cycle(clause))) return this.repeated(clause, text, seconds, exactly, mirrored);
    if (clause.held) return led(await this.held(clause, frames, seed, mirrored));
    return { passage: { text, frames, afresh, low, mirrored, miss: this.miss(clause, frames) } };
  }

  /** Whether a clause asks for something that is seen once, and for no more of it. */
  isSingle({ text, held }) {
    const action = this.nearest(text);
    return action in REPETITIONS && action !== "clap" && !held && !this.reader.saysOften(text);
  }

  /** Whether a clause asks for claps and does not say how many. */
  applauds({ text, count, metres }) {
    if (this.nearest(text) !== "clap" || count > 1 || metres !== null) return false;
    const known = this.reading(CLAPS);
    return known.action === "clap" && known.certainty > 0 && !this.reader.saysNumber(text);
  }

  /** Seconds of rest and from one to the next, of what is done in cycles, if a clause says how often. */
  cycle({ text, count, once }) {
    return count > 1 || once ? this.scope.meta.cycles?.[this.nearest(text)] : null;
  }

  /** How many times as fast a clause is shown as the network makes it. */
  pace(clause) {
    const claps = this.nearest(clause.text) === "clap" && clause.metres === null && clause.degrees === null;
    return clause.tempo * (claps && (clause.count > 1 || this.applauds(clause)) ? CLAP_PACE : 1);
  }

  /** What a clause asks for several times, each in a window of its own, or as many as one holds of what is done in cycles. */
  repeated(clause, text, seconds, exactly, mirrored = false) {
    const { count } = clause, cycle = exactly === null && this.cycle(clause);
    let once = exactly !== null ? Math.ceil(exactly / count) : round(Math.min(Math.max(seconds / count, ONCE[0]), ONCE[1]) * FPS), frames = exactly ?? once * count;
    if (cycle) {
      const [rest, period] = cycle, lap = count * period, least = rest + lap <= AT_ONCE ? 1 : Math.ceil(lap / (LAP - rest));
      const most = rest >= LONG_REST ? count : Math.floor(count / 2); // one in each window, or two at least
      let windows = least;
      while (windows <= most && count % windows) windows++; // which are alike in length
      if (windows > most) windows = least;
      once = round((rest + Math.ceil(count / windows) * period) * FPS);
      frames = round((windows * rest + lap) * FPS);
    }
    return { passage: { text, frames, afresh: this.beginsStanding(text), low: this.nearest(text) === "sit", mirrored, window: once + REPEATED_OVERLAP, miss: this.miss(clause, frames) } };
  }

  /** Whether the heading of a clause is led: it names an angle, spins, or bends its way. */
  async turns({ degrees, metres, count, text }) {
    if (degrees !== null || this.nearest(text) === "spin") return true;
    if (this.nearest(text) === "turn" && this.reader.sideOf(text) !== "both") return !this.reader.turnsHead(text);
    return metres === null && count === 1 && (await this.bends(text)).length > 0;
  }

  /** Seconds of the clause's steps at its own pace; null where it does not go. */
  async stepping({ steps, text }, seed) {
    if (!STEPPING.includes(this.nearest(text))) return null;
    const { speed } = await naturalGait(this.sampler, text, seed);
    return steps * Math.sqrt((60 * WALK_RATIO) / speed);
  }

  /** Degrees by which a walk or a run turns that is to turn, one after the other: seen in what the network makes of it. */
  async bends(text) {
    const side = this.reader.sideOf(text), around = this.reader.goesRound(text), named = this.reader.winding(text);
    if (!GOING.includes(this.nearest(text))) return [];
    if (named.length || !(around || side !== "both")) return named;
    if (!this.bent.has(text)) {
      const { turning } = await naturalGait(this.sampler, text, 0), left = side === "both" ? turning > 0 : side === "left";
      const angle = around ? 360 : Math.abs(turning) < TURNING ? 0 : CORNER;
      this.bent.set(text, left ? angle : -angle);
    }
    return [this.bent.get(text)].filter(Boolean);
  }

  /** By the angle that is named; round a corner or in a circle; else in full circles, as many as are named or as fill the seconds. */
  async turn({ degrees, text, count, seconds: named }, seconds, seed) {
    const turns = this.nearest(text) === "turn", side = this.reader.sideOf(text);
    if (degrees !== null) {
      const given = turned(degrees, named ?? undefined);
      return turns ? onTheSpot(given) : given;
    }
    if (turns && side !== "both") {
      const angle = CORNER * count * (side === "left" ? 1 : -1);
      return onTheSpot(count > 1 ? turned(angle, named ?? undefined) : turned(angle, seconds, Math.max((seconds - TURN_SECONDS) / 2, TURN_REST)));
    }
    const bends = await this.bends(text), total = bends.reduce((sum, bend) => sum + Math.abs(bend), 0);
    if (total && named === null) seconds = Math.max(seconds, total / (bends.length > 1 ? WINDING_SPEED : SPIN_SPEED) + 2 * TURN_REST);
    if (total) {
      const given = total === CORNER ? turned(bends[0], seconds, Math.max((seconds - CORNER_SECONDS) / 2, TURN_REST)) : circled(bends, seconds);
      for (const [t, rate] of (await this.sway(text, framesOf(given.values), seed)).entries()) given.values[t * WIDTH + ROOT + YAW_RATE] += rate;
      return given;
    }
    const around = 360 / SPIN_SPEED;
    let circles = count;
    if (circles <= 1) circles = Math.max(round((seconds - 2 * TURN_REST) / around), 1);
    else if (named === null) seconds = circles * around + 2 * TURN_REST;
    const left = side === "both" ? BigInt(seed) % 2n === 0n : side === "left";
    return turned(360 * (left ? circles : -circles), seconds);
  }

  /** What is done, and stays as it is then. */
  async held(clause, frames, seed, mirrored) {
    const { text } = clause, first = Math.min(frames, round(HELD_SECONDS * FPS));
    const alone = { text, frames: first, afresh: this.beginsStanding(text), mirrored, miss: this.miss(clause, first) };
    return held(await streamFeatures(this.sampler, [alone], seed), frames);
  }

  /** Who goes on for longer than a window, and does not turn in the mean, goes straight on. */
  straighten(text, features) {
    const frames = framesOf(features), at = (t) => t * WIDTH + ROOT + YAW_RATE;
    let turned = 0;
    for (let t = 0; t < frames; t++) turned += features[at(t)];
    if (!STEPPING.includes(this.nearest(text)) || frames <= WINDOW || Math.abs(turned) >= TURNING * frames) return;
    for (const [t, rate] of naturalSway(features).entries()) features[at(t)] = rate;
  }

  async sway(text, frames, seed) {
    return naturalSway(await streamFeatures(this.sampler, [{ text, frames }], seed));
  }

  nearest(text) {
    return text ? (this.scope.check(text).nearest[0] ?? null) : null;
  }

  byArms(text) {
    return this.scope.meta.arms.includes(this.nearest(text));
  }

  /** The columns of the root row that have no mean in a text's motion. */
  steady(text, alone = true) {
    const undead = this.nearest(text) === UNDEAD && this.reader.sideOf(text) === "both"; // all of them curl
    if (!this.scope.meta.still?.includes(this.nearest(text))) return undead || this.byArms(text) ? [YAW_RATE] : [];
    return alone ? [FORWARD, LATERAL, YAW_RATE] : [YAW_RATE];
  }

  rested(motion, texts, held = false) {
    const actions = texts.map((text) => this.nearest(text));
    if (actions.some((action) => this.scope.meta.gestures.includes(action))) motion = restToRest(motion, null, held);
    return String(actions) === "clap" ? handsMeet(motion) : motion;
  }

  wanted(text) {
    const action = this.nearest(text), { checked, arms } = this.scope.meta;
    if (action === null) return null;
    const side = sideCheck(action, this.reader.sideOf(text), arms.includes(action));
    const seen = [...(checked.includes(action) ? [ACTIONS[action]] : []), ...(side ? [side] : [])];
    return seen.length ? (m) => seen.every((check) => check(m)) : null;
  }

  does(prompt, motion) {
    const wanted = this.wanted(prompt);
    return wanted === null || motion.frames / FPS < LEAST || wanted(measure(motion));
  }

  /** How far a passage of so many frames is from showing what its clause asks for. */
  miss(clause, frames) {
    const wanted = this.wanted(clause.text), action = this.nearest(clause.text), side = this.reader.sideOf(clause.text);
    if (action === null || frames < LEAST * FPS) return null;
    const rests = this.scope.meta.gestures.includes(action), latest = this.window(), pace = frames < Infinity ? this.pace({ ...clause, tempo: 1 }) : 1; // edits are shown as they are made, and what is shown fast or slowly is looked at as it is made
    if (wanted === null && !rests) return null;
    return (features) => {
      const motion = pace > 1 ? handsMeet(postProcess(hastened(features, pace), this.settings.post, {})) : decodeFeatures(features);
      const seen = measure(motion), made = framesOf(features);
      const count = clause.count > 1 || (frames <= ONCE[1] * FPS && this.isSingle(clause)) ? repetitions(action, seen, side) : null;
      let found = Number(wanted !== null && !wanted(seen));
      if (found && made > latest) // one bad window is none of those that follow, and feet are cleaned up yet
        found = Number(!wanted(measure(postProcess(cut(features, made - latest, made), this.settings.post, {}))));
      if (count !== null) found = Math.abs(count - round((clause.count * made) / frames));
      return found + UNEASY * Number(rests && made >= frames && !endsAtRest(motion));
    };
  }

  /** 1 for frames that do not show the action of a text, as far as kinematics tell, else 0. */
  unseen(text) {
    const [{ text: first }, ...others] = this.reader.clauses(text);
    return others.length ? null : this.miss(plainClause(first), Infinity);
  }

  // ---------------------------------------------------------------- a path, clips

  async alongPath({ blocks, path }, seed, options) {
    const alone = blocks.length === 1, passages = this.passages(blocks);
    const gait = await naturalGait(this.sampler, blocks[0].text, seed);
    const total = passages.reduce((sum, { frames }) => sum + frames, 0);
    const timed = timePath(path, { ...gait, seconds: alone ? blocks[0].seconds : (total - 1) / FPS });
    // Rounding may make a path a frame longer or shorter than its sentences: the last one gives way.
    passages[passages.length - 1].frames += timed.points.length - total;
    const sway = naturalSway(await streamFeatures(this.sampler, passages, seed, { ...options, told: undefined }));
    const given = pathConstraint(swaying(timed, sway));
    const features = await streamFeatures(this.sampler, passages, seed, { ...options, constraint: given });
    return postProcess(features, this.settings.post, {
      known: given.known,
      text: passages.map(({ text }) => text).join(", then "),
      place: { x: timed.points[0][0], z: timed.points[0][1], heading: timed.headings[0] },
      carried: true,
    });
  }

  /** `clip`: { motion, mode: continue | between | redo, from, until, keep, joints } in seconds. */
  async edited({ blocks, clip }, seed, options) {
    const text = blocks.map((block) => block.text).join(", then "), { motion, mode } = clip;
    const seconds = blocks.reduce((sum, block) => sum + block.seconds, 0), kept = round(clip.keep * FPS);
    let given;
    if (mode === "redo") {
      const start = round(clip.from * FPS), stop = Math.min(round(clip.until * FPS), motion.frames);
      if (!(start >= 0 && start < stop)) throw new Error(`The clip lasts ${(motion.frames / FPS).toFixed(2)} seconds; choose a span of it.`);
      given = redo(motion, start, stop, clip.joints.length ? chosenJoints(clip.joints) : null);
    } else {
      const ends = mode === "between" ? 2 : 1, frames = round(seconds * FPS) + ends * kept;
      if (motion.frames < kept) throw new Error(`The clip lasts ${(motion.frames / FPS).toFixed(2)} seconds, less than the ${clip.keep} to be kept.`);
      const own = mode === "between" ? motion : framesOfMotion(motion, motion.frames - kept, motion.frames);
      given = keepEnds(own, mode === "between" ? (clip.second ?? motion) : null, kept, frames, mode === "between" && !clip.second);
    }
    const more = text ? { miss: this.unseen(text) } : { guidance: 0 };
    const said = text && this.reader.whole(text, this.reader.clauses(text));
    const { features, known } = await fill(this.sampler, said || NO_TEXT, given, seed, { ...options, ...more });
    const made = postProcess(features, this.settings.post, { known, text, place: given.place });
    return { ...made, missed: text ? this.unlessShown(text, made, given.constraint.known) : null };
  }

  /** A line if what was made of a clip does not show the action of its text. */
  unlessShown(text, motion, known) {
    const free = [...Array(motion.frames).keys()].filter((t) => cut(known, t, t + 1).includes(0));
    const [{ text: first }, ...others] = this.reader.clauses(text);
    if (!free.length || others.length || this.does(first, framesOfMotion(motion, free[0], free.at(-1) + 1))) return null;
    return `“${text}”: what was made anew does not show “${this.nearest(first)}”, by how joints move; look at it, try a longer span, another seed, or a clip that stands.`;
  }
}

/** A line of gestures that do not show in a sequence, else null. */
const unshown = (prompt, texts) =>
  texts.map((text) => `“${prompt}”: “${text}” does not show behind what comes before it, by how joints move; try another seed or other words.`).join(" ") || null;

/** The motion as far as the frame in which a foot has landed so many times (src/shared/motion/postprocess/whole.py). */
function untilLanded(motion, steps, last, otherwise) {
  const start = motion.frames - last, lands = [], stands = (t, foot) => motion.contacts[(start + t) * 2 + foot] > 0.5;
  for (let t = 1; t < last; t++) if (t >= (0.5 * otherwise) / steps && [0, 1].some((foot) => stands(t, foot) && !stands(t - 1, foot))) lands.push(t);
  if (lands.length >= steps) otherwise = Math.min(lands[steps - 1] + round(SETTLED * motion.fps), last);
  return framesOfMotion(motion, 0, start + otherwise);
}

/** A led turn whose place is known from where it begins to turn: who walked has come to a stop. */
function onTheSpot(given) {
  let t = 0;
  while (!given.values[t * WIDTH + ROOT + YAW_RATE]) t++;
  for (; t < framesOf(given.values); t++)
    for (const column of [FORWARD, LATERAL]) {
      given.values[t * WIDTH + ROOT + column] = 0;
      given.known[t * WIDTH + ROOT + column] = 1;
    }
  return given;
}

/** A heading that turns by so many degrees, one after the other, as fast at any moment: once round, a way that closes. */
function circled(degrees, seconds) {
  const given = freeConstraint(round(seconds * FPS)), frames = framesOf(given.values), angles = degrees.map((angle) => (angle * Math.PI) / 180);
  const total = angles.reduce((sum, angle) => sum + Math.abs(angle), 0);
  let turned = 0;
  const ends = angles.map((angle) => ((turned += Math.abs(angle)) / total) * frames);
  for (let t = 0; t < frames; t++) {
    const at = ends.findIndex((end, i) => t < end || i === ends.length - 1);
    given.values[t * WIDTH + ROOT + YAW_RATE] = (Math.sign(angles[at]) * total) / seconds;
    given.known[t * WIDTH + ROOT + YAW_RATE] = 1;
  }
  return given;
}

/** A heading that turns by so many degrees, positive to the left; not for so many seconds before and after. */
function turned(degrees, seconds = Math.max(Math.abs(degrees) / TURN_SPEED, 1) + 2 * TURN_REST, still = TURN_REST) {
  const rest = round(Math.min(still, seconds / 4) * FPS), moving = Math.max(round(seconds * FPS) - 2 * rest, 1);
  const given = freeConstraint(moving + 2 * rest);
  const heading = (i) => ((degrees * Math.PI) / 180) * (3 * (i / moving) ** 2 - 2 * (i / moving) ** 3);
  for (let t = 0; t < moving + 2 * rest; t++) {
    const i = t - rest, at = t * WIDTH + ROOT + YAW_RATE;
    if (i >= 0 && i < moving) given.values[at] = (heading(i + 1) - heading(i)) * FPS;
    given.known[at] = 1;
  }
  return given;
}
