// Calls to the engine, in a worker made of the page's own script; in the page itself where workers
// are not allowed.

import { handler } from "../worker.js";

export class Client {
  waiting = new Map();
  count = 0;
  workers = [];

  /**
   * @param {string} script the page's own
   * @param {object} settings
   * @param {Promise<object>} parts still being unpacked
   * @param {string[]} texts that will be asked for first
   */
  static async open(script, settings, parts, texts) {
    const client = new Client(), address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    Object.assign(client, { address, settings, parts, texts });
    client.opened = client.start();
    await client.opened;
    return client;
  }

  async start() {
    const { settings, texts } = this;
    let worker = null, parts = null;
    try {
      worker = this.worker = this.begin();
      worker.onmessage = ({ data }) => this.heard(data);
      const failed = new Promise((_, reject) => { worker.onerror = (event) => reject(new Error(event.message || "no worker")); });
      this.send("prepare", { settings, texts }).catch(() => null); // while the parts are unpacked
      parts = await Promise.race([this.parts, failed]);
      const opened = Promise.race([this.send("open", { settings, parts }), failed]);
      const guided = !settings.shifted.length; // else no pass has two halves
      const helped = guided && navigator.hardwareConcurrency > 1 && (navigator.deviceMemory ?? 8) >= 4 ? this.getHelp(parts).catch(() => null) : null;
      await opened;
      if (helped) helped.then((port) => port && this.worker === worker && this.send("helper", { port }, [port]))
        .catch(() => null); // it was stopped; without help one worker does all
    } catch {
      if (worker && this.worker !== worker) return; // stopped while it opened: the next one opens
      worker?.terminate();
      this.worker = null;
      this.answer = handler();
      await this.send("open", { settings, parts: parts ?? await this.parts });
    }
  }

  begin() {
    const worker = new Worker(this.address);
    this.workers.push(worker);
    return worker;
  }

  /** What is under way fails, and the workers begin anew: one that computes hears nothing until it has done. */
  stop() {
    if (!this.worker) return;
    for (const worker of this.workers.splice(0)) {
      worker.onmessage = null;
      worker.terminate();
    }
    for (const { reject } of this.waiting.values()) reject(new Error("stopped"));
    this.waiting.clear();
    this.opened = this.start();
  }

  /** A second worker that takes half of the work; the port to it. */
  async getHelp({ wasm, graph, adapted, weights }) {
    const worker = this.begin(), { port1, port2 } = new MessageChannel();
    await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }) => (data.error ? reject(new Error(data.error)) : resolve());
      worker.onerror = reject;
      worker.postMessage({ id: 0, call: "help", parts: { wasm, graph, adapted, weights }, names: this.settings.weights, port: port2 }, [port2]);
    });
    return port1;
  }

  async call(name, args, told = null) {
    await this.opened;
    return this.send(name, args, [], told);
  }

  send(name, args, transfer = [], told = null) {
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
