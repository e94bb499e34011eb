// Makes the page's static files: node build.mjs OUT MODULES PACKAGE SOURCE [GPU], where MODULES is the folder that npm has filled, PACKAGE
// the npm package glint-lint, SOURCE the repository, and GPU what tools/webgpu.sh has made. OUT is a new folder.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { licences } from '../licences.mjs';

const [out, modules, lint, source, gpu] = process.argv.slice(2);
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const esbuild = createRequire(path.join(modules, 'esbuild.js'))('esbuild');
fs.mkdirSync(out, { recursive: true });

// ---- program

const built = await esbuild.build({
  entryPoints: [path.join(here, 'main.js'), path.join(here, 'style.css')],
  outdir: out, bundle: true, minify: true, format: 'esm', target: ['es2022'], nodePaths: [path.join(modules, 'node_modules')],
  alias: { marked: path.join(here, 'markdown.js') },
  define: { GLINT_HAS_GPU: String(!!gpu) }, legalComments: 'none', metafile: true, logLevel: 'warning', charset: 'utf8',
});
await esbuild.build({ entryPoints: [path.join(here, 'worker.js')], outdir: out, minify: true, target: ['es2022'], logLevel: 'warning' });
for (const name of ['index.html']) fs.copyFileSync(path.join(here, name), path.join(out, name));
fs.copyFileSync(path.join(lint, 'glint.wasm'), path.join(out, 'glint.wasm'));
const glue = fs.readFileSync(path.join(lint, 'glint.js'), 'utf8');
fs.writeFileSync(path.join(out, 'glint.js'), esbuild.transformSync(glue, { minify: true, target: 'es2022' }).code);
if (gpu) {
  for (const name of ['glint-gpu.wasm', 'trace.wgsl', 'resolve.wgsl']) fs.copyFileSync(path.join(gpu, name), path.join(out, name));
  fs.writeFileSync(path.join(out, 'glint-gpu.js'), esbuild.transformSync(fs.readFileSync(path.join(gpu, 'glint-gpu.js'), 'utf8'), { minify: true, target: 'es2022' }).code);
}

// The licences of what is in it.
fs.writeFileSync(path.join(out, 'licences.txt'), licences(Object.keys(built.metafile.inputs), modules, source));

// ---- scenes

const GROUPS = [
  ['tutorial', 'Tutorial'], ['elements', 'One thing each'], ['language', 'From the language guide'], ['.', 'Larger'], ['gallery', 'Gallery'],
];
const scenes = path.join(source, 'scenes');
const inScenes = (file, from) => path.relative(scenes, path.resolve(from, file));
const order = (a, b) => a.localeCompare(b, 'en', { numeric: true });

// The files that each scene reads, and whether all of them exist.
function readBy(files) {
  const words = [path.join(lint, 'cli.cjs'), 'deps', '--format', 'json', ...files];
  let text;
  try {
    text = execFileSync(process.execPath, words, { cwd: scenes, encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'ignore'] });
  } catch (error) {
    text = error.stdout; // a file is missing
  }
  return new Map(JSON.parse(text).map((one) => [one.scene, one]));
}

const copied = new Set();
const left = [];
const groups = GROUPS.map(([folder, title]) => {
  const names = fs.readdirSync(path.join(scenes, folder)).filter((name) => name.endsWith('.glint.yaml')).sort(order);
  const paths = names.map((name) => path.join(folder, name));
  const twins = paths.map((name) => name.replace(/yaml$/, 'xml'));
  const read = readBy([...paths, ...twins]);
  const list = [];
  paths.forEach((name, i) => {
    const both = [read.get(name), read.get(twins[i])];
    if (both.some((one) => !one || !one.complete)) {
      left.push(name);
      return;
    }
    const files = new Set(both.flatMap((one) => one.files.map((file) => inScenes(file.path, scenes))));
    for (const file of files) copied.add(file);
    files.delete(name);
    files.delete(twins[i]);
    list.push({ path: name, twin: twins[i], title: path.basename(name, '.glint.yaml').replace(/[-_]/g, ' '), files: [...files].sort() });
  });
  return { title, scenes: list };
});
for (const file of copied) {
  const target = path.join(out, 'scenes', file);
  fs.mkdirSync(path.dirname(target), { recursive: true });
  fs.copyFileSync(path.join(scenes, file), target);
}
fs.writeFileSync(path.join(out, 'scenes.json'), JSON.stringify(groups.filter((group) => group.scenes.length)));
if (left.length) {
  console.log(`page: ${left.length} scenes are left out, as files that they read are not made: ${left.join(' ')}`);
  console.log("page: 'cmake --build build/release --target glint_scenes' makes them");
}
