// The parts of the model that stand in the page as base64 of gzip, behind the script that reads them.

export async function readParts(document) {
  if (document.readyState === "loading") await new Promise((resolve) => document.addEventListener("DOMContentLoaded", resolve));
  const elements = [...document.querySelectorAll('script[id^="part-"]')];
  const entries = await Promise.all(elements.map(async (element) => {
    const bytes = decode(element.textContent);
    element.remove(); // 15 MB of text that nobody reads again
    return [element.id.slice("part-".length), await unpacked(bytes)];
  }));
  return Object.fromEntries(entries);
}

function decode(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function unpacked(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
