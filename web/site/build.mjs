// Makes the documentation as static files: node build.mjs OUT MODULES SOURCE [PAGE], where OUT is a new folder, MODULES the one that npm
// has filled, SOURCE the repository, and PAGE what tools/page.sh makes, the playground. Every link is relative, and the same input gives
// the same bytes.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { casesOf, codePage, codesOf } from './codes.mjs';
import { Markdown, escapeHtml } from './markdown.mjs';

const [out, modules, source, playground] = process.argv.slice(2).map((one) => path.resolve(one));
const here = path.dirname(new URL(import.meta.url).pathname);
const need = createRequire(path.join(modules, 'site.js'));
const MarkdownIt = need('markdown-it');
const MiniSearch = need('minisearch');
const highlight = need('highlight.js/lib/common');
highlight.registerLanguage('lisp', need('highlight.js/lib/languages/lisp'));
highlight.registerLanguage('vim', need('highlight.js/lib/languages/vim'));
const { default: Slugger } = await import(pathToFileURL(path.join(modules, 'node_modules/github-slugger/index.js')));

const play = playground ? { scenes: new Set() } : null;
if (play) {
  for (const { scenes } of JSON.parse(fs.readFileSync(path.join(playground, 'scenes.json'), 'utf8')))
    for (const scene of scenes) play.scenes.add(path.posix.normalize(scene.path)).add(path.posix.normalize(scene.twin));
}
const markdown = new Markdown({ MarkdownIt: MarkdownIt.default ?? MarkdownIt, Slugger, highlight, play });
const read = (file) => fs.readFileSync(path.join(source, file), 'utf8');
const write = (file, content) => {
  const target = path.join(out, file);
  fs.mkdirSync(path.dirname(target), { recursive: true });
  fs.writeFileSync(target, content);
};
const sorted = (list) => [...list].sort((a, b) => (a < b ? -1 : a > b ? 1 : 0));

// ---- which files are pages, and where they go

const targets = new Map(); // from a file of the repository to its address in the site
const copied = new Map(); // the same for what is copied as it is, or listed
const queue = [];
function addressOf(file) {
  if (file === 'README.md') return 'index.html';
  const place = file.startsWith('docs/') ? file.slice('docs/'.length) : /^(CHANGELOG|CONTRIBUTING)\.md$/.test(file) ? file.toLowerCase() : `files/${file}`;
  return place.replace(/\.md$/, '.html');
}
function addPage(file) {
  if (targets.has(file)) return;
  targets.set(file, addressOf(file));
  queue.push(file);
}
function pagesUnder(folder) {
  const found = [];
  for (const entry of fs.readdirSync(path.join(source, folder), { withFileTypes: true })) {
    const file = `${folder}/${entry.name}`;
    if (entry.isDirectory()) found.push(...pagesUnder(file));
    else if (entry.name.endsWith('.md')) found.push(file);
  }
  return sorted(found);
}

// contents.json sets the order; a name that ends in '/' stands for all pages in a folder. Pages that are not listed come under "More".
const every = ['README.md', 'CHANGELOG.md', 'CONTRIBUTING.md', ...pagesUnder('docs')];
const contents = JSON.parse(fs.readFileSync(path.join(here, 'contents.json'), 'utf8')).map(([title, files]) => ({
  title,
  files: files.flatMap((file) => (file.endsWith('/') ? every.filter((one) => one.startsWith(file)) : every.includes(file) ? [file] : [])),
}));
const listed = new Set(contents.flatMap(({ files }) => files));
contents.find(({ title }) => title === 'More').files.push(...every.filter((file) => !listed.has(file)));
for (const { files } of contents) files.forEach(addPage);

// The target of a link in `file`, relative to the page at `address`. Files that are not pages are copied; folders are listed.
const relative = (address, target) => path.posix.relative(path.posix.dirname(address), target) || path.posix.basename(target);
function linker(file, address) {
  return (href) => {
    if (/^([a-z][a-z0-9+.-]*:|#|\/\/)/i.test(href)) return href;
    const [whole, fragment] = href.split(/(?=#)/);
    const named = path.posix.join(path.posix.dirname(file), decodeURIComponent(whole)).replace(/\/$/, '');
    if (named.startsWith('..') || !fs.existsSync(path.join(source, named))) throw new Error(`${file}: the link '${href}' leads nowhere`);
    const suffix = fragment ?? '';
    if (fs.statSync(path.join(source, named)).isDirectory()) {
      copied.set(named, `files/${named}/index.html`);
      return relative(address, copied.get(named)) + suffix;
    }
    if (named.endsWith('.md')) addPage(named);
    else copied.set(named, named.startsWith('docs/') ? named.slice('docs/'.length) : `files/${named}`);
    return relative(address, targets.get(named) ?? copied.get(named)) + suffix;
  };
}

// ---- a page around what a file says

const homeTitle = 'glint';
const titles = new Map();
function tableOfContents(headings) {
  const deep = headings.filter(({ level }) => level === 2 || level === 3);
  const shown = deep.length > 45 ? deep.filter(({ level }) => level === 2) : deep;
  if (shown.length < 2) return '';
  const items = shown.map(({ level, id, text }) => `<li class="level${level}"><a href="#${escapeHtml(id)}">${escapeHtml(text)}</a></li>`);
  return `<nav class="toc" aria-label="On this page"><details open><summary>On this page</summary><ul>${items.join('')}</ul></details></nav>`;
}
function pageList(address) {
  const groups = contents.map(({ title, files }) => {
    const items = files.map((file) => {
      const target = targets.get(file);
      const current = target === address ? ' aria-current="page"' : '';
      return `<li><a href="${relative(address, target)}"${current}>${escapeHtml(titles.get(file))}</a></li>`;
    });
    return items.length ? `<h2>${title}</h2><ul>${items.join('')}</ul>` : '';
  });
  return groups.join('');
}
function whole({ address, title, html, headings, around = '', kind = '' }) {
  const root = '../'.repeat(address.split('/').length - 1);
  const playLink = play ? `<a class="top" href="${root}playground/index.html">Playground</a>` : '';
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapeHtml(title === homeTitle ? title : `${title} · glint`)}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${root}site.css">
<script defer src="${root}site.js"></script>
</head>
<body data-root="${root}"${kind ? ` class="${kind}"` : ''}>
<a class="skip" href="#content">To the text</a>
<header><a class="home" href="${root}index.html">glint</a>${playLink}
<form role="search" hidden><label for="search">Search</label> <input id="search" type="search" autocomplete="off" aria-describedby="found" placeholder="/"></form></header>
<section id="results" aria-label="Found" hidden><p id="found" role="status"></p><ul></ul></section>
<div class="columns">
<nav class="pages" aria-label="Pages"><details id="pages" open><summary>Pages</summary>${pageList(address)}</details></nav>
<script>if (innerWidth < 900) document.getElementById('pages').open = false</script>
<main id="content" tabindex="-1">
${html}${around}</main>
${tableOfContents(headings)}
</div>
</body>
</html>
`;
}

// ---- all pages

const documents = []; // what the search finds: {id, title, page, text}
const index = (address, title, sections) => {
  for (const section of sections) {
    if (!section.title && !section.text) continue;
    documents.push({ id: address + (section.id ? `#${section.id}` : ''), title: section.title || title, page: title, text: section.text });
  }
};
const codes = codesOf(read('docs/codes.md'));
const codeOfAnchor = new Map(codes.map(({ code }) => [code.toLowerCase(), code]));

const made = new Map(); // by files
while (queue.length) {
  const file = queue.shift();
  const address = targets.get(file);
  const page = markdown.page(read(file), {
    source: file,
    link: linker(file, address),
    playground: relative(address, 'playground/index.html'),
    anchors: (id) => (file === 'docs/codes.md' && codeOfAnchor.has(id) ? `<p class="more"><a href="codes/${codeOfAnchor.get(id)}.html">With examples</a></p>` : ''),
  });
  made.set(file, page);
  titles.set(file, file === 'README.md' ? 'What glint is' : page.title);
  // Each code has a page of its own; the search finds that.
  index(address, page.title, file === 'docs/codes.md' ? page.sections.filter(({ id }) => !codeOfAnchor.has(id)) : page.sections);
}

// The pictures of the gallery, before its text.
function pictures(page) {
  const found = [...page.html.matchAll(/<img src="([^"]+)" alt="([^"]*)"/g)];
  const ids = page.headings.filter(({ level }) => level === 2);
  if (found.length !== ids.length) return page.html;
  const items = found.map(([, src, alt], i) => `<li><a href="#${ids[i].id}"><img src="${src}" alt="" loading="lazy"><span>${alt}</span></a></li>`);
  return page.html.replace(/<ul>[\s\S]*?<\/ul>/, () => `<ul class="pictures">${items.join('')}</ul>`);
}

const order = contents.flatMap(({ files }) => files);
for (const [file, page] of made) {
  const address = targets.get(file);
  const at = order.indexOf(file);
  const step = (other, words, rel) => (other ? `<a rel="${rel}" href="${relative(address, targets.get(other))}">${words}: ${escapeHtml(titles.get(other))}</a>` : '<span></span>');
  const around = at < 0 ? '' : `<nav class="steps" aria-label="Next and previous page">${step(order[at - 1], 'Before', 'prev')}${step(order[at + 1], 'Next', 'next')}</nav>`;
  let { html } = page;
  if (file === 'docs/gallery.md') html = pictures(page);
  if (file === 'docs/page.md') {
    const seen = play
      ? '<p class="playground" data-page="playground/index.html"><a href="playground/index.html">Open the playground</a></p>'
      : '<p class="playground">The playground is not part of this copy of the documentation: the page was not built (tools/page.sh) when it was made.</p>';
    html = html.replace('</h1>', () => `</h1>\n${seen}`);
  }
  write(address, whole({ address, title: page.title, html, headings: page.headings, around, kind: file === 'docs/gallery.md' ? 'gallery' : '' }));
}

// ---- a page for each code

const rules = new Map();
for (const { id, text } of made.get('docs/lint.md').headings) {
  const found = /^([EWN]\d+): /.exec(text);
  if (found) rules.set(found[1], { id, text });
}
codes.forEach((one, i) => {
  const { title, markdown: text } = codePage(one, rules.get(one.code), casesOf(source, one.code));
  const address = `codes/${one.code}.html`;
  const page = markdown.page(text, { source: `docs/${one.code}.md`, link: linker('docs/codes.md', address), playground: '../playground/index.html' });
  const step = (other, words, rel) => (other ? `<a rel="${rel}" href="${other.code}.html">${words}: ${other.code}</a>` : '<span></span>');
  const around = `<nav class="steps" aria-label="Next and previous code">${step(codes[i - 1], 'Before', 'prev')}${step(codes[i + 1], 'Next', 'next')}</nav>`;
  write(address, whole({ address, title, html: page.html, headings: page.headings, around }));
  index(address, title, [{ id: '', title, text: page.sections[0].text }]);
});

// ---- files that pages link to

const BYTES_MOST = 1 << 20; // of a file that a list of a folder links to
for (const [file, address] of copied) {
  const from = path.join(source, file);
  if (!address.endsWith('/index.html') || !fs.statSync(from).isDirectory()) {
    write(address, fs.readFileSync(from));
    continue;
  }
  const rows = sorted(fs.readdirSync(from)).filter((name) => name !== 'generated').map((name) => {
    const each = path.join(from, name);
    const facts = fs.statSync(each);
    if (facts.isDirectory() || facts.size > BYTES_MOST || !/\.(ya?ml|xml|txt|json|rnc|rng|mtl|md|c|h|jpe?g|png|svg)$/.test(name)) return `<li>${escapeHtml(name)}${facts.isDirectory() ? '/' : ''}</li>`;
    if (copied.has(`${file}/${name}`)) return `<li><a href="${relative(address, copied.get(`${file}/${name}`))}">${escapeHtml(name)}</a></li>`;
    if (targets.has(`${file}/${name}`)) return `<li><a href="${relative(address, targets.get(`${file}/${name}`))}">${escapeHtml(name)}</a></li>`;
    write(`files/${file}/${name}`, fs.readFileSync(each));
    return `<li><a href="${encodeURIComponent(name)}">${escapeHtml(name)}</a></li>`;
  });
  write(address, whole({ address, title: `${file}/`, html: `<h1>${escapeHtml(file)}/</h1>\n<p>A folder of glint's source.</p>\n<ul>${rows.join('\n')}</ul>\n`, headings: [] }));
}

// ---- search, and what all pages share

const search = new MiniSearch({ fields: ['title', 'page', 'text'], storeFields: ['title', 'page', 'excerpt'] });
search.addAll(documents.map((one) => ({ ...one, excerpt: one.text.slice(0, 140) })));
write('search.js', `${fs.readFileSync(path.join(modules, 'node_modules/minisearch/dist/umd/index.js'), 'utf8').replace(/\n\/\/# sourceMappingURL=.*\n?$/, '\n')}\nwindow.GLINT_INDEX = ${JSON.stringify(JSON.stringify(search))};\n`);
for (const name of ['site.css', 'site.js']) write(name, fs.readFileSync(path.join(here, name)));
const licences = ['minisearch', 'markdown-it', 'highlight.js', 'github-slugger'].map((name) => {
  const folder = path.join(modules, 'node_modules', name);
  const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
  const file = sorted(fs.readdirSync(folder)).find((one) => /^licen[cs]e/i.test(one));
  return `${name} ${version}: ${license}\n\n${file ? fs.readFileSync(path.join(folder, file), 'utf8').trim() : ''}\n`;
});
write('licences.txt', [`glint\n\n${read('LICENSE').trim()}\n`, ...licences].join('\n----\n\n'));
if (playground) fs.cpSync(playground, path.join(out, 'playground'), { recursive: true });
console.log(`site: ${made.size} pages, ${codes.length} codes, ${documents.length} sections to search${play ? '' : '; without the playground: tools/page.sh makes it'}`);
