// The files of the scene that is shown, and typed texts: choosing another scene or closing the tab loses none.
const DRAFT = 'glint.draft.';

export class Project {
  constructor() {
    this.files = new Map(); // by paths in the scene's folder: text, or bytes
    this.path = ''; // of the scene
    this.own = new Set(); // files that the user brought
    this.kept = new Map(); // typed texts, if the browser stores nothing
  }

  // ---- scenes that ship

  async load() {
    this.shipped = await (await this.fetch('scenes.json')).json();
  }

  async fetch(path) {
    const response = await fetch(path);
    if (!response.ok) throw new Error(`${path}: ${response.status} ${response.statusText}`);
    return response;
  }

  find(path) {
    for (const group of this.shipped) for (const scene of group.scenes) if (scene.path === path || scene.twin === path) return { ...scene, path };
    return null;
  }

  // Opens the scene and its files, fetching those that are not there yet.
  async open(path) {
    const scene = this.find(path);
    const wanted = [path, ...(scene ? scene.files : [])].filter((name) => !this.files.has(name));
    await Promise.all(
      wanted.map(async (name) => {
        const content = new Uint8Array(await (await this.fetch(`scenes/${name}`)).arrayBuffer());
        this.files.set(name, /\.(ya?ml|xml|mtl)$/.test(name) ? new TextDecoder().decode(content) : content);
      }),
    );
    this.path = path;
  }

  // ---- drafts

  drafts() {
    const names = new Set(this.kept.keys());
    try {
      for (const key of Object.keys(localStorage)) if (key.startsWith(DRAFT)) names.add(key.slice(DRAFT.length));
    } catch {
      // A browser may refuse to keep anything.
    }
    return [...names].sort();
  }

  draft(path) {
    try {
      return localStorage.getItem(DRAFT + path) ?? this.kept.get(path) ?? null;
    } catch {
      return this.kept.get(path) ?? null;
    }
  }

  keep(path, text) {
    this.kept.set(path, text);
    try {
      localStorage.setItem(DRAFT + path, text);
    } catch {
      // Then it is kept as long as the page is open.
    }
  }

  forget(path) {
    this.kept.delete(path);
    try {
      localStorage.removeItem(DRAFT + path);
    } catch {
      // Nothing was stored.
    }
  }

  // A name that no file and no draft has.
  free(path) {
    const [, stem, ending] = /^(.*?)((?:\.glint)?\.[^./]+)$/.exec(path) || [, path, ''];
    let name = path;
    for (let number = 2; this.files.has(name) || this.draft(name) !== null || this.find(name); number++) name = `${stem}-${number}${ending}`;
    return name;
  }
}

// ---- files that are dragged in or chosen

const BYTES_MOST = 256 << 20;

async function entries(entry, folder, into) {
  const path = folder + entry.name;
  if (entry.isFile) {
    into.push([path, await new Promise((resolve, reject) => entry.file(resolve, reject))]);
    return;
  }
  const reader = entry.createReader();
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (!some.length) return;
    for (const one of some) await entries(one, `${path}/`, into);
  }
}

// [[path, File], ...] of a drop or of an input.
export async function filesOf(source) {
  const found = [];
  if (source.items) {
    const all = [...source.items].filter((item) => item.kind === 'file').map((item) => item.webkitGetAsEntry());
    for (const entry of all) if (entry) await entries(entry, '', found);
  } else {
    for (const file of source.files) found.push([file.webkitRelativePath || file.name, file]);
  }
  return found.filter(([path]) => !path.split('/').some((part) => part.startsWith('.') && part !== '.glintrc.yaml'));
}

// The same, read: [[path, text or bytes], ...].
export async function readFiles(found) {
  const bytes = found.reduce((sum, [, file]) => sum + file.size, 0);
  if (bytes > BYTES_MOST) throw new Error(`these files hold ${Math.round(bytes / 1e6)} MB; the page takes ${BYTES_MOST >> 20} MB`);
  return Promise.all(found.map(async ([path, file]) => {
    const content = new Uint8Array(await file.arrayBuffer());
    return [path, /\.(ya?ml|xml|mtl)$/.test(path) ? new TextDecoder().decode(content) : content];
  }));
}
