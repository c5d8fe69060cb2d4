// The denoiser in onnxruntime, its code and weights given as bytes: one thread of WebAssembly, or a graphics card.

import { Weights } from "./safetensors.js";

export class Denoiser {
  /**
   * @param {object} ort onnxruntime, with WebAssembly alone or with WebGPU
   * @param {object} parts bytes: wasm of onnxruntime; graph, and adapted for a model with adapters,
   *     without weights; weights, a safetensors file
   * @param {object} names of the weights that each graph reads
   * @param {string[]} shifted the vectors that a learned step changes; none where none was learned
   * @param {boolean} graphics whether a card computes. It has a session for each adapter, whose weights are those of
   *     the graph without adapters, changed: no shader has a buffer for each part of the other graph's input.
   */
  constructor(ort, parts, names, shifted = [], graphics = false) {
    ort.env.wasm.numThreads = 1;
    ort.env.wasm.wasmBinary = parts.wasm.buffer;
    ort.env.logLevel = "error";
    Object.assign(this, { ort, parts, names, shifted, graphics, weights: new Weights(parts.weights) });
    this.sessions = {};
    this.adapters = {}; // of so many samples each, as they are used
    this.helpers = []; // predict in its place, elsewhere and at the same time, until one has failed
    this.failed = null; // what it said
  }

  /** For an adapter, as it is for the first of few steps where that is `first`: opened when it is first needed, and again where that failed. */
  session(opened, first = false) {
    const graph = opened && !this.graphics ? "adapted" : "graph", own = this.graphics ? opened : 0, key = `${graph} ${own} ${first}`;
    this.sessions[key] ??= this.ort.InferenceSession.create(this.parts[graph], {
      externalData: this.names[graph].map((path) => ({ path, data: new Uint8Array(this.weights.ready(path, first ? this.shifted : null, own).buffer) })),
      executionProviders: [this.graphics ? "webgpu" : "wasm"],
      logSeverityLevel: 3, // errors
      graphOptimizationLevel: "disabled", // the graphs are optimised
    }).catch((error) => {
      delete this.sessions[key];
      throw error;
    });
    return this.sessions[key];
  }

  /** What the graph hears of an adapter (docs/onnx.md) for so many samples. */
  adapter(opened, samples) {
    const key = `${opened} ${samples}`;
    if (!this.adapters[key]) {
      const own = this.weights.adapter(opened - 1);
      this.adapters[key] = new this.ort.Tensor("float32", all(Array(samples).fill(own)), [samples, own.length]);
    }
    return this.adapters[key];
  }

  /**
   * One prediction for a batch of one length.
   * @param {Float32Array[]} batch noisy motions [T,R,C]
   * @param {number} step of the diffusion
   * @param {Float32Array[]} texts an embedding each
   * @param {number} tag
   * @param {Uint8Array} shown entries [T,R,C] that are clean
   * @param {number} opened the adapter of the whole batch, from 1 on; 0 for none
   * @param {boolean} first of few steps, and learned for that
   * @returns {Promise<Float32Array[]>}
   */
  async predict(batch, step, texts, tag, shown, opened = 0, first = false) {
    if (this.helpers.length) {
      const half = this.helpers.length > 1 ? Math.ceil(batch.length / 2) : batch.length, rest = [tag, shown, opened, first];
      const shares = [[0, half], [half, batch.length]].filter(([start, stop]) => start < stop);
      const found = await Promise.all(shares.map((share, i) => this.helpers[i](batch.slice(...share), step, texts.slice(...share), ...rest))).catch((error) => { this.failed = error.message.replace(/^.*Error: /, ""); });
      if (found) return found.flat();
      this.helpers = []; // they may lack the memory
    }
    const number = batch.length, size = batch[0].length, frames = size / 138;
    const shape = [number, frames, 23, 6];
    const { ort } = this, heard = opened && !this.graphics && { adapter: this.adapter(opened, number) };
    const { prediction } = await (await this.session(opened, first)).run({
      x: new ort.Tensor("float32", all(batch), shape),
      t: new ort.Tensor("int64", new BigInt64Array(number).fill(BigInt(step)), [number]),
      pooled: new ort.Tensor("float32", all(texts), [number, texts[0].length]),
      tag: new ort.Tensor("int64", new BigInt64Array(number).fill(BigInt(tag)), [number]),
      mask: new ort.Tensor("bool", new Uint8Array(number * frames).fill(1), [number, frames]),
      known: new ort.Tensor("bool", all(batch.map(() => shown), Uint8Array), shape),
      ...heard,
    });
    return batch.map((_, i) => prediction.data.slice(i * size, (i + 1) * size));
  }
}

function all(rows, Kind = Float32Array) {
  const whole = new Kind(rows.length * rows[0].length);
  rows.forEach((row, i) => whole.set(row, i * row.length));
  return whole;
}
