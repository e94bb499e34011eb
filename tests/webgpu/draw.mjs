// Pictures by WebGPU against those of the device here: node draw.mjs PAGE GLINT SCENES WORK WORDS SCENE..., where PAGE holds glint-gpu.js,
// its module, kernels and index.html; WORDS are options of `glint render` for both, in one argument. Chromium draws by SwiftShader.
// A scene that asks for double precision is refused (E707), and one that needs it is warned of (W701): it is not compared.
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { serve } from '../../web/page/serve.mjs';
import { Browser } from '../page/browser.mjs';

const [folder, glint, scenes, work, options, ...names] = process.argv.slice(2);
const MOST = 1e-5; // difference of values, of those above 1 as a part of them
const words = options.split(' ').filter(Boolean);
const { server, address } = await serve(folder);
const WAIT_MS = (+process.env.WEBGPU_WAIT || 120) * 1000; // for a picture: SwiftShader compiles some kernels for very long
let browser, page;
async function begin() {
  browser = await Browser.start('--enable-unsafe-webgpu', '--enable-features=Vulkan', '--use-webgpu-adapter=swiftshader');
  page = await browser.page(address);
  await page.until('window.ready');
}
await begin();

// Of a PFM: its numbers. All are of three components, and of this machine's order of bytes.
function numbers(bytes) {
  const head = /^PF\n(\d+) (\d+)\n-[0-9.]+\n/.exec(bytes.subarray(0, 64).toString('latin1'));
  const count = 3 * head[1] * head[2];
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + head[0].length, bytes.byteOffset + head[0].length + 4 * count));
}
// Or what came of it instead.
async function run(list, take) {
  let timer;
  const late = new Promise((resolve) => { timer = setTimeout(resolve, WAIT_MS, { status: -1, err: `no answer in ${WAIT_MS / 1000} s`, late: true }); });
  const answer = await Promise.race([page.value(`run(${JSON.stringify(list)}, ${JSON.stringify(take || [])})`), late]);
  clearTimeout(timer);
  return answer;
}

const found = await run(['devices']);
console.log(found.out.trim() || found.err || found.died);
let failed = found.status !== 0;
for (const name of names) {
  const file = `${name}.glint.yaml`;
  const reads = JSON.parse(spawnSync(glint, ['deps', '--format', 'json', file], { cwd: scenes, encoding: 'utf8' }).stdout)[0];
  if (!reads.complete) {
    console.log(`${name}: left out, a file that it reads is not made`);
    continue;
  }
  const files = {};
  for (const one of [file, ...reads.files.map((each) => each.path)]) files[path.relative(scenes, path.resolve(scenes, one))] = fs.readFileSync(path.resolve(scenes, one)).toString('base64');
  await page.value(`put(${JSON.stringify(files)})`);
  const began = performance.now();
  const { status, err, died, late, files: made } = await run(['render', file, ...words, '--quiet', '--color', 'never', '-o', '/out.pfm'], ['/out.pfm']);
  const seconds = ((performance.now() - began) / 1000).toFixed(1);
  if (/E707|W701/.test(err)) {
    console.log(`${name}: ${seconds} s, needs double precision: ${err.split('\n')[0]}`);
    continue;
  }
  if (status !== 0) {
    console.log(`FAIL ${name}: ${seconds} s, status ${status}\n${err}${died || ''}`);
    failed = true;
    if (late || /no longer exists|lost/.test(err)) {
      await browser.stop();
      await begin();
    }
    continue;
  }
  const native = path.join(work, 'native.pfm');
  execFileSync(glint, ['render', file, ...words, '--quiet', '-o', native], { cwd: scenes, stdio: ['ignore', 'ignore', 'inherit'] });
  const [ours, theirs] = [numbers(fs.readFileSync(native)), numbers(Buffer.from(made['/out.pfm'], 'base64'))];
  let most = ours.length === theirs.length ? 0 : Infinity, off = 0, at = 0;
  ours.forEach((value, i) => {
    const apart = Math.abs(value - theirs[i]) / Math.max(1, Math.abs(value));
    if (!(apart <= MOST)) off++;
    if (!(apart <= most)) [most, at] = [apart, i];
  });
  const good = most <= MOST;
  failed = failed || !good;
  console.log(`${good ? 'ok  ' : 'FAIL'} ${name}: largest difference ${most}${off ? `, ${off} of ${ours.length} values over ${MOST}, the worst ${theirs[at]} for ${ours[at]}` : ''}, ${seconds} s`);
}
for (const fault of page.faults) console.log(`the page complains: ${fault}`);
await browser.stop();
server.close();
process.exit(failed ? 1 : 0);
