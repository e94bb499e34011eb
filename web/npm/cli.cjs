#!/usr/bin/env node
// glint as WebAssembly over the files of this machine: the same commands, options, reports and exit statuses.
'use strict';
const { spawnSync } = require('child_process');
const fs = require('fs');
const { load } = require('./load.cjs');

function write(fd, bytes) {
  for (let at = 0; at < bytes.length; ) {
    try {
      at += fs.writeSync(fd, bytes, at);
    } catch (error) {
      if (error.code === 'EPIPE') process.exit(0); // 'glint ... | head' is no mistake
      if (error.code !== 'EAGAIN') throw error;
    }
  }
}

// Standard input, whole, when it is read first.
let text = null;
let at = 0;
function input() {
  if (text === null) {
    try {
      text = fs.readFileSync(0);
    } catch {
      text = Buffer.alloc(0);
    }
  }
  return at < text.length ? text[at++] : null;
}

// What git says of a change; null where there is no git.
function runProgram(words) {
  const { error, status, stdout, stderr } = spawnSync(words[0], words.slice(1), { stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 30 });
  return error ? null : { status: status ?? 128, out: stdout, err: stderr };
}

// The machine's folders at their own paths. Where a folder cannot be entered, nothing below it can be read either.
function mount(m) {
  Object.assign(m.ENV, process.env);
  m.runProgram = runProgram;
  for (const entry of fs.readdirSync('/', { withFileTypes: true })) {
    const folder = '/' + entry.name;
    if (['/dev', '/proc', '/sys'].includes(folder)) continue;
    try {
      if (!fs.statSync(folder).isDirectory()) continue;
      if (!m.FS.analyzePath(folder).exists) m.FS.mkdir(folder);
      m.FS.mount(m.NODEFS, { root: folder }, folder);
    } catch (error) {
      if (error.code === 'EACCES' || error.code === 'EPERM') continue;
      throw error;
    }
  }
  m.FS.chdir(process.cwd());
}

load({ out: (bytes) => write(1, bytes), err: (bytes) => write(2, bytes), input, before: mount })
  .then((glint) => {
    process.exitCode = glint.run(process.argv.slice(2));
  })
  .catch((error) => {
    console.error(`glint: ${error && error.message ? error.message : error}`);
    process.exitCode = 3;
  });
