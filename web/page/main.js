// The page: a text, its findings, and its picture. It fetches only the files beside it.
import { Editor, connect, isXml } from './editor.js';
import { Glint, compile, compileForGpu } from './glint.js';
import { decodeLink, encodeLink } from './link.js';
import { Numbers } from './numbers.js';
import { Picture } from './picture.js';
import { Project, filesOf, readFiles } from './project.js';
import { Study } from './study.js';

const FIRST = 'elements/spheres.glint.yaml';
const OWN = 'yours/'; // the folder for files that the user brings
const COLORS = ['--color', 'never'];

const $ = (id) => document.getElementById(id);
const project = new Project();
const workers = () => [checker, clerk, painter, gpu].filter(Boolean);
const stats = { passes: [], checks: [] };
let checker, clerk, painter, gpu, client, editor, twin, picture, numbers, study;

// Shows a message of the page itself, until the next key. Mistakes in a scene are findings.
function tell(text, good) {
  $('notice').textContent = text;
  $('notice').className = good ? 'good' : 'bad';
}

function trouble(error) {
  tell(error && error.message ? error.message : String(error), false);
}

// ---- places in texts that glint prints

const normal = (path) => new URL(path, 'file:///').pathname.slice(1).split('/').map(decodeURIComponent).join('/');

function withPlaces(element, text) {
  const parts = [];
  let at = 0;
  for (const found of text.matchAll(/(?<![^\s,(])([^\s:,'"()]+):([1-9]\d*):([1-9]\d*)/g)) {
    const path = normal(found[1]);
    if (typeof project.files.get(path) !== 'string') continue;
    const button = document.createElement('button');
    button.textContent = found[0];
    button.onclick = () => goTo(path, +found[2], +found[3]);
    parts.push(text.slice(at, found.index), button);
    at = found.index + found[0].length;
  }
  element.replaceChildren(...parts, text.slice(at));
}

function goTo(path, line, column, focus = true) {
  if (path === twin.path && !$('twin').hidden && editor.path !== path) return twin.go(line, column, focus);
  if (path !== editor.path) showFile(path);
  editor.go(line, column, focus);
}

// ---- what is wrong: the text that a terminal would show

function counted(text) {
  const errors = (text.match(/: error: /g) || []).length;
  const warnings = (text.match(/: warning: /g) || []).length;
  const words = (count, one) => `${count} ${one}${count === 1 ? '' : 's'}`;
  return errors + warnings ? [errors && words(errors, 'error'), warnings && words(warnings, 'warning')].filter(Boolean).join(', ') : 'No mistakes';
}

// One run at a time; what changes meanwhile is judged after it.
function latest(work) {
  let running = false;
  let again = false;
  return async () => {
    again = true;
    if (running) return;
    running = true;
    while (again) {
      again = false;
      await work().catch(trouble);
    }
    running = false;
  };
}

const check = latest(async () => {
  const began = performance.now();
  const { status, out, err } = await clerk.run(['check', '--verbose', '--skip-pixels', ...COLORS, project.path]);
  const text = err + out;
  withPlaces($('messages'), text);
  $('state').textContent = counted(text);
  $('state').className = status === 0 ? 'good' : 'bad';
  stats.checks.push(performance.now() - began);
});

const other = (path) => (isXml(path) ? path.replace(/\.xml$/, '.yaml') : path.replace(/\.ya?ml$/, '.xml'));

// The other spelling of what is in the editor.
const spell = latest(async () => {
  if ($('twin').hidden) return;
  const from = editor.path;
  const { status, out } = await clerk.run(['convert', ...COLORS, from, '-']);
  if (from !== editor.path || $('twin').hidden) return;
  $('twin').classList.toggle('stale', status !== 0);
  if (status !== 0) {
    // The last good text stays; if there is none, there is nothing to type in.
    if (twin.path !== other(from)) twin.open(other(from), '', true);
  } else if (twin.path !== other(from) || twin.locked) twin.open(other(from), out);
  else twin.replace(out);
});

// The text has changed; what was measured for it no longer holds.
function judge() {
  study.forget();
  check();
  spell();
  picture.draw(project.path);
  numbers.update(editor);
}

// ---- texts

function put(path, content) {
  project.files.set(path, content);
  for (const glint of workers()) glint.put({ [path]: content });
}

function edited(text) {
  tell('', true);
  put(editor.path, text);
  project.keep(editor.path, text);
  $('revert').hidden = !project.find(editor.path);
  $('stage').classList.add('old');
  judge();
}

// Text typed in the other spelling becomes the editor's text if it can be understood; if not, it is kept.
async function editedTwin(text) {
  const { path } = twin;
  project.keep(path, text);
  for (const glint of [clerk]) glint.put({ [path]: text });
  const { status, out } = await clerk.run(['convert', ...COLORS, path, '-']);
  if (twin.path !== path || twin.text() !== text) return; // another key was pressed
  $('editor').classList.toggle('stale', status !== 0);
  if (status !== 0) return;
  project.forget(path);
  if ($('twin').classList.contains('stale')) {
    // The editor's text could not be understood, and is not contained in this text: it is kept as a file of its own.
    project.keep(project.free(OWN + editor.path.split('/').pop()), editor.text());
    $('twin').classList.remove('stale');
    listScenes();
  }
  editor.replace(out);
  put(editor.path, out);
  project.keep(editor.path, out);
  study.forget();
  check();
  picture.draw(project.path);
}

function showFile(path) {
  editor.open(path, project.files.get(path));
  $('editor').classList.remove('stale');
  $('file').hidden = path === project.path;
  $('filename').textContent = path;
  $('revert').hidden = !project.find(path) || project.draft(path) === null;
  spell();
  numbers.update(editor);
}

async function openScene(path, text) {
  const known = text ?? project.draft(path);
  if (known !== null) project.files.set(path, known); // so nothing is fetched in its place
  try {
    await project.open(path);
  } catch (error) {
    if (text === undefined && project.draft(path) === null) {
      listScenes();
      return trouble(error);
    }
    project.path = path; // its text is known, even if other files are missing
  }
  for (const name of project.files.keys()) {
    const draft = project.draft(name);
    if (draft !== null) project.files.set(name, draft);
  }
  const typed = text ?? project.draft(path) ?? project.files.get(path);
  project.files.set(path, typed);
  const all = Object.fromEntries(project.files);
  for (const glint of workers()) glint.put(all);
  showFile(path);
  listScenes();
  judge();
}

// ---- the list of scenes

function listScenes() {
  const option = (path, words) => Object.assign(document.createElement('option'), { value: path, textContent: words });
  const group = (label, options) => {
    const element = Object.assign(document.createElement('optgroup'), { label });
    element.append(...options);
    return element;
  };
  const listed = project.path && project.find(project.path);
  const groups = project.shipped.map(({ title, scenes }) =>
    group(title, scenes.map((scene) => option(listed && scene.twin === project.path ? scene.twin : scene.path, scene.title))));
  const own = new Set([...project.own, ...project.drafts()].filter((path) => !project.find(path)));
  if (project.path && !listed) own.add(project.path);
  if (own.size) groups.unshift(group('Yours', [...own].sort().map((path) => option(path, path.replace(OWN, '')))));
  $('scene').replaceChildren(...groups);
  $('scene').value = project.path;
}

// ---- files that are brought

const isText = (path) => /\.(ya?ml|xml)$/.test(path) && !/(^|\/)\.glintrc\.yaml$/.test(path);

// A text is a scene; a mesh gets the scene that glint draws around it; an image waits to be named.
async function bring(source) {
  const found = await readFiles(await filesOf(source));
  if (!found.length) return;
  for (const [path, content] of found) put(OWN + path, content);
  const texts = found.map(([path]) => path).filter(isText);
  const scene = texts.find((path) => /\.glint\.(ya?ml|xml)$/.test(path)) || texts[0];
  if (scene) {
    for (const path of texts) {
      project.own.add(OWN + path);
      project.forget(OWN + path);
    }
    return openScene(OWN + scene);
  }
  for (const [path] of found) {
    const name = project.free(`${OWN}${path.replace(/\.[^.]*$/, '')}.glint.yaml`);
    const { status, files } = await clerk.run(['convert', ...COLORS, OWN + path, name], [name]);
    if (status !== 0 || !files[name]) continue;
    project.own.add(name);
    const text = new TextDecoder().decode(files[name]);
    project.keep(name, text);
    project.files.set(name, text);
    return openScene(name);
  }
  tell(`${found.map(([path]) => path).join(', ')}: there now; a scene can name ${found.length > 1 ? 'them' : 'it'}`, true);
}

// ---- what leaves

function save(name, content, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

async function download(kind) {
  const name = project.path.split('/').pop();
  const stem = name.replace(/(\.glint)?\.[^.]*$/, '');
  if (kind === 'scene') return save(name, project.files.get(project.path), 'text/plain');
  if (kind === 'png') {
    if (!picture.whole) throw new Error('The whole picture is not there yet');
    return save(`${stem}.png`, picture.whole, 'image/png');
  }
  const { status, files, err } = await clerk.run(['pack', ...COLORS, project.path, '/pack.zip'], ['/pack.zip']);
  if (status !== 0) throw new Error(err.split('\n')[0]);
  return save(`${stem}.zip`, files['/pack.zip'], 'application/zip');
}

async function share() {
  const fragment = await encodeLink(editor.path, editor.text());
  history.replaceState(null, '', fragment);
  const own = [...project.files.keys()].filter((path) => path.startsWith(OWN) && path !== editor.path);
  const left = own.length ? '; it carries this text, not the files that you brought' : '';
  try {
    await navigator.clipboard.writeText(location.href);
    tell(`The link is copied${left}`, true);
  } catch {
    tell(`The link is in the address bar${left}`, true);
  }
}

async function openLink() {
  let link = null;
  try {
    link = await decodeLink(location.hash);
  } catch (error) {
    await openScene(FIRST);
    return tell(`This link is damaged: ${error.message}`, false);
  }
  if (!link) return openScene(FIRST);
  if (link.text === undefined) {
    if (project.find(link.path)) return openScene(link.path);
    await openScene(FIRST);
    return tell(`This link names a scene that is not here: ${link.path}`, false);
  }
  // Text typed under this name is kept as a file of its own.
  const draft = project.draft(link.path);
  if (draft !== null && draft !== link.text) project.keep(project.free(OWN + link.path.split('/').pop()), draft);
  project.keep(link.path, link.text);
  return openScene(link.path, link.text);
}

// ---- pixels

let mark = null; // {x, y}

function placeMark() {
  const { width, height } = $('picture');
  $('mark').hidden = !mark;
  if (mark) Object.assign($('mark').style, { left: `${((mark.x + 0.5) / width) * 100}%`, top: `${((mark.y + 0.5) / height) * 100}%` });
}

async function pick(focus) {
  placeMark();
  const camera = picture.camera ? ['--camera', picture.camera] : [];
  const words = ['pick', project.path, `${mark.x},${mark.y}`, '--device', 'reference', ...camera, ...COLORS];
  const { out, err } = await clerk.run(words);
  $('picked').hidden = false;
  withPlaces($('pick'), out || err);
  const place = /^sees .*?([^\s,]+):(\d+):(\d+)$/m.exec(out);
  if (place && typeof project.files.get(normal(place[1])) === 'string') goTo(normal(place[1]), +place[2], +place[3], focus);
}

function pickKeys(event) {
  const { width, height } = $('picture');
  const step = event.shiftKey ? 1 : Math.max(1, Math.round(width / 40));
  const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
  mark = mark || { x: width >> 1, y: height >> 1 };
  if (moves[event.key]) {
    const [x, y] = moves[event.key];
    mark = { x: Math.min(width - 1, Math.max(0, mark.x + x)), y: Math.min(height - 1, Math.max(0, mark.y + y)) };
    placeMark();
  } else if (event.key === 'Enter') pick(false).catch(trouble);
  else return;
  event.preventDefault();
}

// ---- the picture

function painted({ part, ms, whole, failed, by, samples, width, height }) {
  if (failed !== undefined) {
    $('progress').textContent = failed || 'This is the last picture: the text of now has errors.';
    return;
  }
  $('stage').classList.remove('old');
  const words = whole ? `${width} × ${height}, ${samples} sample${samples === 1 ? '' : 's'} per pixel` : part > 1 ? `every ${part}th pixel …` : 'one sample per pixel …';
  $('progress').textContent = `${words} (${ms < 1000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(1)} s`})${whole ? `, by ${by}` : ''}`;
  stats.passes.push({ part, ms, whole, by, at: performance.now() });
  placeMark();
}

function understood({ cameras }) {
  $('cameras').hidden = cameras.length < 2;
  const options = cameras.map((name) => Object.assign(document.createElement('option'), { value: name, textContent: name }));
  $('camera').replaceChildren(...options);
  $('camera').value = picture.camera || cameras[0];
}

// ---- buttons

function wire() {
  const on = (id, event, work) => $(id).addEventListener(event, (...all) => Promise.resolve(work(...all)).catch(trouble));
  on('scene', 'change', () => openScene($('scene').value));
  on('back', 'click', () => showFile(project.path));
  on('revert', 'click', async () => {
    const { path } = editor;
    project.keep(project.free(OWN + path.split('/').pop()), editor.text());
    project.forget(path);
    project.files.delete(path);
    await openScene(path);
  });
  on('open', 'click', () => $('files').click());
  on('folder', 'click', () => $('directory').click());
  for (const id of ['files', 'directory'])
    on(id, 'change', async () => {
      await bring($(id));
      $(id).value = '';
    });
  on('both', 'click', () => {
    const shows = $('twin').hidden;
    $('twin').hidden = !shows;
    $('both').setAttribute('aria-pressed', String(shows));
    $('editor').classList.remove('stale');
    return spell();
  });
  on('fix', 'click', async () => (await editor.fixAll()) || tell('No fix is certain', false));
  on('format', 'click', () => editor.format());
  on('share', 'click', share);
  on('download', 'change', async () => {
    const kind = $('download').value;
    $('download').value = '';
    if (kind) await download(kind);
  });
  on('camera', 'change', () => {
    study.forget();
    picture.camera = $('camera').value;
    picture.draw(project.path);
  });
  on('picture', 'click', (event) => {
    const box = $('picture').getBoundingClientRect();
    const { width, height } = $('picture');
    mark = {
      x: Math.min(width - 1, Math.floor(((event.clientX - box.left) / box.width) * width)),
      y: Math.min(height - 1, Math.floor(((event.clientY - box.top) / box.height) * height)),
    };
    return pick(true);
  });
  on('picture', 'keydown', pickKeys);
  const body = document.body;
  let over = 0;
  body.addEventListener('dragenter', () => ($('drop').hidden = ++over === 0));
  body.addEventListener('dragleave', () => ($('drop').hidden = --over <= 0));
  body.addEventListener('dragover', (event) => event.preventDefault());
  body.addEventListener('drop', (event) => {
    event.preventDefault();
    over = 0;
    $('drop').hidden = true;
    bring(event.dataTransfer).catch(trouble);
  }, true);
  window.addEventListener('hashchange', () => openLink().catch(trouble));
}

// ---- the beginning

async function begin() {
  const [module] = await Promise.all([compile(), project.load()]);
  const files = () => project.files;
  painter = new Glint(module, files);
  clerk = new Glint(module, files);
  checker = new Glint(module, files);
  client = connect(checker);
  checker.onRestart = () => {
    client.disconnect();
    client.connect(checker);
  };
  picture = new Picture({ glint: painter, canvas: $('picture'), told: painted, seen: understood });
  const moved = () => numbers && numbers.update(editor);
  editor = new Editor({ parent: $('editor'), label: 'The scene', client, changed: edited, moved });
  twin = new Editor({ parent: $('twin'), label: 'The other spelling', client, changed: (text) => editedTwin(text).catch(trouble), moved: () => {} });
  numbers = new Numbers({ panel: $('numbers'), list: $('sliders'), client });
  study = new Study({
    $,
    worker: () => new Glint(module, files),
    scene: () => picture.scene,
    choose: (words, draws) => {
      picture.settings = words;
      if (draws) picture.draw(project.path);
    },
  });
  wire();
  await openLink();
  const forGpu = await compileForGpu().catch(() => null);
  if (!forGpu) return;
  gpu = picture.gpu = new Glint(forGpu, files, true);
  picture.draw(project.path);
}

window.addEventListener('unhandledrejection', (event) => trouble(event.reason));
// For tests and the curious.
window.page = { stats, project, get workers() { return [checker, clerk, painter]; }, get editor() { return editor; }, get twin() { return twin; }, get picture() { return picture; }, get study() { return study; } };
begin().catch(trouble);
