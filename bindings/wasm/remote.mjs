// skelgen in a worker: the same as `skelgen.mjs` has, as promises; the thread that asks stays free.
import { SkelgenError } from "./skelgen.mjs";

const ended = () => new SkelgenError({ code: "cancelled", message: "cancelled" });

async function startedWorker(url) {
  if (typeof Worker === "function") {
    const worker = url ? new Worker(url, { type: "module" }) : new Worker(new URL("./worker.mjs", import.meta.url), { type: "module" });
    return {
      listen(take, fail) {
        worker.onmessage = ({ data }) => take(data);
        worker.onerror = (event) => fail(event.message);
        worker.onmessageerror = () => fail("a message was lost");
      },
      post: (message, moved) => worker.postMessage(message, moved),
      end: () => worker.terminate(),
    };
  }
  const { Worker: Thread } = await import(["node", "worker_threads"].join(":"));
  const thread = new Thread(url ?? new URL("./worker.mjs", import.meta.url));
  thread.unref(); // a program that is done does not wait for it
  return {
    listen(take, fail) {
      thread.on("message", take);
      thread.on("error", (error) => fail(error.message));
    },
    post(message, moved) {
      thread.ref();
      thread.postMessage(message, moved);
    },
    rest: () => thread.unref(),
    end: () => void thread.terminate(),
  };
}

/// A worker and what it was asked for. Where it is ended everything that it made is gone; the next call starts a new one.
export class SkelgenWorker {
  /// `worker`, `wasm`: where these files are, if not beside this one.
  constructor({ worker, wasm } = {}) {
    this.urls = { worker, wasm };
    this.calls = new Map();
    this.last = 0;
    this.generation = 0;
    this.started = null;
  }

  start() {
    this.started ??= (async () => {
      const generation = this.generation;
      const worker = await startedWorker(this.urls.worker);
      if (generation !== this.generation) {
        worker.end();
        throw ended();
      }
      this.worker = worker;
      worker.listen((message) => this.take(message), (what) =>
        this.stop(new SkelgenError({ code: "internal", message: `the worker has failed: ${what ?? "it cannot be loaded"}` })));
      Object.assign(this, await this.post("load", { wasm: this.urls.wasm }));
      return this;
    })().catch((error) => {
      this.started = null;
      throw error;
    });
    return this.started;
  }

  take({ call, result, error, progress }) {
    const waiting = this.calls.get(call);
    if (!waiting) return;
    if (progress) return void waiting.onProgress?.(progress);
    this.calls.delete(call);
    if (this.calls.size === 0) this.worker.rest?.();
    if (!error) return waiting.resolve(result);
    waiting.reject(new SkelgenError(error));
    if (error.crashed) this.stop(new SkelgenError(error));
  }

  post(act, values, { moved = [], onProgress } = {}) {
    return new Promise((resolve, reject) => {
      this.calls.set(++this.last, { resolve, reject, onProgress });
      try {
        this.worker.post({ call: this.last, act, values }, moved);
      } catch (error) {
        this.calls.delete(this.last);
        reject(error);
      }
    });
  }

  async ask(act, values, { signal, onProgress, generation = null } = {}) {
    if (signal?.aborted) throw ended();
    if (generation !== null && generation !== this.generation)
      throw new SkelgenError({ code: "usage", message: "the worker that had it was ended" });
    await this.start();
    // Shared memory reaches a worker that is busy; without it ending the worker is the one way.
    const flag = signal && typeof SharedArrayBuffer === "function" && globalThis.crossOriginIsolated !== false
      ? new Int32Array(new SharedArrayBuffer(4)) : undefined;
    const end = () => (flag ? Atomics.store(flag, 0, 1) : this.stop(ended()));
    if (signal?.aborted) throw ended();
    signal?.addEventListener("abort", end);
    try {
      return await this.post(act, flag ? { ...values, flag } : values, { onProgress });
    } finally {
      signal?.removeEventListener("abort", end);
    }
  }

  /// Ends the worker, at whatever it is.
  stop(reason = ended()) {
    ++this.generation;
    this.worker?.end();
    this.worker = this.started = null;
    const { calls } = this;
    this.calls = new Map();
    for (const { reject } of calls.values()) reject(reason);
  }
  delete() {
    this.stop();
  }

  /// A mesh that stays in the worker. With `glb` it is also there as a file that viewers show.
  async open(input, { signal, glb = false } = {}) {
    return new RemoteMesh(this, await this.ask("open", { input, glb }, { signal }));
  }

  async extract(input, { signal, onProgress, ...options } = {}) {
    const mesh = input instanceof RemoteMesh ? input : await this.open(input, { signal });
    try {
      return new RemoteBody(this, await this.ask("extract", { mesh: mesh.id, options }, { signal, onProgress, generation: mesh.generation }));
    } finally {
      if (mesh !== input) mesh.delete();
    }
  }
  async read(input, options) {
    const mesh = await this.open(input, options);
    mesh.delete();
    return { positions: mesh.positions, faces: mesh.faces };
  }
  async once(input, options, use) {
    const body = await this.extract(input, options);
    try {
      return await use(body);
    } finally {
      body.delete();
    }
  }
  rig(input, { format = "glb", names, ...options } = {}) {
    return this.once(input, { ...options, fingers: "off", toes: false }, async (body) => {
      const { signal: _signal, onProgress: _progress, ...how } = options;
      const rig = await body.rig({ ...how, rest: how.rest ?? (format === "vrm" ? "t-pose" : "as-is") });
      return rig.file(format, { names }).finally(() => rig.delete());
    });
  }
  segment(input, options = {}) {
    return this.once(input, options, (body) => body.segment({ parts: options.parts }));
  }
  measure(input, options = {}) {
    return this.once(input, options, (body) => body.measure());
  }
}
if (Symbol.dispose) SkelgenWorker.prototype[Symbol.dispose] = SkelgenWorker.prototype.delete;

class RemoteHandle {
  constructor(owner, { id, ...known }) {
    Object.assign(this, { owner, id, generation: owner.generation }, known);
  }
  ask(act, values, options) {
    return this.owner.ask(act, values, { ...options, generation: this.generation });
  }
  delete() {
    if (this.id !== null && this.generation === this.owner.generation) this.ask("delete", { id: this.id }).catch(() => {});
    this.id = null;
  }
}
if (Symbol.dispose) RemoteHandle.prototype[Symbol.dispose] = RemoteHandle.prototype.delete;

export class RemoteMesh extends RemoteHandle {}

export class RemoteRig extends RemoteHandle {
  file(format, options) {
    return this.ask("file", { rig: this.id, format, options });
  }
  skin() {
    return this.ask("skin", { rig: this.id });
  }
  follow(clip, name) {
    return this.ask("follow", { rig: this.id, clip, name });
  }
}

export class RemoteBody extends RemoteHandle {
  get joints() {
    return this.skeleton.joints;
  }
  get frame() {
    return this.skeleton.frame;
  }
  get quality() {
    return this.skeleton.quality;
  }
  curve() {
    return this.ask("curve", { body: this.id });
  }
  segment(options) {
    return this.ask("segment", { body: this.id, options });
  }
  measure() {
    return this.ask("measure", { body: this.id });
  }
  async rig(options = {}) {
    return new RemoteRig(this.owner, await this.ask("rig", { body: this.id, options }));
  }
  async fit(skeleton, options) {
    return new RemoteBody(this.owner, await this.ask("fit", { body: this.id, skeleton, options }));
  }
}

export { SkelgenError };
