// All that computes, without the page: runs in a worker, or in the page where there are none.

import * as ort from "onnxruntime-web/wasm";

import { useSkeleton } from "./body/skeleton.js";
import { Denoiser } from "./model/denoiser.js";
import { Director } from "./model/director.js";
import { Sampler } from "./model/sampler.js";
import { Scope } from "./model/scope.js";
import { TextTower } from "./model/tower.js";
import { Tokenizer } from "./model/tokenizer.js";
import { Weights } from "./model/safetensors.js";

export class Engine {
  /** @param {object} settings of the page @param {Object<string, Uint8Array>} parts unpacked @param {function[]} helpers that predict */
  static async open(settings, parts, helpers = []) {
    useSkeleton(settings.skeleton);
    const weights = new Weights(parts.weights);
    const tower = new TextTower(weights, new Tokenizer(parts.tokenizer, settings.maxTokens));
    const denoiser = Object.assign(new Denoiser(ort, parts, settings.weights, settings.shifted), { helpers });
    const model = {
      ...settings,
      mean: weights.floats("statistics.mean"),
      std: weights.floats("statistics.std"),
      nullText: weights.floats("denoiser.null_pooled"),
      adapters: settings.adapters && {
        places: weights.floats("denoiser.places"),
        adapterOf: weights.raw("denoiser.adapter_of", BigInt64Array),
      },
    };
    const scope = new Scope(settings.scope, new Weights(parts.scope), tower);
    return new Engine(new Director(new Sampler(denoiser, tower, model), scope, model));
  }

  constructor(director) {
    this.director = director;
  }

  /** Motion of a scene with a seed; `told` hears of frames that are done. */
  make({ scene, seed }, told) {
    return this.director.make(scene, seed, told);
  }

  /** What comes next of a body that goes on and on, and does as soon as possible what the text says; `begin`: of a new one, with a seed. */
  live({ text, seed, begin }) {
    if (begin) this.stream = this.director.stream(seed);
    return this.stream.next(text);
  }

  /** What a body that goes on is to do instead, also while what comes next is made. */
  say({ text }) {
    return this.stream?.say(text);
  }

  /** What its helper is worth: see `Sampler.compare`. */
  compare() {
    return this.director.sampler.compare();
  }

  warning({ text, seconds }) {
    return this.director.warning(text, seconds);
  }
}
