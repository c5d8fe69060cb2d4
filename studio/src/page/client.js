// Calls to the engine, in a worker made of the page's own script; in the page itself where workers
// are not allowed.

import { handler } from "../worker.js";

export class Client {
  /** @param {string} script the page's own @param {object} settings @param {object} parts */
  static async open(script, settings, parts) {
    const client = new Client();
    try {
      const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
      client.worker = new Worker(address);
      client.worker.onmessage = ({ data }) => client.heard(data);
      const failed = new Promise((_, reject) => { client.worker.onerror = (event) => reject(new Error(event.message || "no worker")); });
      const { wasm, graph, adapted, weights } = parts;
      const opened = Promise.race([client.call("open", { settings, parts }), failed]);
      const helped = navigator.hardwareConcurrency > 1 && (navigator.deviceMemory ?? 8) >= 4
        ? client.getHelp(address, { parts: { wasm, graph, adapted, weights } }).catch(() => null)
        : null;
      await opened;
      helped?.then((port) => port && client.call("helper", { port }, [port]));
    } catch {
      client.worker?.terminate();
      client.worker = null;
      client.answer = handler();
      await client.call("open", { settings, parts });
    }
    return client;
  }

  waiting = new Map();
  count = 0;

  /** A second worker that takes half of the work; the port to it. */
  async getHelp(address, model) {
    const worker = new Worker(address), { port1, port2 } = new MessageChannel();
    await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => (data.error ? reject(new Error(data.error)) : resolve());
      worker.onerror = reject;
      worker.postMessage({ id: 0, call: "help", ...model, port: port2 }, [port2]);
    });
    return port1;
  }

  call(name, args, transfer = [], told = null) {
    if (!this.worker) return this.answer(name, args, told ?? (() => {}));
    return new Promise((resolve, reject) => {
      this.waiting.set(++this.count, { resolve, reject, told });
      this.worker.postMessage({ id: this.count, call: name, ...args }, transfer);
    });
  }

  heard({ id, result, error, progress }) {
    const { resolve, reject, told } = this.waiting.get(id);
    if (progress !== undefined) { told?.(progress); return; }
    this.waiting.delete(id);
    if (error === undefined) resolve(result);
    else reject(new Error(error));
  }
}
