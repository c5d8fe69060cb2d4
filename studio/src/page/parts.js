// The parts of the model that stand in the page as gzip in characters of seven bits (src/shared/studio/page.py), behind the
// script that reads them.

const LATER = "graphics"; // is read when somebody wants it

/** All parts but that one, by name; what was read is no longer in the page. */
export async function readParts(document) {
  if (document.readyState === "loading") await new Promise((resolve) => document.addEventListener("DOMContentLoaded", resolve));
  const names = [...document.querySelectorAll('script[id^="part-"]')].map(({ id }) => id.slice("part-".length)).filter((name) => name !== LATER);
  const entries = await Promise.all(names.map(async (name) => {
    const element = document.getElementById(`part-${name}`), part = await readPart(document, name);
    element.remove(); // 15 MB of text that nobody reads again
    return [name, part];
  }));
  return Object.fromEntries(entries);
}

/** One part. @returns {Promise<Uint8Array>} */
export function readPart(document, name) {
  return unpacked(decoded(document.getElementById(`part-${name}`).textContent));
}

function decoded(text) {
  const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
  for (let i = 0, at = 0, bits = 0, held = 0; at < bytes.length; i++) {
    bits = (bits << 7) | (text.charCodeAt(i) & 127);
    held += 7;
    if (held >= 8) bytes[at++] = bits >> (held -= 8);
  }
  return bytes;
}

async function unpacked(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
