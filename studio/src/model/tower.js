// The text tower: rows of tokens and of pairs of them, their mean, and the places a text may lie at
// (src/shared/model/clip/core.py).

const BASE = 1 << 15, SPECIAL = 3, PLACE_SCALE = 30;
const ALIKE = 0.7, OWN_SHARE = 0.01; // a text lies between places that are alike

export class TextTower {
  /** @param {Weights} weights @param {Tokenizer} tokenizer */
  constructor(weights, tokenizer) {
    this.tokenizer = tokenizer;
    this.keys = weights.raw("text.encoder.keys", Int32Array);
    this.width = weights.shape("text.encoder.rows.weight")[1];
    const name = "text.encoder.rows.weight";
    this.stored = weights.has(`${name}.int8_scale`);
    this.rows = this.stored ? weights.raw(name, Int8Array) : weights.floats(name);
    this.scales = this.stored ? weights.scales(name) : null;
    this.weight = weights.floats("text.text_proj.weight");
    this.bias = weights.floats("text.text_proj.bias");
    this.places = weights.has("text.places") ? weights.floats("text.places") : null;
    this.placeKeys = weights.has("text.keys") ? weights.floats("text.keys") : this.places;
    this.remembered = new Map();
  }

  /** The embedding of a prompt, unit length. */
  encode(prompt) {
    return this.read(prompt).place;
  }

  /** { place, closeness } of a prompt: its embedding, and the cosine with the nearest place before places were mixed. */
  read(prompt) {
    let found = this.remembered.get(prompt);
    if (!found) {
      found = this.pool(this.mean(this.tokenizer.encode(prompt)));
      this.remembered.set(prompt, found);
    }
    return found;
  }

  mean(ids) {
    const hidden = new Float64Array(this.width);
    ids.forEach((raw, i) => {
      const id = raw < BASE ? raw : SPECIAL, next = ids[i + 1] < BASE ? ids[i + 1] : SPECIAL;
      if (id >= SPECIAL) this.addRow(id, hidden);
      if (i + 1 < ids.length && (id >= SPECIAL || next >= SPECIAL)) this.addRow((id + 1) * BASE + next, hidden);
    });
    return hidden.map((sum) => sum / ids.length);
  }

  addRow(key, hidden) {
    let low = 0, high = this.keys.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.keys[middle] < key) low = middle + 1;
      else high = middle;
    }
    if (this.keys[low] !== key) return;
    const factor = this.stored ? this.scales[low] : 1;
    for (let i = 0; i < this.width; i++) hidden[i] += this.rows[low * this.width + i] * factor;
  }

  pool(mean) {
    const pooled = unit(Array.from(this.bias, (bias, row) => {
      let sum = bias;
      for (let i = 0; i < this.width; i++) sum += this.weight[row * this.width + i] * mean[i];
      return sum;
    }));
    if (!this.places) return { place: Float32Array.from(pooled), closeness: null };
    const dim = pooled.length, shares = [];
    for (let at = 0; at < this.places.length; at += dim) {
      let cosine = 0;
      for (let i = 0; i < dim; i++) cosine += this.placeKeys[at + i] * pooled[i];
      shares.push(PLACE_SCALE * cosine);
    }
    const most = Math.max(...shares), weights = shares.map((x) => Math.exp(x - most));
    const total = weights.reduce((a, b) => a + b, 0);
    const about = weights.map((own, row) => this.alike(row).reduce((sum, other) => sum + weights[other], OWN_SHARE * own));
    const place = new Array(dim).fill(0);
    for (const row of this.alike(about.indexOf(Math.max(...about)))) {
      for (let i = 0; i < dim; i++) place[i] += (weights[row] / total) * this.places[row * dim + i];
    }
    return { place: Float32Array.from(unit(place)), closeness: most / PLACE_SCALE };
  }

  /** Rows of the places that are alike with that of a row, itself among them. */
  alike(row) {
    this.near ??= likeness(this.places, this.bias.length);
    return this.near[row];
  }
}

/** For each of some unit rows [P * D], the rows that are alike. */
function likeness(rows, dim) {
  const near = Array.from({ length: rows.length / dim }, () => []);
  near.forEach((list, a) => near.forEach((other, b) => {
    let cosine = 0;
    for (let i = 0; i < dim; i++) cosine += rows[a * dim + i] * rows[b * dim + i];
    if (cosine >= ALIKE) list.push(b);
  }));
  return near;
}

export function unit(values) {
  const size = Math.max(Math.hypot(...values), 1e-12);
  return values.map((x) => x / size);
}
