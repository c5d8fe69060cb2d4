// A worker that predicts for the one that leads, and does nothing else. It has a script of its own: in Firefox
// WebAssembly became two hundred times as slow in a thread that had searched a long string (docs/studio.md).

import { Denoiser } from "./model/denoiser.js";

/** Help with one of onnxruntime's builds, on a graphics card where that is `graphics`. */
export function help(ort, graphics = false) {
  self.onmessage = ({ data: { parts, names, shifted, port } }) => {
    const denoiser = new Denoiser(ort, parts, names, shifted, graphics);
    denoiser.session(Number("adapted" in parts), shifted.length > 0).catch(() => null); // while the sentence is read
    port.onmessage = async ({ data: { id, args } }) => {
      try { port.postMessage({ id, result: await denoiser.predict(...args) }); }
      catch (error) { port.postMessage({ id, error: String(error?.message ?? error) }); }
    };
  };
}
