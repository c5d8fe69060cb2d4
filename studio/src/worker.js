// What runs beside the page. One worker leads: it has the whole engine. Another may help it: it
// holds a second denoiser, which takes half of each batch.

import { Denoiser } from "./model/denoiser.js";
import { Engine } from "./engine.js";

/** Answer { id, call, ...arguments } with { id, result } or { id, error }; parts come first. */
export function serve(scope) {
  const answer = handler();
  scope.onmessage = async ({ data }) => {
    const { id, call, ...args } = data;
    try {
      const result = await answer(call, args, (progress) => scope.postMessage({ id, progress }));
      scope.postMessage({ id, result });
    } catch (error) {
      scope.postMessage({ id, error: String(error?.message ?? error) });
    }
  };
}

/** The same without a worker, for pages that may not start one. */
export function handler() {
  let engine = null;
  return async (call, args, told) => {
    if (call === "open") { engine = await Engine.open(args.settings, args.parts); return null; }
    if (call === "help") { await help(args); return null; }
    if (call === "helper") { engine.director.sampler.denoiser.helper = remote(args.port); return null; }
    return engine[call](args, told);
  };
}

async function help({ parts, port }) {
  const denoiser = await Denoiser.open(parts);
  port.onmessage = async ({ data: { id, args } }) => {
    try { port.postMessage({ id, result: await denoiser.predict(...args) }); }
    catch (error) { port.postMessage({ id, error: String(error) }); }
  };
}

/** Calls to a helper, one promise each. */
function remote(port) {
  const waiting = new Map();
  let next = 0;
  port.onmessage = ({ data: { id, result, error } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error) reject(new Error(error));
    else resolve(result);
  };
  return (...args) =>
    new Promise((resolve, reject) => {
      waiting.set(++next, { resolve, reject });
      port.postMessage({ id: next, args });
    });
}
