// Seeds and noise as every runtime makes them (docs/onnx.md): a function of seed, text, sample and
// place, by Philox4x32-10 (Salmon et al. 2011) and Box-Muller.

const MASK = 0xffffffffn, NO_SAMPLE = 0xffffffff;

/** The high 32 bits of a product of 32-bit words. */
function high(a, b) {
  const [ah, al, bh, bl] = [a >>> 16, a & 0xffff, b >>> 16, b & 0xffff];
  const middle = ah * bl + ((al * bl) >>> 16), other = al * bh + (middle & 0xffff);
  return (ah * bh + Math.floor(middle / 65536) + Math.floor(other / 65536)) >>> 0;
}

/** Four words of a counter of four, `out` is filled; the key is the seed, a BigInt below 2^63. */
function philox(c0, c1, c2, c3, k0, k1, out) {
  for (let round = 0; round < 10; round++) {
    const [first, second] = [high(0xd2511f53, c0), high(0xcd9e8d57, c2)];
    const [low0, low1] = [Math.imul(0xd2511f53, c0) >>> 0, Math.imul(0xcd9e8d57, c2) >>> 0];
    [c0, c1, c2, c3] = [(second ^ c1 ^ k0) >>> 0, low1, (first ^ c3 ^ k1) >>> 0, low0];
    k0 = (k0 + 0x9e3779b9) >>> 0;
    k1 = (k1 + 0xbb67ae85) >>> 0;
  }
  out[0] = c0; out[1] = c1; out[2] = c2; out[3] = c3;
}

const key = (seed) => [Number(BigInt(seed) & MASK), Number((BigInt(seed) >> 32n) & MASK)];

/** The seed of part `number` of what has a seed; its own for 0. */
export function derivedSeed(seed, number) {
  if (number === 0) return BigInt(seed);
  const words = [];
  philox(number, 0, 0, NO_SAMPLE, ...key(seed), words);
  return BigInt(words[0]) + (BigInt(words[1] >>> 1) << 32n);
}

/** Starting noise of a motion of a prompt. */
export function noise(seed, prompt, size) {
  const values = new Float32Array(size), text = crc32(new TextEncoder().encode(prompt)), words = [0, 0, 0, 0];
  const [k0, k1] = key(seed);
  for (let at = 0; at < size; at += 4) {
    philox(at >>> 2, 0, text, 0, k0, k1, words);
    for (const pair of [0, 2]) {
      const radius = Math.sqrt(-2 * Math.log((words[pair] + 0.5) / 4294967296));
      const angle = (2 * Math.PI * (words[pair + 1] + 0.5)) / 4294967296;
      values[at + pair] = radius * Math.cos(angle); // what lies beyond the end is dropped
      values[at + pair + 1] = radius * Math.sin(angle);
    }
  }
  return values;
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let i = 0; i < 8; i++) crc = (crc >>> 1) ^ (0xedb88320 & -(crc & 1));
  }
  return ~crc >>> 0;
}
