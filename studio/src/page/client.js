// Calls to the engine, in a worker made of the page's own script; in the page itself where workers
// are not allowed.

import { handler } from "../worker.js";

const [PAGE, HELPER, GRAPHICS] = [0, 1, 2]; // scripts

export class Client {
  waiting = new Map();
  count = 0;
  workers = [];
  graphics = null; // WebAssembly of a helper on a graphics card, where one is wanted

  /**
   * @param {string[]} scripts the page's own, that of helpers, and that of one on a graphics card
   * @param {object} settings
   * @param {Promise<object>} parts still being unpacked
   * @param {string[]} texts that will be asked for first
   */
  static async open(scripts, settings, parts, texts) {
    const client = new Client(), addresses = scripts.map((script) => URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    Object.assign(client, { addresses, settings, parts, texts });
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
      const { graphics } = this, two = !graphics && !settings.shifted.length && navigator.hardwareConcurrency > 1 && (navigator.deviceMemory ?? 8) >= 4; // learned passes have no halves
      const alone = () => this.worker === worker && this.send("alone", {}).catch(() => null);
      const own = graphics ? [{ ...parts, wasm: graphics }, alone, GRAPHICS] : [parts, alone];
      const ports = Array.from({ length: two ? 2 : 1 }, () => this.getHelp(...own));
      await Promise.race([this.send("open", { settings, parts, ports }, ports), failed]);
    } catch {
      if (worker && this.worker !== worker) return; // stopped while it opened: the next one opens
      for (const each of this.workers.splice(0)) each.terminate();
      this.worker = null;
      this.answer = handler();
      await this.send("open", { settings, parts: parts ?? await this.parts });
    }
  }

  begin(script = PAGE) {
    const worker = new Worker(this.addresses[script]);
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

  /** Begin anew with a helper on a graphics card, with its WebAssembly, or without: null. What it is worth: see `Sampler.compare`. */
  async useGraphics(wasm) {
    this.graphics = wasm;
    this.stop();
    await this.opened;
    if (!wasm) return null;
    return this.worker ? this.send("compare", {}) : { error: "this page may start no worker" };
  }

  /** The port to a worker that predicts; `failed` is called where it cannot. */
  getHelp({ wasm, graph, adapted, weights }, failed, script = HELPER) {
    const worker = this.begin(script), { port1, port2 } = new MessageChannel(), { weights: names, shifted } = this.settings;
    worker.onerror = failed;
    worker.postMessage({ parts: { wasm, graph, adapted, weights }, names, shifted, port: port2 }, [port2]);
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
