// The documentation in Chromium: node browse.mjs SITE MODULES WORK. Without a playground in it, what needs one is left out, by name.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { serve } from '../../web/page/serve.mjs';
import { Browser } from '../page/browser.mjs';

const [site, modules, work] = process.argv.slice(2).map((one) => path.resolve(one));
const disk = pathToFileURL(site).href;
const axe = fs.readFileSync(path.join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8');
const { server, address } = await serve(site);
const browser = await Browser.start();
const wide = (page, width) => page.send('Emulation.setDeviceMetricsOverride', { width, height: 900, deviceScaleFactor: 1, mobile: width < 600 });
const there = (words = '') => `document.readyState === 'complete' && document.title.includes(${JSON.stringify(words)})`;

async function opened(url, words) {
  const page = await browser.page(url);
  await page.until(there(words));
  return page;
}

const tests = {
  async 'search from the disk, by keys alone'() {
    const page = await opened(`${disk}/decisions/kernel.html`);
    await page.key('/');
    assert.strictEqual(await page.value('document.activeElement.id'), 'search');
    await page.type('refraction through an open mesh');
    await page.until("document.querySelectorAll('#results li').length > 0");
    const found = await page.value("[...document.querySelectorAll('#results a')].map((one) => one.textContent)");
    assert.ok(found.slice(0, 3).some((one) => one.includes('W401')), found.join('; '));
    await page.key('ArrowDown');
    assert.ok(await page.value("document.activeElement.textContent.includes('open mesh')"), 'the first that is found has the keys');
    await page.key('Escape');
    assert.ok(await page.value("document.getElementById('results').hidden && document.activeElement.id === 'search'"));
    await page.type('E206');
    await page.until("document.querySelector('#results a')?.textContent.startsWith('E206')");
    await page.key('Enter');
    await page.until(there('E206: a number outside its range'));
    assert.ok((await page.value('location.href')).endsWith('/codes/E206.html'));
    await page.value("document.getElementById('search').focus()");
    await page.type('qqqqzzzz');
    await page.until("document.getElementById('found').textContent.startsWith('Nothing found')");
    assert.ok(page.requests.every((one) => one.startsWith('file:') || one.startsWith('data:')), page.requests.join(' '));
    assert.strictEqual(await page.value("document.querySelectorAll('a[href*=\"playground/\"]').length"), 0, 'from the disk nothing leads to the playground');
    return page;
  },

  async 'by keys: to the text, and to every page'() {
    const page = await opened(`${disk}/index.html`);
    await page.key('Tab');
    assert.strictEqual(await page.value('document.activeElement.className'), 'skip');
    await page.key('Enter');
    await page.until("document.activeElement.id === 'content'");
    const open = await page.value("document.querySelectorAll('.pages a').length");
    assert.ok(open > 20, String(open));
    return page;
  },

  async 'colours, pictures, and narrow windows'() {
    for (const [name, width] of [['language.html', 360], ['gallery.html', 360], ['codes/E206.html', 360], ['reference.html', 768], ['tutorial.html', 1400]]) {
      const page = await browser.page();
      await wide(page, width);
      await page.go(`${disk}/${name}`);
      await page.until(there());
      const [scrolls, has] = await page.value('[document.documentElement.scrollWidth, innerWidth]');
      assert.ok(scrolls <= has, `${name} is ${scrolls} wide in ${has}`);
      if (name !== 'gallery.html') assert.ok(await page.value("document.querySelectorAll('pre .hljs-attr').length > 3"), `${name} has no colours`);
      await page.value("document.querySelectorAll('img').forEach((one) => (one.loading = 'eager'))");
      await page.until("[...document.images].every((one) => one.complete)");
      assert.deepStrictEqual(await page.value("[...document.images].filter((one) => !one.naturalWidth).map((one) => one.src)"), []);
      assert.strictEqual(await page.value("document.getElementById('pages').open"), width >= 900);
      assert.deepStrictEqual(page.faults, []);
      if (width === 360) await page.screenshot(path.join(work, `${name.replace('/', '-')}.png`));
      await page.close();
    }
  },

  async 'what axe-core finds'() {
    for (const scheme of ['light', 'dark'])
      for (const [name, width] of [['index.html', 1400], ['gallery.html', 1400], ['language.html', 360], ['codes/W401.html', 360]]) {
        const page = await browser.page('', { scheme });
        await wide(page, width);
        await page.go(`${disk}/${name}`);
        await page.until(there());
        assert.strictEqual(await page.value("getComputedStyle(document.body).backgroundColor"), scheme === 'dark' ? 'rgb(23, 26, 34)' : 'rgb(255, 255, 255)');
        await page.value("document.getElementById('search').focus()");
        await page.type('glass');
        await page.until("document.querySelectorAll('#results li').length > 3");
        await page.value(axe + ';0');
        const violations = await page.value("axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations.map((one) => ({ id: one.id, impact: one.impact, nodes: one.nodes.slice(0, 3).map((node) => node.target.join(' ') + ': ' + node.failureSummary) })))");
        assert.deepStrictEqual(violations.filter((one) => ['serious', 'critical'].includes(one.impact)), [], `${name}, ${scheme}`);
        if (name === 'index.html') await page.screenshot(path.join(work, `${scheme}.png`));
        await page.close();
      }
  },

  async 'the playground: a scene of the documentation, and the page inside'() {
    if (!fs.existsSync(path.join(site, 'playground/index.html'))) {
      console.log('     left out: there is no playground; tools/page.sh makes it');
      return null;
    }
    const playing = "window.page && page.editor && document.getElementById('state').textContent === 'No mistakes'";
    const links = new Map();
    for (const name of ['language.html', 'gallery.html']) {
      const page = await opened(`${address}${name}`);
      links.set(name, await page.value("[...document.querySelectorAll('.play a')].map((one) => one.href)"));
      if (name === 'language.html') {
        const text = await page.value("document.querySelector('.play').previousElementSibling.textContent");
        await page.value("document.querySelector('.play a').click()");
        await page.until(playing);
        assert.strictEqual(await page.value('page.editor.text()'), text, 'the text of the block');
        assert.deepStrictEqual(page.faults, []);
      }
      await page.close();
    }
    assert.ok(links.get('language.html').length > 1 && links.get('gallery.html').length > 0, JSON.stringify([...links].map(([name, all]) => [name, all.length])));
    const scene = await opened(links.get('gallery.html')[0]); // with the files that it reads
    await scene.until(playing);
    await scene.close();
    const page = await opened(`${address}page.html`);
    await page.until("document.querySelector('iframe')?.contentWindow?.page?.editor?.text().includes('glint: 1')");
    return page;
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  const began = Date.now();
  try {
    const page = await test();
    if (page) assert.deepStrictEqual(page.faults, [], 'the page complains');
    console.log(`ok   ${name} (${Date.now() - began} ms)`);
  } catch (error) {
    failed = 1;
    console.log(`FAIL ${name}: ${error.stack}`);
  }
  for (const page of [...browser.pages]) await page.close();
}
await browser.stop();
server.close();
process.exit(failed);
