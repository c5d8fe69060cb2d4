// Weights as they ship: safetensors, float16, and int8 with a scale a row.

export class Weights {
  /** @param {Uint8Array} bytes a whole safetensors file */
  constructor(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const length = Number(view.getBigUint64(0, true));
    this.entries = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + length)));
    this.data = bytes.subarray(8 + length);
  }

  has(name) {
    return name in this.entries;
  }

  shape(name) {
    return this.entries[name].shape;
  }

  /** The stored bytes, copied: typed arrays must begin at a multiple of their width. */
  raw(name, Kind) {
    const [start, stop] = this.entries[name].data_offsets;
    return new Kind(this.data.slice(start, stop).buffer);
  }

  scales(name) {
    return this.floats(`${name}.int8_scale`);
  }

  /** Of adapter `at`, its maps [R,D] and [D',R] row by row, filled up to the largest rank R, by name. */
  adapter(at) {
    const names = Object.keys(this.entries).filter((name) => ADAPTER.test(name)).sort();
    const of = (name, number, layer) => name.replace(ADAPTER, `.adapters.${number}.${layer}.weight`);
    let rank = 0;
    for (let i = 0; this.has(of(names[0], i, 0)); i++) rank = Math.max(rank, this.shape(of(names[0], i, 0))[0]);
    const sizes = names.map((name) => [this.shape(name)[1], this.shape(of(name, 0, 1))[0]]);
    const whole = new Float32Array(rank * sizes.flat().reduce((a, b) => a + b, 0));
    let start = 0;
    names.forEach((name, i) => {
      const [inputs, outputs] = sizes[i], down = of(name, at, 0), up = of(name, at, 1), own = this.shape(down)[0];
      whole.set(this.floats(down), start);
      start += rank * inputs;
      const values = this.floats(up);
      for (let row = 0; row < outputs; row++, start += rank) whole.set(values.subarray(row * own, (row + 1) * own), start);
    });
    return whole;
  }

  /** A tensor as float32, whatever it is stored as. */
  floats(name) {
    const { dtype } = this.entries[name];
    if (dtype === "F32") return this.raw(name, Float32Array);
    if (dtype === "F16") return Float32Array.from(this.raw(name, Uint16Array), half);
    if (dtype !== "I8") throw new Error(`${name} is stored as ${dtype}`);
    const scales = this.scales(name), values = Float32Array.from(this.raw(name, Int8Array));
    const width = values.length / scales.length;
    for (let row = 0, at = 0; row < scales.length; row++)
      for (const end = at + width; at < end; at++) values[at] *= scales[row];
    return values;
  }

  /**
   * What a graph reads under a name: a tensor as float32, or one transposed; as it is for the first of few steps
   * where `shifted` names the vectors that it changes, and with one of the adapters, from 1 on (src/shared/model/onnx_graphs.py).
   */
  ready(path, shifted = null, opened = 0) {
    const name = path.replace(TURNED, ""), values = this.floats(name);
    if (shifted) this.change(name, values, shifted);
    const down = name.replace(/weight$/, `adapters.${opened - 1}.0.weight`);
    if (opened && this.has(down)) this.addProduct(values, down.replace(/0\.weight$/, "1.weight"), down);
    if (name === path) return values;
    const [rows, columns] = this.shape(name), turned = new Float32Array(values.length);
    for (let row = 0, at = 0; row < rows; row++)
      for (let column = 0; column < columns; column++) turned[column * rows + row] = values[at++];
    return turned;
  }

  /** A tensor as the learned step has it: a low-rank product or a row of its shifts is added. */
  change(name, values, shifted) {
    const key = name.replace(/^denoiser\./, "").replaceAll(".", "_"), own = `${STEP}down.${key}`;
    if (this.has(own)) { this.addProduct(values, `${STEP}up.${key}`, own); return; }
    if (!shifted.includes(name)) return;
    this.shifts ??= this.floats(`${STEP}shifts`);
    const width = this.shape(`${STEP}shifts`)[1];
    let at = 0;
    for (const before of shifted.slice(0, shifted.indexOf(name))) at += Math.ceil(this.shape(before)[0] / width) * width;
    for (let i = 0; i < values.length; i++) values[i] += this.shifts[at + i];
  }

  /** Adds a low-rank product, of the tensors of two names, to a matrix. */
  addProduct(values, ups, downs) {
    const up = this.floats(ups), down = this.floats(downs), [rank, columns] = this.shape(downs);
    for (let row = 0; row * columns < values.length; row++) {
      const whole = values.subarray(row * columns, (row + 1) * columns);
      for (let k = 0; k < rank; k++) {
        const share = up[row * rank + k], part = down.subarray(k * columns, (k + 1) * columns);
        for (let column = 0; column < columns; column++) whole[column] += share * part[column];
      }
    }
  }
}

const TURNED = /\/turned$/; // src/shared/model/onnx_card.py
const STEP = "denoiser.one_step.";
const ADAPTER = /\.adapters\.0\.0\.weight$/;

function half(bits) {
  const sign = bits >> 15 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  return exponent === 0 ? sign * fraction * 2 ** -24 : sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}
