// A worker that runs glint, as the page sees it: it takes files, and answers commands and messages of a language client.

export class Cancelled extends Error {}

export class Glint {
  // `module`: compiled; `gpu`: it is the one that draws by WebGPU; `files()`: all files of the scene's folder, by path, for a new worker.
  // `address`: of its program, as this page names it.
  constructor(module, files, gpu = false, address = 'worker.js') {
    this.module = module;
    this.address = address;
    this.gpu = gpu;
    this.files = files;
    this.listeners = new Set();
    this.next = 0;
    this.spare = null;
    this.start();
  }

  fresh() {
    const worker = new Worker(this.address);
    worker.postMessage({ module: this.module, gpu: this.gpu });
    return worker;
  }

  start() {
    this.waiting = new Map();
    this.worker = this.spare || this.fresh();
    this.spare = null;
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.died(event.message || 'the worker could not start');
    this.worker.postMessage({ files: Object.fromEntries(this.files()) });
  }

  take(data) {
    if (data.lsp !== undefined) {
      for (const listener of this.listeners) listener(data.lsp);
    } else if (data.died !== undefined) {
      this.died(data.died);
    } else {
      const { resolve } = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      resolve(data);
    }
  }

  // Memory or stack ran out: pending commands are told so, and another worker takes the next one.
  died(why) {
    const waiting = this.waiting;
    this.worker.terminate();
    this.start();
    for (const { reject } of waiting.values()) reject(new Error(why));
    if (this.onRestart) this.onRestart(why);
  }

  // Ends the current command at once. The next worker was started while this one was working, so it is ready.
  prepare() {
    this.spare = this.spare || this.fresh();
  }
  cancel() {
    if (!this.waiting.size) return;
    const waiting = this.waiting;
    this.worker.terminate();
    this.start();
    for (const { reject } of waiting.values()) reject(new Cancelled());
  }

  // For good.
  end() {
    this.worker.terminate();
    if (this.spare) this.spare.terminate();
    for (const { reject } of this.waiting.values()) reject(new Cancelled());
  }

  put(files, gone = []) {
    this.worker.postMessage({ files, gone });
  }

  // {status, out, err, files}
  run(words, take = []) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, words, take });
    });
  }

  // ---- as a transport of a language client

  send(text) {
    this.worker.postMessage({ lsp: text });
  }
  subscribe(listener) {
    this.listeners.add(listener);
  }
  unsubscribe(listener) {
    this.listeners.delete(listener);
  }
}

// Compiled once for all workers.
export async function compile(name = 'glint.wasm') {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
  if ((response.headers.get('content-type') || '').startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

// The module that draws by WebGPU, fetched only where it helps. null: the page has none, the browser cannot wait for a GPU in a module, or
// its GPU is emulated by a processor, where the reference is faster. `?adapter=any` accepts that too.
export async function compileForGpu() {
  if (!GLINT_HAS_GPU || !navigator.gpu || !WebAssembly.Suspending) return null;
  const adapter = await navigator.gpu.requestAdapter({ powerPreference: 'high-performance' });
  const any = new URLSearchParams(location.search).get('adapter') === 'any';
  return adapter && (any || !adapter.info.isFallbackAdapter) ? compile('glint-gpu.wasm') : null;
}
