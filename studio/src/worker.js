// What runs beside the page. One worker leads: it has the whole engine. Others predict for it (helper.js).

import { Engine } from "./engine.js";
import { SentenceReader } from "./model/sentence.js";

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
    if (call === "prepare") { prepare(args); return null; }
    if (call === "open") { engine = await Engine.open(args.settings, args.parts, args.ports?.map(remote)); return null; }
    if (call === "alone") { engine.director.sampler.denoiser.helpers.forEach((helper) => helper.end()); return null; }
    return engine[call](args, told);
  };
}

/** Patterns are compiled when they are first met, and again when they are met a second time; what is compiled is kept. */
function prepare({ settings, texts }) {
  const reader = new SentenceReader(settings.measures, () => ({ action: null, certainty: -Infinity, arms: false }));
  for (const text of [...texts, ...texts]) reader.clauses(text);
}

/** Calls to a helper, one promise each; after its `end` all fail. */
function remote(port) {
  const waiting = new Map();
  let next = 0, ended = false;
  port.onmessage = ({ data: { id, result, error } }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error) reject(new Error(error));
    else resolve(result);
  };
  const call = (...args) =>
    new Promise((resolve, reject) => {
      if (ended) { reject(new Error("gone")); return; }
      waiting.set(++next, { resolve, reject });
      port.postMessage({ id: next, args });
    });
  call.end = () => {
    ended = true;
    waiting.forEach(({ reject }) => reject(new Error("gone")));
  };
  return call;
}
