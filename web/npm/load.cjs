// One instance of glint.wasm. What it prints goes to `out` and `err`, functions that take bytes.
'use strict';
const fs = require('fs');
const path = require('path');
const createGlint = require('./glint.js');

const wasmBinary = fs.readFileSync(path.join(__dirname, 'glint.wasm'));

// A character device of its own for each stream, so that bytes come as they are, and lines without an end too.
function streams(module, out, err) {
  const bytes = { out: [], err: [] };
  const flush = () => {
    if (bytes.out.length) out(Buffer.from(bytes.out));
    if (bytes.err.length) err(Buffer.from(bytes.err));
    bytes.out = [];
    bytes.err = [];
  };
  const put = (name) => (code) => {
    if (code === null) return;
    bytes[name].push(code);
    if (bytes[name].length >= 65536) flush();
  };
  return { flush, out: put('out'), err: put('err') };
}

async function load({ out, err, input, before }) {
  let stream;
  const module = await createGlint({
    wasmBinary,
    preRun: [
      (m) => {
        stream = streams(m, out, err);
        m.FS.init(input || (() => null), stream.out, stream.err);
        before(m);
      },
    ],
  });
  // The exit status of a command.
  module.run = (words) => {
    try {
      return module.callMain(words);
    } finally {
      stream.flush();
    }
  };
  return module;
}

module.exports = { load };
