// A language server's client over stdio for the tests of editors: frames, requests, diagnostics.
'use strict';
const { spawn } = require('child_process');

class Client {
  constructor(command, args) {
    this.child = spawn(command, args, { stdio: ['pipe', 'pipe', 'inherit'] });
    this.bytes = Buffer.alloc(0);
    this.waiting = new Map();
    this.diagnostics = new Map();
    this.listeners = [];
    this.last = 0;
    this.child.stdout.on('data', (data) => this.receive(data));
  }
  receive(data) {
    this.bytes = Buffer.concat([this.bytes, data]);
    for (;;) {
      const end = this.bytes.indexOf('\r\n\r\n');
      if (end < 0) return;
      const length = Number(/Content-Length: *(\d+)/i.exec(this.bytes.toString('latin1', 0, end))[1]);
      if (this.bytes.length < end + 4 + length) return;
      const message = JSON.parse(this.bytes.toString('utf8', end + 4, end + 4 + length));
      this.bytes = this.bytes.subarray(end + 4 + length);
      this.take(message);
    }
  }
  take(message) {
    if (message.method && message.id !== undefined) {
      // The server asks: for configuration, or to register something.
      const result = message.method === 'workspace/configuration' ? message.params.items.map(() => null) : null;
      this.send({ id: message.id, result });
    } else if (message.method === 'textDocument/publishDiagnostics') {
      this.diagnostics.set(message.params.uri, message.params.diagnostics);
      this.listeners.forEach((listener) => listener());
    } else if (message.id !== undefined && this.waiting.has(message.id)) {
      this.waiting.get(message.id)(message);
      this.waiting.delete(message.id);
    }
  }
  send(message) {
    const text = JSON.stringify({ jsonrpc: '2.0', ...message });
    this.child.stdin.write(`Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
  }
  notify(method, params) { this.send({ method, params }); }
  request(method, params) {
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, (m) => (m.error ? reject(new Error(m.error.message)) : resolve(m.result)));
      this.send({ id, method, params });
    });
  }
  // The diagnostics of a document, once they satisfy the test.
  until(uri, test) {
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`no such diagnostics of ${uri}: ${
        JSON.stringify(this.diagnostics.get(uri))}`)), 600000);
      const look = () => {
        const list = this.diagnostics.get(uri);
        if (!list || !test(list)) return;
        clearTimeout(timer);
        resolve(list);
      };
      this.listeners.push(look);
      look();
    });
  }
  async start(root) {
    await this.request('initialize', {
      processId: process.pid, rootUri: root,
      capabilities: { textDocument: { hover: { contentFormat: ['markdown', 'plaintext'] },
        completion: { completionItem: { documentationFormat: ['markdown'], snippetSupport: false } },
        publishDiagnostics: { relatedInformation: true } } },
    });
    this.notify('initialized', {});
  }
  open(uri, languageId, text) {
    this.notify('textDocument/didOpen', { textDocument: { uri, languageId, version: 1, text } });
  }
  async stop() {
    await this.request('shutdown', null);
    this.notify('exit', null);
  }
}
module.exports = { Client };
