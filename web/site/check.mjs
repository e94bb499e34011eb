// Follows every link of a made site: node check.mjs SITE MODULES. Reports missing files and anchors, addresses from the root of a server,
// and anything that a page would fetch from elsewhere; the status is then 1. The playground has tests of its own.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const [site, modules] = process.argv.slice(2).map((one) => path.resolve(one));
const { parse } = createRequire(path.join(modules, 'site.js'))('parse5');
const ADDRESSES = { a: 'href', link: 'href', img: 'src', script: 'src', iframe: 'src', source: 'src' };

const pages = new Map(); // {ids, links: [[element, address]]}
function look(node, page) {
  for (const { name, value } of node.attrs ?? []) {
    if (name === 'id' || (name === 'name' && node.tagName === 'a')) {
      if (page.ids.has(value)) page.wrong.push(`two elements with the id '${value}'`);
      page.ids.add(value);
    }
    if (ADDRESSES[node.tagName] === name || name === 'data-page') page.links.push([node.tagName, value]);
  }
  for (const child of node.childNodes ?? []) look(child, page);
}
function* walk(folder) {
  for (const entry of fs.readdirSync(path.join(site, folder), { withFileTypes: true }).sort((a, b) => (a.name < b.name ? -1 : 1))) {
    const file = folder ? `${folder}/${entry.name}` : entry.name;
    if (!entry.isDirectory()) yield file;
    else if (file !== 'playground') yield* walk(file);
  }
}
for (const file of walk('')) {
  if (!file.endsWith('.html')) continue;
  const page = { ids: new Set(), links: [], wrong: [] };
  look(parse(fs.readFileSync(path.join(site, file), 'utf8')), page);
  pages.set(file, page);
}

let links = 0;
const wrong = [];
for (const [file, page] of pages) {
  wrong.push(...page.wrong.map((what) => `${file}: ${what}`));
  for (const [element, address] of page.links) {
    links++;
    if (address === 'data:,') continue;
    if (/^([a-z][a-z0-9+.-]*:|\/)/i.test(address)) {
      if (element !== 'a' || address.startsWith('/')) wrong.push(`${file}: '${address}' is not beside the site`);
      continue;
    }
    const [whole, fragment] = address.split('#');
    const target = whole ? path.posix.join(path.posix.dirname(file), decodeURIComponent(whole)) : file;
    if (target.startsWith('..') || !fs.existsSync(path.join(site, target)) || fs.statSync(path.join(site, target)).isDirectory()) wrong.push(`${file}: '${address}' is not there`);
    else if (fragment !== undefined && pages.has(target) && !pages.get(target).ids.has(decodeURIComponent(fragment))) wrong.push(`${file}: '${address}' has no such anchor`);
  }
}
for (const line of wrong) console.error(`dead: ${line}`);
console.log(`site: ${links} links in ${pages.size} pages${wrong.length ? `, ${wrong.length} of them dead` : ''}`);
process.exit(wrong.length ? 1 : 0);
