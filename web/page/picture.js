// The picture of a scene, coarse to fine, by the reference tracer in a worker. The last pass equals, byte for byte, the file that `glint
// render SCENE --device reference --as-file` writes; or, if there is a GPU, the GPU draws the whole picture.
import { Cancelled } from './glint.js';

const PARTS = [8, 4, 2, 1]; // of width and height, with one sample per pixel
const LEAST = 24; // pixels across: coarser ones show nothing
const SHORT_MS = 60; // a pass that ends soon is waited for
const LONG_MS = 2000; // a pass on a GPU that takes longer is given up, together with what its compiler has made
const GPU_MS = 60000; // for a GPU's compiler, and its picture

const TRACER = ['--device', 'reference', '--as-file', '--no-cache', '--quiet', '--color', 'never'];

// Reads what `glint inspect --ir=evaluated` prints.
function understood(text) {
  const number = (name, normal, part = 'image') => {
    const found = new RegExp(`^${part}:(?:\\n +.*)*?\\n +${name}: (\\d+)$`, 'm').exec(text);
    return found ? +found[1] : normal;
  };
  const cameras = /^cameras:((?:\n +.*)*)/m.exec(text);
  const names = cameras ? [...cameras[1].matchAll(/^ {2}(\S.*):$/gm)].map(([, name]) => (name.startsWith('"') ? JSON.parse(name) : name)) : [];
  return { width: number('width', 640), height: number('height', 480), samples: number('samples', 1), depth: number('max_depth', 16, 'trace'), cameras: names };
}

export class Picture {
  // `told({part, ms, whole, failed})` after each pass; `seen(understood)` when the text was.
  constructor({ glint, canvas, told, seen }) {
    Object.assign(this, { glint, canvas, told, seen });
    this.camera = '';
    this.settings = []; // options to try instead of the scene's own
    this.scene = null; // what was understood last
    this.wanted = null;
    this.began = 0;
    this.whole = null; // the file of the whole picture
    this.working = false;
    this.gpu = null; // a worker that draws by WebGPU, once there is one
    this.gpuBegan = 0;
  }

  // The scene at `path`, whose files the worker has. A picture that is being made is given up.
  draw(path) {
    this.wanted = path;
    this.whole = null;
    if (this.began && performance.now() - this.began > SHORT_MS) this.glint.cancel();
    if (this.gpuBegan && performance.now() - this.gpuBegan > LONG_MS) this.gpu.cancel();
    if (!this.working) this.work();
  }

  async work() {
    this.working = true;
    while (this.wanted) {
      const path = this.wanted;
      this.wanted = null;
      try {
        await this.passes(path);
      } catch (error) {
        if (!(error instanceof Cancelled)) this.told({ failed: error.message });
      }
    }
    this.working = false;
  }

  async run(words, take) {
    this.began = performance.now();
    const long = setTimeout(() => this.glint.prepare(), SHORT_MS);
    try {
      const answer = await this.glint.run(words, take);
      return { ...answer, ms: performance.now() - this.began };
    } finally {
      clearTimeout(long);
      this.began = 0;
    }
  }

  // Draws the whole picture by WebGPU; returns why it was not drawn, '' if it was.
  async byGpu(path, camera, scene) {
    const began = (this.gpuBegan = performance.now());
    const late = setTimeout(() => this.gpu.died('the GPU did not answer'), GPU_MS);
    try {
      const { status, err, files } = await this.gpu.run(['render', path, '--quiet', '--color', 'never', ...camera, ...this.settings, '-o', '/picture.png'], ['/picture.png']);
      if (/\[(E707|W701)\]/.test(err)) return 'this scene needs double precision, which WebGPU has not';
      if (status !== 0 || this.wanted) return err.split('\n')[0] || 'the text has changed';
      await this.show(files['/picture.png'], scene);
      if (!this.wanted) this.whole = files['/picture.png'];
      this.told({ part: 1, ms: performance.now() - began, whole: true, by: 'WebGPU', samples: scene.samples, width: scene.width, height: scene.height });
      return '';
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      this.gpu = null; // its worker has started again; one that failed once is not asked again
      return error.message;
    } finally {
      clearTimeout(late);
      this.gpuBegan = 0;
    }
  }

  async passes(path) {
    const { status, out } = await this.run(['inspect', '--ir=evaluated', '--skip-pixels', '--color', 'never', path]);
    if (status !== 0) {
      this.scene = null;
      this.told({ failed: '' }); // the findings say why
      return;
    }
    if (this.wanted) return;
    const scene = understood(out);
    if (!scene.cameras.includes(this.camera)) this.camera = '';
    this.scene = { ...scene, path, camera: this.camera };
    this.seen(scene);
    const tried = /--samples,(\d+)/.exec(this.settings);
    if (tried) scene.samples = +tried[1];
    const passes = PARTS.filter((part) => part === 1 || scene.width / part >= LEAST).map((part) => ({
      part,
      words: ['--size', `${Math.ceil(scene.width / part)}x${Math.ceil(scene.height / part)}`, '--samples', '1'],
    }));
    if (scene.samples === 1) passes.pop();
    passes.push({ part: 1, words: this.settings, whole: true });
    const camera = this.camera ? ['--camera', this.camera] : [];
    let why = this.gpu ? null : undefined; // why the GPU did not draw; null: it was not asked yet
    for (const { part, words, whole } of passes) {
      if (why === null && part < PARTS[0]) {
        why = await this.byGpu(path, camera, scene);
        if (!why || this.wanted) return;
      }
      const { status, err, files, ms } = await this.run(['render', path, ...TRACER, ...camera, ...words, '-o', '/picture.png'], ['/picture.png']);
      if (status !== 0) {
        this.told({ failed: err });
        return;
      }
      if (this.wanted && !whole) return;
      await this.show(files['/picture.png'], scene);
      if (whole && !this.wanted) this.whole = files['/picture.png'];
      this.told({ part, ms, whole: !!whole, by: why ? `the reference: ${why}` : 'the reference', samples: whole ? scene.samples : 1, width: scene.width, height: scene.height });
    }
  }

  async show(png, { width, height }) {
    const image = await createImageBitmap(new Blob([png], { type: 'image/png' }), { colorSpaceConversion: 'none' });
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const context = this.canvas.getContext('2d');
    context.imageSmoothingEnabled = false;
    context.drawImage(image, 0, 0, width, height);
    image.close();
  }
}
