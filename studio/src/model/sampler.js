// Prompts to features: noise, guidance, DDIM and DPM-Solver++(2M), known entries (src/shared/model/diffusion.py and
// generation/motion_generator.py).

import { WIDTH } from "../body/features.js";
import { noise } from "./noise.js";

const MEASURED = 60; // frames
const FAR = 0.01; // standard deviations between predictions of the same

export class Sampler {
  /**
   * @param {Denoiser} denoiser
   * @param {TextTower} tower
   * @param {object} settings of the model: mean, std [R*C], null_text, tags, schedule [[t, alpha bar]],
   *     sampler, guidance, clip, prediction, shifted [names] of one whose own few steps were learned, adapters {places [P*D], adapterOf [P]} or null
   */
  constructor(denoiser, tower, settings) {
    Object.assign(this, { denoiser, tower, settings });
  }

  /**
   * Raw features [T,R,C]; null where they are no longer wanted.
   * @param {string} prompt
   * @param {number} frames
   * @param {bigint|number} seed
   * @param {{known: Uint8Array, shown: Uint8Array, values: Float32Array}|null} given
   * @param {{guidance?: number, gone?: function}} options guidance: learned steps want none; gone: asked before each step
   */
  async sample(prompt, frames, seed, given = null, { guidance = this.settings.guidance, gone } = {}) {
    const { mean, std, schedule, nullText, tags, shifted } = this.settings, learned = shifted.length > 0;
    const size = frames * WIDTH, start = noise(seed, prompt, size), nothing = new Uint8Array(size);
    const shown = given ? given.shown.map((is, i) => is && given.known[i]) : nothing;
    const values = new Float32Array(size);
    if (given) for (let i = 0; i < size; i++) if (given.known[i]) values[i] = (given.values[i] - mean[i % WIDTH]) / std[i % WIDTH];
    const text = this.tower.encode(prompt), opened = this.opened(text);
    let x = start.slice(), before = null;
    for (let i = 0; i < schedule.length; i++) {
      if (gone && !this.denoiser.helpers.length) await new Promise((resolve) => setTimeout(resolve)); // else nobody is heard meanwhile
      if (gone?.()) return null;
      const [step, alphaBar] = schedule[i], next = i + 1 < schedule.length ? schedule[i + 1][1] : 1;
      const a = Math.sqrt(alphaBar), s = Math.sqrt(1 - alphaBar);
      let input = x;
      if (given) {
        input = x.slice();
        for (let j = 0; j < size; j++) if (given.known[j]) input[j] = shown[j] ? values[j] : a * values[j] + s * start[j];
      }
      const output = await this.guided(input, step, text, nullText, tags, shown, learned ? Math.min(guidance, 1) : guidance, opened, learned && i === 0);
      const clean = this.cleaned(x, output, a, s, given?.known, values), here = { clean, lambda: Math.log(a / s) };
      x = follow(x, this.settings.sampler === "ddim" ? clean : extrapolated(here, before, next), a, s, next);
      before = here;
    }
    const features = new Float32Array(size);
    for (let i = 0; i < size; i++) features[i] = given?.known[i] ? given.values[i] : x[i] * std[i % WIDTH] + mean[i % WIDTH];
    return features;
  }

  /**
   * What the only helper is worth, by a pass over the same noise: { helper, own } milliseconds and how far `apart` the predictions
   * are; or { error }, and then it helps no more.
   */
  async compare() {
    const { denoiser, settings: { schedule, nullText, tags, adapters } } = this, { helpers } = denoiser, size = MEASURED * WIDTH;
    const args = [[noise(0, "", size)], schedule[0][0], [nullText], tags, new Uint8Array(size), Number(Boolean(adapters))];
    const timed = async (help) => {
      denoiser.helpers = help;
      await denoiser.predict(...args); // code is compiled as it runs
      const start = performance.now(), [values] = await denoiser.predict(...args);
      return { values, took: performance.now() - start };
    };
    const own = await timed([]), other = await timed(helpers);
    const apart = own.values.reduce((most, value, i) => Math.max(most, Math.abs(value - other.values[i])), 0);
    if (apart < FAR) return { helper: other.took, own: own.took, apart, ...(denoiser.helpers.length ? {} : { error: denoiser.failed }) };
    denoiser.helpers = [];
    return { error: `it computes something else (${apart.toPrecision(2)} apart)` };
  }

  /** Which adapter a text opens, as the nearest place does; 0 for none. */
  opened(text) {
    const { adapters } = this.settings;
    if (!adapters) return 0;
    const { places, adapterOf } = adapters, dim = text.length;
    let nearest = 0, most = -Infinity;
    for (let row = 0; row < adapterOf.length; row++) {
      let cosine = 0;
      for (let i = 0; i < dim; i++) cosine += places[row * dim + i] * text[i];
      if (cosine > most) [nearest, most] = [row, cosine];
    }
    return Number(adapterOf[nearest]);
  }

  async guided(x, step, text, nullText, tags, shown, guidance, opened, first) {
    if (guidance === 1 || guidance === 0)
      return (await this.denoiser.predict([x], step, [guidance ? text : nullText], tags, shown, opened, first))[0];
    const [own, none] = await this.denoiser.predict([x, x], step, [text, nullText], tags, shown, opened);
    return own.map((value, i) => none[i] + guidance * (value - none[i]));
  }

  /** x_0 as predicted, within its limit; known entries as they are. */
  cleaned(x, output, a, s, known, values) {
    const { clip, prediction } = this.settings;
    return x.map((value, i) => {
      let clean = output[i];
      if (known?.[i]) clean = values[i];
      else if (prediction === "epsilon") clean = (value - s * output[i]) / a;
      else if (prediction === "v") clean = a * value - s * output[i];
      return clip === null ? clean : Math.min(Math.max(clean, -clip), clip);
    });
  }
}

/** x_0 of DPM-Solver++(2M) from this step and the one before, on the way to an alpha bar (Lu et al. 2022b, algorithm 2). */
function extrapolated({ clean, lambda }, before, next) {
  if (!before || next === 1) return clean;
  const share = (0.5 * (0.5 * Math.log(next / (1 - next)) - lambda)) / (lambda - before.lambda);
  return clean.map((value, i) => value + share * (value - before.clean[i]));
}

/** To the next alpha bar along the line through x and x_0 (Song et al. 2021, eq. 12, eta 0). */
function follow(x, clean, a, s, next) {
  const direction = Math.sqrt(1 - next), signal = Math.sqrt(next);
  return x.map((value, i) => signal * clean[i] + (direction * (value - a * clean[i])) / s);
}
