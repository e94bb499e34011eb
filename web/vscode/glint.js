// A worker with glint in it, as the page has it (web/page/glint.js), whose files are the editor's.
import { Glint } from '../page/glint.js';
import { answer } from './places.js';

export class EditorGlint extends Glint {
  // `address`: of worker.js; `texts()`: documents that are open, by path, for a worker that starts; `log(line)`; `folder`: where commands run.
  constructor({ module, address, texts, log, folder }) {
    super(module, texts, false, address);
    this.log = log;
    this.folder = folder;
  }

  run(words, take) {
    this.worker.postMessage({ folder: this.folder });
    return super.run(words, take);
  }

  take(data) {
    if (!data.want) {
      super.take(data);
      return;
    }
    const { worker } = this;
    answer(data.want, this.log).then((have) => worker.postMessage({ have }));
  }

  // As a worker that speaks the protocol: what the language client wants to be given.
  port() {
    const port = { postMessage: (message) => this.send(message), addEventListener() {}, onmessage: null };
    this.subscribe((message) => port.onmessage({ data: message }));
    return port;
  }
}
