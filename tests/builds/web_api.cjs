// The package glint-lint in a program: node web_api.cjs PACKAGE
'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const { check, run, serve } = require(path.resolve(process.argv[2]));

const wrong = 'glint: 1\nspheres: [{center: [0, 0, 0], raduis: 1, material: stone}]\n';

async function checks() {
  const report = await check(wrong, { 'base.yaml': 'glint: 1\n' });
  assert.strictEqual(report.status, 1);
  assert.deepStrictEqual(report.scenes[0].findings.map((one) => [one.code, one.line, one.column]), [['E202', 2, 31], ['E301', 2, 52]]);
  const types = fs.readFileSync(path.join(process.argv[2], 'index.d.ts'), 'utf8');
  for (const name of Object.keys(report).concat(Object.keys(report.scenes[0]), Object.keys(report.scenes[0].findings[0])))
    assert.match(types, new RegExp(`\\b${name}\\??:`), name);
  const good = await check('<Scene glint="1"><Include file="parts/ball.xml"/></Scene>', {
    'parts/ball.xml': '<Scene glint="1"><Sphere radius="1"><Center x="0" y="0" z="0"/></Sphere></Scene>',
  }, { args: ['--fail-on', 'error'] });
  assert.strictEqual(good.status, 0, JSON.stringify(good));
  await assert.rejects(check(wrong, { '../elsewhere': '' }), RangeError);
  await assert.rejects(check(wrong, {}, { args: ['--no-such-option'] }), /no-such-option/);
}

async function picture() {
  const scene = 'glint: 1\nimage: {width: 8, height: 6}\ncamera: {position: [0, 0, 4]}\nlights: [{position: [5, 5, 5]}]\nspheres: [{center: [0, 0, 0], radius: 1}]\n';
  const { status, err } = await run(['render', 'a.yaml', '--device', 'reference', '--no-cache', '-o', 'a.png'], { 'a.yaml': scene });
  assert.strictEqual(status, 0, err);
}

async function server() {
  const said = [];
  let wake;
  const until = async (good) => {
    for (let tries = 0; !said.some(good); tries++) {
      assert.ok(tries < 100, JSON.stringify(said));
      await new Promise((resolve) => { wake = resolve; setTimeout(resolve, 100); });
    }
    return said.find(good);
  };
  const lsp = await serve((message) => { said.push(message); if (wake) wake(); });
  const uri = `${lsp.root}/main.yaml`;
  lsp.take({ jsonrpc: '2.0', id: 1, method: 'initialize', params: { capabilities: {} } });
  assert.ok((await until((m) => m.id === 1)).result.capabilities.hoverProvider);
  lsp.take({ jsonrpc: '2.0', method: 'initialized', params: {} });
  lsp.take({ jsonrpc: '2.0', method: 'textDocument/didOpen', params: { textDocument: { uri, version: 1, languageId: 'yaml', text: wrong } } });
  const found = await until((m) => m.method === 'textDocument/publishDiagnostics');
  assert.deepStrictEqual(found.params.diagnostics.map((one) => one.code), ['E202', 'E301']);
  lsp.take({ jsonrpc: '2.0', id: 2, method: 'textDocument/hover', params: { textDocument: { uri }, position: { line: 1, character: 2 } } });
  assert.ok((await until((m) => m.id === 2)).result.contents);
  lsp.take({ jsonrpc: '2.0', id: 3, method: 'shutdown' });
  await until((m) => m.id === 3);
  assert.strictEqual(lsp.close(), 0);
  assert.throws(() => lsp.take({}), /has ended/);
}

checks().then(picture).then(server).then(() => console.log('all good'), (error) => { console.error(error); process.exit(1); });
