// The page where there is a GPU: node page.mjs PAGE. SwiftShader plays one, which the page takes only where it is asked to.
import assert from 'node:assert';
import { serve } from '../../web/page/serve.mjs';
import { Browser } from '../page/browser.mjs';

const { server, address } = await serve(process.argv[2]);
const browser = await Browser.start('--enable-unsafe-webgpu', '--enable-features=Vulkan', '--use-webgpu-adapter=swiftshader');
const progress = "document.getElementById('progress').textContent";
const WAIT_MS = 300000;

// What nobody can use is not fetched.
const plain = await browser.page(address);
await plain.until('page.picture && page.picture.whole');
assert.match(await plain.value(progress), /, by the reference$/);
assert.deepStrictEqual(plain.requests.filter((one) => /gpu|wgsl/.test(one)), []);
await plain.close();

const page = await browser.page(`${address}?adapter=any`);
await page.until("page.stats.passes.some((one) => one.by === 'WebGPU')", WAIT_MS);
assert.match(await page.value(progress), /^320 × 240, 4 samples per pixel \(.*\), by WebGPU$/);
console.log(`ok   spheres: ${await page.value(progress)}`);
await page.value("(() => { const list = document.getElementById('scene'); list.value = 'elements/precision.glint.yaml'; list.dispatchEvent(new Event('change')) })()");
await page.until("page.editor.path === 'elements/precision.glint.yaml' && page.picture.whole", WAIT_MS);
assert.match(await page.value(progress), /, by the reference: this scene needs double precision/);
console.log(`ok   double precision: ${await page.value(progress)}`);
assert.deepStrictEqual(page.faults, []);
await browser.stop();
server.close();
