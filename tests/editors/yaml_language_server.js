'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const { pathToFileURL } = require('url');
const { Client } = require('./client.js');
const [, , modulePath, work, source] = process.argv;
const head = '# yaml-language-server: $schema=glint.schema.json\n';

function file(name, text) {
  fs.writeFileSync(path.join(work, name), text);
  return pathToFileURL(path.join(work, name)).href;
}

async function main() {
  const client = new Client('node', [path.join(modulePath, 'bin', 'yaml-language-server'), '--stdio']);
  await client.start(pathToFileURL(work).href);
  client.notify('workspace/didChangeConfiguration', { settings: { yaml: {
    validate: true, hover: true, completion: true, schemaStore: { enable: false } } } });

  // Diagnostics: a misspelt key, a value out of range, a word that is none.
  const bad = head + 'glint: 1\nimage: {widht: 3, height: 0, tone: Clip}\n';
  const uri = file('bad.yaml', bad);
  client.open(uri, 'yaml', bad);
  const list = await client.until(uri, (found) => found.length >= 3);
  const text = list.map((d) => d.message).join('\n');
  assert.match(text, /widht/);
  assert(list.every((d) => d.range.start.line === 2), 'on their line');

  // Hover: what the attribute means.
  const good = head + 'glint: 1\ncamera:\n  fov: 60\n  \nmaterials:\n  glass:\n    refractive_index: 1.5\n';
  const goodUri = file('good.yaml', good);
  client.open(goodUri, 'yaml', good);
  const hover = await client.request('textDocument/hover',
    { textDocument: { uri: goodUri }, position: { line: 3, character: 3 } });
  assert.match(JSON.stringify(hover.contents), /[Vv]ertical field of view/);

  // Completion: the keys of a camera, and those already there left out.
  const completion = await client.request('textDocument/completion',
    { textDocument: { uri: goodUri }, position: { line: 4, character: 2 } });
  const labels = (completion.items || completion).map((item) => item.label);
  assert(labels.includes('position') && labels.includes('look_at'), labels.join(' '));
  assert(!labels.includes('refractive_index'), 'keys of other elements stay away');

  // Silence on everything that ships.
  for (const folder of ['scenes', 'scenes/elements']) {
    for (const name of fs.readdirSync(path.join(source, folder)).filter((n) => n.endsWith('.glint.yaml'))) {
      const body = head + fs.readFileSync(path.join(source, folder, name), 'utf8').replace(/^# yaml-language-server.*\n/, '');
      const sceneUri = file(name, body);
      client.open(sceneUri, 'yaml', body);
      const found = await client.until(sceneUri, () => true);
      assert.deepStrictEqual(found.map((d) => d.message), [], name);
    }
  }
  await client.stop();
}
main().then(() => process.exit(0), (error) => { console.error(error); process.exit(1); });
