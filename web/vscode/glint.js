// A worker that runs glint, like the page's (web/page/glint.js), with the editor's files.
import { Glint } from '../page/glint.js';
import { answer } from './places.js';

const DEATHS_MOST = 3; // of workers that sent nothing: then the scene is not the cause
const KEPT_MOST = 1 << 28; // bytes of files

export class EditorGlint extends Glint {
  // `address`: of worker.js; `texts()`: documents that are open, by path, for a worker that starts; `log(line)`; `folder`: where commands
  // run. `keeps`: files that were read are kept until put() names them as gone: a cancelled command ends its worker, and the next one needs
  // them.
  constructor({ module, address, texts, log, folder, keeps = false }) {
    super(module, texts, false, address);
    this.log = log;
    this.folder = folder;
    this.keeps = keeps;
    this.kept = new Map(); // answers by path
    this.keptBytes = 0;
  }

  run(words, take) {
    this.worker.postMessage({ folder: this.folder });
    return super.run(words, take);
  }

  died(why) {
    this.deaths = (this.deaths || 0) + 1;
    if (this.deaths <= DEATHS_MOST) super.died(why);
    else this.end();
  }

  take(data) {
    if (data.died === undefined) this.deaths = 0;
    if (!data.want) {
      super.take(data);
      return;
    }
    const { worker } = this;
    this.answer(data.want).then((have) => worker.postMessage({ have }));
  }

  async answer({ files, folders }) {
    const there = files.filter((path) => this.kept.has(path)).map((path) => this.kept.get(path));
    const have = await answer({ files: files.filter((path) => !this.kept.has(path)), folders }, this.log);
    for (const one of have) {
      if (!this.keeps || Array.isArray(one.folder) || this.keptBytes + (one.bytes?.length || 0) > KEPT_MOST) continue;
      this.kept.set(one.path, one);
      this.keptBytes += one.bytes?.length || 0;
    }
    return [...there, ...have];
  }

  put(files, gone = []) {
    for (const path of gone) {
      // Files that were missing are looked for again too, because a folder may have been added.
      for (const [one, { bytes, folder }] of this.kept) {
        if (one !== path && !one.startsWith(`${path}/`) && (bytes || folder)) continue;
        this.keptBytes -= bytes?.length || 0;
        this.kept.delete(one);
      }
    }
    super.put(files, gone);
  }

  // Whether the picture can depend on the file.
  knows(path) {
    return this.kept.has(path) || [...this.kept.keys()].some((one) => one.startsWith(`${path}/`) || path.startsWith(`${one}/`));
  }

  // This as a worker that speaks the protocol, for the language client.
  port() {
    const port = { postMessage: (message) => this.send(message), addEventListener() {}, onmessage: null };
    this.subscribe((message) => port.onmessage({ data: message }));
    return port;
  }
}
