// glint.wasm in a worker of its own, with files that exist only in memory. Takes messages:
//   {module, gpu}               first: the compiled module, shared by all workers; `gpu`: the one that draws by WebGPU (glint-gpu.js)
//   {files, gone}               new or changed files by their paths in the scene's folder, and paths that went away
//   {id, words, take}           a command; answers {id, status, out, err, files}, with the files named in `take`, if there
//   {lsp}                       a message of a language client, as text; answers, in any number, {lsp}
// {id, died} answers a command that ended the module itself (memory, stack): this worker is of no use after it.
'use strict';
const FOLDER = '/scene';
const IDLE_MS = 400; // without typing, before the slower checks run

let glint = null;
let server = 0;
let soon = 0;
let busy = Promise.resolve();
const printed = { out: [], err: [] };

let draws = false; // by WebGPU

// Fetches a kernel; only kernels that are used are fetched.
async function kernel(name) {
  const response = await fetch(`${name}.wgsl`);
  if (!response.ok) throw new Error(`${name}.wgsl: ${response.status} ${response.statusText}`);
  return response.text();
}

function start(module, gpu) {
  draws = gpu;
  importScripts(gpu ? 'glint-gpu.js' : 'glint.js');
  return createGlint({
    kernel,
    instantiateWasm(imports, done) {
      if (draws) {
        // While these wait, the module waits too: by JavaScript Promise Integration.
        for (const part of Object.values(imports))
          for (const [name, one] of Object.entries(part)) if (one.suspends) part[name] = new WebAssembly.Suspending(one);
      }
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    preRun: [
      (m) => {
        const put = (name) => (code) => code === null || printed[name].push(code);
        m.FS.init(() => null, put('out'), put('err'));
        m.FS.mkdir(FOLDER);
        m.FS.chdir(FOLDER);
      },
    ],
  });
}

function printedText(name) {
  const text = new TextDecoder().decode(Uint8Array.from(printed[name]));
  printed[name] = [];
  return text;
}

function put(files, gone) {
  for (const [name, content] of Object.entries(files)) {
    const whole = `${FOLDER}/${name}`;
    glint.FS.mkdirTree(whole.slice(0, whole.lastIndexOf('/')));
    glint.FS.writeFile(whole, content);
  }
  for (const name of gone || []) {
    if (glint.FS.analyzePath(`${FOLDER}/${name}`).exists) glint.FS.unlink(`${FOLDER}/${name}`);
  }
  if (server) {
    const changes = Object.keys(files).map((name) => ({ uri: `file://${FOLDER}/${encodeURI(name)}`, type: 2 }));
    serve(JSON.stringify({ jsonrpc: '2.0', method: 'workspace/didChangeWatchedFiles', params: { changes } }));
  }
}

async function run({ id, words, take }) {
  let status;
  try {
    status = draws ? await glint.run(words) : glint.callMain(words);
  } catch (error) {
    postMessage({ id, died: String((error && error.message) || error) });
    return;
  }
  const files = {};
  for (const name of take || []) {
    if (!glint.FS.analyzePath(name).exists) continue;
    files[name] = glint.FS.readFile(name);
    glint.FS.unlink(name);
  }
  const answer = { id, status, out: printedText('out'), err: printedText('err'), files };
  postMessage(answer, Object.values(files).map((bytes) => bytes.buffer));
}

// ---- the language server

function refresh(idle) {
  soon = 0;
  const more = server && glint.ccall('web_lsp_refresh', 'number', ['number', 'number'], [server, idle ? 1 : 0]);
  if (more && !idle) soon = setTimeout(refresh, IDLE_MS, true);
}

// Messages that come together are checked once, when no more wait.
function serve(text) {
  if (!server) {
    glint.onMessage = (said) => postMessage({ lsp: said });
    server = glint.ccall('web_lsp_open', 'number', [], []);
  }
  clearTimeout(soon);
  soon = setTimeout(refresh, 0, false);
  glint.ccall('web_lsp_take', 'number', ['number', 'string'], [server, text]);
}

async function take(data) {
  if (data.module) glint = await start(data.module, !!data.gpu);
  else if (data.files) put(data.files, data.gone);
  else if (data.lsp) serve(data.lsp);
  else await run(data);
}

// One after the other, in their order.
onmessage = ({ data }) => {
  busy = busy.then(() => take(data)).catch((error) => postMessage({ id: data.id, died: String((error && error.message) || error) }));
};
