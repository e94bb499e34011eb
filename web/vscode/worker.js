// glint.wasm in a worker of the editor. Its files are the editor's, fetched on demand: a file that the program looks for and does not have
// is noted, the extension is asked for it, and the work is done again. Takes messages:
//   {module}                    first: the compiled module
//   {lsp}                       a message of the language client; answers, in any number, {lsp}
//   {folder}                    where commands run
//   {id, words, take}           a command; answers {id, status, out, err, files}, with the files named in `take`, if there
//   {files, gone}               texts by their paths, which are newer than what was fetched; and paths to fetch again
//   {have}                      answers {want: {files, folders}}: a list of {path, and `bytes`, `folder` (its names, or true) or neither}
// {id, died} answers a command that ended the module itself, {died} a message that did: this worker is of no use after it.
'use strict';
import createGlint from 'glint-module';

const OWN = '/.glint'; // what commands write
const IDLE_MS = 400; // without typing, before the slower checks run

let glint = null;
const printed = { out: [], err: [] };

async function start(module) {
  glint = await createGlint({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    preRun: [
      (m) => {
        const put = (name) => (code) => code === null || printed[name].push(code);
        m.FS.init(() => null, put('out'), put('err'));
      },
    ],
  });
  glint.FS.mkdir(OWN);
  watchFiles(glint.FS);
}

// ---- the editor's files

let placing = false; // this file does the lookup, not the program
const known = new Set(); // paths that were answered, whether they exist or not
const listed = new Set(); // folders whose names are all known
let files = new Set(); // paths to ask for
let folders = new Set();
let answered = null; // resolves the promise that waits for {have}

const isOwn = (path) => path === OWN || path.startsWith(`${OWN}/`) || /^\/(dev|proc)(\/|$)/.test(path);
const wanted = () => files.size + folders.size > 0;

// The hook of the file system: MEMFS calls `lookup` for a name that it does not have.
function watchFiles(FS) {
  const folder = FS.lookupPath(OWN).node.node_ops;
  const { lookup, readdir } = folder;
  folder.lookup = (parent, name) => {
    const path = `${FS.getPath(parent).replace(/\/$/, '')}/${name}`;
    if (!placing && !known.has(path) && !isOwn(path)) files.add(path);
    return lookup(parent, name);
  };
  folder.readdir = (node) => {
    const path = FS.getPath(node);
    if (!placing && !listed.has(path) && !isOwn(path)) folders.add(path);
    return readdir(node);
  };
}

const parentOf = (path) => path.slice(0, path.lastIndexOf('/')) || '/';

function remove(path) {
  const { FS } = glint;
  const { exists, object } = FS.analyzePath(path);
  if (exists && !FS.isDir(object.mode)) FS.unlink(path);
}

function write(path, content) {
  remove(path);
  glint.FS.mkdirTree(parentOf(path));
  glint.FS.writeFile(path, content);
  known.add(path);
}

// A file of which only the name is known until it is opened.
function name(path) {
  const { FS } = glint;
  if (known.has(path) || FS.analyzePath(path).exists) return;
  FS.writeFile(path, '');
  const { node } = FS.lookupPath(path);
  node.stream_ops = {
    ...node.stream_ops,
    open() {
      if (!placing && !known.has(path)) files.add(path);
    },
  };
}

function quietly(work) {
  placing = true;
  try {
    work();
  } finally {
    placing = false;
  }
}

function put(have) {
  quietly(() => {
    for (const { path, bytes, folder } of have) {
      known.add(path);
      if (bytes) write(path, bytes);
      else if (folder) glint.FS.mkdirTree(path);
      if (!Array.isArray(folder)) continue;
      listed.add(path);
      for (const { file, name: base } of folder) {
        const whole = `${path.replace(/\/$/, '')}/${base}`;
        if (file) name(whole);
        else glint.FS.mkdirTree(whole);
      }
    }
  });
}

function forget(paths) {
  quietly(() => {
    for (const path of paths) {
      remove(path);
      known.delete(path);
      listed.delete(parentOf(path));
      // A folder that was missing may have been added with it.
      for (let above = parentOf(path); above !== '/'; above = parentOf(above)) {
        if (glint.FS.analyzePath(above).exists) break;
        known.delete(above);
        listed.delete(parentOf(above));
      }
      // When a folder is added or removed, so is everything below it.
      for (const one of [...known].filter((below) => below.startsWith(`${path}/`))) {
        remove(one);
        known.delete(one);
        listed.delete(parentOf(one));
      }
    }
  });
}

// Asks for the paths that were looked for; one question at a time.
async function fetchFiles() {
  const want = { files: [...files], folders: [...folders] };
  files = new Set();
  folders = new Set();
  const have = await new Promise((resolve) => {
    answered = resolve;
    postMessage({ want });
  });
  put(have);
  // A folder that is not there, or a name that cannot be read, is not asked for twice.
  for (const path of want.files) known.add(path);
  for (const path of want.folders) listed.add(path);
}

// ---- commands

function printedText(which) {
  const text = new TextDecoder().decode(Uint8Array.from(printed[which]));
  printed[which] = [];
  return text;
}

async function run({ id, words, take }) {
  let status;
  for (;;) {
    status = glint.callMain(words);
    if (!wanted()) break;
    printed.out = [];
    printed.err = [];
    await fetchFiles();
  }
  const made = {};
  for (const path of take || []) {
    if (!glint.FS.analyzePath(path).exists) continue;
    made[path] = glint.FS.readFile(path);
    glint.FS.unlink(path);
  }
  const answer = { id, status, out: printedText('out'), err: printedText('err'), files: made };
  postMessage(answer, Object.values(made).map((bytes) => bytes.buffer));
}

// ---- the language server

let server = 0;
let soon = 0;
let fetching = false;
const documents = new Map(); // those that are open, as `didOpen` would have them now
let held = new Map(); // findings that may change once files have arrived, by document

const pathOf = (uri) => decodeURIComponent(uri.replace(/^file:\/\//, ''));
const tell = (method, params) => take(JSON.stringify({ jsonrpc: '2.0', method, params }));
const take = (text) => glint.ccall('web_lsp_take', 'number', ['number', 'string'], [server, text]);

// The offset of a protocol position, whose columns count as in JavaScript.
function offsetOf(text, { line, character }) {
  const ends = /\r\n|\r|\n/g;
  let begin = 0;
  for (let i = 0; i < line; i++) {
    if (!ends.exec(text)) return text.length;
    begin = ends.lastIndex;
  }
  const rest = ends.exec(text);
  return Math.min(begin + character, rest ? rest.index : text.length);
}
// The whole text after changes: it is needed to open a document again.
function changedText(before, changes) {
  return changes.reduce((text, { range, text: by }) => {
    if (!range) return by;
    return text.slice(0, offsetOf(text, range.start)) + by + text.slice(offsetOf(text, range.end));
  }, before);
}

function said(text) {
  const message = JSON.parse(text);
  if (message.method === 'textDocument/publishDiagnostics') held.set(message.params.uri, message);
  else postMessage({ lsp: message });
}

function publish() {
  const messages = held;
  held = new Map();
  for (const message of messages.values()) postMessage({ lsp: message });
}

function refresh(idle) {
  soon = 0;
  const more = glint.ccall('web_lsp_refresh', 'number', ['number', 'number'], [server, idle ? 1 : 0]);
  if (fetching) return;
  if (wanted()) fetchForServer().catch(died);
  else publish();
  if (more && !idle) soon = setTimeout(checked, IDLE_MS, true);
}
function checked(idle) {
  try {
    refresh(idle);
  } catch (error) {
    died(error);
  }
}

// The scene of a document is decided when it is opened, so it is opened again.
async function fetchForServer() {
  fetching = true;
  await fetchFiles();
  fetching = false;
  for (const [uri, document] of documents) {
    tell('textDocument/didClose', { textDocument: { uri } });
    tell('textDocument/didOpen', { textDocument: document });
  }
  tell('workspace/didChangeWatchedFiles', { changes: [] });
  clearTimeout(soon);
  soon = setTimeout(checked, 0, true);
}

function serve(message) {
  const { method, params } = message;
  if (!server) {
    glint.onMessage = said;
    server = glint.ccall('web_lsp_open', 'number', [], []);
    if (!server) throw new Error('there is not enough memory');
  }
  if (method === 'textDocument/didOpen') {
    documents.set(params.textDocument.uri, { ...params.textDocument });
    if (params.textDocument.uri.startsWith('file:')) quietly(() => glint.FS.mkdirTree(parentOf(pathOf(params.textDocument.uri))));
  } else if (method === 'textDocument/didChange') {
    const document = documents.get(params.textDocument.uri);
    if (document) Object.assign(document, { text: changedText(document.text, params.contentChanges), version: params.textDocument.version });
  } else if (method === 'textDocument/didClose') {
    documents.delete(params.textDocument.uri);
  } else if (method === 'workspace/didChangeWatchedFiles') {
    forget(params.changes.map(({ uri }) => pathOf(uri)));
  }
  clearTimeout(soon);
  soon = setTimeout(checked, 0, false);
  take(JSON.stringify(message));
}

// ---- messages, one after the other

function died(error) {
  postMessage({ died: String((error && error.message) || error) });
}

async function accept(data) {
  if (data.module) await start(data.module);
  else if (data.lsp) serve(data.lsp);
  else if (data.id !== undefined) await run(data);
  else if (data.folder) {
    quietly(() => glint.FS.mkdirTree(data.folder));
    glint.FS.chdir(data.folder);
  } else if (data.files) {
    quietly(() => Object.entries(data.files).forEach(([path, text]) => write(path, text)));
    forget(data.gone || []);
  }
}

let busy = Promise.resolve();
onmessage = ({ data }) => {
  if (data.have) {
    answered(data.have);
    return;
  }
  busy = busy.then(() => accept(data)).catch((error) => postMessage({ id: data.id, died: String((error && error.message) || error) }));
};
