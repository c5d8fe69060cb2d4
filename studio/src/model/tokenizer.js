// SentencePiece, unigram (Kudo 2018) with byte fallback: the file that ships with the model is read
// as it is. Its normalisation is a table in the file, too: a trie from UTF-8 to UTF-8.

const BOS = 0, EOS = 2, UNK = 3;
const NORMAL = 1, USER_DEFINED = 4, UNUSED = 5, BYTE = 6;
const SPACE = "\u2581", UNKNOWN_PENALTY = 10;

export class Tokenizer {
  /** @param {Uint8Array} bytes of sentencepiece.bpe.model @param {number} maxTokens */
  constructor(bytes, maxTokens) {
    this.maxTokens = maxTokens;
    this.pieces = new Map();
    this.bytes = [];
    this.longest = 1;
    let lowest = 0, id = 0, normalizer = new Uint8Array();
    for (const [field, value] of fieldsOf(bytes)) {
      if (field === 3) normalizer = value;
      if (field !== 1) continue;
      let piece = "", score = 0, kind = NORMAL;
      for (const [inner, part] of fieldsOf(value)) {
        if (inner === 1) piece = new TextDecoder().decode(part);
        if (inner === 2) score = part;
        if (inner === 3) kind = part;
      }
      if (kind === BYTE) this.bytes[parseInt(piece.slice(3, 5), 16)] = id;
      if (kind === NORMAL || kind === USER_DEFINED || kind === UNUSED) {
        this.pieces.set(piece, { id, score });
        this.longest = Math.max(this.longest, [...piece].length);
        lowest = Math.min(lowest, score);
      }
      id++;
    }
    this.unknown = Math.fround(lowest - UNKNOWN_PENALTY);
    for (const [field, value] of fieldsOf(normalizer))
      if (field === 2) {
        const size = new DataView(value.buffer, value.byteOffset).getUint32(0, true);
        this.trie = new Uint32Array(value.slice(4, 4 + size).buffer);
        this.replacements = value.subarray(4 + size);
      }
  }

  /** Ids of a prompt with begin and end, cut to as many as the model takes. */
  encode(prompt) {
    const ids = [BOS, ...this.best([...this.normalized(prompt)]), EOS];
    return ids.length > this.maxTokens ? [...ids.slice(0, this.maxTokens - 1), EOS] : ids;
  }

  normalized(text) {
    const bytes = new TextEncoder().encode(text), out = [];
    for (let at = 0; at < bytes.length; ) {
      let length = 0, value = -1;
      if (this.trie) {
        let node = offsetOf(this.trie[0]);
        for (let i = at; i < bytes.length; i++) {
          node ^= bytes[i];
          const unit = this.trie[node];
          if (unit === undefined || ((unit & 0x800000ff) >>> 0) !== bytes[i]) break;
          node ^= offsetOf(unit);
          if ((unit >>> 8) & 1) { length = i + 1 - at; value = this.trie[node] & 0x7fffffff; }
        }
      }
      if (length === 0) {
        length = bytes[at] < 0x80 ? 1 : bytes[at] < 0xe0 ? 2 : bytes[at] < 0xf0 ? 3 : 4;
        out.push(...bytes.subarray(at, at + length));
      } else for (let i = value; this.replacements[i]; i++) out.push(this.replacements[i]);
      at += length;
    }
    const words = new TextDecoder().decode(Uint8Array.from(out)).split(" ").filter(Boolean);
    return words.map((word) => SPACE + word).join("");
  }

  /** The likeliest cut of an array of characters, as ids. */
  best(characters) {
    const scores = [0], from = [0], ids = [[]];
    const offer = (start, stop, score, found) => {
      const sum = Math.fround(scores[start] + score);
      if (scores[stop] === undefined || sum > scores[stop]) { scores[stop] = sum; from[stop] = start; ids[stop] = found; }
    };
    for (let start = 0; start < characters.length; start++) {
      let single = false;
      for (let length = 1, piece = ""; length <= this.longest && start + length <= characters.length; length++) {
        piece += characters[start + length - 1];
        const known = this.pieces.get(piece);
        if (!known) continue;
        offer(start, start + length, known.score, [known.id]);
        single ||= length === 1;
      }
      if (!single) {
        const bytes = [...new TextEncoder().encode(characters[start])];
        offer(start, start + 1, this.unknown, bytes.map((byte) => this.bytes[byte] ?? UNK));
      }
    }
    const parts = [];
    for (let at = characters.length; at > 0; at = from[at]) parts.unshift(ids[at]);
    return parts.flat();
  }
}

const offsetOf = (unit) => (unit >>> 10) << ((unit & 0x200) >>> 6);

/** Fields of a protocol buffer: [number, value], value a number or bytes. */
function* fieldsOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  const varint = () => {
    let value = 0, factor = 1, byte;
    do { byte = bytes[at++]; value += (byte & 127) * factor; factor *= 128; } while (byte & 128);
    return value;
  };
  while (at < bytes.length) {
    const key = varint(), kind = key & 7;
    if (kind === 0) yield [key >>> 3, varint()];
    else if (kind === 5) { yield [key >>> 3, view.getFloat32(at, true)]; at += 4; }
    else if (kind === 1) { yield [key >>> 3, view.getFloat64(at, true)]; at += 8; }
    else { const length = varint(); yield [key >>> 3, bytes.subarray(at, at + length)]; at += length; }
  }
}
