// Chromium without a window, driven through its own protocol over a pipe (--remote-debugging-pipe: messages of JSON, each ended by a
// zero), so that no package is needed.
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';

export const PROGRAM = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find((file) => fs.existsSync(file));
export const WAIT_MS = +process.env.PAGE_WAIT || 600000; // for what should come at once: a hang ends there, and a busy machine does not

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export class Browser {
  // With more words for Chromium's command line.
  static async start(...more) {
    const browser = new Browser();
    browser.folder = fs.mkdtempSync(path.join(os.tmpdir(), 'glint-page-'));
    const words = [
      '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-background-networking', '--disable-component-update',
      '--no-first-run', `--user-data-dir=${browser.folder}`, '--remote-debugging-pipe', '--window-size=1400,900', ...more, 'about:blank',
    ];
    browser.process = spawn(PROGRAM, words, { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    browser.waiting = new Map();
    browser.listeners = [];
    browser.next = 1;
    browser.pages = []; // those that are open
    let rest = Buffer.alloc(0);
    browser.process.stdio[4].on('data', (bytes) => {
      rest = Buffer.concat([rest, bytes]);
      for (let end; (end = rest.indexOf(0)) >= 0; rest = rest.subarray(end + 1)) browser.take(JSON.parse(rest.subarray(0, end).toString()));
    });
    browser.process.on('exit', () => {
      for (const { reject } of browser.waiting.values()) reject(new Error('the browser has ended'));
    });
    return browser;
  }

  take(message) {
    if (message.id) {
      const { resolve, reject } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    } else {
      for (const listener of this.listeners) listener(message);
    }
  }

  send(method, params = {}, sessionId) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
  }

  async page(address, { scheme = 'light' } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    this.pages.push(page);
    await page.send('Page.enable');
    await page.send('Runtime.enable');
    await page.send('Network.enable');
    await page.send('Log.enable');
    await page.send('Emulation.setDeviceMetricsOverride', { width: 1400, height: 900, deviceScaleFactor: 1, mobile: false });
    await page.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: scheme }] });
    if (address) await page.go(address);
    return page;
  }

  async stop() {
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    await this.send('Browser.close').catch(() => {});
    const kill = setTimeout(() => this.process.kill('SIGKILL'), 5000);
    await ended;
    clearTimeout(kill);
    fs.rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

const KEYS = {
  Enter: [13, '\r'], Tab: [9], Escape: [27], Backspace: [8], Delete: [46], ArrowUp: [38], ArrowDown: [40], ArrowLeft: [37], ArrowRight: [39],
  Home: [36], End: [35], F8: [119],
};

class Page {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target });
    this.faults = []; // what the page itself complains of
    this.requests = [];
    browser.listeners.push(({ method, params, sessionId }) => {
      if (sessionId !== session) return;
      if (method === 'Runtime.exceptionThrown') this.faults.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
      if (method === 'Runtime.consoleAPICalled' && params.type === 'error') this.faults.push(params.args.map((one) => one.value || one.description).join(' '));
      if (method === 'Log.entryAdded' && params.entry.level === 'error') this.faults.push(`${params.entry.text} ${params.entry.url || ''}`);
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    });
  }

  send(method, params) {
    return this.browser.send(method, params, this.session);
  }

  async go(address) {
    await this.send('Page.navigate', { url: address });
  }

  // The value of an expression, awaited.
  async value(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(`${expression.slice(0, 200)}: ${exceptionDetails.exception?.description || exceptionDetails.text}`);
    return result.value;
  }

  // Waits until an expression is true; returns its value.
  async until(expression, ms = WAIT_MS) {
    const end = Date.now() + ms;
    for (;;) {
      const value = await this.value(expression).catch(() => false);
      if (value) return value;
      if (Date.now() > end) throw new Error(`never true: ${expression}`);
      await sleep(10);
    }
  }

  async type(text) {
    for (const char of text) {
      if (char === '\n') await this.key('Enter');
      else await this.send('Input.dispatchKeyEvent', { type: 'char', text: char });
    }
  }

  // A key by its name, with modifiers before it: 'Control+End', 'Shift+Tab'.
  async key(name) {
    const parts = name.split('+');
    const key = parts.pop();
    const modifiers = parts.reduce((sum, one) => sum | { Alt: 1, Control: 2, Meta: 4, Shift: 8 }[one], 0);
    const [code, text] = KEYS[key] || [key === '.' ? 190 : key.toUpperCase().charCodeAt(0)];
    const event = { key, code: KEYS[key] ? key : key === '.' ? 'Period' : `Key${key.toUpperCase()}`, windowsVirtualKeyCode: code, modifiers };
    await this.send('Input.dispatchKeyEvent', { type: text && !modifiers ? 'keyDown' : 'rawKeyDown', ...event, ...(text && !modifiers ? { text } : {}) });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', ...event });
  }

  async click(x, y) {
    for (const type of ['mousePressed', 'mouseReleased']) await this.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', clickCount: 1 });
  }

  async screenshot(file) {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    fs.writeFileSync(file, Buffer.from(data, 'base64'));
  }

  async close() {
    this.browser.pages = this.browser.pages.filter((one) => one !== this);
    await this.browser.send('Target.closeTarget', { targetId: this.target });
  }
}
