// The active parts of the documentation's pages: the search, and the playground inside a page. They also work from a folder on the disk,
// where a browser loads scripts but fetches nothing.
'use strict';
const root = document.body.dataset.root;
const form = document.querySelector('form[role=search]');
const input = document.getElementById('search');
const results = document.getElementById('results');
const list = results.querySelector('ul');
const MOST = 20;
let index = null;

// The index is loaded when it is first needed.
function load() {
  index = index || new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = `${root}search.js`;
    script.onload = () => resolve(MiniSearch.loadJSON(GLINT_INDEX, { fields: ['title', 'page', 'text'], storeFields: ['title', 'page', 'excerpt'] }));
    script.onerror = () => reject(new Error('search.js is not there'));
    document.head.append(script);
  });
  return index;
}

function show(words, found) {
  results.hidden = !words;
  document.getElementById('found').textContent = found.length ? `${found.length} found${found.length > MOST ? `, the best ${MOST}` : ''}` : `Nothing found for ‘${words}’`;
  list.replaceChildren(...found.slice(0, MOST).map(({ id, title, page, excerpt }) => {
    const item = document.createElement('li');
    const link = document.createElement('a');
    const text = document.createElement('p');
    link.href = root + id;
    link.textContent = page === title ? title : `${page}: ${title}`;
    text.textContent = excerpt;
    item.append(link, text);
    return item;
  }));
}

async function search() {
  const words = input.value.trim();
  if (!words) return show('', []);
  const found = (await load()).search(words, { boost: { title: 4, page: 2 }, prefix: true, fuzzy: (term) => (term.length > 4 ? 0.2 : false), combineWith: 'AND' });
  if (words === input.value.trim()) show(words, found);
}

form.hidden = false;
input.addEventListener('focus', load);
input.addEventListener('input', search);
form.addEventListener('submit', (event) => {
  event.preventDefault();
  const first = list.querySelector('a');
  if (first) first.click();
});

// '/' goes to the search, arrow keys to what it found, Escape back to the page.
document.addEventListener('keydown', (event) => {
  const inText = /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
  if (event.key === '/' && !inText && !event.ctrlKey && !event.metaKey && !event.altKey) {
    event.preventDefault();
    input.focus();
  }
  if (results.hidden || !(event.target === input || results.contains(event.target))) return;
  const places = [input, ...list.querySelectorAll('a')];
  const at = places.indexOf(document.activeElement);
  if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
    event.preventDefault();
    places[Math.max(0, Math.min(places.length - 1, at + (event.key === 'ArrowDown' ? 1 : -1)))].focus();
  } else if (event.key === 'Escape') {
    input.value = '';
    show('', []);
    input.focus();
  }
});
list.addEventListener('click', () => show('', []));

// The playground starts workers, which a browser refuses to pages that lie on the disk.
if (location.protocol === 'file:') {
  for (const link of document.querySelectorAll('a[href*="playground/index.html"]')) link.remove();
  for (const place of document.querySelectorAll('.playground')) if (place.dataset.page) place.textContent = 'The playground needs a web server; this page was opened from the disk.';
  for (const empty of document.querySelectorAll('.play')) empty.remove();
} else {
  for (const place of document.querySelectorAll('.playground[data-page]')) {
    const frame = Object.assign(document.createElement('iframe'), { src: place.dataset.page, title: 'The playground', loading: 'lazy' });
    place.after(frame);
  }
}
