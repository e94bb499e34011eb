// The page, typed at: node typing.mjs PAGE GLINT SCENES MODULES WORK. Prints what it measures; limits on time have room for a busy machine.
import assert from 'node:assert';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { serve } from '../../web/page/serve.mjs';
import { Browser, WAIT_MS, sleep } from './browser.mjs';

const [folder, glint, scenes, modules, work] = process.argv.slice(2);
const ROOM = 20; // times what the issue asks for
const { server, address } = await serve(folder);
const browser = await Browser.start();

const state = "document.getElementById('state').textContent";
const notice = "document.getElementById('notice').textContent";
const messages = "document.getElementById('messages').textContent";
const text = 'page.editor.text()';
const idle = 'page.stats.passes.length && page.stats.passes[page.stats.passes.length - 1].whole && page.picture.whole !== null';
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];

// A page that has drawn its first picture.
async function opened(fragment = '', options = {}) {
  const page = await browser.page(address + fragment, options);
  await page.until(`window.page && page.editor && ${text} && ${state}`);
  return page;
}
async function choose(page, scene) {
  await page.value(`(() => { const list = document.getElementById('scene'); list.value = ${JSON.stringify(scene)}; list.dispatchEvent(new Event('change')) })()`);
  await page.until(`page.editor.path === ${JSON.stringify(scene)}`);
}
// The cursor before the text, or after it.
const cursor = (page, words, after = false) =>
  page.value(`(() => { const { view } = page.editor; const at = ${text}.indexOf(${JSON.stringify(words)}); if (at < 0) throw new Error('no such text');
    view.dispatch({ selection: { anchor: at + ${after ? words.length : 0} } }); view.focus() })()`);
const click = (page, id) => page.value(`document.getElementById(${JSON.stringify(id)}).click()`);
const contains = (page, expression, words) => page.until(`${expression}.includes(${JSON.stringify(words)})`);

const tests = {
  async 'the first picture, and that it is the native one'() {
    const page = await opened();
    await page.until(idle);
    const passes = await page.value('page.stats.passes');
    const first = passes[0];
    console.log(`first coarse picture ${first.at.toFixed(0)} ms after navigation, whole picture ${passes.at(-1).at.toFixed(0)} ms`);
    assert.ok(first.at < 1000 * ROOM);
    assert.ok(first.part > 1 && passes.length >= 4, 'from coarse to fine');
    for (const scene of ['elements/spheres', 'elements/models', 'tutorial/step-3']) {
      await choose(page, `${scene}.glint.yaml`);
      await page.until(idle);
      const drawn = await page.value("btoa(Array.from(page.picture.whole, (one) => String.fromCharCode(one)).join(''))");
      const file = path.join(work, 'native.png');
      execFileSync(glint, ['render', `${scene}.glint.yaml`, '--device', 'reference', '--as-file', '--no-cache', '--quiet', '-o', file], { cwd: scenes });
      assert.ok(Buffer.from(drawn, 'base64').equals(fs.readFileSync(file)), `${scene}: the picture has other bytes than the native one`);
      const shown = await page.value(`(() => { const { canvas } = page.picture; return canvas.width + 'x' + canvas.height })()`);
      assert.strictEqual(shown, scene.startsWith('tutorial') ? '640x480' : scene.endsWith('models') ? '320x200' : '320x240');
    }
    const own = new URL(address).origin;
    assert.deepStrictEqual(page.requests.filter((one) => !one.startsWith(own) && !/^(data|blob):/.test(one)), [], 'nothing is fetched elsewhere');
    return page;
  },

  async 'a key to the squiggle, the carets and a coarse picture'() {
    const page = await opened();
    await page.until(idle);
    await cursor(page, 'fov', true);
    const squiggles = [];
    const carets = [];
    const pictures = [];
    for (let i = 0; i < 7; i++) {
      await page.value(`window.seen = {}; window.addEventListener('keypress', () => { seen.key = performance.now() }, { once: true, capture: true });
        window.watch = setInterval(() => {
          if (!seen.key) return;
          if (!seen.squiggle && document.querySelector('.cm-lintRange-error')) seen.squiggle = performance.now();
          if (!seen.caret && ${messages}.includes('fovx')) seen.caret = performance.now();
        }, 1); 0`);
      await page.type('x');
      const seen = await page.until('seen.squiggle && seen.caret && seen');
      squiggles.push(seen.squiggle - seen.key);
      carets.push(seen.caret - seen.key);
      await page.value('clearInterval(window.watch); seen = { passes: page.stats.passes.length, began: performance.now() }; 0');
      await page.key('Backspace');
      await page.until('page.stats.passes.length > seen.passes');
      pictures.push(await page.value('page.stats.passes[seen.passes].at - seen.began'));
      await page.until(`${idle} && !document.querySelector('.cm-lintRange-error')`);
    }
    const say = (list) => `${median(list).toFixed(0)} ms, at most ${Math.max(...list).toFixed(0)}`;
    console.log(`key to squiggle ${say(squiggles)}; to carets ${say(carets)}; to the first coarse picture ${say(pictures)}`);
    assert.ok(median(squiggles) < 150 * ROOM && median(carets) < 50 * ROOM);
    return page;
  },

  async 'mistakes are found, fixed by keys, and the last picture stays'() {
    const page = await opened('#tutorial/step-4.glint.yaml');
    await page.until(idle);
    await cursor(page, 'radius', true);
    for (let i = 0; i < 3; i++) await page.key('Backspace');
    await page.type('is');
    await contains(page, messages, "a sphere has no 'radis'");
    await contains(page, state, '1 error');
    await page.until("!!document.querySelector('#stage').classList.contains('old')");
    await page.until("!!document.querySelector('.cm-lintRange-error')");
    for (const end = Date.now() + WAIT_MS; !(await page.value(text)).includes('radius: 1, material') && Date.now() < end; await sleep(50))
      await page.key('Control+.'); // does nothing before the fix is there, which comes a moment after its finding
    await contains(page, text, 'radius: 1, material');
    await contains(page, state, 'No mistakes');
    await page.until(idle);
    await cursor(page, 'plastic}', true);
    await page.key('Backspace');
    await page.key('Backspace');
    await page.type('k}');
    await contains(page, messages, "'plastik'");
    await click(page, 'fix');
    await contains(page, text, 'material: plastic}');
    // The place in a message is a button that leads to the line.
    await page.type('!');
    await contains(page, messages, ': error:');
    await cursor(page, 'glint: 1');
    const place = await page.until("(() => { const button = document.querySelector('#messages button'); button.click(); return button.textContent })()");
    const line = await page.value('page.editor.view.state.doc.lineAt(page.editor.view.state.selection.main.head).number');
    assert.strictEqual(line, +/:(\d+):/.exec(place)[1]);
    return page;
  },

  async 'completion, hover, format'() {
    const page = await opened('#tutorial/step-4.glint.yaml');
    await cursor(page, ', specular_exponent');
    await page.type(', refr');
    await page.until("!!document.querySelector('.cm-tooltip-autocomplete')");
    await contains(page, "document.querySelector('.cm-tooltip-autocomplete').textContent", 'refractive_index');
    await sleep(150); // keys are not taken before that, lest a fast typist accepts what he has not seen
    await page.key('Enter');
    await contains(page, text, 'refractive_index:');
    const box = await page.value(`(() => { const { view } = page.editor; const at = view.coordsAtPos(${text}.indexOf('look_at') + 3); return [at.left, (at.top + at.bottom) / 2] })()`);
    await page.send('Input.dispatchMouseEvent', { type: 'mouseMoved', x: box[0], y: box[1] });
    await page.until("!!document.querySelector('.cm-tooltip-hover')");
    assert.match(await page.value("document.querySelector('.cm-tooltip-hover').textContent"), /camera/i);
    await cursor(page, 'camera:', true);
    await page.type('     ');
    await click(page, 'format');
    await page.until(`!${text}.includes('camera:      ')`);
    return page;
  },

  async 'both spellings, either of them typed in'() {
    const page = await opened();
    await click(page, 'both');
    await page.until("page.twin.path === 'elements/spheres.glint.xml' && page.twin.text().includes('<Sphere')");
    await cursor(page, 'radius: 0.9', true);
    await page.type('5');
    await contains(page, 'page.twin.text()', 'radius="0.95"');
    await page.value("(() => { const { view } = page.twin; const at = page.twin.text().indexOf('radius=\"0.95\"') + 12; view.dispatch({ selection: { anchor: at } }); view.focus() })()");
    await page.key('Backspace');
    await page.type('9');
    await contains(page, text, 'radius: 0.99,');
    await page.type('x');
    await page.until("document.getElementById('editor').classList.contains('stale')");
    assert.ok((await page.value(text)).includes('radius: 0.99,'), 'what cannot be understood changes nothing');
    assert.ok((await page.value('page.twin.text()')).includes('0.99x'), 'and stays');
    await page.key('Backspace');
    await page.until("!document.getElementById('editor').classList.contains('stale')");
    // A text that cannot be understood has no other spelling; one typed there does not make it go away.
    await cursor(page, 'glint: 1', true);
    await page.type('{');
    await page.until("document.getElementById('twin').classList.contains('stale')");
    const broken = await page.value(text);
    await page.value("(() => { const { view } = page.twin; const at = page.twin.text().indexOf('radius=\"0.99\"') + 12; view.dispatch({ selection: { anchor: at } }); view.focus() })()");
    await page.key('Backspace');
    await page.type('8');
    await contains(page, text, 'radius: 0.98,');
    assert.ok((await page.value('page.project.drafts().map((one) => page.project.draft(one))')).includes(broken), 'it is one of the texts that are yours');
    return page;
  },

  async 'a pixel, by mouse and by keys'() {
    const page = await opened();
    await page.until(idle);
    const [x, y] = await page.value("(() => { const box = document.getElementById('picture').getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2] })()");
    await page.click(x, y);
    await contains(page, "document.getElementById('pick').textContent", "sphere 'body'");
    const line = 'page.editor.view.state.doc.lineAt(page.editor.view.state.selection.main.head).text';
    await contains(page, line, 'name: body');
    await page.value("document.getElementById('picture').focus()");
    for (let i = 0; i < 20; i++) await page.key('ArrowDown');
    await page.key('Enter');
    await contains(page, "document.getElementById('pick').textContent", 'rectangle');
    await contains(page, line, 'corner: [-20');
    assert.strictEqual(await page.value('document.activeElement.id'), 'picture', 'keys stay where they are');
    return page;
  },

  async 'sliders'() {
    for (const ending of ['yaml', 'xml']) {
      const page = await opened(`#elements/spheres.glint.${ending}`);
      await cursor(page, ending === 'yaml' ? 'radius: 0.42' : 'radius="0.42"');
      await page.until("document.querySelectorAll('#sliders input').length === 4");
      const label = ending === 'yaml' ? ['center[0]', 'center[1]', 'center[2]', 'radius'] : ['radius', 'Center x', 'Center y', 'Center z'];
      assert.deepStrictEqual(await page.value("[...document.querySelectorAll('#sliders span')].map((one) => one.textContent)"), label);
      const index = label.indexOf('radius');
      await page.until(`document.querySelectorAll('#sliders input')[${index}].min > 0`); // its range is known: more than nothing
      await page.value(`document.querySelectorAll('#sliders input')[${index}].focus()`);
      const before = await page.value('page.stats.passes.length');
      await page.key('ArrowRight');
      await page.until(`!${text}.includes('0.42') && page.stats.passes.length > ${before}`);
      await contains(page, state, 'No mistakes');
      await page.close();
    }
    const page = await opened('#elements/spheres.glint.yaml');
    await cursor(page, 'radius: 0.9');
    await page.until("!document.getElementById('numbers').hidden");
    await cursor(page, 'glint: 1');
    await page.until("document.getElementById('numbers').hidden"); // the whole scene has no sliders
    return page;
  },

  async 'settings: what is measured, the front, and the slider'() {
    const page = await opened('#elements/trace.glint.yaml');
    await page.until(idle);
    await page.value("document.getElementById('measure').focus()");
    await page.key('Enter');
    await contains(page, "document.getElementById('measured').textContent", 'settings measured');
    const { points, front } = await page.value('({ points: page.study.points, front: page.study.front })');
    const at = (samples, depth) => points.find((one) => one.samples === samples && one.depth === depth);
    const deepest = Math.max(...points.map((one) => one.depth));
    assert.ok(points.length >= 10 && deepest > 1 && deepest <= 9, JSON.stringify(points));
    assert.ok(points.every((one) => one.ms > 0 && one.error > 0 && one.error < 1));
    assert.ok(at(16, deepest).error < at(1, deepest).error, 'more samples are nearer');
    assert.ok(at(16, 0).error > at(16, deepest).error, 'mirrors need depth');
    for (const one of front) assert.ok(!points.some((other) => other.ms < one.ms && other.error < one.error), 'no point beats one of the front');
    for (const one of points) assert.ok(front.some((other) => other.ms <= one.ms && other.error <= one.error), 'each point is beaten by one of the front, or is one');
    // What it says of a setting is what native commands say of it.
    const size = ['--size', await page.value('page.study.size')];
    const draw = (samples, limits, file) => execFileSync(glint, ['render', 'elements/trace.glint.yaml', '--device', 'reference', '--no-cache', '--quiet', ...size, '--samples', samples, ...limits, '-o', file], { cwd: scenes });
    draw(64, [], path.join(work, 'truth.pfm'));
    draw(4, ['--as-file', '--set', 'trace.max_depth=0'], path.join(work, 'point.pfm'));
    const compared = JSON.parse(execFileSync(glint, ['compare', path.join(work, 'point.pfm'), path.join(work, 'truth.pfm'), '--format', 'json'], { encoding: 'utf8' }));
    assert.ok(Math.abs(at(4, 0).error - compared.metrics.flip.value) < 1e-6, 'the powers of FLIP are those of another library');
    // By keys: the slider, its words, the picture.
    await page.value("document.getElementById('setting').focus()");
    const passes = await page.value('page.stats.passes.length');
    await page.key('End');
    const last = front.at(-1);
    await contains(page, "document.getElementById('chosen').textContent", `depth ${last.depth}: `);
    assert.strictEqual(await page.value("document.getElementById('paste').textContent"), `image: {samples: ${last.samples}}\ntrace: {max_depth: ${last.depth}}`);
    assert.ok((await page.value("document.getElementById('setting').getAttribute('aria-valuetext')")).startsWith(`${last.samples} sample`));
    await page.until(`page.stats.passes.slice(${passes}).some((one) => one.whole)`);
    await contains(page, "document.getElementById('progress').textContent", `${last.samples} sample`);
    assert.strictEqual(await page.value("document.querySelectorAll('#points li').length"), front.length);
    assert.strictEqual(await page.value("document.querySelectorAll('#chart circle').length"), points.length + front.length);
    await click(page, 'asis');
    await page.until("document.getElementById('asis').hidden");
    await page.until(idle);
    await contains(page, "document.getElementById('progress').textContent", '4 samples');
    // Another text: what was measured is gone, and a study that is under way ends.
    await click(page, 'measure');
    await contains(page, "document.getElementById('measured').textContent", 'Measuring');
    await cursor(page, 'max_depth: 9', true);
    await page.key('Backspace');
    await page.type('8');
    await page.until("document.getElementById('measured').textContent === '' && document.getElementById('front').hidden && page.study.glint === null");
    return page;
  },

  async 'links, good and damaged'() {
    const page = await opened('#tutorial/step-2.glint.yaml');
    await cursor(page, 'glint: 1', true);
    await page.type('\n# träffe ☃');
    await click(page, 'share');
    await page.until("location.hash.startsWith('#z=')");
    const typed = await page.value(text);
    const hash = await page.value('location.hash');
    await page.value('localStorage.clear()');
    await page.close();
    const other = await opened(hash);
    assert.strictEqual(await other.value(text), typed);
    await other.close();
    for (const [wrong, why] of [
      [hash.slice(0, -20), 'damaged'], ['#z=a.yaml,!!!', 'damaged'], ['#z=a.yaml', 'damaged'], ['#z=../a.yaml,', 'damaged'], ['#no/such.yaml', 'not here'], ['#%', 'damaged'],
    ]) {
      const page = await opened(wrong);
      await contains(page, notice, why);
      assert.ok((await page.value(text)).includes('glint: 1'), 'there is a scene all the same');
      await page.close();
    }
    // A text that would unpack to far more than it takes is refused.
    const large = await browser.page(address);
    await large.until(`window.page && page.editor && ${text}`);
    const bomb = await large.value(`(async () => { const stream = new Blob([' '.repeat(20 << 20)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
      const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
      return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join('')).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '') })()`);
    await large.value(`location.hash = '#z=a.yaml,' + ${JSON.stringify(bomb)}; 0`);
    await contains(large, notice, 'more than 4 MB');
    return large;
  },

  async 'files that are brought, good and bad'() {
    const page = await opened();
    const drop = async (...files) => {
      const data = { items: [], files: files.map((file) => path.resolve(file)), dragOperationsMask: 1 };
      for (const type of ['dragEnter', 'dragOver', 'drop']) await page.send('Input.dispatchDragEvent', { type, x: 400, y: 400, data });
    };
    await cursor(page, 'radius: 0.9', true);
    await page.type('1');
    await drop(path.join(scenes, 'meshes/fox.obj'), path.join(scenes, 'meshes/fox.mtl'));
    await page.until("page.editor.path === 'yours/fox.glint.yaml'");
    const passes = await page.value('page.stats.passes.length'); // at most one of the scene before is still to come
    await contains(page, text, 'mesh: fox.obj');
    await page.until(`page.picture.scene?.path === 'yours/fox.glint.yaml' && page.stats.passes.length > ${passes} + 1`); // the whole picture takes long
    await contains(page, state, 'No mistakes');
    await choose(page, 'elements/spheres.glint.yaml');
    assert.ok((await page.value(text)).includes('radius: 0.91'), 'what was typed before is there');
    // A folder: a scene with what it includes.
    const whole = path.join(work, 'folder');
    fs.mkdirSync(path.join(whole, 'parts'), { recursive: true });
    fs.writeFileSync(path.join(whole, 'main.glint.yaml'), 'glint: 1\ninclude: [parts/ball.yaml]\n');
    fs.writeFileSync(path.join(whole, 'parts/ball.yaml'), 'glint: 1\nspheres: [{center: [0, 0, 0], radius: 1, colour: 1}]\n');
    await drop(whole);
    await page.until("page.editor.path === 'yours/folder/main.glint.yaml'");
    await contains(page, messages, 'parts/ball.yaml:2:');
    await page.value("document.querySelector('#messages button').click()");
    await page.until("page.editor.path === 'yours/folder/parts/ball.yaml'");
    await cursor(page, ', colour: 1', true);
    for (let i = 0; i < ', colour: 1'.length; i++) await page.key('Backspace');
    await contains(page, state, 'No mistakes');
    await page.until(idle);
    // What is no mesh, and what is nothing that glint reads, harms nothing.
    const junk = path.join(work, 'junk.obj');
    fs.writeFileSync(junk, Buffer.from(Array.from({ length: 5000 }, (_, i) => (i * 7919) & 255)));
    await drop(junk);
    await page.until("page.editor.path === 'yours/junk.glint.yaml'");
    await contains(page, messages, 'junk.obj:1:1: error');
    const notes = path.join(work, 'notes.txt');
    fs.writeFileSync(notes, 'These are notes.');
    await drop(notes);
    await contains(page, notice, 'notes.txt: there now');
    const broken = path.join(work, 'broken.glint.yaml');
    fs.writeFileSync(broken, Buffer.concat([Buffer.from('glint: 1\n\t{[}: '), Buffer.from([0xff, 0xfe, 0x00, 0x80])]));
    await drop(broken);
    await page.until("page.editor.path === 'yours/broken.glint.yaml'");
    await contains(page, state, 'error');
    return page;
  },

  async 'a text is not lost: another scene, a reload, a scene that breaks the module'() {
    const page = await opened('#tutorial/step-1.glint.yaml');
    await cursor(page, 'glint: 1', true);
    await page.type('\n{{{ <<< not yaml');
    await contains(page, state, 'error');
    const typed = await page.value(text);
    await choose(page, 'tutorial/step-2.glint.yaml');
    await choose(page, 'tutorial/step-1.glint.yaml');
    assert.strictEqual(await page.value(text), typed);
    await page.send('Page.reload');
    await page.until(`window.page && page.editor && page.editor.path === 'tutorial/step-1.glint.yaml' && ${state}`);
    assert.strictEqual(await page.value(text), typed);
    await click(page, 'revert');
    await page.until(`!${text}.includes('not yaml')`);
    assert.ok((await page.value("page.project.drafts().map((one) => page.project.draft(one)).join('')")).includes('not yaml'), 'it is kept beside');
    // A worker that dies is replaced: the page goes on.
    await page.value('page.workers.forEach((one) => one.died("a test ends it")); 0');
    await cursor(page, 'glint: 1', true);
    await page.type('x');
    await contains(page, state, 'error');
    await page.key('Backspace');
    await contains(page, state, 'No mistakes');
    await page.until(idle);
    return page;
  },

  async 'what is downloaded'() {
    const page = await opened('#elements/models.glint.yaml');
    await page.until(idle);
    const folder = path.join(work, 'downloads');
    fs.mkdirSync(folder, { recursive: true });
    await page.browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
    for (const [kind, name] of [['scene', 'models.glint.yaml'], ['pack', 'models.zip'], ['png', 'models.png']]) {
      await page.value(`(() => { const list = document.getElementById('download'); list.value = '${kind}'; list.dispatchEvent(new Event('change')) })()`);
      const there = () => fs.existsSync(path.join(folder, name)) && !fs.readdirSync(folder).some((one) => one.endsWith('.crdownload'));
      for (const end = Date.now() + WAIT_MS; !there() && Date.now() < end; ) await sleep(25);
      assert.ok(there(), name);
    }
    const native = path.join(work, 'native.zip');
    execFileSync(glint, ['pack', 'elements/models.glint.yaml', native], { cwd: scenes });
    assert.ok(fs.readFileSync(native).equals(fs.readFileSync(path.join(folder, 'models.zip'))), 'the package has the native bytes');
    assert.ok(fs.readFileSync(path.join(scenes, 'elements/models.glint.yaml')).equals(fs.readFileSync(path.join(folder, 'models.glint.yaml'))));
    return page;
  },

  async 'every scene that ships'() {
    const page = await opened();
    const all = await page.value('page.project.shipped.flatMap((group) => group.scenes.map((one) => one.path))');
    assert.ok(all.length > 40, String(all.length));
    for (const scene of all) {
      const checks = await page.value('page.stats.checks.length');
      await choose(page, scene);
      await page.until(`page.stats.checks.length > ${checks}`);
      await contains(page, state, 'No mistakes');
    }
    console.log(`${all.length} scenes`);
    return page;
  },

  async 'text, picture and findings are seen at once, on a phone too, and nothing moves with the first key'() {
    for (const [width, height] of [[1280, 800], [390, 844]]) {
      const page = await browser.page(null);
      await page.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 500 });
      await page.go(address);
      await page.until(`window.page && page.editor && ${text} && ${state}`);
      await page.until(idle);
      const boxes = () => page.value("Object.fromEntries(['editor', 'picture', 'progress', 'state'].map((id) => { const { left, top, right, bottom } = document.getElementById(id).getBoundingClientRect(); return [id, [left, top, right, bottom]] }))");
      const before = await boxes();
      for (const [id, [left, top, right, bottom]] of Object.entries(before))
        assert.ok(left >= 0 && top >= 0 && right <= width && bottom <= height && right - left > 50 && bottom - top > 10, `${width}x${height}: ${id} at ${left} ${top} ${right} ${bottom}`);
      assert.ok(await page.value(`document.documentElement.scrollWidth <= ${width}`), 'the page is not wider than the screen');
      await cursor(page, 'fov', true);
      await page.type('x');
      await contains(page, state, '1 error');
      assert.deepStrictEqual((await boxes()).editor, before.editor);
      await page.value('localStorage.clear()');
      await page.close();
    }
  },

  async 'by keys alone, and what axe-core finds'() {
    const axe = fs.readFileSync(path.join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8');
    for (const scheme of ['light', 'dark']) {
      const page = await opened('', { scheme });
      await page.until(idle);
      const reached = new Set();
      for (let i = 0; i < 60; i++) {
        await page.key('Tab');
        reached.add(await page.value("document.activeElement.id || document.activeElement.className || document.activeElement.tagName"));
      }
      for (const id of ['scene', 'open', 'folder', 'both', 'fix', 'format', 'share', 'download', 'picture', 'measure', 'messages'])
        assert.ok(reached.has(id), `Tab does not reach ${id}: ${[...reached].join(' ')}`);
      assert.ok([...reached].some((one) => one.includes('cm-content')), 'Tab reaches the text, and leaves it');
      await cursor(page, 'radius: 0.42', true);
      await page.type('x');
      await page.until("!!document.querySelector('.cm-lintRange-error') && !document.getElementById('numbers').hidden");
      await page.value("page.study.show([{ samples: 1, depth: 1, ms: 10, error: 0.1 }, { samples: 4, depth: 1, ms: 40, error: 0.05 }])");
      await page.value("document.querySelector('#front details').open = true; page.study.pick(0)");
      await click(page, 'both');
      await page.value(axe + ';0');
      const { violations } = await page.value("axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => ({ violations: violations.map((one) => ({ id: one.id, impact: one.impact, nodes: one.nodes.map((node) => node.target.join(' ') + ': ' + node.failureSummary) })) }))");
      console.log(`axe-core, ${scheme}: ${violations.map((one) => `${one.id} (${one.impact})`).join(', ') || 'nothing'}`);
      assert.deepStrictEqual(violations.filter((one) => ['serious', 'critical'].includes(one.impact)), []);
      await page.screenshot(path.join(work, `${scheme}.png`));
      await page.value('localStorage.clear()');
      await page.close();
    }
  },
};

let failed = 0;
const only = process.env.PAGE_TEST;
for (const [name, test] of Object.entries(tests)) {
  if (only && !name.includes(only)) continue;
  const began = Date.now();
  let bad = false;
  try {
    const page = await test();
    if (page) assert.deepStrictEqual(page.faults, [], 'the page complains');
    console.log(`ok   ${name} (${Date.now() - began} ms)`);
  } catch (error) {
    failed = 1;
    bad = true;
    console.log(`FAIL ${name}: ${error.stack}`);
  }
  for (const page of browser.pages) {
    if (bad) console.log(await page.value(`[${state}, page.editor.path, ${text}, ${messages}].join('\\n').slice(0, 3000)`).catch(String), page.faults);
    await page.value('localStorage.clear()').catch(() => {});
    await page.close();
  }
}
await browser.stop();
server.close();
process.exit(failed);
