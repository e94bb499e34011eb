// check(text, files), run(words, files) and serve(send, files): glint over files that exist only in memory. index.d.ts says what comes back.
'use strict';
const path = require('path').posix;
const { load } = require('./load.cjs');

const FOLDER = '/scene';

function place(m, files) {
  m.FS.mkdir(FOLDER);
  for (const [name, content] of Object.entries(files)) {
    const whole = path.resolve(FOLDER, name);
    if (!whole.startsWith(FOLDER + '/')) throw new RangeError(`'${name}' is outside of the scene's folder`);
    m.FS.mkdirTree(path.dirname(whole));
    m.FS.writeFile(whole, content);
  }
  m.FS.chdir(FOLDER);
}

async function run(words, files = {}) {
  const out = [];
  const err = [];
  const glint = await load({
    out: (bytes) => out.push(bytes),
    err: (bytes) => err.push(bytes),
    before: (m) => place(m, files),
  });
  const status = glint.run(words);
  return { status, out: Buffer.concat(out).toString('utf8'), err: Buffer.concat(err).toString('utf8') };
}

async function check(text, files = {}, options = {}) {
  const name = options.name || (/^\s*</.test(text) ? 'scene.glint.xml' : 'scene.glint.yaml');
  const words = ['check', name, '--format', 'json', ...(options.args || [])];
  const { status, out, err } = await run(words, { ...files, [name]: text });
  if (!out) throw new Error(err.trim() || `glint check ended with status ${status}`);
  return { status, ...JSON.parse(out) };
}

// How long nobody must have typed before what takes longer is checked.
const IDLE_MS = 400;

async function serve(send, files = {}) {
  const log = [];
  const glint = await load({ out: () => {}, err: (bytes) => log.push(bytes), before: (m) => place(m, files) });
  glint.onMessage = (text) => send(JSON.parse(text));
  let server = glint.ccall('web_lsp_open', 'number', [], []);
  if (!server) throw new Error('there is not enough memory for the language server');
  let soon = null;
  const refresh = (idle) => {
    soon = null;
    const more = server && glint.ccall('web_lsp_refresh', 'number', ['number', 'number'], [server, idle ? 1 : 0]);
    if (more && !idle) soon = setTimeout(refresh, IDLE_MS, true);
  };
  return {
    // Messages that come together are checked once, as nothing more waits.
    take(message) {
      if (!server) throw new Error('the language server has ended');
      clearTimeout(soon);
      soon = setTimeout(refresh, 0, false);
      if (!glint.ccall('web_lsp_take', 'number', ['number', 'string'], [server, JSON.stringify(message)])) this.close();
    },
    write: (name, content) => glint.FS.writeFile(path.resolve(FOLDER, name), content),
    // The exit status: 0 after `shutdown`.
    close() {
      clearTimeout(soon);
      const status = server ? glint.ccall('web_lsp_close', 'number', ['number'], [server]) : 0;
      server = 0;
      return status;
    },
    root: `file://${FOLDER}`,
  };
}

module.exports = { check, run, serve };
