// The licences of what a bundle contains, glint's own first: licences(inputs, modules, source), where `inputs` are the files of esbuild's
// metafile, `modules` the folder that npm has filled, and `source` the repository.
import fs from 'node:fs';
import path from 'node:path';

export function licences(inputs, modules, source) {
  const packages = new Set();
  for (const input of inputs) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) packages.add(found[1]);
  }
  const others = [...packages].sort().map((name) => {
    const folder = path.join(modules, 'node_modules', name);
    const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
    const file = fs.readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
    return `${name} ${version}: ${license}\n\n${file ? fs.readFileSync(path.join(folder, file), 'utf8').trim() : ''}\n`;
  });
  return [`glint\n\n${fs.readFileSync(path.join(source, 'LICENSE'), 'utf8').trim()}\n`, ...others].join('\n----\n\n');
}
